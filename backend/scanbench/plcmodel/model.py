"""What is known about one PLC model: the contract of this room. Made by `load`, never changed afterwards."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

from scanbench.plcmodel import address
from scanbench.plcmodel.areas import Access, AccessRange, Area, IecMap, Location, Who
from scanbench.plcmodel.catalogue import (
    Control,
    ErrorAddress,
    ErrorDetail,
    ErrorEntry,
    ErrorGroup,
    Kind,
    Severity,
    Wording,
)

__all__ = [
    "Access",
    "AccessRange",
    "Area",
    "Control",
    "ErrorAddress",
    "ErrorDetail",
    "ErrorEntry",
    "ErrorGroup",
    "ErrorLog",
    "FatalBehaviour",
    "IecMap",
    "Kind",
    "Location",
    "Model",
    "Severity",
    "Special",
    "Who",
    "WordRange",
    "Wording",
]


@dataclass(frozen=True, slots=True)
class WordRange:
    """Words `first` to `last` of an area, both included."""

    area: Area
    first: int
    last: int


@dataclass(frozen=True, slots=True)
class FatalBehaviour:
    """What happens to memory when a fatal error stops the program."""

    outputs: tuple[WordRange, ...] = ()
    """Go to 0 in any case."""
    cleared: tuple[Area, ...] = ()
    """Go to 0 too, unless the hold bit is on or the error keeps the memory."""
    hold: Location | None = None


@dataclass(frozen=True, slots=True)
class ErrorLog:
    """The model's own error log: `records` records of `words` words from `first` on, and the word that counts them."""

    first: Location
    records: int
    words: int
    counter: Location


@dataclass(frozen=True, slots=True)
class Special:
    """An address with a meaning for the system: first cycle flag, clock, ..."""

    name: str
    location: Location
    text: str
    description: str
    source: str
    verified: bool


@dataclass(frozen=True)
class Model:
    """One PLC model."""

    name: str
    vendor: str
    description: str
    in_out: Literal["reference", "value"]
    areas: tuple[Area, ...]
    iec_maps: tuple[IecMap, ...]
    catalogue: tuple[ErrorGroup, ...]
    code_word: Location | None = None
    """Shows the code of the most serious error present."""
    status_words: tuple[str, ...] = ()
    """Addresses worth showing beside the catalogue."""
    fatal: FatalBehaviour = FatalBehaviour()
    log: ErrorLog | None = None
    specials: tuple[Special, ...] = ()
    wordings: tuple[Wording, ...] = ()

    def area(self, name: str) -> Area | None:
        """The area of this name (not of an alias)."""
        return self._areas.get(name)

    def locate(self, text: str) -> Location | None:
        """The place that an address names, in either notation and any case; None where there is none."""
        try:
            return address.parse(self.areas, self.iec_maps, text)
        except address.NoSuchPlace:
            return None

    def why_not(self, text: str) -> str:
        """Why `locate` finds nothing; empty where it does."""
        try:
            address.parse(self.areas, self.iec_maps, text)
        except address.NoSuchPlace as reason:
            return f"{reason} ({self.name})"
        return ""

    def format(self, area: Area, byte: int, bit: int | None, bits: int) -> str:
        """The vendor's notation of a place."""
        return address.write(area, self.iec_maps, byte, bit, bits)

    def errors(self) -> Iterator[ErrorEntry]:
        """Every error of the catalogue, in the order of the tree."""
        for group in self.catalogue:
            yield from group.walk()

    def error(self, id: str) -> ErrorEntry | None:
        """The error of this id."""
        return self._errors.get(id)

    def special(self, name: str) -> Location | None:
        """The special address of this name."""
        return next((entry.location for entry in self.specials if entry.name == name), None)

    @cached_property
    def _areas(self) -> dict[str, Area]:
        return {area.name: area for area in self.areas}

    @cached_property
    def _errors(self) -> dict[str, ErrorEntry]:
        return {entry.id: entry for entry in self.errors()}
