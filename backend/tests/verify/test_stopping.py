"""Disturbances that stop a PLC: run-time errors, loops that do not end, and programs that stop it themselves. Each is found at its scan,
statement and instance, live and in the past."""

from pathlib import Path
from random import Random

import pytest

from scanbench.engines.available import flavours
from scanbench.faults.disturb.definition import Disturbance
from scanbench.faults.disturb.disturb import Disturb
from scanbench.faults.disturb.schedule import DisturbanceSchedule
from scanbench.program.program import Program
from scanbench.recording.programs import cached, on
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


@pytest.fixture(scope="module")
def made() -> Program:
    return program(SOURCE)


@pytest.mark.parametrize(
    "seed", [pytest.param(each, marks=[] if each < 20 else nightly) for each in range(amount(1000, 20))]
)
def test_each_is_found_where_it_stops_the_plc(seed: int, made: Program, tmp_path: Path) -> None:
    found_where_it_stops(made, tmp_path, *stops(seed))


@slow
def test_a_loop_that_does_not_end_is_found(made: Program, tmp_path: Path) -> None:
    found_where_it_stops(made, tmp_path, *stops(1, LOOP))


def found_where_it_stops(made: Program, tmp_path: Path, wanted: Disturbance, line: int, instance: str) -> None:
    assert wanted.scan is not None
    path = record(
        tmp_path / "run", made, 24, [(1, Disturb("Ada", wanted))], agenda=DisturbanceSchedule(), programs=cached({1: made}, MAKE)
    )  # fmt: skip
    with verifier(path, made, make=MAKE) as verified:
        assert verified.end == wanted.scan + 1
        found = [(scan, row) for scan in range(verified.end) for row in verified.verify(scan).rows if row.differs]
        (scan, row) = found[0]
        assert (len(found), scan) == (1, wanted.scan)
        (trap,) = [each for each in row.differences if each.cause == "trap"]
        assert trap.place is not None
        assert (trap.place.line, trap.place.instance) == (line, instance)
        assert row.disturbances == (f"Result of {wanted.site}, bit {wanted.bit}",)
        assert verified.verify(wanted.scan).rows == (row,)  # the same when it is asked for once more
