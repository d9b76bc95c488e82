"""Loops whose checks are written down afterwards: LLVM can then make vectors of the rounds.

In such a loop a check limits the value and notes in one flag that something was outside; no branch, no call. Where the flag is
set when the rounds are over, the rounds are gone through once more, storing nothing and recording each violation in its order. So
everything that a check looks at has to be what it was: it is nothing that the loop writes. And nothing may trap in a round.
"""

from collections.abc import Callable, Iterable

from scanbench.engines.native.effects import keeps, plain
from scanbench.engines.native.emit_body import Body, counter_key
from scanbench.engines.native.emit_function import UNLIKELY
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
    if body.unit.flavour is not RUN or loop.exits or not plain(loop.variable) or body.outside:
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
    checks = [each for each in parts if isinstance(each, Limit)]
    counts = keeps(frozenset(each.variable for each in targets), loop.variable)
    return bool(checks) and counts and all(_stays(each, loop, written) for each in checks)


def rounds(body: Body, emit: Callable[[], str], again: Callable[[], str]) -> str | None:
    """Emits the loop with `emit`, and with `again` what records; gives what `emit` gives, or None if something in it can trap
    or nothing is checked."""
    text = body.text
    mark = text.mark()
    body.outside = text.alloca("i8", 1)
    text.do(f"store i8 0, ptr {body.outside}, align 1")
    try:
        counter = emit()
        nothing = not any(line.endswith(f"ptr {body.outside}, align 1") for line in text.lines[mark.lines + 1 :])
        if nothing or text.failed_since(mark):
            text.undo(mark)
            return None
        any_outside = text.op(f"load i8, ptr {body.outside}, align 1")
    finally:
        body.outside = ""
    late, on = text.name("late"), text.name("on")
    text.choose(text.op(f"icmp ne i8 {any_outside}, 0"), late, on, UNLIKELY)
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


def note(body: Body, outside: str) -> None:
    """A check found this."""
    text = body.text
    before = text.op(f"load i8, ptr {body.outside}, align 1")
    after = text.op(f"or i8 {before}, {text.op(f'zext i1 {outside} to i8')}")
    text.do(f"store i8 {after}, ptr {body.outside}, align 1")


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
