"""The reference engine: the scan loop in Python."""

import threading
import time
from collections.abc import Callable
from dataclasses import replace
from functools import partial

from scanbench.check.typed.condition import Condition
from scanbench.engines.engine import Engine, Pace, Reason, Stop
from scanbench.engines.interpreter.expressions import Body
from scanbench.engines.interpreter.observer import ReferenceObserver
from scanbench.engines.interpreter.places import Places, Read, Trapped
from scanbench.engines.interpreter.sampler import Sampler
from scanbench.engines.interpreter.statements import Statements
from scanbench.engines.interpreter.violations import recorder
from scanbench.engines.sample import Sampling
from scanbench.problems import Span
from scanbench.program.layout import FORCE_AFTER_PROGRAM, FORCE_BEFORE, Layout
from scanbench.program.program import Expr, Pou, Program
from scanbench.program.tasks import ProgramInstance, Task
from scanbench.program.types import Kind, Record

LOST_NS = 100_000_000


class ReferenceEngine(Engine):
    """Runs the checked tree in plain Python; with an observer, that is told what the program does."""

    name = "reference"

    def __init__(self, program: Program, memory: bytearray, observer: ReferenceObserver | None = None) -> None:
        self.program = program
        self.memory = memory
        self.observer = observer
        self.state_size = program.layout.state_size
        self.record = recorder(memory, program)
        self._recursive = any(pou.recursive for pou in program.pous)
        self._bodies: dict[Pou, Body] = {}
        for pou in program.pous:
            body = Statements(self, pou).block(pou.body)
            self._bodies[pou] = body if observer is None else observer.body(pou, body)
        self._common = [self._silent(self._program(each)) for each in program.common]
        self._life = [self._program(each) for each in program.life]
        self._plant = [self._silent(self._program(each)) for each in program.plant]
        self._tasks = [(self._due(task), [self._program(each) for each in task.programs]) for task in program.tasks]
        self._interrupt = threading.Event()
        self._condition: Callable[[], bool] | None = None
        self._samplers: list[Sampler] = []

    def body(self, pou: Pou) -> Body:
        """The body of a callee; `Program.pous` lists callees first, but for those that call each other."""
        known = self._bodies.get(pou)
        return known if known is not None else partial(self._later, pou)

    def _later(self, pou: Pou, instance: int) -> int:
        return self._bodies[pou](instance)

    def _program(self, instance: ProgramInstance) -> Callable[[], None]:
        """One program instance of a task, with what is connected to it."""
        make = Statements(self, replace(instance.pou, first_trap=0, first_check=0, called_at=0))
        body = self._bodies[instance.pou]
        before, after = (self._connected(instance, make.block(each)) for each in (instance.before, instance.after))

        memory, called = self.memory, instance.pou.called_at

        def run() -> None:
            before(0)
            if called:
                memory[called : called + 8] = bytes(8)
            body(instance.offset)
            after(0)

        return run

    def _connected(self, instance: ProgramInstance, run: Body) -> Body:
        """What is connected to a program instance, on one side of it; called without an instance."""
        return run

    def _silent(self, run: Callable[[], None]) -> Callable[[], None]:
        """What is not the user's program is not observed."""
        observer = self.observer
        if observer is None:
            return run

        def silent() -> None:
            with observer.silence():
                run()

        return silent

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

    def interrupt(self) -> None:
        self._interrupt.set()

    def stop_when(self, condition: Condition | None, *others: Condition) -> None:
        conditions = others if condition is None else (condition, *others)
        checks = [self._holds(each) for each in conditions]
        self._condition = (lambda: any(check() for check in checks)) if checks else None

    def holds(self, condition: Condition) -> bool:
        return self._holds(condition)()

    def sample(self, *samplings: Sampling) -> None:
        self._samplers = [
            Sampler(each, self.memory, [self._value(signal.expr) for signal in each.signals]) for each in samplings
        ]

    def _value(self, expr: Expr) -> Read:
        """Evaluates an expression that belongs to no POU."""
        nobody = Record("CONDITION", Kind.STRUCT)
        return Statements(self, Pou("CONDITION", "function", nobody, nobody, (), None, Span("", 0, 0, 0, 0))).evaluate(
            expr
        )

    def _holds(self, condition: Condition) -> Callable[[], bool]:
        """Evaluates the condition on the image."""
        value = self._value(condition.expr)

        def holds() -> bool:
            try:
                return bool(value(0))
            except Trapped:
                return condition.unknown

        return holds

    def run(self, scans: int, pace: Pace | None = None) -> Stop:
        stop = self._run(scans, pace)
        self._interrupt.clear()
        return stop

    def _run(self, scans: int, pace: Pace | None) -> Stop:
        if any(each.full for each in self._samplers):
            return Stop(Reason.INTERRUPTED)
        for _ in range(scans):
            paced = pace is not None and pace.period_ns > 0
            if self._interrupt.is_set() or (pace is not None and paced and not self._wait(pace)):
                return Stop(Reason.INTERRUPTED)
            begin = time.monotonic_ns()
            try:
                self._scan()
            except Trapped as trapped:
                return Stop(Reason.TRAP, trapped.trap)
            if pace is not None:
                pace.busy_ns += time.monotonic_ns() - begin
                pace.scans += 1
                pace.deadline_ns += pace.period_ns
            if not all([each.sample() for each in self._samplers]):  # noqa: C419 - each of them has to sample
                self._interrupt.set()
            if self._condition is not None and self._condition():
                return Stop(Reason.CONDITION)
            if any(self.memory[Layout.ASKED_COUNT : Layout.ASKED_COUNT + 4]):
                return Stop(Reason.ASKED)
        return Stop(Reason.INTERRUPTED if self._interrupt.is_set() else Reason.DONE)

    def _wait(self, pace: Pace) -> bool:
        """Sleeps to the deadline; False when somebody interrupted meanwhile."""
        while (left := pace.deadline_ns - time.monotonic_ns()) > 0:
            if self._interrupt.wait(left / 1e9):
                return False
        late = -left
        pace.late_scans += late > pace.period_ns
        if late > max(10 * pace.period_ns, LOST_NS):
            pace.deadline_ns += late
        pace.late_ns += late
        pace.worst_ns = max(pace.worst_ns, late)
        return True

    def _scan(self) -> None:
        memory = self.memory
        # 1 common processing
        scan = int.from_bytes(memory[Layout.SCAN : Layout.SCAN + 8], "little")
        origin = int.from_bytes(memory[Layout.ORIGIN : Layout.ORIGIN + 8], "little")
        clock = origin + scan * self.program.interval_ns & (1 << 63) - 1
        memory[Layout.CLOCK : Layout.CLOCK + 8] = clock.to_bytes(8, "little")
        memory[Layout.BUDGET : Layout.BUDGET + 8] = memory[Layout.BUDGET_LIMIT : Layout.BUDGET_LIMIT + 8]
        memory[Layout.INTERVAL : Layout.INTERVAL + 8] = self.program.interval_ns.to_bytes(8, "little")
        memory[Layout.ASKED_COUNT : Layout.ASKED_COUNT + 4] = bytes(4)
        if self._recursive:
            memory[Layout.DEPTH : Layout.DEPTH + 4] = bytes(4)
        for run in (*self._common, *self._life):
            run()
        # 2 input refresh: the plant; inputs are also changed in the seam; forces
        for run in self._plant:
            run()
        self._force(FORCE_BEFORE)
        # 3 user program
        for due, programs in self._tasks:
            if due(scan):
                for run in programs:
                    run()
        # 4 forces again, output refresh
        self._force(FORCE_AFTER_PROGRAM)
        memory[Layout.SCAN : Layout.SCAN + 8] = (scan + 1).to_bytes(8, "little")

    def _force(self, note: int) -> None:
        memory = self.memory
        count = int.from_bytes(memory[Layout.FORCE_COUNT : Layout.FORCE_COUNT + 4], "little")
        for at in range(Layout.FORCES, Layout.FORCES + 8 * min(count, Layout.FORCE_LIMIT), 8):
            offset = int.from_bytes(memory[at : at + 4], "little")
            mask, value = memory[at + 4], memory[at + 5]
            if offset < len(memory):
                memory[at + note] = memory[offset]
                memory[offset] = memory[offset] & ~mask | value & mask
