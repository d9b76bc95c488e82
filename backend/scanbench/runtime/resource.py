"""The virtual PLC: engine, image, seam and journal in one. No threads, no wall clock: whoever owns it says when to run."""

from collections.abc import Callable
from dataclasses import dataclass

from scanbench.check.layout import Layout
from scanbench.check.program import Program
from scanbench.engines.engine import Engine, Pace, Reason, Stop
from scanbench.runtime import seam
from scanbench.runtime.carry_over import carry_over
from scanbench.runtime.clock import monotonic_ns
from scanbench.runtime.command import Command, Entry, Refusal, View
from scanbench.runtime.forces import forced
from scanbench.runtime.header import Header, Mode, fresh_image, pass_time
from scanbench.runtime.journal import Journal
from scanbench.runtime.program_change import ProgramChange
from scanbench.runtime.trap import TrapInfo, Trapped, trap_info

EngineFactory = Callable[[Program, bytearray], Engine]


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
        self, program: Program, engine_factory: EngineFactory, mode: Mode = Mode.MONITOR, state: bytes | None = None
    ) -> None:
        """Cold start in `mode`, or from `state`, the first `Layout.state_size` bytes of an image of this program."""
        self.program = program
        self.memory = fresh_image(program, mode)
        if state is not None:
            self.memory[: len(state)] = state
        self.header = Header(self.memory)
        self.engine = engine_factory(program, self.memory)
        self.journal = Journal()
        self.trap: TrapInfo | None = None
        self.measured = Measured()

    @property
    def view(self) -> View:
        """What planners may read."""
        return View(self.program, self.memory, self.journal)

    @property
    def runnable(self) -> bool:
        """Whether the mode and the errors let the program run."""
        return self.header.runnable

    @property
    def state(self) -> bytes:
        """A copy of what is compared, hashed and recorded."""
        return bytes(memoryview(self.memory)[: self.program.layout.state_size])

    def submit(self, command: Command) -> Entry | Refusal:
        """Enters a command in the seam, now."""
        entry = seam.enter(command, self.view, self.memory, self.journal)
        self._see_trap()
        return entry

    def run(self, scans: int, pace: Pace | None = None) -> Stop:
        """Runs up to `scans` scans; a trap is entered in the journal and stops the program."""
        if not self.runnable:
            raise RuntimeError("the program is stopped: run() must not be called")
        stop = self._measured_run(scans, pace)
        if stop.reason is Reason.TRAP:
            self.submit(Trapped("PLC", trap_info(self.program, stop.trap, self.header.scan)))
        return stop

    def restart(self) -> None:
        """Cold start: a fresh image, a new journal. It runs, in RUN if it was in RUN, else in MONITOR."""
        mode = Mode.RUN if self.header.mode is Mode.RUN else Mode.MONITOR
        self.memory[:] = fresh_image(self.program, mode)
        self.journal, self.trap, self.measured = Journal(), None, Measured()

    def swap(self, program: Program, engine: Engine, memory: bytearray, author: str, version: int) -> str:
        """Goes on with a new program; `engine` was made for it on `memory`. Returns what became of the variables.

        After a trap there is nothing to go on with: the new program starts cold.
        """
        old_program, old_memory, trapped = self.program, self.memory, self.trap is not None
        memory[:] = fresh_image(program, Mode.MONITOR)
        held = forced(self.journal)
        self.program, self.memory, self.engine, self.header = program, memory, engine, Header(memory)
        self.measured = Measured()
        if trapped:
            self.journal, self.trap = Journal(), None
            report = "cold start, as the old program had stopped by a run-time error"
            self.submit(ProgramChange(author, version, report))
            return report
        mode = old_memory[Layout.MODE]
        report = str(carry_over(old_program, old_memory, program, memory))
        memory[Layout.MODE] = Mode.MONITOR  # forces are entered anew, in any mode
        self.submit(ProgramChange(author, version, report))
        lost = [force.path for force in held.values() if isinstance(self.submit(force), Refusal)]
        memory[Layout.MODE] = mode
        return report + (f"; forces released: {', '.join(lost)}" if lost else "")

    def pass_time(self, scans: int) -> None:
        """Virtual time goes on while the program is stopped."""
        if scans > 0:
            pass_time(self.memory, scans, self.program.interval_ns)

    def adopt(self, journal: Journal) -> None:
        """Takes the journal that led to this image, as read from a checkpoint."""
        self.journal = journal
        self._see_trap()

    def reenter(self, entry: Entry) -> None:
        """Replay of an entry: its plan, not its command, so that the planner need not be the same any more."""
        seam.apply(self.memory, entry.plan)
        self.journal.append(entry)
        self._see_trap()

    def rerun_trap(self, entry: Entry) -> None:
        """Replay of a trap: the part of the scan that ran before it, then its entry."""
        self._measured_run(1, None)
        self.reenter(entry)

    def _measured_run(self, scans: int, pace: Pace | None) -> Stop:
        first, start = self.header.scan, monotonic_ns()
        busy = pace.busy_ns if pace is not None else 0
        stop = self.engine.run(scans, pace)
        self.measured.scans += self.header.scan - first
        self.measured.busy_ns += pace.busy_ns - busy if pace is not None else monotonic_ns() - start
        return stop

    def _see_trap(self) -> None:
        """The trap that keeps the program stopped, if one does: the journal knows."""
        if not self.header.halted_by_trap:
            self.trap = None
            return
        for entry in reversed(self.journal):
            if isinstance(entry.command, Trapped):
                self.trap = entry.command.info
                return
