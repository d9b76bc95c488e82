"""A sweep: every error alone from every point, each compared with the run without it. Two of them side by side: `compare.py`."""

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from scanbench.faults.reaction.react import TRACE_LIMIT, Comparison, Prepared, Twin, run_twin
from scanbench.faults.reaction.reaction import Reaction
from scanbench.faults.reaction.required_rules import Rules
from scanbench.faults.reaction.required_watch import not_checked
from scanbench.faults.reaction.steps import Point
from scanbench.faults.reference import ErrorRef
from scanbench.problems import perhaps
from scanbench.runtime.command import Refusal
from scanbench.runtime.programs import Programs

AUTHOR = "sweep"
_ELSEWHERE = "it is about a state that this sweep does not begin from"


@dataclass(frozen=True, slots=True)
class Cell:
    """One error from one point; without a reaction `note` says why it could not be raised or run."""

    error: str
    """With the details that were chosen, as `ErrorRef` writes them."""
    point: str
    reaction: Reaction | None
    note: str = ""


def sweep(
    points: Mapping[str, Point],
    errors: Sequence[ErrorRef],
    window: int,
    programs: Programs,
    done: Collection[tuple[str, str]] = (),
    on_try: Callable[[str, str], None] = lambda error, point: None,
    rules: Rules | None = None,
) -> Iterator[Cell]:
    """Raises errors in the order given, each from all points, but for the pairs (error, point) in `done`.

    All points are of one program. Details that are not given are the catalogue's defaults. The run without an error is run once
    for each point. What `rules` require is checked in the same runs.
    """
    left = [(error, name) for error in errors for name in points if (str(error), name) not in done]
    sweeper = Sweeper(points, window, programs, rules)
    for ref, name in left:
        on_try(str(ref), name)
        yield sweeper.cell(ref, name)


class Sweeper:
    """Raises errors from points, whatever the order; what all errors of a point have in common is made once."""

    def __init__(
        self, points: Mapping[str, Point], window: int, programs: Programs, rules: Rules | None = None
    ) -> None:  # fmt: skip
        self._points, self._window, self._programs, self._rules = points, window, programs, rules
        self._prepared: dict[int, Prepared] = {}
        self._known: dict[str, tuple[Comparison, Twin]] = {}

    def cell(self, ref: ErrorRef, name: str) -> Cell:
        """One error from one point."""
        comparison, twin = self._at(name)
        rules = self._rules
        found = comparison.raised(twin, ref, AUTHOR, (), () if rules is None else rules.of(ref, name))
        if isinstance(found, Refusal):
            return Cell(str(ref), name, None, found.message)
        if rules is not None and name == next(iter(self._points)):
            near = dict.fromkeys(each for _, names in rules.unknown_states(self._points) for each in names)
            note = f"it is about a state that this sweep does not begin from.{perhaps(near)}" if near else _ELSEWHERE
            elsewhere = not_checked(rules.elsewhere(ref, self._points), "other_state", note)
            found = replace(found, required=(*found.required, *elsewhere))
        return Cell(str(ref), name, found)

    def _at(self, name: str) -> tuple[Comparison, Twin]:
        if name not in self._known:
            point = self._points[name]
            if point.version not in self._prepared:
                self._prepared[point.version] = Prepared(self._programs.get(point.version).program)
            twin = run_twin(point, (), self._window, self._programs, TRACE_LIMIT // len(self._points))
            self._known[name] = Comparison(point, self._programs, self._prepared[point.version]), twin
        return self._known[name]
