"""The virtual PLC: engine, image, seam and journal in one. No threads: whoever owns it says when to run."""

import errno
from dataclasses import dataclass
from operator import is_

from scanbench.check.condition import Condition
from scanbench.check.program import Program
from scanbench.engines.engine import Engine, Pace, Reason, Stop
from scanbench.engines.observe import Observer
from scanbench.runtime import seam
from scanbench.runtime.agenda import NONE_MET, NOTHING, Agenda, Met, Waits
from scanbench.runtime.clock import monotonic_ns, wall_time
from scanbench.runtime.command import Command, Entry, Refusal, View
from scanbench.runtime.detect import Detect, read_asked
from scanbench.runtime.header import Header, Mode, fresh_image, pass_time
from scanbench.runtime.journal import Journal
from scanbench.runtime.programs import Loaded, Programs, Shelf
from scanbench.runtime.recorder import Recorder
from scanbench.runtime.trap import TRAPPED, TrapInfo, Trapped, trap_info


@dataclass(slots=True)
class Measured:
    """What running cost in wall time: shown, and never seen by the program."""

    scans: int = 0
    busy_ns: int = 0

    @property
    def cycle_us(self) -> float:
        """Mean duration of a scan."""
        return self.busy_ns / self.scans / 1000 if self.scans else 0.0


class Resource:
    """One PLC with one program."""

    def __init__(
        self, loaded: Loaded, mode: Mode = Mode.MONITOR, state: bytes | None = None, *,
        programs: Programs | None = None, detect: Detect | None = None, recorder: Recorder | None = None,
        agenda: Agenda | None = None,
    ) -> None:  # fmt: skip
        """A new run in `mode`, or from `state`, the first `Layout.state_size` bytes of an image of this program."""
        self.loaded = loaded
        self.programs = programs if programs is not None else Shelf(loaded)
        self.recorder = recorder
        self.journal = Journal()
        self.measured = Measured()
        self.detect = detect
        self.agenda = agenda
        self.until: Condition | None = None
        """A live run comes back after each scan after which it holds. Made for the program that is live."""
        self._stops = Stops()
        self._observed: _Observed | None = None
        loaded.memory[:] = fresh_image(loaded.program, mode)
        if state is not None:
            loaded.memory[: len(state)] = state
        self.header = Header(loaded.memory)

    @property
    def program(self) -> Program:
        """The program that runs."""
        return self.loaded.program

    @property
    def version(self) -> int:
        """The version of the program that runs."""
        return self.loaded.version

    @property
    def memory(self) -> bytearray:
        """The image. A change of the program brings another one."""
        return self.loaded.memory

    @property
    def engine(self) -> Engine:
        """What runs the program."""
        observed = self._observed
        return self.loaded.engine if observed is None else observed.engine

    @engine.setter
    def engine(self, engine: Engine) -> None:
        """Other code of the same program, on the same memory."""
        self.loaded.engine = engine

    @property
    def observing(self) -> bool:
        """Whether observed code runs, as statements are waited for."""
        return self._observed is not None

    @property
    def view(self) -> View:
        """What planners may read."""
        return View(self.program, self.memory, self.journal, self.programs, self.version, self.loaded.fresh)

    @property
    def runnable(self) -> bool:
        """Whether the mode and the errors let the program run."""
        return self.header.runnable

    @property
    def trap(self) -> TrapInfo | None:
        """The trap that keeps the program stopped, if one does."""
        return self.journal.derived(TRAPPED) if self.header.halted_by_trap else None

    @property
    def state(self) -> bytes:
        """A copy of what is compared, hashed and recorded."""
        return bytes(memoryview(self.memory)[: self.program.layout.state_size])

    # ---- live -----------------------------------------------------------------------------------------------------

    def submit(self, command: Command) -> Entry | Refusal:
        """Enters a command in the seam, now: planned, kept, then applied. What cannot be kept is refused."""
        outcome = self._enter(command, must=False)
        if not isinstance(outcome, Refusal):
            self._attend(NONE_MET)
        return outcome

    def run(self, scans: int, pace: Pace | None = None) -> Stop:
        """Runs up to `scans` scans. Comes back early for a trap, which stops the program, for what it asked for, and for
        what is due; reason CONDITION says that `until` holds."""
        ran = self.runnable
        self._attend(NONE_MET)  # nothing, unless this run was gone on with behind what was due
        if ran and not self.runnable:
            return Stop(Reason.KNOCKED)
        waits, first = self._waits(), self.header.scan
        if waits.scan is not None:
            scans = min(scans, waits.scan - first)
        self._observe(waits)
        self._stops.set(self.engine, self._conditions(waits))
        stop = self._run(self.engine, min(scans, 1) if waits.sites else scans, pace)
        met = self._met(stop, waits)
        if stop.reason is Reason.CONDITION and (self.until is None or not self.engine.holds(self.until)):
            stop = Stop(Reason.KNOCKED)
        if stop.reason is Reason.TRAP:
            self._trapped(stop.trap)
        elif self.header.scan > first:
            self._answer()
        self._attend(met)
        return stop

    def idle(self, scans: int) -> None:
        """Up to `scans` scans pass while the program is stopped: no further than to what is due."""
        self._attend(NONE_MET)
        due = self._waits().scan
        self.pass_time(scans if due is None else min(scans, due - self.header.scan))
        self._attend(NONE_MET)

    def settle(self) -> None:
        """Behind a recovery: answers what the last scan asked for, and does what is due, unless all that was entered
        before all ended."""
        last = self.journal[-1].scan if self.journal else -1
        met = NONE_MET
        if last < self.header.scan:
            met = Met(self._held(self._waits()))
            self._answer()
        self._attend(met)

    # ---- replay ---------------------------------------------------------------------------------------------------

    def rerun(self, scans: int, pace: Pace | None = None) -> Stop:
        """Runs up to `scans` scans, and enters nothing: what was noticed then is in the journal."""
        self._stops.set(self.loaded.engine, ())
        return self._run(self.loaded.engine, scans, pace)

    def pass_time(self, scans: int) -> None:
        """Virtual time goes on while the program is stopped."""
        if scans > 0:
            pass_time(self.memory, scans, self.program.interval_ns)

    def reenter(self, entry: Entry) -> None:
        """Replay of an entry: its plan, not its command, so that the planner need not be the same any more."""
        self._apply(entry)

    def restore(self, loaded: Loaded, state: bytes, journal: Journal) -> None:
        """The PLC as it was: the program, its image, and the journal that led to it."""
        if loaded is not self.loaded:
            self._load(loaded)
        self.memory[: len(state)] = state
        self.journal = journal

    # ---- what is waited for ---------------------------------------------------------------------------------------

    def _run(self, engine: Engine, scans: int, pace: Pace | None) -> Stop:
        if not self.runnable:
            raise RuntimeError("the program is stopped: it must not be run")
        first, start = self.header.scan, monotonic_ns()
        busy = pace.busy_ns if pace is not None else 0
        stop = engine.run(scans, pace)
        self.measured.scans += self.header.scan - first
        self.measured.busy_ns += pace.busy_ns - busy if pace is not None else monotonic_ns() - start
        return stop

    def _waits(self) -> Waits:
        return NOTHING if self.agenda is None else self.agenda.waits(self.view)

    def _conditions(self, waits: Waits) -> tuple[Condition, ...]:
        return waits.conditions if self.until is None else (self.until, *waits.conditions)

    def _observe(self, waits: Waits) -> None:
        """Observed code runs while statements are waited for, and no longer."""
        if not waits.sites or self.agenda is None:
            self._observed = None
        elif self._observed is None or self._observed.loaded is not self.loaded:
            self._observed = _Observed(self.loaded, *self.agenda.observed(self.loaded))

    def _met(self, stop: Stop, waits: Waits) -> Met:
        """What came true in the scan that just ended."""
        held = self._held(waits) if stop.reason is Reason.CONDITION else NONE_MET.conditions
        sites = NONE_MET.sites if self._observed is None else self._observed.observer.take().reached & waits.sites
        return Met(held, sites)

    def _held(self, waits: Waits) -> frozenset[str]:
        return frozenset(each.text for each in waits.conditions if self.engine.holds(each))

    def _attend(self, met: Met) -> None:
        """Enters what is due in this seam. It has happened in any case, so it is never refused for want of room."""
        if self.agenda is None:
            return
        while (command := self.agenda.due(self.view, met)) is not None:
            outcome = self._enter(command, must=True)
            if isinstance(outcome, Refusal):
                self._enter(self.agenda.refused(command, outcome), must=True)

    # ---- the seam -------------------------------------------------------------------------------------------------

    def _enter(self, command: Command, must: bool) -> Entry | Refusal:
        command = command.settled(self.view)
        plan = command.plan(self.view)
        if isinstance(plan, Refusal):
            return plan
        entry = Entry(self.header.scan, wall_time(), command, plan)
        if self.recorder is not None:
            try:
                self.recorder.entry(entry, must)
            except OSError as error:
                return _not_kept(error)
        self._apply(entry)
        return entry

    def _apply(self, entry: Entry) -> None:
        loaded = seam.apply(self.loaded, self.programs, entry.plan)
        if loaded is not self.loaded:
            self._load(loaded)
        self.journal.append(entry)

    def _load(self, loaded: Loaded) -> None:
        self.loaded = loaded
        self.header = Header(loaded.memory)
        self.measured = Measured()

    def _trapped(self, trap: int) -> None:
        info = trap_info(self.program, trap, self.header.scan)
        self._enter(Trapped("PLC", info), must=True)
        self._answer()
        command = self.detect.on_trap(info, self.view) if self.detect is not None else None
        if command is not None:
            self._enter(command, must=True)

    def _answer(self) -> None:
        asked = read_asked(self.memory)
        if asked and self.detect is not None:
            for command in self.detect.on_asked(asked, self.view):
                self._enter(command, must=True)


@dataclass(frozen=True, slots=True)
class _Observed:
    """Observed code of the program that runs."""

    loaded: Loaded
    engine: Engine
    observer: Observer


class Stops:
    """Which engine was given which conditions last: giving them costs something, so it is done only when they change."""

    def __init__(self) -> None:
        self._engine: Engine | None = None
        self._conditions: tuple[Condition, ...] = ()

    def set(self, engine: Engine, conditions: tuple[Condition, ...]) -> None:
        """This engine is to have these from now on, and no other has any."""
        if self._engine is not None and self._engine is not engine and self._conditions:
            self._engine.stop_when(None)
            self._conditions = ()
        same = len(conditions) == len(self._conditions) and all(map(is_, conditions, self._conditions))
        self._engine = engine
        if not same:
            self._conditions = conditions
            engine.stop_when(None, *conditions)


def _not_kept(error: OSError) -> Refusal:
    if error.errno in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG):
        return Refusal(
            "the disk is full, so the run cannot be recorded, and nothing was changed: make room, then try again"
        )
    return Refusal(f"the run cannot be recorded ({error}), so nothing was changed")
