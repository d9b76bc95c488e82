"""Payloads of Sparkplug B 3.0: the few messages of `sparkplug_b.proto` that an edge node sends, and what it has to understand.

Protocol Buffers, by hand: six fields of two messages need no library and no generated code.
"""

import struct
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from enum import IntEnum

SEQUENCES = 256
"""`seq` and `bdSeq` count from 0 to 255."""
REBIRTH = "Node Control/Rebirth"
BIRTHS = "bdSeq"
_VARINT, _EIGHT, _BYTES, _FOUR = 0, 1, 2, 5
"""Wire types."""


class DataType(IntEnum):
    """Of a metric; the numbers of the specification."""

    INT8 = 1
    INT16 = 2
    INT32 = 3
    INT64 = 4
    UINT8 = 5
    UINT16 = 6
    UINT32 = 7
    UINT64 = 8
    FLOAT = 9
    DOUBLE = 10
    BOOLEAN = 11
    STRING = 12
    DATETIME = 13


_BITS = {
    DataType.INT8: 8, DataType.UINT8: 8, DataType.INT16: 16, DataType.UINT16: 16, DataType.INT32: 32, DataType.UINT32: 32,
}  # fmt: skip
"""Of what goes as a uint32: negative ones as two's complement of their own size, as Tahu has it."""


@dataclass(frozen=True, slots=True)
class Metric:
    """A value with its name; None: there is none now."""

    name: str
    type: DataType
    value: bool | int | float | str | None


class Broken(Exception):
    """This is no payload."""


def payload(at_ms: int, metrics: Iterable[Metric], sequence: int | None) -> bytes:
    """A message of an edge node; only that of its end has no sequence number."""
    whole = _field(1, _VARINT) + _varint(at_ms)
    whole += b"".join(_bytes(2, _metric(each, at_ms)) for each in metrics)
    return whole if sequence is None else whole + _field(3, _VARINT) + _varint(sequence)


def _metric(metric: Metric, at_ms: int) -> bytes:
    begin = (
        _bytes(1, metric.name.encode())
        + _field(3, _VARINT) + _varint(at_ms)
        + _field(4, _VARINT) + _varint(metric.type)
    )  # fmt: skip
    if metric.value is None:
        return begin + _field(7, _VARINT) + b"\1"
    return begin + _value(metric.type, metric.value)


def _value(type: DataType, value: bool | int | float | str) -> bytes:
    match type:
        case DataType.BOOLEAN:
            return _field(14, _VARINT) + _varint(bool(value))
        case DataType.STRING:
            return _bytes(15, str(value).encode())
        case DataType.FLOAT:
            return _field(12, _FOUR) + struct.pack("<f", value)
        case DataType.DOUBLE:
            return _field(13, _EIGHT) + struct.pack("<d", value)
        case DataType.INT64 | DataType.UINT64 | DataType.DATETIME:
            return _field(11, _VARINT) + _varint(int(value) & (1 << 64) - 1)
        case _:
            return _field(10, _VARINT) + _varint(int(value) & (1 << _BITS[type]) - 1)


def wants_rebirth(data: bytes) -> bool:
    """Whether a command to the node asks it to tell again what it is; `Broken`."""
    for number, metric in _fields(data):
        if number == 2 and isinstance(metric, bytes):
            found = dict(_fields(metric))
            if found.get(1) == REBIRTH.encode() and found.get(14) == 1:
                return True
    return False


def _fields(data: bytes) -> Iterator[tuple[int, int | bytes]]:
    at = 0
    while at < len(data):
        key, at = _read(data, at)
        kind = key & 7
        if kind == _VARINT:
            value, at = _read(data, at)
            yield key >> 3, value
            continue
        if kind == _BYTES:
            size, at = _read(data, at)
        elif kind in (_EIGHT, _FOUR):
            size = 8 if kind == _EIGHT else 4
        else:
            raise Broken
        if at + size > len(data):
            raise Broken
        yield key >> 3, data[at : at + size]
        at += size


def _read(data: bytes, at: int) -> tuple[int, int]:
    value = 0
    for shift in range(0, 70, 7):
        if at >= len(data):
            break
        value |= (data[at] & 127) << shift
        at += 1
        if data[at - 1] < 128:
            return value, at
    raise Broken


def _field(number: int, kind: int) -> bytes:
    return _varint(number << 3 | kind)


def _bytes(number: int, data: bytes) -> bytes:
    return _field(number, _BYTES) + _varint(len(data)) + data


def _varint(value: int) -> bytes:
    found = bytearray()
    while value > 127:
        found.append(value & 127 | 128)
        value >>= 7
    found.append(value)
    return bytes(found)
