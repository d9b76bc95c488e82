"""Traces: signals over scans, recorded by the PLC."""

import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from scanbench.client.asking import Steps, asked, asked_value
from scanbench.client.requests.base import Asks, waited
from scanbench.client.shapes import traces as shapes

_HEAD = struct.Struct("<BBHIQQQ")
"""Of the bytes of samples, as `taps/trace_buffer.py` packs them."""
_SIGNED = ("int", "time", "date")
Number = bool | int | float


@dataclass(frozen=True, slots=True)
class Samples:
    """What a trace recorded, oldest first."""

    scans: list[int]
    """After each of these scans there is a sample."""
    values: Mapping[str, list[Number | None]]
    """Of each signal as many as `scans`: BOOL as bool, REAL as float, times and dates as ns, other types as int. None: it had none then."""
    thinned: bool
    """Two samples stand for a stretch: the least values in its first scan, the greatest in its last."""


class Traces(Asks):
    """A trace has a number; everybody at the PLC sees it."""

    @asked_value
    def traces(self) -> Steps[list[shapes.TraceInfo]]:
        """The traces of this PLC: `definition`, `state`, the scans `first` to `end` - 1 that are in the buffer, and more."""
        return self._traces()

    @asked
    def begin_trace(
        self, name: str, signals: Sequence[str], *, every: int = 1, scans: int = 30_000,
        trigger: shapes.TraceTrigger | None = None, repeat: bool = False, start: bool = True,
    ) -> Steps[int]:  # fmt: skip
        """Records variables, addresses or expressions after every so manyth scan, in a buffer that reaches `scans` back; the trace's
        number. With a trigger, `{"text": "Main.level", "when": "above", "value": "50", "before": 20}`, it waits for that; with `repeat`
        again and again."""
        body = {
            "name": name, "signals": list(signals), "every": every, "scans": scans, "trigger": trigger,
            "repeat": repeat, "start": start,
        }  # fmt: skip
        return (yield from self._send(shapes.TraceInfo, "POST", "traces", body))["id"]

    @asked
    def start_trace(self, number: int) -> Steps[shapes.TraceInfo]:
        """Records again, from now on; arms a trace that has a trigger."""
        return self._send(shapes.TraceInfo, "POST", f"traces/{number}/start")

    @asked
    def stop_trace(self, number: int) -> Steps[shapes.TraceInfo]:
        """Stops recording; what was recorded is kept."""
        return self._send(shapes.TraceInfo, "POST", f"traces/{number}/stop")

    @asked
    def delete_trace(self, number: int) -> Steps[None]:
        """Deletes a trace and what it recorded."""
        return self._send(type(None), "DELETE", f"traces/{number}")

    @asked
    def samples(
        self, number: int, first: int = 0, last: int | None = None, points: int | None = None
    ) -> Steps[Samples]:
        """The samples of scans `first` to `last`; where there are more than `points`, thinned."""
        signals = next((each["signals"] for each in (yield from self._traces()) if each["id"] == number), [])
        data = yield from self._fetch(f"traces/{number}/samples", first=first, last=last, points=points)
        return unpacked(data, signals)

    @asked
    def trace_csv(self, number: int, first: int = 0, last: int | None = None) -> Steps[str]:
        """Every sample of these scans as CSV."""
        return (yield from self._fetch(f"traces/{number}/csv", first=first, last=last)).decode()

    @asked
    def keep_trace(self, number: int, name: str) -> Steps[shapes.TraceRecordInfo]:
        """Keeps what a trace has recorded until now, in the project."""
        return self._send(shapes.TraceRecordInfo, "POST", f"traces/{number}/keep", {"name": name})

    @asked
    def record_past(
        self, signals: Sequence[str], scans: int, last: int | None = None, every: int = 1, timeout_s: float = 600.0
    ) -> Steps[shapes.Retrospective]:
        """Records so many scans that are over, up to `last` or the newest, while the PLC goes on, and waits for it: `record` is the number of
        the record that came of it, for `record_samples`; None where there is none, and `message` says why."""
        body = {"signals": list(signals), "scans": scans, "last": last, "every": every}
        begun = yield from self._send(shapes.Retrospective, "POST", "retrospectives", body)
        return (
            yield from waited(
                lambda: self._get(shapes.Retrospective, f"/api/retrospectives/{begun['id']}"),
                lambda now: now["record"] is None and not now["message"], timeout_s,
                lambda now: f"{now['done']} of {now['of']} scans are recorded",
            )
        )  # fmt: skip

    @asked
    def record_samples(
        self, record: int, first: int = 0, last: int | None = None, points: int | None = None
    ) -> Steps[Samples]:
        """The samples of a kept record."""
        path = f"/api/trace-records/{record}"
        signals = (yield from self._get(shapes.TraceRecordInfo, path))["signals"]
        data = yield from self._fetch(f"{path}/samples", first=first, last=last, points=points)
        return unpacked(data, signals)

    def _traces(self) -> Steps[list[shapes.TraceInfo]]:
        return self._get(list[shapes.TraceInfo], "traces")


def unpacked(data: bytes, signals: Sequence[shapes.TraceSignal]) -> Samples:
    """Samples from their bytes."""
    _, thinned, count, rows, _, _, _ = _HEAD.unpack_from(data)
    columns = [struct.unpack_from(f"<{rows}Q", data, _HEAD.size + 8 * rows * at) for at in range(2 + count)]
    values = {
        signal["text"]: [number(raw, signal["kind"], signal["size"]) if valid >> at & 1 else None for raw, valid in zip(column, columns[1], strict=True)]
        for at, (signal, column) in enumerate(zip(signals, columns[2:], strict=True))
    }  # fmt: skip
    return Samples(list(columns[0]), values, bool(thinned))


def number(raw: int, kind: str, size: int) -> Number:
    """A value of so many bytes, which lie in the image as those of `raw`."""
    data = raw.to_bytes(8, "little")[:size]
    if kind == "bool":
        return bool(raw)
    if kind == "real":
        found: float = struct.unpack("<f" if size == 4 else "<d", data)[0]
        return found
    return int.from_bytes(data, "little", signed=kind in _SIGNED)
