"""Which POUs become part of their callers."""

from collections.abc import Iterable

from scanbench.program.bodies import bodies
from scanbench.program.program import Pou, Stmt

LARGE = 24
"""Statements from which on a body is compiled by itself: a call costs it nothing, and LLVM takes more than linear time
for a caller that has swallowed hundreds of them."""
COPY, MOST_COPIED = 10, 600
"""What a copy of a callee costs in addition to its statements, and what all copies in a module may: with a copy of everything
below, a chain of functions would take quadratic time."""
MOST_SWALLOWED = 1500
"""Statements of the standard library that become part of one body. What has a thousand timers calls the others."""
DIVIDED, PIECE = 2000, 500
"""Statements from which on a body is compiled in pieces, and those of a piece."""


def divided(pou: Pou) -> bool:
    """Whether its body is compiled in pieces. Each call of what may be called while it runs has buffers of its own instead."""
    return not pou.recursive and size(pou.body) > DIVIDED


def attribute(pou: Pou) -> str:
    """The LLVM attribute of the POU's function; none where LLVM may choose."""
    if pou.inline:
        return " alwaysinline"
    return " noinline" if size(pou.body) > LARGE or pou.recursive else ""


def shared(pou: Pou) -> bool:
    """Whether modules that call it get a copy of the body, so that it may become part of the caller."""
    return pou.inline or (size(pou.body) <= LARGE and not pou.recursive)


def size(statements: Iterable[Stmt]) -> int:
    """Statements, with those inside of others."""
    return sum(1 + sum(size(inner) for inner in bodies(each)) for each in statements)
