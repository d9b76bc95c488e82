"""Copies of whole arrays and structures: each value with a subrange in them is checked where the copy lands.

What is copied is kept aside, each value in it is brought to what its policy says, and that is stored. So a policy that stops the program stores nothing, and
one that holds has the old value to go on with.
"""

from collections.abc import Iterator
from dataclasses import replace

from scanbench.check.body.context import Body
from scanbench.check.body.harmless import again_at
from scanbench.check.body.subrange_checks import arriving, has_subranges, limit
from scanbench.problems import Span
from scanbench.program.program import Assign, Const, Expr, For, Index, Load, Place, Sequence, Stmt
from scanbench.program.sites import TrapKind
from scanbench.program.types import LINT, ArrayType, Record, Subrange, Type, base_of


def landed(body: Body, value: Expr, type: Type, span: Span, what: str, target: Place | None = None) -> Expr:
    """A whole array or structure on its way into a variable, `what`, at `target` where that is known."""
    if isinstance(type, Subrange) or not has_subranges(type) or body.pou is None or not body.effects.checks:
        return value
    kept = body.temporary(type, span)
    last = None if target is None else again_at(target)
    checks = tuple(_checks(body, kept, last, span, what))
    return Sequence((Assign(kept, value, span), *checks), Load(kept)) if checks else value


def _checks(body: Body, place: Place, last: Place | None, span: Span, what: str) -> Iterator[Stmt]:
    """Statements that bring what is at `place` to what its policies say; at `last` are the values that it had."""
    match place.type:
        case Subrange() as type:
            plain = Load(replace(place, type=base_of(type)))
            value = limit(body, plain, type, span, what)
            if last is not None:
                value = arriving(body, value, place, span, last)
            if value != plain:
                yield Assign(place, value, span)
        case ArrayType() as type if has_subranges(type):
            yield from _elements(body, place, last, span, what)
        case Record() as type if has_subranges(type):
            for member in type.members.values():
                if has_subranges(member.type):
                    parts = [
                        None
                        if each is None
                        else replace(each, type=member.type, offset=each.offset + member.offset, bit=member.bit)
                        for each in (place, last)
                    ]
                    assert parts[0] is not None
                    yield from _checks(body, parts[0], parts[1], span, f"{what}.{member.name}")


def _elements(body: Body, place: Place, last: Place | None, span: Span, what: str) -> Iterator[Stmt]:
    type = place.type
    assert isinstance(type, ArrayType)
    counter = body.temporary(LINT, span)
    trap = body.trap(TrapKind.LOOP, span, "this copy has more elements than a scan may go through")
    one = Index(Load(counter), 0, type.count - 1, type.element.size, trap)
    parts = [
        None if each is None else replace(each, type=type.element, indices=(*each.indices, one))
        for each in (place, last)
    ]
    assert parts[0] is not None
    inner = tuple(_checks(body, parts[0], parts[1], span, f"{what}[]"))
    if inner:
        yield For(counter, Const(LINT, 0), Const(LINT, type.count - 1), Const(LINT, 1), inner, False, trap, span)
