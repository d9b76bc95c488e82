"""Values of any type between where they are read and where they are stored.

A number is in a register as soon as it is read. The characters of a STRING and the bytes of an aggregate stay where they are,
until they are stored; so they are settled, which is copied, where code of the user runs before that (`disturbed`).
"""

from dataclasses import dataclass
from typing import TypeAlias

from scanbench.engines.native.emit_body import Body
from scanbench.engines.native.emit_function import Value
from scanbench.engines.native.emit_memory import Address, load_at, move, store
from scanbench.engines.native.emit_places import address
from scanbench.engines.native.emit_strings import Piece, assign, of_pointer, settled
from scanbench.program.program import Place
from scanbench.program.types import Elementary, StringType, Type


@dataclass(frozen=True, slots=True)
class Bytes:
    """An array or a structure, somewhere in memory."""

    pointer: str
    size: int


Held: TypeAlias = Value | list[Piece] | Bytes


def settle(body: Body, held: Held, disturbed: bool) -> Held:
    """The value, safe from the code that runs next, if it is going to be disturbed."""
    if not disturbed or isinstance(held, Value):
        return held
    if isinstance(held, Bytes):
        return Bytes(move(body, body.text.buffer(held.size), held.pointer, held.size), held.size)
    return settled(body, held)


def read(body: Body, pointer: str, type: Type, disturbed: bool) -> Held:
    """The value at an address."""
    if isinstance(type, StringType):
        return settle(body, [of_pointer(body, pointer, type)], disturbed)
    if isinstance(type, Elementary):
        return load_at(body, Address(pointer), type)
    return settle(body, Bytes(pointer, type.size), disturbed)


def put(body: Body, target: Place, held: Held) -> None:
    """Evaluates the target's address, and stores the value there."""
    if isinstance(held, Value):
        assert isinstance(target.type, Elementary)
        where = address(body, target)
        store(body, where, target.type, held)
    elif isinstance(held, Bytes):
        where = address(body, target)
        move(body, where.pointer, held.pointer, held.size)
    else:
        where = assign(body, target, held)
    body.unit.flavour.written(body, target, where)
