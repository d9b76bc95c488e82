"""Which bytes data breakpoints look at, and which accesses are theirs."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass

from scanbench.debug.placed import Placed, bytes_of
from scanbench.engines.debug import READ, WRITE
from scanbench.symbols.values import format_value

_WANTED = {"read": READ, "write": WRITE, "change": WRITE, "access": READ | WRITE}


@dataclass(slots=True)
class _Place:
    """Where the variable of a breakpoint is now, and what was there when it was last looked at."""

    offset: int
    size: int
    mask: int
    last: bytes


class Watching:
    """The data breakpoints of one program. In-outs are followed again in each scan, and whenever their block begins."""

    def __init__(self, placed: Iterable[Placed], memory: bytearray) -> None:
        self._placed = tuple(placed)
        self._memory = memory
        self._places: dict[Placed, list[_Place]] = {}
        self.bytes: Mapping[int, int] = {}
        """For `Listen`."""

    @property
    def moving(self) -> bool:
        """Whether any of them may be somewhere else from one call to the next."""
        return any(each.symbol is not None and each.symbol.slots for each in self._placed)

    def follow(self) -> bool:
        """Finds their places and values; returns whether `bytes` changed."""
        bytes: dict[int, int] = {}
        self._places = {}
        for placed in self._placed:
            places = self._places[placed] = self._places_of(placed)
            for place in places:
                for at in range(place.offset, place.offset + place.size):
                    bytes[at] = bytes.get(at, 0) | _WANTED[placed.breakpoint.access]
        if bytes == self.bytes:
            return False
        self.bytes = bytes
        return True

    def look(self) -> None:
        """Finds out what is there now: something else than the program wrote."""
        for places in self._places.values():
            for place in places:
                place.last = self._value(place.offset, place.size, place.mask)

    def touched(
        self, offset: int, size: int, bits: int, written: bool, copying: Callable[[Placed], bool]
    ) -> list[tuple[Placed, str]]:
        """Whose access this is, and what to say of it; `bits`: see `DebugEngine`. `copying`: a block copies what was passed to
        it, or copies it back; that is nobody's access."""
        found: dict[Placed, str] = {}
        for placed, places in self._places.items():
            for place in places:
                if offset + size <= place.offset or place.offset + place.size <= offset or not bits & place.mask:
                    continue
                before = place.last
                if written:
                    place.last = self._value(place.offset, place.size, place.mask)
                if self._is_for(placed, before != place.last, written) and not copying(placed):
                    found.setdefault(placed, self._text(placed, place, before, written))
        return list(found.items())

    @staticmethod
    def _is_for(placed: Placed, changed: bool, written: bool) -> bool:
        access = placed.breakpoint.access
        return bool(_WANTED[access] & (WRITE if written else READ)) and (changed or access != "change")

    def _places_of(self, placed: Placed) -> list[_Place]:
        found = (bytes_of(each, self._memory) for each in (placed.symbol, placed.copy) if each is not None)
        return [_Place(*each, self._value(*each)) for each in found if each is not None]

    def _value(self, offset: int, size: int, mask: int) -> bytes:
        data = self._memory[offset : offset + size]
        return bytes((data[0] & mask,)) if mask != 0xFF else bytes(data)

    def _text(self, placed: Placed, place: _Place, before: bytes, written: bool) -> str:
        symbol = placed.symbol
        assert symbol is not None
        now = format_value(symbol.type, place.last)
        if not written:
            return f"{symbol.path} was read" + (f": {now}" if now else "")
        if before != place.last and now:
            return f"{symbol.path} changed from {format_value(symbol.type, before)} to {now}"
        return f"{symbol.path} was written" + (f": {now}" if now else "")
