"""Memory areas as FINS numbers them, and where they lie in the memory of a model. (W342, section 5-2-2; libfins; Omron CS/CJ mode.)"""

from dataclasses import dataclass
from enum import Enum

from scanbench.comm.fins.codes import End, Refused
from scanbench.plcmodel.areas import Area
from scanbench.plcmodel.model import Model
from scanbench.wire.memory import AreaSpan

_BITS = {0x30: "CIO", 0x31: "W", 0x32: "H", 0x33: "A", 0x02: "D"}
_WORDS = {0xB0: "CIO", 0xB1: "W", 0xB2: "H", 0xB3: "A", 0x82: "D"}
_FORCED_BITS = {0x70: "CIO", 0x71: "W", 0x72: "H"}
_FORCED_WORDS = {0xF0: "CIO", 0xF1: "W", 0xF2: "H"}
_FLAG, _FORCED_FLAG, _PRESENT = 0x09, 0x49, 0x89
_COUNTERS = 0x8000
"""Of the number of a timer or counter: it is a counter."""
_TIMERS = 4096
_BANK_BITS, _BANK_WORDS, _UPPER_BITS, _UPPER_WORDS = 0x20, 0xA0, 0xE0, 0x60
_BANKS, _UPPER_BANKS = 0x10, 0x09
_CURRENT_BIT, _CURRENT_WORD = 0x0A, 0x98
_PULSES, _TASK_FLAG, _TASK_STATUS, _INDEX, _DATA = 0x07, 0x06, 0x46, 0xDC, 0xBC
_UNUSED = {_PULSES: 1, _TASK_FLAG: 1, _TASK_STATUS: 1, _INDEX: 4, _DATA: 2}
"""What programs here never use, and the bytes of an element: clock pulses and condition flags, tasks, registers."""


class Form(Enum):
    """What an element is, and the bytes that it has in a frame."""

    BIT = 1
    WORD = 2
    FORCED_BIT = 3
    """A bit, and whether it is forced."""
    FORCED_WORD = 4
    """A word, and which of its bits are forced."""
    UNUSED = 5
    """Nothing of the image."""


@dataclass(frozen=True, slots=True)
class Element:
    """The first element that an address means."""

    form: Form
    size: int
    """Bytes of an element in a frame."""
    area: Area | None = None
    """None where nothing of the image is meant: it is 0, and nothing can change it."""
    word: int = 0
    bit: int = 0

    def spans(self, count: int) -> tuple[AreaSpan, ...]:
        """The bytes that `count` elements are read from; `Refused` outside of the area."""
        if self.area is None:
            return ()
        bits = self.form in (Form.BIT, Form.FORCED_BIT)
        last = self.word + ((self.bit + max(count, 1) - 1) // 16 if bits else max(count, 1) - 1)
        if self.word >= self.area.words:
            raise Refused(End.BEGINS_OUTSIDE)
        if last >= self.area.words:
            raise Refused(End.ENDS_OUTSIDE)
        span = AreaSpan(self.area.name, 2 * self.word, 2 * (last - self.word + 1))
        if self.form in (Form.FORCED_BIT, Form.FORCED_WORD):
            return span, AreaSpan(span.area, span.byte, span.size, forced=True)
        return (span,)

    def encode(self, data: tuple[bytes, ...], count: int) -> bytes:
        """`count` elements of what was read from `spans`, as a frame has them."""
        if self.area is None:
            return bytes(self.size * count)
        if self.form is Form.WORD:
            return swapped(data[0])[: 2 * count]
        if self.form is Form.FORCED_WORD:
            return swapped(data[0]) + swapped(data[1])
        bits = bytes(data[0][at // 8] >> at % 8 & 1 for at in range(self.bit, self.bit + count))
        if self.form is Form.BIT:
            return bits
        return bytes((bits[0] | (data[1][self.bit // 8] >> self.bit % 8 & 1) << 1,))


def swapped(data: bytes) -> bytes:
    """Words in the other order of bytes: high first in a frame, low first in memory."""
    turned = bytearray(len(data))
    turned[0::2], turned[1::2] = data[1::2], data[0::2]
    return bytes(turned)


def word_code(area: str) -> int | None:
    """The code of the words of an area, by its name: CIO, W, H, A, D, or a bank E0 to E18; None where there is none."""
    code = next((code for code, name in _WORDS.items() if name == area), None)
    if code is not None or area[:1] != "E":
        return code
    try:
        bank = int(area[1:], 16)
    except ValueError:
        return None
    if bank < _BANKS:
        return _BANK_WORDS + bank
    return _UPPER_WORDS + bank - _BANKS if bank < _BANKS + _UPPER_BANKS else None


def element(model: Model, code: int, address: int, bit: int) -> Element:
    """What an area code and an address mean; `Refused` where the model has no such memory."""
    if code in (_FLAG, _FORCED_FLAG):
        _timer(address)
        return Element(Form.UNUSED, 1)
    if code == _PRESENT:
        return _in(model, "C" if address & _COUNTERS else "T", Form.WORD, _timer(address), 0)
    if code in _UNUSED:
        return Element(Form.UNUSED, _UNUSED[code])
    for form, names in (
        (Form.BIT, _BITS), (Form.WORD, _WORDS), (Form.FORCED_BIT, _FORCED_BITS), (Form.FORCED_WORD, _FORCED_WORDS),
    ):  # fmt: skip
        if code in names:
            return _in(model, names[code], form, address, bit)
    form, bank = _bank(code)
    return _in(model, f"E{bank:X}", form, address, bit)


def _timer(address: int) -> int:
    number = address & ~_COUNTERS
    if number >= _TIMERS:
        raise Refused(End.BEGINS_OUTSIDE)
    return number


def _bank(code: int) -> tuple[Form, int]:
    """Of the extended data memory; the current bank is bank 0, as nothing here selects one."""
    if code in (_CURRENT_BIT, _CURRENT_WORD):
        return (Form.BIT if code == _CURRENT_BIT else Form.WORD), 0
    for first, form, count, bank in (
        (_BANK_BITS, Form.BIT, _BANKS, 0), (_BANK_WORDS, Form.WORD, _BANKS, 0),
        (_UPPER_BITS, Form.BIT, _UPPER_BANKS, 0x10), (_UPPER_WORDS, Form.WORD, _UPPER_BANKS, 0x10),
    ):  # fmt: skip
        if first <= code < first + count:
            return form, bank + code - first
    raise Refused(End.NO_AREA)


def _in(model: Model, name: str, form: Form, address: int, bit: int) -> Element:
    """In the area of this name, or in the part of it that has words with such numbers: A10000."""
    parts = [each for each in model.areas if each.name == name or (each.first and each.written == name)]
    if not parts:
        raise Refused(End.NO_AREA)
    if bit > 15:
        raise Refused(End.BEGINS_OUTSIDE)
    area = next((each for each in parts if each.first <= address < each.first + each.words), None)
    if area is None:
        raise Refused(End.BEGINS_OUTSIDE)
    size = {Form.BIT: 1, Form.WORD: 2, Form.FORCED_BIT: 1, Form.FORCED_WORD: 4}[form]
    return Element(form, size, area, address - area.first, bit if form in (Form.BIT, Form.FORCED_BIT) else 0)
