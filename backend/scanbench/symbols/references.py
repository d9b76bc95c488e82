"""What a reference, pointer or variable of an interface refers to, by name."""

from scanbench.program.copies import Image
from scanbench.program.program import Program
from scanbench.program.types import Kind, Record, Reference
from scanbench.symbols.names import names_of
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
    names = names_of(program)
    if isinstance(type.target, Record) and type.target.kind is Kind.INTERFACE:
        return f"-> {names.instance(spot[0], '')}"
    return f"-> {names.text(*spot, type.target)}"
