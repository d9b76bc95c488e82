"""Observed code for the programs of one host: while somebody waits for a statement, and for no one else."""

from collections.abc import Sequence
from dataclasses import dataclass

from scanbench.check.program import Program
from scanbench.engines.cache import BlobCache
from scanbench.engines.observe import Observed
from scanbench.session.protocol import Submit

_KEPT = 2


@dataclass(frozen=True, slots=True)
class Observable:
    """The program of a version as it was checked anew, with observed code; the command that waits for it follows."""

    version: int
    program: Program
    then: Submit


class ObservedCode:
    """Native where LLVM is there, else the reference engine's. `prepare` is for any thread, `make` for the loop's."""

    def __init__(self, cache: BlobCache | None) -> None:
        try:
            from scanbench.engines.native.observed import ObservedBuilds
        except ImportError:
            self._builds = None
        else:
            self._builds = ObservedBuilds(cache)
        self._ready: list[tuple[Program, Sequence[bytes]]] = []

    def prepare(self, program: Program) -> None:
        """Compiles what `make` would have to wait for; it takes seconds for a large program."""
        if self._builds is not None:
            self._ready = [*self._ready[1 - _KEPT :], (program, self._builds.objects(program))]

    def make(self, program: Program, memory: bytearray) -> Observed:
        """The engine on this memory: at once where the program was prepared."""
        if self._builds is None:
            from scanbench.engines.interpreter.observed import observed_engine

            return observed_engine(program, memory)
        from scanbench.engines.native.observed import observed_engine as native_engine

        objects = next((objects for known, objects in self._ready if known is program), None)
        return native_engine(program, memory, self._builds.objects(program) if objects is None else objects)
