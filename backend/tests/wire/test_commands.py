"""Commands by name out of plain values, and values that do not fit their annotations."""

from dataclasses import dataclass, fields
from datetime import UTC, datetime

import pytest

from scanbench.faults.arm import Arm
from scanbench.faults.clear import ClearErrors
from scanbench.faults.disturb.definition import Disturbance
from scanbench.faults.disturb.disturb import Disturb
from scanbench.faults.inject import Generate
from scanbench.faults.reference import ErrorRef
from scanbench.faults.shapes import Shape, Start, Wanted
from scanbench.runtime.command import Entry, Plan
from scanbench.runtime.restart import Restart
from scanbench.runtime.write import Write
from scanbench.typed import BadValue, check, make
from scanbench.wire.codec import ENTRIES, BadMessage, pack_body, unpack
from scanbench.wire.commands import COMMANDS, read_command
from scanbench.wire.host import Sources
from scanbench.wire.refused import Refused


def test_commands_are_made_of_plain_values() -> None:
    assert read_command("write", {"path": "Main.n", "value": "7"}, "ada") == Write("ada", "Main.n", "7")
    errors = [{"id": "io-bus-error", "details": {"rack": "1", "slot": "3"}}]
    refs = (ErrorRef("io-bus-error", (("rack", "1"), ("slot", "3"))),)
    assert read_command("generate", {"errors": errors, "again": True}, "ada") == Generate("ada", refs, again=True)
    arm = {"errors": errors, "start": {"kind": "scan", "scan": 9}, "shape": {"kind": "for", "scans": 5}, "gap": 0}
    assert read_command("arm", arm, "ada") == Arm("ada", Wanted(refs, Start("scan", 9), Shape("for", 5)))
    assert read_command("disturb", {"kind": "late", "probability": 1}, "ada") == Disturb(
        "ada", Disturbance("late", probability=1)
    )
    assert read_command("clear_errors", {"what": 247}, "ada") == ClearErrors("ada", 247)


@pytest.mark.parametrize(
    ("name", "given", "said"),
    [
        ("burn", {}, "there is no command burn"),
        ("write", {"path": "Main.n"}, "value is missing"),
        ("write", {"path": "Main.n", "value": 7}, "value must be a text, not 7"),
        ("write", {"path": "Main.n", "value": "7", "through": "x"}, "through is unknown; write has path, value, site"),
        ("generate", {"errors": [{"id": "x", "detail": {}}]}, "errors: detail is unknown; there are id, details"),
        ("generate", {"errors": "x"}, "errors must be a list of objects, not 'x'"),
        ("restart", {"kind": "hot"}, "kind must be one of cold, warm, power, not 'hot'"),
        ("recover", {"ids": [1]}, "ids must be a text, not 1"),
        ("clear_errors", {"what": "some"}, "what must be one of current, all, not 'some'"),
        (
            "arm",
            {"errors": [], "start": {"kind": "scan", "scan": "9"}},
            "wanted: start: scan must be a whole number, not '9'",
        ),
    ],
)
def test_what_does_not_fit_is_refused_by_its_field(name: str, given: dict[str, object], said: str) -> None:
    with pytest.raises(Refused) as told:
        read_command(name, given, "ada")
    assert str(told.value).startswith(said)


def test_every_command_of_the_registry_has_the_fields_that_may_be_given() -> None:
    for known in COMMANDS.values():
        assert set(known.fields) <= {each.name for each in fields(known.cls)}


def test_an_entry_whose_values_are_of_another_type_is_no_entry() -> None:
    entry = Entry(1, datetime(2026, 1, 1, tzinfo=UTC), Restart("ada", "cold"), Plan((), "restarted"))
    assert ENTRIES.unpack(ENTRIES.pack(entry)) == entry
    for bad in (Restart("ada", "hot"), Restart(3, "cold"), Write("ada", "Main.n", 7)):  # type: ignore[arg-type]
        with pytest.raises(BadMessage):
            unpack(pack_body(bad))
    with pytest.raises(BadMessage):
        unpack(pack_body(Sources("M", {"a.st": 1}, 1, 1)))  # type: ignore[dict-item]


def test_numbers_of_one_kind_pass_for_another_where_python_lets_them() -> None:
    @dataclass(frozen=True)
    class Measured:
        speed: float
        count: int | None = None

    check(Measured, (1,))
    check(Measured, (1.5, True))
    assert make(Measured, {"speed": 2}) == Measured(2)
    with pytest.raises(BadValue):
        check(Measured, (1.5, 2, 3))
    with pytest.raises(BadValue):
        check(Measured, ("fast",))
