"""Ladder as text: the networks of a body, before any name is looked up. The grammar is that of `docs/ladder.md`."""

from collections.abc import Iterator

from scanbench.problems import Span
from scanbench.syntax import tree
from scanbench.syntax.tree import node

POWER = "~"
"""The value of an argument that takes the power that comes in, as the name of a `tree.Name`."""
WIRE = "#"
"""Begins the name of a `tree.Name` that means a link."""


@node
class Contact:
    """`[operand]`; `mode` is empty, `/` (closed contact), `P` or `N` (edge)."""

    mode: str
    operand: tree.Expression
    written: str
    """The operand as text: the memory of an edge is named after it."""
    span: Span


@node
class Coil:
    """`(target)`; `mode` is empty, `/`, `S`, `R`, `P` or `N`."""

    mode: str
    target: tree.Expression
    written: str
    span: Span


@node
class Branch:
    """`name := < ... >`: contacts of its own, from the rail, at an input of a box."""

    name: str
    parallel: "Parallel"
    span: Span


@node
class Box:
    """`result := callee(arguments).output`. The power goes on from `output`; without one as it came."""

    result: tree.Expression | None
    callee: tree.Expression
    arguments: tuple[tree.Argument | Branch, ...]
    output: str
    span: Span
    after: Span
    """From the closing parenthesis to the end."""


@node
class Parallel:
    branches: tuple["Path", ...]
    span: Span


@node
class Link:
    """`-> #name` sends the power and ends its path; `#name` lets through what was sent."""

    name: str
    sends: bool
    span: Span


@node
class Leave:
    """`JMP label`, or RETURN: then `label` is empty. Ends its path."""

    label: str
    span: Span


Element = Contact | Coil | Box | Parallel | Link | Leave
Path = tuple[Element, ...]


@node
class Rung:
    label: str
    path: Path
    off: bool
    """The pragma `{off}`: not compiled."""
    span: Span
    """Of the first line."""


@node
class NetworkBody:
    networks: tuple[Rung, ...]
    span: Span
    owner: str = ""
    """The name of the POU: its heirs have memories of their own."""


def elements(path: Path) -> Iterator[Element]:
    """All of a path, those inside of others as well; what is inside of an argument comes before its box."""
    for each in path:
        if isinstance(each, Parallel):
            for branch in each.branches:
                yield from elements(branch)
        elif isinstance(each, Box):
            for argument in each.arguments:
                if isinstance(argument, Branch):
                    yield from elements((argument.parallel,))
        yield each


def edges(body: NetworkBody) -> Iterator[tuple[Contact | Coil, str]]:
    """What looks for an edge, with the name of its memory: by operand and count, so that an inserted rung changes no other name."""
    counts: dict[str, int] = {}
    for rung in body.networks:
        for each in elements(rung.path):
            if isinstance(each, Contact | Coil) and each.mode in ("P", "N"):
                kind = each.mode + ("" if isinstance(each, Contact) else "C")
                key = f"${body.owner}.{kind}.{each.written}".upper()
                counts[key] = counts.get(key, 0) + 1
                yield each, f"{key}.{counts[key]}"


def memories(body: NetworkBody) -> tuple[tree.VariableSection, ...]:
    """The variables that the edges of a body need: what each saw last."""
    found = tuple(
        tree.Variable(name, tree.NamedType("BOOL", each.span), None, None, each.span) for each, name in edges(body)
    )
    return (tree.VariableSection("VAR", (), found, body.span),) if found else ()
