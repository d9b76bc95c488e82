"""The virtual PLC: engine, image, seam and journal in one. No threads: whoever owns it says when to run."""

import errno
from dataclasses import dataclass
from functools import partial

from scanbench.check.typed.condition import Condition
from scanbench.engines.engine import Engine, Pace, Reason, Stop
from scanbench.program.program import Program
from scanbench.runtime import seam
from scanbench.runtime.agenda import NONE_MET, Agenda, Met
from scanbench.runtime.clock import monotonic_ns, wall_time
from scanbench.runtime.command import Command, Entry, Plan, Refusal, View
from scanbench.runtime.detect import Detect, read_asked
from scanbench.runtime.header import Header, Mode, fresh_image, pass_time
from scanbench.runtime.inside import Diverged, Inside, Insider, entered_inside, front, needs_seam
from scanbench.runtime.journal import Journal
from scanbench.runtime.listening import Listening, Within
from scanbench.runtime.programs import Loaded, LoadedPrograms, Programs
from scanbench.runtime.recorder import Recorder
from scanbench.runtime.trap import TRAPPED, TrapInfo, Trapped, trap_info
from scanbench.runtime.waiting import Waiting, held


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
        self.programs = programs if programs is not None else LoadedPrograms(loaded)
        self.recorder = recorder
        self.journal = Journal()
        self.measured = Measured()
        self.detect = detect
        self.listening = Listening(loaded)
        self.waiting = Waiting(agenda)
        self.proved = 1 << 64
        """A replay is believed to go so far, and `BETWEEN` scans further: a run file has a state of this scan."""
        self._finishing = False
        self.lenient = False
        """The run need not go as it did when it was recorded: what was entered inside of a scan that does not get so far now
        is entered after it."""
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
        """The image. A program change replaces it."""
        return self.loaded.memory

    @property
    def engine(self) -> Engine:
        """What runs the program."""
        return self.listening.engine(probing=not self._finishing)

    @property
    def begun(self) -> bool:
        """Whether the scan that is next has been run in part: it is halted, or was when the PLC was ended."""
        return self.listening.inside is not None or bool(entered_inside(self.journal, self.header.scan))

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

        In a halted scan it is entered at the halt; a command that needs the seam lets the scan run to its end first.
        """
        if self.begun:
            plan = command.settled(self.view).plan(self.view)
            if isinstance(plan, Refusal):
                return plan
            inside = self.listening.inside
            if inside is not None and not needs_seam(plan):
                return self._enter(command, must=False, step=inside.count)
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
        self._attend(NONE_MET)  # nothing, unless this run was gone on with after what was due
        if ran and not self.runnable:
            return Stop(Reason.INTERRUPTED)
        waits, first, listening = self.waiting.waits(self.view), self.header.scan, self.listening
        if waits.scan is not None:
            scans = min(scans, waits.scan - first)
        insider = waits.inside
        listening.observe(waits.observed)
        if insider is not None and not self._finishing and listening.takes_over():
            return Stop(Reason.INTERRUPTED)
        alone = bool(waits.sites) or insider is not None
        stop = self._run(self.engine, min(scans, 1) if alone else scans, pace, self.waiting.conditions(waits), insider)
        if stop.reason is Reason.HALTED:
            return Stop(Reason.INTERRUPTED) if listening.probe_reached() else stop
        if stop.reason is Reason.TRAP and not self._finishing and listening.trap_taken_back():
            return Stop(Reason.HALTED)
        came_true = held(self.engine, waits) if stop.reason is Reason.CONDITION else NONE_MET.conditions
        met = Met(came_true, listening.reached(waits.sites))
        if stop.reason is Reason.CONDITION and not any(map(self.engine.holds, self.waiting.until)):
            stop = Stop(Reason.INTERRUPTED)
        if stop.reason is Reason.TRAP:
            self._notice(stop.trap)
        elif self.header.scan > first:
            self._notice()
        self._attend(met)
        return stop

    def interrupt(self) -> None:
        """Asks, from any thread, for the run to come back after the current scan."""
        self.engine.interrupt()

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

    def idle(self, scans: int) -> None:
        """Up to `scans` scans pass while the program is stopped: no further than to what is due."""
        self._attend(NONE_MET)
        due = self.waiting.waits(self.view).scan
        self.pass_time(scans if due is None else min(scans, due - self.header.scan))
        self._attend(NONE_MET)

    def settle(self) -> None:
        """After a recovery: answers what the last scan asked for, and does what is due, unless all that was entered
        before all ended."""
        last = self.journal[-1].scan if self.journal else -1
        met = NONE_MET
        if last < self.header.scan:
            met = Met(held(self.engine, self.waiting.waits(self.view)))
            self._notice()
        self._attend(met)

    # ---- replay ---------------------------------------------------------------------------------------------------

    def rerun(self, scans: int, pace: Pace | None = None) -> Stop:
        """Runs up to `scans` scans, and enters nothing: what was noticed then is in the journal."""
        return self._run(self.loaded.engine if self.listening.hook is None else self.engine, scans, pace, ())

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
        self.listening.inside = inside

    def leave(self) -> None:
        """Where the scan began that is halted, without what was entered inside of it: for what is shown of the past."""
        self.listening.go_to_begin()
        self.journal = self.journal.prefix(front(self.journal, self.header.scan))

    # ---- running --------------------------------------------------------------------------------------------------

    def _run(
        self, engine: Engine, scans: int, pace: Pace | None, conditions: tuple[Condition, ...],
        insider: Insider | None = None,
    ) -> Stop:  # fmt: skip
        self.listening.go_to_begin()
        if not self.runnable:
            raise RuntimeError("the program is stopped: it must not be run")
        waiting = entered_inside(self.journal, self.header.scan)
        if waiting or insider is not None:
            engine, scans = self.loaded.debugged(), min(scans, 1)
        self.waiting.tell(engine, self.program, conditions)
        first, start = self.header.scan, monotonic_ns()
        busy = pace.busy_ns if pace is not None else 0
        if waiting or self.listening.hook is not None or insider is not None:
            within = Within(
                waiting, lambda entry: seam.apply(self.loaded, self.programs, entry.plan), insider,
                partial(self._enter_inside, first),
            )  # fmt: skip
            stop = self.listening.run(scans, pace, within, not self._finishing, self.lenient)
        else:
            stop = engine.run(scans, pace)
        self.measured.scans += self.header.scan - first
        self.measured.busy_ns += pace.busy_ns - busy if pace is not None else monotonic_ns() - start
        return stop

    def _enter_inside(self, scan: int, command: Command, count: int) -> None:
        """What an insider enters. If it is refused, the agenda finds that it was not entered."""
        plan = command.plan(self.view)
        if isinstance(plan, Plan):
            self.enter_planned(command, plan, must=True, step=count, scan=scan)

    # ---- the seam -------------------------------------------------------------------------------------------------

    def _attend(self, met: Met) -> None:
        """Enters what is due in this seam. It has happened in any case, so it is never refused for want of room."""
        agenda = self.waiting.agenda
        if agenda is None or self.begun:
            return
        while (command := agenda.due(self.view, met)) is not None:
            outcome = self._enter(command, must=True)
            if isinstance(outcome, Refusal):
                self._enter(agenda.refused(command, outcome), must=True)

    def _enter(self, command: Command, must: bool, step: int = 0) -> Entry | Refusal:
        command = command.settled(self.view)
        plan = command.plan(self.view)
        if isinstance(plan, Refusal):
            return plan
        return self.enter_planned(command, plan, must, step)

    def enter_planned(
        self, command: Command, plan: Plan, must: bool = False, step: int = 0, scan: int | None = None
    ) -> Entry | Refusal:
        """Enters a command by its plan, before statement `step` of the scan that runs, or in the seam. What cannot be
        kept is refused, unless it `must` be."""
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
        self.loaded, self.header = loaded, Header(loaded.memory)
        self.listening.load(loaded)
        self.measured = Measured()

    def _notice(self, trap: int = 0) -> None:
        """Enters what the PLC notices after a scan: its trap, what the program asked for, the error of the trap."""
        info = trap_info(self.program, trap, self.header.scan) if trap else None
        if info is not None:
            self._enter(Trapped("PLC", info), must=True)
        if self.detect is None:
            return
        asked = read_asked(self.memory)
        for command in self.detect.on_asked(asked, self.view) if asked else ():
            self._enter(command, must=True)
        error = self.detect.on_trap(info, self.view) if info is not None else None
        if error is not None:
            self._enter(error, must=True)


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
