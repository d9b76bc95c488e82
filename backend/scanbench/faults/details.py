"""Details of an error: what was chosen or entered, checked, and the bits that represent it."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from difflib import get_close_matches

from scanbench.faults.reference import ErrorRef
from scanbench.plcmodel.model import ErrorAddress, ErrorDetail, ErrorEntry, Location
from scanbench.program.layout import Layout
from scanbench.runtime.command import Refusal

_WORD = re.compile(r"16#[0-9A-Fa-f]{1,4}")


@dataclass(frozen=True, slots=True)
class Bits:
    """Bits of one byte of the image: which, and their values."""

    offset: int
    mask: int
    value: int


@dataclass(frozen=True, slots=True)
class Chosen:
    """An error with all its details decided."""

    error: ErrorEntry
    details: tuple[tuple[str, str], ...]
    """(detail, chosen id or number as text), in the order of the catalogue.

    Several bits of a List in one word, or others than its choices, are the word as a number: `16#0030`.
    """
    code: int
    contents: tuple[Bits, ...]
    """What the details write."""
    marks: tuple[Bits, ...]
    """The flag, and what else the error writes."""

    @property
    def lasting(self) -> bool:
        """Whether the cause is still there after a restart, and after the device's own way to clear it."""
        chosen = (detail.choice(dict(self.details).get(detail.name, "")) for detail in self.error.details)
        return self.error.lasting or any(choice is not None and choice.lasting for choice in chosen)

    @property
    def bits(self) -> tuple[Bits, ...]:
        """Everything that the error writes."""
        return self.contents + self.marks

    @property
    def instance(self) -> ErrorRef:
        """The error with just the details that tell it apart from others of its kind."""
        names = {each.name for each in self.error.identifying}
        return ErrorRef(self.error.id, tuple(each for each in self.details if each[0] in names))

    def same_instance(self, other: "Chosen") -> bool:
        """Whether the two are one error, whatever else their details say."""
        return self.error is other.error and self.instance == other.instance

    @property
    def code_text(self) -> str:
        """The code as the vendor writes it."""
        return self.error.show(self.code)

    def __str__(self) -> str:
        return ", ".join(f"{name}={value}" for name, value in self.details)


def choose(error: ErrorEntry, given: Mapping[str, str], layout: Layout) -> Chosen | Refusal:
    """Decides every detail: as given, else the catalogue's default."""
    names = [detail.name for detail in error.details]
    for name in given:
        if name not in names:
            known = f"its details are {', '.join(names)}" if names else "it has none"
            return Refusal(f"{error.id} has no detail {name}: {known}", tuple(get_close_matches(name, names)))
    decided: list[tuple[str, str]] = []
    numbers: dict[str, int] = {}
    contents: list[Bits] = []
    code = error.code
    for detail in error.details:
        text = given.get(detail.name)
        word = None if text is None else _whole_word(detail, text)
        if word is not None:
            text = word_text(detail, word)
            if detail.choice(text) is None:
                decided.append((detail.name, text))
                contents += _word_bits(detail, word, layout)
                continue
        found = _decide(error, detail, text)
        if isinstance(found, Refusal):
            return found
        address, number, text = found
        decided.append((detail.name, text))
        numbers[detail.name] = number
        contents += _bits(address, number, layout)
        if address.add_to_code:
            code += number
    marks = field_bits(error.flag, 0, 1, 1, layout)
    for address in error.also:
        number = numbers.get(address.id, 1) if address.value is None else address.value
        marks += _bits(address, number, layout)
    return Chosen(error, tuple(decided), code & error.code_limit, tuple(contents), tuple(marks))


def code_text_with(error: ErrorEntry, given: Mapping[str, str]) -> str:
    """The code of an error with these details, as the vendor writes it. Without details, and with ones that do not fit, it is the
    kind's own."""
    return code_text_raised(error, given) if given else error.code_text


def code_text_raised(error: ErrorEntry, given: Mapping[str, str]) -> str:
    """The code that an error has when it is raised with these details: those that are not given have their defaults, so that a FAL
    of which nothing is said is number 1. With details that do not fit it is the kind's own."""
    code = error.code
    for detail in error.details:
        text = given.get(detail.name)
        word = None if text is None else _whole_word(detail, text)
        if word is not None:
            text = word_text(detail, word)
            if detail.choice(text) is None:
                continue  # several choices of one word add nothing
        found = _decide(error, detail, text)
        if isinstance(found, Refusal):
            return error.code_text
        address, number, _ = found
        code += number if address.add_to_code else 0
    return error.show(code & error.code_limit)


def word_text(detail: ErrorDetail, word: int) -> str:
    """What a List whose choices are bits of one word says when this is the word: the choice, or the word itself."""
    return next((each.id for each in detail.addresses if 1 << _bit_in_word(each) == word), f"16#{word:04X}")


def field_bits(location: Location, shift: int, width: int, value: int, layout: Layout) -> list[Bits]:
    """The bits of a field of `width` bits that begins `shift` bits after `location`."""
    first = layout.areas[location.area.name] * 8 + location.byte * 8 + (location.bit or 0) + shift
    found: list[Bits] = []
    done = 0
    while done < width:
        offset, bit = divmod(first + done, 8)
        count = min(8 - bit, width - done)
        mask = (1 << count) - 1
        found.append(Bits(offset, mask << bit, (value >> done & mask) << bit))
        done += count
    return found


def _decide(error: ErrorEntry, detail: ErrorDetail, text: str | None) -> tuple[ErrorAddress, int, str] | Refusal:
    if detail.control == "List":
        return _decide_choice(error, detail, text)
    address = detail.addresses[0]
    if address.is_text:
        return _decide_text(error, detail, address, text or "")
    if text is None:
        start = address.default if address.default is not None else address.minimum
        number = start if start is not None else 0
    else:
        parsed = _number(text, address.base)
        if parsed is None:
            return Refusal(f"{error.id}: {detail.name}={text} is not a number to the base {address.base}")
        number = parsed
    low, high = address.minimum or 0, _highest(address)
    if not low <= number <= high:
        return Refusal(f"{error.id}: {detail.name}={text} is outside of {low} to {high}; nothing was written")
    return address, number, f"{number:X}" if address.base == 16 else str(number)


def _decide_text(
    error: ErrorEntry, detail: ErrorDetail, address: ErrorAddress, text: str
) -> tuple[ErrorAddress, int, str] | Refusal:
    most = address.maximum or 0
    if len(text) > most:
        return Refusal(f"{error.id}: {detail.name} has {len(text)} characters, at most {most} fit; nothing was written")
    odd = next((character for character in text if not " " <= character <= "~"), None)
    if odd is not None:
        return Refusal(f"{error.id}: {detail.name} takes ASCII characters, {odd!r} is none; nothing was written")
    return address, int.from_bytes(text.encode("ascii"), "little"), text


def _decide_choice(error: ErrorEntry, detail: ErrorDetail, text: str | None) -> tuple[ErrorAddress, int, str] | Refusal:
    ids = [address.id for address in detail.addresses]
    wanted = (text if text is not None else detail.default or ids[0]).strip()
    address = detail.choice(wanted)
    if address is None:
        near = tuple(get_close_matches(wanted, ids, cutoff=0.4)) or tuple(ids)
        return Refusal(f"{error.id}: {detail.name} cannot be {wanted!r}; it is one of {', '.join(ids)}", near)
    return address, address.value if address.value is not None else 1, wanted


def _bits(address: ErrorAddress, number: int, layout: Layout) -> list[Bits]:
    if address.location is None:
        return []
    if address.kind == "Bit":
        return field_bits(address.location, 0, 1, 1, layout)
    if address.kind == "BitArray":
        return field_bits(address.location, number, 1, 1, layout)
    if address.is_text:
        return field_bits(address.location, 0, 8 * (address.maximum or 0), number, layout)
    value = int(str(number), 16) if address.kind == "BCD" else number
    return field_bits(address.location, address.shift, address.width, value, layout)


def _whole_word(detail: ErrorDetail, text: str) -> int | None:
    """The word that a List is given in place of a choice."""
    return int(text.strip()[3:], 16) if detail.word is not None and _WORD.fullmatch(text.strip()) else None


def _word_bits(detail: ErrorDetail, word: int, layout: Layout) -> list[Bits]:
    """All choices, on or off, and the other bits that are on in the word, which may belong to other details."""
    assert detail.word is not None
    bits = {_bit_in_word(each) for each in detail.addresses} | {bit for bit in range(16) if word >> bit & 1}
    return [part for bit in sorted(bits) for part in field_bits(detail.word, bit, 1, word >> bit, layout)]


def _bit_in_word(address: ErrorAddress) -> int:
    assert address.location is not None
    return address.location.byte % 2 * 8 + (address.location.bit or 0)


def _highest(address: ErrorAddress) -> int:
    if address.maximum is not None:
        return address.maximum
    if address.kind == "BCD":
        return int(10 ** (address.width // 4)) - 1
    return (1 << address.width) - 1


def _number(text: str, base: int) -> int | None:
    plain = text.strip().removeprefix("#").removeprefix("16#").replace("_", "")
    if text.strip().startswith("16#") or plain[:2].lower() == "0x":
        base = 16
    try:
        return int(plain, base)
    except ValueError:
        return None
