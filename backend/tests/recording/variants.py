"""A small run file in which each field of each record is changed to extreme values in turn, with right checksums."""

import json
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import Path
from struct import Struct

import msgpack  # type: ignore[import-untyped]

from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.observed import ObservedBuilds
from scanbench.faults.arm import Arm
from scanbench.faults.detect import Detection
from scanbench.faults.disturb.definition import Disturbance
from scanbench.faults.disturb.disturb import Disturb
from scanbench.faults.disturb.schedule import DisturbanceSchedule
from scanbench.faults.inject import Generate
from scanbench.faults.reference import ErrorRef
from scanbench.faults.schedule import Schedule
from scanbench.faults.shapes import Shape, Wanted
from scanbench.program.layout import Layout
from scanbench.recording.format import Kind, RunFile
from scanbench.recording.timeline import Timeline
from scanbench.runtime.agenda import Agenda
from scanbench.runtime.command import Command, Entry
from scanbench.runtime.forces import Force
from scanbench.runtime.joined import Joined
from scanbench.runtime.write import Write
from scanbench.wire.codec import ENTRIES
from tests.recording.recorded import COUNTER, advance, spare

BATTERY, UNIT = (ErrorRef("battery-error"),), (ErrorRef("cpu-bus-unit-error", (("unit", "3"),)),)
EXTREME = (0, 65_535, 1 << 53, (1 << 64) - 1)
COMMANDS: tuple[Command, ...] = (
    Write("Ada", "Main.other", "7"),
    Force("Ada", "Main.d", "3"),
    Arm("Ada", Wanted(BATTERY, shape=Shape("intermittent", scans=2, period=5))),
    Disturb("Ada", Disturbance("flip", "Main.other", probability=0.25, times=3)),
    Disturb("Ada", Disturbance("stuck", "Main.start", scans=4)),
    Generate("Ada", UNIT),
    Arm("Ada", Wanted((ErrorRef("cpu-bus-unit-setting-error", (("unit", "3"),)),), shape=Shape("chatter"))),
    Disturb("Ada", Disturbance("late", "Main.start", scan=50, scans=4, probability=0.5)),
)
_U64, _U32 = Struct("<Q"), Struct("<I")
_VERSION = 4
"""Bytes before the state of a keyframe."""
HEADER = 64


def agenda() -> Agenda:
    """As the process of a PLC has it."""
    return Joined(Schedule(ObservedBuilds().engine), DisturbanceSchedule())


Record = tuple[Kind, int, bytes]


@cache
def records(folder: Path) -> tuple[Record, ...]:
    """What a run of a few scans wrote."""
    timeline = Timeline.begin(
        folder / "whole", spare(ReferenceEngine), 1, COUNTER.encode(), ENTRIES, "Ada", Detection(), agenda=agenda()
    )
    for command in COMMANDS:
        outcome = timeline.submit(command)
        assert isinstance(outcome, Entry), outcome
        advance(timeline, 3)
    timeline.recording.checkpoint(timeline.live_scan, 1, timeline.resource.state)
    advance(timeline, 3)
    timeline.close()
    file = RunFile.open(folder / "whole", read_only=True)
    found = tuple((each.kind, each.scan, file.payload(each)) for each in file.scan_blocks())
    file.close()
    assert {kind for kind, _, _ in found} == set(Kind)
    return found


def write(path: Path, changed: Sequence[Record]) -> Path:
    """A run file of these records."""
    path.unlink(missing_ok=True)
    file = RunFile.create(path)
    for kind, scan, payload in changed:
        file.append(kind, scan, payload)
    file.close()
    return path


def variants(of: Sequence[Record]) -> Iterator[tuple[str, list[Record]]]:
    """Each field of each record changed, and what was changed."""
    for index, (kind, scan, payload) in enumerate(of):
        before, after = list(of[:index]), list(of[index + 1 :])
        name = f"{index} {kind.name}"
        for value in EXTREME:
            if 0 <= value != scan:
                yield f"{name} block scan {value}", [*before, (kind, value, payload), *after]
                if value > 1:
                    shifted = [_later(each, value) for each in of[index:]]
                    yield f"{name} and all after it, {value} scans later", [*before, *shifted]
        for what, changed in _payloads(kind, payload):
            yield f"{name} {what}", [*before, (kind, scan, changed), *after]


def _payloads(kind: Kind, payload: bytes) -> Iterator[tuple[str, bytes]]:
    match kind:
        case Kind.ABOUT:
            about = json.loads(payload)
            for field, known in about.items():
                for value in EXTREME if isinstance(known, int) else ():
                    yield f"{field} {value}", json.dumps({**about, field: value}).encode()
        case Kind.PROGRAM:
            yield from _numbers(payload, "version", 0, _U32)
        case Kind.KEYFRAME:
            yield from _numbers(payload, "version", 0, _U32)
            for at in range(0, HEADER, _U64.size):
                yield from _numbers(payload, f"header {at}", _VERSION + at, _U64)
        case Kind.DELTA:
            for at in range(0, HEADER, _U64.size):
                yield from _numbers(payload, f"header {at}", at, _U64)
        case Kind.ENTRY:
            tree = _decoded(payload)
            for path, known in _leaves(tree):
                for value in EXTREME:
                    if value != known:
                        yield f"field {'.'.join(map(str, path))} {value}", _encoded(_replaced(tree, path, value))


def _numbers(payload: bytes, what: str, at: int, form: Struct) -> Iterator[tuple[str, bytes]]:
    for value in EXTREME:
        if 0 <= value < 1 << 8 * form.size:
            yield f"{what} {value}", payload[:at] + form.pack(value) + payload[at + form.size :]


def _later(record: Record, scans: int) -> Record:
    """The same record, so many scans later, wherever it says its scan."""
    kind, scan, payload = record
    later = min(scan + scans, (1 << 64) - 1)
    if kind is Kind.ENTRY:
        tree = _decoded(payload)
        payload = _encoded(_replaced(tree, (1,), later))
    elif kind in (Kind.KEYFRAME, Kind.DELTA):
        at = Layout.SCAN + (_VERSION if kind is Kind.KEYFRAME else 0)
        known = _U64.unpack_from(payload, at)[0]
        payload = payload[:at] + _U64.pack(known ^ scan ^ later) + payload[at + _U64.size :]
    return kind, later, payload


# ---- entries: lists of a class's name and its fields ------------------------------------------------------------


def _decoded(payload: bytes) -> object:
    return msgpack.unpackb(payload, ext_hook=lambda code, data: [_Object(code), *_fields(data)], strict_map_key=False)


def _fields(data: bytes) -> list[object]:
    found = _decoded(data)
    assert isinstance(found, list)
    return found


class _Object:
    """First in the list of an object's fields."""

    def __init__(self, code: int) -> None:
        self.code = code


def _encoded(tree: object) -> bytes:
    packed = msgpack.packb(_raw(tree))
    assert isinstance(packed, bytes)
    return packed


def _raw(tree: object) -> object:
    if not isinstance(tree, list):
        return tree
    if tree and isinstance(tree[0], _Object):
        return msgpack.ExtType(tree[0].code, _encoded(tree[1:]))
    return [_raw(each) for each in tree]


def _leaves(tree: object, path: tuple[int, ...] = ()) -> Iterator[tuple[tuple[int, ...], object]]:
    if isinstance(tree, list):
        for index, each in enumerate(tree):
            yield from _leaves(each, (*path, index))
    elif isinstance(tree, int | float) or tree is None:
        yield path, tree


def _replaced(tree: object, path: tuple[int, ...], value: object) -> object:
    if not path:
        return value
    assert isinstance(tree, list)
    return [_replaced(each, path[1:], value) if index == path[0] else each for index, each in enumerate(tree)]
