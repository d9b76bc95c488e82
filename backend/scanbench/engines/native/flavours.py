"""Every flavour of machine code; see `engines/available.py`."""

from collections.abc import Sequence
from functools import cached_property

from scanbench.engines.cache import BlobCache
from scanbench.engines.debug import DebugEngine
from scanbench.engines.engine import Engine
from scanbench.engines.native.compiler import Compiler
from scanbench.engines.native.debugged import DebugBuilds
from scanbench.engines.native.engine import NativeEngine
from scanbench.engines.native.observed import ObservedBuilds, observed_engine
from scanbench.engines.native.probed import ProbedBuilds
from scanbench.engines.native.worker import optimised
from scanbench.engines.observe import Observed
from scanbench.engines.probe import MakeProbed
from scanbench.program.program import Program

_KEPT = 2
"""Programs whose observed code is kept."""


class Native:
    """See `Flavours`."""

    def __init__(self, cache: BlobCache | None = None) -> None:
        self._cache = cache
        self._debug, self._observed = DebugBuilds(cache), ObservedBuilds(cache)
        self._ready: list[tuple[Program, Sequence[bytes]]] = []

    @cached_property
    def _compiler(self) -> Compiler:
        return Compiler(self._cache)

    def run(self, program: Program, memory: bytearray) -> Engine:
        """See `Flavours`."""
        return NativeEngine(program, memory, objects=self._compiler.build(program).objects)

    def debug(self, program: Program, memory: bytearray) -> DebugEngine:
        """See `Flavours`."""
        return self._debug.engine(program, memory)

    def observed(self, program: Program, memory: bytearray) -> Observed:
        """See `Flavours`."""
        objects = next((objects for known, objects in self._ready if known is program), None)
        return observed_engine(program, memory, self._observed.objects(program) if objects is None else objects)

    def prepare_observed(self, program: Program) -> None:
        """See `Flavours`."""
        self._ready = [*self._ready[1 - _KEPT :], (program, self._observed.objects(program))]

    def probed(self, *, aside: bool) -> MakeProbed:
        """See `Flavours`."""
        return ProbedBuilds(self._cache, (lambda parts: optimised(parts, lambda: True)) if aside else None).engine
