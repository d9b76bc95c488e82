"""One browser at one PLC: messages in, events and value frames out.

A browser that does not keep up loses frames, never the newest state: what it missed is made good by a snapshot as soon
as it has taken everything else.
"""

import asyncio
import json
from collections import deque
from collections.abc import Callable, Iterable
from contextlib import suppress

from fastapi import WebSocket, WebSocketDisconnect
from pydantic import TypeAdapter, ValidationError

from scanbench.server.drafts import Drafts
from scanbench.server.people import People
from scanbench.session.session import Session
from scanbench.store.records import ProjectRow
from scanbench.web import messages as wire
from scanbench.web import messages_client as client
from scanbench.web import messages_commands as commands
from scanbench.web import messages_debug as debugger
from scanbench.web import messages_together as together
from scanbench.web import translate, translate_debug, translate_verify
from scanbench.web.dap.attaching import ForBrowser
from scanbench.web.dap.conversation import Conversation
from scanbench.web.invalid import said
from scanbench.web.socket.drafting import Drafting
from scanbench.web.socket.paced import Paced
from scanbench.web.socket.waiting import Waiting
from scanbench.wire import events
from scanbench.wire.commands import read_command
from scanbench.wire.events import Event, User
from scanbench.wire.host import Ack
from scanbench.wire.refused import Refused, Unavailable
from scanbench.wire.together import PeopleChanged
from scanbench.wire.verifying import VerificationStatus

WAITING_FRAMES = 4
"""So many frames not yet sent: the browser is slow, and gets a snapshot instead."""
ALIVE_AFTER_S = 5.0
"""So long without anything to tell: an `Alive` is sent. Browsers give up after 12 s of silence."""
_Wanted = (
    commands.Command
    | client.Press
    | client.Run
    | client.Travel
    | client.NewRun
    | client.RollBack
    | debugger.SetCoverage
    | together.OpenDraft
    | together.EditDraft
    | together.CloseDraft
)

_INCOMING: TypeAdapter[client.ClientMessage] = TypeAdapter(client.ClientMessage)
_OUTGOING: TypeAdapter[wire.ServerMessage] = TypeAdapter(wire.ServerMessage)


class Client:
    """A subscriber that is connected by a WebSocket."""

    def __init__(self, socket: WebSocket, session: Session, user: User, drafts: Drafts, people: People) -> None:
        self.user = user
        self._socket, self._session = socket, session
        self._id = 0
        self._ids: set[int] = set()
        self._texts = Waiting()
        self._paced = Paced()
        self._frames: deque[bytes] = deque()
        self._stale = False
        self._asked = False
        self._wake = asyncio.Event()
        self._slow: set[asyncio.Task[None]] = set()
        self._dap: Conversation | None = None
        self._pressed: set[str] = set()
        """Variables that a push button of this browser holds at TRUE."""
        self._people, self._person = people, 0
        self._others: PeopleChanged | None = None
        self._drafting = Drafting(drafts, session.project_id, self, self._say_draft)

    # ---- from the session -----------------------------------------------------------------------------------------

    def on_event(self, event: Event) -> None:
        """Queues it; of states, of rows of errors, and of where people are, only the newest is worth sending."""
        if isinstance(event, events.LogpointSaid | events.WrittenInside):
            return
        if isinstance(event, events.WatchListChanged) and event.owner not in ("", self.user.name):
            return
        if isinstance(event, events.StateChanged):
            self._paced.state(event)
        elif isinstance(event, events.ErrorsChanged):
            self._paced.errors(event)
        elif isinstance(event, PeopleChanged):
            self._others = event
        elif isinstance(event, events.Watching):
            self._on_watching(event)
        else:
            self._texts.add(_text(translate.event(event)))
        self._wake.set()

    def on_frame(self, frame: bytes) -> None:
        """Queues it, unless the browser lags behind."""
        if self._stale or not self._ids:
            return
        if len(self._frames) >= WAITING_FRAMES:
            self._frames.clear()
            self._stale, self._asked = True, False
        else:
            self._frames.append(frame)
        self._wake.set()

    def on_snapshot(self, frame: bytes) -> None:
        """All values: what was missed does not matter any more."""
        self._frames.clear()
        self._frames.append(frame)
        self._stale = False
        self._wake.set()

    def _on_watching(self, event: events.Watching) -> None:
        """Other people's paths are none of its business."""
        items = event.items
        if event.ref is None:
            items = tuple(item for item in items if item.id in self._ids)
        self._ids.update(item.id for item in items if item.sent)
        # Also without items: then this browser asks again for what it was refused.
        self._texts.add(_text(translate.event(events.Watching(event.ref, items))))

    # ---- the socket -----------------------------------------------------------------------------------------------

    async def serve(
        self, project: ProjectRow, verifications: Callable[[Session], Iterable[VerificationStatus]]
    ) -> None:
        """Speaks with the browser until it goes."""
        await self._socket.accept()
        colour = await self._people.colour(self._session.project_id, self.user.name)
        self._id = self._session.join(self)
        self._person = self._people.come(self._session.project_id, self._session.id, self, colour)
        hello = wire.Hello(  # looked at only now: of what changed before, this browser has been told nothing
            you=translate.user(self.user),
            users=list(map(translate.user, self._session.users)),
            instance=translate.instance(self._session, project),
            errors=list(map(translate.error_row, self._session.errors.rows)),
            log=self._session.log.lines,
            forces=self._session.forces.all,
            device=self._session.device.known,
            armed=self._session.errors.armed,
            lines=events.LinesChanged(self._session.errors.lines),
            diagnostics=translate.diagnostics(self._session.log.violations),
            timeline=self._session.log.timeline,
            breakpoints=list(map(translate_debug.breakpoint, self._session.debugging.verdicts)),
            coverage=self._session.debugging.coverage,
            verifications=list(map(translate_verify.info, verifications(self._session))),
            disturbances=self._session.errors.disturbances,
        )
        self._texts.first(_text(hello))
        writer = asyncio.get_running_loop().create_task(self._write())
        try:
            while True:
                await self._receive(await self._socket.receive_text())
        except (WebSocketDisconnect, RuntimeError, KeyError):
            pass  # gone, or it sent bytes where only text is understood
        except asyncio.CancelledError:
            if not self._texts.over:
                raise
        finally:
            self._people.leave(self._person)
            await self._let_go()
            self._session.leave(self._id)
            tasks = (writer, *self._slow)
            for task in tasks:
                task.cancel()
            await asyncio.gather(*tasks, return_exceptions=True)
            await self._drafting.end()
            if self._dap is not None:
                await self._dap.close()

    async def _write(self) -> None:
        while True:
            due = self._paced.wait_s()
            try:
                async with asyncio.timeout(ALIVE_AFTER_S if due is None else due):
                    await self._wake.wait()
            except TimeoutError:
                if due is None:
                    await self._socket.send_text(_text(wire.Alive()))
                    continue
            self._wake.clear()
            is_due = self._paced.wait_s() == 0
            if is_due:
                self._add_errors()
            while self._texts:
                await self._socket.send_text(self._texts.take())
            if is_due and (state := self._paced.take_state()) is not None:
                await self._socket.send_text(_text(translate.event(state)))
            if self._others is not None:
                others, self._others = self._others, None
                await self._socket.send_text(_text(translate.event(others)))
            while self._frames:
                await self._socket.send_bytes(self._frames.popleft())
            if self._stale and not self._asked:
                self._asked = True
                self._session.watching.want_snapshot(self._id)

    def _add_errors(self) -> None:
        errors = self._paced.take_errors()
        if errors is not None:
            self._texts.add(_text(translate.event(errors)))

    def _answer(
        self, ref: int, ok: bool, message: str, scan: int | None = None, near: tuple[str, ...] = (), final: bool = False
    ) -> None:
        self._add_errors()
        self._texts.add(_text(wire.Done(ref=ref, ok=ok, message=message, scan=scan, near=list(near), final=final)))
        self._wake.set()

    # ---- from the browser -----------------------------------------------------------------------------------------

    async def _receive(self, text: str) -> None:
        try:
            message = _INCOMING.validate_json(text)
        except ValidationError as error:
            first = error.errors()[0]
            place = ".".join(map(str, first["loc"]))
            self._answer(_ref_of(text), False, f"not a message of this server: {said(first, place)}")
            return
        match message:
            case client.Watch():
                self._session.watching.watch(self._id, message.ref, message.paths)
            case debugger.DapOut():
                self._debugger().receive(message.message)
            case client.Unwatch():
                self._ids.difference_update(message.ids)
                self._session.watching.unwatch(self._id, message.ids)
            case together.Here():
                self._people.move(self._person, message.file, message.line, message.anchor, message.head)
            # A build, or a database: the rest must not wait for it.
            case client.Travel() | client.NewRun() | client.RollBack():
                self._serve_aside(message)
            case together.OpenDraft() | together.EditDraft() | together.CloseDraft():
                self._serve_aside(message)
            case _:
                await self._serve(message)

    def _serve_aside(self, message: _Wanted) -> None:
        task = asyncio.get_running_loop().create_task(self._serve(message))
        self._slow.add(task)
        task.add_done_callback(self._slow.discard)

    def _say_draft(self, draft: together.Draft) -> None:
        self._texts.add(_text(draft))
        self._wake.set()

    def _debugger(self) -> Conversation:
        """The browser's debug session, which begins with its first word."""
        if self._dap is None:
            lender = ForBrowser(self._session, self.user.name)
            self._dap = Conversation(self._say_dap, lender, self.user, self._end_dap)
        return self._dap

    def _say_dap(self, message: dict[str, object]) -> None:
        self._texts.add(_text(debugger.Dap.model_validate({"message": message})))
        self._wake.set()

    def _end_dap(self) -> None:
        self._dap = None

    async def _serve(self, message: _Wanted) -> None:
        try:
            ack = await self._done(message)
        except Refused as error:
            self._answer(message.ref, False, error.message, None, error.near, error.final)
            return
        self._answer(message.ref, ack.ok, ack.message, ack.scan, ack.near)

    async def _press(self, path: str, down: bool) -> Ack:
        wanted = {"path": path, "value": "TRUE" if down else "FALSE", "site": ""}
        ack = await self._session.submit(read_command("write", wanted, self.user.name))
        if ack.ok:
            (self._pressed.add if down else self._pressed.discard)(path)
        return ack

    async def _let_go(self) -> None:
        """Nobody is there any more to let go of what is pressed."""
        for path in tuple(self._pressed):
            with suppress(Refused, Unavailable):
                await asyncio.shield(self._press(path, False))

    async def _done(self, message: _Wanted) -> Ack:
        session, author = self._session, self.user.name
        match message:
            case client.Press():
                return await self._press(message.path, message.down)
            case client.Run():
                return await session.drive(message.action, message.speed, author, message.scans, message.until)
            case client.Travel():
                return await session.travel(message.scan, author, message.count)
            case client.NewRun():
                return await session.new_run(author)
            case client.RollBack():
                return await session.roll_back(author)
            case together.OpenDraft() | together.EditDraft() | together.CloseDraft():
                await self._drafting.serve(message)
                return Ack(0, True, "", session.state.scan)
            case debugger.SetCoverage():
                return await session.debugging.cover(message.on, message.reset, author)
            case _:
                given = message.model_dump(exclude={"type", "ref"})
                return await session.submit(read_command(message.type, given, author))


def _text(message: wire.ServerMessage) -> str:
    return _OUTGOING.dump_json(message).decode()


def _ref_of(text: str) -> int:
    """The ref of a message that is wrong otherwise, so that its sender learns of it; -1 where there is none."""
    with suppress(ValueError, AttributeError):
        ref = json.loads(text).get("ref")
        if isinstance(ref, int):
            return ref
    return -1
