"""The model's own memory of what happened: the error log, where the oldest record drops when it is full, and the time."""

from collections.abc import Sequence
from datetime import UTC, datetime, timedelta

from scanbench.faults.details import Chosen
from scanbench.plcmodel.model import ClockField
from scanbench.runtime.command import Patch, View

_BEGIN = datetime(1970, 1, 1, tzinfo=UTC)
_CODE, _CONTENTS, _MINUTE_SECOND, _DAY_HOUR, _YEAR_MONTH = range(5)


def log_patches(view: View, generated: Sequence[Chosen]) -> list[Patch]:
    """Patches that append a record for each error that has a code: that, first detail word, the PLC's clock in BCD."""
    log, layout = view.model.log, view.program.layout
    generated = [one for one in generated if one.error.coded]
    if log is None or not generated:
        return []
    counter = layout.areas[log.counter.area.name] + log.counter.byte
    first = layout.areas[log.first.area.name] + log.first.byte
    size = 2 * log.words
    count = min(view.memory[counter], log.records)
    records = [bytes(view.memory[first + size * k : first + size * (k + 1)]) for k in range(count)]
    records += [_record(view, one, log.words) for one in generated]
    records = records[-log.records :]
    return [Patch.whole(first, b"".join(records)), Patch.whole(counter, bytes((len(records),)))]


def time_patches(view: View, generated: Sequence[Chosen], nothing_left: bool = False) -> list[Patch]:
    """Patches that show when the latest error came: now, if one was generated; nothing, if none is left."""
    time = view.model.error_time
    generated = [one for one in generated if one.error.coded]
    if time is None or not (generated or nothing_left):
        return []
    first = view.program.layout.areas[time.first.area.name] + time.first.byte
    return [Patch.whole(first, clock_bytes(view, time.fields) if generated else bytes(len(time.fields)))]


def clock_bytes(view: View, fields: Sequence[ClockField]) -> bytes:
    """The PLC's clock in BCD, a byte for each field."""
    now = _now(view)
    shown = {
        "second": now.second, "minute": now.minute, "hour": now.hour, "day": now.day, "month": now.month,
        "year": now.year % 100, "century": now.year // 100, "weekday": now.isoweekday() % 7, "zero": 0,
    }  # fmt: skip
    return bytes(_bcd(shown[field]) for field in fields)


def _now(view: View) -> datetime:
    return _BEGIN + timedelta(microseconds=(view.header.epoch_ns + view.header.clock_ns) // 1000)


def _record(view: View, chosen: Chosen, words: int) -> bytes:
    now = _now(view)
    record = [0] * max(words, 5)
    record[_CODE] = chosen.code & 0xFFFF
    record[_CONTENTS] = _contents(chosen)
    record[_MINUTE_SECOND] = _bcd(now.minute) << 8 | _bcd(now.second)
    record[_DAY_HOUR] = _bcd(now.day) << 8 | _bcd(now.hour)
    record[_YEAR_MONTH] = _bcd(now.year % 100) << 8 | _bcd(now.month)
    return b"".join(word.to_bytes(2, "little") for word in record[:words])


def _contents(chosen: Chosen) -> int:
    """The word that its details write, as far as they lie in the first one."""
    if not chosen.contents:
        return 0
    word = chosen.contents[0].offset & ~1
    value = 0
    for part in chosen.contents:
        if part.offset & ~1 == word:
            value |= part.value << 8 * (part.offset & 1)
    return value


def _bcd(number: int) -> int:
    return int(str(number), 16)
