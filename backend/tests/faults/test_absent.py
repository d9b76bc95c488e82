"""A batch of which some errors are present: those are skipped. And which error of several the code word shows."""

import pytest

from scanbench.check.build import check_sources
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.faults.absent import GenerateAbsent
from scanbench.faults.inject import ACTIVE, Generate
from scanbench.faults.reference import ErrorRef
from scanbench.runtime.command import Entry, Refusal
from scanbench.runtime.programs import Loaded
from scanbench.runtime.resource import Resource
from tests.runtime.bench import model, program, value

BATTERY, SETUP, MEMORY = ErrorRef("battery-error"), ErrorRef("plc-setup-error"), ErrorRef("memory-error")
SOURCE = "PROGRAM Main\nVAR n : DINT; END_VAR\n  n := n + 1;\nEND_PROGRAM\n"
OWN = """<UserErrors><ErrorGroup><Name>Own</Name>
<Error Id="own" ErrorCode="1234" ErrorFlag="W10.00" Severity="{severity}" Priority="1"><Name>Own</Name></Error>
</ErrorGroup></UserErrors>"""


def plc() -> Resource:
    return Resource(Loaded.make(program(SOURCE), ReferenceEngine))


def ids_of(resource: Resource) -> list[str]:
    """The errors that are present."""
    present = resource.journal.derived(ACTIVE)
    return list(present)


def test_what_is_present_stays_and_the_others_come() -> None:
    resource = plc()
    resource.submit(Generate("Ada", (BATTERY,)))
    assert isinstance(resource.submit(Generate("Bob", (BATTERY, SETUP))), Refusal)
    entry = resource.submit(GenerateAbsent("Bob", (BATTERY, SETUP)))
    assert isinstance(entry, Entry)
    assert entry.command == Generate("Bob", (SETUP,))
    present = resource.journal.derived(ACTIVE)
    assert {id: each.by for id, each in present.items()} == {"battery-error": "Ada", "plc-setup-error": "Bob"}


def test_nothing_is_left() -> None:
    resource = plc()
    resource.submit(Generate("Ada", (BATTERY,)))
    entry = resource.submit(GenerateAbsent("Bob", (BATTERY,)))
    assert isinstance(entry, Entry)
    assert entry.plan.message == "nothing to generate: all of these errors are present already"
    assert not entry.plan.patches


def test_what_is_wrong_with_one_is_told_and_none_comes() -> None:
    resource = plc()
    resource.submit(Generate("Ada", (BATTERY,)))
    refused = resource.submit(GenerateAbsent("Bob", (BATTERY, ErrorRef("batery-error"), SETUP)))
    assert isinstance(refused, Refusal)
    assert "batery-error" in refused.message
    assert ids_of(resource) == ["battery-error"]


@pytest.mark.parametrize(("severity", "others", "shown"), [
    ("nonfatal", (MEMORY,), 0x80F1 + 1), ("fatal", (MEMORY,), 0x80F1 + 1), ("fatal", (BATTERY,), 0x1234), ("nonfatal", (BATTERY,), 0x1234),
])  # fmt: skip
def test_an_error_of_a_project_ranks_below_a_fatal_one_of_the_device(
    severity: str, others: tuple[ErrorRef, ...], shown: int
) -> None:
    own = check_sources({"main.st": SOURCE, "errors.xml": OWN.format(severity=severity)}, model()).program
    assert own is not None
    resource = Resource(Loaded.make(own, ReferenceEngine))
    assert isinstance(resource.submit(Generate("Ada", (ErrorRef("own"), *others))), Entry)
    assert value(resource, "A400") == shown
