"""Addresses as people write them (`A402.12`, `D100`, `%MW3`) to places, and back.

Two notations live side by side. Vendor: a prefix, a word, and a bit 00 to 15 after a dot (`A402.12`, also `A40212`).
IEC: `%`, the letter of a map, a width and a number that counts in that width (`%MW3` is bytes 6 and 7, `%MX3.2` is
bit 2 of byte 3). A model has either or both.
"""

import re
from collections.abc import Sequence

from scanbench.plcmodel.areas import Area, IecMap, Location

WIDTHS = {"X": 1, "B": 8, "W": 16, "D": 32, "L": 64}
LETTERS = {bits: letter for letter, bits in WIDTHS.items()}

_IEC = re.compile(r"%([IQM])([XBWDL]?)(\d{1,9})(?:\.(\d{1,9}))?")
_VENDOR = re.compile(r"%?([A-Z]*) ?(\d{1,9})(?:\.(\d{1,2})(?:-(\d{1,2}))?)?")


class NoSuchPlace(Exception):
    """The text is no address of this model; the message says why."""


def parse(areas: Sequence[Area], maps: Sequence[IecMap], text: str) -> Location:
    """The place that `text` names; `NoSuchPlace` says why there is none."""
    plain = text.strip().upper()
    if iec := _IEC.fullmatch(plain):
        letter, width, number, bit = iec.groups()
        for entry in maps:
            if entry.letter == letter:
                return _iec(entry, text, width or "X", int(number), None if bit is None else int(bit))
    if vendor := _VENDOR.fullmatch(plain):
        prefix, number, bit, last = vendor.groups()
        for area in areas:
            if prefix in (area.name, *area.aliases) or (not prefix and area.bare_bits and bit is not None):
                return _vendor(area, text, number, bit, last)
    raise NoSuchPlace(f"{text!r} is not an address of this model: {_known(areas, maps)}")


def _known(areas: Sequence[Area], maps: Sequence[IecMap]) -> str:
    names = [f"%{entry.letter}" for entry in maps]
    mapped = {(entry.area.name, entry.area.words) for entry in maps if entry.letter == entry.area.name}
    names += [area.name for area in areas if (area.name, area.words) not in mapped]
    return "its areas are " + ", ".join(names)


def _iec(entry: IecMap, text: str, width: str, number: int, bit: int | None) -> Location:
    if width == "X":
        if bit is None:
            raise NoSuchPlace(f"{text!r} names a bit and needs one: %{entry.letter}X{number}.0 to .7")
        if bit > 7:
            raise NoSuchPlace(f"{text!r}: bit {bit} does not exist, a byte has bits 0 to 7")
        byte, size = number, 1
    else:
        if bit is not None:
            raise NoSuchPlace(f"{text!r}: only %{entry.letter}X has a bit after the dot")
        size = WIDTHS[width] // 8
        byte = number * size
    if byte + size > entry.words * 2:
        last = entry.words * 2 // size - 1
        raise NoSuchPlace(f"{text!r} is outside of the area: the last one is %{entry.letter}{width}{last}")
    return Location(entry.area, entry.first * 2 + byte, bit, WIDTHS[width])


def _vendor(area: Area, text: str, digits: str, bit: str | None, last: str | None) -> Location:
    word = int(digits)
    if bit is None and word >= area.words and word // 100 < area.words and word % 100 <= 15:
        # A40212: no such word, so the last two digits are the bit. A word that exists is always meant as the word.
        word, bit = word // 100, digits[-2:]
    if word >= area.words:
        raise NoSuchPlace(f"{text!r} is outside of the area: the last word is {area.name}{area.words - 1}")
    if bit is None:
        return Location(area, word * 2, None, 16)
    number = int(bit)
    if last is not None:
        if (number, int(last)) not in ((0, 7), (8, 15)):
            raise NoSuchPlace(f"{text!r}: the bytes of a word are .00-07 and .08-15")
        return Location(area, word * 2 + number // 8, None, 8)
    if number > 15:
        raise NoSuchPlace(f"{text!r}: bit {number} does not exist, a word has bits 00 to 15")
    return Location(area, word * 2 + number // 8, number % 8, 1)


def write(area: Area, maps: Sequence[IecMap], byte: int, bit: int | None, bits: int) -> str:
    """The vendor's notation of a place. Where the area is an IEC one, or a byte starts no word, that may be `%MB3`."""
    for entry in maps:
        if entry.area.name == area.name and entry.letter == area.name:
            return _write_iec(entry, byte, bit, bits)
    word, odd = divmod(byte, 2)
    if bit is not None:
        return f"{area.name}{word}.{odd * 8 + bit:02}"
    if bits == 8 or odd:
        return f"{area.name}{word}.{'08-15' if odd else '00-07'}"
    return f"{area.name}{word}"


def _write_iec(entry: IecMap, byte: int, bit: int | None, bits: int) -> str:
    inside = byte - entry.first * 2
    if bit is not None:
        return f"%{entry.letter}X{inside}.{bit}"
    size = bits // 8
    if inside % size:
        return f"%{entry.letter}B{inside}"
    return f"%{entry.letter}{LETTERS[bits]}{inside // size}"
