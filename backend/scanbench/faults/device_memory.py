"""Reading error memory: bits, numbers and texts of catalogue addresses, and what instructions put there."""

from scanbench.faults.device_shapes import DeviceDetail
from scanbench.plcmodel.model import ErrorAddress, ErrorDetail, ErrorEntry, Location, TextPlace
from scanbench.program.layout import Layout


class Memory:
    """The image, read by the addresses of its model."""

    def __init__(self, memory: bytearray | bytes | memoryview, layout: Layout) -> None:
        self._memory, self._layout, self.model = memory, layout, layout.model

    def byte(self, place: Location, more: int = 0) -> int:
        """One byte, `more` bytes after the place."""
        return self._memory[self._layout.areas[place.area.name] + place.byte + more]

    def number(self, place: Location, shift: int = 0, width: int | None = None) -> int:
        """So many bits, from `shift` bits after the place on."""
        first = (place.bit or 0) + shift
        bits = place.bits if width is None else width
        data = bytes(self.byte(place, each) for each in range(first // 8, -(-(first + bits) // 8)))
        return int.from_bytes(data, "little") >> first % 8 & (1 << bits) - 1

    @property
    def code(self) -> int:
        """What the code word shows."""
        return 0 if self.model.code_word is None else self.number(self.model.code_word)

    @property
    def code_text(self) -> str:
        """The same as the device shows it."""
        return "" if self.model.code_word is None else self.model.show_code(self.code)

    @property
    def codes(self) -> set[int]:
        """Every code of a present error that the memory shows: the code word, and those of parts of the device."""
        return {self.code, *(self.number(query.code) for query in self.model.queries)} - {0}

    def text(self, place: TextPlace, number: int) -> str:
        """The text that an instruction put there with this number: two characters in a word, the first in the high byte."""
        first = 2 * place.words * number
        data = bytes(self.byte(place.first, first + (each ^ 1)) for each in range(2 * place.words))
        return _readable(data.split(b"\0")[0])

    def text_of(self, error: ErrorEntry, details: tuple[DeviceDetail, ...]) -> str:
        """What the program said when it raised this error: a text of its instruction, else a detail that is a text."""
        values = {each.name: each.value for each in details}
        for made in self.model.instructions:
            number = values.get(made.detail, "")
            if made.error == error.id and made.texts is not None and number.isdigit() and int(number) <= made.maximum:
                return self.text(made.texts, int(number))
        texts = (each.name for each in error.details if each.addresses[0].is_text)
        return next((values[name] for name in texts if name in values), "")

    def field(self, address: ErrorAddress) -> int | None:
        """The number in a field; None where it is no decimal number although it should be."""
        assert address.location is not None
        value = self.number(address.location._replace(bits=16), address.shift, address.width)
        if address.kind != "BCD":
            return value
        digits = f"{value:X}"
        return int(digits) if digits.isdigit() else None

    def characters(self, address: ErrorAddress) -> str:
        """A text detail: the first character in the low byte."""
        assert address.location is not None
        data = bytes(self.byte(address.location, each) for each in range(address.maximum or 0))
        return _readable(data.split(b"\0")[0])


def said(detail: ErrorDetail, value: str) -> DeviceDetail:
    """A detail with its words."""
    label = detail.description or detail.addresses[0].description or detail.name
    if detail.control == "List":
        found = (detail.choice(each) for each in value.split("+"))
        words = [each.description or each.id for each in found if each is not None]
        return DeviceDetail(detail.name, value, f"{label}: {', '.join(words) or value}")
    return DeviceDetail(detail.name, value, f"{label}: {value}")


def number_text(detail: ErrorDetail, number: int) -> str:
    """A number as the catalogue writes it."""
    return f"{number:X}" if detail.addresses[0].base == 16 else str(number)


def _readable(data: bytes) -> str:
    return "".join(chr(each) if 32 <= each < 127 else "." for each in data)
