"""Payloads of Sparkplug B 3.0: the few messages that an edge node sends, and what it has to understand.

Google's protobuf reads and writes them. The fields are those of `sparkplug_b.proto` of the specification that are used here;
what a host sends besides is left alone, as Protocol Buffers have it.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from enum import IntEnum

from google.protobuf import descriptor_pb2, descriptor_pool, message_factory
from google.protobuf.message import DecodeError

SEQUENCES = 256
"""`seq` and `bdSeq` count from 0 to 255."""
REBIRTH = "Node Control/Rebirth"
BIRTHS = "bdSeq"


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


_FIELD = descriptor_pb2.FieldDescriptorProto
_METRIC = {
    "name": (1, _FIELD.TYPE_STRING), "timestamp": (3, _FIELD.TYPE_UINT64), "datatype": (4, _FIELD.TYPE_UINT32),
    "is_null": (7, _FIELD.TYPE_BOOL), "int_value": (10, _FIELD.TYPE_UINT32), "long_value": (11, _FIELD.TYPE_UINT64),
    "float_value": (12, _FIELD.TYPE_FLOAT), "double_value": (13, _FIELD.TYPE_DOUBLE),
    "boolean_value": (14, _FIELD.TYPE_BOOL), "string_value": (15, _FIELD.TYPE_STRING),
}  # fmt: skip
_BITS = {
    DataType.INT8: 8, DataType.UINT8: 8, DataType.INT16: 16, DataType.UINT16: 16, DataType.INT32: 32, DataType.UINT32: 32,
    DataType.INT64: 64, DataType.UINT64: 64, DataType.DATETIME: 64,
}  # fmt: skip
"""Of whole numbers: negative ones go as the two's complement of their own size, as Tahu has it."""
_OTHERS = {
    DataType.FLOAT: "float_value", DataType.DOUBLE: "double_value",
    DataType.BOOLEAN: "boolean_value", DataType.STRING: "string_value",
}  # fmt: skip


def _described() -> descriptor_pb2.FileDescriptorProto:
    file = descriptor_pb2.FileDescriptorProto(name="sparkplug_b.proto", package="spb", syntax="proto2")
    metric, whole = file.message_type.add(name="Metric"), file.message_type.add(name="Payload")
    for name, (number, type) in _METRIC.items():
        metric.field.add(name=name, number=number, type=type, label=_FIELD.LABEL_OPTIONAL)
    whole.field.add(name="timestamp", number=1, type=_FIELD.TYPE_UINT64, label=_FIELD.LABEL_OPTIONAL)
    whole.field.add(
        name="metrics", number=2, type=_FIELD.TYPE_MESSAGE, type_name=".spb.Metric", label=_FIELD.LABEL_REPEATED
    )
    whole.field.add(name="seq", number=3, type=_FIELD.TYPE_UINT64, label=_FIELD.LABEL_OPTIONAL)
    return file


_POOL = descriptor_pool.DescriptorPool()
_POOL.Add(_described())
_PAYLOAD = message_factory.GetMessageClass(_POOL.FindMessageTypeByName("spb.Payload"))


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
    made = _PAYLOAD(timestamp=at_ms, seq=sequence)
    for each in metrics:
        made.metrics.add(name=each.name, timestamp=at_ms, datatype=each.type, **_value(each.type, each.value))
    return bytes(made.SerializeToString())


def _value(type: DataType, value: bool | int | float | str | None) -> dict[str, bool | int | float | str]:
    if value is None:
        return {"is_null": True}
    if type in _OTHERS:
        return {_OTHERS[type]: value}
    bits = _BITS[type]
    return {"int_value" if bits <= 32 else "long_value": int(value) & (1 << bits) - 1}


def wants_rebirth(data: bytes) -> bool:
    """Whether a command to the node asks it to tell again what it is; `Broken`."""
    try:
        found = _PAYLOAD.FromString(data)
    except DecodeError:
        raise Broken from None
    return any(each.name == REBIRTH and each.boolean_value for each in found.metrics)
