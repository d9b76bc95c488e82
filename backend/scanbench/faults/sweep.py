"""A sweep: every error alone from every point, each compared with the run without it. And two sweeps side by side."""

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

from scanbench.faults.observed import ObservedPrograms
from scanbench.faults.react import TRACE_LIMIT, Comparison, Point, Prepared, Twin, run_twin
from scanbench.faults.reaction import Reaction, Verdict
from scanbench.faults.reference import ErrorRef
from scanbench.runtime.command import Refusal

AUTHOR = "sweep"


@dataclass(frozen=True, slots=True)
class Cell:
    """One error from one point; without a reaction `note` says why it could not be raised or run."""

    error: str
    point: str
    reaction: Reaction | None
    note: str = ""


def sweep(
    points: Mapping[str, Point],
    errors: Sequence[str],
    window: int,
    programs: ObservedPrograms,
    done: Collection[tuple[str, str]] = (),
    on_try: Callable[[str, str], None] = lambda error, point: None,
) -> Iterator[Cell]:
    """Raises errors in the order given, each from all points, but for the pairs (error, point) in `done`.

    All points are of one program. Details are the catalogue's defaults. The run without an error is run once for each point.
    """
    left = [(error, name) for error in errors for name in points if (error, name) not in done]
    prepared: dict[int, Prepared] = {}
    known: dict[str, tuple[Comparison, Twin]] = {}
    for error, name in left:
        on_try(error, name)
        if name not in known:
            point = points[name]
            if point.version not in prepared:
                prepared[point.version] = Prepared(programs.get(point.version).program)
            twin = run_twin(point, (), window, programs, TRACE_LIMIT // len(points))
            known[name] = Comparison(point, programs, prepared[point.version]), twin
        comparison, twin = known[name]
        found = comparison.raised(twin, ErrorRef(error), AUTHOR)
        if isinstance(found, Refusal):
            yield Cell(error, name, None, found.message)
        else:
            yield Cell(error, name, found)


# ---- two sweeps ----------------------------------------------------------------------------------------------------

Kind = Literal["same", "better", "worse", "slower", "faster", "new", "gone"]
_WORTH: Mapping[Verdict, int] = {"never_read": 0, "no_effect": 1, "reacted": 2, "stopped": 2}


@dataclass(frozen=True, slots=True)
class Outcome:
    """What a sweep said about one error from one state; `scans` until the first effect."""

    error: str
    state: str
    verdict: Verdict | None
    """None: it could not be raised."""
    scans: int | None = None


@dataclass(frozen=True, slots=True)
class SweepChange:
    """One error from one state in two sweeps; None where a sweep has no verdict."""

    error: str
    state: str
    before: Verdict | None
    after: Verdict | None
    scans_before: int | None
    scans_after: int | None
    change: Kind


def compare(before: Iterable[Outcome], after: Iterable[Outcome]) -> tuple[SweepChange, ...]:
    """Pairs what has the same error and state: in the order of `after`, then what is only in `before`."""
    old = {(each.error, each.state): each for each in before}
    new = {(each.error, each.state): each for each in after}
    changes = []
    for error, state in [*new, *(key for key in old if key not in new)]:
        was, now = (side.get((error, state), Outcome(error, state, None)) for side in (old, new))
        changes.append(SweepChange(error, state, was.verdict, now.verdict, was.scans, now.scans, _kind(was, now)))
    return tuple(changes)


def _kind(was: Outcome, now: Outcome) -> Kind:
    if was.verdict is None or now.verdict is None:
        return "same" if was.verdict is now.verdict else "new" if was.verdict is None else "gone"
    worth = _WORTH[now.verdict] - _WORTH[was.verdict]
    if worth:
        return "better" if worth > 0 else "worse"
    if was.scans is None or now.scans is None or was.scans == now.scans:
        return "same"
    return "slower" if now.scans > was.scans else "faster"
