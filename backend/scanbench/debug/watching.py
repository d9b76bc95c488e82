"""Which bytes data breakpoints look at, and which accesses are theirs."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from scanbench.debug.placed import Placed, bytes_of
from scanbench.debug.values import value_text
from scanbench.engines.debug import READ, WRITE

_WANTED = {"read": READ, "write": WRITE, "change": WRITE, "access": READ | WRITE}


@dataclass(slots=True)
class _Place:
    """Where the variable of a breakpoint is now, and what was there when it was last looked at."""

    offset: int
    size: int
    mask: int
    last: bytes


class Watching:
    """The data breakpoints of one program. In-outs are followed anew in each scan, and whenever their block begins."""

    def __init__(self, placed: Iterable[Placed], memory: bytearray) -> None:
        self._placed = tuple(placed)
        self._memory = memory
        self._places: dict[Placed, _Place] = {}
        self.bytes: Mapping[int, int] = {}
        """For `Listen`."""

    @property
    def moving(self) -> bool:
        """Whether any of them may be somewhere else from one call to the next."""
        return any(each.symbol is not None and each.symbol.slots for each in self._placed)

    def follow(self) -> bool:
        """Finds out where they are and what is there; whether `bytes` is another."""
        places: dict[Placed, _Place] = {}
        bytes: dict[int, int] = {}
        for placed in self._placed:
            assert placed.symbol is not None
            found = bytes_of(placed.symbol, self._memory)
            if found is None:
                continue
            offset, size, mask = found
            places[placed] = _Place(offset, size, mask, self._value(offset, size, mask))
            for at in range(offset, offset + size):
                bytes[at] = bytes.get(at, 0) | _WANTED[placed.breakpoint.access]
        self._places = places
        if bytes == self.bytes:
            return False
        self.bytes = bytes
        return True

    def touched(self, offset: int, size: int, written: bool) -> list[tuple[Placed, str]]:
        """Whose access this is, and what to say of it."""
        found = []
        for placed, place in self._places.items():
            if offset + size <= place.offset or place.offset + place.size <= offset:
                continue
            access, before = placed.breakpoint.access, place.last
            if written:
                place.last = self._value(place.offset, place.size, place.mask)
            if access == "change" and before == place.last:
                continue
            if _WANTED[access] & (WRITE if written else READ):
                found.append((placed, self._text(placed, place, before, written)))
        return found

    def _value(self, offset: int, size: int, mask: int) -> bytes:
        data = self._memory[offset : offset + size]
        return bytes((data[0] & mask,)) if mask != 0xFF else bytes(data)

    def _text(self, placed: Placed, place: _Place, before: bytes, written: bool) -> str:
        symbol = placed.symbol
        assert symbol is not None
        now = value_text(symbol.type, place.last)
        if not written:
            return f"{symbol.path} was read" + (f": {now}" if now else "")
        if before != place.last and now:
            return f"{symbol.path} changed from {value_text(symbol.type, before)} to {now}"
        return f"{symbol.path} was written" + (f": {now}" if now else "")
