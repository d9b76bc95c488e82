"""A fault of the native emitter is found by verification in the scan in which it first does anything, at its statement."""

from pathlib import Path

import pytest

from scanbench.check.build import check_sources
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.engine import NativeEngine
from scanbench.host.run_files import sources_in
from scanbench.plcmodel.load import model_named
from scanbench.program.program import Program
from scanbench.recording.blocks import KeptProgram
from scanbench.recording.headless import run_headless
from scanbench.recording.recording import Recording
from scanbench.runtime.programs import Loaded
from scanbench.runtime.resource import Resource
from scanbench.verify.contract import Row
from scanbench.verify.ranges import parse_range
from scanbench.wire.codec import ENTRIES, pack_body
from scanbench.wire.host import Sources
from tests.verify.planted import Fault, planted
from tests.verify.verified_runs import opened

MODEL = "GENERIC-IEC"
INTERVAL = 10_000_000
SCANS = 12
SOURCE = """\
FUNCTION Scaled : DINT
VAR_INPUT raw : DINT; END_VAR
VAR i : DINT; END_VAR
  FOR i := 1 TO 3 DO
    Scaled := Scaled + raw * i;
  END_FOR;
END_FUNCTION

FUNCTION_BLOCK Ramp
VAR_INPUT target : INT; END_VAR
VAR_OUTPUT speed : INT; END_VAR
  IF speed < target THEN
    speed := speed + 25;
  ELSIF speed > target THEN
    speed := speed - 25;
  END_IF;
END_FUNCTION_BLOCK

PROGRAM Main
VAR n : INT; belt : ARRAY[1..3] OF Ramp; i : INT; mean : REAL; scaled : DINT; high : BOOL; END_VAR
  n := n + 1;
  FOR i := 1 TO 3 DO
    belt[i](target := n * 10 * i);
  END_FOR;
  mean := INT_TO_REAL(belt[1].speed + belt[2].speed) / 2.0;
  scaled := Scaled(raw := INT_TO_DINT(n));
  high := belt[3].speed >= 125;
END_PROGRAM
"""
FAULTS = [
    (5, "add", "sub", "Scaled"),  # in a loop of a FUNCTION
    (5, "mul", "add", "Scaled"),
    (13, "add", "sub", "Main.belt["),  # of a block that is called three times
    (12, "lt", "le", "Main.belt["),  # the way of an IF
    (21, "add", "sub", "Main"),
    (25, "div", "mul", "Main"),  # REAL
    (27, "ge", "gt", "Main"),  # a comparison that differs at its bound only
]


@pytest.fixture(scope="module")
def program() -> Program:
    checked = check_sources({"main.st": SOURCE}, model_named(MODEL), INTERVAL)
    assert checked.program is not None, checked.problems
    return checked.program


def recorded(path: Path, program: Program, fault: Fault) -> None:
    """A run of the PLC with the fault."""
    sources = pack_body(Sources(MODEL, {"main.st": SOURCE}, INTERVAL, 1))
    with Recording.begin(path, program, 1, sources, ENTRIES, "test") as recording, fault.in_place():
        run_headless(program, SCANS, NativeEngine, recording=recording)


def first_wrong(program: Program, fault: Fault) -> int:
    """The first scan after which the fault shows, found by running both engines from the same state."""
    wrong = Resource(planted(fault, debug=False)(1, program))
    right = Resource(Loaded.make(program, ReferenceEngine))
    for scan in range(SCANS):
        wrong.run(1)
        right.run(1)
        if wrong.state != right.state:
            return scan
    raise AssertionError("the fault does nothing")


def program_of(kept: KeptProgram) -> Program:
    sources = sources_in(kept)
    checked = check_sources(sources.files, model_named(sources.model), sources.interval_ns)
    assert checked.program is not None
    return checked.program


def differing(path: Path, fault: Fault, stretch: str, debug: bool) -> list[Row]:
    with opened(path, program_of, planted(fault, debug=debug)) as verifier:
        verifier.begin(parse_range(stretch))
        assert (verifier.first, verifier.end) == (0, SCANS)
        return [row for scan in range(SCANS) for row in verifier.verify(scan).rows if row.differs]


@pytest.mark.parametrize(("line", "right", "wrong", "instance"), FAULTS)
def test_it_is_found_in_its_scan_at_its_statement(
    program: Program, tmp_path: Path, line: int, right: str, wrong: str, instance: str
) -> None:
    fault = Fault("main.st", line, right, wrong)
    recorded(tmp_path / "run", program, fault)
    first = differing(tmp_path / "run", fault, "", debug=True)[0]
    assert first.scan == first_wrong(program, fault)
    place = first.differences[0].place
    assert place is not None
    # a comparison that is wrong shows in the statement that runs, and should not
    assert (place.file, place.line) == ("main.st", line + 1 if line == 12 else line)
    assert place.instance.startswith(instance)
    assert f"main.st:{place.line}" in first.differences[0].message


@pytest.mark.parametrize(("line", "right", "wrong", "instance"), FAULTS)
def test_it_is_found_in_its_scan_where_only_the_code_that_runs_live_has_it(
    program: Program, tmp_path: Path, line: int, right: str, wrong: str, instance: str
) -> None:
    """Then results of statements are known only for variables that are in memory after the scan."""
    fault = Fault("main.st", line, right, wrong)
    recorded(tmp_path / "run", program, fault)
    first = differing(tmp_path / "run", fault, "", debug=False)[0]
    assert first.scan == first_wrong(program, fault)
    if line == 12:  # the other code did not go this way at all: no statement of it has written the variable
        assert any(each.name.endswith(".speed") for each in first.differences)
        return
    place = first.differences[0].place
    assert place is not None
    assert (place.file, place.line) == ("main.st", 26 if instance == "Scaled" else line)  # that takes the result
    assert place.instance.startswith("Main" if instance == "Scaled" else instance)


def test_it_is_found_in_the_range_that_has_it_and_in_no_other(program: Program, tmp_path: Path) -> None:
    fault = Fault("main.st", 13, "add", "sub")
    recorded(tmp_path / "run", program, fault)
    rows = differing(tmp_path / "run", fault, "Ramp", True)
    assert {row.instance for row in rows if row.scan == 0} == {"Main.belt[1]", "Main.belt[2]", "Main.belt[3]"}
    found = {each.name for row in rows for each in row.differences if each.cause != "outside"}
    assert found == {"speed"}
    # what Main computes of the wrong values is right
    of_main = [each for row in differing(tmp_path / "run", fault, "Main:25-27", True) for each in row.differences]
    assert {each.cause for each in of_main} <= {"input", "outside"}
    assert {each.name for each in of_main if each.cause == "input"} <= {f"Main.belt[{n}].speed" for n in (1, 2, 3)}


def test_without_a_fault_there_is_no_difference(program: Program, tmp_path: Path) -> None:
    nothing = Fault("main.st", 21, "add", "add")
    recorded(tmp_path / "run", program, nothing)
    assert differing(tmp_path / "run", nothing, "", True) == []


def test_the_uses_of_a_row_are_what_the_row_says(program: Program, tmp_path: Path) -> None:
    fault = Fault("main.st", 25, "div", "mul")
    recorded(tmp_path / "run", program, fault)
    with opened(tmp_path / "run", program_of, planted(fault, debug=False)) as verifier:
        verifier.begin(parse_range("Main:25"))
        row = next(row for scan in range(12) for row in verifier.verify(scan).rows if row.differs)
        wrong = [each for each in verifier.uses(row.scan, row.call) if each.control != each.monitor]
        assert [(each.name, each.control, each.monitor) for each in wrong] == [
            (name, each.control, each.monitor) for name, each in row.outputs.items()
        ]
