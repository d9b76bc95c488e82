"""Statements that write the same value in every branch of an IF or CASE: whichever branch runs, the same comes of it."""

from collections.abc import Iterator, Mapping, Sequence

from scanbench.faults.reaction.places import Ref, meet, parts, ref_of
from scanbench.program import program
from scanbench.program.bodies import bodies
from scanbench.program.program import Assign, CallFunction, Case, If, Place, RefOf, Stmt

Group = tuple[Assign, ...]
"""One of each branch."""


def alike(stmt: Stmt) -> Iterator[Group]:
    """The groups of a statement. Only of simple branches: assignments without calls and references, which write nothing else
    that the value or the target depends on."""
    if not isinstance(stmt, If | Case):
        return
    branches = [_simple(body) for body in bodies(stmt)]
    if not all(branches):
        return
    for first in branches[0]:
        found = [[each for each in branch if _same(each, first)] for branch in branches]
        others = [each for branch in branches for each in branch if not _same(each, first)]
        if all(len(each) == 1 for each in found) and not _disturb(others, first):
            yield tuple(each for (each,) in found)


def representatives(statements: Mapping[int, Stmt]) -> dict[int, int]:
    """By the number of a statement in a group that of the group's first one."""
    number_of = {id(stmt): number for number, stmt in statements.items()}
    found: dict[int, int] = {}
    for stmt in statements.values():
        for group in alike(stmt):
            numbers = [number_of[id(each)] for each in group if id(each) in number_of]
            found |= dict.fromkeys(numbers, min(numbers, default=0))
    return found


def _simple(body: Sequence[Stmt]) -> tuple[Assign, ...]:
    """The statements of a branch; none where not all are simple."""
    found = tuple(each for each in body if isinstance(each, Assign) and _is_simple(each))
    return found if len(found) == len(body) else ()


def _is_simple(stmt: Assign) -> bool:
    for each in (*parts(stmt.value), *parts(stmt.target)):
        if isinstance(each, CallFunction | RefOf | program.Sequence):
            return False
        if isinstance(each, Place) and (each.slot is not None or each.reference is not None):
            return False
    return True


def _same(one: Assign, other: Assign) -> bool:
    return one.target == other.target and one.value == other.value


def _disturb(others: Sequence[Assign], first: Assign) -> bool:
    """Whether different statements write what this one reads or writes."""
    used: list[Ref] = [ref_of(each) for each in (*parts(first.value), *parts(first.target)) if isinstance(each, Place)]
    return any(meet(ref_of(other.target), ref) for other in others for ref in used)
