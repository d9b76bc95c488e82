"""Ladder and function block diagrams as text: the networks of a body, before any name is looked up. The grammar is that of `docs/ladder.md`."""

from collections.abc import Iterator

from scanbench.problems import Span
from scanbench.syntax import tree
from scanbench.syntax.tree import node

POWER = "~"
"""The value of an argument that takes the power that comes in, as the name of a `tree.Name`."""
WIRE = "#"
"""Begins the name of a `tree.Name` that means a wire or link of its network."""


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
class Pin:
    """`NOT R_EDGE x`: an edge is a contact with the mode P or N; `name` is that of the input, where it is one."""

    name: str | None
    edge: Contact
    negated: bool
    span: Span


@node
class Function:
    """`callee(inputs, name => variable or wire)`, as a box of a function block diagram."""

    callee: tree.Expression
    arguments: tuple[tree.Argument | Pin, ...]
    span: Span


@node
class Item:
    """A line of a function block diagram. `target` takes the value: a variable, or a wire, which is a name that begins with `#`."""

    target: tree.Expression | None
    operator: str
    """`:=`, `S=` or `R=`."""
    value: Function | Pin | tree.Expression | None
    """Of a jump its condition; None without one."""
    leave: Leave | None
    span: Span


@node
class Wire:
    """`#name : type = value`, or `output => #name : type`; `loop`: it is read above the line that sets it, so that it keeps its value from
    one evaluation to the next."""

    name: str
    type: tree.TypeSpec | None
    loop: bool
    span: Span


@node
class TypedWire(tree.Name):
    """`#name : type` after `output =>`: a wire that keeps its value says its type unless that is BOOL."""

    type: tree.TypeSpec


@node
class Diagram:
    """NETWORK: a function block diagram, in the order of execution."""

    label: str
    items: tuple[Item, ...]
    wires: tuple[Wire, ...]
    off: bool
    span: Span
    """Of the first line."""


@node
class NetworkBody:
    networks: tuple[Rung | Diagram, ...]
    span: Span
    owner: str = ""
    """The name of the POU: its heirs have memories of their own."""


def wire_at(argument: tree.Argument) -> tree.Name | None:
    """The wire that an output goes to."""
    value = argument.value
    is_wire = argument.output and isinstance(value, tree.Name) and value.name.startswith(WIRE)
    return value if is_wire and isinstance(value, tree.Name) else None


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
    for network in body.networks:
        for each in elements(network.path) if isinstance(network, Rung) else _pins(network):
            if isinstance(each, Contact | Coil) and each.mode in ("P", "N"):
                kind = each.mode + ("" if isinstance(each, Contact) else "C")
                key = f"${body.owner}.{kind}.{each.written}".upper()
                counts[key] = counts.get(key, 0) + 1
                yield each, f"{key}.{counts[key]}"


def loops(body: NetworkBody) -> Iterator[tuple[Wire, str]]:
    """The wires that keep their values, with the names of their variables: `#LOW/MAIN.1`, as for edges."""
    counts: dict[str, int] = {}
    for network in body.networks:
        for each in network.wires if isinstance(network, Diagram) else ():
            if each.loop:
                key = f"{each.name}/{body.owner}".upper()
                counts[key] = counts.get(key, 0) + 1
                yield each, f"{key}.{counts[key]}"


def _pins(diagram: Diagram) -> Iterator[Contact]:
    """The edges of a diagram, in the order in which they are looked for."""
    for item in diagram.items:
        if isinstance(item.value, Function):
            yield from (each.edge for each in item.value.arguments if isinstance(each, Pin))
        elif isinstance(item.value, Pin):
            yield item.value.edge


def memories(body: NetworkBody) -> tuple[tree.VariableSection, ...]:
    """The variables that the edges and loops of a body need: what each edge saw last, what each wire had."""
    found = tuple(
        tree.Variable(name, tree.NamedType("BOOL", each.span), None, None, each.span) for each, name in edges(body)
    )
    found += tuple(
        tree.Variable(name, each.type or tree.NamedType("BOOL", each.span), None, None, each.span)
        for each, name in loops(body)
    )
    return (tree.VariableSection("VAR", (), found, body.span),) if found else ()
