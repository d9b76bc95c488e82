"""Observed programs by version: what two runs that are compared run on."""

from collections.abc import Callable

from scanbench.engines.observe import MakeObserved, Observer
from scanbench.program.program import Program
from scanbench.runtime.programs import Loaded


class ObservedPrograms:
    """`runtime.Programs` whose engines are observed. Each is built when it is first asked for, and stays."""

    def __init__(self, program_of: Callable[[int], Program], make: MakeObserved) -> None:
        """`program_of` gives the program of a version, `NoProgram` when there is none."""
        self._program_of, self._make = program_of, make
        self._known: dict[int, tuple[Loaded, Observer]] = {}

    def get(self, version: int) -> Loaded:
        """See `Programs`."""
        return self._get(version)[0]

    def observer(self, version: int) -> Observer:
        """What the engine of this version notes."""
        return self._get(version)[1]

    def _get(self, version: int) -> tuple[Loaded, Observer]:
        known = self._known.get(version)
        if known is None:
            program = self._program_of(version)
            memory = bytearray(program.layout.size)
            engine, observer = self._make(program, memory)
            known = self._known[version] = Loaded(version, program, memory, engine), observer
        return known
