"""Loops whose checks are written down afterwards: LLVM can then make vectors of the rounds.

In such a loop a check limits the value, and notes how far above the lower bound it was at most (below it the distance wraps, and is
large); no branch, no call. Where that was too far for any of them when the rounds are over, the rounds are gone through once more,
storing nothing and recording each violation in its order. So everything that a check looks at has to be what it was: it is nothing that
the loop writes. And nothing may trap in a round.

Where the rounds read nothing at all that they write, they are run as if nothing were outside, without limiting anything; if something
was, all of them are run once more with their checks, and store over what was wrong.
"""

from collections.abc import Callable, Iterable
from functools import reduce

from scanbench.engines.native.effects import keeps, plain
from scanbench.engines.native.emit_body import Body, Farthest, counter_key
from scanbench.engines.native.emit_function import UNLIKELY
from scanbench.engines.native.emit_operators import intrinsic
from scanbench.engines.native.emit_places import address
from scanbench.engines.native.flavour import RUN
from scanbench.program.layout import Layout
from scanbench.program.program import (
    Assign,
    Base,
    Binary,
    Compare,
    Const,
    Convert,
    Expr,
    For,
    Intrinsic,
    Limit,
    Load,
    Place,
    Unary,
)
from scanbench.program.types import Elementary

PURE = ("MIN", "MAX", "SEL")


def deferrable(body: Body, loop: For) -> bool:
    """Whether the checks of the loop may be recorded after its rounds, unless something in it can trap."""
    if body.unit.flavour is not RUN or loop.exits or not plain(loop.variable) or body.farthest is not None:
        return False
    targets: list[Place] = []
    values: list[Expr] = []
    for each in loop.body:
        if not isinstance(each, Assign):
            return False
        targets.append(each.target)
        values.append(each.value)
    parts = list(_parts(values, targets))
    if not all(_simple(each) for each in (*parts, *targets)):
        return False
    written = {each.variable for each in (*targets, loop.variable)}
    checks = [each for each in parts if isinstance(each, Limit) and each.site]
    counts = keeps(frozenset(each.variable for each in targets), loop.variable)
    return bool(checks) and counts and all(_stays(each, loop, written) for each in checks)


def repeatable(loop: For) -> bool:
    """Whether the rounds may be gone through once more with the same results: they read nothing that they write. And nothing goes wrong
    meanwhile where a value is outside: none is an index, and none divides."""
    targets = [each.target for each in loop.body if isinstance(each, Assign)]
    values = [each.value for each in loop.body if isinstance(each, Assign)]
    parts = list(_parts(values, targets))
    written = {each.variable for each in targets}
    indices = [index.value for place in (*parts, *targets) if isinstance(place, Place) for index in place.indices]
    reads = (each for each in parts if isinstance(each, Place))
    return (
        all(each.variable and each.variable not in written for each in reads)
        and all(_counts(each, loop) for each in _parts(indices) if isinstance(each, Limit))
        and not any(isinstance(each, Binary) and each.op in ("div", "mod") for each in parts)
    )


def _counts(check: Limit, loop: For) -> bool:
    """Whether the check looks at the counter, which keeps within its subrange."""
    return (
        check.site != 0
        and isinstance(check.value, Load)
        and counter_key(check.value.place) == counter_key(loop.variable)
    )


def rounds(body: Body, emit: Callable[[], str], again: Callable[[], str], optimistic: bool) -> str | None:
    """Emits the loop with `emit`, and with `again` what records; gives what `emit` gives, or None if something in it can trap
    or nothing is checked. `optimistic`: values are not limited in `emit`, and `again` is the whole loop with all its checks."""
    text = body.text
    mark = text.mark()
    farthest: list[Farthest] = []
    body.farthest, body.optimistic = farthest, optimistic
    try:
        counter = emit()
    finally:
        body.farthest, body.optimistic = None, False
    if not farthest or text.failed_since(mark):
        text.undo(mark)
        return None
    text.lines[mark.lines : mark.lines] = [f"  store {each.type} 0, ptr {each.pointer}" for each in farthest]
    outside = [
        text.op(f"icmp ugt {each.type} {text.op(f'load {each.type}, ptr {each.pointer}')}, {each.most}")
        for each in farthest
    ]
    late, on = text.name("late"), text.name("on")
    text.choose(reduce(lambda one, other: text.op(f"or i1 {one}, {other}"), outside), late, on, UNLIKELY)
    text.begin(late)
    again()
    text.go(on)
    text.begin(on)
    return counter


def record(body: Body, loop: For) -> None:
    """What the checks of one round record, in the order in which they are made; nothing is stored."""
    for each in loop.body:
        assert isinstance(each, Assign)
        body.scalar(each.value)
        address(body, each.target)


def note(body: Body, distance: str, type: str, most: str) -> None:
    """A check found a value at this distance above the lower bound, as an unsigned number; `most` is what may be."""
    text, farthest = body.text, body.farthest
    assert farthest is not None
    if body.optimistic:  # what was computed from a value outside may be anything
        distance = text.op(f"freeze {type} {distance}")
    pointer = text.alloca(type, 8)
    farthest.append(Farthest(pointer, type, most))
    before = text.op(f"load {type}, ptr {pointer}")
    after = intrinsic(body, "umax", type, before, distance)
    text.do(f"store {type} {after}, ptr {pointer}")


def _parts(values: Iterable[Expr], places: Iterable[Place] = ()) -> Iterable[Expr | Place]:
    """All expressions and read places in these, and in the indices."""
    for place in places:
        yield from _parts(index.value for index in place.indices)
    for value in values:
        yield value
        match value:
            case Load(place):
                yield place
                yield from _parts((), (place,))
            case Unary(operand=inner) | Convert(operand=inner) | Limit(value=inner):
                yield from _parts((inner,))
            case Binary(left=left, right=right) | Compare(left=left, right=right):
                yield from _parts((left, right))
            case Intrinsic(args=args):
                yield from _parts(args)


def _simple(part: Expr | Place) -> bool:
    if isinstance(part, Place):
        fixed = all(isinstance(each, int) for index in part.indices for each in (index.low, index.high, index.stride))
        # the header changes while something is recorded
        own = part.base is not Base.IMAGE or part.offset >= Layout.HEADER_SIZE
        found = part.slot is None and part.reference is None and part.bit is None
        return fixed and own and found and isinstance(part.type, Elementary) and not part.variable.startswith("@")
    if isinstance(part, Intrinsic):
        return part.name in PURE and isinstance(part.type, Elementary)
    return isinstance(part, Const | Load | Unary | Binary | Compare | Convert | Limit) and isinstance(
        part.type, Elementary
    )


def _stays(check: Limit, loop: For, written: set[str]) -> bool:
    """Whether the check sees the same after the loop as in the round; the counter is one that each loop has for itself."""
    read = [each for each in _parts((check.value,)) if isinstance(each, Place)]
    own = counter_key(loop.variable)
    return all(
        (each.variable and each.variable not in written) or (plain(each) and counter_key(each) == own) for each in read
    )
