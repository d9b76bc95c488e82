"""Variables and addresses, as people see them."""

from dataclasses import dataclass
from typing import ClassVar, Literal

from scanbench.public import Public

SymbolKind = Literal[
    "bool", "int", "uint", "bits", "real", "time", "string", "array", "struct", "block", "union", "interface", "date",
    "char", "ref",
]  # fmt: skip


@dataclass(frozen=True, slots=True)
class EnumValue(Public):
    """A number of an enumeration that has a name."""

    name: str
    value: int


@dataclass(frozen=True, slots=True)
class SymbolInfo(Public):
    """A variable, or an address, by its instance path."""

    PUBLIC: ClassVar = "Symbol"

    path: str
    name: str
    type: str
    """As declared, e.g. INT, ARRAY[0..9] OF REAL, TON."""
    kind: SymbolKind
    size: int
    """Bytes of the value."""
    address: str | None
    """Vendor notation when it is located."""
    writable: bool
    section: str
    """VAR, VAR_INPUT, VAR_OUTPUT, VAR_IN_OUT, VAR_GLOBAL, address or member."""
    expandable: bool
    values: tuple[EnumValue, ...] = ()
    """Of an enumeration: the names of its numbers."""
    range: str = ""
    """Of a subrange: the integer that it is and its bounds, INT (0..500); `type` may be a name."""
    in_out: bool = False
    """It is an in-out; of a watched path also: it leads through one. It has a binding."""


@dataclass(frozen=True, slots=True)
class WatchItem:
    """One watched path: its symbol, or why there is none. `sent` is false for structures, which are in no frame."""

    id: int
    path: str
    symbol: SymbolInfo | None
    sent: bool
    message: str = ""
    near: tuple[str, ...] = ()
