"""The statements inside of statements."""

from collections.abc import Iterable, Iterator
from typing import assert_never

from scanbench.program.program import (
    Assign,
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
    Repeat,
    Return,
    SetBytes,
    Stmt,
    While,
)


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
