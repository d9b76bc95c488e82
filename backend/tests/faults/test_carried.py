"""Another program takes over while errors of the project are present: it must know them as they are."""

from pathlib import Path

import pytest

from scanbench.check.build import check_sources
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.faults.carried import why_not_carried
from scanbench.faults.inject import ACTIVE, Generate, Recover
from scanbench.faults.reference import ErrorRef
from scanbench.program.program import Program
from scanbench.runtime.command import Entry
from scanbench.runtime.programs import Loaded
from scanbench.runtime.resource import Resource
from tests.runtime.bench import model

GOOD = (Path(__file__).parents[1] / "plcmodel" / "broken_user_errors" / "GOOD.xml").read_text("utf-8")
MAIN = "PROGRAM Main\nVAR n : INT; END_VAR\nn := n + 1;\nEND_PROGRAM\n"


def program(errors: str | None) -> Program:
    files = {"main.st": MAIN} | ({} if errors is None else {"errors.xml": errors})
    checked = check_sources(files, model())
    assert checked.program is not None, checked.problems
    return checked.program


def running() -> Resource:
    resource = Resource(Loaded.make(program(GOOD), ReferenceEngine))
    own = ErrorRef("pump-hot", (("degrees", "120"), ("pump", "south")))
    assert isinstance(resource.submit(Generate("Ada", (own, ErrorRef("battery-error")))), Entry)
    return resource


@pytest.mark.parametrize(
    ("errors", "reason"),
    [
        (None, "pump-hot is generated, and the new program's catalogue does not have it: recover pump-hot first"),
        (GOOD.replace('"pump-hot"', '"other"'), "does not have it"),
        (GOOD.replace("W10.00", "W10.01"), "has it otherwise: recover pump-hot first"),
        (GOOD.replace("4101", "4201"), "has it otherwise"),
        (GOOD.replace("W12.04", "W12.05"), "has it otherwise"),
        (GOOD.replace('Max="200"', 'Max="100"'), "has it otherwise"),
        (GOOD.replace('Priority="300"', 'Priority="1"'), "has it otherwise"),
        (GOOD.replace("nonfatal", "fatal"), "has it otherwise"),
    ],
)
def test_what_is_present_stays_what_it_is(errors: str | None, reason: str) -> None:
    resource = running()
    why = why_not_carried(resource.journal.derived(ACTIVE), resource.program, program(errors))
    assert reason in why
    assert "battery-error" not in why  # the device's own are the same
    resource.submit(Recover("Ada", ("pump-hot",)))
    assert why_not_carried(resource.journal.derived(ACTIVE), resource.program, program(errors)) == ""


@pytest.mark.parametrize(
    "errors",
    [GOOD, GOOD.replace("Pump hot", "Pump too hot"), GOOD.replace("W12.03", "W12.02"), GOOD.replace('"90"', '"80"')],
)
def test_what_it_does_not_touch_may_change(errors: str) -> None:
    resource = running()
    assert why_not_carried(resource.journal.derived(ACTIVE), resource.program, program(errors)) == ""
