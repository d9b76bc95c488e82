"""A sweep: every error alone from every point, each compared with the run without it. Two of them side by side: `compare.py`."""

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from scanbench.faults.reaction.react import TRACE_LIMIT, Comparison, Prepared, Twin, run_twin
from scanbench.faults.reaction.reaction import Reaction
from scanbench.faults.reaction.required_rules import Rules
from scanbench.faults.reaction.required_watch import not_checked
from scanbench.faults.reaction.steps import Point
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
    prepared: dict[int, Prepared] = {}
    known: dict[str, tuple[Comparison, Twin]] = {}
    for ref, name in left:
        error = str(ref)
        on_try(error, name)
        if name not in known:
            point = points[name]
            if point.version not in prepared:
                prepared[point.version] = Prepared(programs.get(point.version).program)
            twin = run_twin(point, (), window, programs, TRACE_LIMIT // len(points))
            known[name] = Comparison(point, programs, prepared[point.version]), twin
        comparison, twin = known[name]
        found = comparison.raised(twin, ref, AUTHOR, (), () if rules is None else rules.of(ref, name))
        if isinstance(found, Refusal):
            yield Cell(error, name, None, found.message)
        else:
            if rules is not None and name == next(iter(points)):
                note = "it is about a state that this sweep does not begin from"
                elsewhere = not_checked(rules.elsewhere(ref, points), "other_state", note)
                found = replace(found, required=(*found.required, *elsewhere))
            yield Cell(error, name, found)
