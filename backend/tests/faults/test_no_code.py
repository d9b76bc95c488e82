"""Errors for which the device has no code: ports. Code word, error flags and log stay as they are."""

import pytest

from scanbench.faults.clear import ClearErrors
from scanbench.faults.device import read_device
from scanbench.faults.history import History
from scanbench.faults.inject import ACTIVE, Generate, Recover
from scanbench.faults.preview import preview
from scanbench.faults.reaction.reaction import Reaction, Verdict
from scanbench.faults.reference import ErrorRef
from scanbench.runtime.command import Entry, Refusal, RestartKind
from scanbench.runtime.programs import EngineFactory
from scanbench.runtime.resource import Resource
from scanbench.runtime.restart import Restart
from tests.faults.reacting import MAKES, attempt, checked
from tests.runtime.bench import ENGINES, plc, value

SOURCE = """
PROGRAM Main
VAR failed AT A219.03 : BOOL; framing AT A528.03 : BOOL; seen, odd : INT; END_VAR
  IF failed THEN seen := seen + 1; END_IF;
  IF framing THEN odd := odd + 1; END_IF;
END_PROGRAM
"""
PORT, SERIAL = "communications-port-3-error", "rs-232c-port-error"


def raised(*refs: ErrorRef) -> Generate:
    return Generate("Ada", refs)


def with_errors(*refs: ErrorRef, engine: EngineFactory = ENGINES[0]) -> Resource:
    resource = plc(SOURCE, engine)
    resource.run(2)
    assert isinstance(resource.submit(raised(*refs)), Entry)
    resource.run(3)
    return resource


def ids(resource: Resource) -> list[str]:
    present = resource.journal.derived(ACTIVE)
    return list(present)


@pytest.mark.parametrize("engine", ENGINES)
def test_flag_and_completion_code_are_there_and_nothing_else(engine: EngineFactory) -> None:
    resource = with_errors(ErrorRef(PORT, (("completion-code", "0401"),)), engine=engine)
    assert (value(resource, "A219"), value(resource, "A206"), value(resource, "Main.seen")) == (8, 0x0401, 3)
    assert [value(resource, each) for each in ("A400", "A401", "A402", "A300", "A100")] == [0, 0, 0, 0, 0]
    assert resource.journal[-1].plan.message == f"generated {PORT} (completion-code=401), no code"
    resource.submit(Recover("Ada", None))
    assert (value(resource, "A219"), value(resource, "A206")) == (0, 0)


def test_the_kind_of_a_serial_error_is_a_bit_of_each_port() -> None:
    resource = with_errors(ErrorRef(SERIAL, (("kind", "framing"),)), ErrorRef("peripheral-port-error"))
    assert (value(resource, "A392"), value(resource, "A528"), value(resource, "Main.odd")) == (0x1010, 0x0408, 3)
    resource.submit(Recover("Ada", (SERIAL,)))
    assert (value(resource, "A392"), value(resource, "A528")) == (0x1000, 0x0400)


def test_beside_it_the_code_word_shows_the_error_that_has_one() -> None:
    resource = with_errors(ErrorRef(SERIAL), ErrorRef("battery-error"))
    assert (value(resource, "A400"), value(resource, "A300"), value(resource, "A100")) == (0x00F7, 1, 0x00F7)
    resource.submit(Recover("Ada", ("battery-error",)))
    assert (value(resource, "A400"), ids(resource)) == (0, [SERIAL])


def test_the_devices_way_to_clear_errors_does_not_know_it() -> None:
    resource = with_errors(ErrorRef(SERIAL), ErrorRef("fal"))
    resource.submit(ClearErrors("Bob", "all"))
    assert ids(resource) == [SERIAL]
    for command in (ClearErrors("Bob", "all"), ClearErrors("Bob", "current")):
        entry = resource.submit(command)
        assert isinstance(entry, Entry)
        assert entry.plan.message == "no error is present that the device clears: what is there has no code"
    assert isinstance(resource.submit(ClearErrors("Bob", 0)), Refusal)


@pytest.mark.parametrize("kind", ["cold", "warm", "power"])
def test_a_restart_leaves_nothing_of_it(kind: RestartKind) -> None:
    resource = with_errors(ErrorRef(SERIAL), ErrorRef(PORT))
    resource.submit(Restart("Bob", kind))
    assert ids(resource) == []
    assert [value(resource, each) for each in ("A392", "A528", "A219", "A206")] == [0, 0, 0, 0]


def test_what_will_be_written_is_told() -> None:
    resource = plc(SOURCE)
    told = preview(resource.view, [ErrorRef(PORT)], again=False)
    assert {each.address: (each.before, each.after) for each in told.writes} == {
        "A219.03": ("0", "1"), "A206": ("0000", "0205"), "A400": ("0000", "0000"),
    }  # fmt: skip


def test_the_devices_own_view_shows_it_without_a_code() -> None:
    shown = read_device(with_errors(ErrorRef(SERIAL), ErrorRef("fal")).view)
    assert [(each.id, each.code, each.top) for each in shown.errors] == [("fal", "4101", True), (SERIAL, "", False)]
    assert [each.text for each in shown.errors[1].details] == ["What failed: Parity error"]
    assert [each.code for each in shown.log] == ["4101"]


def test_its_row_of_the_history_has_no_code() -> None:
    resource = with_errors(ErrorRef(PORT, (("completion-code", "0401"),)))
    history = History(resource.program.layout.model, 1)
    history.fold(resource.journal[-1])
    row = next(each for each in history.rows if each.id == PORT)
    assert (row.status, row.code, row.details) == ("generated", "", "completion-code=401")


PROGRAMS: tuple[tuple[str, Verdict], ...] = (
    ("IF %A219.03 THEN %QX0.0 := TRUE; END_IF;", "acted"),
    ("%D100 := %A206;", "displayed"),
    ("IF %A400 <> 0 THEN %QX0.0 := TRUE; END_IF;", "never_read"),
    ("IF %A400 = 0 THEN n := 1; END_IF;", "never_read"),
    ("IF %A300 <> 0 THEN %QX0.0 := TRUE; END_IF;", "never_read"),
)


@pytest.mark.parametrize("make", MAKES)
@pytest.mark.parametrize(("body", "verdict"), PROGRAMS)
def test_only_who_reads_flag_or_detail_looks_at_it(body: str, verdict: Verdict, make: str) -> None:
    code = checked({"main.st": f"PROGRAM Main VAR n : INT; END_VAR {body} END_PROGRAM"})
    found = attempt(code, (PORT,), MAKES[make])
    assert isinstance(found, Reaction)
    assert found.verdict == verdict
