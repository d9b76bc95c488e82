"""Which words FINS can read of a program: its variables at addresses, under their own names."""

from scanbench.comm.controller.contract import MOST
from scanbench.comm.fins.reading import TYPES
from scanbench.program.program import Program
from scanbench.program.types import Elementary, base_of
from scanbench.verify.trace.likeness import single_values


def located(program: Program) -> tuple[str, ...]:
    """What is to be read of a controller that runs this program: `Main.level=D100:INT` for each."""
    found = []
    for symbol in single_values(program):
        type = str(base_of(symbol.type)) if isinstance(symbol.type, Elementary) else ""
        if symbol.address is not None and type in TYPES:
            found.append(f"{symbol.path}={symbol.address}:{type}")
    return tuple(found[:MOST])
