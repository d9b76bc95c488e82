"""One PLC and the people at it: commands in, events out, history and log kept."""

from collections.abc import Awaitable, Iterable, Sequence
from pathlib import Path

from scanbench.check.violations import Violations
from scanbench.faults.history import ErrorRow, History
from scanbench.faults.inject import Generate, Recover
from scanbench.plcmodel.model import Model
from scanbench.runtime.clear_violations import ClearViolations
from scanbench.runtime.clock import wall_time
from scanbench.runtime.command import Command, Entry
from scanbench.runtime.forces import Force, Release, forced
from scanbench.runtime.modes import SetMode
from scanbench.runtime.program_change import ProgramChange
from scanbench.runtime.trap import Trapped
from scanbench.runtime.write import Write
from scanbench.session import events, protocol
from scanbench.session.builds import BuildOutcome
from scanbench.session.events import Event, LogEntry, PlcState, Subscriber, User
from scanbench.session.instance import Instance, Unavailable
from scanbench.session.keeper import Keeper
from scanbench.session.watches import Watches

LOG_LINES = 500
_EVERYBODY = 0
_LOG_KINDS: dict[type, str] = {
    Write: "write", Force: "force", Release: "force", Generate: "error", Recover: "recover", SetMode: "mode",
    ProgramChange: "build", Trapped: "system", ClearViolations: "run",
}  # fmt: skip


class Session:
    """Everything that one instance is to the rest of the server."""

    def __init__(
        self, id: int, name: str, project_id: int, model: Model, sources: protocol.Sources, keeper: Keeper,
        rows: dict[str, ErrorRow], lines: Sequence[LogEntry], cache: Path | None = None,
    ) -> None:  # fmt: skip
        self.id, self.name, self.project_id, self.model = id, name, project_id, model
        self._keeper = keeper
        self._history = History(model, rows)
        self._lines = list(lines)[-LOG_LINES:]
        self._subscribers: dict[int, Subscriber] = {}
        self._next_subscriber = 1
        self._watches = Watches()
        self._questions: dict[int, tuple[int, int]] = {}
        self._next_question = _EVERYBODY + 1
        self._unwatched = False  # what is watched must be told to the next host
        self._violations = Violations()
        self._instance = Instance(sources, self._on_state, self._on_message, cache)
        self._last_state = self._instance.state

    # ---- what it is -----------------------------------------------------------------------------------------------

    @property
    def state(self) -> PlcState:
        """The PLC's state."""
        return self._instance.state

    @property
    def rows(self) -> list[ErrorRow]:
        """The error history, in the order of the catalogue."""
        return self._history.rows

    @property
    def lines(self) -> list[LogEntry]:
        """The last lines of the log."""
        return list(self._lines)

    @property
    def forces(self) -> tuple[Force, ...]:
        """The forces that hold, in the order in which they were made."""
        return tuple(forced(self._instance.entries).values())

    @property
    def violations(self) -> Violations:
        """The runtime diagnostics."""
        return self._violations

    @property
    def users(self) -> tuple[User, ...]:
        """Who is here, everybody once."""
        return tuple(dict.fromkeys(subscriber.user for subscriber in self._subscribers.values()))

    # ---- life -----------------------------------------------------------------------------------------------------

    def start(self) -> None:
        """Starts the PLC. Errors that the last server left generated are gone: the start is a cold one."""
        self._cleared_by_cold_start()
        self._add_line(LogEntry(wall_time(), 0, "server", "the server started: cold start at scan 0", "system"))
        self._instance.start()

    async def stop(self) -> None:
        """Ends the PLC's process."""
        await self._instance.stop()

    # ---- commands -------------------------------------------------------------------------------------------------

    async def submit(self, command: Command) -> protocol.Ack:
        """The one door: enters a command in the seam of the PLC."""
        return await self._refusing(self._instance.submit(command))

    async def drive(self, action: str, speed: float | None, author: str) -> protocol.Ack:
        """Pace of the run: continue, pause, scan, restart."""
        ack = await self._refusing(self._instance.drive(action, speed, author))
        if ack.ok:
            self._add_line(LogEntry(wall_time(), ack.scan, author, ack.message, "run"))
        return ack

    async def build(self, sources: protocol.Sources, author: str) -> protocol.Ack:
        """A new program for the PLC; the old one goes on until the new one is ready."""
        return await self._refusing(self._instance.build(sources, author))

    def told_built(self, author: str, outcome: BuildOutcome) -> None:
        """Tells everybody here what became of a build of their project."""
        self._publish(events.ProgramBuilt(author, outcome))
        if not outcome.ok:
            self._add_line(LogEntry(wall_time(), self.state.scan, author, f"build refused: {outcome.message}", "build"))

    def told_saved(self, author: str, path: str, version: int) -> None:
        """Tells everybody here that a file was saved."""
        self._publish(events.FileSaved(author, path, version))

    def told_deleted(self, author: str, path: str) -> None:
        """Tells everybody here that a file was deleted."""
        self._publish(events.FileDeleted(author, path))

    async def _refusing(self, answer: Awaitable[protocol.Ack]) -> protocol.Ack:
        try:
            return await answer
        except Unavailable as error:
            return protocol.Ack(0, False, str(error), self.state.scan)

    # ---- looking --------------------------------------------------------------------------------------------------

    def join(self, subscriber: Subscriber) -> int:
        """Takes a subscriber in; the number to `leave` with."""
        id, self._next_subscriber = self._next_subscriber, self._next_subscriber + 1
        self._subscribers[id] = subscriber
        self._publish(events.UsersChanged(self.users))
        return id

    def leave(self, id: int) -> None:
        """The subscriber is gone, and what only it watched is watched no more."""
        if self._subscribers.pop(id, None) is not None:
            self._unwatch(self._watches.drop(id))
            self._publish(events.UsersChanged(self.users))

    def watch(self, subscriber: int, ref: int, paths: Sequence[str]) -> None:
        """Watches paths; the answer is a `Watching` event, before any frame with the new ids.

        All subscribers share the ids, each value is in the frames once.
        """
        pairs = self._watches.add(subscriber, paths)
        question, self._next_question = self._next_question, self._next_question + 1
        if self._instance.tell(protocol.WatchPaths(question, pairs)):
            self._questions[question] = (subscriber, ref)
        else:
            self._unwatched = True

    def unwatch(self, subscriber: int, ids: Iterable[int]) -> None:
        """Ends watching for this subscriber."""
        self._unwatch(self._watches.forget(subscriber, ids))

    def want_snapshot(self, subscriber: int) -> None:
        """A frame with all values, for this subscriber alone."""
        self._instance.tell(protocol.WantSnapshot(subscriber))

    async def look_up(self, kind: str, text: str) -> protocol.Found:
        """`members` of a path, or what `complete`s a text."""
        return await self._instance.look_up(kind, text)

    def _unwatch(self, ids: Sequence[int]) -> None:
        if ids:
            self._instance.tell(protocol.UnwatchIds(tuple(ids)))

    # ---- from the instance ----------------------------------------------------------------------------------------

    def _on_state(self, state: PlcState) -> None:
        before, self._last_state = self._last_state, state
        self._publish(events.StateChanged(state))
        if state.state != before.state and state.state in ("restarting", "failed"):
            self._questions.clear()
            self._unwatched = True
            self._add_line(LogEntry(wall_time(), state.scan, "server", state.message, "system"))

    def _on_message(self, message: object) -> None:
        match message:
            case protocol.Frame():
                self._on_frame(message)
            case protocol.Entered():
                self._on_entry(message.entry)
            case protocol.ColdStart():
                self._cleared_by_cold_start()
                self._publish(events.ForcesChanged(self.forces))
                self._on_diagnosed(Violations())
            case protocol.Diagnosed():
                self._on_diagnosed(message.violations)
            case protocol.Ready():
                self._on_ready(message)
            case protocol.Watching():
                self._on_watching(message)

    def _on_frame(self, frame: protocol.Frame) -> None:
        if frame.to is None:
            for subscriber in self._subscribers.values():
                subscriber.on_frame(frame.data)
        elif frame.to in self._subscribers:
            self._subscribers[frame.to].on_snapshot(frame.data)

    def _on_entry(self, entry: Entry) -> None:
        command = entry.command
        self._publish_rows(self._history.fold(entry))
        if isinstance(command, Write | Force):
            forced = isinstance(command, Force)
            self._publish(events.ValueWritten(command.path, command.author, entry.scan, forced))
        if isinstance(command, Force | Release | ProgramChange):
            self._publish(events.ForcesChanged(self.forces))
        kind = _LOG_KINDS.get(type(command), "system")
        self._add_line(LogEntry(entry.at, entry.scan, command.author, entry.plan.message, kind))

    def _on_diagnosed(self, violations: Violations) -> None:
        """Everybody gets the list; a place that is new in it also gets a line of the log."""
        before = {(each.site, each.instance) for each in self._violations.entries}
        self._violations = violations
        self._publish(events.DiagnosticsChanged(violations))
        for each in violations.entries:
            if (each.site, each.instance) not in before:
                text = f"{each}, {each.span.file}:{each.span.line}"
                self._add_line(LogEntry(wall_time(), each.first_scan, "PLC", text, "system"))

    def _on_ready(self, ready: protocol.Ready) -> None:
        if ready.message:
            self._add_line(LogEntry(wall_time(), self.state.scan, "server", ready.message, "system"))
        if self._unwatched:
            self._unwatched = False
            self._instance.tell(protocol.WatchPaths(_EVERYBODY, self._watches.all()))

    def _on_watching(self, answer: protocol.Watching) -> None:
        if answer.ref is None or answer.ref == _EVERYBODY:
            self._publish(events.Watching(None, answer.items))
            return
        subscriber, ref = self._questions.pop(answer.ref, (0, 0))
        self._unwatch(self._watches.forget(subscriber, [item.id for item in answer.items if not item.sent]))
        if subscriber in self._subscribers:
            self._subscribers[subscriber].on_event(events.Watching(ref, answer.items))

    # ---- history and log ------------------------------------------------------------------------------------------

    def _cleared_by_cold_start(self) -> None:
        self._publish_rows(self._history.cold_start(wall_time()))

    def _publish_rows(self, rows: Sequence[ErrorRow]) -> None:
        if rows:
            self._keeper.keep_rows(self.id, rows, self.state.version)
            self._publish(events.ErrorsChanged(tuple(rows)))

    def _add_line(self, line: LogEntry) -> None:
        self._lines.append(line)
        del self._lines[:-LOG_LINES]
        self._keeper.keep_line(self.id, line)
        self._publish(events.Logged((line,)))

    def _publish(self, event: Event) -> None:
        for subscriber in list(self._subscribers.values()):
            subscriber.on_event(event)
