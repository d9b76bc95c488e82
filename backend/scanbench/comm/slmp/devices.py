"""Devices of a MELSEC as SLMP numbers them, and where they lie in the memory of the model. (SH-080008, device codes.)"""

from dataclasses import dataclass
from types import MappingProxyType

from scanbench.comm.slmp.frame import DECIMAL, HEXADECIMAL, Cursor, End, Refused
from scanbench.plcmodel.areas import Area
from scanbench.plcmodel.model import Model
from scanbench.wire.memory import AreaSpan

CODES = MappingProxyType({
    0x91: "SM", 0xA9: "SD", 0x9C: "X", 0x9D: "Y", 0x90: "M", 0x92: "L", 0x93: "F", 0x94: "V", 0xA0: "B", 0xA8: "D",
    0xB4: "W", 0xC2: "T", 0xC5: "C", 0xA1: "SB", 0xB5: "SW", 0x98: "S", 0xAF: "R", 0xB0: "ZR",
})  # fmt: skip
_ASCII = MappingProxyType({"TN": "T", "CN": "C"})
_HEXADECIMAL = frozenset({"X", "Y", "B", "W", "SB", "SW", "ZR"})
"""Those whose numbers are hexadecimal digits in ASCII code."""


@dataclass(frozen=True, slots=True)
class Device:
    """A device, and those that follow it."""

    area: Area
    number: int
    """A bit of an area that counts bits, else a word."""

    @property
    def is_bit(self) -> bool:
        """Whether the area counts bits."""
        return self.area.unit == "bit"

    def words(self, count: int) -> AreaSpan:
        """The bytes of `count` words, or of 16 times as many bits."""
        first, size = (
            (self.number // 8, 2 * count + (self.number % 8 != 0)) if self.is_bit else (2 * self.number, 2 * count)
        )
        return self._within(first, size)

    def bits(self, count: int) -> AreaSpan:
        """The bytes of `count` bits."""
        if not self.is_bit:
            raise Refused(End.DATA)
        first = self.number // 8
        return self._within(first, (self.number + count - 1) // 8 - first + 1)

    def _within(self, first: int, size: int) -> AreaSpan:
        if first + size > self.area.size:
            raise Refused(End.OUTSIDE)
        return AreaSpan(self.area.name, first, size)


def read_device(model: Model, cursor: Cursor) -> Device:
    """The device that a request names: number and code, or in ASCII code its name and digits."""
    if cursor.ascii:
        name = cursor.take(2).decode("latin-1").replace("*", "")
        name = _ASCII.get(name, name)
        number = cursor.digits(6, HEXADECIMAL if name in _HEXADECIMAL else DECIMAL)
    else:
        number = cursor.number(3)
        name = CODES.get(cursor.number(1), "")
    area = next((each for each in model.areas if name and (each.name == name or name in each.aliases)), None)
    if area is None:
        raise Refused(End.CANNOT)
    return Device(area, number)
