"""The errors that a model knows: codes, flags, details."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Literal

from scanbench.plcmodel.areas import Location

Severity = Literal["fatal", "nonfatal"]
Control = Literal["List", "Spin", "Edit"]
Kind = Literal["Bit", "Word", "Byte", "BCD", "Nibble", "BitArray"]
Identifies = Literal["", "several", "one"]
"""Whether each value of a detail is an error instance of its own: `several` are present together, as the device has a place for
each; of `one` it has a place for one at a time."""
Hardware = Literal[
    "", "rack", "slot", "basic-io-unit", "special-io-unit", "cpu-bus-unit", "unit", "inner-board", "serial-port",
    "communications-port", "sysmac-bus-master", "module", "station", "sensor", "fal", "fals",
]  # fmt: skip
"""What a number counts, or what an error needs. `unit`: CPU Bus Units, and from `FIRST_SPECIAL` on Special I/O Units. With `slot`
goes `rack`; an error of a `basic-io-unit` names both."""
FIRST_SPECIAL = 16
CodeForm = Literal["hex4", "hex8", "decimal"]
"""How a model shows its error codes: `80F1`, `60010000`, `1600`."""
CODE_LIMITS: dict[CodeForm, int] = {"hex4": 0xFFFF, "hex8": 0xFFFF_FFFF, "decimal": 0xFFFF}


def show_code(code: int, form: CodeForm) -> str:
    """An error code as the device shows it."""
    return {"hex4": f"{code:04X}", "hex8": f"{code:08X}", "decimal": str(code)}[form]


@dataclass(frozen=True, slots=True)
class Wording:
    """Name and description in a language other than English; empty where the model file has none."""

    language: str
    name: str
    description: str


@dataclass(frozen=True, slots=True)
class ErrorAddress:
    """One place that a detail writes: a bit, or a field of `width` bits from bit `shift` on of the word at `location`.

    `Bit` switches `location` on. `BitArray` switches on bit n%16 of the word n/16 after `location`; n is the value.
    The others write the value (BCD: its decimal digits) into the field. A text fills `maximum` bytes from `location` on,
    the first character in the low byte, with zeros after it.
    """

    id: str
    """What names this choice of a List. In `ErrorEntry.also`: the detail whose number is written. Else empty."""
    description: str
    location: Location | None
    """None where the number goes into the error code only."""
    text: str
    """The address as the model file writes it."""
    kind: Kind
    shift: int
    width: int
    value: int | None
    minimum: int | None
    maximum: int | None
    base: Literal[0, 10, 16]
    """How its number is written; 0: it is a text of at most `maximum` characters."""
    default: int | None
    add_to_code: bool
    """The value is added to the error code."""
    wordings: tuple[Wording, ...] = ()
    lasting: bool = False
    """Of a choice: the error with it has a cause that lasts, see `ErrorEntry.lasting`."""

    @property
    def is_text(self) -> bool:
        """Whether characters are written here, no number."""
        return self.base == 0


@dataclass(frozen=True, slots=True)
class ErrorDetail:
    """One thing to say about an error. A List has one address for each choice; a Spin and an Edit have exactly one."""

    name: str
    control: Control
    description: str
    addresses: tuple[ErrorAddress, ...]
    default: str | None = None
    """The id of the choice that a List starts with."""
    wordings: tuple[Wording, ...] = ()
    identifies: Identifies = ""
    hardware: Hardware = ""
    """What its number counts; empty: nothing that a hardware configuration has."""
    absent: bool = False
    """The device can report the error of what is not fitted, too."""

    def choice(self, id: str) -> ErrorAddress | None:
        """The choice of a List with this id."""
        return next((address for address in self.addresses if address.id == id), None)

    @property
    def word(self) -> Location | None:
        """The word of a List whose choices are all bits of this one: then several of them can be on together."""
        places = [each.location for each in self.addresses if each.kind == "Bit" and each.location is not None]
        words = {(place.area.name, place.word) for place in places}
        if self.control != "List" or len(words) != 1 or len(places) != len(self.addresses):
            return None
        return places[0]._replace(byte=2 * places[0].word, bit=None, bits=16)


def _additions(detail: ErrorDetail) -> list[range]:
    """What it can add to the code; nothing where it never does."""
    adding = [each for each in detail.addresses if each.add_to_code]
    if detail.control != "List":
        return [range(each.minimum or 0, (each.maximum or 0) + 1) for each in adding]
    values = {each.value or 0 if each.add_to_code else 0 for each in detail.addresses}
    return [range(value, value + 1) for value in sorted(values)] if adding else []


@dataclass(frozen=True, slots=True)
class ErrorEntry:
    """One error of the catalogue."""

    id: str
    name: str
    description: str
    code: int
    flag: Location
    flag_text: str
    severity: Severity
    priority: int
    """1 is the most serious: it decides which error the code word shows."""
    details: tuple[ErrorDetail, ...]
    source: str
    verified: bool
    """False: from knowledge, not checked against a source. Shown as such."""
    keeps_memory: bool = False
    """A fatal error that leaves the memory as it is, that of the outputs too (what is wired to them goes off all the same)."""
    also: tuple[ErrorAddress, ...] = ()
    """What it writes besides its flag and details: bits, a fixed `value`, or the number of the detail named by `id`."""
    form: CodeForm = "hex4"
    wordings: tuple[Wording, ...] = ()
    user: bool = False
    """One of the project's own (`user_errors`), not of the device."""
    lasting: bool = False
    """Its cause lasts: what a tool or program clears shows again at once. Only who holds the cause can recover it."""
    hardware: Hardware = ""
    """What has to be fitted for it, where no detail says which."""
    hardware_number: int | None = None
    """Which one of them; None: any."""
    coded: bool = True
    """False: the device has no error code for it. So the code word, the log and its way to clear errors know nothing of it;
    `code` is 0."""

    @property
    def identifying(self) -> tuple[ErrorDetail, ...]:
        """The details that tell its instances apart."""
        return tuple(each for each in self.details if each.identifies)

    @property
    def several(self) -> bool:
        """Whether the device has several instances of it present together."""
        return bool(self.identifying) and all(each.identifies == "several" for each in self.identifying)

    @property
    def code_text(self) -> str:
        """The code without what details add to it, as the device shows it; empty where it has none."""
        return self.show(self.code)

    @property
    def code_limit(self) -> int:
        """The largest code that the form can show."""
        return CODE_LIMITS[self.form]

    def show(self, code: int) -> str:
        """A code of this error (details added) as the device shows it."""
        return show_code(code, self.form) if self.coded else ""

    @property
    def codes(self) -> tuple[range, ...]:
        """Every code that it can have, details added."""
        if not self.coded:
            return ()
        found = [range(self.code, self.code + 1)]
        for detail in self.details:
            if stretches := _additions(detail):
                found = [
                    range(code.start + more.start, code.stop + more.stop - 1) for code in found for more in stretches
                ]
        return tuple(found)

    def detail(self, name: str) -> ErrorDetail | None:
        """The detail of this name."""
        return next((detail for detail in self.details if detail.name == name), None)


@dataclass(frozen=True, slots=True)
class ErrorGroup:
    """A branch of the tree."""

    name: str
    groups: tuple["ErrorGroup", ...]
    errors: tuple[ErrorEntry, ...]
    wordings: tuple[Wording, ...] = ()

    def walk(self) -> Iterator[ErrorEntry]:
        """Every error of this branch, in the order of the tree: inner groups first."""
        for _, error in self.walk_with_groups():
            yield error

    def walk_with_groups(self) -> Iterator[tuple[tuple["ErrorGroup", ...], ErrorEntry]]:
        """The same with the groups that each is in, from this one down."""
        for group in self.groups:
            for groups, error in group.walk_with_groups():
                yield (self, *groups), error
        for error in self.errors:
            yield (self,), error


def path_text(names: Iterable[str]) -> str:
    """The names of groups from the top, as one text."""
    return " / ".join(names)
