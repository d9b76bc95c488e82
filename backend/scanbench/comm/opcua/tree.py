"""The nodes of a program: objects for instances and structures, variables for what has a value. Pure."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice

from scanbench.comm.opcua.forms import form_of
from scanbench.program.program import Program
from scanbench.program.types import ArrayType, Kind, Record, StringType
from scanbench.symbols.symbols import Symbol, members, roots

MOST_NODES = 20_000
"""That are shown. Whatever there is besides has a node when a client asks for its path."""
MOST_CHILDREN = 1000
"""Elements of an array that have a node each."""


@dataclass(frozen=True, slots=True)
class Item:
    """A node."""

    symbol: Symbol
    parent: str
    """The path of the object around it; empty for programs and global variables."""
    variable: bool
    """It has a value; else it is an object with what is in it."""

    @property
    def path(self) -> str:
        """Which also names the node."""
        return self.symbol.path


def items(program: Program) -> list[Item]:
    """All nodes that are shown, each after the one around it."""
    return list(islice(_items(program), MOST_NODES))


def _items(program: Program) -> Iterator[Item]:
    ahead = [(symbol, "") for symbol in roots(program)][::-1]
    while ahead:
        symbol, parent = ahead.pop()
        if form_of(symbol.type) is not None:
            yield Item(symbol, parent, variable=True)
        elif _holds(symbol):
            yield Item(symbol, parent, variable=False)
            inner = members(program, symbol.path)[:MOST_CHILDREN]
            ahead += [(each, symbol.path) for each in reversed(inner)]


def _holds(symbol: Symbol) -> bool:
    """What refers to something else is no object: that is found where it lives."""
    type = symbol.type
    if symbol.slots:
        return False
    if isinstance(type, Record):
        return type.kind is not Kind.INTERFACE
    return isinstance(type, ArrayType) and isinstance(type.element, Record | ArrayType | StringType)


def writable(symbol: Symbol, program: Program) -> bool:
    """Whether tools may write it: no constant, and not in memory that the model keeps for itself."""
    if symbol.constant or symbol.tool != "write":
        return False
    if symbol.slots:
        return True
    found = program.layout.area_at(symbol.offset)
    if found is None:
        return True
    area, byte = found
    return area.protected(byte, 1 if symbol.bit is not None else symbol.type.size, "tool") is None
