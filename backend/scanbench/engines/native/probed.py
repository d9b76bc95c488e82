"""Engines with probes, and their machine code; see `engines.probe`.

Only modules with probes, and modules into which a POU with a probe was inlined, are compiled again; the others are those that
the run flavour keeps.
"""

import ctypes
from collections.abc import Callable, Iterable, Iterator, Sequence

from scanbench.engines.cache import BlobCache
from scanbench.engines.engine import Pace, Reason, Stop
from scanbench.engines.native import emit_probe, jit
from scanbench.engines.native.compiler import FAST, Compiler
from scanbench.engines.native.emit_probe import Probing
from scanbench.engines.native.engine import NativeEngine
from scanbench.engines.native.parts import Part
from scanbench.engines.probe import Probe, ProbedEngine
from scanbench.program.layout import Layout
from scanbench.program.program import Program

Optimise = Callable[[Iterable[Part]], Iterator[tuple[Part, bytes]]]
"""Optimises modules, one after the other; may end early, as `worker.optimised` does."""


class ProbedBuilds:
    """Compiles program after program with probes. Not thread-safe."""

    def __init__(self, cache: BlobCache | None = None, optimise: Optimise | None = None) -> None:
        """`optimise` compiles elsewhere; without it that is done here."""
        self._compiler = Compiler(cache)
        self._optimise = optimise or _here

    def objects(self, program: Program, probes: Sequence[Probe]) -> list[bytes] | None:
        """The object code, for an engine with exactly these probes; None where `optimise` ended early.

        Raises BadProbe.
        """
        build = self._compiler.emitted(program, Probing(program, probes))
        self._compiler.take_known(build)
        for part, code in self._optimise(build.pending):
            self._compiler.learn(build, part, code)
        return build.objects if build.finished else None

    def engine(self, program: Program, memory: bytearray, probes: Sequence[Probe]) -> ProbedEngine:
        """An engine on this image; `optimise` must not end early."""
        objects = self.objects(program, probes)
        assert objects is not None
        return probed_engine(program, memory, probes, objects)


def _here(parts: Iterable[Part]) -> Iterator[tuple[Part, bytes]]:
    for part in parts:
        yield part, jit.compile_object(part.text, FAST, jit.Timings())


def probed_engine(
    program: Program, memory: bytearray, probes: Sequence[Probe], objects: Sequence[bytes]
) -> "NativeProbedEngine":
    """An engine with code that `ProbedBuilds` compiled for the program and these probes: only linked."""
    return NativeProbedEngine(program, memory, probes, objects)


class NativeProbedEngine(NativeEngine, ProbedEngine):
    """Runs probed machine code."""

    def __init__(self, program: Program, memory: bytearray, probes: Sequence[Probe], objects: Sequence[bytes]) -> None:
        super().__init__(program, memory, objects=objects)
        self.probes = tuple(probes)
        self._memory = memory
        self._halted: int | None = None
        slots, hits = (self._code.variable(name.removeprefix("@")) for name in (emit_probe.SLOTS, emit_probe.HITS))
        self._slots = (ctypes.c_int64 * len(self.probes)).from_address(slots)
        self._hits = (ctypes.c_uint8 * len(self.probes)).from_address(hits)

    def run(self, scans: int, pace: Pace | None = None) -> Stop:
        """See `ProbedEngine`."""
        stop, self._halted = super().run(scans, pace), None
        if stop.reason is not Reason.TRAP:
            return stop
        scan = int.from_bytes(self._memory[Layout.SCAN : Layout.SCAN + 8], "little")
        for number, hit in enumerate(self._hits):
            if hit:  # by a scan that trapped after that
                self._hits[number], self._slots[number] = 0, scan
        reached = (number for number, probe in enumerate(self.probes) if probe.halt and self._slots[number] == scan)
        self._halted = next(reached, None)
        return stop if self._halted is None else Stop(Reason.HALTED)

    @property
    def halted(self) -> int | None:
        return self._halted

    @property
    def reached(self) -> tuple[int | None, ...]:
        return tuple(None if scan == emit_probe.NEVER else scan for scan in self._slots)

    def forget(self) -> None:
        for number in range(len(self._slots)):
            self._slots[number] = emit_probe.NEVER
