"""What is told of comparisons of runs, and of runs that are repeated with a change."""

from dataclasses import dataclass
from typing import Literal

from scanbench.history.contract import Divergence
from scanbench.public import Public


@dataclass(frozen=True, slots=True)
class Comparison(Public):
    """How far a comparison of the runs of instances `a` and `b` is, and what came of it. The last 20 of an instance are kept."""

    id: int
    a: int
    b: int
    by: str
    done: int = 0
    of: int = 0
    """Scans."""
    result: Divergence | None = None
    message: str = ""
    """Why nothing came of it."""
    type: Literal["comparison"] = "comparison"


@dataclass(frozen=True, slots=True)
class Rerun(Public):
    """How far a replay with a change is, and the instance that came of it."""

    id: int
    by: str
    name: str
    done: int = 0
    of: int = 0
    instance: int | None = None
    refused: tuple[str, ...] = ()
    """Commands that were not taken this time, and why."""
    message: str = ""
    """Why nothing came of it."""
    type: Literal["rerun"] = "rerun"
