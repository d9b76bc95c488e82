"""The history of one PLC over several versions of its program, with what is known of reactions."""

import sys
from dataclasses import replace
from datetime import UTC, datetime
from types import FrameType

import pytest

from scanbench.faults.acknowledge import Acknowledge, Acknowledged
from scanbench.faults.history import ErrorRow, History, RowReaction, Swept, worst
from scanbench.faults.inject import Generate, Recover
from scanbench.faults.present import Active, Raised, Way
from scanbench.faults.reaction.reaction import Reaction
from scanbench.faults.reference import ErrorRef
from scanbench.plcmodel.hardware import Fitted
from scanbench.runtime.command import Command, Entry, Plan, Swapped
from scanbench.runtime.write import Write
from tests.runtime.bench import model

REACTED = Reaction("reacted", 200, 1, 2)
_second = 0


def entry(command: Command, scan: int, effect: Swapped | None = None) -> Entry:
    global _second
    _second += 1
    at = datetime(2026, 11, 21, 12, _second // 60 % 60, _second % 60, tzinfo=UTC)
    return Entry(scan, at, command, Plan((), "", effect))


def raise_(history: History, *ids: str, scan: int = 1, by: str = "Ada") -> list[ErrorRow]:
    return history.fold(entry(Generate(by, tuple(ErrorRef(id) for id in ids)), scan))


def swap(history: History, version: int, fresh: bool = False, scan: int = 1) -> list[ErrorRow]:
    return history.fold(entry(Write("Ada", "any", "1"), scan, Swapped(version, fresh)))


def row(history: History, id: str) -> ErrorRow:
    return next(each for each in history.rows if each.id == id)


def test_a_new_version_begins_with_rows_of_its_own() -> None:
    history = History(model(), 1)
    raise_(history, "battery-error")
    history.fold(entry(Recover("Ada", ("battery-error",)), 5))
    assert row(history, "battery-error").program_version == 1
    assert swap(history, 2) == []
    assert history.version == 2
    assert {each.status for each in history.rows} == {"never"}
    assert {each.program_version for each in history.rows} == {2}
    old = {each.id: each for each in history.rows_of(1, model())}
    assert (old["battery-error"].status, old["battery-error"].count) == ("cleared", 1)
    assert history.versions == [1, 2]


def test_a_row_has_the_code_of_its_instance_before_it_is_raised() -> None:
    fitted = (Fitted("special-io-unit", 5), Fitted("fal", 41))
    rows = History(replace(model(), fitted=fitted), 1).rows
    codes = {each.key: each.code for each in rows if each.id in ("special-io-unit-error", "fal", "fals")}
    assert codes == {"special-io-unit-error:unit=5": "0305", "fal:number=41": "4129", "fals": "C100"}


def test_what_is_present_is_present_in_the_new_version_too() -> None:
    history = History(model(), 1)
    raise_(history, "battery-error", scan=7, by="Bob")
    assert history.set_reaction("battery-error", 1, 7, REACTED) is not None
    (carried,) = swap(history, 2)
    assert (carried.status, carried.by, carried.generated_scan, carried.count) == ("generated", "Bob", 7, 1)
    assert carried.reaction is None  # nobody compared how this version reacts
    history.fold(entry(Recover("Ada", None), 9))
    assert row(history, "battery-error").status == "cleared"
    old = {each.id: each for each in history.rows_of(1, model())}
    assert old["battery-error"].status == "generated"  # so it was when version 1 ended


@pytest.mark.parametrize("way", ["simulator", "tool", "program"])
def test_who_took_an_error_back_and_how(way: Way) -> None:
    history = History(model(), 1)
    raise_(history, "battery-error")
    history.fold(entry(Recover("Ada", None, way=way), 9))
    gone = row(history, "battery-error")
    assert (gone.status, gone.recovered_by, gone.recovered_way) == ("cleared", "Ada", way)
    raise_(history, "battery-error", scan=10)
    again = row(history, "battery-error")
    assert (again.status, again.recovered_by, again.recovered_way) == ("generated", "", None)


def test_who_acknowledged_an_error_is_known_until_it_is_raised_again() -> None:
    history = History(model(), 1)
    assert history.fold(entry(Acknowledge("Ada", "battery-error", ""), 2)) == []
    raise_(history, "battery-error", scan=3)
    (seen,) = history.fold(entry(Acknowledge("Ada", "battery-error", "a new one comes"), 5))
    assert isinstance(seen.acknowledged, Acknowledged)
    assert (seen.acknowledged.by, seen.acknowledged.scan, seen.acknowledged.remark) == ("Ada", 5, "a new one comes")
    history.fold(entry(Recover("Ada", None), 9))
    assert row(history, "battery-error").acknowledged == seen.acknowledged
    then = {scan: history.as_of({}, scan) for scan in (5, 6)}
    found = {scan: next(each for each in rows if each.id == "battery-error") for scan, rows in then.items()}
    assert (found[5].acknowledged, found[6].acknowledged) == (None, seen.acknowledged)
    raise_(history, "battery-error", scan=10)
    assert row(history, "battery-error").acknowledged is None


def test_a_program_that_starts_fresh_has_no_errors() -> None:
    history = History(model(), 1)
    raise_(history, "battery-error")
    (ended,) = swap(history, 2, fresh=True, scan=9)
    assert (ended.program_version, ended.status, ended.recovered_scan) == (1, "cleared", 9)
    assert (ended.recovered_by, ended.recovered_way) == ("", None)  # nobody took it back
    assert {each.status for each in history.rows} == {"never"}


def test_back_to_a_version_that_ran_before() -> None:
    history = History(model(), 1)
    raise_(history, "battery-error")
    swap(history, 2)
    history.fold(entry(Recover("Ada", None), 9))
    (cleared,) = swap(history, 1, scan=12)
    assert (cleared.id, cleared.program_version, cleared.status, cleared.recovered_scan) == (
        "battery-error", 1, "cleared", 12,
    )  # fmt: skip
    raise_(history, "battery-error", scan=13)
    assert row(history, "battery-error").count == 2
    swap(history, 2)
    assert row(history, "battery-error").count == 2  # once carried over, once again
    assert swap(history, 1) == []  # the same generation is counted once
    assert row(history, "battery-error").count == 2


def test_reactions_belong_to_one_generation() -> None:
    history = History(model(), 1)
    (first,) = raise_(history, "battery-error", scan=7)
    assert first.reaction == RowReaction("recording", scan=7)
    raise_(history, "battery-error", scan=9)
    assert history.set_reaction("battery-error", 1, 7, REACTED) is None  # raised again since
    assert row(history, "battery-error").reaction == RowReaction("recording", scan=9)
    done = history.set_reaction("battery-error", 1, 9, REACTED)
    assert done is not None
    assert done.reaction == RowReaction("done", REACTED, scan=9)
    assert (done.reaction.verdict, done.reaction.scans) == ("reacted", 2)
    failed = history.set_reaction("battery-error", 1, 9, "it died")
    assert failed is not None
    assert failed.reaction == RowReaction("failed", None, "it died", 9)
    assert history.set_reaction("battery-error", 4, 9, REACTED) is None
    assert history.set_reaction("fal", 1, 9, REACTED) is None


def test_what_the_plc_finds_itself_has_no_reaction() -> None:
    history = History(model(), 1)
    raise_(history, "cycle-time-over", scan=7)
    found = Generate("PLC", (ErrorRef("cycle-time-over"),), "plc")
    (changed,) = history.fold(entry(found, 9))
    assert (changed.origin, changed.reaction) == ("plc", None)


def test_rows_are_kept_over_a_restart() -> None:
    before = History(model(), 1)
    raise_(before, "battery-error")
    swap(before, 2)
    raise_(before, "fal")
    kept = [each for version in (1, 2) for each in before.rows_of(version, model()) if each.status != "never"]
    after = History(model(), 2, kept)
    assert after.rows == before.rows
    assert after.rows_of(1, model()) == before.rows_of(1, model())
    present = {"battery-error": Active((Raised(ErrorRef("battery-error"), "Ada", 1, "simulator"),))}
    (gone,) = after.reconcile(present, datetime(2026, 11, 21, 13, tzinfo=UTC))
    assert (gone.id, gone.status) == ("fal", "cleared")


def test_the_past_may_be_of_a_different_version() -> None:
    history = History(model(), 1)
    raise_(history, "battery-error")
    swap(history, 2)
    raise_(history, "fal")
    then = {each.id: each for each in history.as_of({}, 1000, 1)}
    assert (then["battery-error"].status, then["fal"].status) == ("cleared", "never")
    assert row(history, "fal").status == "generated"  # nothing was changed


def test_the_past_has_the_times_of_when_it_happened() -> None:
    history = History(model(), 1)
    raise_(history, "battery-error", scan=10)
    once = row(history, "battery-error")
    history.fold(entry(Recover("Ada", ("battery-error",)), 20))
    present = {"battery-error": Active((Raised(ErrorRef("battery-error"), once.by or "", 10, "simulator"),))}
    at = {
        scan: {each.id: each for each in history.as_of(there, scan)}
        for scan, there in ((5, {}), (15, present), (25, {}))
    }
    assert at[5]["battery-error"].status == "never", "it had not been raised"
    assert at[15]["battery-error"] == once
    assert at[25]["battery-error"] == row(history, "battery-error")
    raise_(history, "battery-error", scan=30)
    again = {each.id: each for each in history.as_of(present, 15)}["battery-error"]
    assert (again.status, again.generated_scan, again.generated_at) == ("generated", 10, None), (
        "when is not known any more"
    )
    between = {each.id: each for each in history.as_of({}, 25)}["battery-error"]
    assert (between.status, between.generated_at, between.recovered_at) == ("cleared", None, None)


def test_what_is_not_as_required_is_the_worst_that_a_sweep_found() -> None:
    found = worst([("a", Swept("acted", 1, unmet=1)), ("a", Swept("never_read", None)), ("b", Swept("acted", 1))])
    assert found == {"a": Swept("acted", 1, unmet=1), "b": Swept("acted", 1)}


def calls_of(numbers: int) -> int:
    """Function calls to read the rows of a project with so many FAL numbers, all of them swept."""
    fitted = tuple(Fitted("fal", number, name=f"text {number}") for number in range(1, numbers + 1))
    history = History(replace(model(), fitted=fitted), 1)
    calls = 0

    def count(frame: FrameType, event: str, argument: object) -> None:
        nonlocal calls
        calls += event == "call"

    before = sys.getprofile()
    sys.setprofile(count)
    try:
        history.take_sweeps({1: {f"fal:number={each.number}": Swept("acted", each.number) for each in fitted}})
        rows = [history.with_sweep(row) for row in history.rows]
    finally:
        sys.setprofile(before)
    told = [(row.key, row.label, row.fitted, row.swept) for row in rows if row.id == "fal"]
    assert told == [(f"fal:number={n}", f"text {n}", True, Swept("acted", n)) for n in range(1, numbers + 1)]
    return calls


def test_reading_the_rows_takes_as_long_as_there_are_rows() -> None:
    none, some, more = map(calls_of, (1, 101, 301))
    assert more - none < 4 * (some - none)
