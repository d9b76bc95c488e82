"""A thousand random disturbances: each that changes a byte is found in its scan, with its variable; and nothing else is.

All of them are in one run, a scan apart at least, so that it is known of each scan what has to be found.
"""

from pathlib import Path
from random import Random

import pytest

from scanbench.engines.available import flavours
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.engine import NativeEngine
from scanbench.faults.disturb.definition import Disturbance
from scanbench.faults.disturb.disturb import Disturb, told
from scanbench.faults.disturb.fire import Corrupt, Flip
from scanbench.faults.disturb.schedule import DisturbanceSchedule
from scanbench.recording.headless import HeadlessRun, run_headless
from scanbench.recording.programs import on, reference
from scanbench.recording.recording import Recording
from scanbench.runtime.command import Command, Entry, Freed, Held, Patch
from scanbench.runtime.header import Mode, fresh_image
from scanbench.runtime.programs import EngineFactory
from scanbench.runtime.write import Write
from scanbench.symbols.names import names_of
from scanbench.symbols.symbols import resolve
from scanbench.verify.contract import Mismatch, Range
from scanbench.wire.codec import ENTRIES
from tests.runtime.bench import program
from tests.verify.verified_runs import opened

SOURCE = """
TYPE Pair : STRUCT a : INT; b : LREAL; c : ARRAY[0..2] OF BOOL; END_STRUCT END_TYPE
VAR_GLOBAL switch AT CIO0.03 : BOOL; key AT CIO0.04 : BOOL; speed AT CIO2 : WORD; lamp AT CIO100.05 : BOOL; level AT D120 : INT;
  set AT W3 : DWORD; spare : LINT; END_VAR
FUNCTION_BLOCK Belt
VAR_INPUT go : BOOL; v : INT; END_VAR VAR_IN_OUT total : DINT; END_VAR VAR_OUTPUT done : BOOL; END_VAR VAR pos : INT; t : TON; END_VAR
  IF go THEN
    pos := pos + v;
    total := total + 1;
  END_IF;
  IF pos > 200 THEN
    pos := 0;
  END_IF;
  done := pos > 100;
  t(IN := done, PT := T#30ms);
END_FUNCTION_BLOCK
FUNCTION Mean : INT
VAR_INPUT x, y : INT; END_VAR VAR sum : INT; END_VAR
  sum := x + y;
  Mean := sum / 2;
END_FUNCTION
PROGRAM Main
VAR n : DINT; u : UINT; r : REAL; l : LREAL; text : STRING[12] := 'abc'; pair, other : Pair; list : ARRAY[0..7] OF INT;
  belt : ARRAY[0..1] OF Belt; total : DINT; i : INT; m : INT; b : BOOL; left : BYTE; time1 : TIME; END_VAR
  n := n + 1;
  u := WORD_TO_UINT(speed);
  r := r + 0.5;
  l := LREAL#2.0 * l + 1.0;
  IF l > 1000.0 THEN l := 0.0; END_IF;
  text := CONCAT(LEFT(text, 4), 'xy');
  pair.a := pair.a + 3;
  pair.c[1] := switch;
  other := pair;
  FOR i := 0 TO 7 DO
    list[i] := list[i] + i;
  END_FOR;
  belt[0](go := switch, v := 7, total := total);
  belt[1](go := key, v := level, total := total);
  m := Mean(list[3], 10);
  b := belt[0].done OR key;
  lamp := b AND NOT switch;
  left := SHL(left, 1) OR BYTE#1;
  set := SHR(set, 1);
  time1 := time1 + T#10ms;
END_PROGRAM
"""
MEMORY = (
    "D120", "D777", "W3", "W100.07", "CIO0.09", "CIO100.05", "H5", "switch", "speed", "level", "set", "spare", "lamp", "Main.n", "Main.u",
    "Main.r", "Main.l", "Main.text", "Main.pair.a", "Main.pair.b", "Main.pair.c[1]", "Main.other.b", "Main.list[5]", "Main.belt[0].pos",
    "Main.belt[1].total", "Main.belt[1].done", "Main.belt[0].t.ET", "Main.belt[0].t.Q", "Main.m", "Main.b", "Main.left", "Main.time1",
)  # fmt: skip
WRITING = (
    "pos := pos + v;", "total := total + 1;", "done := pos > 100;", "sum := x + y;", "Mean := sum / 2;", "n := n + 1;",
    "u := WORD_TO_UINT(speed);", "r := r + 0.5;", "l := LREAL#2.0 * l + 1.0;", "text := CONCAT(LEFT(text, 4), 'xy');",
    "pair.a := pair.a + 3;", "pair.c[1] := switch;", "other := pair;", "list[i] := list[i] + i;",
    "belt[0](go := switch, v := 7, total := total);", "m := Mean(list[3], 10);", "lamp := b AND NOT switch;",
    "left := SHL(left, 1) OR BYTE#1;", "set := SHR(set, 1);", "time1 := time1 + T#10ms;", "pos := 0;",
)  # fmt: skip
INPUTS = ("CIO0.03", "CIO0.04", "speed", "")
TEMPORARIES = ("Mean.sum", "Mean.x", "Mean.y", "Mean.Mean", "Mean")
LINES = {text.strip(): number for number, text in enumerate(SOURCE.splitlines(), 1)}


def planned(random: Random, count: int) -> list[tuple[int, Command]]:
    """Random disturbances, and people who change inputs meanwhile."""
    commands: list[tuple[int, Command]] = []
    scan = 3
    for _ in range(count):
        kind = random.choice(("flip", "flip", "flip", "result", "late", "stuck"))
        scans = 1
        if kind == "flip":
            wanted = Disturbance("flip", random.choice(MEMORY), seed=random.randrange(1 << 32))
        elif kind == "result":
            site = f"main.st:{LINES[random.choice(WRITING)]}"
            wanted = Disturbance("result", site=site, seed=random.randrange(1 << 32))
        else:
            scans = random.choice((1, 2, 3))
            wanted = Disturbance("late" if kind == "late" else "stuck", random.choice(INPUTS), scans=scans)
        commands.append((scan, Disturb("Ada", wanted)))
        for at in range(scan, scan + scans):
            commands += [(at, each) for each in written(random)]
        scan += scans + random.choice((1, 1, 2))
    return commands


def written(random: Random) -> list[Command]:
    """Inputs that change, perhaps."""
    made: list[Command] = []
    for path, values in (("switch", ("TRUE", "FALSE")), ("key", ("TRUE", "FALSE")), ("speed", ("1", "500", "16#8001"))):
        if random.random() < 0.4:
            made.append(Write("Bob", path, random.choice(values)))
    return made


def found_at(differences: list[Mismatch], image: bytearray) -> set[int]:
    """The bytes of the variables that are named."""
    found: set[int] = set()
    for each in differences:
        if each.name in TEMPORARIES:
            continue
        symbol = resolve(program(SOURCE), each.name)
        place = symbol.locate(image)
        assert place is not None
        found |= set(range(place[0], place[0] + symbol.type.size))
    return found


class Expected:
    """Of each scan: the bytes that have to be found."""

    def __init__(self, entries: tuple[Entry, ...], image: bytes) -> None:
        self.bytes: dict[int, set[int]] = {}
        self._wires = bytearray(image)
        """What was written to the inputs, whatever is held there."""
        self._wrong: dict[int, int] = {}
        """Bits that flipped in this seam, and that nobody wrote afterwards."""
        self._held: dict[int, tuple[tuple[int, int, int], ...]] = {}
        by_scan: dict[int, list[Entry]] = {}
        for entry in entries:
            by_scan.setdefault(entry.scan, []).append(entry)
        for scan in range(max(by_scan) + 1):
            self._wrong.clear()
            for entry in by_scan.get(scan, ()):
                self._take(entry)
            self._expect(scan, {at for at, mask in self._wrong.items() if mask})
            for spots in self._held.values():
                self._expect(scan, {at for at, mask, value in spots if (self._wires[at] ^ value) & mask})

    def _take(self, entry: Entry) -> None:
        match entry.plan.effect:
            case Held(number, spots):
                self._held[number] = spots
            case Freed(numbers):
                for number in numbers:
                    del self._held[number]
            case None:
                for patch in entry.plan.patches:
                    self._patch(entry, patch)

    def _patch(self, entry: Entry, patch: Patch) -> None:
        if isinstance(entry.command, Corrupt):
            self._expect(entry.scan, {patch.offset})
            return
        for at, (mask, data) in enumerate(zip(patch.mask, patch.data, strict=True), patch.offset):
            self._wires[at] = self._wires[at] & ~mask | data & mask
            turned = self._wrong.get(at, 0)
            self._wrong[at] = turned ^ mask if isinstance(entry.command, Flip) else turned & ~mask

    def _expect(self, scan: int, found: set[int]) -> None:
        if found:
            self.bytes.setdefault(scan, set()).update(found)


@pytest.mark.parametrize("engine", [NativeEngine, ReferenceEngine], ids=("native", "reference"))
def test_every_one_is_found_and_nothing_else(tmp_path: Path, engine: EngineFactory) -> None:
    random = Random(7 if engine is NativeEngine else 8)
    commands, checked = planned(random, 700 if engine is NativeEngine else 300), program(SOURCE)
    end = commands[-1][0] + 8
    with Recording.begin(tmp_path / "run", checked, 1, SOURCE.encode(), ENTRIES, "Ada") as recording:
        result: HeadlessRun[None] = run_headless(
            checked, end, engine, commands, agenda=DisturbanceSchedule(), recording=recording
        )
    assert result.refused == ()
    expected = Expected(result.entries, bytes(fresh_image(checked, Mode.MONITOR)))
    size = checked.layout.state_size
    make = on(flavours()) if engine is NativeEngine else reference
    with opened(tmp_path / "run", lambda kept: checked, make) as verifier:
        verifier.begin(Range())
        for scan in range(end):
            rows = verifier.verify(scan).rows
            differences = [each for row in rows for each in row.differences]
            entries = [each for each in result.entries if each.scan == scan]
            about = f"scan {scan}: {[told(each) for each in entries]}, {[each.message for each in differences]}"
            wanted = expected.bytes.get(scan, set())
            assert bool(differences) == bool(wanted), about
            missing = {at for at in wanted if at < size} - found_at(differences, result.resource.memory)
            assert not missing, f"{about}: {[names_of(checked).path(at) for at in missing]}"
            said = {text for row in rows for text in row.disturbances}
            begun = {told(each) for each in entries if told(each)}
            assert begun <= said, about
            assert all(" stuck" in text or " late" in text or " lost" in text for text in said - begun), (
                about
            )  # they last
