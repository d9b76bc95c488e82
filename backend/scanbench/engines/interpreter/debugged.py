"""The reference engine's debug flavour; see `engines.debug`."""

from scanbench.engines.debug import DebugEngine, Frame, Hook, Listen
from scanbench.engines.engine import Pace, Reason, Stop
from scanbench.engines.interpreter.debug_observer import DebugObserver, Halted
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.interpreter.expressions import Body
from scanbench.program.program import Program
from scanbench.program.tasks import ProgramInstance


class ReferenceDebugEngine(ReferenceEngine, DebugEngine):
    """Runs the checked tree, and halts in it."""

    observer: DebugObserver

    def __init__(self, program: Program, memory: bytearray) -> None:
        observer = DebugObserver(program, memory)
        super().__init__(program, memory, observer)
        self.sites = observer.sites
        self._begin = bytes(memory)

    def hook(self, hook: Hook | None) -> None:
        self.observer.hook = hook

    def listen(self, listen: Listen) -> None:
        self.observer.listen(listen)

    @property
    def bits(self) -> int:
        return self.observer.bits

    @property
    def begin(self) -> bytes:
        return self._begin

    @property
    def count(self) -> int:
        return self.observer.count

    def frames(self) -> tuple[Frame, ...]:
        return self.observer.frames()

    def _connected(self, instance: ProgramInstance, run: Body) -> Body:
        return self.observer.connected(instance, run)

    def run(self, scans: int, pace: Pace | None = None) -> Stop:
        try:
            return super().run(scans, pace)
        finally:
            self._interrupt.clear()  # also when the hook raises

    def _run(self, scans: int, pace: Pace | None) -> Stop:
        try:
            return super()._run(scans, pace)
        except Halted:
            return Stop(Reason.HALTED)

    def _scan(self) -> None:
        self._begin = bytes(self.memory)
        self.observer.begin()
        try:
            super()._scan()
        finally:
            self.observer.end()


def debug_engine(program: Program, memory: bytearray) -> DebugEngine:
    """The debug flavour for this program, on this image."""
    return ReferenceDebugEngine(program, memory)
