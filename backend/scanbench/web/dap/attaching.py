"""PLCs of a server for DAP clients: a browser shares everything with the other browsers, a tool has a list of its own."""

from collections.abc import Iterable
from contextlib import suppress
from itertools import count

from scanbench.runtime.restart import Restart
from scanbench.session.session import Session
from scanbench.web.dap import shapes
from scanbench.web.dap.debuggee import Debuggee
from scanbench.web.dap.events import Send
from scanbench.web.dap.paths import FolderPaths, ProjectPaths, ServerPaths
from scanbench.web.dap.run import proceed
from scanbench.wire.refused import Refused

_numbers = count(1)
_NO_LAUNCH = "a server's PLCs are attached to: to launch a program, use `scanbench dap`"


class ForBrowser:
    """The PLC that a browser looks at: breakpoints are everybody's, and stay when it goes."""

    def __init__(self, session: Session, author: str) -> None:
        paths = ProjectPaths(lambda: session.instance.sources.files)
        self.present: Debuggee | None = Debuggee(session, author, "", paths)

    async def launch(self, args: shapes.Launch, say: Send) -> Debuggee:
        """Not here."""
        raise Refused(_NO_LAUNCH)

    async def attach(self, args: shapes.Attach) -> Debuggee:
        """It is attached already."""
        assert self.present is not None
        return self.present

    async def begin(self, plc: Debuggee) -> None:
        """It runs already."""

    async def restart(self, plc: Debuggee, say: Send) -> None:
        """As somebody who switches it off and on, for everybody."""
        await cold_restart(plc)

    async def end(self, plc: Debuggee) -> bool:
        """Others may be at it, and a page that is loaded again is back in a moment: it stays as it is."""
        return False


class ForTool:
    """A PLC of this server for a client like VS Code: its breakpoints go with it."""

    present: Debuggee | None = None

    def __init__(self, session: Session, author: str) -> None:
        self._session, self._author = session, author

    async def launch(self, args: shapes.Launch, say: Send) -> Debuggee:
        """Not here."""
        raise Refused(_NO_LAUNCH)

    async def attach(self, args: shapes.Attach) -> Debuggee:
        """With the files of a folder on the client's machine, or texts from here."""
        session = self._session

        def files() -> Iterable[str]:
            return session.instance.sources.files

        paths = FolderPaths(files, args.local_root) if args.local_root else ServerPaths(files)
        return Debuggee(session, self._author, f"debug session {next(_numbers)}", paths)

    async def begin(self, plc: Debuggee) -> None:
        """It runs already."""

    async def restart(self, plc: Debuggee, say: Send) -> None:
        """As somebody who switches it off and on, for everybody."""
        await cold_restart(plc)

    async def end(self, plc: Debuggee) -> bool:
        """A PLC that is halted, and at which nobody is any more, goes on."""
        session = plc.session
        await session.debugging.forget_group(plc.group)
        if session.state.halt is not None and not session.users:
            with suppress(Refused):  # somebody was faster
                if session.state.past_by:
                    await session.travel(None, plc.author)
                await proceed(plc)
        return False


async def cold_restart(plc: Debuggee) -> None:
    """Everything initial, and it runs."""
    plc.done(await plc.session.submit(Restart(plc.author, "cold")))
    if plc.session.state.halt is not None or plc.session.state.state == "paused":
        await proceed(plc)
