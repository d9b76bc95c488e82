"""Values of a trace's signals in the memory of the monitor."""

from collections.abc import Sequence
from typing import Literal

from scanbench.program.strings import characters, stored
from scanbench.program.types import StringType
from scanbench.runtime.command import Patch
from scanbench.verify.trace.bind import Signal

Agrees = Literal["same", "allowed", "open", "no"]
"""How a recorded value agrees with that of the reference. same: it is what is written. allowed: within the tolerance that
somebody chose. open: rounded numbers do not tell. no: it differs."""


def patch_of(signal: Signal, value: bytes) -> Patch:
    """Gives a variable a value."""
    symbol = signal.symbol
    if symbol.bit is not None:
        return Patch.of_bit(symbol.offset, symbol.bit, value != b"\0")
    return Patch.whole(symbol.offset, value)


def value_of(signal: Signal, memory: bytes | bytearray) -> bytes:
    """What a variable is."""
    symbol = signal.symbol
    if symbol.bit is not None:
        return bytes((memory[symbol.offset] >> symbol.bit & 1,))
    value = bytes(memory[symbol.offset : symbol.offset + signal.type.size])
    if isinstance(signal.type, StringType):  # bytes after its end have no meaning
        return stored(signal.type, characters(signal.type, value)).ljust(len(value), b"\0")
    return value


def put(memory: bytearray, patches: Sequence[Patch]) -> None:
    """Applies them."""
    for patch in patches:
        for at, (mask, data) in enumerate(zip(patch.mask, patch.data, strict=True), patch.offset):
            memory[at] = memory[at] & ~mask | data & mask
