"""Disturbances that stop a PLC: run-time errors, loops that do not end, and programs that stop it themselves. Each is found at its scan,
statement and instance, live and in the past."""

from collections.abc import Sequence
from pathlib import Path
from random import Random

import pytest

from scanbench.engines.available import flavours
from scanbench.faults.disturb.definition import Disturbance
from scanbench.faults.disturb.disturb import Disturb
from scanbench.faults.disturb.schedule import DisturbanceSchedule
from scanbench.program.program import Program
from scanbench.recording.programs import cached, on
from scanbench.runtime.command import Command
from scanbench.runtime.modes import SetMode
from tests.amounts import amount, nightly, slow
from tests.runtime.bench import program
from tests.verify.verified_runs import record, verifier

SOURCE = """\
FUNCTION_BLOCK Guard
VAR_INPUT v : INT; END_VAR VAR limit, ix, by, q, n, top : INT; list : ARRAY[0..9] OF INT; END_VAR
METHOD PUBLIC check
  limit := v + 1;
  IF limit > 500 THEN
    FALS(7);
  END_IF;
END_METHOD
  ix := v;
  list[ix] := list[ix] + 1;
  by := 0 - 256;
  q := 1000 / (by + 256 * 2);
  top := v;
  n := 0;
  WHILE n <> top DO
    n := n + 1;
    IF n > 20 THEN n := 15; END_IF;
  END_WHILE
  check();
END_FUNCTION_BLOCK
PROGRAM Main
VAR n : INT; g : ARRAY[1..3] OF Guard; END_VAR
  n := (n + 1) MOD 10;
  g[1](v := n);
  g[2](v := 9 - n);
  g[3](v := 3);
END_PROGRAM
"""
MAKE = on(flavours())
LOOP = 13
"""The line after which a loop does not end: its 50 million rounds take half a minute on both sides."""
CASES = {
    # which statement is disturbed: bits of its result with which the PLC stops, and where it stops
    4: (range(9, 15), 6),
    9: (range(4, 15), 10),
    11: ((8,), 12),  # -256 becomes -512, by which it divides 1000 after 512 is added
    13: (range(5, 15), 15),
}


def stops(seed: int, line: int = 0) -> tuple[Disturbance, int, str]:
    """A disturbance, and where it stops the PLC."""
    chance = Random(seed)
    line = line or chance.choice([each for each in CASES if each != LOOP])
    bits, at = CASES[line]
    wanted = Disturbance("result", site=f"main.st:{line}", bit=chance.choice(list(bits)), scan=chance.randrange(2, 20))
    return wanted, at, "Main.g[1]"


def mode_changes(seed: int, before: int) -> list[tuple[int, Command]]:
    """Of every second run: PROGRAM for a while, over before this scan or just as it begins."""
    chance = Random(-seed)
    if seed % 2 or before < 2:
        return []
    first = chance.randrange(1, before)
    return [
        (first, SetMode("Bob", "PROGRAM")),
        (chance.randrange(first + 1, before + 1), SetMode("Bob", chance.choice(("MONITOR", "RUN")))),
    ]


@pytest.fixture(scope="module")
def made() -> Program:
    return program(SOURCE)


@pytest.mark.parametrize(
    "seed", [pytest.param(each, marks=[] if each < 20 else nightly) for each in range(amount(1000, 20))]
)
def test_each_is_found_where_it_stops_the_plc(seed: int, made: Program, tmp_path: Path) -> None:
    wanted, line, instance = stops(seed)
    assert wanted.scan is not None
    found_where_it_stops(made, tmp_path, wanted, line, instance, mode_changes(seed, wanted.scan))


@slow
def test_a_loop_that_does_not_end_is_found(made: Program, tmp_path: Path) -> None:
    # its record is full long before the watchdog ends it, so the rest of its scan was not looked at
    found_where_it_stops(made, tmp_path, *stops(1, LOOP), full=True)


def found_where_it_stops(
    made: Program, tmp_path: Path, wanted: Disturbance, line: int, instance: str, modes: Sequence[tuple[int, Command]] = (),
    full: bool = False,
) -> None:  # fmt: skip
    assert wanted.scan is not None
    path = record(
        tmp_path / "run", made, 24, [(0, Disturb("Ada", wanted)), *modes], agenda=DisturbanceSchedule(),
        programs=cached({1: made}, MAKE),
    )  # fmt: skip
    with verifier(path, made, make=MAKE) as verified:
        assert verified.end == wanted.scan + 1
        scans = [verified.verify(scan) for scan in range(verified.end)]
        still = range(modes[0][0], modes[1][0]) if modes else range(0)
        assert [each.scan for each in scans if not each.compared] == [*still, *[wanted.scan] * full]
        found = [(each.scan, row) for each in scans for row in each.rows if row.differs]
        (scan, row) = found[0]
        assert (len(found), scan) == (1, wanted.scan)
        (trap,) = [each for each in row.differences if each.cause == "trap"]
        assert trap.place is not None
        assert (trap.place.line, trap.place.instance) == (line, instance)
        assert not any("header+" in each.name or "image+" in each.name for each in row.differences)
        assert row.disturbances == (f"Result of {wanted.site}, bit {wanted.bit}",)
        assert verified.verify(wanted.scan).rows == (row,)  # the same when it is asked for once more


RAISING = """\
PROGRAM Main
VAR n, k : INT; x : INT(0..100); END_VAR
  n := n + 1;
  IF n > 100 THEN FAL(3); END_IF;
  x := n;
  k := k + x;
END_PROGRAM
"""


def test_what_the_system_noted_is_told_in_words(tmp_path: Path) -> None:
    wanted, code = Disturbance("result", site="main.st:3", bit=9, scan=5), program(RAISING)
    path = record(tmp_path / "run", code, 8, [(1, Disturb("Ada", wanted))], agenda=DisturbanceSchedule(), programs=cached({1: code}, MAKE))  # fmt: skip
    with verifier(path, code, make=MAKE) as verified:
        (row,) = verified.verify(5).rows
    names = [each.name for each in row.differences]
    assert {
        "errors that the program raised (system)", "error 1 that the program raised: number (system)", "violation 1: times (system)",
        "_SubrangeErrorCount",
    } <= set(names)  # fmt: skip
    assert not any("header+" in each or "image+" in each for each in names)
    told = next(each.message for each in row.differences if each.name.startswith("errors that"))
    assert (
        told == "errors that the program raised (system) is 16#00000001, the reference gives 16#00000000, after scan 5"
    )
