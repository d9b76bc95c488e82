"""The reference engine: the scan loop in Python."""

import time
from collections.abc import Callable
from dataclasses import replace

from scanbench.check.layout import Layout
from scanbench.check.program import Expr, Pou, Program, ProgramInstance, Task
from scanbench.engines.engine import Engine, Pace, Reason, Stop
from scanbench.engines.interpreter.expressions import Body
from scanbench.engines.interpreter.places import Places, Read, Trapped
from scanbench.engines.interpreter.statements import Statements
from scanbench.engines.interpreter.violations import recorder

SLICE_NS = 2_000_000
LOST_NS = 100_000_000


class ReferenceEngine(Engine):
    """Runs the checked tree in plain Python."""

    name = "reference"

    def __init__(self, program: Program, memory: bytearray) -> None:
        self.program = program
        self.memory = memory
        self.state_size = program.layout.state_size
        self.record = recorder(memory, program.layout.violations)
        self._bodies: dict[Pou, Body] = {}
        for pou in program.pous:
            self._bodies[pou] = Statements(self, pou).block(pou.body)
        self._tasks = [(self._due(task), [self._program(each) for each in task.programs]) for task in program.tasks]
        self._knocked = False

    def body(self, pou: Pou) -> Body:
        """The body of a callee; `Program.pous` lists callees first."""
        return self._bodies[pou]

    def _program(self, instance: ProgramInstance) -> Callable[[], None]:
        """One program instance of a task, with what is connected to it."""
        make = Statements(self, replace(instance.pou, first_trap=0, first_check=0))
        before, body, after = make.block(instance.before), self._bodies[instance.pou], make.block(instance.after)

        def run() -> None:
            before(0)
            body(instance.offset)
            after(0)

        return run

    def _due(self, task: Task) -> Callable[[int], bool]:
        """Whether a task runs in a scan; asked when its turn comes."""
        every = task.every
        if task.single is None:
            return lambda scan: scan % every == 0
        assert task.previous is not None
        places = Places(self.memory, self.state_size, 0, self._no_indices)
        read, read_previous = places.read(task.single), places.read(task.previous)
        write_previous = places.write(task.previous)

        def due(scan: int) -> bool:
            single, previous = read(0), read_previous(0)
            write_previous(0, single)
            return not previous if single else every != 0 and scan % every == 0

        return due

    def _no_indices(self, expr: Expr) -> Read:
        raise AssertionError(f"the place of a task computes nothing, but {expr}")

    def knock(self) -> None:
        self._knocked = True

    def run(self, scans: int, pace: Pace | None = None) -> Stop:
        for _ in range(scans):
            if self._knocked or (pace is not None and not self._wait(pace)):
                self._knocked = False
                return Stop(Reason.KNOCKED)
            begin = time.monotonic_ns()
            try:
                self._scan()
            except Trapped as trapped:
                return Stop(Reason.TRAP, trapped.trap)
            if pace is not None:
                pace.busy_ns += time.monotonic_ns() - begin
                pace.scans += 1
                pace.deadline_ns += pace.period_ns
        if self._knocked:
            self._knocked = False
            return Stop(Reason.KNOCKED)
        return Stop(Reason.DONE)

    def _wait(self, pace: Pace) -> bool:
        """Sleeps to the deadline; False when somebody knocked meanwhile."""
        while (left := pace.deadline_ns - time.monotonic_ns()) > 0:
            time.sleep(min(left, SLICE_NS) / 1e9)
            if self._knocked:
                return False
        late = -left
        if late > max(10 * pace.period_ns, LOST_NS):
            pace.deadline_ns += late
            late = 0
        pace.late_ns += late
        pace.worst_ns = max(pace.worst_ns, late)
        return True

    def _scan(self) -> None:
        memory = self.memory
        # 1 common processing
        scan = int.from_bytes(memory[Layout.SCAN : Layout.SCAN + 8], "little")
        clock = scan * self.program.interval_ns & (1 << 63) - 1
        memory[Layout.CLOCK : Layout.CLOCK + 8] = clock.to_bytes(8, "little")
        memory[Layout.BUDGET : Layout.BUDGET + 8] = memory[Layout.BUDGET_LIMIT : Layout.BUDGET_LIMIT + 8]
        # 2 input refresh: inputs are changed in the seam; forces
        self._force()
        # 3 user program
        for due, programs in self._tasks:
            if due(scan):
                for run in programs:
                    run()
        # 4 forces again, output refresh
        self._force()
        memory[Layout.SCAN : Layout.SCAN + 8] = (scan + 1).to_bytes(8, "little")

    def _force(self) -> None:
        memory = self.memory
        count = int.from_bytes(memory[Layout.FORCE_COUNT : Layout.FORCE_COUNT + 4], "little")
        for at in range(Layout.FORCES, Layout.FORCES + 8 * count, 8):
            offset = int.from_bytes(memory[at : at + 4], "little")
            mask, value = memory[at + 4], memory[at + 5]
            memory[offset] = memory[offset] & ~mask | value & mask
