"""Engines whose machine code is observed, and that code; see `engines.observe`.

It is one module, compiled quickly: that takes half a second for 10,000 lines, and runs some thousand times faster than the
reference engine. Who waits for it waits seldom, so there are no parts and no second tier.
"""

from collections.abc import Sequence

from scanbench.engines.cache import BlobCache
from scanbench.engines.native import jit
from scanbench.engines.native.compiler import QUICK
from scanbench.engines.native.emit_observed import Observing
from scanbench.engines.native.emit_program import emit_program
from scanbench.engines.native.engine import NativeEngine
from scanbench.engines.native.observer import NativeObserver
from scanbench.engines.observe import Observed
from scanbench.garbage import without_collection
from scanbench.program.program import Program


class ObservedBuilds:
    """Compiles programs to be observed, or takes from the cache what was compiled. Thread-safe."""

    def __init__(self, cache: BlobCache | None = None) -> None:
        self._cache = cache

    def objects(self, program: Program) -> list[bytes]:
        """The object code of the program."""
        with without_collection():
            text = emit_program(program, Observing(program))
        key = jit.object_key(text, QUICK)
        code = self._cache.get(key) if self._cache is not None else None
        if code is None:
            code = jit.compile_object(text, QUICK, jit.Timings())
            if self._cache is not None:
                self._cache.put(key, code)
        return [code]

    def engine(self, program: Program, memory: bytearray) -> Observed:
        """An engine on this image, and what it notes."""
        return observed_engine(program, memory, self.objects(program))


def observed_engine(program: Program, memory: bytearray, objects: Sequence[bytes]) -> Observed:
    """The same with code that `ObservedBuilds` compiled for the program: only linked."""
    observer = NativeObserver(program)
    return NativeEngine(program, memory, objects=objects, observer=observer), observer
