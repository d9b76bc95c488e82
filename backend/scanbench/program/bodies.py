"""The statements inside of statements."""

from collections.abc import Iterable, Iterator
from typing import assert_never

from scanbench.program.program import (
    Assign,
    Base,
    Blocks,
    CallBlock,
    Case,
    Continue,
    Evaluate,
    Exit,
    For,
    Halt,
    If,
    Jump,
    Load,
    Repeat,
    Return,
    SetBytes,
    Stmt,
    Try,
    While,
)
from scanbench.program.types import Kind


def bodies(statement: Stmt) -> tuple[tuple[Stmt, ...], ...]:
    """The statements inside of a statement, body by body."""
    match statement:
        case If(branches, orelse):
            return (*(body for _, body in branches), orelse)
        case Case(_, branches, orelse):
            return (*(body for _, body in branches), orelse)
        case For() | While() | Repeat():
            return (statement.body,)
        case Blocks(blocks):
            return blocks
        case Try():
            return statement.body, statement.handler, statement.final
        case Assign() | SetBytes() | CallBlock() | Evaluate() | Exit() | Continue() | Return() | Jump() | Halt():
            return ()
        case _:
            assert_never(statement)


def every(statements: Iterable[Stmt]) -> Iterator[Stmt]:
    """Each statement, and those inside of it."""
    for statement in statements:
        yield statement
        for body in bodies(statement):
            yield from every(body)


def keeps_bits(assign: Assign) -> bool:
    """Whether it copies a REAL as it is in memory, a NaN with all its bits. A temporary may be in a register instead."""
    if not isinstance(assign.value, Load) or assign.value.type.kind is not Kind.REAL:
        return False
    place = assign.value.place
    return place.type == assign.target.type and (
        place.base is not Base.FRAME or place.slot is not None or place.reference is not None
    )
