"""The sample's handler loses one statement after the other: each time the sweep names the errors that it was for. A harmless
line more changes nothing."""

from functools import cache

import pytest

from scanbench.cli.sweep_states import FromStart, run_state
from scanbench.faults.reaction.compare import Outcome, SweepChange, compare, outcome
from scanbench.faults.reaction.sweep import sweep
from scanbench.faults.reference import ErrorRef
from scanbench.server.samples import samples
from tests.faults.reacting import MAKES, checked, programs
from tests.runtime.bench import model

(SAMPLE,) = (each for each in samples() if each.name == "Conveyor")
FILE = "ErrorHandler.st"
STATES = (
    FromStart("Stopped", 20),
    FromStart("Running", 30, ("10: start=TRUE", "12: start=FALSE")),
    FromStart("Acknowledged", 40, ("10: raise basic-io-error", "20: clear basic-io-error", "40: reset=TRUE")),
)
ERRORS = [each.id for each in model().errors() if each.severity == "nonfatal"]
UNITS = {"cpu-bus-unit-error", "special-io-unit-error", "special-io-unit-unknown"}
ALL = {"basic-io-error", *UNITS}
# Every statement of the handler, and the errors whose handler is lost with it. An IF goes with all that is in it.
STATEMENTS = (
    ("any := basicIoError OR cpuBusError OR specialIoError;", ALL),
    ("edge(CLK := any);", ALL),
    ("IF edge.Q THEN\n    count := count + 1;\n  END_IF;", ALL),
    ("count := count + 1;", ALL),
    ("IF any THEN\n    lamp := TRUE;\n  ELSIF reset THEN\n    lamp := FALSE;\n  END_IF;", ALL),
    ("lamp := TRUE;", ALL),
    ("ELSIF reset THEN\n    lamp := FALSE;", ALL),
    ("lamp := FALSE;", ALL),
    ("hold := basicIoError;", {"basic-io-error"}),
    ("IF innerBoardError THEN\n    ; // to be done\n  END_IF;", {"inner-board-error"}),
)


def swept(handler: str) -> list[Outcome]:
    make = MAKES["native"]
    program = checked({**SAMPLE.files, FILE: handler}, SAMPLE.model)
    points = {state.name: run_state(state, program, make, 1) for state in STATES}
    cells = list(sweep(points, [ErrorRef(each) for each in ERRORS], 30, programs(program, make)))
    found = [outcome(each.error, each.point, each.reaction) for each in cells if each.reaction is not None]
    assert len(found) == len(ERRORS) * len(STATES), cells
    return found


@cache
def as_it_is() -> list[Outcome]:
    return swept(SAMPLE.files[FILE])


def compared(old: str, new: str) -> tuple[SweepChange, ...]:
    text = SAMPLE.files[FILE]
    assert text.count(old) == 1, old
    return compare(as_it_is(), swept(text.replace(old, new)))


def test_every_statement_is_in_the_list() -> None:
    body = SAMPLE.files[FILE].split("END_VAR")[-1].split("END_FUNCTION_BLOCK")[0]
    for statement, _ in sorted(STATEMENTS, key=lambda each: -len(each[0])):
        body = body.replace(statement, "")
    assert [each for each in body.splitlines() if each.strip() and not each.strip().startswith("//")] == []


@pytest.mark.parametrize(("statement", "errors"), STATEMENTS, ids=[each.split("\n")[0] for each, _ in STATEMENTS])
def test_a_statement_that_is_lost_names_its_errors(statement: str, errors: set[str]) -> None:
    changes = compared(statement, "")
    assert {each.error for each in changes if each.change in ("worse", "fewer")} == errors
    assert all(each.change in ("same", "worse", "fewer", "slower") for each in changes)


@pytest.mark.parametrize(
    "line", ["copy := basicIoError;", "codes := codes + 1;", "IF innerBoardError THEN copy := TRUE; END_IF;"]
)
def test_a_harmless_line_changes_no_grade_of_what_is_handled(line: str) -> None:
    variables = "  any  : BOOL;\n"
    text = SAMPLE.files[FILE].replace(variables, f"{variables}  copy : BOOL; codes : INT;\n")
    text = text.replace("  hold := basicIoError;\n", f"  hold := basicIoError;\n  {line}\n")
    changes = compare(as_it_is(), swept(text))
    assert {each.error for each in changes if each.before != each.after} <= {"inner-board-error"}
    assert {each.after for each in changes if each.error == "inner-board-error"} <= {"no_effect", "stored"}
    assert {each.change for each in changes} <= {"same", "better"}
