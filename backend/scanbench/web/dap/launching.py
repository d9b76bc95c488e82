"""`launch`: a program from this machine's disk on a virtual PLC of its own, which ends with the debug session."""

import asyncio
import os
from dataclasses import dataclass, replace
from pathlib import Path

from scanbench.check.build import check_sources
from scanbench.jobs.checker import INTERVAL_NS
from scanbench.plcmodel.load import NoModels, NoSuchModel, model_named
from scanbench.plcmodel.model import Model
from scanbench.problems import Problem, Severity
from scanbench.server.from_disk import DEFAULT_MODEL, program_files, project_model, read_text
from scanbench.server.solo import Solo
from scanbench.server.user_cache import user_cache
from scanbench.syntax.literals import duration
from scanbench.web.dap import shapes
from scanbench.web.dap.debuggee import Debuggee
from scanbench.web.dap.events import Send
from scanbench.web.dap.paths import FolderPaths
from scanbench.web.dap.run import move, proceed
from scanbench.web.dap.shapes import Body
from scanbench.wire.host import Sources
from scanbench.wire.refused import Refused

_SHORTEST_NS = 1_000
_SLOWEST = 0.01


@dataclass(frozen=True, slots=True)
class Found:
    """What is to be launched."""

    root: Path
    real: str
    """The same folder without links."""
    sources: Sources
    model: Model


class Launcher:
    """Lends PLCs that it starts itself."""

    present: Debuggee | None = None

    def __init__(self, author: str) -> None:
        self._author = author
        self._args: shapes.Launch | None = None
        self._solo: Solo | None = None

    async def launch(self, args: shapes.Launch, say: Send) -> Debuggee:
        """Checks and builds; problems are told one by one as output."""
        if 0 < args.pace < _SLOWEST:
            raise Refused(f"pace {args.pace:g} is too slow: from {_SLOWEST:g} on, or 0 for as fast as possible")
        self._args = args
        found = await asyncio.to_thread(find, args)
        await _check(found, say)
        cache = await asyncio.to_thread(user_cache)
        self._solo = await Solo.start(found.root.name, found.sources, found.model, args.pace, cache)
        session = self._solo.session
        paths = FolderPaths(lambda: session.instance.sources.files, str(found.root), found.real)
        return Debuggee(session, self._author, "launched", paths, breaks=not args.no_debug)

    async def attach(self, args: shapes.Attach) -> Debuggee:
        """Not here."""
        raise Refused("attach needs the address of a server: `address`, and perhaps `token` and `instance`")

    async def begin(self, plc: Debuggee) -> None:
        """Runs, or halts at the first statement."""
        assert self._args is not None
        if self._args.stop_on_entry and not self._args.no_debug:
            await move(plc, "entry")
        else:
            await proceed(plc)

    async def restart(self, plc: Debuggee, say: Send) -> None:
        """A new run of what the files say now; breakpoints stay."""
        assert self._args is not None
        assert self._solo is not None
        found = await asyncio.to_thread(find, self._args)
        await _check(found, say)
        plc.done(await plc.session.drive("pause", None, plc.author))
        sources = replace(found.sources, version=plc.session.instance.sources.version + 1)
        plc.done(await plc.session.new_run(plc.author, sources))
        await self._solo.settled()
        await self.begin(plc)

    async def end(self, plc: Debuggee) -> bool:
        """The PLC goes with its session."""
        if self._solo is not None:
            solo, self._solo = self._solo, None
            await solo.close()
        return True


def find(args: shapes.Launch) -> Found:
    """Reads what is to be launched; `Refused` says what is wrong with the arguments or the files."""
    path = Path(args.cwd or ".", args.program).expanduser().absolute()
    path = Path(os.path.normpath(path))
    files = program_files(path)
    root = path if path.is_dir() else path.parent
    texts = {each.relative_to(root).as_posix(): read_text(each) for each in files}
    name = args.model or project_model(root) or DEFAULT_MODEL
    try:
        model = model_named(name)
    except (NoModels, NoSuchModel) as error:
        raise Refused(str(error)) from error
    return Found(root, os.path.realpath(root), Sources(model.name, texts, _interval(args.interval), 1), model)


def _interval(text: str | None) -> int:
    if text is None:
        return INTERVAL_NS
    try:
        interval = duration(text.upper().removeprefix("T#").removeprefix("TIME#"))
    except ValueError as error:
        raise Refused(f"interval {text}: {error}") from error
    if interval < _SHORTEST_NS:
        raise Refused(f"interval {text}: a task runs at most every microsecond")
    return interval


async def _check(found: Found, say: Send) -> None:
    """Reports all problems; `Refused` with the first one that prevents the program from running."""
    sources = found.sources
    checked = await asyncio.to_thread(check_sources, sources.files, found.model, sources.interval_ns)
    for problem in checked.problems:
        say("output", _output(found.root, problem))
    errors = [each for each in checked.problems if each.severity is Severity.ERROR]
    if errors:
        count = f"{len(errors)} error{'s' * (len(errors) != 1)}"
        raise Refused(f"{count}, nothing was started: {_at(found.root, errors[0])}")
    if checked.program is None:
        raise Refused(f"there is nothing to run in {found.root}: declare a PROGRAM")


def _output(root: Path, problem: Problem) -> Body:
    span = problem.span
    path = root / span.file
    body: Body = {
        "category": "stderr" if problem.severity is Severity.ERROR else "console",
        "output": f"{_at(root, problem)}\n",
    }
    if path.is_file():
        body |= {"source": {"name": path.name, "path": str(path)}, "line": span.line, "column": span.column}
    return body


def _at(root: Path, problem: Problem) -> str:
    return f"{root}{os.sep}{problem}"
