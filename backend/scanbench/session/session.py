"""One PLC and the people at it: commands in, events out, history and log kept."""

import asyncio
from collections.abc import Awaitable, Callable, Iterable, Mapping, Sequence
from functools import partial
from pathlib import Path

from scanbench.debug.bound_to import Bound
from scanbench.debug.breakpoint import Breakpoint
from scanbench.faults.arm import ArmedInfo
from scanbench.faults.disturb.disturb import DisturbanceInfo
from scanbench.faults.history import ErrorRow, History, Swept
from scanbench.faults.reaction.reaction import Reaction
from scanbench.faults.reference import ErrorRef
from scanbench.host.load import Load, Loads
from scanbench.jobs.reactions import Reactions
from scanbench.plcmodel.model import Model
from scanbench.plcmodel.user_errors import model_for
from scanbench.runtime.clock import wall_time
from scanbench.runtime.command import Command, Entry
from scanbench.runtime.forces import Force, ForcedValue
from scanbench.runtime.write import Write
from scanbench.session.debugging import Debugging
from scanbench.session.instance import Instance, Remembered
from scanbench.session.marks import Marks
from scanbench.session.reacting import Raised, Reacting
from scanbench.session.tracing import Tracing
from scanbench.session.watches import Watches
from scanbench.session.write_behind import WriteBehind
from scanbench.store.records import InstanceRow, Json, NotFound
from scanbench.symbols.violations import Violations
from scanbench.wire import debugging as debug_protocol
from scanbench.wire import events
from scanbench.wire import host as protocol
from scanbench.wire.debugging import DebugAnswer, DebugRequest
from scanbench.wire.events import BuildOutcome, Event, LogEntry, Subscriber, User
from scanbench.wire.host import PlcState
from scanbench.wire.refused import Refused, Unavailable
from scanbench.wire.traces import TracesAre

LOG_LINES = 500
LISTED = 100
"""Entries of one moment that get a line each."""
SPEEDS = 0.01, 1000.0
_EVERYBODY = 0
_LIVING = ("running", "paused", "halted", "stopped", "trapped", "fatal", "no_space")
"""States that a host tells of itself, with the version that runs."""


class Session:
    """Everything that one instance is to the rest of the server."""

    def __init__(
        self, row: InstanceRow, model: Model, memory: Remembered, write_behind: WriteBehind,
        rows: Sequence[ErrorRow], lines: Sequence[LogEntry], loads: Loads, reactions: Reactions,
        breakpoints: Sequence[Breakpoint], cache: Path | None = None, traces: Mapping[int, Json] | None = None,
        why_not: str = "",
    ) -> None:  # fmt: skip
        """`model` is the device; the project's own errors come with the program that runs. `why_not`: why this never runs."""
        self.row, self._device = row, model
        self._loads = loads
        self._write_behind = write_behind
        self._history = History(model_for(model, memory.sources.files), memory.sources.version, rows)
        self._lines = list(lines)[-LOG_LINES:]
        self._subscribers: dict[int, Subscriber] = {}
        self._next_subscriber = 1
        self._listeners: list[Callable[[Event], None]] = []
        self._watches = Watches()
        self._questions: dict[int, tuple[int, int, tuple[tuple[int, str], ...]]] = {}
        self._next_question = _EVERYBODY + 1
        self._unwatched = False  # what is watched must be told to the next host
        self._violations = Violations()
        self._forces: tuple[ForcedValue, ...] = ()
        self._past_rows: list[ErrorRow] = []
        self._armed: tuple[ArmedInfo, ...] = ()
        self._disturbances: tuple[DisturbanceInfo, ...] = ()
        self._reacting = Reacting(reactions, lambda: self.run_file, self._on_reaction)
        if not why_not:
            self._compare(rows)  # the run goes on, so what was being recorded is found out yet
        self._timeline = Marks()
        self._instance = Instance(memory, self._on_state, self._on_message, cache, why_not=why_not)
        self._last_state = self._instance.state
        self.debugging = Debugging(
            self._instance.debug, self._publish, partial(write_behind.keep_breakpoints, row.id), breakpoints
        )
        self.tracing = Tracing(
            self._instance.ask, self._publish, partial(write_behind.keep_traces, row.id), traces or {}
        )
        self._halted = 0
        self._resending: asyncio.Task[None] | None = None

    # ---- what it is -----------------------------------------------------------------------------------------------

    @property
    def id(self) -> int:
        """The instance's number."""
        return self.row.id

    @property
    def name(self) -> str:
        """The instance's name."""
        return self.row.name

    @property
    def project_id(self) -> int:
        """The project that it runs."""
        return self.row.project

    @property
    def load(self) -> Load:
        """What the process cost lately; zeros while there is none."""
        return self._loads.of(self.state.pid)

    @property
    def model(self) -> Model:
        """The model, with the errors of the project as the program that runs knows them."""
        return model_for(self._device, self.sources.files)

    @property
    def sources(self) -> protocol.Sources:
        """What the program that runs is made of."""
        return self._instance.sources

    @property
    def on(self) -> bool:
        """Whether the PLC has a process, or will have one again in a moment."""
        return self._instance.on

    @property
    def why_not(self) -> str:
        """Why the PLC cannot be started at all (its model is missing); empty when it can."""
        return self._instance.why_not

    @property
    def runs(self) -> int:
        """New runs that began since the server started."""
        return self._instance.runs

    @property
    def run_file(self) -> Path:
        """Where the run is recorded."""
        return self._instance.run_file

    @property
    def timeline(self) -> events.TimelineChanged:
        """The run file and all marks."""
        return self._timeline.all

    @property
    def state(self) -> PlcState:
        """The PLC's state."""
        return self._instance.state

    @property
    def rows(self) -> list[ErrorRow]:
        """The error history, in the order of the catalogue; while the past is shown, as it was then."""
        return [self._history.with_sweep(row) for row in self._past_rows or self._history.rows]

    @property
    def history_version(self) -> int:
        """The version whose rows are written now."""
        return self._history.version

    @property
    def history_versions(self) -> list[int]:
        """Versions of the program that have an error history, that of the one that runs included."""
        return self._history.versions

    def rows_of(self, version: int, model: Model) -> list[ErrorRow]:
        """The error history of a version of the program, which ran on this model."""
        return [self._history.with_sweep(row) for row in self._history.rows_of(version, model)]

    def take_sweeps(self, swept: Mapping[int, Mapping[str, Swept]]) -> None:
        """What sweeps of the project found out, by version and error."""
        self._history.take_sweeps(swept)
        self._tell_rows(self.rows)

    @property
    def lines(self) -> list[LogEntry]:
        """The last lines of the log."""
        return list(self._lines)

    @property
    def forces(self) -> tuple[ForcedValue, ...]:
        """The forces that hold, in the order in which they were made, as they were told last."""
        return self._forces

    @property
    def armed(self) -> tuple[ArmedInfo, ...]:
        """The faults that are armed."""
        return self._armed

    @property
    def disturbances(self) -> tuple[DisturbanceInfo, ...]:
        """What is to disturb the PLC, or does."""
        return self._disturbances

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
        """Starts the PLC where its run file ends."""
        self._instance.start()

    async def stop(self) -> None:
        """Ends the PLC's process; its run is kept."""
        await self._instance.stop()
        await self._reacting.close()

    async def change(self, row: InstanceRow, author: str) -> None:
        """Takes over a new name, new limits, and whether it is on."""
        before, self.row = self.row, row
        if row.limits != before.limits:
            self._instance.limit(row.limits)
        if row.powered == self.on:
            return
        self._add_line(
            LogEntry(wall_time(), self.state.scan, author, "switched on" if row.powered else "switched off", "run")
        )
        await self._instance.switch(row.powered)

    # ---- commands -------------------------------------------------------------------------------------------------

    async def submit(self, command: Command) -> protocol.Ack:
        """The one door: enters a command in the seam of the PLC."""
        return await self._refusing(self._instance.submit(command))

    async def drive(
        self, action: str, speed: float | None, author: str, scans: int | None = None, until: str | None = None
    ) -> protocol.Ack:
        """Pace of the run: continue (so many scans, until a condition holds), pause, one scan."""
        low, high = SPEEDS
        if speed is not None and speed != 0 and not low <= speed <= high:
            message = f"speed {speed:g} is outside of x{low:g} to x{high:g}; 0 is without limit"
            return protocol.Ack(0, False, message, self.state.scan)
        drive = protocol.Drive(0, action, speed, author, scans, until)
        return self._logged(await self._refusing(self._instance.drive(drive)), author)

    async def travel(self, scan: int | None, author: str, count: int = 0) -> protocol.Ack:
        """Shows the past to everybody, in front of a statement of the scan if there is a count; or live again."""
        return await self._refusing(self._instance.travel(scan, author, count))

    async def begin_anew(self, author: str, sources: protocol.Sources | None = None) -> protocol.Ack:
        """A new run from scan 0, of other sources if there are any; the old run file is kept aside."""
        return self._logged(await self._refusing(self._instance.begin_anew(sources)), author)

    async def forces_now(self) -> tuple[ForcedValue, ...]:
        """The forces, and what they did in the scan that ran last; of a PLC that is not there those that were told last."""
        try:
            return await self._instance.forces()
        except Unavailable:
            return self._forces

    async def disturbances_now(self) -> tuple[DisturbanceInfo, ...]:
        """The disturbances as the PLC has them now; of one that is not there those that were told last."""
        await self.forces_now()  # before that is answered, what holds is told
        return self._disturbances

    async def preview_errors(self, errors: tuple[ErrorRef, ...], again: bool) -> protocol.PreviewedErrors:
        """What raising these would write now."""
        return await self._instance.preview_errors(errors, again)

    def reaction(self, error: str) -> Reaction | None:
        """How the program reacted to an error the last time it was raised; None where nobody compared."""
        row = next((row for row in self._history.rows if row.id == error), None)
        return None if row is None or row.reaction is None else row.reaction.found

    async def preview(self, sources: protocol.Sources) -> protocol.Previewed:
        """What a swap to these sources would do to the variables."""
        return await self._instance.preview(sources)

    async def build(self, sources: protocol.Sources, author: str) -> protocol.Ack:
        """A new program for the PLC; the old one goes on until the new one is ready."""
        return await self._refusing(self._instance.build(sources, author))

    async def roll_back(self, author: str) -> protocol.Ack:
        """Swaps back in what ran before the last change."""
        return await self._refusing(self._instance.roll_back(author))

    async def copy(self, path: Path, scan: int | None, author: str) -> None:
        """Writes a run file of its own that ends before `scan`, or now; `Refused` or `Unavailable` say why it cannot."""
        ack = await self._instance.copy(path, scan, author)
        if not ack.ok:
            raise Refused(ack.message, ack.near)

    def _logged(self, ack: protocol.Ack, author: str) -> protocol.Ack:
        if ack.ok:
            self._add_line(LogEntry(wall_time(), ack.scan, author, ack.message, "run"))
        return ack

    def told_built(self, author: str, outcome: BuildOutcome) -> None:
        """Tells everybody here what became of a build of their project."""
        self._publish(events.ProgramBuilt(author, outcome))
        if not outcome.ok:
            self._add_line(LogEntry(wall_time(), self.state.scan, author, f"build refused: {outcome.message}", "build"))

    def told(self, author: str, text: str) -> None:
        """A line of the log."""
        self._add_line(LogEntry(wall_time(), self.state.scan, author, text, "run"))

    def tell(self, event: Event) -> None:
        """Something of the project that everybody here is told."""
        self._publish(event)

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

    async def debug(self, make: Callable[[int], DebugRequest]) -> DebugAnswer | protocol.Ack:
        """Asks something of debugging; `make` makes the request with the ref that it is given. Breakpoints are set through
        `debugging`. A refusal is an `Ack` that is not ok, also when the PLC is away."""
        try:
            return await self._instance.debug(make)
        except Unavailable as error:
            return protocol.Ack(0, False, str(error), self.state.scan)

    async def cover(self, on: bool, reset: bool, author: str) -> protocol.Ack:
        """Notes which statements are reached from now on, or no longer."""
        answer = await self.debug(lambda ref: debug_protocol.SetCoverage(ref, on, reset, author))
        assert isinstance(answer, protocol.Ack)
        return answer

    async def coverage(self) -> debug_protocol.Coverage:
        """What was reached so far; `Refused` says why nobody knows."""
        answer = await self.debug(debug_protocol.WantCoverage)
        if isinstance(answer, protocol.Ack):
            raise Refused(answer.message, answer.near)
        assert isinstance(answer, debug_protocol.CoverageIs)
        return answer.coverage

    async def binding(self, path: str) -> Bound:
        """What an in-out is bound to; `Refused` when there is none of this path."""
        answer = await self.debug(lambda ref: debug_protocol.WantBinding(ref, path))
        if isinstance(answer, protocol.Ack):
            raise Refused(answer.message, answer.near)
        assert isinstance(answer, debug_protocol.BindingIs)
        return answer.bound

    # ---- looking --------------------------------------------------------------------------------------------------

    def join(self, subscriber: Subscriber) -> int:
        """Takes a subscriber in; the number to `leave` with."""
        id, self._next_subscriber = self._next_subscriber, self._next_subscriber + 1
        self._subscribers[id] = subscriber
        self._instance.tell(protocol.Attend(True))
        self._publish(events.UsersChanged(self.users))
        return id

    def leave(self, id: int) -> None:
        """The subscriber is gone, and what only it watched is watched no more."""
        if self._subscribers.pop(id, None) is not None:
            self._unwatch(self._watches.drop(id))
            self._instance.tell(protocol.Attend(bool(self._subscribers)))
            self._publish(events.UsersChanged(self.users))

    def watch(self, subscriber: int, ref: int, paths: Sequence[str]) -> None:
        """Watches paths; the answer is a `Watching` event, before any frame with the new ids.

        All subscribers share the ids, each value is in the frames once.
        """
        pairs = self._watches.add(subscriber, paths)
        question, self._next_question = self._next_question, self._next_question + 1
        self._questions[question] = (subscriber, ref, pairs)  # whoever is not there now is asked when it is
        self._instance.tell(protocol.WatchPaths(question, pairs))

    def unwatch(self, subscriber: int, ids: Iterable[int]) -> None:
        """Ends watching for this subscriber."""
        self._unwatch(self._watches.forget(subscriber, ids))

    def want_snapshot(self, subscriber: int) -> None:
        """A frame with all values, for this subscriber alone."""
        self._instance.tell(protocol.WantSnapshot(subscriber))

    async def look_up(self, kind: str, text: str) -> protocol.Found:
        """`members` of a path, what `complete`s a text, or the `instances` of a POU."""
        return await self._instance.look_up(kind, text)

    async def sources_of(self, version: int) -> protocol.Sources:
        """What a version of the program was made of when it ran here; `NotFound` when it never did."""
        found = await self._instance.sources_of(version)
        if found.sources is None:
            raise NotFound(found.message)
        return found.sources

    def _unwatch(self, ids: Sequence[int]) -> None:
        if ids:
            self._instance.tell(protocol.UnwatchIds(tuple(ids)))

    # ---- from the instance ----------------------------------------------------------------------------------------

    def _on_state(self, state: PlcState) -> None:
        before, self._last_state = self._last_state, state
        self._publish(events.StateChanged(state))
        self._see_halt(state)
        if state.pid is not None and not state.past_by and state.state in _LIVING:
            self._see_version(state.version, state.scan)
        if not state.past_by:
            self._reacting.reached(state.scan, state.state)
        if self._past_rows and not state.past_by:
            self._past_rows = []
            self._tell_rows(self._history.rows)
        if state.state != before.state and "silent" in (state.state, before.state):
            text = state.message if state.state == "silent" else "the PLC's process answers again"
            if state.state in ("silent", *_LIVING):
                self._add_line(LogEntry(wall_time(), state.scan, "server", text, "system"))
        if state.state != before.state and state.state in ("restarting", "failed", "off"):
            self._unwatched = True
            if state.state == "off":
                return
            self._add_line(LogEntry(wall_time(), state.scan, "server", state.message, "system"))

    def _see_halt(self, state: PlcState) -> None:
        """A halt that nobody stepped to gets a line of the log, and a mark."""
        halt = state.halt
        if halt is None or halt.number == self._halted:
            return
        self._halted = halt.number
        if halt.reason not in ("step", "goto", "entry") and not halt.past:
            self._add_line(LogEntry(wall_time(), halt.scan, halt.by or "PLC", f"halted: {halt.text}", "halt"))
            self._publish(self._timeline.halted(halt))

    def _on_message(self, message: object) -> None:
        match message:
            case protocol.Frame():
                self._on_frame(message)
            case protocol.Entered():
                self._on_entries(message.entries)
            case protocol.Standing():
                self._on_standing(message)
            case protocol.ForcesAre():
                self._forces = message.forces
                self._publish(events.ForcesChanged(self.forces))
            case protocol.RunMarks():
                self._publish(self._timeline.take(message))
            case protocol.Diagnosed():
                self._on_diagnosed(message.violations)
            case protocol.Ready():
                self._on_ready(message)
            case protocol.NowRuns():
                self._history.take_model(self.model)
                self._publish_rows((), fresh=True)  # the errors that it has more
            case protocol.Watching():
                self._on_watching(message)
            case TracesAre():
                self.tracing.on_message(message)
            case _:
                self.debugging.on_message(message)

    def _on_frame(self, frame: protocol.Frame) -> None:
        if frame.to is None:
            for subscriber in self._subscribers.values():
                subscriber.on_frame(frame.data)
        elif frame.to in self._subscribers:
            self._subscribers[frame.to].on_snapshot(frame.data)

    def _on_entries(self, entries: Sequence[Entry]) -> None:
        """What was entered; a program that raises errors all the time is summed up, not listed."""
        rows: dict[tuple[int, str], ErrorRow] = {}
        version = self._history.version
        for entry in entries:
            changed = self._history.fold(entry)
            rows.update(((row.program_version, row.id), row) for row in changed)
            if entry.plan.cuts:
                self._reacting.ended(entry.scan)
            self._compare(changed, entry.scan)
            command = entry.command
            if isinstance(command, Write | Force):
                forced = isinstance(command, Force)
                for path in filter(None, (command.path, command.through)):
                    self._publish(events.ValueWritten(path, command.author, entry.scan, forced))
        if any(entry.step for entry in entries):
            self._publish(events.WrittenInside(entries[-1].scan))
        self._publish_rows(list(rows.values()), fresh=self._history.version != version)
        self._publish(self._timeline.add(entries))
        for entry in entries[:LISTED]:
            command = entry.command
            self._add_line(LogEntry(entry.at, entry.scan, command.author, entry.plan.message, command.category))
        if len(entries) > LISTED:
            last, more = entries[-1], len(entries) - LISTED
            self._add_line(LogEntry(last.at, last.scan, last.command.author, f"... and {more} more entries", "system"))

    def _compare(self, rows: Sequence[ErrorRow], scan: int | None = None) -> None:
        """Has the reactions found out that are being recorded; of those that began in front of `scan`, if it is given."""
        for row in rows:
            reaction = row.reaction
            if reaction is not None and reaction.state == "recording" and scan in (None, reaction.scan):
                self._reacting.raised(Raised(row.id, reaction.scan, row.program_version))

    def _on_reaction(self, raised: Raised, found: Reaction | str) -> None:
        row = self._history.set_reaction(raised.error, raised.version, raised.scan, found)
        if row is not None:
            self._publish_rows([row])

    def _on_standing(self, standing: protocol.Standing) -> None:
        """What holds now: also after a start, when entries of an earlier life or of a lost one count."""
        if standing.armed != self._armed:
            self._armed = standing.armed
            self._publish(events.ArmedChanged(self._armed))
        if standing.disturbances != self._disturbances:
            self._disturbances = standing.disturbances
            self._publish(events.Disturbances(self._disturbances))
        if self.state.past_by:
            self._past_rows = self._history.as_of(standing.errors, wall_time(), self.state.version)
            self._tell_rows(self._past_rows)
            return
        self._publish_rows(self._history.reconcile(standing.errors, wall_time()))

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
        if ready.fresh:
            self._reacting.forget()
            if self._forces:  # those of the run before
                self._forces = ()
                self._publish(events.ForcesChanged(()))
        self._history.take_model(self.model)
        if ready.sources.version != self._history.version:
            self._history.begin(ready.sources.version)
            self._publish_rows((), fresh=True)
        if ready.message:
            self._add_line(LogEntry(wall_time(), self.state.scan, "server", ready.message, "system"))
        self._instance.tell(protocol.Attend(bool(self._subscribers)))
        if self._unwatched:
            self._unwatched = False
            self._instance.tell(protocol.WatchPaths(_EVERYBODY, self._watches.all()))
        for question, (_, _, pairs) in self._questions.items():
            self._instance.tell(protocol.WatchPaths(question, pairs))
        self._resending = asyncio.get_running_loop().create_task(self._resend())

    async def _resend(self) -> None:
        await self.debugging.resend()
        await self.tracing.resend()

    def _on_watching(self, answer: protocol.Watching) -> None:
        if answer.ref is None or answer.ref == _EVERYBODY:
            self._publish(events.Watching(None, answer.items))
            return
        subscriber, ref, _ = self._questions.pop(answer.ref, (0, 0, ()))
        self._unwatch(self._watches.forget(subscriber, [item.id for item in answer.items if not item.sent]))
        if subscriber in self._subscribers:
            self._subscribers[subscriber].on_event(events.Watching(ref, answer.items))

    # ---- history and log ------------------------------------------------------------------------------------------

    def _see_version(self, version: int, scan: int) -> None:
        """A run that goes on from its past may be back at a version that ran before, without an entry that says so."""
        if version != self._history.version:
            self._publish_rows(self._history.turn_to(version, wall_time(), scan), fresh=True)

    def _publish_rows(self, rows: Sequence[ErrorRow], fresh: bool = False) -> None:
        """Keeps and tells what changed; `fresh`: another version runs, whose rows are all others."""
        self._write_behind.keep_rows(self.id, rows)
        now = self._history.rows if fresh else [row for row in rows if row.program_version == self._history.version]
        if now and not self._past_rows:
            self._tell_rows(now)

    def _tell_rows(self, rows: Sequence[ErrorRow]) -> None:
        self._publish(events.ErrorsChanged(tuple(map(self._history.with_sweep, rows))))

    def _add_line(self, line: LogEntry) -> None:
        self._lines.append(line)
        del self._lines[:-LOG_LINES]
        self._write_behind.keep_line(self.id, line, self._history.version)
        self._publish(events.Logged((line,)))

    def listen(self, listener: Callable[[Event], None]) -> None:
        """Has somebody of the server's own told what happens; people are subscribers."""
        self._listeners.append(listener)

    def ignore(self, listener: Callable[[Event], None]) -> None:
        """The end of that."""
        if listener in self._listeners:
            self._listeners.remove(listener)

    def _publish(self, event: Event) -> None:
        for listener in list(self._listeners):
            listener(event)
        for subscriber in list(self._subscribers.values()):
            subscriber.on_event(event)
