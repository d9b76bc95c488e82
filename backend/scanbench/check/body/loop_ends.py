"""The end value and the step of a FOR loop, where the dialect computes them for each round.

Where nothing that the loop does can change them, they are computed once: that gives the same, in less time.
"""

from scanbench.check.body.allowed import may, used
from scanbench.check.body.context import Body
from scanbench.check.body.harmless import harmless
from scanbench.check.dialect import Allowance
from scanbench.problems import Span
from scanbench.program.bodies import every
from scanbench.program.program import (
    Assign,
    Binary,
    Blocks,
    Case,
    Compare,
    Const,
    Continue,
    Convert,
    Exit,
    Expr,
    For,
    If,
    Intrinsic,
    Jump,
    Limit,
    Load,
    Place,
    Repeat,
    Return,
    Stmt,
    Unary,
    While,
)
from scanbench.program.types import LINT, Elementary, StringType


def computed_again(body: Body, counter: Place, end: Expr, step: Expr, inner: tuple[Stmt, ...], span: Span) -> bool:
    """Whether end and step have to be computed for each round; that is told where the loop itself changes what they are computed from."""
    if not may(body, Allowance.FOR_ENDS) or (isinstance(end, Const) and isinstance(step, Const)):
        return False
    read = _joined([end, step])
    names = frozenset() if read is None else frozenset(each.variable for each in read)
    written = {counter.variable, *(each.target.variable for each in every(inner) if isinstance(each, Assign))}
    changed = not (harmless(end) and harmless(step)) or not names.isdisjoint(written)
    if isinstance(counter.type, Elementary) and counter.type.size == LINT.size:
        if changed:
            raise body.report.reject(
                "X001", f"End value and step are computed for each round, and this loop changes them; its counter is {counter.type}, and only "
                "those of up to 32 bits can do that here. Write a WHILE loop.", span,
            )  # fmt: skip
        return False
    if changed:
        used(
            body,
            Allowance.FOR_ENDS,
            span,
            "End value and step are computed for each round, and this loop may change them",
        )
    return changed or read is None or not all(_fixed(each) for each in read) or not all(map(_apart, every(inner)))


def _read(expr: Expr) -> list[Place] | None:
    """The places that it reads; None of what may be anything."""
    match expr:
        case Const():
            return []
        case Load(place):
            return _joined([index.value for index in place.indices], place)
        case Unary(operand=operand) | Convert(operand=operand):
            return _read(operand)
        case Binary(left=left, right=right) | Compare(left=left, right=right):
            return _joined([left, right])
        case Intrinsic(args=args):
            return _joined(list(args))
        case Limit(value=value):
            return _read(value)
    return None


def _joined(parts: list[Expr], *places: Place) -> list[Place] | None:
    found = list(places)
    for each in parts:
        more = _read(each)
        if more is None:
            return None
        found += more
    return found


def _fixed(place: Place) -> bool:
    """Whether only its own name leads to it."""
    return (
        place.reference is None and place.slot is None and place.variable != "" and not place.variable.startswith("@")
    )


def _apart(statement: Stmt) -> bool:
    """Whether it writes nothing but what it names."""
    match statement:
        case Assign(target, value):
            return _fixed(target) and isinstance(target.type, Elementary | StringType) and harmless(value)
        case If(branches):
            return all(harmless(test) for test, _ in branches)
        case Case(selector):
            return harmless(selector)
        case For(variable, start, end, step):
            return _fixed(variable) and harmless(start) and harmless(end) and harmless(step)
        case While(condition):
            return harmless(condition)
        case Repeat(_, until):
            return harmless(until)
        case Exit() | Continue() | Return() | Jump() | Blocks():
            return True
    return False
