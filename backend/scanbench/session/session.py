"""One PLC and the people at it: commands in, events out, history and log kept."""

import asyncio
from collections.abc import Awaitable, Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TypeVar

from scanbench.faults.history import ErrorRow, History
from scanbench.faults.network import NetworkRequest
from scanbench.host.load import Load, Loads
from scanbench.jobs.client import SharedJob
from scanbench.plcmodel.model import Model
from scanbench.plcmodel.user_errors import model_for
from scanbench.runtime.command import Command, Entry
from scanbench.runtime.forces import Force
from scanbench.runtime.write import Write
from scanbench.runtime.write_variables import WriteVariables
from scanbench.session.debugging import Debugging
from scanbench.session.device import Device
from scanbench.session.errors import Errors
from scanbench.session.forces import Forces
from scanbench.session.instance import Instance, Remembered
from scanbench.session.keeper import Keeper
from scanbench.session.log import Log
from scanbench.session.reacting import Reacting
from scanbench.session.tracing import Tracing
from scanbench.session.watching import Watching
from scanbench.store.records import InstanceRow, Json
from scanbench.wire import events
from scanbench.wire import host as protocol
from scanbench.wire.debugging import DebugRequest
from scanbench.wire.events import BuildOutcome, Event, LogEntry, Subscriber, User
from scanbench.wire.host import PlcState
from scanbench.wire.refused import Refused, Unavailable

A = TypeVar("A")
SPEEDS = 0.01, 1000.0


class Session:
    """Everything that one instance is to the rest of the server."""

    def __init__(
        self, row: InstanceRow, model: Model, memory: Remembered, keeper: Keeper,
        rows: Sequence[ErrorRow], lines: Sequence[LogEntry], loads: Loads, reactions: SharedJob,
        breakpoints: Sequence[Json], cache: Path | None = None, traces: Mapping[int, Json] | None = None,
        why_not: str = "",
    ) -> None:  # fmt: skip
        """`model` is the device; the project's own errors come with the program that runs. `why_not`: why this never runs."""
        self.row, self._device = row, model
        self._loads = loads
        self._subscribers: dict[int, Subscriber] = {}
        self._next_subscriber = 1
        self.tools: tuple[User, ...] = ()
        """The clients of protocols that are connected; whoever changes it tells so."""
        self._listeners: list[Callable[[Event], None]] = []
        self.instance = Instance(memory, self._on_state, self._on_message, cache, why_not=why_not)
        self._last_state = self.instance.state
        self.errors = Errors(
            History(model_for(model, memory.sources.files), memory.sources.version, rows),
            partial(Reacting, reactions, lambda: self.instance.run_file),
            self.tell, partial(keeper.keep_rows, row.id), lambda: self.state,
        )  # fmt: skip
        if not why_not:
            self.errors.compare(rows)  # the run goes on, so what was being recorded is found out yet
        self.log = Log(
            lines, self.tell, lambda line: keeper.keep_line(row.id, line, self.errors.version), lambda: self.state
        )
        self.forces = Forces(self.instance, self.tell)
        self.device = Device(self.instance, self.tell)
        self.watching = Watching(self.instance.tell, self.tell, self._subscribers)
        self.debugging = Debugging(self.debug, self.tell, partial(keeper.keep_breakpoints, row.id), breakpoints)
        self.tracing = Tracing(self.instance.ask, self.tell, partial(keeper.keep_traces, row.id), traces or {})
        self._resending: asyncio.Task[None] | None = None
        self.on_network: Callable[[NetworkRequest, int], None] | None = None
        """Is told what the program asks of other PLCs, and in which scan."""

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
        return model_for(self._device, self.instance.sources.files)

    @property
    def state(self) -> PlcState:
        """The PLC's state."""
        return self.instance.state

    @property
    def users(self) -> tuple[User, ...]:
        """Who is here, everybody once: people, then the clients of protocols."""
        return tuple(dict.fromkeys(each.user for each in self._subscribers.values())) + self.tools

    # ---- life -----------------------------------------------------------------------------------------------------

    async def stop(self) -> None:
        """Ends the PLC's process; its run is kept."""
        await self.instance.stop()
        await self.errors.close()

    async def change(self, row: InstanceRow, author: str) -> None:
        """Takes over a new name, new limits, and whether it is on."""
        before, self.row = self.row, row
        if row.limits != before.limits:
            self.instance.limit(row.limits)
        if await self.instance.switch(row.powered):
            self.log.add(author, "switched on" if row.powered else "switched off")

    # ---- commands -------------------------------------------------------------------------------------------------

    async def submit(self, command: Command) -> protocol.Ack:
        """The one door: enters a command in the seam of the PLC."""
        return await self._refusing(self.instance.submit(command))

    async def drive(
        self, action: str, speed: float | None, author: str, scans: int | None = None, until: str | None = None
    ) -> protocol.Ack:
        """Pace of the run: continue (so many scans, until a condition holds), pause, one scan."""
        low, high = SPEEDS
        if speed is not None and speed != 0 and not low <= speed <= high:
            message = f"speed {speed:g} is outside of x{low:g} to x{high:g}; 0 is without limit"
            return protocol.Ack(0, False, message, self.state.scan)
        return await self._refusing(
            self.instance.ask(lambda ref: protocol.Drive(ref, action, speed, author, scans, until), protocol.Ack),
            author,
        )

    async def travel(self, scan: int | None, author: str, count: int = 0) -> protocol.Ack:
        """Shows the past to everybody, before a statement of the scan if there is a count; or live again."""
        return await self._refusing(
            self.instance.ask(lambda ref: protocol.Travel(ref, scan, author, count), protocol.Ack, takes_long=True)
        )

    async def new_run(self, author: str, sources: protocol.Sources | None = None) -> protocol.Ack:
        """Begins a new run at scan 0, with other sources if there are any; the old run file is kept aside."""
        return await self._refusing(self.instance.new_run(sources), author)

    async def build(self, sources: protocol.Sources, author: str) -> protocol.Ack:
        """A new program for the PLC; the old one goes on until the new one is ready."""
        return await self._refusing(self.instance.build(sources, author))

    async def roll_back(self, author: str) -> protocol.Ack:
        """Swaps back in what ran before the last change."""
        return await self._refusing(
            self.instance.ask(lambda ref: protocol.RollBack(ref, author), protocol.Ack, takes_long=True)
        )

    async def copy(self, path: Path, scan: int | None, author: str) -> None:
        """Writes a run file of its own that ends before `scan`, or now; `Refused` or `Unavailable` say why it cannot."""
        ack = await self.instance.ask(
            lambda ref: protocol.Copy(ref, str(path), scan, author), protocol.Ack, takes_long=True
        )
        if not ack.ok:
            raise Refused(ack.message, ack.near)

    def told_built(self, author: str, outcome: BuildOutcome) -> None:
        """Tells everybody here what became of a build of their project."""
        self.tell(events.ProgramBuilt(author, outcome))
        if not outcome.ok:
            self.log.add(author, f"build refused: {outcome.message}", "build")

    async def _refusing(self, answer: Awaitable[protocol.Ack], author: str = "") -> protocol.Ack:
        """The answer, which is a refusal where the PLC is away; a line of the log where it was done and has an author."""
        try:
            ack = await answer
        except Unavailable as error:
            return protocol.Ack(0, False, str(error), self.state.scan)
        if ack.ok and author:
            self.log.add(author, ack.message, scan=ack.scan)
        return ack

    async def debug(self, make: Callable[[int], DebugRequest], answer: type[A]) -> A:
        """Asks something of debugging; `make` makes the request with the ref that it is given. Breakpoints are set through
        `debugging`. `Refused`, also when the PLC is away."""
        try:
            return await self.instance.ask(make, answer, takes_long=True)
        except Unavailable as error:
            raise Refused(str(error)) from error

    # ---- looking --------------------------------------------------------------------------------------------------

    def join(self, subscriber: Subscriber) -> int:
        """Takes a subscriber in; the number to `leave` with."""
        id, self._next_subscriber = self._next_subscriber, self._next_subscriber + 1
        self._subscribers[id] = subscriber
        self.instance.tell(protocol.Attend(True))
        self.tell(events.UsersChanged(self.users))
        return id

    def leave(self, id: int) -> None:
        """The subscriber is gone, and what only it watched is watched no more."""
        if self._subscribers.pop(id, None) is not None:
            self.watching.drop(id)
            self.instance.tell(protocol.Attend(bool(self._subscribers)))
            self.tell(events.UsersChanged(self.users))

    # ---- from the instance ----------------------------------------------------------------------------------------

    def _on_state(self, state: PlcState) -> None:
        before, self._last_state = self._last_state, state
        self.tell(events.StateChanged(state))
        self.log.on_halt(state)
        self.errors.on_state(state)
        if state.state != before.state and state.state in ("restarting", "failed", "off"):
            self.watching.on_gone()
        self.log.on_state(before.state, state)

    def _on_message(self, message: object) -> None:
        match message:
            case protocol.Entered():
                self._on_entries(message.entries)
            case protocol.Ready():
                self._on_ready(message)
            case protocol.NowRuns():
                self.errors.on_model(self.model)
            case _:
                rooms = (self.watching, self.errors, self.forces, self.device, self.log, self.tracing, self.debugging)
                any(room.on_message(message) for room in rooms)

    def _on_entries(self, entries: Sequence[Entry]) -> None:
        for entry in entries:
            command = entry.command
            if isinstance(command, Write | Force):
                forced = isinstance(command, Force)
                for path in filter(None, (command.path, command.through)):
                    self.tell(events.ValueWritten(path, command.author, entry.scan, forced))
            elif isinstance(command, NetworkRequest) and self.on_network is not None:
                self.on_network(command, entry.scan)
            elif isinstance(command, WriteVariables):
                for write in command.writes:
                    self.tell(events.ValueWritten(write.path, command.author, entry.scan, False))
        if any(entry.step for entry in entries):
            self.tell(events.WrittenInside(entries[-1].scan))
        self.forces.on_entries(entries)
        self.errors.on_entries(entries)
        self.log.on_entries(entries)

    def _on_ready(self, ready: protocol.Ready) -> None:
        if ready.fresh:
            self.errors.on_new_run()
            self.forces.on_new_run()
        self.errors.on_program(self.model, ready.sources.version)
        if ready.message:
            self.log.add("server", ready.message, "system")
        self.instance.tell(protocol.Attend(bool(self._subscribers)))
        self.watching.on_ready()
        self._resending = asyncio.get_running_loop().create_task(self._resend())

    async def _resend(self) -> None:
        await self.debugging.resend()
        await self.tracing.resend()

    # ---- telling --------------------------------------------------------------------------------------------------

    def listen(self, listener: Callable[[Event], None]) -> None:
        """Has somebody of the server's own told what happens; people are subscribers."""
        self._listeners.append(listener)

    def ignore(self, listener: Callable[[Event], None]) -> None:
        """The end of that."""
        if listener in self._listeners:
            self._listeners.remove(listener)

    def tell(self, event: Event) -> None:
        """Tells everybody here."""
        for listener in list(self._listeners):
            listener(event)
        for subscriber in list(self._subscribers.values()):
            subscriber.on_event(event)
