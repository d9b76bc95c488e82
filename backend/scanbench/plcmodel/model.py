"""What is known about one PLC model: the contract of this room. Made by `load`, never changed afterwards."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

from scanbench.plcmodel import address
from scanbench.plcmodel.areas import Access, AccessRange, Area, IecMap, Location, Who
from scanbench.plcmodel.catalogue import (
    CodeForm,
    Control,
    ErrorAddress,
    ErrorDetail,
    ErrorEntry,
    ErrorGroup,
    Kind,
    Severity,
    Wording,
    show_code,
)
from scanbench.plcmodel.facts import Fact
from scanbench.plcmodel.hardware import Fitted

__all__ = [
    "Access",
    "AccessRange",
    "Area",
    "ClockField",
    "CodeForm",
    "Control",
    "ErrorAddress",
    "ErrorDetail",
    "ErrorEntry",
    "ErrorGroup",
    "ErrorLog",
    "ErrorReset",
    "ErrorTime",
    "Fact",
    "FatalBehaviour",
    "IecMap",
    "Instruction",
    "Kind",
    "Location",
    "MessageInstruction",
    "Model",
    "QueryInstruction",
    "ResetInstruction",
    "Role",
    "Severity",
    "Special",
    "Standby",
    "TextPlace",
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
    """What happens to memory when the program stops: by a fatal error, or by a change to PROGRAM."""

    outputs: tuple[WordRange, ...] = ()
    """Go to 0 at a fatal error and at a change to PROGRAM, unless the hold bit is on or the error keeps the memory."""
    cleared: tuple[Area, ...] = ()
    """Go to 0 too, but for input words, and so they do when the program starts again; unless the hold bit is on or the
    error keeps the memory."""
    hold: Location | None = None


@dataclass(frozen=True, slots=True)
class ErrorLog:
    """The model's own error log: `records` records of `words` words from `first` on, and the word that counts them."""

    first: Location
    records: int
    words: int
    counter: Location


@dataclass(frozen=True, slots=True)
class ErrorReset:
    """The device's own way to clear an error: its code in the word `code`, then `bit` goes on."""

    bit: Location
    code: Location


Role = Literal[
    "", "on", "off", "first-cycle", "pulse", "cycle-time", "longest-cycle-time", "shortest-cycle-time", "scan-count",
    "clock",
]  # fmt: skip
"""What common processing writes to a special address in every scan; '' is nothing.

`first-cycle`: on in the first scan after the program started. `pulse`: off for half of `period_ns` of virtual time, then
on. `cycle-time`: the length of a scan in virtual time, in units of `unit_ns`, as wide as the address. `scan-count`: scans
since the start of the run, wrapping. `clock`: the PLC's clock (`Layout.EPOCH` + `Layout.CLOCK`): one byte for each of
`fields`, from the low byte of the address on, which has 8 bits for each.
"""
ClockField = Literal["second", "minute", "hour", "day", "month", "year", "century", "weekday", "zero"]
"""`year` is the last two digits, `weekday` counts from 0 on Sunday."""


@dataclass(frozen=True, slots=True)
class ErrorTime:
    """When the latest error came, in BCD: a byte for each of `fields` from `first` on; 0 while there is none."""

    first: Location
    fields: tuple[ClockField, ...]


@dataclass(frozen=True, slots=True)
class Standby:
    """A second CPU Unit that runs the same program, and takes over when the active one fails."""

    duplex: Location
    """On: both run; off: one is left (simplex)."""
    active: Location | None
    """On in the CPU Unit that controls: the program always sees it on."""
    side: Location
    """Off: the left CPU Unit controls, as at the start; on: the right one."""
    causes: tuple[tuple[str, Location], ...]
    """The errors for which the standby takes over, by id, and the bit that says why it did last."""
    time: Location | None = None
    """When it took over last, in BCD: a byte for each of `fields`."""
    fields: tuple[ClockField, ...] = ()

    def takes_over_for(self, error: str) -> bool:
        """Whether an error of this id does not stop the program while both run."""
        return any(id == error for id, _ in self.causes)

    @property
    def places(self) -> tuple[Location, ...]:
        """Everything that a change between the CPU Units writes."""
        bits = [self.duplex, self.side, *(place for _, place in self.causes)]
        if self.active is not None:
            bits.append(self.active)
        if self.time is not None:
            bits.append(self.time._replace(bits=8 * len(self.fields)))
        return tuple(bits)


@dataclass(frozen=True, slots=True)
class Special:
    """An address with a meaning for the system: first cycle flag, clock, ..."""

    name: str
    location: Location
    text: str
    description: str
    source: str
    verified: bool
    symbol: str = ""
    """A variable that every program on this model knows (`P_First_Cycle`, `SM400`, `_ErrSta`); '' where there is none."""
    role: Role = ""
    period_ns: int = 0
    unit_ns: int = 0
    fields: tuple[ClockField, ...] = ()
    bcd: bool = False


@dataclass(frozen=True, slots=True)
class TextPlace:
    """Where texts of the program are kept: number n in the `words` words that begin n times as many after `first`. Two
    characters in a word, the first in the high byte, zeros after the last."""

    first: Location
    words: int


@dataclass(frozen=True, slots=True)
class Instruction:
    """An instruction of the vendor that raises an error of the catalogue; a program calls it as a function.

    `FAL(N := 5)` gives the error `error` with 5 as its detail `detail`; a number outside `minimum` to `maximum` does
    nothing, but for `clears`, which recovers it. When the error is fatal the program stops right there.

    As Omron has it: with a parameter `selector` the number `clears` clears what that says: one number, 16#FFFF all nonfatal
    errors, anything else the most serious of them. When the number is that in the word `system_errors`, which is not 0, an
    error of the device is raised instead: `selector` is its code, the parameter `information` its detail word.
    """

    name: str
    error: str
    parameter: str
    detail: str
    minimum: int
    maximum: int
    clears: int | None = None
    description: str = ""
    source: str = ""
    verified: bool = False
    selector: str = ""
    information: str = ""
    system_errors: Location | None = None
    text: str = ""
    """A parameter that is a text, which is kept at `texts` when the error is raised."""
    texts: TextPlace | None = None
    part: int = 0
    """An instruction with several ranges of numbers, each with an error of its own, is several of one name: which of them."""


@dataclass(frozen=True, slots=True)
class ResetInstruction:
    """An instruction of the vendor that clears the nonfatal errors whose flags are in the word `flags`.

    With a parameter `code` it clears only the error of that code, unless that is 0.
    """

    name: str
    flags: Location
    description: str = ""
    source: str = ""
    verified: bool = False
    code: str = ""


@dataclass(frozen=True, slots=True)
class QueryInstruction:
    """An instruction of the vendor that tells the most serious error of a part of the device: those with flags in `flags`.

    The output Level is the number in `levels` of the first bit in `bits` that is on, else 0; Code is what is in `code`, which
    the system keeps: the code of the most serious of these errors. The result is whether there is one of these levels.
    """

    name: str
    flags: Location
    bits: tuple[int, ...]
    levels: tuple[int, ...]
    code: Location
    level_type: str
    code_type: str
    description: str = ""
    source: str = ""
    verified: bool = False


@dataclass(frozen=True, slots=True)
class MessageInstruction:
    """An instruction of the vendor that shows a text on tools, under a number; an empty text takes it back."""

    name: str
    parameter: str
    text: str
    minimum: int
    maximum: int
    texts: TextPlace
    description: str = ""
    source: str = ""
    verified: bool = False


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
    """Addresses worth showing in addition to the catalogue."""
    fatal: FatalBehaviour = FatalBehaviour()
    log: ErrorLog | None = None
    specials: tuple[Special, ...] = ()
    instructions: tuple[Instruction, ...] = ()
    code_form: CodeForm = "hex4"
    wordings: tuple[Wording, ...] = ()
    error_reset: ErrorReset | None = None
    error_time: ErrorTime | None = None
    resets: tuple[ResetInstruction, ...] = ()
    facts: tuple[Fact, ...] = ()
    """Everything that the model file says about the device, and where it comes from."""
    queries: tuple[QueryInstruction, ...] = ()
    messages: tuple[MessageInstruction, ...] = ()
    standby: Standby | None = None
    fitted: tuple[Fitted, ...] | None = None
    """What a project says is fitted; None: it does not say."""

    def area(self, name: str) -> Area | None:
        """The area of this name (not of an alias)."""
        return self._areas.get(name)

    def locate(self, text: str) -> Location | None:
        """The place that an address names, in either notation and any case; None where there is none."""
        try:
            return address.parse(self.areas, self.iec_maps, text, self._symbols)
        except address.NoSuchPlace:
            return None

    def why_not(self, text: str) -> str:
        """Why `locate` finds nothing; empty where it does."""
        try:
            address.parse(self.areas, self.iec_maps, text, self._symbols)
        except address.NoSuchPlace as reason:
            return f"{reason} ({self.name})"
        return ""

    def format(self, area: Area, byte: int, bit: int | None, bits: int) -> str:
        """The vendor's notation of a place."""
        return address.write(area, self.iec_maps, byte, bit, bits)

    def word_text(self, area: Area, byte: int) -> str:
        """The vendor's notation of a word; of an area that counts bits that of its first bit: `D100`, `0`, `X20`."""
        bits = area.unit == "bit"
        return self.format(area, byte, 0 if bits else None, 1 if bits else 16)

    def range_text(self, words: WordRange) -> tuple[str, str]:
        """First and last address of a range, in the vendor's notation: `D0`, `D99`; `X0`, `X63F` where bits count."""
        area, bits = words.area, words.area.unit == "bit"
        first = self.format(area, 2 * words.first, 0 if bits else None, 1 if bits else 16)
        return first, self.format(area, 2 * words.last + bits, 7 if bits else None, 1 if bits else 16)

    def show_code(self, code: int) -> str:
        """An error code as this device shows it."""
        return show_code(code, self.code_form)

    def errors(self) -> Iterator[ErrorEntry]:
        """Every error of the catalogue, in the order of the tree."""
        for _, error in self.errors_with_groups():
            yield error

    def errors_with_groups(self) -> Iterator[tuple[tuple[ErrorGroup, ...], ErrorEntry]]:
        """The same with the groups that each is in, from the top."""
        for group in self.catalogue:
            yield from group.walk_with_groups()

    def error(self, id: str) -> ErrorEntry | None:
        """The error of this id."""
        return self._errors.get(id)

    def special(self, name: str) -> Location | None:
        """The special address of this name."""
        return next((entry.location for entry in self.specials if entry.name == name), None)

    def texts(self) -> Iterator[tuple[str, TextPlace, int]]:
        """Where instructions keep texts: the name of each, the place, and its words."""
        for made in self.instructions:
            if made.texts is not None:
                yield made.name, made.texts, made.texts.words * (made.maximum + 1)
        for message in self.messages:
            yield message.name, message.texts, message.texts.words * (message.maximum + 1)

    @cached_property
    def _symbols(self) -> dict[str, Location]:
        return {entry.symbol.upper(): entry.location for entry in self.specials if entry.symbol}

    @cached_property
    def _areas(self) -> dict[str, Area]:
        return {area.name: area for area in self.areas}

    @cached_property
    def _errors(self) -> dict[str, ErrorEntry]:
        return {entry.id: entry for entry in self.errors()}
