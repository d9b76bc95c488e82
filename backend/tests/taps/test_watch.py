"""The watch tap: only what changed, in the frame's exact bytes."""

import struct
from dataclasses import dataclass, field

import pytest

from scanbench.runtime.programs import EngineFactory
from scanbench.runtime.resource import Resource
from scanbench.runtime.write import Write
from scanbench.symbols.symbols import resolve
from scanbench.taps.watch import WatchPlan
from tests.runtime.bench import ENGINES, plc

SOURCE = """
PROGRAM Main
VAR b : BOOL; i : INT := -2; r : REAL := 1.5; l : LREAL; t : TIME := T#2s; s : STRING[10] := 'hi'; w AT W10 : WORD;
  bit AT W10.03 : BOOL; high AT W10.15 : BOOL; u : User; other : INT := 9; bitUser : BitUser; END_VAR
  i := i + 1;
  u(v := i);
  bitUser(v := bit);
END_PROGRAM
FUNCTION_BLOCK User
VAR_IN_OUT v : INT; END_VAR
VAR c : INT; END_VAR
  c := v;
END_FUNCTION_BLOCK
FUNCTION_BLOCK BitUser
VAR_IN_OUT v : BOOL; END_VAR
VAR c : BOOL; END_VAR
  c := v;
END_FUNCTION_BLOCK
"""


@dataclass
class Parsed:
    full: bool
    scan: int
    values: dict[int, bytes] = field(default_factory=dict)
    texts: dict[int, bytes] = field(default_factory=dict)


def parse(data: bytes) -> Parsed:
    kind, full, zero, count, scan, _ = struct.unpack_from("<BBHIQq", data)
    assert (kind, zero) == (1, 0)
    frame, at = Parsed(bool(full), scan), 24
    ids = struct.unpack_from(f"<{count}I", data, at)
    at += -(-4 * count // 8) * 8
    for id in ids:
        frame.values[id], at = data[at : at + 8], at + 8
    (strings,) = struct.unpack_from("<I", data, at)
    at += 4
    for _ in range(strings):
        id, length = struct.unpack_from("<II", data, at)
        frame.texts[id], at = data[at + 8 : at + 8 + length], at + 8 + length
    assert at == len(data)
    return frame


def plan_of(resource: Resource, *paths: str) -> WatchPlan:
    symbols = {number: resolve(resource.program, path) for number, path in enumerate(paths, 1)}
    return WatchPlan(resource.program, symbols, len(resource.memory))


def sample(plan: WatchPlan, resource: Resource) -> Parsed | None:
    data = plan.sample(resource.memory, resource.header.scan, resource.header.clock_ns)
    return None if data is None else parse(data)


@pytest.mark.parametrize("engine", ENGINES)
def test_values_of_every_kind_then_only_changes(engine: EngineFactory) -> None:
    resource = plc(SOURCE, engine)
    resource.submit(Write("Ada", "W10", "16#8008"))
    paths = ("Main.b", "Main.i", "Main.r", "Main.l", "Main.t", "Main.s", "Main.w", "W10.03", "Main.high", "W10.04")
    plan = plan_of(resource, *paths)
    first = sample(plan, resource)
    assert first is not None
    assert not first.full
    assert first.values == {
        1: bytes(8), 2: b"\xfe\xff" + bytes(6), 3: struct.pack("<f", 1.5) + bytes(4), 4: bytes(8),
        5: struct.pack("<q", 2_000_000_000), 7: b"\x08\x80" + bytes(6), 8: b"\1" + bytes(7), 9: b"\1" + bytes(7),
        10: bytes(8),
    }  # fmt: skip
    assert first.texts == {6: b"hi"}
    assert sample(plan, resource) is None
    resource.run(1)
    changed = sample(plan, resource)
    assert changed is not None
    assert changed.values == {2: b"\xff\xff" + bytes(6)}
    assert changed.scan == 1
    resource.submit(Write("Ada", "Main.s", "'longer'"))
    resource.submit(Write("Ada", "W10.04", "TRUE"))
    changed = sample(plan, resource)
    assert changed is not None
    assert changed.texts == {6: b"longer"}
    assert set(changed.values) == {7, 10}
    whole = parse(plan.snapshot(resource.memory, 1, 0))
    assert whole.full
    assert set(whole.values) | set(whole.texts) == set(range(1, 11))


@pytest.mark.parametrize("engine", ENGINES)
def test_in_outs_appear_when_connected_and_are_followed(engine: EngineFactory) -> None:
    resource = plc(SOURCE, engine)
    plan = plan_of(resource, "Main.u.v", "Main.bitUser.v")
    assert sample(plan, resource) is None  # never called
    resource.submit(Write("Ada", "Main.bit", "TRUE"))
    resource.run(1)
    frame = sample(plan, resource)
    assert frame is not None
    assert frame.values == {1: b"\xff\xff" + bytes(6), 2: b"\1" + bytes(7)}
    slot = resolve(resource.program, "Main.u.v").slots[0]
    other = resolve(resource.program, "Main.other").offset
    resource.memory[slot : slot + 8] = other.to_bytes(8, "little")  # as another call would
    frame = sample(plan, resource)
    assert frame is not None
    assert frame.values == {1: b"\x09" + bytes(7)}


def test_a_new_plan_goes_on_where_the_old_one_was() -> None:
    resource = plc(SOURCE)
    old = plan_of(resource, "Main.b", "Main.s", "Main.i")
    assert sample(old, resource) is not None
    new = plan_of(resource, "Main.b", "Main.s", "Main.i", "Main.r")
    new.keep_last(old, again=[3])
    frame = sample(new, resource)
    assert frame is not None
    assert set(frame.values) == {3, 4}  # 4 is new, 3 was asked for again
    assert not frame.texts


def test_the_last_byte_of_the_image_can_be_watched() -> None:
    resource = plc("FUNCTION_BLOCK F\nVAR_TEMP t : BOOL; END_VAR\nt := TRUE;\nEND_FUNCTION_BLOCK\n" + SOURCE)
    symbol = resolve(resource.program, "Main.b")
    last = len(resource.memory) - 1
    resource.memory[last] = 7
    plan = WatchPlan(resource.program, {1: type(symbol)("x", "x", symbol.type, "VAR", last)}, len(resource.memory))
    frame = sample(plan, resource)
    assert frame is not None
    assert frame.values == {1: b"\7" + bytes(7)}


REFERRING = """
INTERFACE State METHOD Run END_METHOD END_INTERFACE
FUNCTION_BLOCK Idle IMPLEMENTS State
VAR scans : DINT; END_VAR
METHOD PUBLIC Run scans := scans + 1; END_METHOD
END_FUNCTION_BLOCK
PROGRAM Main
VAR first, second : Idle; now : State; near : REF_TO INT; list : ARRAY[1..3] OF INT; i : INT; END_VAR
  i := i + 1;
  IF i > 1 THEN now := second; near := REF(list[2]); END_IF;
END_PROGRAM
"""


@pytest.mark.parametrize("engine", ENGINES)
def test_what_references_and_interfaces_refer_to_is_said_by_name(engine: EngineFactory) -> None:
    resource = plc(REFERRING, engine)
    plan = plan_of(resource, "Main.now", "Main.near")
    frame = sample(plan, resource)
    assert frame is not None
    assert not frame.values
    assert frame.texts == {1: b"NULL", 2: b"NULL"}
    resource.run(1)
    assert sample(plan, resource) is None
    resource.run(1)
    frame = sample(plan, resource)
    assert frame is not None
    assert frame.texts == {1: b"-> Main.second", 2: b"-> Main.list[2]"}
