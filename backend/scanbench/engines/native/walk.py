"""Walks over checked code: which places it reads, writes and takes references of, and whom it calls."""

from collections.abc import Iterable, Iterator
from enum import Enum

from scanbench.check.program import (
    Assign,
    Binary,
    CallBlock,
    CallFunction,
    Case,
    Compare,
    Convert,
    Evaluate,
    Expr,
    For,
    If,
    Intrinsic,
    Load,
    Place,
    Pou,
    Repeat,
    SetBytes,
    Stmt,
    Unary,
    While,
)
from scanbench.check.types import Section


class Use(Enum):
    """What happens to a place."""

    READ = 0
    WRITE = 1
    REFERENCE = 2
    CALL = 3
    """A block instance stands there and is run."""


Seen = tuple[Place, Use] | Pou


def of_statements(statements: Iterable[Stmt]) -> Iterator[Seen]:
    """Everything that these statements touch."""
    for statement in statements:
        yield from of_statement(statement)


def of_statement(statement: Stmt) -> Iterator[Seen]:
    """Everything that the statement touches."""
    match statement:
        case Assign(target, value):
            yield from of_place(target, Use.WRITE)
            yield from of_expression(value)
        case SetBytes(target):
            yield from of_place(target, Use.WRITE)
        case CallBlock():
            yield from _block(statement)
        case Evaluate(call):
            yield from of_expression(call)
        case If(branches, orelse):
            for condition, body in branches:
                yield from of_expression(condition)
                yield from of_statements(body)
            yield from of_statements(orelse)
        case Case(selector, cases, orelse):
            yield from of_expression(selector)
            for _, body in cases:
                yield from of_statements(body)
            yield from of_statements(orelse)
        case For(variable, start, end, step, body):
            yield from of_place(variable, Use.WRITE)
            for part in (start, end, step):
                yield from of_expression(part)
            yield from of_statements(body)
        case While(condition, body):
            yield from of_expression(condition)
            yield from of_statements(body)
        case Repeat(body, until):
            yield from of_statements(body)
            yield from of_expression(until)


def _block(call: CallBlock) -> Iterator[Seen]:
    yield from of_place(call.instance, Use.CALL)
    for target, value in call.inputs:
        yield from of_expression(value)
        yield target, Use.WRITE
    for slot, bound in call.in_outs:
        yield slot, Use.WRITE
        yield from of_place(bound, Use.REFERENCE)
    yield call.pou
    for _, target in call.outputs:
        yield from of_place(target, Use.WRITE)


def of_place(place: Place, use: Use) -> Iterator[Seen]:
    """The place itself, its slot, and what its indices read."""
    yield place, use
    if place.slot is not None:
        yield from of_place(place.slot, Use.READ)
    for index in place.indices:
        yield from of_expression(index.value)


def of_expression(expr: Expr) -> Iterator[Seen]:
    """Everything that evaluating it touches."""
    match expr:
        case Load(place):
            yield from of_place(place, Use.READ)
        case Unary(_, _, operand) | Convert(_, operand):
            yield from of_expression(operand)
        case Binary(_, _, left, right) | Compare(_, _, left, right):
            yield from of_expression(left)
            yield from of_expression(right)
        case Intrinsic(_, _, args):
            for arg in args:
                yield from of_expression(arg)
        case CallFunction(pou, _, arguments):
            for name, argument in zip(pou.parameters, arguments, strict=True):
                if isinstance(argument, Place):
                    in_out = pou.frame.members[name].section is Section.IN_OUT
                    yield from of_place(argument, Use.REFERENCE if in_out else Use.WRITE)
                elif argument is not None:
                    yield from of_expression(argument)
            yield pou


def calls_functions(expr: Expr) -> bool:
    """Whether evaluating it runs code that may change variables."""
    return any(isinstance(seen, Pou) for seen in of_expression(expr))


def address_calls(place: Place) -> bool:
    """Whether finding its address runs code that may change variables."""
    return any(isinstance(seen, Pou) for seen in of_place(place, Use.READ))
