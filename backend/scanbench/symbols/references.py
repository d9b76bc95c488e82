"""What a reference, pointer or variable of an interface refers to, by name."""

from scanbench.program.copies import Image, Spot, referred
from scanbench.program.program import Program
from scanbench.program.types import BOOL, Kind, Record, Reference, Type
from scanbench.symbols.names import Names, names_of
from scanbench.symbols.symbols import Symbol, target_of

NOTHING = "NULL"


def refers_to(program: Program, memory: Image, symbol: Symbol) -> str:
    """`-> Main.tank[3].level (D120)`, or `NULL`; of a variable of an interface the instance: `-> Main.starting`."""
    type = symbol.type
    if not isinstance(type, Reference) or type.target is None:
        return NOTHING
    spot = target_of(symbol).locate(memory)
    if spot is None:
        return NOTHING
    return _named(names_of(program), type.target, spot)


def slot_text(names: Names, type: Reference, slot: bytes) -> str:
    """The same of what a reference holds, which may be a copy, or have been there once."""
    spot = referred(int.from_bytes(slot, "little"))
    if spot is None or type.target is None:
        return NOTHING
    return _named(names, type.target, (spot[0], spot[1] if type.target == BOOL else None))


def _named(names: Names, target: Type, spot: Spot) -> str:
    if isinstance(target, Record) and target.kind is Kind.INTERFACE:
        return f"-> {names.instance(spot[0], '')}"
    return f"-> {names.text(*spot, target)}"
