"""A project's hardware configuration: `hardware.json` says what is fitted. Data, and which error instances there are by it.

Without the file nothing is known about what is fitted, and every error of the model can be raised.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import product

from scanbench.plcmodel.catalogue import FIRST_SPECIAL, ErrorDetail, ErrorEntry

HARDWARE_FILE = "hardware.json"
"""The name of the file, at the top of a project."""
Details = tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True)
class Fitted:
    """A unit, a board, a rack, or a number that the program raises errors with; `name` is what people call it."""

    kind: str
    number: int | None = None
    rack: int | None = None
    slot: int | None = None
    name: str = ""
    words: tuple[str, ...] = ()
    """The words of inputs and outputs that lead to the terminals of the unit, as `Model.word_text` writes them."""


def fitted_instances(fitted: tuple[Fitted, ...] | None, error: ErrorEntry) -> tuple[Details, ...] | None:
    """The details of each instance of an error that the hardware has; None where it does not say: all can be raised."""
    if fitted is None:
        return None
    if error.hardware:
        return ((),) if any(_is_of(each, error) for each in fitted) else ()
    counted = [each for each in error.identifying if each.hardware]
    if not counted:
        return None
    found: dict[Details, Fitted] = {}
    for each in fitted:
        values = [_value(detail, each) for detail in counted]
        if all(value is not None for value in values):
            details = tuple((detail.name, str(value)) for detail, value in zip(counted, values, strict=True))
            found.setdefault(details, each)
    free = [[(detail.name, text) for text in _texts(detail)] for detail in error.identifying if not detail.hardware]
    whole = (dict((*details, *rest)) for details in found for rest in product(*free))
    order = [detail.name for detail in error.identifying]
    return tuple(tuple((name, each[name]) for name in order) for each in whole)


def is_fitted(fitted: tuple[Fitted, ...] | None, error: ErrorEntry, details: Details) -> bool:
    """Whether the error instance with these details is one of what is fitted."""
    known = fitted_instances(fitted, error)
    return known is None or details in known


def can_be_absent(error: ErrorEntry) -> bool:
    """Whether the device can report the error of what is not fitted."""
    return any(each.absent for each in error.identifying)


@dataclass(frozen=True, slots=True)
class FittedKind:
    """Which instances of one kind of error are fitted, and what people call them: made once for all rows of the kind."""

    error: ErrorEntry
    instances: frozenset[Details] | None
    """None: nothing is known, all can be raised."""
    names: Mapping[tuple[str, ...], str]
    """By the values of the details that hardware counts; empty for a part that is there once."""

    def has(self, details: Details) -> bool:
        """Whether this instance is fitted; without details, whether any is."""
        if self.instances is None:
            return True
        return details in self.instances if details or not self.error.identifying else bool(self.instances)

    def name(self, details: Details) -> str:
        """What people call the unit or the number of an instance; empty where nobody says."""
        given = dict(details)
        return self.names.get(tuple(given.get(each.name, "") for each in _counted(self.error)), "")


def fitted_kind(fitted: tuple[Fitted, ...] | None, error: ErrorEntry) -> FittedKind:
    """What is fitted of a kind of error."""
    instances, counted = fitted_instances(fitted, error), _counted(error)
    names: dict[tuple[str, ...], str] = {}
    for each in fitted or ():
        values = [_value(detail, each) for detail in counted]
        if counted or _is_of(each, error):
            names.setdefault(tuple(value or "-" for value in values), each.name)
    return FittedKind(error, None if instances is None else frozenset(instances), names)


def _is_of(each: Fitted, error: ErrorEntry) -> bool:
    """Whether it is what has to be fitted for an error, where no detail says which."""
    return each.kind == error.hardware and error.hardware_number in (None, each.number)


def _counted(error: ErrorEntry) -> list[ErrorDetail]:
    return [] if error.hardware else [each for each in error.identifying if each.hardware]


def _value(detail: ErrorDetail, of: Fitted) -> str | None:
    """What a detail says of something that is fitted, as the catalogue writes it; None: it is not about that."""
    number = _number(detail, of)
    address = detail.addresses[0]
    if number is None or not (address.minimum or 0) <= number <= (address.maximum or number):
        return None
    return f"{number:X}" if address.base == 16 else str(number)


def _number(detail: ErrorDetail, of: Fitted) -> int | None:
    match detail.hardware:
        case "rack":
            return of.number if of.kind == "rack" else of.rack
        case "slot":
            return of.slot
        case "basic-io-unit":
            place = of.slot if detail.name == "slot" else of.rack
            return place if of.kind == "basic-io-unit" else None
        case "unit":
            if of.kind == "special-io-unit" and of.number is not None:
                return FIRST_SPECIAL + of.number
            return of.number if of.kind == "cpu-bus-unit" else None
        case kind:
            return of.number if of.kind == kind else None


def _texts(detail: ErrorDetail) -> Iterator[str]:
    """Every value of a detail that no hardware counts; of a number only the first, as nothing says which there are."""
    if detail.control == "List":
        yield from (each.id for each in detail.addresses)
        return
    address = detail.addresses[0]
    first = address.default if address.default is not None else address.minimum or 0
    yield f"{first:X}" if address.base == 16 else str(first)
