"""What differs at the end of a scan and is no use of the range: at which call it is told, and as what."""

from pathlib import Path

from scanbench.faults.disturb.definition import Disturbance
from scanbench.faults.disturb.disturb import Disturb
from scanbench.faults.disturb.schedule import DisturbanceSchedule
from tests.runtime.bench import program
from tests.verify.verified_runs import record, verifier

SOURCE = """FUNCTION_BLOCK Tank
VAR_INPUT step : INT; END_VAR VAR_IN_OUT level : INT; END_VAR VAR_OUTPUT share : INT(0..100); END_VAR
  level := level + step;
  share := level;
END_FUNCTION_BLOCK
PROGRAM Main
VAR a : INT := 500; b : INT; one, two : Tank; copy : INT; END_VAR
  one(step := 1, level := a);
  two(step := 2, level := b);
  copy := a;
END_PROGRAM
"""


def test_a_violation_that_kept_a_wrong_value_is_told_where_the_value_is_and_marks_no_other_instance(
    tmp_path: Path,
) -> None:
    wrong = Disturbance("result", site="main.st:3", bit=3, scan=7)
    path = record(tmp_path / "run", program(SOURCE), 9, [(3, Disturb("Ada", wrong))], agenda=DisturbanceSchedule())
    one, two = verifier(path, program(SOURCE), "Tank").verify(7).rows
    assert [one.instance, two.instance] == ["Main.one", "Main.two"]
    assert two.differences == (), "it came out right"
    assert {each.name: each.cause for each in one.differences} == {
        "level": "logic", "violation 1: value (system)": "logic", "Main.copy": "outside",
    }  # fmt: skip
