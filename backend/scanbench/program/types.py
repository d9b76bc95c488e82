"""Types: what a variable is, how many bytes it takes in the image, and what it starts with.

Sizes are bytes. All values are little endian: BOOL is a byte 0 or 1 (or one bit of an area when it is located
there); durations, dates and times of day are an i64 of nanoseconds (dates since 1970-01-01, times of day since
midnight); STRING[n] is a u16 with the current length in characters, then n bytes (WSTRING: n units of UTF-16), of which those
beyond the length mean nothing (but see `StringType.zero`); an in-out takes a slot of `SLOT_BYTES`; so does a reference.
"""

from dataclasses import dataclass, field, fields
from enum import StrEnum
from operator import attrgetter

from scanbench.problems import Span

SLOT_BYTES = 8
"""An in-out slot is a u64 reference: bits 0-31 byte offset in the image, bits 32-34 bit number (BOOL in an area);
0 means bound to nothing, as nothing lives at offset 0."""

LARGEST_STEP = 8
"""Bytes: every member is at a multiple of its size, or of these."""

MAX_STRING = 32767


class Kind(StrEnum):
    BOOL = "bool"
    INT = "int"
    UINT = "uint"
    BITS = "bits"
    REAL = "real"
    TIME = "time"
    DATE = "date"
    """Dates and times of day."""
    CHAR = "char"
    REF = "ref"
    """A reference, in the form of an in-out slot: u64."""
    STRING = "string"
    ARRAY = "array"
    STRUCT = "struct"
    UNION = "union"
    BLOCK = "block"
    """Of a FUNCTION_BLOCK, CLASS or PROGRAM."""
    INTERFACE = "interface"


@dataclass(frozen=True, slots=True)
class Elementary:
    """A type with a value of 1, 2, 4 or 8 bytes; 16 for those of `wide_types`."""

    name: str
    kind: Kind
    size: int
    unit: int = field(default=0, compare=False, kw_only=True, repr=False)
    """Of a time that has 32 bits without a sign in the dialect: ns that it counts. The same type as without it."""

    @property
    def align(self) -> int:
        return min(self.size, LARGEST_STEP)

    @property
    def bits(self) -> int:
        return 1 if self.kind is Kind.BOOL else 8 * self.size

    @property
    def signed(self) -> bool:
        return self.kind in (Kind.INT, Kind.TIME, Kind.DATE)

    def __str__(self) -> str:
        return self.name


@dataclass(frozen=True, slots=True)
class Enumeration(Elementary):
    """Named numbers; `kind` and `size` are those of the base type, which is all that an engine looks at."""

    values: tuple[tuple[str, int], ...] = ()
    """As declared, in their order."""
    base_name: str = "INT"
    named: bool = False  # as text a value is its name, and not its number
    _numbers: dict[str, int] = field(init=False, compare=False, repr=False, default_factory=dict)

    def __post_init__(self) -> None:
        self._numbers.update((name.upper(), number) for name, number in reversed(self.values))

    def number(self, name: str) -> int | None:
        """The number of the value of this name."""
        return self._numbers.get(name.upper())


@dataclass(frozen=True, slots=True)
class Subrange(Elementary):
    """An integer that keeps between `low` and `high`; `kind` and `size` are those of the base type.

    A `Load` may have such a type, and a `Place`; every other expression has the base type.
    """

    low: int = 0
    high: int = 0
    base_name: str = "INT"
    policy: str = field(default="", compare=False)  # of a value outside: `pragmas.POLICIES`; empty: as where it is used


@dataclass(frozen=True, slots=True)
class Reference(Elementary):
    """REF_TO, REFERENCE TO or POINTER TO `target`; to an interface, it refers to an instance that implements it."""

    target: "Type | None" = None
    """None for NULL, which fits every reference."""
    pointer: bool = False  # POINTER TO: it can be computed with, in bytes
    automatic: bool = False  # REFERENCE TO: every use of the variable dereferences it


@dataclass(frozen=True, slots=True)
class StringType:
    """STRING[capacity], one byte a character; or WSTRING[capacity], with `width` 2 bytes a character."""

    capacity: int
    width: int = 1
    kind: Kind = Kind.STRING
    zero: bool = False
    """As CODESYS has it: characters of one byte up to the first 0, for which there is room after `capacity` of them."""

    @property
    def size(self) -> int:
        return self.capacity + 1 if self.zero else 2 + (self.capacity * self.width + 1) // 2 * 2

    @property
    def align(self) -> int:
        return 1 if self.zero else 2

    @property
    def name(self) -> str:
        return f"{'W' if self.width == 2 else ''}STRING[{self.capacity}]"

    def __str__(self) -> str:
        return self.name


@dataclass(frozen=True, slots=True)
class ArrayType:
    """ARRAY of one or more dimensions, row-major: the last index moves fastest."""

    bounds: tuple[tuple[int, int], ...]
    element: "Type"
    kind: Kind = Kind.ARRAY

    @property
    def count(self) -> int:
        total = 1
        for low, high in self.bounds:
            total *= high - low + 1
        return total

    @property
    def size(self) -> int:
        return self.count * self.element.size

    @property
    def align(self) -> int:
        return self.element.align

    def stride(self, dimension: int) -> int:
        """Bytes from one index to the next in this dimension."""
        total = self.element.size
        for low, high in self.bounds[dimension + 1 :]:
            total *= high - low + 1
        return total

    @property
    def name(self) -> str:
        bounds = ", ".join(f"{low}..{high}" for low, high in self.bounds)
        return f"ARRAY[{bounds}] OF {self.element.name}"

    def __str__(self) -> str:
        return self.name


@dataclass(frozen=True, slots=True)
class OpenArray:
    """ARRAY[*] OF element: the type of an in-out whose bounds come with the call, in hidden variables after the slot.

    The members `name$low1`, `name$high1`, `name$low2`, ... are LINT inputs of the same owner.
    """

    dimensions: int
    element: "Type"
    kind: Kind = Kind.ARRAY

    @property
    def size(self) -> int:
        return 0

    @property
    def align(self) -> int:
        return self.element.align

    @property
    def name(self) -> str:
        return f"ARRAY[{', '.join('*' * self.dimensions)}] OF {self.element.name}"

    def __str__(self) -> str:
        return self.name


class Section(StrEnum):
    VAR = "VAR"
    INPUT = "VAR_INPUT"
    OUTPUT = "VAR_OUTPUT"
    IN_OUT = "VAR_IN_OUT"
    TEMP = "VAR_TEMP"
    GLOBAL = "VAR_GLOBAL"
    EXTERNAL = "VAR_EXTERNAL"
    MEMBER = "member"
    RESULT = "result"


@dataclass(slots=True)
class Member:
    """A variable inside a structure, block, frame or the globals. `offset` counts from the start of its owner."""

    name: str
    type: "Type"
    section: Section
    span: Span
    offset: int = 0
    initial: bytes = b""
    """Image of the start value, `storage` bytes; empty means all zero."""
    constant: bool = False
    address: str = ""
    """Vendor notation, when the variable is located (AT)."""
    bit: int | None = None
    """Bit within the byte at `offset`, when the variable is a located BOOL. `offset` is then absolute."""
    home: str = ""
    """Name of the record that declared it: a derived block has the members of its base, at the same offsets."""
    access: str = "PUBLIC"
    """PUBLIC, PROTECTED, PRIVATE or INTERNAL."""
    retain: bool = False  # RETAIN or PERSISTENT
    persistent: bool = False  # kept over a cold restart, too
    non_retain: bool = False
    """NON_RETAIN: not retained, even where the instance around it is."""
    hidden: bool = False
    """Made by the compiler (a name with `$` in it): never shown."""
    copied: bool = False
    """Of an in-out by value: a copy of what was passed, which goes back afterwards, and to which the hidden `actual_name` refers."""
    note: "Member | None" = None
    """The hidden variable beside it that keeps what was written before a check limited it; see `check/body/notes.py`."""
    output: bool = False  # an ARRAY[*] that is declared as VAR_OUTPUT: bound as an in-out, and given as an output
    open_input: bool = False  # an ARRAY[*] that is declared as VAR_INPUT: bound as an in-out, too
    incomplete: str = ""
    """`%I*`: VAR_CONFIG gives each instance its address. The type is a REFERENCE TO what was declared."""

    def copy(self) -> "Member":
        """Another one like it. A derived block has one of each member of its base, so there may be many."""
        return Member(*_of_member(self))

    @property
    def given(self) -> Section:
        """The section that a call sees: it decides how the argument is written."""
        return Section.OUTPUT if self.output else self.section

    @property
    def located(self) -> bool:
        return self.address != ""

    @property
    def storage(self) -> int:
        """Bytes it takes in its owner."""
        if self.located:
            return 0
        return SLOT_BYTES if self.bound else self.type.size

    @property
    def bound(self) -> bool:
        """Whether it is a slot that refers to what was passed: an in-out, unless that is by value."""
        return self.section is Section.IN_OUT and not self.copied


_of_member = attrgetter(*(each.name for each in fields(Member)))


@dataclass(eq=False, slots=True)
class Record:
    """A STRUCT, or the variables of a FUNCTION_BLOCK, PROGRAM or frame: members at offsets.

    Located members are in an area of the model and take no room here; VAR_EXTERNAL takes none either.
    """

    name: str
    kind: Kind
    members: dict[str, Member] = field(default_factory=dict)
    """By upper-case name, in order of declaration."""
    size: int = 0
    align: int = 1
    overlaps: bool = False
    """A UNION, or a STRUCT with OVERLAP: its members share bytes."""
    written_out: bool = False
    """A STRUCT in the declaration of a variable, without a name of its own."""
    base: "Record | None" = None
    """What a block or class extends."""
    interfaces: tuple["Record", ...] = ()
    """What it implements; of an interface, those that it extends."""
    pack: int = LARGEST_STEP
    """Bytes of the largest step at which its members are placed; 1: without gaps."""
    open: bool = False
    """What it extends was refused, so nobody knows all that it has: what it seems to lack is no mistake of its own."""

    def inherit(self, base: "Record") -> None:
        """Begins with the members of `base`, at the same offsets."""
        self.members.update(base.members)
        self.size, self.align = max(self.size, base.size), max(self.align, base.align)

    def place(self, member: Member) -> None:
        """Gives the member the next aligned offset; in a UNION all begin at 0."""
        self.members[member.name.upper()] = member
        member.home = member.home or self.name
        if member.storage == 0:
            return
        if self.kind is Kind.UNION:
            self.place_at(member, 0, min(member.type.align, self.pack))
            return
        align = min(SLOT_BYTES if member.bound else member.type.align, self.pack)
        member.offset = -(-self.size // align) * align
        self.size = member.offset + member.storage
        self.align = max(self.align, align)

    def place_at(self, member: Member, offset: int, align: int = 1) -> None:
        """Gives the member this offset, whatever else is there."""
        self.members[member.name.upper()] = member
        member.home = member.home or self.name
        member.offset = offset
        self.size = max(self.size, offset + member.storage)
        self.align = max(self.align, align)

    def close(self) -> None:
        """Rounds the size up, so that arrays of this type keep their members aligned."""
        self.size = -(-self.size // self.align) * self.align

    def initial(self) -> bytes:
        """Image of a fresh instance."""
        image = bytearray(self.size)
        started = bytearray(self.size if self.overlaps else 0)
        for member in self.members.values():
            if member.located or not member.initial:
                continue
            if member.bit is not None:
                image[member.offset] |= (member.initial[0] & 1) << member.bit
                continue
            if not self.overlaps:
                image[member.offset : member.offset + len(member.initial)] = member.initial
                continue
            # where members share bytes, the first one that says something wins
            for at, byte in enumerate(member.initial, member.offset):
                if not started[at]:
                    image[at] = byte
                    started[at] = byte != 0
        return bytes(image)

    def __str__(self) -> str:
        return self.name


Type = Elementary | StringType | ArrayType | OpenArray | Record

BOOL = Elementary("BOOL", Kind.BOOL, 1)
SINT = Elementary("SINT", Kind.INT, 1)
INT = Elementary("INT", Kind.INT, 2)
DINT = Elementary("DINT", Kind.INT, 4)
LINT = Elementary("LINT", Kind.INT, 8)
USINT = Elementary("USINT", Kind.UINT, 1)
UINT = Elementary("UINT", Kind.UINT, 2)
UDINT = Elementary("UDINT", Kind.UINT, 4)
ULINT = Elementary("ULINT", Kind.UINT, 8)
BYTE = Elementary("BYTE", Kind.BITS, 1)
WORD = Elementary("WORD", Kind.BITS, 2)
DWORD = Elementary("DWORD", Kind.BITS, 4)
LWORD = Elementary("LWORD", Kind.BITS, 8)
REAL = Elementary("REAL", Kind.REAL, 4)
LREAL = Elementary("LREAL", Kind.REAL, 8)
TIME = Elementary("TIME", Kind.TIME, 8)
LTIME = Elementary("LTIME", Kind.TIME, 8)
DATE = Elementary("DATE", Kind.DATE, 8)
LDATE = Elementary("LDATE", Kind.DATE, 8)
TIME_OF_DAY = Elementary("TIME_OF_DAY", Kind.DATE, 8)
LTIME_OF_DAY = Elementary("LTIME_OF_DAY", Kind.DATE, 8)
DATE_AND_TIME = Elementary("DATE_AND_TIME", Kind.DATE, 8)
LDATE_AND_TIME = Elementary("LDATE_AND_TIME", Kind.DATE, 8)
CHAR = Elementary("CHAR", Kind.CHAR, 1)
WCHAR = Elementary("WCHAR", Kind.CHAR, 2)
NULL = Reference("NULL", Kind.REF, 8)

ELEMENTARY: dict[str, Elementary] = {
    type.name: type
    for type in (
        BOOL, SINT, INT, DINT, LINT, USINT, UINT, UDINT, ULINT, BYTE, WORD, DWORD, LWORD, REAL, LREAL, TIME,
        LTIME, DATE, LDATE, TIME_OF_DAY, LTIME_OF_DAY, DATE_AND_TIME, LDATE_AND_TIME, CHAR, WCHAR,
    )
}  # fmt: skip

ABBREVIATIONS = {
    "TOD": TIME_OF_DAY, "LTOD": LTIME_OF_DAY, "DT": DATE_AND_TIME, "LDT": LDATE_AND_TIME, "LT": LTIME, "T": TIME,
    "D": DATE, "LD": LDATE,
}  # fmt: skip
"""In names of types (TOD, LTOD, DT, LDT), and all of them in literals."""


def actual_name(name: str) -> str:
    """The hidden in-out beside one by value: what the last call passed for it."""
    return f"{name}$actual"


def actual_of(record: "Record", member: Member) -> Member:
    """The same, of this member of a block."""
    return record.members[actual_name(member.name).upper()]


def base_of(type: Elementary) -> Elementary:
    """What an enumeration or subrange computes like; any other type itself."""
    return ELEMENTARY[type.base_name] if isinstance(type, Enumeration | Subrange) else type


def is_derived(record: Record, base: Record) -> bool:
    """Whether a reference to `base` may refer to a `record`: it is the same, extends it or implements it."""
    if record is base:
        return True
    parents = (*record.interfaces, record.base) if record.base else record.interfaces
    return any(is_derived(parent, base) for parent in parents)


def has_instance(type: Type) -> bool:
    """Whether an instance of a function block is in it: such a value keeps state, and is not copied."""
    if isinstance(type, ArrayType):
        return has_instance(type.element)
    if isinstance(type, Record):
        return type.kind is Kind.BLOCK or any(has_instance(member.type) for member in type.members.values())
    return False


def initial_of(type: Type) -> bytes:
    """Image of a fresh variable of this type that has no initial value of its own."""
    if isinstance(type, Record):
        return type.initial()
    if isinstance(type, ArrayType):
        return initial_of(type.element) * type.count
    if isinstance(type, Enumeration) and type.values:
        return (type.values[0][1] & (1 << type.bits) - 1).to_bytes(type.size, "little")
    if isinstance(type, Subrange):
        return (type.low & (1 << type.bits) - 1).to_bytes(type.size, "little")
    return bytes(type.size)
