"""What an error has to do at least, so that it is no finding."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Literal

from scanbench.faults.reaction.reaction import Grade, Verdict, fulfils
from scanbench.faults.reference import ErrorRef, error_of

Wanted = Grade | Literal["none"]
"""none: nothing is required."""


@dataclass(frozen=True, slots=True)
class Required:
    """A grade for all errors, and for some of them a different one."""

    all: Wanted = "decided"
    own: Mapping[str, Wanted] = field(default_factory=dict)
    """By error, with details or without."""
    file: Callable[[ErrorRef, str], Wanted | None] | None = None
    """What the project's own requirements say of an error in a state; None: nothing. `own` comes before it."""

    def of(self, error: str, state: str = "") -> Grade | None:
        """What is required of this one; None: nothing."""
        wanted = self.own.get(error) or self.own.get(error_of(error))
        if wanted is None and self.file is not None:
            wanted = self.file(_read(error), state)
        wanted = self.all if wanted is None else wanted
        return None if wanted == "none" else wanted

    def met(self, error: str, verdict: Verdict, state: str = "") -> bool:
        """Whether the error did as much."""
        wanted = self.of(error, state)
        return wanted is None or fulfils(verdict, wanted)


def _read(error: str) -> ErrorRef:
    """What `str(ErrorRef)` wrote."""
    id, _, rest = error.partition(":")
    details = (part.partition("=") for part in rest.split(",")) if rest else ()
    return ErrorRef(id, tuple((name, value) for name, _, value in details))


REQUIRED = Required()
"""What is required where nobody says something else."""
