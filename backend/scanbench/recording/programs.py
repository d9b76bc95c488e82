"""The programs of a run file, each made ready to run when it is first asked for."""

from collections.abc import Callable, Collection, Mapping
from typing import Protocol

from scanbench.engines.debug import DebugEngine
from scanbench.engines.engine import Engine
from scanbench.engines.interpreter.debugged import debug_engine
from scanbench.engines.observe import MakeObserved
from scanbench.program.program import Program
from scanbench.recording.blocks import KeptProgram
from scanbench.recording.fingerprints import program_digest
from scanbench.recording.recording import Recording
from scanbench.runtime.programs import Loaded, NoProgram, Programs

ProgramsOf = Callable[[Mapping[int, KeptProgram]], Programs]
"""Makes programs, with memory of their own, of what a run file kept of them. The mapping grows with the run."""
Make = Callable[[int, Program], Loaded]
"""Makes a version of a program ready to run."""


class Code(Protocol):
    """The part of `Flavours` that a program of a run needs."""

    def run(self, program: Program, memory: bytearray) -> Engine:
        """See `Flavours`."""

    def debug(self, program: Program, memory: bytearray) -> DebugEngine:
        """See `Flavours`."""


def on(code: Code) -> Make:
    """On this code; the debug flavour is made when it is first needed."""
    make_debug = code.debug

    def make(version: int, program: Program) -> Loaded:
        memory = bytearray(program.layout.size)
        return Loaded(version, program, memory, code.run(program, memory), make_debug=make_debug)

    return make


def reference(version: int, program: Program) -> Loaded:
    """On the reference interpreter: one flavour is both."""
    memory = bytearray(program.layout.size)
    engine = debug_engine(program, memory)
    return Loaded(version, program, memory, engine, debug=engine)


def observed(make_observed: MakeObserved) -> Make:
    """On code that notes what it does."""

    def make(version: int, program: Program) -> Loaded:
        memory = bytearray(program.layout.size)
        engine, observer = make_observed(program, memory)
        return Loaded(version, program, memory, engine, observer=observer)

    return make


class ProgramCache:
    """`Programs` that are loaded when they are first asked for, and stay. In one thread."""

    def __init__(self, load: Callable[[int], Loaded]) -> None:
        """`load` makes a version ready to run; `NoProgram` says why it cannot."""
        self._load = load
        self._loaded: dict[int, Loaded] = {}

    def get(self, version: int) -> Loaded:
        """See `Programs`."""
        loaded = self._loaded.pop(version, None)
        if loaded is None:
            loaded = self._load(version)
        self._loaded[version] = loaded  # the dict keeps the order of use: the last one used is last
        return loaded

    def put(self, loaded: Loaded) -> None:
        """One that was loaded elsewhere, in the place of what there was of its version."""
        self._loaded.pop(loaded.version, None)
        self._loaded[loaded.version] = loaded

    @property
    def loaded(self) -> Collection[Loaded]:
        """All that are here."""
        return self._loaded.values()

    def keep(self, most: int, *in_use: int) -> None:
        """Lets go of those that were not used for long, until there are so many; the versions given stay."""
        idle = [version for version in self._loaded if version not in in_use]
        for version in idle[: max(0, len(self._loaded) - most)]:
            del self._loaded[version]


def cached(programs: Mapping[int, Program], make: Make) -> ProgramCache:
    """These programs, by version."""
    return ProgramCache(lambda version: made(make, version, programs[version]))


def made(make: Make, version: int, program: Program) -> Loaded:
    """Ready to run. Who looks at a run is told that a program is too large; the process of a PLC has its own words for that."""
    try:
        return make(version, program)
    except MemoryError as error:
        raise NoProgram(f"program version {version} does not fit into memory") from error


def programs_of(program_of: Callable[[KeptProgram], Program], make: Make) -> ProgramsOf:
    """`program_of` builds a program, `NoProgram` says why it cannot be built."""

    def programs(kept: Mapping[int, KeptProgram]) -> ProgramCache:
        def load(version: int) -> Loaded:
            if version not in kept:
                raise NoProgram(f"there is no program version {version} in the run")
            return made(make, version, program_of(kept[version]))

        return ProgramCache(load)

    return programs


class KeptPrograms:
    """Programs, but only those that the run file has, and only when they have come out as they were."""

    def __init__(self, recording: Recording, programs: Programs) -> None:
        self._recording, self.inner = recording, programs
        self._checked: set[int] = set()

    def get(self, version: int) -> Loaded:
        """See `Programs`."""
        kept = self._recording.programs.get(version)
        if kept is None:
            raise NoProgram(f"there is no program version {version} in {self._recording.path.name}")
        loaded = self.inner.get(version)
        if version not in self._checked:
            if program_digest(loaded.program) != kept.digest:
                raise NoProgram(
                    f"program version {version} of {self._recording.path.name} does not come out as it was when it was "
                    "recorded, because this version of scanbench compiles it differently: open it with the version that wrote it"
                )
            self._checked.add(version)
        return loaded
