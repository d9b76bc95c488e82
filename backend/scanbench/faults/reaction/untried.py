"""What a project requires and what a run did not try: the error could not be raised, or the state is none of those that there are."""

from collections.abc import Collection, Iterable, Mapping
from difflib import get_close_matches

from scanbench.faults.inject import ACTIVE, INSTANCES
from scanbench.faults.reaction.reaction import RequiredResult, Unchecked
from scanbench.faults.reaction.required_rules import Made, Rules
from scanbench.faults.reaction.required_watch import not_checked, result
from scanbench.faults.reaction.steps import Point
from scanbench.faults.reference import ErrorRef, find_error
from scanbench.problems import perhaps
from scanbench.runtime.command import Refusal

OWN = ("Start", "Now")
"""The names of the state from which the command line and a server begin when nobody chooses one: there is always such a state."""
_ELSEWHERE = "it is about a state that this sweep does not begin from"
_NAMED = 5
"""States that a message names, where none has a name that is near."""
_BY_HAND = "a PLC that somebody works with is in none of the states of a sweep"


class Untried:
    """Of a sweep: what is required of an error and was not tried."""

    def __init__(self, rules: Rules, points: Mapping[str, Point], known: Collection[str] = ()) -> None:
        """`known`: further states that there are, from which the sweep does not begin."""
        self._rules, self._points = rules, points
        self._named = tuple(dict.fromkeys((*points, *known)))
        self._known = {each.casefold(): each for each in (*OWN, *self._named)}
        self._begun = {each.casefold() for each in points}

    def refused(self, ref: ErrorRef, name: str, why: str) -> tuple[RequiredResult, ...]:
        """What is required of an error that could not be raised from this point. Where it is present in the point, and another one that
        the same is required in is without it, that one tries it."""
        free = [other for other in self._points if other != name and not self._is_present(ref, other)]
        elsewhere = {id(made) for other in free for made in self._rules.of(ref, other)}
        present = self._is_present(ref, name)
        return tuple(
            _result(made, "present" if present and id(made) in elsewhere else "not_raised", why)
            for made in self._rules.of(ref, name)
            if made.grade != "none"
        )

    def elsewhere(self, ref: ErrorRef) -> tuple[RequiredResult, ...]:
        """What is required of it in states from which the sweep does not begin. That a state does not exist is a finding: nobody knows
        which one was meant."""
        return tuple(
            _result(made, *found)
            for states, every in self._rules.by_states(ref)
            if (found := self._missing(states)) is not None
            for made in every
            if made.grade != "none"
        )

    def _missing(self, states: Iterable[str]) -> tuple[Unchecked, str] | None:
        unknown = [each for each in states if each.casefold() not in self._known]
        if unknown:
            named = {each.casefold(): each for each in self._named}  # of the others there may be none here
            near = [named[each] for one in unknown for each in get_close_matches(one.casefold(), named)]
            some = " and ".join(f"`{each}`" for each in unknown)
            there = ", ".join(f"`{each}`" for each in self._named[:_NAMED])
            return "no_state", f"there is no state {some}.{perhaps(dict.fromkeys(near)) or f' There are: {there}.'}"
        return None if any(each.casefold() in self._begun for each in states) else ("other_state", _ELSEWHERE)

    def _is_present(self, ref: ErrorRef, name: str) -> bool:
        journal, entry = self._points[name].journal, find_error(self._rules.program.layout.model, ref.id)
        if isinstance(entry, Refusal) or not entry.several:
            return ref.id in journal.derived(ACTIVE)
        present = (raised.ref for raised in journal.derived(INSTANCES).values())
        return any(each.id == ref.id and set(ref.details) <= set(each.details) for each in present)


def by_hand(rules: Rules, ref: ErrorRef) -> tuple[RequiredResult, ...]:
    """What is required in certain states only, of an error that was raised on a PLC that somebody works with."""
    return tuple(each for _, every in rules.by_states(ref) for each in not_checked(every, "other_state", _BY_HAND))


def _result(made: Made, reason: Unchecked, note: str) -> RequiredResult:
    if made.invalid and reason == "other_state":
        return result(made, "not_checked", "invalid", made.invalid)
    return result(made, "not_checked", reason, note)
