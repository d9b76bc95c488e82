"""WriteVariables: what a protocol client writes into variables by their paths, as bytes."""

from dataclasses import dataclass
from typing import ClassVar

from scanbench.program.strings import characters, stored
from scanbench.program.types import BOOL, ArrayType, Elementary, Enumeration, Kind, StringType
from scanbench.runtime.command import Category, Command, Patch, Plan, Refusal, View
from scanbench.runtime.forces import forced_table
from scanbench.runtime.target import everywhere, find, writable_place
from scanbench.runtime.write_areas import Changes
from scanbench.symbols.symbols import Symbol
from scanbench.symbols.values import format_value

_SHOWN = 3
"""Variables that are named, where many are written."""


@dataclass(frozen=True, slots=True)
class VariableWrite:
    """The value of a variable, as it lies in memory: a BOOL is a byte, a text may end where its characters do."""

    path: str
    type: str
    """The name of its type as the client knows it: a program that was changed meanwhile may have a different one."""
    data: bytes


@dataclass(frozen=True, slots=True)
class WriteVariables(Command):
    """All of it, or nothing: single values, and arrays of them. As at a port of the device every mode permits it, and a bit that is
    forced stays as it is."""

    category: ClassVar[Category] = "write"

    writes: tuple[VariableWrite, ...]

    def plan(self, view: View) -> Plan | Refusal:
        """Patches of the bits that change: none where all of it is there already, or is forced."""
        patches: list[Patch] = []
        texts: list[str] = []
        forced, changes = forced_table(view), Changes(view.memory)
        for write in self.writes:
            symbol = find(view, write.path)
            if isinstance(symbol, Refusal):
                return symbol
            wrong = _wrong(symbol, write)
            if wrong:
                return Refusal(wrong)
            place = writable_place(view, symbol)
            if isinstance(place, Refusal):
                return place
            offset, bit = place
            if bit is None:
                mask, data = b"\xff" * len(write.data), _normal(symbol, write.data)
            else:
                mask, data = bytes((1 << bit,)), bytes(((write.data[0] != 0) << bit,))
            free = bytes(each & ~forced.get(at, (0, 0))[0] for at, each in enumerate(mask, offset))
            patches += changes.write(offset, free, data)
            texts.append(_said(symbol, write.data))
        more = len(texts) - _SHOWN
        said = "; ".join(texts[:_SHOWN]) + (f"; and {more} more" if more > 0 else "")
        return Plan(tuple(each for patch in patches for each in everywhere(view, patch)), said)


def _wrong(symbol: Symbol, write: VariableWrite) -> str:
    """Why these bytes are no value of the variable; empty where they are."""
    type, data = symbol.type, write.data
    if type.name != write.type:
        return f"{symbol.path} is {type.name} now, and no longer {write.type}: read it again first"
    element = type.element if isinstance(type, ArrayType) else type
    if isinstance(element, StringType):
        if isinstance(type, ArrayType):
            fits = len(data) == type.size
        else:
            fits = data == stored(element, characters(element, data))
        return "" if fits else f"{symbol.path}: {len(data)} bytes are no {type.name}"
    if not isinstance(element, Elementary) or element.kind is Kind.REF:
        return f"{symbol.path} is {type.name}, which cannot be written as a whole: write one of its members"
    if len(data) != type.size:
        return f"{symbol.path}: {len(data)} bytes are no {type.name}"
    if isinstance(element, Enumeration):
        known = {number for _, number in element.values}
        for at in range(0, len(data), element.size):
            number = int.from_bytes(data[at : at + element.size], "little", signed=element.signed)
            if number not in known:
                return f"{symbol.path}: {number} is not {element.name}; it has {', '.join(name for name, _ in element.values)}"
    return ""


def _normal(symbol: Symbol, data: bytes) -> bytes:
    """What lies in memory: a BOOL is 0 or 1."""
    element = symbol.type.element if isinstance(symbol.type, ArrayType) else symbol.type
    return bytes(each != 0 for each in data) if element == BOOL else data


def _said(symbol: Symbol, data: bytes) -> str:
    """What was written, for people: `Main.level := 5`."""
    if isinstance(symbol.type, ArrayType):
        return f"{symbol.path} written, {symbol.type.count} elements"
    return f"{symbol.path} := {format_value(symbol.type, data)}"
