"""Programs by version, each with the memory and the engine it runs on: what a change of the program chooses from."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

from scanbench.engines.debug import DebugEngine
from scanbench.engines.engine import Engine
from scanbench.engines.interpreter.debugged import debug_engine
from scanbench.engines.observe import Observer
from scanbench.program.program import Program

EngineFactory = Callable[[Program, bytearray], Engine]


@dataclass(eq=False, slots=True)
class Loaded:
    """A program that can run at once. `engine` works on `memory` and may be replaced by one that computes the same."""

    version: int
    program: Program
    memory: bytearray
    engine: Engine
    fresh: Program | None = None
    """The same program checked again, where later checks may have changed the statements of `program`."""
    renew: Callable[[], Program] | None = None
    """Makes `fresh`, always the same, where that may be needed; in any thread."""
    debug: DebugEngine | None = None
    """The debug flavour on the same memory, once there is any."""
    make_debug: Callable[[Program, bytearray], DebugEngine] | None = None
    """Makes it when it is first needed, where that may take its time."""
    observer: Observer | None = None
    """Tells what `engine` reads and writes, where that was made to be observed."""

    def debugged(self) -> DebugEngine:
        """The debug flavour: that of the reference engine, unless a different one was put in place. So a run that was debugged
        can be replayed anywhere."""
        if self.debug is None:
            self.debug = (self.make_debug or debug_engine)(self.settled(), self.memory)
        return self.debug

    def settled(self) -> Program:
        """The same as `renewed`, and from now on those are its `statements`. In the thread that runs it."""
        self.fresh = self.renewed()
        return self.fresh

    def renewed(self) -> Program:
        """The program with statements that no later check changes. Any thread."""
        if self.fresh is not None:
            return self.fresh
        return self.program if self.renew is None else self.renew()

    @property
    def statements(self) -> Program:
        """The program whose statements are those that run."""
        return self.fresh or self.program

    @staticmethod
    def make(program: Program, engine_factory: EngineFactory, version: int = 1) -> "Loaded":
        """With memory of its own."""
        memory = bytearray(program.layout.size)
        return Loaded(version, program, memory, engine_factory(program, memory))


class NoProgram(LookupError):
    """There is no such program, or it cannot be made any more; the message says why."""


class Programs(Protocol):
    """Knows every program that a run used or may change to."""

    def get(self, version: int) -> Loaded:
        """The same object as long as it is in use; `NoProgram` when there is no such version."""


class LoadedPrograms:
    """Programs by version, all of which are loaded: nothing is compiled on demand, and none is dropped."""

    def __init__(self, *loaded: Loaded) -> None:
        self._loaded = {each.version: each for each in loaded}

    def add(self, loaded: Loaded) -> None:
        """Adds one, or replaces that of the same version."""
        self._loaded[loaded.version] = loaded

    def get(self, version: int) -> Loaded:
        """The program of this version."""
        found = self._loaded.get(version)
        if found is None:
            known = ", ".join(map(str, sorted(self._loaded))) or "none"
            raise NoProgram(f"there is no program version {version}; known: {known}")
        return found
