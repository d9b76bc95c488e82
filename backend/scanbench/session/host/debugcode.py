"""Debugged code for the programs of one host: built beside the loop, put in place in its seam."""

from dataclasses import dataclass

from scanbench.check.program import Program
from scanbench.debug.probing import Prober
from scanbench.engines.cache import BlobCache
from scanbench.engines.debug import DebugEngine
from scanbench.engines.probe import BadProbe, Probe, ProbedEngine
from scanbench.runtime.programs import Loaded


@dataclass(frozen=True, slots=True)
class Debuggable:
    """The debug flavour of a program that is loaded; or why there is none."""

    loaded: Loaded
    program: Program | None
    engine: DebugEngine | None
    message: str = ""

    def put_in_place(self) -> None:
        """In the seam. What stands there already stays: somebody may have listened to it."""
        if self.loaded.debug is None and self.engine is not None:
            self.loaded.fresh = self.program
            self.loaded.debug = self.engine


@dataclass(frozen=True, slots=True)
class Probed:
    """Code with probes, for the program that is loaded."""

    loaded: Loaded
    engine: ProbedEngine


class DebugCode:
    """Native where LLVM is there, else the reference engine's. For any thread."""

    def __init__(self, cache: BlobCache | None) -> None:
        try:
            from scanbench.engines.native.debugged import DebugBuilds
            from scanbench.engines.native.probed import ProbedBuilds
            from scanbench.engines.native.worker import optimised
        except ImportError:
            self._builds = None
            self.prober: Prober | None = None
        else:
            self._builds = DebugBuilds(cache)
            self.prober = ProbedBuilds(cache).engine
            """Makes code with probes at once, for the loop's thread."""
            self._probed = ProbedBuilds(cache, lambda parts: optimised(parts, lambda: True))

    def make(self, program: Program, memory: bytearray) -> DebugEngine:
        """The engine on this memory, which it does not touch until it runs; it takes seconds for a large program."""
        if self._builds is None:
            from scanbench.engines.interpreter.debugged import debug_engine

            return debug_engine(program, memory)
        return self._builds.engine(program, memory)

    def probed(self, loaded: Loaded, probes: tuple[Probe, ...]) -> ProbedEngine | None:
        """The same with probes, compiled in a process of its own; None where there can be none. One thread at a time."""
        if self._builds is None:
            return None
        try:
            return self._probed.engine(loaded.renewed(), loaded.memory, probes)
        except BadProbe:
            return None
