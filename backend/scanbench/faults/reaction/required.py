"""What an error has to do at least, so that it is no finding."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from scanbench.faults.reaction.reaction import Grade, Verdict, fulfils
from scanbench.faults.reference import ErrorRef, named_reference

Wanted = Grade | Literal["none"]
"""none: nothing is required."""


@dataclass(frozen=True, slots=True)
class Required:
    """A grade for all errors, and for some of them a different one."""

    all: Wanted = "decided"
    own: Callable[[ErrorRef], Wanted | None] | None = None
    """What somebody says of one error; None: nothing."""
    file: Callable[[ErrorRef, str], Wanted | None] | None = None
    """What the project's own requirements say of an error in a state; None: nothing. `own` comes before it."""

    def of(self, error: str, state: str = "") -> Grade | None:
        """What is required of this one; None: nothing."""
        ref = named_reference(error)
        wanted = None if self.own is None else self.own(ref)
        if wanted is None and self.file is not None:
            wanted = self.file(ref, state)
        wanted = self.all if wanted is None else wanted
        return None if wanted == "none" else wanted

    def met(self, error: str, verdict: Verdict, state: str = "") -> bool:
        """Whether the error did as much."""
        wanted = self.of(error, state)
        return wanted is None or fulfils(verdict, wanted)


REQUIRED = Required()
"""What is required where nobody says something else."""
