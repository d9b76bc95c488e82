"""Both engines at once: every scan runs on each, and the images must agree byte for byte."""

from scanbench.check.typed.condition import Condition
from scanbench.engines.engine import Engine, Pace, Reason, Stop
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.engine import NativeEngine
from scanbench.engines.sample import Sampling
from scanbench.program.layout import Layout
from scanbench.program.program import Program
from scanbench.symbols.names import names_of


class Differs(Exception):
    """The engines disagree after a scan."""

    def __init__(self, scan: int, where: str, native: str, reference: str) -> None:
        super().__init__(f"scan {scan}: the engines differ at {where}: native {native}, reference {reference}")
        self.scan = scan
        self.where = where


class PairEngine(Engine):
    """Native on the image given; the reference engine on an image of its own.

    Before every scan that takes over the state, which was compared, with what was written since. It keeps its own frames, where temporaries are:
    with those of the native engine, which writes few of them, a temporary that is read before it is written would look the same in both.
    """

    name = "both"

    def __init__(self, program: Program, memory: bytearray) -> None:
        self.program = program
        self.memory = memory
        self.shadow = bytearray(memory)
        self._size = program.layout.state_size
        self.native = NativeEngine(program, memory)
        self.reference = ReferenceEngine(program, self.shadow)

    def interrupt(self) -> None:
        self.native.interrupt()

    def stop_when(self, condition: Condition | None, *others: Condition) -> None:
        self.native.stop_when(condition, *others)
        self.reference.stop_when(condition, *others)

    def sample(self, *samplings: Sampling) -> None:
        self.native.sample(*samplings)

    def holds(self, condition: Condition) -> bool:
        return self.native.holds(condition)

    def run(self, scans: int, pace: Pace | None = None) -> Stop:
        for _ in range(scans):
            scan = self._scan
            self.shadow[: self._size] = self.memory[: self._size]
            stop = self.native.run(1, pace)
            if stop.reason is Reason.INTERRUPTED and self._scan == scan:
                return stop
            other = self.reference.run(1)
            self._compare(scan, Stop(Reason.DONE) if stop.reason is Reason.INTERRUPTED else stop, other)
            if stop.reason is not Reason.DONE:
                return stop
        return Stop(Reason.DONE)

    @property
    def _scan(self) -> int:
        return int.from_bytes(self.memory[Layout.SCAN : Layout.SCAN + 8], "little")

    def _compare(self, scan: int, stop: Stop, other: Stop) -> None:
        size = self._size
        if stop != other:
            raise Differs(scan, "the end of the scan", self._say(stop), self._say(other))
        if self.memory[:size] != self.shadow[:size]:
            at = next(index for index in range(size) if self.memory[index] != self.shadow[index])
            values = (memory[at : at + 8].hex(" ") for memory in (self.memory, self.shadow))
            raise Differs(scan, f"{names_of(self.program).path(at)} (byte {at} of the image)", *values)

    def _say(self, stop: Stop) -> str:
        match stop.reason:
            case Reason.TRAP:
                site = self.program.traps[stop.trap - 1]
                return f"trapped at {site.span}: {site.message}"
            case Reason.ASKED:
                return "asked for something"
            case Reason.CONDITION:
                return "found that the condition holds"
        return "went on"
