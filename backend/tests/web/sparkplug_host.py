"""Payloads of Sparkplug B as Google's protobuf reads and writes them, by the fields of `sparkplug_b.proto` of the specification."""

from dataclasses import dataclass

from google.protobuf import descriptor_pb2, descriptor_pool, message_factory

Value = bool | int | float | str | None
_FIELD = descriptor_pb2.FieldDescriptorProto
_METRIC = (
    ("name", 1, _FIELD.TYPE_STRING), ("alias", 2, _FIELD.TYPE_UINT64), ("timestamp", 3, _FIELD.TYPE_UINT64),
    ("datatype", 4, _FIELD.TYPE_UINT32), ("is_null", 7, _FIELD.TYPE_BOOL), ("int_value", 10, _FIELD.TYPE_UINT32),
    ("long_value", 11, _FIELD.TYPE_UINT64), ("float_value", 12, _FIELD.TYPE_FLOAT), ("double_value", 13, _FIELD.TYPE_DOUBLE),
    ("boolean_value", 14, _FIELD.TYPE_BOOL), ("string_value", 15, _FIELD.TYPE_STRING),
)  # fmt: skip
_SIGNED = {1: 8, 2: 16, 3: 32, 4: 64}
"""Bits of the data types that can be negative."""


def _message(file: descriptor_pb2.FileDescriptorProto, name: str, fields: tuple[tuple[str, int, int], ...]) -> None:
    made = file.message_type.add(name=name)
    for field, number, type in fields:
        made.field.add(name=field, number=number, type=type, label=_FIELD.LABEL_OPTIONAL)


def _payload() -> type:
    file = descriptor_pb2.FileDescriptorProto(name="sparkplug_b.proto", package="spb", syntax="proto2")
    _message(file, "Metric", _METRIC)
    _message(file, "Payload", (("timestamp", 1, _FIELD.TYPE_UINT64), ("seq", 3, _FIELD.TYPE_UINT64)))
    file.message_type[1].field.add(
        name="metrics", number=2, type=_FIELD.TYPE_MESSAGE, label=_FIELD.LABEL_REPEATED, type_name=".spb.Metric"
    )
    pool = descriptor_pool.DescriptorPool()
    pool.Add(file)
    made: type = message_factory.GetMessageClass(pool.FindMessageTypeByName("spb.Payload"))
    return made


_PAYLOAD = _payload()


@dataclass(frozen=True, slots=True)
class Told:
    """What a host makes of a message."""

    sequence: int | None
    values: dict[str, Value]
    types: dict[str, int]


def read(data: bytes) -> Told:
    """A payload; whatever is no payload raises an error of protobuf."""
    found = _PAYLOAD.FromString(data)  # type: ignore[attr-defined]
    assert found.HasField("timestamp")
    values: dict[str, Value] = {}
    for each in found.metrics:
        kinds = [field.name for field, _ in each.ListFields() if field.name.endswith("_value")]
        value = None if each.is_null else getattr(each, *kinds)
        bits = _SIGNED.get(each.datatype, 0)
        if isinstance(value, int) and bits:
            assert value < 1 << bits, "two's complement of its own size"
            value -= (value >> bits - 1) << bits
        values[each.name] = value
    types = {each.name: each.datatype for each in found.metrics}
    return Told(found.seq if found.HasField("seq") else None, values, types)


def rebirth() -> bytes:
    """What a host sends to be told everything again."""
    made = _PAYLOAD()
    made.timestamp = 1
    metric = made.metrics.add(name="Node Control/Rebirth", timestamp=1, datatype=11)
    metric.boolean_value = True
    return bytes(made.SerializeToString())
