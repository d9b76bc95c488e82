"""Engines whose machine code is observed, and the code for them; see `engines.observe`."""

from collections.abc import Sequence
from threading import Lock

from scanbench.check.program import Program
from scanbench.engines.cache import BlobCache
from scanbench.engines.native.compiler import QUICK, Compiler
from scanbench.engines.native.engine import NativeEngine
from scanbench.engines.native.recorder import Recorder
from scanbench.engines.observe import Observed


class ObservedBuilds:
    """Compiles observed code of program after program; what did not change since the last one is not compiled again."""

    def __init__(self, cache: BlobCache | None = None) -> None:
        self._compiler = Compiler(cache, observed=True)
        self._lock = Lock()

    def objects(self, program: Program) -> list[bytes]:
        """The object code of the program: what takes time, a second or so for each 10,000 lines that are new."""
        with self._lock:
            return self._compiler.build(program, QUICK).objects

    def engine(self, program: Program, memory: bytearray) -> Observed:
        """An engine on this image, and what it notes."""
        return observed_engine(program, memory, self.objects(program))


def observed_engine(program: Program, memory: bytearray, objects: Sequence[bytes]) -> Observed:
    """The same with code that `ObservedBuilds` compiled for the program: only linked."""
    recorder = Recorder(program)
    return NativeEngine(program, memory, objects=objects, recorder=recorder), recorder
