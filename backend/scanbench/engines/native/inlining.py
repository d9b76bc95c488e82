"""Which POUs become part of their callers."""

from collections.abc import Iterable

from scanbench.check.program import Case, For, If, Pou, Repeat, Stmt, While

LARGE = 24
"""Statements from which on a body is compiled by itself: a call costs it nothing, and LLVM takes more than linear time
for a caller that has swallowed hundreds of them."""


def attribute(pou: Pou) -> str:
    """The LLVM attribute of the POU's function; none where LLVM may choose."""
    if pou.inline:
        return " alwaysinline"
    return " noinline" if size(pou.body) > LARGE else ""


def size(statements: Iterable[Stmt]) -> int:
    """Statements, with those inside of others."""
    return sum(1 + sum(size(inner) for inner in _bodies(each)) for each in statements)


def _bodies(statement: Stmt) -> list[tuple[Stmt, ...]]:
    match statement:
        case If(branches, orelse):
            return [*(body for _, body in branches), orelse]
        case Case(_, branches, orelse):
            return [*(body for _, body in branches), orelse]
        case For() | While() | Repeat():
            return [statement.body]
    return []
