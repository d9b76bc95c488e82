"""What a path means for a command: a symbol, its place in the image now, and whether a tool may write there."""

from dataclasses import dataclass

from scanbench.check.symbols import Symbol, UnknownPath, resolve
from scanbench.check.types import Elementary, StringType
from scanbench.check.values import parse_value
from scanbench.runtime.command import Patch, Refusal, View
from scanbench.runtime.rights import Right, may


@dataclass(frozen=True, slots=True)
class Target:
    """A place of the image that a value can be written to."""

    symbol: Symbol
    offset: int
    bit: int | None
    type: Elementary | StringType

    def patch(self, text: str) -> Patch | Refusal:
        """The patch that gives it this value, as typed."""
        try:
            data = parse_value(self.type, text)
        except ValueError as error:
            return Refusal(f"{self.symbol.path}: {error}")
        if self.bit is not None:
            return Patch.of_bit(self.offset, self.bit, data[0] != 0)
        return Patch.whole(self.offset, data)


def find(view: View, path: str) -> Symbol | Refusal:
    """The symbol of a path, or the reason why there is none, with near matches."""
    try:
        return resolve(view.program, path.strip())
    except UnknownPath as error:
        return Refusal(error.message, tuple(error.near))


def writable_target(view: View, path: str, verb: Right) -> Target | Refusal:
    """The place behind `path` if a tool may write (force ...) there now; `verb` is for the refusal."""
    symbol = find(view, path)
    if isinstance(symbol, Refusal):
        return symbol
    if not isinstance(symbol.type, Elementary | StringType):
        return Refusal(f"{symbol.path} is {symbol.type.name}, not a single value: {verb} one of its members instead")
    place = symbol.locate(view.memory)
    if place is None:
        return Refusal(f"{symbol.path} is not connected yet: its block has not been called. Let one scan run first")
    offset, bit = place
    reason = read_only_reason(view, symbol, offset, bit)
    if reason is not None:
        return Refusal(reason)
    return may(view.header.mode, verb, symbol.path) or Target(symbol, offset, bit, symbol.type)


def read_only_reason(view: View, symbol: Symbol, offset: int, bit: int | None) -> str | None:
    """Why a tool may not write here, or None. An in-out may lead into read-only memory: the place decides."""
    model = view.model
    found = view.program.layout.area_at(offset)
    if found is not None:
        area, byte = found
        if area.access(byte // 2, "tool") != "write":
            place = model.format(area, byte, bit, 1 if bit is not None else 8 * symbol.type.size)
            return (
                f"{place} is read-only for tools on {model.name}, as on the device. "
                "To see the program react to an error, raise it with the error simulator"
            )
        return None
    if not symbol.writable:
        return f"{symbol.path} is a constant: change it in the program and build"
    return None
