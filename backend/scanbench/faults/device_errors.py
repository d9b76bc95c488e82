"""Errors by what the device calls them: a code, and the word of information that goes with it."""

from collections.abc import Iterator

from scanbench.faults.details import word_text
from scanbench.faults.reference import ErrorRef
from scanbench.plcmodel.model import ErrorAddress, ErrorDetail, ErrorEntry, Location, Model, Severity

_SPECIAL_UNIT = 0x8000
"""With this bit a unit number is that of a Special I/O Unit; those come after the 16 CPU Bus Units."""


def by_code(model: Model, code: int, severity: Severity) -> ErrorEntry | None:
    """The error that has this code; the one of just this code before one whose details add up to it."""
    known = [error for error in model.errors() if error.severity == severity and not error.user and error.coded]
    exact = next((error for error in known if error.code == code), None)
    return exact or next((error for error in known if any(code in each for each in error.codes)), None)


def reference(error: ErrorEntry, code: int, information: int) -> ErrorRef:
    """The error with details that fit code and information; what does not fit stays as the catalogue begins it."""
    place = next((place for place in _places(error) if place is not None), None)
    found = ((detail.name, _said(detail, code - error.code, information, place)) for detail in error.details)
    return ErrorRef(error.id, tuple((name, text) for name, text in found if text is not None))


def _places(error: ErrorEntry) -> Iterator[Location | None]:
    return (address.location for detail in error.details for address in detail.addresses)


def _said(detail: ErrorDetail, added: int, information: int, place: Location | None) -> str | None:
    """What code or information say about a detail."""
    if detail.control == "List":
        choices = detail.addresses
        adding = [each.id for each in choices if added and each.add_to_code and each.value == added]
        if detail.word is not None and not adding:
            return word_text(detail, information) if information and _is_in(detail.word, place) else None
        shown = [each.id for each in choices if _shows(each, information, place)]
        return next(iter(adding or shown), None)
    address = detail.addresses[0]
    number = added if address.add_to_code else _number(address, information, place)
    low, high = address.minimum or 0, address.maximum or 0
    if number is None or not low <= number <= high:
        return None
    return f"{number:X}" if address.base == 16 else str(number)


def _shows(address: ErrorAddress, information: int, place: Location | None) -> bool:
    """Whether the word of information is what this choice would write there."""
    if address.kind != "Bit":
        return _number(address, information, place) == address.value
    if address.location is None or not _is_in(address.location, place):
        return False
    return bool(information >> (address.location.byte % 2 * 8 + (address.location.bit or 0)) & 1)


def _number(address: ErrorAddress, information: int, place: Location | None) -> int | None:
    if address.location is None or not _is_in(address.location, place) or address.is_text:
        return None
    if address.kind == "BitArray":
        return (information & ~_SPECIAL_UNIT) + 16 if information & _SPECIAL_UNIT else information
    field = information >> address.shift & (1 << address.width) - 1
    digits = f"{field:X}"
    return (int(digits) if digits.isdigit() else None) if address.kind == "BCD" else field


def _is_in(location: Location, word: Location | None) -> bool:
    return word is not None and (location.area.name, location.word) == (word.area.name, word.word)
