"""The virtual PLC: engine, image, seam and journal in one. No threads: whoever owns it says when to run."""

import errno
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from operator import is_

from scanbench.check.typed.condition import Condition
from scanbench.engines.debug import NOTHING as NOT_LISTENING
from scanbench.engines.debug import Listen
from scanbench.engines.engine import Engine, Pace, Reason, Stop
from scanbench.engines.observe import Observer, Seen
from scanbench.engines.sample import Sampling
from scanbench.program.program import Program
from scanbench.runtime import seam
from scanbench.runtime.agenda import NONE_MET, NOTHING, Agenda, Met, Waits
from scanbench.runtime.clock import monotonic_ns, wall_time
from scanbench.runtime.command import Command, Entry, Plan, Refusal, View
from scanbench.runtime.detect import Detect, read_asked
from scanbench.runtime.header import Header, Mode, fresh_image, pass_time
from scanbench.runtime.inside import Diverged, Inside, Insider, Onlooker, Passage, front, needs_seam
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
        self.samplings: tuple[Sampling, ...] = ()
        """What is sampled, but not while a program runs that they were not made for. A scan of the past that is run again
        has its rows already, so it gets none."""
        self._sampled: tuple[Engine | None, tuple[Sampling, ...]] = None, ()
        self._stops = Stops()
        self._observed: _Observed | None = None
        self._passage: Passage | None = None
        self._listen = NOT_LISTENING
        self._reached: set[int] = set()
        self.proved = 1 << 64
        """A replay is believed to go so far, and `BETWEEN` scans further: a run file has a state of this scan."""
        self.inside: Inside | None = None
        """Where the scan is halted that is next; the image stands there."""
        self._finishing = False
        self.lenient = False
        """The run need not go as it did when it was recorded: what was entered inside of a scan that does not get so far now
        is entered behind it."""
        self.hook: Onlooker | None = None
        """Who listens to the debug flavour: while somebody does, it runs."""
        self.on_seen: Callable[[Seen], None] | None = None
        """Who is told what observed code or the debug flavour notes."""
        self.probed: Engine | None = None
        """Code with probes (`engines.probe`), which runs the live program instead of the ordinary one while nobody listens."""
        self.on_probe: Callable[[], None] | None = None
        """Called when a probe was reached: whoever it is goes back to where the scan began."""
        self.on_trap: Callable[[], bool] | None = None
        """Asked before a trap stops the program: true says that the scan was gone back to and is halted now."""
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
        if self.hook is not None:
            return self.loaded.debugged()
        observed = self._observed
        if self.probed is not None and observed is None and not self._finishing:
            return self.probed
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
    def begun(self) -> bool:
        """Whether the scan that is next has been run in part: it is halted, or was when the PLC was ended."""
        return self.inside is not None or bool(self._waiting())

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
        """Enters a command, now: planned, kept, then applied. What cannot be kept is refused.

        In a scan that is halted it is entered where that stands; what needs the seam lets it run to its end first.
        """
        if self.begun:
            plan = command.settled(self.view).plan(self.view)
            if isinstance(plan, Refusal):
                return plan
            if self.inside is not None and not needs_seam(plan):
                return self._enter(command, must=False, step=self.inside.count)
            self.finish()
        outcome = self._enter(command, must=False)
        if not isinstance(outcome, Refusal):
            self._attend(NONE_MET)
        return outcome

    def run(self, scans: int, pace: Pace | None = None) -> Stop:
        """Runs up to `scans` scans. Comes back early for a trap, which stops the program, for what it asked for, and for
        what is due; reason CONDITION says that `until` holds. With a `hook` it may be halted inside of a scan; then the
        next run goes on with that scan, from its beginning."""
        ran = self.runnable
        self._attend(NONE_MET)  # nothing, unless this run was gone on with behind what was due
        if ran and not self.runnable:
            return Stop(Reason.KNOCKED)
        waits, first = self._waits(), self.header.scan
        if waits.scan is not None:
            scans = min(scans, waits.scan - first)
        self._observe(waits)
        insider = waits.inside
        if insider is not None and self._probes():
            return Stop(Reason.KNOCKED)
        alone = bool(waits.sites) or insider is not None
        stop = self._run(self.engine, min(scans, 1) if alone else scans, pace, self._conditions(waits), insider)
        if stop.reason is Reason.HALTED:
            if self.inside is None and self.on_probe is not None:
                self.on_probe()
                return Stop(Reason.KNOCKED)
            return stop
        if stop.reason is Reason.TRAP and self.on_trap is not None and not self._finishing and self.on_trap():
            return Stop(Reason.HALTED)
        met = self._met(stop, waits)
        if stop.reason is Reason.CONDITION and (self.until is None or not self.engine.holds(self.until)):
            stop = Stop(Reason.KNOCKED)
        if stop.reason is Reason.TRAP:
            self._trapped(stop.trap)
        elif self.header.scan > first:
            self._answer()
        self._attend(met)
        return stop

    def knock(self) -> None:
        """Asks, from any thread, for the run to come back after the current scan."""
        self.engine.knock()

    def finish(self) -> None:
        """Runs the scan to its end that is halted, whoever wants to halt it again. A trap ends it, too."""
        scan = self.header.scan
        self._finishing = self.begun
        try:
            while self._finishing and self.runnable and self.header.scan == scan:
                if self.run(1).reason is Reason.TRAP:
                    break
        finally:
            self._finishing = False

    def enter_here(self, command: Command, plan: Plan, count: int) -> Entry | Refusal:
        """For the hook: enters a command, whose plan it has, in front of the statement of this count, which is to begin."""
        return self._keep(command, plan, must=False, step=count)

    def _probes(self) -> bool:
        """Whether a scan that is to run in the debug flavour would miss its probes: whoever wants them listens from now on."""
        if self.probed is None or self.hook is not None or self.on_probe is None or self._finishing:
            return False
        self.on_probe()
        return True

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
        return self._run(self.loaded.engine if self.hook is None else self.engine, scans, pace, ())

    def pass_time(self, scans: int) -> None:
        """Virtual time goes on while the program is stopped."""
        if scans > 0:
            pass_time(self.memory, scans, self.program.interval_ns)

    def reenter(self, entry: Entry) -> None:
        """Replay of an entry: its plan, not its command, so that the planner need not be the same any more."""
        self._apply(entry)

    def await_step(self, entry: Entry) -> None:
        """Replay of an entry that was made inside of the scan that is next: it is entered there when that runs."""
        if self.journal and self.journal[-1].scan == entry.scan and self.journal[-1].step > entry.step:
            raise Diverged(f"scan {entry.scan} has entries inside that are in no order")
        self.journal.append(entry)

    def restore(self, loaded: Loaded, state: bytes, journal: Journal, inside: Inside | None = None) -> None:
        """The PLC as it was: the program, its image, and the journal that led to it; the whole image inside of a scan."""
        if loaded is not self.loaded:
            self._load(loaded)
        self.memory[: len(state)] = state
        self.journal = journal
        self.inside = inside

    def leave(self) -> None:
        """Where the scan began that is halted, without what was entered inside of it: for what is shown of the past."""
        if self.inside is not None:
            self.memory[:] = self.inside.begin
            self.inside = None
        self.journal = self.journal.prefix(front(self.journal, self.header.scan))

    # ---- the debug flavour ----------------------------------------------------------------------------------------

    def listen(self, listen: Listen) -> None:
        """What the hook is called for, from now on: also from the hook."""
        self._listen = listen
        if self._passage is not None:
            self._passage.listen(listen)

    @property
    def listening(self) -> Listen:
        """What `listen` was given last."""
        return self._listen

    def look(self) -> None:
        """Takes what was noted, and tells `on_seen`."""
        observer = self._observer()
        if observer is not None:
            seen = observer.take()
            self._reached |= seen.reached
            if self.on_seen is not None:
                self.on_seen(seen)

    def _observer(self) -> Observer | None:
        if self.hook is not None:
            return self.loaded.debugged().observer
        return None if self._observed is None else self._observed.observer

    def _waiting(self) -> list[Entry]:
        """What was entered inside of the scan that is next."""
        return self.journal[front(self.journal, self.header.scan) :]

    def _passing(self) -> Passage:
        engine = self.loaded.debugged()
        if self._passage is None or self._passage.engine is not engine:
            self._passage = Passage(engine)
        return self._passage

    # ---- what is waited for ---------------------------------------------------------------------------------------

    def _run(
        self, engine: Engine, scans: int, pace: Pace | None, conditions: tuple[Condition, ...],
        insider: Insider | None = None,
    ) -> Stop:  # fmt: skip
        if self.inside is not None:
            self.memory[:] = self.inside.begin
            self.inside = None
        if not self.runnable:
            raise RuntimeError("the program is stopped: it must not be run")
        waiting = self._waiting()
        if waiting or insider is not None:
            engine, scans = self.loaded.debugged(), min(scans, 1)
        self._stops.set(engine, conditions)
        self._sample(engine, tuple(each for each in self.samplings if each.program is self.program))
        first, start = self.header.scan, monotonic_ns()
        busy = pace.busy_ns if pace is not None else 0
        if waiting or self.hook is not None or insider is not None:
            stop = self._pass(scans, pace, waiting, insider)
        else:
            stop = engine.run(scans, pace)
        self.measured.scans += self.header.scan - first
        self.measured.busy_ns += pace.busy_ns - busy if pace is not None else monotonic_ns() - start
        return stop

    def _pass(self, scans: int, pace: Pace | None, waiting: list[Entry], insider: Insider | None) -> Stop:
        """Runs the debug flavour."""
        passage, scan = self._passing(), self.header.scan
        enter = partial(self._enter_inside, scan)
        passage.begin(self.hook, not self._finishing, self._listen, waiting, self._again, insider, enter)
        trapped = whole = False
        try:
            stop = passage.engine.run(scans, pace)
            trapped, whole = stop.reason is Reason.TRAP, self.header.scan > scan
        finally:
            passage.end(trapped or whole, whole, self.lenient)
        if insider is not None and self.hook is None:
            self._reached |= passage.engine.observer.take().reached
        if stop.reason is Reason.HALTED:
            engine = passage.engine
            self.inside = Inside(engine.begin, engine.count, engine.frames())
        return stop

    def _enter_inside(self, scan: int, command: Command, count: int) -> None:
        """What an insider enters. If it is refused, the agenda finds that it was not entered."""
        plan = command.plan(self.view)
        if isinstance(plan, Plan):
            self._keep(command, plan, must=True, step=count, scan=scan)

    def _again(self, entry: Entry) -> None:
        seam.apply(self.loaded, self.programs, entry.plan)

    def _waits(self) -> Waits:
        return NOTHING if self.agenda is None else self.agenda.waits(self.view)

    def _conditions(self, waits: Waits) -> tuple[Condition, ...]:
        return waits.conditions if self.until is None else (self.until, *waits.conditions)

    def _observe(self, waits: Waits) -> None:
        """Observed code runs while statements are waited for, and no longer."""
        if not waits.sites or self.agenda is None or self.hook is not None:
            self._observed = None
        elif self._observed is None or self._observed.loaded is not self.loaded:
            self._observed = _Observed(self.loaded, *self.agenda.observed(self.loaded))

    def _sample(self, engine: Engine, samplings: tuple[Sampling, ...]) -> None:
        """This engine samples, and no other does; told only when that changes, as it costs something."""
        before, given = self._sampled
        if before is not None and before is not engine and given:
            before.sample()
        if given != samplings or (samplings and before is not engine):
            engine.sample(*samplings)
        self._sampled = engine, samplings

    def _met(self, stop: Stop, waits: Waits) -> Met:
        """What came true in the scan that just ended."""
        held = self._held(waits) if stop.reason is Reason.CONDITION else NONE_MET.conditions
        if waits.sites:
            self.look()
        sites, self._reached = waits.sites & self._reached, set()
        return Met(held, sites)

    def _held(self, waits: Waits) -> frozenset[str]:
        return frozenset(each.text for each in waits.conditions if self.engine.holds(each))

    def _attend(self, met: Met) -> None:
        """Enters what is due in this seam. It has happened in any case, so it is never refused for want of room."""
        if self.agenda is None or self.begun:
            return
        while (command := self.agenda.due(self.view, met)) is not None:
            outcome = self._enter(command, must=True)
            if isinstance(outcome, Refusal):
                self._enter(self.agenda.refused(command, outcome), must=True)

    # ---- the seam -------------------------------------------------------------------------------------------------

    def _enter(self, command: Command, must: bool, step: int = 0) -> Entry | Refusal:
        command = command.settled(self.view)
        plan = command.plan(self.view)
        if isinstance(plan, Refusal):
            return plan
        return self._keep(command, plan, must, step)

    def _keep(self, command: Command, plan: Plan, must: bool, step: int, scan: int | None = None) -> Entry | Refusal:
        entry = Entry(self.header.scan if scan is None else scan, wall_time(), command, plan, step)
        if self.recorder is not None:
            try:
                self.recorder.entry(entry, must)
            except OSError as error:
                return not_kept(error)
        self._apply(entry)
        return entry

    def _apply(self, entry: Entry) -> None:
        loaded = seam.apply(self.loaded, self.programs, entry.plan)
        if loaded is not self.loaded:
            self._load(loaded)
        self.journal.append(entry)

    def _load(self, loaded: Loaded) -> None:
        self.loaded, self.inside, self.probed, self._passage = loaded, None, None, None
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


def is_no_space(error: OSError) -> bool:
    """Whether there is no room for what was to be written."""
    return error.errno in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)


def not_kept(error: OSError) -> Refusal:
    """What is said of a command that cannot be kept."""
    if is_no_space(error):
        return Refusal(
            "no space: the disk is full, so the run cannot be recorded, and nothing was changed. Make room, then try again"
        )
    return Refusal(f"the run cannot be recorded ({error}), so nothing was changed")
