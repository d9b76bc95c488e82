"""Subrange checks that the checker checks by itself: where a subrange variable is read, and where one is assigned.

A value outside of its subrange is brought back to the nearer bound and recorded (`Limit`), so that the program goes on
with what it may count on. What can be proven needless is listed, but not run; `redundant_checks.py` finds more of it.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace

from scanbench.check.body import fold
from scanbench.check.body.context import Body
from scanbench.check.body.harmless import again, again_at, limited
from scanbench.check.body.notes import note_of
from scanbench.check.body.true_values import Way, elementary, value_range, wrapped_valid, written
from scanbench.check.declare.scopes import place_of
from scanbench.problems import Span
from scanbench.program.program import (
    Assign,
    Base,
    CallFunction,
    Compare,
    Const,
    Expr,
    Halt,
    If,
    Intrinsic,
    Limit,
    Load,
    Place,
    Sequence,
    Stmt,
    Violates,
)
from scanbench.program.sites import CheckSite, TrapKind
from scanbench.program.types import (
    BOOL,
    ArrayType,
    Elementary,
    Kind,
    Member,
    Record,
    Subrange,
    Type,
    actual_of,
    base_of,
    has_instance,
)
from scanbench.syntax import tree

LIMITED = ("limit", "hold")
"""Policies under which a value that is read is limited."""


def read(body: Body, place: Place, span: Span, variable: str) -> Expr:
    """The value of a variable; that of a subrange variable is checked, and has the base type."""
    if not isinstance(place.type, Subrange):
        return Load(place)
    if not body.effects.checks:
        return Load(replace(place, type=base_of(place.type)))
    return limit(body, Load(place), place.type, span, variable)


def plain(body: Body, expr: Expr, span: Span, variable: str = "the value") -> Expr:
    """Checks a subrange value that comes from elsewhere than `read`."""
    if not isinstance(expr.type, Subrange):
        return expr
    match expr:
        case Load(place):
            return read(body, place, span, variable)
        case CallFunction(type=Elementary() as type):
            return replace(expr, type=base_of(type))  # checked where the function assigned it
        case Sequence(first, value):
            return Sequence(first, plain(body, value, span, variable))
    raise AssertionError(expr)


def into(body: Body, expr: Expr, type: Subrange, span: Span, variable: str) -> Expr:
    """A value of the base type, checked on its way into a subrange variable."""
    if isinstance(expr, Const):
        value = expr.value
        if isinstance(value, int) and not type.low <= value <= type.high:
            raise body.report.reject("S004", f"{value} is outside of {_named(type)}.", span)
    true = Way(body, span, variable, policy_of(body, type)).true(expr, base_of(type))
    return limit(body, true, type, span, variable)


def limit(body: Body, expr: Expr, type: Subrange, span: Span, variable: str) -> Expr:
    """The value as its policy wants it, of the base type; that is `expr` itself where it needs no check. `expr` may be of a
    wider type (`Way.true`)."""
    if body.pou is None:
        return expr  # among declarations everything is constant
    base, policy = base_of(type), policy_of(body, type)
    if policy not in LIMITED:
        expr = Load(replace(expr.place, type=base)) if isinstance(expr, Load) else expr
        if policy == "off":
            return expr
    site = CheckSite(span, body.scope.pou, variable, type.low, type.high, _proof(expr, type))
    number = body.report.check(site)
    if site.needless:
        return Load(replace(expr.place, type=base)) if isinstance(expr, Load) else expr
    bound = bound_of(body, expr.place) if isinstance(expr, Load) else None
    if policy in LIMITED:
        return Limit(base, expr, type.low, type.high, number, bound)
    kept = body.temporary(elementary(expr), span)
    outside = Violates(BOOL, Load(kept), type.low, type.high, number, bound)
    if policy == "report":
        then: Stmt = Assign(body.temporary(BOOL, span), outside, span)
    else:
        trap = body.trap(TrapKind.BOUNDS, span, f"{variable} is outside of {type.low}..{type.high}")
        then = If(((outside, (Halt(trap, span),)),), (), span)
    return Sequence((Assign(kept, expr, span), then), fold.convert(base, Load(kept)))


def has_subranges(type: Type) -> bool:
    """Whether a value of the type is one with a subrange, or has such elements or members."""
    match type:
        case ArrayType(element=element):
            return has_subranges(element)
        case Record(kind=Kind.STRUCT):
            inner = (each.type for each in type.members.values())
            return not type.overlaps and not has_instance(type) and any(map(has_subranges, inner))
    return isinstance(type, Subrange)


def policy_of(body: Body, type: Subrange) -> str:
    """What becomes of a value outside: as the variable or its type says, else the POU, else it is limited."""
    return type.policy or body.scope.policy or "limit"


def bound_of(body: Body, place: Place) -> Place | None:
    """What is known by a name of this POU, but is a variable of somebody else: that of an in-out, or what a reference refers to. None
    for a variable of its own."""
    if (place.slot is not None or place.reference is not None) and not _own(body, place):
        return _unchecked(place)
    record = body.scope.instance
    if place.base is not Base.SELF or not isinstance(record, Record):
        return None
    for member in record.members.values():
        if member.copied and member.offset <= place.offset < member.offset + member.type.size:
            actual = place_of(actual_of(record, member), Base.SELF, record, 0)
            return _unchecked(
                replace(actual, type=place.type, offset=place.offset - member.offset, indices=place.indices)
            )
    return None


def _own(body: Body, place: Place) -> bool:
    """Whether it is a variable of the instance that this method belongs to."""
    slot, frame = place.slot, body.scope.frame
    this = None if frame is None else frame.members.get("THIS")
    if slot is None or this is None or slot.slot is not None or slot.reference is not None:
        return False
    return slot.base is Base.FRAME and slot.offset == this.offset


def _unchecked(place: Place) -> Place | None:
    same = again_at(place)
    return None if same is None else replace(same, null_trap=0)


def arriving(body: Body, value: Expr, place: Place, span: Span, last: Place | None = None) -> Expr:
    """A checked value on its way into a variable: what is recorded says which variable that is, and it may hold its last value."""
    bound = bound_of(body, last or place) if isinstance(place.type, Subrange) else None
    return holding(body, value if bound is None else _bound_to(value, bound), place, span, last)


def _bound_to(value: Expr, bound: Place) -> Expr:
    match value:
        case Limit() | Violates():
            return replace(value, bound=bound)
        case Sequence((Assign() as kept, Assign(value=Violates() as outside) as told), result):
            return Sequence((kept, replace(told, value=replace(outside, bound=bound))), result)
        case Sequence((Assign() as kept, If(((Violates() as outside, stops),)) as told), result):
            return Sequence((kept, replace(told, branches=((replace(outside, bound=bound), stops),))), result)
    return value


def holding(body: Body, value: Expr, place: Place, span: Span, last: Place | None = None) -> Expr:
    """A value on its way into a variable that holds its last value where the new one is outside; `last` is where that is read, if not
    at `place`. Where the index of an element calls a function, the new one is limited instead."""
    type = place.type
    if not (isinstance(type, Subrange) and isinstance(value, Limit) and policy_of(body, type) == "hold"):
        return value
    same = again_at(last or place)
    if same is None:
        return value
    base = base_of(type)
    kept = body.temporary(elementary(value.value), span)
    outside = Violates(BOOL, Load(kept), value.low, value.high, value.site, value.bound)
    chosen = (outside, fold.convert(base, Load(kept)), Load(replace(same, type=base)))
    return Sequence((Assign(kept, value.value, span),), Intrinsic("SEL", base, chosen))


@contextmanager
def explicitly(body: Body, node: tree.Call) -> Iterator[None]:
    """The variables that this call takes, which has EN or ENO, are read as they were written meanwhile."""
    before = body.explicit
    body.explicit = (
        *before,
        *(each.value for each in node.arguments if each.value is not None and not each.output),
    )
    try:
        yield
    finally:
        body.explicit = before


def as_written(body: Body, place: Place, member: Member | None) -> Expr:
    """The value of a subrange variable before any check limits it, as one of the base type."""
    type = place.type
    assert isinstance(type, Subrange)
    base = base_of(type)
    there, note = Load(replace(place, type=base)), _note_of(body, place, member)
    if note is None:
        return there
    kept = Load(note)
    valid: Expr = Compare("eq", BOOL, limited(base, kept, type.low, type.high), there)
    valid = wrapped_valid(valid, kept, there, type)
    once_more = again(there)
    assert once_more is not None
    value = Intrinsic("SEL", base, (valid, once_more, kept))
    if policy_of(body, type) != "hold":
        return value
    return Intrinsic("SEL", base, (Violates(BOOL, kept, type.low, type.high, 0), value, kept))


def _note_of(body: Body, place: Place, member: Member | None) -> Place | None:
    """Where the variable's value is kept as it was written."""
    same = None if member is None or member.note is None else again_at(place)
    if same is None or member is None:
        return None
    found = body.scope.find(member.name)
    own = found is not None and found[0] is member and body.scope.this is None
    return note_of(same, member, found[1] if own and found is not None else None)


def noting(body: Body, place: Place, member: Member | None) -> Place | None:
    """The note that an assignment to the variable writes."""
    return _note_of(body, place, member) if body.effects.checks else None


def with_note(body: Body, value: Expr, type: Subrange, span: Span) -> tuple[Expr, Expr]:
    """An argument that is a subrange value, and the same as it was before it was limited."""
    if not body.effects.checks:
        return value, value
    same = again(value.value if isinstance(value, Limit) else value)
    if same is not None:
        return value, written(same, type)
    kept = body.temporary(base_of(type), span)
    return keeping(body, value, kept, span), Load(kept)


def keeping(body: Body, value: Expr, note: Place | None, span: Span) -> Expr:
    """A value on its way into a subrange variable; the note takes it as it is before it is limited."""
    if note is None:
        return value
    match value:
        case Limit() if elementary(value.value) != value.type:
            kept = body.temporary(elementary(value.value), span)
            noted = Assign(note, written(Load(kept), value), span)
            return Sequence((Assign(kept, value.value, span), noted), replace(value, value=Load(kept)))
        case Limit():
            return Sequence((Assign(note, value.value, span),), replace(value, value=Load(note)))
        case Sequence((Assign(kept),) as first, Intrinsic("SEL", args=(Violates() as told, *_)) as chosen):  # `holding`
            type = value.type
            assert isinstance(type, Elementary)
            to = Limit(type, Load(kept), told.low, told.high, 0)
            return Sequence((*first, Assign(note, written(Load(kept), to), span)), chosen)
    return Sequence((Assign(note, value, span),), value if isinstance(value, Const) else Load(note))


def _proof(expr: Expr, type: Subrange) -> str:
    """Why the value cannot be outside, or ''."""
    low, high = value_range(expr)
    if not (type.low <= low and high <= type.high):
        return ""
    match expr:
        case Const():
            return "the constant is in range"
        case Limit():
            return f"the value is brought to {low}..{high} already"
    return f"the value is {low}..{high} at most"


def _named(type: Subrange) -> str:
    bounds_text = f"{type.low}..{type.high}"
    return bounds_text if bounds_text in type.name else f"{type.name} ({bounds_text})"
