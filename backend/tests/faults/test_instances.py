"""Several instances of one kind of error: as the device has them, each raised, recovered and recorded by itself."""

from collections.abc import Callable

import pytest

from scanbench.faults.arm import Arm
from scanbench.faults.detect import Detection
from scanbench.faults.history import ErrorRow, History
from scanbench.faults.inject import ACTIVE, Generate, Recover, present_texts
from scanbench.faults.reaction.choices import Choices
from scanbench.faults.reference import ErrorRef, parse_reference
from scanbench.faults.shapes import Start, Wanted
from scanbench.runtime.command import Entry, Refusal
from scanbench.runtime.programs import EngineFactory, Loaded
from scanbench.runtime.resource import Resource
from scanbench.runtime.write import Write
from tests.faults.reacting import checked
from tests.runtime.bench import ENGINES, model, plc, value

SOURCE = """
PROGRAM Main
VAR n, first : INT; END_VAR
  n := n + 1;
  IF first <> 0 THEN FAL(first); END_IF;
END_PROGRAM
"""
SPECIAL = "special-io-unit-error"


def ref(text: str) -> ErrorRef:
    found = parse_reference(model(), text)
    assert isinstance(found, ErrorRef), found
    return found


def generate(resource: Resource, *texts: str, again: bool = False) -> Entry | Refusal:
    return resource.submit(Generate("Ada", tuple(map(ref, texts)), again=again))


def present(resource: Resource) -> tuple[str, ...]:
    return present_texts(resource.journal.derived(ACTIVE))


def history_of(resource: Resource) -> History:
    history = History(model())
    for entry in resource.journal:
        history.fold(entry)
    return history


def rows(resource: Resource, id: str) -> list[ErrorRow]:
    return [row for row in history_of(resource).rows if row.id == id]


@pytest.fixture(params=ENGINES)
def resource(request: pytest.FixtureRequest) -> Resource:
    engine: EngineFactory = request.param
    made = plc(SOURCE, engine)
    made.detect = Detection()
    return made


def test_a_unit_is_raised_beside_one_that_has_an_error_already(resource: Resource) -> None:
    for text in (f"{SPECIAL}:unit=3", f"{SPECIAL}:unit=20"):
        assert isinstance(generate(resource, text), Entry)
    assert present(resource) == (f"{SPECIAL}:unit=3", f"{SPECIAL}:unit=20")
    assert [value(resource, word) for word in ("A400", "A402", "A418", "A419")] == [0x0303, 1 << 6, 1 << 3, 1 << 4]
    assert (value(resource, "A100"), value(resource, "A105"), value(resource, "A300")) == (0x0303, 0x0314, 2)
    refused = generate(resource, f"{SPECIAL}:unit=3")
    assert isinstance(refused, Refusal)
    assert refused.near == (f"{SPECIAL}:unit=3",)


def test_what_the_program_raised_keeps_no_other_number_away(resource: Resource) -> None:
    resource.submit(Write("Ada", "Main.first", "7"))
    resource.run(3)
    assert isinstance(generate(resource, "fal:number=5"), Entry)
    assert [value(resource, word) for word in ("A400", "A360")] == [0x4105, 1 << 5 | 1 << 7]
    assert isinstance(generate(resource, "fal:number=7"), Refusal)
    assert [(row.key, row.origin) for row in rows(resource, "fal")] == [
        ("fal:number=5", "simulator"), ("fal:number=7", "program"),
    ]  # fmt: skip


def test_one_is_recovered_and_the_others_stay(resource: Resource) -> None:
    generate(resource, *(f"{SPECIAL}:unit={unit}" for unit in (0, 3, 17)), "battery-error")
    entry = resource.submit(Recover("Bob", (f"{SPECIAL}:unit=3",)))
    assert isinstance(entry, Entry)
    assert entry.plan.message == f"recovered {SPECIAL} (unit=3)"
    assert present(resource) == (f"{SPECIAL}:unit=0", f"{SPECIAL}:unit=17", "battery-error")
    assert [value(resource, word) for word in ("A400", "A402", "A418", "A419")] == [0x0300, 1 << 6 | 1 << 4, 1, 2]
    resource.submit(Recover("Bob", (f"{SPECIAL}:unit=0",)))
    assert value(resource, "A400") == 0x0311
    resource.submit(Recover("Bob", (SPECIAL,)))  # all that are left
    assert [value(resource, word) for word in ("A400", "A402", "A418", "A419")] == [0x00F7, 1 << 4, 0, 0]
    gone = resource.submit(Recover("Bob", (f"{SPECIAL}:unit=3",)))
    assert isinstance(gone, Refusal)
    assert gone.near == ("battery-error",)


def test_a_row_for_each_instance(resource: Resource) -> None:
    generate(resource, *(f"{SPECIAL}:unit={unit}" for unit in (7, 0, 3)))
    resource.submit(Recover("Bob", (f"{SPECIAL}:unit=3",)))
    generate(resource, f"{SPECIAL}:unit=7", again=True)
    assert [(row.key, row.status, row.code, row.details, row.count) for row in rows(resource, SPECIAL)] == [
        (f"{SPECIAL}:unit=0", "generated", "0300", "unit=0", 1),
        (f"{SPECIAL}:unit=3", "cleared", "0303", "unit=3", 1),
        (f"{SPECIAL}:unit=7", "generated", "0307", "unit=7", 2),
    ]
    (fal,) = rows(resource, "fal")
    assert (fal.key, fal.instance, fal.status) == ("fal", "", "never")


def test_a_kind_that_the_device_has_one_place_for_is_present_once(resource: Resource) -> None:
    generate(resource, "basic-io-error:rack=1,slot=3")
    assert isinstance(generate(resource, "basic-io-error:rack=0,slot=2"), Refusal)
    assert isinstance(generate(resource, "basic-io-error:rack=0,slot=2", again=True), Entry)
    assert value(resource, "A408") == 2
    assert [(row.key, row.status) for row in rows(resource, "basic-io-error")] == [
        ("basic-io-error:rack=0,slot=2", "generated"), ("basic-io-error:rack=1,slot=3", "cleared"),
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("text", "left"),
    [("io-bus-error:rack=1", 0), ("io-bus-error:rack=0", 1), ("duplicated-unit-number:unit=16#3", 2)],
)
def test_some_of_the_details_name_all_that_have_them(resource: Resource, text: str, left: int) -> None:
    generate(resource, "io-bus-error:rack=1,slot=3")
    assert isinstance(resource.submit(Recover("Bob", (text,))), Refusal) is bool(left)


def test_what_is_present_without_its_order_is_the_same(resource: Resource) -> None:
    """Rows of a run whose beginning nobody told."""
    generate(resource, *(f"{SPECIAL}:unit={unit}" for unit in (7, 3)), "battery-error")
    told, heard = history_of(resource), History(model())
    at = resource.journal[0].at
    heard.reconcile(resource.journal.derived(ACTIVE), at)
    key: Callable[[ErrorRow], str] = lambda row: row.key  # noqa: E731
    assert list(map(key, heard.rows)) == list(map(key, told.rows))
    resource.submit(Recover("Bob", (f"{SPECIAL}:unit=7",)))
    heard.reconcile(resource.journal.derived(ACTIVE), at)
    statuses = [(row.key, row.status) for row in heard.rows if row.id == SPECIAL]
    assert statuses == [(f"{SPECIAL}:unit=3", "generated"), (f"{SPECIAL}:unit=7", "cleared")]


# ---- with a hardware configuration -----------------------------------------------------------------------------------

HARDWARE = """{"version": 1, "fitted": [
{"kind": "special-io-unit", "number": 3, "name": "Analog inputs"},
{"kind": "special-io-unit", "number": 20},
{"kind": "fal", "number": 42, "name": "pump overpressure"}
]}"""


def equipped() -> Resource:
    made = checked({"main.st": SOURCE, "hardware.json": HARDWARE})
    return Resource(Loaded.make(made, ENGINES[0]))


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (f"{SPECIAL}:unit=4", f"{SPECIAL}:unit=4 is not fitted: hardware.json does not have it. Add it there, and build"),
        ("cpu-bus-unit-error:unit=0", "the device reports no such error of what is not there"),
        ("fal:number=7", "and by REST with anyway, it can be raised all the same"),
        ("special-io-unit-setting-error:unit=4", "it can be raised all the same"),
    ],
)  # fmt: skip
def test_what_is_not_fitted_is_refused_with_the_reason(text: str, words: str) -> None:
    resource = equipped()
    refused = generate(resource, text)
    assert isinstance(refused, Refusal)
    assert words in refused.message
    armed = resource.submit(Arm("Ada", Wanted((ref(text),), Start("scan", 50))))
    assert isinstance(armed, Refusal)
    raised = resource.submit(Generate("Ada", (ref(text),), anyway=True))
    assert isinstance(raised, Entry) is ("all the same" in words)
    if isinstance(raised, Entry):
        assert f"; hardware.json does not have {text}" in raised.plan.message


def test_rows_are_those_of_what_is_fitted() -> None:
    resource = equipped()
    history = History(resource.view.model)
    told = [
        (row.key, row.fitted, row.label)
        for row in history.rows
        if row.id in (SPECIAL, "fal", "fals", "cpu-bus-unit-error")
    ]
    assert told == [
        ("fals", False, ""), ("fal:number=42", True, "pump overpressure"), ("cpu-bus-unit-error", False, ""),
        (f"{SPECIAL}:unit=3", True, "Analog inputs"), (f"{SPECIAL}:unit=20", True, ""),
    ]  # fmt: skip
    entry = generate(resource, f"{SPECIAL}:unit=3")
    assert isinstance(entry, Entry)
    assert [(row.key, row.label, row.status) for row in history.fold(entry)] == [
        (f"{SPECIAL}:unit=3", "Analog inputs", "generated")
    ]


def test_a_sweep_asks_of_what_is_fitted() -> None:
    choices = Choices(equipped().program)
    assert [str(each) for id in (SPECIAL, "fal", "fals", "basic-io-error", "battery-error") for each in choices.of(id)] == [
        f"{SPECIAL}:unit=3", f"{SPECIAL}:unit=20", "fal:number=42", "battery-error",
    ]  # fmt: skip
