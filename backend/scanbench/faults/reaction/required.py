"""What an error has to do at least, so that it is no finding."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from scanbench.faults.reaction.reaction import Grade, Verdict, fulfils
from scanbench.faults.reference import error_of

Wanted = Grade | Literal["none"]
"""none: nothing is required."""


@dataclass(frozen=True, slots=True)
class Required:
    """A grade for all errors, and for some of them a different one."""

    all: Wanted = "decided"
    own: Mapping[str, Wanted] = field(default_factory=dict)
    """By error, with details or without."""

    def of(self, error: str) -> Grade | None:
        """What is required of this one; None: nothing."""
        wanted = self.own.get(error, self.own.get(error_of(error), self.all))
        return None if wanted == "none" else wanted

    def met(self, error: str, verdict: Verdict) -> bool:
        """Whether the error did as much."""
        wanted = self.of(error)
        return wanted is None or fulfils(verdict, wanted)


REQUIRED = Required()
"""What is required where nobody says something else."""
