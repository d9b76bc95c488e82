"""Addresses as people write them (`A402.12`, `D100`, `X1F`, `%MW3`) to places, and back.

Two notations live side by side. Vendor: a prefix, a number, and for a bit of a word a dot and 00 to 15 (`A402.12`,
also `A40212`) or 0 to F (`D100.F`). What the number counts, words or bits, and to which base, is the area's business
(`X1F` is the 32nd bit of X on a MELSEC; 16 of them from X20 on are `K4X20`). IEC: `%`, the letter of a map, a width and a
number that counts in that width (`%MW3` is bytes 6 and 7, `%MX3.2` is bit 2 of byte 3). Plain areas count bits where there is one number (`%IX11` is `%IX1.3`), and
have modules where there is one more (`MODULE_BYTES`). A model has either or both, and
names of special places besides (`_ErrSta.7`).
"""

import re
from collections.abc import Mapping, Sequence

from scanbench.plcmodel.areas import Area, IecMap, Location

WIDTHS = {"X": 1, "B": 8, "W": 16, "D": 32, "L": 64}
LETTERS = {bits: letter for letter, bits in WIDTHS.items()}

_IEC = re.compile(r"%([IQM])([XBWDL]?)(\d{1,9})(?:\.(\d{1,9}))?(?:\.(\d{1,9}))?")
MODULE_BYTES = 64
"""Of a module in the plain areas: `%IX1.2.3` is bit 3 of byte 2 of module 1, `%IW1.2` its word 2."""
_VENDOR = re.compile(
    r"%?(?:K(16|[248]))?([A-Z]+[0-9A-F]{0,2}_|[A-Z]*) ?(\d[0-9A-F]{0,8})(?:\.([0-9A-F]{1,2})(?:-(\d{2}))?)?"
)
_NAMED = re.compile(r"([A-Z_]\w*)(?:\.(\d{1,2}))?")


class NoSuchPlace(Exception):
    """The text is no address of this model; the message says why."""


def parse(
    areas: Sequence[Area], maps: Sequence[IecMap], text: str, symbols: Mapping[str, Location] | None = None
) -> Location:
    """The place that `text` names; `NoSuchPlace` says why there is none. `symbols`: places by name, upper case."""
    plain = text.strip().upper()
    if symbols and (named := _NAMED.fullmatch(plain)) and (place := symbols.get(named[1])) is not None:
        return place if named[2] is None else _bit_of(place, text, int(named[2]))
    vendor = _VENDOR.fullmatch(plain)
    known = [area for area in areas if vendor and _means(area, vendor)]
    if iec := _IEC.fullmatch(plain):
        letter, width, *levels = iec.groups()
        numbers = [int(each) for each in levels if each is not None]
        bare = not width and len(numbers) == 1 and known  # %M100 where M is an area of the vendor's
        for entry in maps:
            if entry.letter == letter and not bare:
                return _iec(entry, text, width or "X", numbers)
    if vendor and known:
        return _vendor(known, text, vendor)
    raise NoSuchPlace(f"{text!r} is not an address of this model: {_known(areas, maps)}")


def _known(areas: Sequence[Area], maps: Sequence[IecMap]) -> str:
    names = [f"%{entry.letter}" for entry in maps]
    mapped = {(entry.area.name, entry.area.words) for entry in maps if entry.letter == entry.area.name}
    own = [area for area in areas if (area.name, area.words) not in mapped and not area.texts]
    names += [area.written for area in own]
    written = [_number(area, 0) for area in own[:1]] + [f"%{entry.letter}W0" for entry in maps[:1]]
    return f"its areas are {', '.join(dict.fromkeys(names))}; write it like {' or '.join(written)}"


def _bit_of(place: Location, text: str, bit: int) -> Location:
    if bit >= place.bits or place.bit is not None:
        raise NoSuchPlace(f"{text!r}: there is no bit {bit} in {place.bits} bits")
    return Location(place.area, place.byte + bit // 8, bit % 8, 1)


def _iec(entry: IecMap, text: str, width: str, numbers: list[int]) -> Location:
    plain = entry.area.name == entry.letter  # as the standard has it, by no vendor
    bit: int | None = None
    if width == "X":
        if len(numbers) == 1 and not plain:
            raise NoSuchPlace(f"{text!r} names a bit and needs one: %{entry.letter}X{numbers[0]}.0 to .7")
        *levels, bit = numbers if len(numbers) > 1 else divmod(numbers[0], 8)
        if bit > 7:
            raise NoSuchPlace(f"{text!r}: bit {bit} does not exist, a byte has bits 0 to 7")
    else:
        levels = numbers
    size = max(1, WIDTHS[width] // 8)
    if len(levels) > 1 and (not plain or len(levels) > 2):
        raise NoSuchPlace(f"{text!r}: only %{entry.letter}X has a bit after the dot")
    module, number = levels if len(levels) > 1 else (0, levels[0])
    if len(levels) > 1 and (number + 1) * size > MODULE_BYTES:
        most = MODULE_BYTES // size - 1
        raise NoSuchPlace(f"{text!r}: a module has {MODULE_BYTES} bytes, so the number after it goes up to {most}")
    byte = module * MODULE_BYTES + number * size
    if byte + size > entry.words * 2:
        last = f"{entry.words * 2 // size - 1}{'.7' if width == 'X' else ''}"
        raise NoSuchPlace(f"{text!r} is outside of the area: the last one is %{entry.letter}{width}{last}")
    return Location(entry.area, entry.first * 2 + byte, bit, WIDTHS[width])


# ---- the vendor's notation --------------------------------------------------------------------------------------


def _means(area: Area, match: re.Match[str]) -> bool:
    digits, prefix, _, bit, _ = match.groups()
    if digits and area.unit != "bit":
        return False
    return prefix in (area.written, *area.aliases) or (not prefix and area.bare_bits and bit is not None)


def _vendor(areas: Sequence[Area], text: str, match: re.Match[str]) -> Location:
    """Areas may share a prefix (A0 to A1471 and A10000 to A11535): the first that has the number."""
    nibbles, _, digits, bit, last = match.groups()
    refusals: list[NoSuchPlace] = []
    for area in areas:
        try:
            if area.unit == "bit":
                return _points(area, text, digits, bit, int(nibbles) * 4 if nibbles else 1)
            return _word(area, text, digits, bit, last)
        except NoSuchPlace as refusal:
            refusals.append(refusal)
    if bit is None and len(digits) > 2 and digits.isdigit() and int(digits[-2:]) <= 15:
        # A40212: no such word, so the last two digits are the bit. A word that exists is always meant as the word.
        for area in areas:
            if area.unit == "word" and area.radix == area.bit_radix == 10 and _index(area, digits[:-2]) is not None:
                return _word(area, text, digits[:-2], digits[-2:], None)
    raise refusals[0]


def _index(area: Area, digits: str) -> int | None:
    """The word or bit of the area that the digits number; None where there is none."""
    if area.radix == 10 and not digits.isdigit():
        return None
    index = int(digits, area.radix) - area.first
    return index if 0 <= index < (area.words * 16 if area.unit == "bit" else area.words) else None


def _outside(area: Area, text: str) -> NoSuchPlace:
    if area.unit == "bit":
        return NoSuchPlace(f"{text!r} is outside of the area: the last one is {_number(area, area.words * 16 - 1)}")
    first = f"the first word is {_number(area, 0)}, " if area.first else ""
    return NoSuchPlace(f"{text!r} is outside of the area: {first}the last word is {_number(area, area.words - 1)}")


def _points(area: Area, text: str, digits: str, bit: str | None, bits: int) -> Location:
    if bit is not None:
        raise NoSuchPlace(f"{text!r}: {area.written} counts in bits, which have no bits of their own")
    index = _index(area, digits)
    if index is None or index + bits > area.words * 16:
        raise _outside(area, text)
    if bits == 1:
        return Location(area, index // 8, index % 8, 1)
    if index % 8:
        raise NoSuchPlace(f"{text!r}: {bits} bits at once begin at a multiple of 8")
    return Location(area, index // 8, None, bits)


def _word(area: Area, text: str, digits: str, bit: str | None, last: str | None) -> Location:
    word = _index(area, digits)
    if word is None:
        raise _outside(area, text)
    if bit is None:
        return Location(area, word * 2, None, 16)
    if last is not None:
        if (bit, last) not in (("00", "07"), ("08", "15")):
            raise NoSuchPlace(f"{text!r}: the bytes of a word are .00-07 and .08-15")
        return Location(area, word * 2 + int(bit) // 8, None, 8)
    shown = "0 to F" if area.bit_radix == 16 else "00 to 15"
    number = int(bit, area.bit_radix) if area.bit_radix == 16 or bit.isdigit() else 16
    if number > 15:
        raise NoSuchPlace(f"{text!r}: bit {bit} does not exist, a word has bits {shown}")
    return Location(area, word * 2 + number // 8, number % 8, 1)


# ---- writing ----------------------------------------------------------------------------------------------------


def write(area: Area, maps: Sequence[IecMap], byte: int, bit: int | None, bits: int) -> str:
    """The vendor's notation of a place. Where the area is an IEC one, or a byte starts no word, that may be `%MB3`."""
    for entry in maps:
        if entry.area.name == area.name and entry.letter == area.name and area.unit == "word":
            return _write_iec(entry, byte, bit, bits)
    if area.unit == "bit":
        start = _number(area, byte * 8 + (bit or 0))
        return start if bit is not None else f"K{bits // 4}{start}"
    word, odd = divmod(byte, 2)
    if bit is not None:
        number = odd * 8 + bit
        return f"{_number(area, word)}.{f'{number:X}' if area.bit_radix == 16 else f'{number:02}'}"
    if bits == 8 or odd:
        return f"{_number(area, word)}.{'08-15' if odd else '00-07'}"
    return _number(area, word)


def _number(area: Area, index: int) -> str:
    """A number that would begin with a letter gets a 0 before it, as vendors write it: X0A."""
    digits = f"{index + area.first:X}" if area.radix == 16 else str(index + area.first)
    return area.written + ("" if digits[0].isdigit() else "0") + digits


def _write_iec(entry: IecMap, byte: int, bit: int | None, bits: int) -> str:
    inside = byte - entry.first * 2
    if bit is not None:
        return f"%{entry.letter}X{inside}.{bit}"
    size = bits // 8
    if inside % size:
        return f"%{entry.letter}B{inside}"
    return f"%{entry.letter}{LETTERS[bits]}{inside // size}"
