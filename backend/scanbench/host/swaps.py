"""What builds hand over to the loop, which takes it in its seam."""

from dataclasses import dataclass
from typing import Protocol

from scanbench.engines.engine import Engine
from scanbench.program.program import Program
from scanbench.runtime.command import Refusal
from scanbench.runtime.programs import Loaded
from scanbench.wire.host import Sources


@dataclass(frozen=True, slots=True)
class Swap:
    """A compiled program, ready to take over."""

    ref: int
    loaded: Loaded
    sources: Sources
    author: str


@dataclass(frozen=True, slots=True)
class BuildRefused:
    """A build that came to nothing."""

    ref: int
    message: str


@dataclass(frozen=True, slots=True)
class Recode:
    """Optimised code of a program, on the same memory; no engine when it was given up."""

    program: Program
    engine: Engine | None


@dataclass(frozen=True, slots=True)
class Copied:
    """A copy of the run was written, or could not be."""

    ref: int
    refusal: Refusal | None


class Optimising(Protocol):
    """Makes optimised code in the background."""

    @property
    def optimising(self) -> bool:
        """Whether optimised code is still to come."""
