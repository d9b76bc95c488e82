"""Sweeps: every error from every point; two sweeps side by side; what is said of them."""

from collections.abc import Iterable
from dataclasses import replace
from xml.etree import ElementTree

import pytest
from lxml import etree

from scanbench.engines.observe import MakeObserved
from scanbench.faults.inject import Generate
from scanbench.faults.reaction.compare import Change, Outcome, SweepChange, compare, judged
from scanbench.faults.reaction.reaction import OutputRestart, Reaction, Verdict, went_on
from scanbench.faults.reaction.sweep import Cell, sweep
from scanbench.faults.reference import ErrorRef
from scanbench.reports.sweep_page import sweep_page
from scanbench.reports.sweep_report import (
    SweepResult,
    outcomes_in,
    reason,
    sweep_json,
    sweep_junit,
    sweep_text,
)
from scanbench.runtime.command import Entry
from scanbench.runtime.write import Write
from tests.faults.reacting import MAKES, attempt, checked, point_of, programs, ref, standing
from tests.faults.test_react import HANDLERS
from tests.runtime.bench import model

ERRORS = ("battery-error", "basic-io-error", "inner-board-error", "memory-error")
GATED = """
PROGRAM Main
VAR battery AT A402.04 : BOOL; lamp AT CIO 100.00 : BOOL; on : BOOL; n : INT; END_VAR
  n := n + 1;
  IF on THEN lamp := battery; END_IF;
END_PROGRAM
"""


def refs(errors: Iterable[str]) -> list[ErrorRef]:
    return [ErrorRef(each) for each in errors]


def swept(done: tuple[tuple[str, str], ...] = ()) -> list[Cell]:
    """From two states: lamp handler off, lamp handler on."""
    program, make = checked({"main.st": GATED}), MAKES["native"]
    live = standing(program, make)
    off = point_of(live)
    assert isinstance(live.submit(Write("Ada", "Main.on", "TRUE")), Entry)
    live.run(5)
    points = {"Off": off, "On": point_of(live)}
    return list(sweep(points, refs(ERRORS[:2]), 30, programs(program, make), done))


def test_every_error_from_every_point_in_order() -> None:
    cells = swept()
    assert [(each.error, each.point) for each in cells] == [
        ("battery-error", "Off"), ("battery-error", "On"), ("basic-io-error", "Off"), ("basic-io-error", "On"),
    ]  # fmt: skip
    verdicts = [each.reaction.verdict for each in cells if each.reaction is not None]
    assert verdicts == ["not_reached", "acted", "never_read", "never_read"]


def test_what_is_done_is_not_done_again() -> None:
    left = swept((("battery-error", "Off"), ("basic-io-error", "On")))
    assert left == [swept()[1], swept()[2]]


@pytest.mark.parametrize("make", MAKES.values(), ids=MAKES.keys())
def test_a_sweep_says_what_a_reaction_says(make: MakeObserved) -> None:
    """The twin that all errors share is the one that each would have had."""
    program = checked({"main.st": HANDLERS})
    point = point_of(standing(program, make))
    errors = [each.id for each in model().errors()]
    for cell in sweep({"here": point}, refs(errors), 40, programs(program, make)):
        assert cell.reaction == attempt(program, (cell.error,), make, 40), cell.error


def test_an_error_that_is_there_already_is_said_so() -> None:
    program, make = checked({"main.st": GATED}), MAKES["native"]
    live = standing(program, make)
    assert isinstance(live.submit(Generate("Ada", (ref("battery-error"),))), Entry)
    cells = list(sweep({"here": point_of(live)}, refs(ERRORS[:2]), 10, programs(program, make)))
    assert cells[0].reaction is None
    assert cells[0].note == "battery-error is present in this state already"
    note = "battery-error was present before: what follows from both is no difference"
    assert cells[1].reaction == Reaction("never_read", 10, note=note, basis="exact")


# ---- two sweeps ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("before", "after", "kind"),
    [
        (("never_read", None), ("no_effect", None), "better"),
        (("never_read", None), ("not_reached", None), "better"),
        (("no_effect", None), ("stored", None), "better"),
        (("stored", None), ("displayed", None), "better"),
        (("displayed", None), ("decided", None), "better"),
        (("decided", None), ("acted", 3), "better"),
        (("acted", 3), ("displayed", None), "worse"),
        (("no_effect", None), ("reacted", 3), "better"),
        (("reacted", 3), ("never_read", None), "worse"),
        (("reacted", 3), ("reacted", 5), "slower"),
        (("reacted", 5), ("reacted", 3), "faster"),
        (("reacted", 3), ("reacted", 3), "same"),
        (("stopped", None), ("stopped", None), "same"),
        (("reacted", 3), ("acted", 3), "same"),  # of before there were grades
        (("reacted", 3), ("decided", None), "same"),
        (("stored_only", None), ("displayed", None), "same"),
        (("stored_only", None), ("acted", 3), "better"),
        (("reacted", 3), ("stored", None), "worse"),
        ((None, None), ("stopped", None), "better"),
        (("no_effect", None), (None, None), "worse"),
        ((None, None), (None, None), "same"),
    ],
)
def test_what_became_of_a_cell(
    before: tuple[Verdict | None, int | None], after: tuple[Verdict | None, int | None], kind: Change
) -> None:
    (change,) = compare([Outcome("e", "s", *before)], [Outcome("e", "s", *after)])
    assert change == SweepChange("e", "s", before[0], after[0], before[1], after[1], kind)


@pytest.mark.parametrize(
    ("outputs", "others", "kind", "lost"),
    [
        (("motor",), ("count",), "same", ()),
        (("motor", "lamp"), ("count", "more"), "same", ()),
        ((), ("count",), "worse", ("motor",)),
        (("motor",), (), "fewer", ("count",)),
        ((), (), "worse", ("motor", "count")),
        (None, None, "same", ()),
    ],
)
def test_what_differs_no_longer_is_named(
    outputs: tuple[str, ...] | None, others: tuple[str, ...] | None, kind: Change, lost: tuple[str, ...]
) -> None:
    old = Outcome("e", "s", "acted", 1, frozenset({"motor"}), frozenset({"count"}))
    known = [None if each is None else frozenset(each) for each in (outputs, others)]
    (change,) = compare([old], [Outcome("e", "s", "acted", 1, known[0], known[1])])
    assert (change.change, change.lost) == (kind, lost)


@pytest.mark.parametrize(
    ("before", "after", "kind", "unmet"),
    [
        ({"motor off": True}, {"motor off": False}, "worse", ("motor off",)),
        ({"motor off": False}, {"motor off": True}, "better", ()),
        ({"motor off": False, "lamp": True}, {"motor off": True, "lamp": False}, "worse", ("lamp",)),
        ({}, {"motor off": False}, "same", ()),  # nobody asked before
        ({"motor off": True}, {}, "same", ()),
    ],
)
def test_what_is_not_as_required_any_more_is_worse(
    before: dict[str, bool], after: dict[str, bool], kind: Change, unmet: tuple[str, ...]
) -> None:
    old, new = (Outcome("e", "s", "acted", 1, required=each) for each in (before, after))
    (change,) = compare([old], [new])
    assert (change.change, change.unmet) == (kind, unmet)


def test_an_output_that_goes_on_again_by_itself_is_looked_at_after_a_recovery_only() -> None:
    on = OutputRestart("motor", 3)
    assert judged([], [on], 30, ["motor", "fan"]) == {went_on("motor"): False, went_on("fan"): True}
    assert judged([], [], 0, ["motor"]) == {}


def test_what_only_one_sweep_has() -> None:
    changes = compare(
        [Outcome("a", "s", "reacted", 1), Outcome("b", "s", "stopped", None)], [Outcome("c", "s", "never_read", None)]
    )
    assert [(each.error, each.change) for each in changes] == [("c", "new"), ("a", "gone"), ("b", "gone")]


# ---- reports -------------------------------------------------------------------------------------------------------


def result() -> SweepResult:
    program, make = checked({"main.st": HANDLERS}), MAKES["native"]
    cells = tuple(sweep({"Here": point_of(standing(program, make))}, refs(ERRORS), 30, programs(program, make)))
    known = tuple(each for id in ERRORS for each in model().errors() if each.id == id)
    return SweepResult("line & co", "CJ1M-CPU63", 30, (("Here", 10),), known, cells)


def test_unhandled_errors_are_those_of_the_severity_asked_for() -> None:
    assert [each.error for each in result().unhandled(("nonfatal",))] == ["battery-error", "inner-board-error"]
    assert result().unhandled(("fatal",)) == ()


def test_json_is_read_again_and_names_readers_and_variables() -> None:
    told = sweep_json(result())
    results = told["results"]
    assert isinstance(results, list)
    basic = results[1]
    assert (basic["verdict"], basic["scans"], basic["severity"], basic["code"]) == ("acted", 1, "nonfatal", "009A")
    assert basic["readers"] == ["main.st:16"]
    assert [each["path"] for each in basic["differences"]] == ["Main.lamp", "Main.trips"]
    assert basic["handler_lines"] == ["main.st:17", "main.st:18"]
    assert told["counts"] == {"acted": 1, "no_effect": 1, "never_read": 1, "stopped": 1}
    verdicts = [each.verdict for each in outcomes_in(told)]
    assert verdicts == ["never_read", "acted", "no_effect", "stopped"]


def test_a_cell_has_the_code_of_its_details() -> None:
    unit = "special-io-unit-error"
    entry = next(each for each in model().errors() if each.id == unit)
    cells = tuple(Cell(error, "Here", Reaction("never_read", 30)) for error in (unit, f"{unit}:unit=5"))
    made = SweepResult("line", "CJ1M-CPU63", 30, (("Here", 10),), (entry,), cells)
    results = sweep_json(made)["results"]
    assert isinstance(results, list)
    assert [each["code"] for each in results] == ["0300", "0305"]
    assert f"{unit}:unit=5  0305 " in "\n".join(sweep_text(made))
    assert f'name="{unit}:unit=5 (0305)"' in sweep_junit(made, ("nonfatal",))
    assert sweep_page(made, "today").count("<code>0305</code>") == 1


@pytest.mark.parametrize(
    ("told", "why"),
    [
        ([], "is not a sweep's JSON"),
        ({"results": 3}, "is not a sweep's JSON"),
        ({"results": [], "format": 9}, "format 9"),
        ({"results": [3], "format": 1}, "no object"),
        ({"results": [{"id": "a"}], "format": 1}, "no `id` and `state`"),
        ({"results": [{"id": "a", "state": "s", "verdict": "fine"}], "format": 1}, "'fine'"),
        ({"results": [{"id": "a", "state": "s", "verdict": None, "scans": "x"}], "format": 1}, "'x'"),
    ],
)
def test_what_is_no_sweep_is_refused(told: object, why: str) -> None:
    with pytest.raises(ValueError, match=why):
        outcomes_in(told)


def test_junit_fails_where_an_error_is_unhandled() -> None:
    suite = ElementTree.fromstring(sweep_junit(result(), ("nonfatal",)))
    failed = [case.get("name") for case in suite.iter("testcase") if case.find("failure") is not None]
    assert failed == ["battery-error (00F7)", "inner-board-error (02F0)"]
    assert (suite.get("tests"), suite.get("failures"), suite.get("skipped")) == ("4", "2", "0")


def test_the_page_needs_no_other_files() -> None:
    page = sweep_page(result(), "2026-01-01")
    assert "line &amp; co" in page
    assert "main.st:16" in page
    for loads in ("<script", "http://", "https://", "<img", "<link", "url("):
        assert loads not in page
    assert page.count("never read") >= 2


def test_every_cell_of_the_page_leads_to_what_was_found() -> None:
    """But for those in which the PLC stopped: of these there is no more to say."""
    known = result()
    page = etree.fromstring(sweep_page(known, "2026-01-01"), etree.HTMLParser())
    links = [str(each.get("href")) for each in page.iterfind(".//td/a")]
    ids = [str(each.get("id")) for each in page.iter(etree.Element) if each.get("id")]
    assert links == [f"#{error}/Here" for error in ERRORS[:3]]
    assert sorted(ids) == sorted(link.removeprefix("#") for link in links)
    twice = replace(known, states=(("A B", 1), ("A_B", 2)), cells=tuple(
        replace(cell, point=point) for cell in known.cells for point in ("A B", "A_B")
    ))  # fmt: skip
    page = etree.fromstring(sweep_page(twice, "2026-01-01"), etree.HTMLParser())
    ids = [str(each.get("id")) for each in page.iter(etree.Element) if each.get("id")]
    assert len(set(ids)) == len(ids) == 6


def test_names_stay_what_they_are_in_junit() -> None:
    """An ideographic space is no printable character for Python, but one of every name in Japanese."""
    known = result()
    text = "異常　状態\x07"
    cells = tuple(Cell(cell.error, text, None, text) for cell in known.cells)
    suite = ElementTree.fromstring(sweep_junit(replace(known, project=text, cells=cells), ("nonfatal",)))
    (name,) = {case.get("classname") for case in suite.iter("testcase")}
    (note,) = {case.get("message") for case in suite.iter("skipped")}
    assert (name, note) == ("CJ1M-CPU63.異常　状態\ufffd", "異常　状態\ufffd")


def test_the_table_has_a_line_for_each_error() -> None:
    text = sweep_text(result())
    (basic,) = (each.split() for each in text if each.startswith("basic-io-error"))
    assert basic[1:7] == ["009A", "nonfatal", "Here", "acted", "1", "read"]
    assert text[-1] == "1 acted, 1 read, no effect, 1 never read, 1 PLC stopped"


def test_a_reason_for_every_verdict() -> None:
    for cell in result().cells:
        assert reason(cell)
    assert reason(Cell("e", "s", None, "already there")) == "already there"
