"""What a sequential function chart has to keep to: initial step, steps that are there and can be reached, durations."""

from collections import deque
from itertools import combinations

from scanbench.check.body.context import Body
from scanbench.program.types import BOOL
from scanbench.syntax import chart

MOST_MARKINGS = 5_000
"""Sets of active steps that are looked at; nothing is said of what a larger chart can reach."""
MOST_LOST = 3
"""Steps that are told one by one."""
Marking = frozenset[str]


def check_chart(body: Body, written: chart.Chart) -> None:
    """Reports what is wrong. A POU that keeps nothing between two calls cannot have a chart at all."""
    kind = "" if body.pou is None else body.pou.kind
    if kind == "function" and body.scope.instance is None:
        raise body.report.reject(
            "T010",
            "A chart remembers its steps, and this keeps nothing; write it in a PROGRAM or FUNCTION_BLOCK.",
            written.span,
        )
    if body.scope.find(chart.begun(written)) is None:
        raise body.report.reject(
            "T010",
            "A METHOD keeps nothing between two calls, so it has no chart. Write it in an ACTION, or in a FUNCTION_BLOCK of its own.",
            written.span,
        )
    known = {each.name.name.upper() for each in written.steps}
    if written.whole:
        _check_initial(body, written)
        _check_names(body, written, known)
    markings = reachable(written)
    if markings is not None:
        _check_reached(body, written, markings)
    for use in chart.uses(written):
        if use.name.upper() in known:
            message = f"`{use.name}` is a step, so an action has a different name; rename one."
            raise body.report.reject("T010", message, use.first.span)
    _check_actions(body, written, markings)


def _check_names(body: Body, written: chart.Chart, known: set[str]) -> None:
    for transition in written.transitions:
        for name in (*transition.sources, *transition.targets):
            if name.name.upper() not in known:
                hint = body.report.near(name.name, lambda: [each.name.name for each in written.steps], "step")
                body.report.error("T001", f"There is no step `{name.name}`.{hint}", name.span)


def _check_initial(body: Body, written: chart.Chart) -> None:
    initial = [each for each in written.steps if each.initial]
    if not initial:
        where = written.steps[0].span if written.steps else written.span
        body.report.error("T010", "A chart begins with an INITIAL_STEP; there is none.", where)
    for each in initial[1:]:
        body.report.error("D001", f"`{initial[0].name.name}` is the initial step already; there can be one.", each.span)


def reachable(written: chart.Chart) -> set[Marking] | None:
    """All sets of steps that can be active together, whatever the conditions are; None where these are too many."""
    transitions = [
        (frozenset(each.name.upper() for each in one.sources), frozenset(each.name.upper() for each in one.targets))
        for one in written.transitions
    ]
    first = frozenset(each.name.name.upper() for each in written.steps if each.initial)
    found, waiting = {first}, deque([first])
    while waiting:
        marking = waiting.popleft()
        for sources, targets in transitions:
            if sources <= marking:
                following = (marking - sources) | targets
                if following not in found:
                    found.add(following)
                    waiting.append(following)
        if len(found) > MOST_MARKINGS:
            return None
    return found


def _check_reached(body: Body, written: chart.Chart, markings: set[Marking]) -> None:
    reached = frozenset[str]().union(*markings)
    if not written.whole or not any(each.initial for each in written.steps):
        return
    lost = [each for each in written.steps if each.name.name.upper() not in reached]
    if lost and not written.transitions:
        message = (
            "This chart has no transition, so it never leaves its initial step. "
            f"Write TRANSITION FROM a TO {lost[0].name.name} := condition; END_TRANSITION."
        )
        body.report.warn("W001", message, lost[0].span)
        return
    caused = [each for each in lost if not _follows_lost(each, written, reached)] or lost[:1]
    if len(caused) > MOST_LOST:
        names = ", ".join(f"`{each.name.name}`" for each in caused)
        body.report.warn("W001", f"Nothing leads to the steps {names}; they are never active.", caused[0].span)
        return
    for step in caused:
        body.report.warn("W001", f"Nothing leads to the step `{step.name.name}`; it is never active.", step.span)


def _follows_lost(step: chart.Step, written: chart.Chart, reached: frozenset[str]) -> bool:
    """Whether a transition leads to it from a different step that is never active, so that its mistake is the one to tell."""
    own = step.name.name.upper()
    for each in written.transitions:
        sources = {source.name.upper() for source in each.sources} - {own}
        if own in (target.name.upper() for target in each.targets) and sources - reached:
            return True
    return False


def _check_actions(body: Body, written: chart.Chart, markings: set[Marking] | None) -> None:
    for use in chart.uses(written):
        if {"SD", "SL"} <= use.by_qualifier.keys():
            message = f"`{use.name}` has SD and SL, which share a memory in the standard; use one of them."
            body.report.error("T010", message, use.by_qualifier["SL"][0][1].span)
        timed = [pair for qualifier in chart.TIMED & use.by_qualifier.keys() for pair in use.by_qualifier[qualifier]]
        for (one, _), (other, second) in combinations(sorted(timed, key=lambda each: each[1].span.line), 2):
            names = {one.name.name.upper(), other.name.name.upper()}
            together = len(names) == 1 or (markings is not None and any(names <= marking for marking in markings))
            if together:
                message = f"`{use.name}` has two durations at once: here, and in step `{one.name.name}`; remove one."
                body.report.error("T010", message, second.span)
        for _, each in (pair for pairs in use.by_qualifier.values() for pair in pairs):
            if each.indicator is not None:
                type = body.place(each.indicator)[0].type
                if type != BOOL:
                    message = f"The indicator of an action is BOOL, but this is {type}; a duration belongs to L, D, SD, DS and SL only."
                    body.report.error("T002", message, each.indicator.span)
