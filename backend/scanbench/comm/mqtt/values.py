"""What variables are worth, for JSON and for Sparkplug B."""

import math
import struct
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta

from scanbench.comm.mqtt.sparkplug import DataType
from scanbench.program.strings import characters
from scanbench.program.types import ELEMENTARY, Kind, StringType
from scanbench.wire.symbols import SymbolInfo, WatchItem
from scanbench.wire.variables import VariablesAre

Value = bool | int | float | str
_NS_MS = 1_000_000
_1970 = datetime(1970, 1, 1, tzinfo=UTC)
_NUMBERS: dict[str, tuple[str, DataType]] = {
    "BOOL": ("?", DataType.BOOLEAN), "SINT": ("b", DataType.INT8), "INT": ("<h", DataType.INT16),
    "DINT": ("<i", DataType.INT32), "LINT": ("<q", DataType.INT64), "USINT": ("B", DataType.UINT8),
    "BYTE": ("B", DataType.UINT8), "CHAR": ("B", DataType.UINT8), "UINT": ("<H", DataType.UINT16),
    "WORD": ("<H", DataType.UINT16), "WCHAR": ("<H", DataType.UINT16), "UDINT": ("<I", DataType.UINT32),
    "DWORD": ("<I", DataType.UINT32), "ULINT": ("<Q", DataType.UINT64), "LWORD": ("<Q", DataType.UINT64),
    "REAL": ("<f", DataType.FLOAT), "LREAL": ("<d", DataType.DOUBLE),
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class Form:
    """How the bytes of a variable are read."""

    size: int
    type: DataType
    read: Callable[[bytes], Value]

    def json(self, data: bytes) -> Value | None:
        """For JSON, which has neither infinity nor NaN; a point in time as ISO 8601."""
        value = self.read(data)
        if isinstance(value, float) and not math.isfinite(value):
            return None
        if self.type is DataType.DATETIME:
            assert isinstance(value, int)
            return (_1970 + timedelta(milliseconds=value)).isoformat()
        return value


def form_of(symbol: SymbolInfo) -> Form | None:
    """None where it has no single value."""
    if symbol.values:
        return _enumeration(symbol)
    base = symbol.range.partition(" ")[0] or symbol.type
    if base.startswith(("STRING[", "WSTRING[")):
        return _text(symbol, base)
    elementary = ELEMENTARY.get(base)
    if elementary is None:
        return None
    if base in ("TIME", "LTIME"):
        return Form(symbol.size, DataType.DOUBLE, lambda data: _signed(data) / _NS_MS)
    if elementary.kind is Kind.DATE:
        return Form(symbol.size, DataType.DATETIME, lambda data: _signed(data) // _NS_MS)
    letters, type = _NUMBERS[base]
    packing = struct.Struct(letters)
    return Form(packing.size, type, lambda data: _number(packing, data))


def _number(packing: struct.Struct, data: bytes) -> Value:
    (value,) = packing.unpack(data)
    assert isinstance(value, bool | int | float)
    return value


def _enumeration(symbol: SymbolInfo) -> Form:
    """The name, or the number where it has none."""
    names = {each.value: each.name for each in symbol.values}
    signed = any(number < 0 for number in names)

    def read(data: bytes) -> str:
        number = int.from_bytes(data, "little", signed=signed)
        return names.get(number) or str(number)

    return Form(symbol.size, DataType.STRING, read)


def _text(symbol: SymbolInfo, name: str) -> Form:
    capacity, width = int(name.partition("[")[2].rstrip("]")), 2 if name.startswith("W") else 1
    type = StringType(capacity, width, zero=symbol.size == capacity + 1)
    coding = "utf-16-le" if width == 2 else "latin-1"
    return Form(symbol.size, DataType.STRING, lambda data: characters(type, data).decode(coding, "replace"))


def _signed(data: bytes) -> int:
    return int.from_bytes(data, "little", signed=True)


@dataclass(frozen=True, slots=True)
class Chosen:
    """Variables that can be published, of one version of the program."""

    version: int
    paths: tuple[str, ...]
    forms: tuple[Form, ...]
    trouble: str
    """Of those that cannot; empty: all can."""

    def pieces(self, told: VariablesAre) -> list[bytes | None]:
        """The bytes of each; None where an in-out leads nowhere."""
        found: list[bytes | None] = []
        at = 0
        for there, form in zip(told.there, self.forms, strict=True):
            found.append(told.data[at : at + form.size] if there else None)
            at += form.size if there else 0
        return found


def choose(version: int, items: Sequence[WatchItem]) -> Chosen:
    """Those of these that have a value."""
    paths, forms, wrong = list[str](), list[Form](), list[str]()
    for item in items:
        form = None if item.symbol is None else form_of(item.symbol)
        if form is not None:
            paths.append(item.path)
            forms.append(form)
        else:
            wrong.append(item.message or f"{item.path} has no single value that could be published")
    more = f" ({len(wrong) - 1} more)" if len(wrong) > 1 else ""
    return Chosen(version, tuple(paths), tuple(forms), wrong[0] + more if wrong else "")
