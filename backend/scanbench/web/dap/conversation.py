"""One DAP session over any transport: requests in, responses and events out."""

import asyncio
import logging
from collections.abc import Awaitable, Callable, Sequence
from dataclasses import dataclass
from typing import Protocol

from pydantic import ValidationError

from scanbench.translation.inside import wanted
from scanbench.web.dap import shapes
from scanbench.web.dap.answers import fault, refusal, response
from scanbench.web.dap.debuggee import Debuggee
from scanbench.web.dap.events import Events
from scanbench.web.dap.handlers import CAPABILITIES, HANDLERS
from scanbench.web.dap.said import said
from scanbench.web.dap.shapes import Body
from scanbench.wire.events import Event, User
from scanbench.wire.refused import Refused, Unavailable

log = logging.getLogger("scanbench")

Send = Callable[[Body], None]


class Lender(Protocol):
    """Where a conversation has its PLC from."""

    present: Debuggee | None
    """One that is attached from the start, and to a client that sees its breakpoints: nothing has to be configured."""

    async def launch(self, args: shapes.Launch, say: Callable[[str, Body], None]) -> Debuggee:
        """Starts a PLC of its own, which waits before its first scan; `say` sends an event."""

    async def attach(self, args: shapes.Attach) -> Debuggee:
        """One that is there."""

    async def begin(self, plc: Debuggee) -> None:
        """The client has set its breakpoints: a PLC that was launched runs now."""

    async def restart(self, plc: Debuggee, say: Callable[[str, Body], None]) -> None:
        """From the beginning."""

    async def end(self, plc: Debuggee) -> bool:
        """The client is gone or wants to be; whether the PLC ended with it."""


@dataclass(frozen=True, slots=True)
class Attached:
    """What a PLC and its events are to a conversation."""

    plc: Debuggee
    events: Events
    number: int
    """Of the subscriber."""


class Conversation:
    """A DAP session. A subscriber of its PLC's session as long as it has one."""

    def __init__(self, send: Send, lender: Lender, user: User, on_end: Callable[[], None] = lambda: None) -> None:
        """`on_end` is called when the client has said good-bye."""
        self.user = user
        self._send, self._lender, self._on_end = send, lender, on_end
        self._seq = 0
        self._language = "en"
        self._client: shapes.Initialize | None = None
        self._attached: Attached | None = None
        self._configured = asyncio.Event()
        self._running: dict[int, tuple[str, asyncio.Task[None]]] = {}
        self._launching = False
        self._over = False
        self._own: dict[str, Callable[[shapes.Request], Awaitable[None]]] = {
            "initialize": self._on_initialize, "launch": self._on_launch, "attach": self._on_attach,
            "configurationDone": self._on_configuration_done, "disconnect": self._on_disconnect,
            "terminate": self._on_terminate, "restart": self._on_restart, "cancel": self._on_cancel,
        }  # fmt: skip

    # ---- from the transport ---------------------------------------------------------------------------------------

    def receive(self, message: object) -> None:
        """A message of the client. Answers come one by one as they are found; requests reach the PLC in their order."""
        if not isinstance(message, dict):
            self._on_nonsense(message, "it is no JSON object")
            return
        try:
            request = shapes.Request.model_validate(_without_nulls(message))
        except ValidationError as error:
            self._on_nonsense(message, fault(error))
            return
        except RecursionError:
            self._on_nonsense(message, "it is nested too deeply")
            return
        task = asyncio.get_running_loop().create_task(self._serve(request))
        self._running[request.seq] = request.command, task
        task.add_done_callback(lambda done: self._forget(request.seq, done))

    def _forget(self, seq: int, task: asyncio.Task[None]) -> None:
        if seq in self._running and self._running[seq][1] is task:
            del self._running[seq]

    def _on_nonsense(self, message: object, text: str) -> None:
        if isinstance(message, dict) and message.get("type") in ("response", "event"):
            return  # nothing was asked of the client
        seq = message.get("seq") if isinstance(message, dict) else None
        command = message.get("command") if isinstance(message, dict) else None
        self._refuse(
            seq if isinstance(seq, int) else 0, command if isinstance(command, str) else "",
            f"no request of DAP: {text}",
        )  # fmt: skip

    async def close(self) -> None:
        """The client is gone."""
        await self._give_up()
        await self._leave()

    async def _give_up(self) -> None:
        """Ends all requests that are being served, but the one that asks for it."""
        tasks = [task for _, task in self._running.values() if task is not asyncio.current_task()]
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)

    # ---- from the session -----------------------------------------------------------------------------------------

    def on_event(self, event: Event) -> None:
        """Something happened at the PLC."""
        if self._attached is not None:
            self._attached.events.on_event(event)

    def on_frame(self, frame: bytes) -> None:
        """A debugger asks for values."""

    def on_snapshot(self, frame: bytes) -> None:
        """A debugger asks for values."""

    # ---- requests -------------------------------------------------------------------------------------------------

    async def _serve(self, request: shapes.Request) -> None:
        try:
            await self._dispatch(request)
        except asyncio.CancelledError:
            self._refuse(request.seq, request.command, "cancelled")
            raise
        except (Refused, Unavailable) as error:
            near = error.near if isinstance(error, Refused) else ()
            self._refuse(request.seq, request.command, str(error), near)
        except ValidationError as error:
            self._refuse(request.seq, request.command, f"{request.command}: {fault(error)}")
        except UnicodeEncodeError:
            self._refuse(request.seq, request.command, f"{request.command}: a text in it is no Unicode")
        except Exception:
            log.exception("the DAP request %s could not be served", request.command)
            self._refuse(request.seq, request.command, f"{request.command} failed: see the server's log")

    async def _dispatch(self, request: shapes.Request) -> None:
        if request.command in self._own:
            await self._own[request.command](request)
            return
        handler = HANDLERS.get(request.command)
        if handler is None:
            raise Refused(f"there is no request {request.command!r} here", tuple(sorted({*self._own, *HANDLERS})))
        attached = self._needed()
        if not attached.plc.breaks and request.command.endswith("Breakpoints"):
            self._respond(request.seq, request.command, _ignored(request.arguments))
            return
        if not handler.moves:
            self._respond(request.seq, request.command, await handler(attached.plc, request.arguments))
            return
        attached.events.begin_move()
        moved = False
        try:
            body = await handler(attached.plc, request.arguments)
            moved = True
            self._respond(request.seq, request.command, body)
        finally:
            if not moved:
                asyncio.get_running_loop().call_soon(attached.events.end_move, False)  # after the refusal
            else:
                attached.events.end_move(True)

    def _needed(self) -> Attached:
        if self._attached is None:
            hint = "send `initialize` first" if self._client is None else "send `launch` or `attach` first"
            raise Refused(f"there is no PLC yet: {hint}")
        return self._attached

    # ---- beginning and ending -------------------------------------------------------------------------------------

    async def _on_initialize(self, request: shapes.Request) -> None:
        if self._client is not None and self._lender.present is None:
            raise Refused("initialize comes once")
        self._client = shapes.Initialize.model_validate(request.arguments)
        self._language = wanted(self._client.locale)
        self._respond(request.seq, request.command, CAPABILITIES)
        present = self._lender.present
        if present is not None:
            if self._attached is None:
                self._attach(present)
            present.client = self._client
            self._event("initialized", {})
            self._needed().events.start()

    def _attach(self, plc: Debuggee) -> None:
        assert self._client is not None
        plc.client = self._client
        events = Events(plc, self._event, self._on_gone)
        self._attached = Attached(plc, events, plc.session.join(self))

    async def _on_launch(self, request: shapes.Request) -> None:
        args = shapes.Launch.model_validate(request.arguments)
        self._refuse_second()
        self._launching = True
        try:
            self._attach(await self._lender.launch(args, self._event))
            self._event("initialized", {})
            await self._configured.wait()
            await self._lender.begin(self._needed().plc)
        except BaseException:  # refused, or the client has cancelled it: it may launch again
            await self._leave()
            self._configured.clear()
            raise
        finally:
            self._launching = False
        self._respond(request.seq, request.command)
        self._event("process", {"name": self._needed().plc.session.name, "startMethod": "launch"})
        self._needed().events.start()

    async def _on_attach(self, request: shapes.Request) -> None:
        args = shapes.Attach.model_validate(request.arguments)
        if self._client is None or self._lender.present is None:
            self._refuse_second()
            self._attach(await self._lender.attach(args))
            self._event("initialized", {})
        self._respond(request.seq, request.command)

    def _refuse_second(self) -> None:
        if self._client is None:
            raise Refused("send `initialize` first")
        if self._attached is not None or self._launching:
            raise Refused("this session has its PLC already: disconnect first")

    async def _on_configuration_done(self, request: shapes.Request) -> None:
        attached = self._needed()
        setting = [
            task for seq, (command, task) in self._running.items() if seq < request.seq and command.startswith("set")
        ]
        if setting:  # the first scan must not be ahead of them
            await asyncio.wait(setting)
        self._configured.set()
        self._respond(request.seq, request.command)
        if not self._launching:
            attached.events.start()

    async def _on_restart(self, request: shapes.Request) -> None:
        attached = self._needed()
        attached.events.begin_move()
        try:
            await self._lender.restart(attached.plc, self._event)
            self._respond(request.seq, request.command)
        finally:
            asyncio.get_running_loop().call_soon(attached.events.end_move, True)

    async def _on_terminate(self, request: shapes.Request) -> None:
        self._needed()
        await self._give_up()
        self._respond(request.seq, request.command)
        await self._leave()
        self._end_session()

    async def _on_disconnect(self, request: shapes.Request) -> None:
        shapes.Disconnect.model_validate(request.arguments)
        await self._give_up()
        await self._leave()
        self._respond(request.seq, request.command)
        self._on_end()

    async def _on_cancel(self, request: shapes.Request) -> None:
        args = shapes.Cancel.model_validate(request.arguments)
        running = self._running.get(args.request_id) if args.request_id is not None else None
        if running is not None and args.request_id != request.seq:
            running[1].cancel()
        self._respond(request.seq, request.command)

    async def _leave(self) -> None:
        attached, self._attached = self._attached, None
        if attached is None:
            return
        plc = attached.plc
        plc.session.leave(attached.number)
        try:
            ended = await self._lender.end(plc)
        except Exception:  # a client that goes is let go
            log.exception("a debug session at %s did not end as it should", plc.session.name)
            return
        if ended:
            self._event("exited", {"exitCode": 0})

    def _on_gone(self, text: str) -> None:
        """The PLC is switched off, or cannot go on. A browser stays: it sees when there is something again."""
        if self._attached is not None and self._attached.plc.group:
            self._end_session()

    def _end_session(self) -> None:
        if not self._over:
            self._over = True
            self._event("terminated", {})

    # ---- to the client --------------------------------------------------------------------------------------------

    def _respond(self, request_seq: int, command: str, body: Body | None = None) -> None:
        self._say(response(request_seq, command, body))

    def _refuse(self, request_seq: int, command: str, text: str, near: Sequence[str] = ()) -> None:
        self._say(refusal(request_seq, command, text, near))

    def _event(self, event: str, body: Body) -> None:
        message: Body = {"type": "event", "event": event}
        self._say(message | {"body": body} if body else message)

    def _say(self, message: Body) -> None:
        self._seq += 1
        self._send(said({"seq": self._seq, **message}, self._language))


def _without_nulls(value: object) -> object:
    """Some clients send null for what they leave out."""
    if isinstance(value, dict):
        return {key: _without_nulls(each) for key, each in value.items() if each is not None}
    return [_without_nulls(each) for each in value] if isinstance(value, list) else value


def _ignored(arguments: Body) -> Body:
    """The answer to breakpoints of a client that did not want to debug."""
    wanted = arguments.get("breakpoints")
    count = len(wanted) if isinstance(wanted, list) else 0
    return {"breakpoints": [{"verified": False, "message": "launched without debugging"}] * count}
