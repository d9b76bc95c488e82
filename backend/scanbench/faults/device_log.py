"""The device's own error log, and the messages of its program, from its memory."""

from collections.abc import Mapping, Sequence
from datetime import UTC, datetime

from scanbench.faults import device_errors
from scanbench.faults.device_memory import Memory, said
from scanbench.faults.device_shapes import DeviceDetail, DeviceMessage, DeviceRecord
from scanbench.plcmodel.catalogue import ErrorEntry
from scanbench.plcmodel.model import ClockField, ErrorLog, ErrorTime, Location

_CODE, _CONTENTS, _TIMES = 0, 1, ("second", "minute", "hour", "day", "month", "year")
"""Words of a record: the code, the details, then a byte for each part of the time."""


def records(memory: Memory) -> tuple[DeviceRecord, ...]:
    """The newest first. A model without a log may keep the latest error with its time: that is one record."""
    model = memory.model
    if model.log is not None:
        count = min(memory.byte(model.log.counter), model.log.records)
        return tuple(_record(memory, model.log, number) for number in range(count, 0, -1))
    if model.error_time is not None and memory.code:
        return (_named(memory, 1, _latest(memory, model.error_time), memory.code, None),)
    return ()


def messages(memory: Memory) -> tuple[DeviceMessage, ...]:
    """Those that are shown now, by their numbers."""
    found = (
        DeviceMessage(number, memory.text(made.texts, number), made.name)
        for made in memory.model.messages
        for number in range(made.minimum, made.maximum + 1)
    )
    return tuple(each for each in found if each.text)


def _record(memory: Memory, log: ErrorLog, number: int) -> DeviceRecord:
    start = 2 * log.words * (number - 1)
    size = 2 * log.words
    data = bytes(memory.byte(log.first, start + each) for each in range(size))
    words = [int.from_bytes(data[at : at + 2], "little") for at in range(0, size, 2)]
    parts = dict(zip(_TIMES, data[4:10], strict=False))
    return _named(memory, number, _time(parts), words[_CODE], words[_CONTENTS] if len(words) > _CONTENTS else None)


def _latest(memory: Memory, time: ErrorTime) -> str:
    return clock_text(memory, time.first, time.fields)


def clock_text(memory: Memory, first: Location, fields: Sequence[ClockField]) -> str:
    """A time of which the memory has a byte for each field, in BCD; empty where it is none."""
    return _time({field: memory.byte(first, number) for number, field in enumerate(fields)})


def _time(parts: Mapping[str, int]) -> str:
    """Bytes of two decimal digits as a time; empty where they are none."""
    if any(name not in parts for name in _TIMES) or not all(f"{parts[name]:02X}".isdigit() for name in _TIMES):
        return ""
    second, minute, hour, day, month, year = (int(f"{parts[name]:X}") for name in _TIMES)
    try:
        return datetime(2000 + year, month, day, hour, minute, second, tzinfo=UTC).strftime("%Y-%m-%d %H:%M:%S")
    except ValueError:
        return ""


def _named(memory: Memory, number: int, time: str, code: int, contents: int | None) -> DeviceRecord:
    error = _error_of(memory, code)
    details = () if error is None else _details(error, code, contents)
    return DeviceRecord(
        number=number,
        time=time,
        code=memory.model.show_code(code),
        contents="" if contents is None else f"{contents:04X}",
        id="" if error is None else error.id,
        name="" if error is None else error.name,
        severity=None if error is None else error.severity,
        details=details,
        text="" if error is None else memory.text_of(error, details),
    )


def _error_of(memory: Memory, code: int) -> ErrorEntry | None:
    model = memory.model
    device = device_errors.by_code(model, code, "fatal") or device_errors.by_code(model, code, "nonfatal")
    users = (error for error in model.errors() if error.user and any(code in each for each in error.codes))
    return device or next(users, None)


def _details(error: ErrorEntry, code: int, contents: int | None) -> tuple[DeviceDetail, ...]:
    """What code and contents say; where a detail is in neither, nothing."""
    ref = device_errors.reference(error, code, contents or 0)
    found = ((error.detail(name), value) for name, value in ref.details)
    return tuple(said(detail, value) for detail, value in found if detail is not None and value)
