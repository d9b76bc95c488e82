"""What a variable is worth, with all that is in it: arrays and structures too."""

from scanbench.program.program import Program
from scanbench.program.types import ArrayType, Record
from scanbench.symbols.symbols import Symbol, members
from scanbench.symbols.values import format_value, python_value

Memory = bytearray | bytes | memoryview
Worth = bool | int | float | str | None | list["Worth"] | dict[str, "Worth"]


def worth(program: Program, memory: Memory, symbol: Symbol) -> Worth:
    """A value of Python; arrays are lists, structures dictionaries; None for an in-out that is bound to nothing."""
    if isinstance(symbol.type, ArrayType):
        return [worth(program, memory, each) for each in members(program, symbol.path)]
    if isinstance(symbol.type, Record):
        return {each.name: worth(program, memory, each) for each in members(program, symbol.path)}
    data = bytes_of(memory, symbol)
    return None if data is None else python_value(symbol.type, data)


def worth_text(program: Program, memory: Memory, symbol: Symbol) -> str:
    """As it is written in a program: `16#FF`, `[1, 2]`, `(a := 1, b := TRUE)`."""
    if isinstance(symbol.type, ArrayType):
        return f"[{', '.join(worth_text(program, memory, each) for each in members(program, symbol.path))}]"
    if isinstance(symbol.type, Record):
        inside = (f"{each.name} := {worth_text(program, memory, each)}" for each in members(program, symbol.path))
        return f"({', '.join(inside)})"
    data = bytes_of(memory, symbol)
    return "not bound yet" if data is None else format_value(symbol.type, data)


def bytes_of(memory: Memory, symbol: Symbol) -> bytes | None:
    """The bytes of a single value, a bit as one byte; None for an in-out that is bound to nothing."""
    place = symbol.locate(memory)
    if place is None:
        return None
    offset, bit = place
    data = bytes(memory[offset : offset + symbol.type.size])
    return data if bit is None else bytes((data[0] >> bit & 1,))
