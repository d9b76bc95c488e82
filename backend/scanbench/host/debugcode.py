"""Debugged code for the programs of one host: built while the loop runs, put in place in its seam."""

from dataclasses import dataclass

from scanbench.engines.debug import DebugEngine
from scanbench.engines.probe import BadProbe, MakeProbed, Probe, ProbedEngine
from scanbench.program.program import Program
from scanbench.runtime.programs import Loaded


@dataclass(frozen=True, slots=True)
class Debuggable:
    """The debug flavour of a program that is loaded; or why there is none."""

    loaded: Loaded
    program: Program | None
    engine: DebugEngine | None
    message: str = ""

    def put_in_place(self) -> None:
        """Puts the code in place, in the seam. An engine that is there already stays: somebody may have listened to it."""
        if self.loaded.debug is None and self.engine is not None:
            self.loaded.fresh = self.program
            self.loaded.debug = self.engine


@dataclass(frozen=True, slots=True)
class StandAgain:
    """Asks for what needs debugged code: to be halted before a statement, or to show one of the past, as when the last process ended."""


@dataclass(frozen=True, slots=True)
class Probed:
    """Code with probes, for the program that is loaded."""

    loaded: Loaded
    engine: ProbedEngine


def probed(make: MakeProbed | None, loaded: Loaded, probes: tuple[Probe, ...]) -> ProbedEngine | None:
    """Code with probes for what is loaded; None where there can be none."""
    try:
        return make(loaded.renewed(), loaded.memory, probes) if make is not None else None
    except BadProbe:
        return None
