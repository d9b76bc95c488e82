"""Types: what a variable is, how many bytes it takes in the image, and what it starts with.

Sizes are bytes. All values are little endian: BOOL is a byte 0 or 1 (or one bit of an area when it is located
there); TIME is an i64 of nanoseconds; STRING[n] is a u16 with the current length, then n bytes, of which those
beyond the length mean nothing; an in-out takes a slot of `SLOT_BYTES`, see `Section.IN_OUT`.
"""

from dataclasses import dataclass, field
from enum import StrEnum

from scanbench.problems import Span

SLOT_BYTES = 8
"""An in-out slot is a u64 reference: bits 0-31 byte offset in the image, bits 32-34 bit number (BOOL in an area);
0 means bound to nothing, as nothing lives at offset 0."""

MAX_STRING = 32767


class Kind(StrEnum):
    BOOL = "bool"
    INT = "int"
    UINT = "uint"
    BITS = "bits"
    REAL = "real"
    TIME = "time"
    STRING = "string"
    ARRAY = "array"
    STRUCT = "struct"
    BLOCK = "block"


@dataclass(frozen=True, slots=True)
class Elementary:
    """A type with a value of 1, 2, 4 or 8 bytes."""

    name: str
    kind: Kind
    size: int

    @property
    def align(self) -> int:
        return self.size

    @property
    def bits(self) -> int:
        return 1 if self.kind is Kind.BOOL else 8 * self.size

    @property
    def signed(self) -> bool:
        return self.kind in (Kind.INT, Kind.TIME)

    def __str__(self) -> str:
        return self.name


@dataclass(frozen=True, slots=True)
class StringType:
    """STRING[capacity]: one byte a character."""

    capacity: int
    kind: Kind = Kind.STRING

    @property
    def size(self) -> int:
        return (2 + self.capacity + 1) // 2 * 2

    @property
    def align(self) -> int:
        return 2

    @property
    def name(self) -> str:
        return f"STRING[{self.capacity}]"

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

    @property
    def located(self) -> bool:
        return self.address != ""

    @property
    def storage(self) -> int:
        """Bytes it takes in its owner."""
        if self.located:
            return 0
        return SLOT_BYTES if self.section is Section.IN_OUT else self.type.size


@dataclass(eq=False, slots=True)
class Record:
    """A STRUCT, or the variables of a FUNCTION_BLOCK, PROGRAM or frame: members at offsets.

    Located members stand in an area of the model and take no room here; VAR_EXTERNAL takes none either.
    """

    name: str
    kind: Kind
    members: dict[str, Member] = field(default_factory=dict)
    """By upper-case name, in order of declaration."""
    size: int = 0
    align: int = 1

    def place(self, member: Member) -> None:
        """Gives the member the next aligned offset."""
        self.members[member.name.upper()] = member
        if member.storage == 0:
            return
        align = SLOT_BYTES if member.section is Section.IN_OUT else member.type.align
        member.offset = -(-self.size // align) * align
        self.size = member.offset + member.storage
        self.align = max(self.align, align)

    def close(self) -> None:
        """Rounds the size up, so that arrays of this type keep their members aligned."""
        self.size = -(-self.size // self.align) * self.align

    def initial(self) -> bytes:
        """Image of a fresh instance."""
        image = bytearray(self.size)
        for member in self.members.values():
            if member.initial and not member.located:
                image[member.offset : member.offset + len(member.initial)] = member.initial
        return bytes(image)

    def __str__(self) -> str:
        return self.name


Type = Elementary | StringType | ArrayType | Record

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

ELEMENTARY: dict[str, Elementary] = {
    type.name: type
    for type in (
        BOOL, SINT, INT, DINT, LINT, USINT, UINT, UDINT, ULINT, BYTE, WORD, DWORD, LWORD, REAL, LREAL, TIME
    )
}  # fmt: skip


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
    return bytes(type.size)
