"""One row of a file's outline."""

from dataclasses import dataclass
from typing import Literal

from scanbench.problems import Span

EntryKind = Literal[
    "program", "function", "block", "class", "interface", "method", "property", "variable", "constant", "type", "enumeration",
    "value", "member", "configuration", "task", "instance", "section", "statement",
]  # fmt: skip
"""`section`: VAR to END_VAR. `statement`: one with others inside of it."""


@dataclass(frozen=True, slots=True)
class Entry:
    name: str
    kind: EntryKind
    detail: str
    span: Span
    """Of the name."""
    start: int
    """Of the whole declaration, as far as that is known: positions in the file."""
    end: int
    inner: tuple["Entry", ...] = ()
