"""What belongs to the device and to the system: no error of a project may write it, or the PLC would tell what is not so."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from scanbench.plcmodel.catalogue import ErrorAddress
from scanbench.plcmodel.model import ErrorEntry, Model
from scanbench.plcmodel.overlaps import Stretch, stretch, stretches

_NAMED = ("hold-bit", "forced-hold-bit", "output-off", "log-reset", "stopped-task")
"""Special addresses that do something, or are written, without a role."""


class Taken(NamedTuple):
    """Bits, and what they are for, as it follows `A400 is`."""

    bits: Stretch
    purpose: str


def taken(device: Model) -> Iterator[Taken]:
    """Everything of a model without errors of a project."""
    yield from _of_the_system(device)
    for error in device.errors():
        yield from _of_an_error(error)


def who_has(known: Sequence[Taken], bits: Stretch) -> str:
    """What the first of these bits that is taken is for; '' where none is."""
    return next((each.purpose for each in known if each.bits.meets(bits)), "")


def _of_the_system(device: Model) -> Iterator[Taken]:
    if device.code_word is not None:
        yield Taken(stretch(device.code_word), "the error code")
    if device.log is not None:
        log = device.log
        yield Taken(stretch(log.first, log.records * log.words), "in the error log")
        yield Taken(stretch(log.counter), "the counter of the error log")
    if device.error_time is not None:
        yield Taken(
            stretch(device.error_time.first, len(device.error_time.fields) // 2), "the time of the latest error"
        )
    if device.error_reset is not None:
        yield Taken(stretch(device.error_reset.bit), "the bit that clears errors")
        yield Taken(stretch(device.error_reset.code), "the code of the error to clear")
    if device.fatal.hold is not None:
        yield Taken(stretch(device.fatal.hold), "the hold bit")
    for told in () if device.standby is None else device.standby.places:
        yield Taken(stretch(told, -(-told.bits // 16)), "what says which CPU Unit controls")
    for special in device.specials:
        if special.role or special.name in _NAMED:
            yield Taken(stretch(special.location), f"{special.name} of the system")
    for query in device.queries:
        yield Taken(stretch(query.code), f"the code that {query.name} tells")
    for name, place, words in device.texts():
        yield Taken(stretch(place.first, words), f"in the texts of {name}")
    for instruction in device.instructions:
        if instruction.system_errors is not None:
            purpose = f"the number that makes {instruction.name} raise errors of the device"
            yield Taken(stretch(instruction.system_errors), purpose)


def _of_an_error(error: ErrorEntry) -> Iterator[Taken]:
    yield Taken(stretch(error.flag), f"the flag of {error.id!r}")
    for detail in error.details:
        for bits in stretches(detail.addresses):
            yield Taken(bits.words(), f"in a word that {error.id!r} writes its detail {detail.name} to")
    for bits in stretches(error.also):
        yield Taken(bits, f"what {error.id!r} writes too")


def addresses_of(error: ErrorEntry) -> Iterator[ErrorAddress]:
    """Every address of an error but its flag, in the order of a file: `Also` comes first."""
    yield from error.also
    for detail in error.details:
        yield from detail.addresses
