"""A sweep: every error alone from every point, each compared with the run without it. Two of them side by side: `compare.py`."""

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from scanbench.faults.reaction.react import TRACE_LIMIT, Comparison, Prepared, Twin, run_twin
from scanbench.faults.reaction.reaction import Reaction, RequiredResult
from scanbench.faults.reaction.required_rules import Rules
from scanbench.faults.reaction.steps import Point
from scanbench.faults.reaction.untried import Untried
from scanbench.faults.reference import ErrorRef
from scanbench.runtime.command import Refusal
from scanbench.runtime.programs import Programs

AUTHOR = "sweep"


@dataclass(frozen=True, slots=True)
class Cell:
    """One error from one point; without a reaction `note` says why it could not be raised or run."""

    error: str
    """With the details that were chosen, as `ErrorRef` writes them."""
    point: str
    reaction: Reaction | None
    note: str = ""
    untried: tuple[RequiredResult, ...] = ()
    """Without a reaction: what is required all the same, none of it checked."""

    @property
    def required(self) -> tuple[RequiredResult, ...]:
        """What the project requires, and what became of it."""
        return self.untried if self.reaction is None else self.reaction.required

    @property
    def unmet(self) -> tuple[str, ...]:
        """What is not as the project requires it, each in a line."""
        if self.reaction is not None:
            return self.reaction.unmet
        return tuple(each.text for each in self.untried if each.is_finding)


def sweep(
    points: Mapping[str, Point],
    errors: Sequence[ErrorRef],
    window: int,
    programs: Programs,
    done: Collection[tuple[str, str]] = (),
    on_try: Callable[[str, str], None] = lambda error, point: None,
    rules: Rules | None = None,
    known: Collection[str] = (),
) -> Iterator[Cell]:
    """Raises errors in the order given, each from all points, but for the pairs (error, point) in `done`.

    All points are of one program. Details that are not given are the catalogue's defaults. The run without an error is run once
    for each point. What `rules` require is checked in the same runs; `known` are further states that they may name.
    """
    sweeper = Sweeper(points, window, programs, rules, known)
    for ref, name in pairs_of(points, errors, done):
        on_try(str(ref), name)
        yield sweeper.cell(ref, name)


def pairs_of(
    points: Collection[str], errors: Sequence[ErrorRef], done: Collection[tuple[str, str]]
) -> list[tuple[ErrorRef, str]]:
    """What a sweep tries, in its order."""
    return [(error, name) for error in errors for name in points if (str(error), name) not in done]


class Sweeper:
    """Raises errors from points, whatever the order; what all errors of a point have in common is made once."""

    def __init__(
        self, points: Mapping[str, Point], window: int, programs: Programs, rules: Rules | None = None,
        known: Collection[str] = (),
    ) -> None:  # fmt: skip
        self._points, self._window, self._programs, self._rules = points, window, programs, rules
        self._untried = None if rules is None else Untried(rules, points, known)
        self._prepared: dict[int, Prepared] = {}
        self._known: dict[str, tuple[Comparison, Twin]] = {}

    def cell(self, ref: ErrorRef, name: str) -> Cell:
        """One error from one point."""
        comparison, twin = self._at(name)
        found = comparison.raised(twin, ref, AUTHOR, (), () if self._rules is None else self._rules.of(ref, name))
        untried = self._untried
        if untried is None:
            return (
                Cell(str(ref), name, None, found.message) if isinstance(found, Refusal) else Cell(str(ref), name, found)
            )
        # What is about no state of this sweep is told once.
        elsewhere = untried.elsewhere(ref) if name == next(iter(self._points)) else ()
        if isinstance(found, Refusal):
            return Cell(str(ref), name, None, found.message, (*untried.refused(ref, name, found.message), *elsewhere))
        return Cell(str(ref), name, replace(found, required=(*found.required, *elsewhere)))

    def _at(self, name: str) -> tuple[Comparison, Twin]:
        if name not in self._known:
            point = self._points[name]
            if point.version not in self._prepared:
                self._prepared[point.version] = Prepared(self._programs.get(point.version).program)
            twin = run_twin(point, (), self._window, self._programs, TRACE_LIMIT // len(self._points))
            self._known[name] = Comparison(point, self._programs, self._prepared[point.version]), twin
        return self._known[name]
