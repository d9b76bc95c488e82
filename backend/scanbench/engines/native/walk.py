"""Walks over checked code: which places it reads, writes and takes references of, and whom it calls.

A node that is not known here is an error: to overlook one would be to emit wrong code.
"""

from collections.abc import Iterable
from enum import Enum
from typing import assert_never

from scanbench.program.bodies import bodies
from scanbench.program.program import (
    Assign,
    Binary,
    Blocks,
    CallBlock,
    CallFunction,
    Case,
    Compare,
    Const,
    Continue,
    Convert,
    Evaluate,
    Exit,
    Expr,
    For,
    Halt,
    If,
    Index,
    Intrinsic,
    Jump,
    Limit,
    Load,
    Place,
    Pou,
    RefOf,
    Repeat,
    Return,
    Sequence,
    SetBytes,
    Stmt,
    Try,
    Unary,
    Violates,
    While,
)
from scanbench.program.types import Section


class Use(Enum):
    """What happens to a place."""

    READ = 0
    WRITE = 1
    REFERENCE = 2
    CALL = 3
    """The place is a block instance, and the instance is run."""


Seen = tuple[Place, Use] | Pou


def index_parts(index: Index) -> tuple[Expr, ...]:
    """The expressions of an index."""
    if isinstance(index.low, int) and isinstance(index.high, int) and isinstance(index.stride, int):
        return (index.value,)
    return (index.value, *(part for part in (index.low, index.high, index.stride) if not isinstance(part, int)))


def of_statements(statements: Iterable[Stmt]) -> list[Seen]:
    """Everything that these statements touch."""
    seen: list[Seen] = []
    _statements(statements, seen)
    return seen


def of_place(place: Place, use: Use) -> list[Seen]:
    """The place itself, its slot or reference, and what its indices read."""
    return [(place, use), *of_address(place)]


def of_address(place: Place) -> list[Seen]:
    """What finding the place's address touches."""
    seen: list[Seen] = []
    _address(place, seen)
    return seen


def of_expression(expr: Expr) -> list[Seen]:
    """Everything that evaluating it touches."""
    seen: list[Seen] = []
    _expression(expr, seen)
    return seen


# ---- gathering ------------------------------------------------------------------------------------------------


def _statements(statements: Iterable[Stmt], seen: list[Seen]) -> None:
    for statement in statements:
        match statement:
            case Assign(target, value):
                _place(target, Use.WRITE, seen)
                _expression(value, seen)
            case If(branches, orelse):
                for condition, body in branches:
                    _expression(condition, seen)
                    _statements(body, seen)
                _statements(orelse, seen)
            case CallBlock():
                _block(statement, seen)
            case _:
                _rarer(statement, seen)
                for body in bodies(statement):
                    _statements(body, seen)


def _rarer(
    statement: SetBytes
    | Evaluate
    | Case
    | For
    | While
    | Repeat
    | Exit
    | Continue
    | Return
    | Blocks
    | Jump
    | Halt
    | Try,
    seen: list[Seen],
) -> None:
    """What the statement touches, without those inside of it."""
    match statement:
        case SetBytes(target):
            _place(target, Use.WRITE, seen)
        case Evaluate(call):
            _expression(call, seen)
        case Case(selector):
            _expression(selector, seen)
        case For(variable, start, end, step):
            _place(variable, Use.WRITE, seen)
            for part in (start, end, step):
                _expression(part, seen)
        case While(condition):
            _expression(condition, seen)
        case Repeat(_, until):
            _expression(until, seen)
        case Try():
            _place(statement.code, Use.WRITE, seen)
        case Exit() | Continue() | Return() | Blocks() | Jump() | Halt():
            return
        case _:
            assert_never(statement)


def _block(call: CallBlock, seen: list[Seen]) -> None:
    _place(call.instance, Use.CALL, seen)
    for target, value in call.inputs:
        _expression(value, seen)
        _place(target, Use.WRITE, seen)
    for slot, bound in call.in_outs:
        seen.append((slot, Use.WRITE))
        _place(bound, Use.REFERENCE, seen)
    seen.append(call.pou)
    for value, target in call.outputs:
        _expression(value, seen)
        _place(target, Use.WRITE, seen)


def _place(place: Place, use: Use, seen: list[Seen]) -> None:
    seen.append((place, use))
    if place.indices or place.slot is not None or place.reference is not None:
        _address(place, seen)


def _address(place: Place, seen: list[Seen]) -> None:
    if place.slot is not None:
        _place(place.slot, Use.READ, seen)
    if place.reference is not None:
        _expression(place.reference, seen)
    for index in place.indices:
        for part in index_parts(index):
            _expression(part, seen)


def _expression(expr: Expr, seen: list[Seen]) -> None:
    match expr:
        case Load(place):
            _place(place, Use.READ, seen)
        case Const():
            return
        case Binary(_, _, left, right) | Compare(_, _, left, right):
            _expression(left, seen)
            _expression(right, seen)
        case Unary(_, _, operand) | Convert(_, operand):
            _expression(operand, seen)
        case Limit(_, operand) | Violates(_, operand):
            _expression(operand, seen)
        case Intrinsic(_, _, operands):
            for each in operands:
                _expression(each, seen)
        case CallFunction():
            _function(expr, seen)
        case RefOf(place):
            _place(place, Use.REFERENCE, seen)
        case Sequence(body, value):
            _statements(body, seen)
            _expression(value, seen)
        case _:
            assert_never(expr)


def _function(call: CallFunction, seen: list[Seen]) -> None:
    for name, argument in zip(call.pou.parameters, call.args, strict=True):
        if isinstance(argument, Place):
            in_out = call.pou.frame.members[name].section is Section.IN_OUT
            _place(argument, Use.REFERENCE if in_out else Use.WRITE, seen)
        elif argument is not None:
            _expression(argument, seen)
    seen.append(call.pou)


def _changes(seen: Seen) -> bool:
    return isinstance(seen, Pou) or seen[1] is Use.WRITE


def disturbs(expr: Expr) -> bool:
    """Whether evaluating it runs code that may change variables."""
    return any(_changes(seen) for seen in of_expression(expr))


def address_disturbs(place: Place) -> bool:
    """Whether finding its address runs code that may change variables."""
    return any(_changes(seen) for seen in of_address(place))
