"""Which IFs can become selects: bodies that may as well be evaluated when the condition is false.

LLVM may not invent stores, so it keeps the branch around `IF a[j] > a[j + 1] THEN (swap) END_IF`; we know that all of the
image may be written, and that the condition has already checked the addresses.
"""

from collections.abc import Iterable
from dataclasses import fields, is_dataclass
from typing import assert_never

from scanbench.engines.native import walk
from scanbench.engines.native.effects import keeps
from scanbench.engines.native.emit_body import Body
from scanbench.engines.native.emit_types import elementary, is_real
from scanbench.engines.native.ranges import Range, arithmetic, within
from scanbench.program.program import (
    Assign,
    Binary,
    CallFunction,
    Compare,
    Const,
    Convert,
    Expr,
    If,
    Index,
    Intrinsic,
    Limit,
    Load,
    Place,
    Pou,
    RefOf,
    Sequence,
    Stmt,
    Unary,
    Violates,
)
from scanbench.program.types import Elementary, StringType
from scanbench.program.untyped import bounds

MOST_ASSIGNMENTS = 4
MOST_NODES = 24
CHEAP = ("ABS", "MIN", "MAX", "SEL", "SHL", "SHR", "ROL", "ROR", "BITCAST", "CLOCK")


class _Checked:
    """Places whose checks have passed on every way to this point."""

    def __init__(self, body: Body, condition: Expr, known: bool = True) -> None:
        """With `known`, the condition has been evaluated."""
        self.body = body
        self.nodes = 0
        self.places: dict[object, Place] = {}
        if known and not walk.disturbs(condition):
            for seen in walk.of_expression(condition):
                if isinstance(seen, tuple):
                    self.places[_key(seen[0])] = seen[0]

    def forget(self, written: Place) -> None:
        """Drops the places whose address may depend on what was written."""
        names = frozenset({written.variable})
        for key, place in list(self.places.items()):
            if not all(keeps(names, each) for each in _address_reads(place)):
                del self.places[key]

    def allows_place(self, place: Place) -> bool:
        """Whether reaching the place cannot trap here."""
        self.nodes += 1
        if place.slot is None and place.reference is None and not place.indices:
            return True
        if _key(place) in self.places:
            return True
        return (
            place.slot is None and place.reference is None and all(self._allows_index(each) for each in place.indices)
        )

    def _allows_index(self, index: Index) -> bool:
        if not isinstance(index.low, int) or not isinstance(index.high, int):
            return False
        return within(range_of(self.body, index.value), (index.low, index.high)) and self.allows(index.value)

    def allows(self, expr: Expr) -> bool:
        """Whether evaluating it is cheap and cannot trap here."""
        self.nodes += 1
        match expr:
            case Const(_, value):
                return not isinstance(value, bytes)
            case Load(place):
                return isinstance(place.type, Elementary) and self.allows_place(place)
            case Unary(_, _, operand) | Convert(_, operand):
                return not isinstance(operand.type, StringType) and self.allows(operand)
            case Binary(op, type, left, right):
                safe = op not in ("div", "mod") or _divides(self.body, type, right)
                return safe and self.allows(left) and self.allows(right)
            case Compare(_, _, left, right):
                return not isinstance(left.type, StringType) and self.allows(left) and self.allows(right)
            case Intrinsic(name, _, args):
                plain = not any(isinstance(each.type, StringType) for each in args)
                return name in CHEAP and plain and all(self.allows(arg) for arg in args)
            case Limit(_, value, site=0):
                return self.allows(value)
            case Limit(_, value, low, high):
                return within(range_of(self.body, value), (low, high)) and self.allows(value)
            case Violates(_, value, site=site):
                return site == 0 and self.allows(value)
            case CallFunction() | RefOf() | Sequence():
                return False
            case _:
                assert_never(expr)


def _divides(body: Body, type: Elementary, right: Expr) -> bool:
    """Whether the division is cheap and cannot trap: by a constant."""
    return not is_real(type) and isinstance(right, Const) and right.value != 0


def range_of(body: Body, expr: Expr) -> Range:
    """Range of an integer expression, without emitting it."""
    match expr:
        case Const(_, value) if isinstance(value, int):
            return value, value
        case Load(place):
            known = body.counter(place)
            return known.range if known is not None else _bounds(expr)
        case Binary(op, type, left, right) if not is_real(type):
            return arithmetic(op, type, range_of(body, left), range_of(body, right))[0]
        case Convert(type, operand) if isinstance(operand.type, Elementary) and not is_real(operand.type):
            inner = range_of(body, operand)
            return inner if isinstance(type, Elementary) and within(inner, bounds(type)) else _bounds(expr)
        case Limit(_, value, site=0):
            return range_of(body, value)
        case Limit(_, value, low, high):
            inner = range_of(body, value)
            return min(max(inner[0], low), high), min(max(inner[1], low), high)
    return _bounds(expr)


def _bounds(expr: Expr) -> Range:
    return bounds(elementary(expr.type))


def to_selects(body: Body, statement: If) -> bool:
    """Whether all bodies of the IF can be evaluated at all times, and that is worth it."""
    bodies = [*(each for _, each in statement.branches), statement.orelse]
    if len(statement.branches) > 2 or sum(len(each) for each in bodies) > MOST_ASSIGNMENTS:
        return False
    if not all(_plain(each) for each in bodies):
        return False
    checked = _Checked(body, statement.branches[0][0])
    for position, each in enumerate(bodies):
        if 0 < position < len(statement.branches) and not checked.allows(statement.branches[position][0]):
            return False
        for assign in each:
            assert isinstance(assign, Assign)
            if not (checked.allows(assign.value) and checked.allows_place(assign.target)):
                return False
            checked.forget(assign.target)
    return checked.nodes <= MOST_NODES


def harmless(body: Body, expr: Expr) -> bool:
    """Whether the expression can be evaluated at any time, and that is cheap."""
    checked = _Checked(body, expr, known=False)
    return checked.allows(expr) and checked.nodes <= MOST_NODES


def _plain(statements: Iterable[Stmt]) -> bool:
    return all(isinstance(each, Assign) and isinstance(each.target.type, Elementary) for each in statements)


def _address_reads(place: Place) -> list[Place]:
    return [seen[0] for seen in walk.of_address(place) if isinstance(seen, tuple)]


def _key(node: object) -> object:
    """The same for two places or expressions that differ only in where they trap."""
    if isinstance(node, tuple):
        return tuple(_key(each) for each in node)
    if isinstance(node, Pou) or not is_dataclass(node) or isinstance(node, Elementary | type):
        return node
    if not hasattr(node, "__hash__") or node.__hash__ is None:
        return id(node)
    names = [each.name for each in fields(node) if each.name not in ("trap", "null_trap", "span")]
    return type(node), tuple(_key(getattr(node, name)) for name in names)
