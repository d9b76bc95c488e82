"""Test records: made, written as CSV, XML and HTML, and read again."""

import csv
import io
from dataclasses import replace
from datetime import UTC, datetime, timedelta, timezone
from typing import get_args

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from lxml import etree

from scanbench.faults.history import ErrorRow, RowReaction
from scanbench.faults.reaction.reaction import (
    WORST_FIRST,
    Basis,
    Carried,
    Difference,
    Line,
    Obstacle,
    OutputRestart,
    Reaction,
    Reader,
    RequiredResult,
    Unreached,
    Verdict,
)
from scanbench.plcmodel.document import TOLD
from scanbench.reports.reaction_json import from_json, to_json
from scanbench.reports.record import (
    RecordAccepted,
    RecordCell,
    RecordError,
    RecordHead,
    RecordSweep,
    SweepStatus,
    TestRecord,
    make_record,
)
from scanbench.reports.record_csv import COLUMNS, to_csv
from scanbench.reports.record_html import to_html
from scanbench.reports.record_read import from_xml
from scanbench.reports.record_text import RecordLine, folded
from scanbench.reports.record_words import WORDS
from scanbench.reports.record_xml import to_xml
from tests.runtime.bench import model

NOON = datetime(2026, 11, 21, 12, 0, 0, 123456, tzinfo=UTC)
HEAD = RecordHead("conveyor", "CJ1M-CPU63", "line-1", 3, "ab" * 32, NOON, "Ada", "Scanbench 0.1")
REACTION = Reaction(
    "reacted", 200, 1, 2, (Reader("main.st", 12, "Main", "flag", 1), Reader("main.st", 12, "Main", "code", 2)),
    (Difference("Main.out", "TRUE", "FALSE", True, 2), Difference("Main.n", "1", "2", False, 3)), 17,
    (Line("main.st", 13),),
)  # fmt: skip


def made() -> TestRecord:
    rows = [
        ErrorRow(
            "battery-error", "x", "nonfatal", "cleared", "00F7", "", NOON, NOON + timedelta(seconds=5), 7, 9, "Ada",
            "simulator", 2, RowReaction("done", REACTION), 3,
        ),
        ErrorRow(
            "memory-error", "x", "fatal", "generated", "80F4", "location=io-table-checksum", NOON, None, 8, None,
            "=Bob", "simulator", 1, RowReaction("failed", None, "the run was made smaller"), 3,
        ),
    ]  # fmt: skip
    cells = (
        RecordCell("fal", "filled", "reacted", 3), RecordCell("fal", "empty", "never_read"),
        RecordCell("cycle-time-over", "filled", None, None, "it cannot be raised here"),
        RecordCell("of another catalogue", "filled", "reacted", 1),
    )  # fmt: skip
    sweep = RecordSweep(NOON, "Ada", "line-1", "done", 200, ("filled", "empty"), cells)
    accepted = [("fal", RecordAccepted("empty", "no <FAL> in this line & no other", "Eva", NOON))]
    log = [RecordLine(NOON, 7, "Ada", "generated battery-error, code 00F7")]
    return make_record(HEAD, model(), rows, sweeps=[sweep], accepted=accepted, log=log)


def find(record: TestRecord, id: str) -> RecordError:
    return next(error for error in record.errors if error.id == id)


def test_every_error_of_the_catalogue_has_a_row() -> None:
    record = made()
    assert [error.id for error in record.errors] == [error.id for error in model().errors()]
    battery = find(record, "battery-error")
    assert battery.reaction is not None
    assert [each.path for each in battery.reaction.differences] == ["Main.out"]  # outputs only
    assert battery.reaction.difference_count == 17
    assert battery.name == "Battery error"
    assert battery.group == "CPU nonfatal errors / CPU Unit"
    assert "of another catalogue" not in {cell.error for cell in record.sweeps[0].cells}


def test_the_verdict_is_the_plcs_own_or_the_worst_of_the_newest_sweep() -> None:
    record = made()
    assert record.finding(find(record, "battery-error")).where == "plc"
    fal = record.finding(find(record, "fal"))
    assert (fal.verdict, fal.where) == ("never_read", "sweep")
    assert record.finding(find(record, "memory-error")).verdict is None
    older = replace(
        record.sweeps[0], cells=(RecordCell("fal", "filled", "no_effect"), RecordCell("cpu-error", "filled", "stopped"))
    )
    both = replace(record, sweeps=(record.sweeps[0], older))
    assert both.finding(find(both, "fal")).verdict == "never_read"
    told = record.summary
    assert (told.errors, told.tested, told.generated) == (len(record.errors), 3, 1)
    assert (told.accepted, told.open) == (1, 0)
    assert told.verdicts == {
        **dict.fromkeys(get_args(Verdict), 0), "never_read": 1, "reacted": 1,
    }  # fmt: skip
    assert told.unknown == 1


def missed_in_two_states() -> TestRecord:
    """Accepted for one of them; the other one, of an older sweep, is open still."""
    cells = (RecordCell("fal", "Running", "never_read"), RecordCell("battery-error", "Running", "reacted", 3))
    newest = RecordSweep(NOON, "Ada", "line-1", "done", 200, ("Running",), cells)
    older = replace(newest, states=("Running", "Stopped"), cells=(
        RecordCell("fal", "Running", "reacted", 1), RecordCell("fal", "Stopped", "no_effect"),
    ))  # fmt: skip
    accepted = [("fal", RecordAccepted("Running", "not on this line", "Eva", NOON))]
    seen = Reaction("never_read", 200)
    row = ErrorRow(
        "basic-io-error", "x", "nonfatal", "cleared", "009A", "rack=2, slot=3", NOON, NOON, 7, 9, "Ada", "simulator", 1,
        RowReaction("done", seen), 3,
    )  # fmt: skip
    return make_record(HEAD, model(), [row], sweeps=[newest, older], accepted=accepted)


def test_a_finding_is_open_until_it_is_accepted_in_each_state() -> None:
    record = missed_in_two_states()
    found = {(each.error.id, each.state): (each.verdict, each.accepted is not None) for each in record.missed}
    assert found == {
        ("basic-io-error", ""): ("never_read", False),
        ("fal", "Stopped"): ("no_effect", False),
        ("fal", "Running"): ("never_read", True),
    }
    assert record.missed[-1].state == "Running"  # what is open comes first
    assert (record.summary.open, record.summary.accepted) == (2, 1)
    again = from_xml(to_xml(record))
    assert isinstance(again, TestRecord)
    assert again.missed == record.missed


def test_what_is_open_is_so_in_every_form() -> None:
    record = missed_in_two_states()
    page = etree.fromstring(to_html(record), etree.HTMLParser())
    tables = page.findall(".//table")
    rows = [[" ".join(map(str, cell.itertext())) for cell in row] for row in tables[0].findall("tbody/tr")]
    name = find(record, "fal").name
    assert [[row[0], *row[3:6]] for row in rows if row[0] == name] == [
        [name, "Stopped", "read, no effect", "open"], [name, "Running", "never read", "accepted"],
    ]  # fmt: skip
    assert [row[3] for row in rows if row[0] == find(record, "basic-io-error").name] == ["on the PLC itself"]
    matrix = {row[0].text: "".join(map(str, row[1].itertext())) for row in tables[2].findall("tbody/tr")}
    assert matrix[name] == "never readaccepted"
    assert "accepted" not in matrix["Battery error"]
    head, *lines = list(csv.reader(io.StringIO(to_csv(record).removeprefix("\ufeff"))))
    by_id = {line[1]: dict(zip(head, line, strict=True)) for line in lines}
    assert by_id["fal"]["open in"] == "Stopped"
    assert by_id["basic-io-error"]["open in"] == "on the PLC itself"
    assert by_id["battery-error"]["open in"] == ""
    cells = etree.fromstring(to_xml(record).encode()).findall("Sweep/Cell")
    assert [(cell.get("Error"), cell.get("State"), cell.get("Accepted")) for cell in cells] == [
        ("fal", "Running", "true"), ("battery-error", "Running", None), ("fal", "Running", None), ("fal", "Stopped", None),
    ]  # fmt: skip


def test_what_is_not_as_required_is_an_open_finding() -> None:
    cells = (
        RecordCell("fal", "Running", "acted", 1, required=2, unmet=2),
        RecordCell("fal", "Stopped", "never_read", unmet=1),
    )
    sweep = RecordSweep(NOON, "Ada", "line-1", "done", 200, ("Running", "Stopped"), cells)
    accepted = [("fal", RecordAccepted(state, "not on this line", "Eva", NOON)) for state in ("Running", "Stopped")]
    seen = Reaction(
        "acted", 200, required=(RequiredResult("motor = FALSE", 2, "failed"),), restarts=(OutputRestart("motor", 1),)
    )
    row = ErrorRow(
        "battery-error", "x", "nonfatal", "cleared", "00F7", "", NOON, NOON, 7, 9, "Ada", "simulator", 1,
        RowReaction("done", seen), 3,
    )  # fmt: skip
    record = make_record(HEAD, model(), [row], sweeps=[sweep], accepted=accepted)
    assert {(each.error.id, each.state, each.unmet, each.accepted is not None) for each in record.missed} == {
        ("battery-error", "", 2, False), ("fal", "Running", 2, False),
        ("fal", "Stopped", 1, False), ("fal", "Stopped", 0, True),
    }  # fmt: skip
    assert (record.summary.open, record.summary.accepted) == (3, 1)
    assert [record.finding(find(record, id)).unmet for id in ("fal", "battery-error", "memory-error")] == [2, 2, 0]
    again = from_xml(to_xml(record))
    assert isinstance(again, TestRecord)
    assert again.missed == record.missed
    page = to_html(record)
    assert WORDS["en"]["no_findings"] not in page
    rows = etree.fromstring(page, etree.HTMLParser()).find(".//table/tbody")
    assert rows is not None
    told = {(row[3].text, "".join(map(str, row[4].itertext()))) for row in rows}
    assert ("Running", "acted2 not as required") in told
    assert '"Running, Stopped"' in to_csv(record)  # open in


def test_people_read_names_and_details_in_words() -> None:
    log = [
        RecordLine(NOON, 7, "Ada", "generated memory-error (location=io-table-checksum), code 80F4; the program is stopped"),
        RecordLine(NOON, 8, "Ada", "armed 1: battery-error, now, for 20 scans"),
        RecordLine(NOON, 9, "Ada", "recovered memory-error"),
    ]  # fmt: skip
    row = ErrorRow("memory-error", "x", "fatal", "generated", "80F4", "location=io-table-checksum", NOON)
    record = make_record(HEAD, model(), [row], log=log)
    choice = model().error("memory-error").detail("location").choice("io-table-checksum")  # type: ignore[union-attr]
    assert choice is not None
    texts = [line.text for line in record.log]
    assert texts == [
        f"generated Memory error ({choice.description}), code 80F4; the program is stopped",
        "armed 1: Battery error, now, for 20 scans",
        "recovered Memory error",
    ]
    memory = find(record, "memory-error")
    assert (memory.details, memory.details_text) == ("location=io-table-checksum", choice.description)
    for text in (to_html(record), to_csv(record)):
        assert choice.description in text
        assert "location=" not in text
    japanese = make_record(HEAD, model(), [row], log=log, language="ja")
    words = next(each.description for each in choice.wordings if each.language == "ja")
    name = find(japanese, "memory-error").name
    assert find(japanese, "memory-error").details_text == words
    assert japanese.log[0].text == f"発生：{name} ({words})、コード 80F4（プログラム停止）"


def test_rounds_of_a_fault_are_one_line_of_the_log() -> None:
    def line(scan: int, text: str, by: str = "Ada") -> RecordLine:
        return RecordLine(NOON + timedelta(seconds=scan), scan, by, text)

    rounds = [line(10 * n + k, text) for n in range(35) for k, text in enumerate(("generated fal", "recovered fal"))]
    lines = [line(1, "armed 4: fal"), *rounds, line(900, "generated fal"), line(901, "generated fal", "Bob")]
    told = folded(lines)
    assert [(each.times, each.first.scan, each.last.scan) for each in told] == [
        (1, 1, 1), (35, 0, 341), (1, 900, 900), (1, 901, 901),
    ]  # fmt: skip
    assert told[1].texts == ("generated fal", "recovered fal")
    assert [each.times for each in folded(rounds[:4])] == [1, 1, 1, 1]  # twice is not again and again
    page = etree.fromstring(to_html(replace(made(), log=tuple(lines))), etree.HTMLParser())
    last = page.findall(".//table")[-1].findall("tbody/tr")
    assert len(last) == 4
    assert "generated fal; recovered fal (35 times)" in "".join(map(str, last[1].itertext()))


def test_names_in_japanese_where_the_model_has_them() -> None:
    record = make_record(HEAD, model(), [], language="ja")
    worded = {error.id: error for error in model().errors()}
    for error in record.errors:
        names = {each.name for each in worded[error.id].wordings if each.language == "ja"} - {""}
        assert error.name in (names or {worded[error.id].name})


def test_csv_has_a_row_for_each_error() -> None:
    record = made()
    text = to_csv(record)
    assert text.startswith("\ufeff")
    head, *rows = list(csv.reader(io.StringIO(text.removeprefix("\ufeff"))))
    assert tuple(head) == COLUMNS
    assert len(rows) == len(record.errors)
    by_id = {row[1]: dict(zip(head, row, strict=True)) for row in rows}
    battery, memory, fal = by_id["battery-error"], by_id["memory-error"], by_id["fal"]
    assert (battery["verdict"], battery["readers"], battery["outputs that differ"]) == (
        "reacted", "main.st:12", "Main.out TRUE → FALSE",
    )  # fmt: skip
    assert battery["generated"] == "2026-11-21T12:00:00.123Z"
    assert memory["by"] == "'=Bob"  # no formula in whoever's spreadsheet
    assert memory["note"] == "the run was made smaller"
    assert (fal["verdict"], fal["verdict from"]) == ("never_read", "sweep")
    assert fal["accepted"] == "empty: no <FAL> in this line & no other (Eva)"


@pytest.mark.parametrize("language", ["en", "ja"])
def test_the_document_to_sign(language: str) -> None:
    record = made()
    text = to_html(record, "ja" if language == "ja" else "en")
    page = etree.fromstring(text, etree.HTMLParser())
    assert page.get("lang") == language
    words = WORDS["ja" if language == "ja" else "en"]
    said = "".join(str(part) for part in page.itertext())
    for name in ("title", "findings", "sign", "tested_by", "approved_by", "reacted", "never_read"):
        assert words[name] in said
    assert "no <FAL> in this line & no other (Eva" in said  # escaped once, shown as it was
    rows = page.findall(".//table//tbody//tr")
    assert any(
        "Battery error" in "".join(map(str, row.itertext())) and "main.st:12" in "".join(map(str, row.itertext()))
        for row in rows
    )
    for tag in ("script", "img", "link", "iframe"):
        assert page.find(f".//{tag}") is None  # self-contained, and nothing that could do anything
    assert "http" not in text.replace("http-equiv", "")


def test_both_languages_have_the_same_words() -> None:
    assert WORDS["en"].keys() == WORDS["ja"].keys()
    assert all(WORDS["ja"].values())


def test_names_are_text_not_markup() -> None:
    evil = "<script>alert(1)</script>"
    error = RecordError(evil, evil, evil, evil, evil, "fatal", "generated", evil, NOON, None, 1, None, evil)
    sweep = RecordSweep(NOON, evil, evil, "done", 1, (evil,), (RecordCell(evil, evil, None, None, evil),))
    head = RecordHead(evil, evil, evil, 1, evil, NOON, evil, evil)
    record = TestRecord(head, (error,), (sweep,), (RecordLine(NOON, 1, evil, evil),))
    assert "<script" not in to_html(record)
    assert from_xml(to_xml(record)) == record


def test_what_xml_cannot_hold_is_marked() -> None:
    record = replace(made(), log=(RecordLine(NOON, 1, "Ada", "a\x00b\x1bc\ud800d"),))
    read = from_xml(to_xml(record))
    assert isinstance(read, TestRecord)
    assert read.log[0].text == "a\ufffdb\ufffdc\ufffdd"


# ---- XML, there and back ------------------------------------------------------------------------------------------

TEXT = st.text(st.characters(codec="utf-8", exclude_categories=("Cs", "Cc"), exclude_characters="\ufffe\uffff") | st.sampled_from("\t\n\r<&\"'"), max_size=20)  # fmt: skip
NAME = TEXT.filter(bool)
COUNT = st.integers(0, 2**63 - 1)
SCAN = st.none() | COUNT
AT = st.datetimes(
    datetime.fromisoformat("1972-01-01"),
    datetime.fromisoformat("2199-12-31"),
    timezones=st.just(timezone(timedelta(hours=9))),
)
VERDICT: st.SearchStrategy[Verdict] = st.sampled_from(WORST_FIRST)
SWEEP_STATUS: tuple[SweepStatus, ...] = ("running", "done", "cancelled", "interrupted", "failed")
READERS = st.builds(Reader, TEXT, COUNT, TEXT, st.sampled_from(["flag", "code", "detail", "log"]), COUNT)
TEXTS = st.lists(TEXT, max_size=2).map(tuple)
REACTIONS = st.builds(
    Reaction, VERDICT, COUNT, SCAN, SCAN, st.lists(READERS, max_size=3).map(tuple),
    st.lists(st.builds(Difference, TEXT, TEXT, TEXT, st.just(True), COUNT), max_size=3).map(tuple), COUNT,
    st.lists(st.builds(Line, TEXT, COUNT), max_size=3).map(tuple), TEXT,
    st.sampled_from(["", *get_args(Basis)]), st.lists(st.builds(Carried, TEXT, COUNT, TEXTS), max_size=2).map(tuple), TEXTS, TEXTS,
    st.lists(st.builds(Unreached, TEXT, COUNT, TEXTS, st.sampled_from(get_args(Obstacle)), TEXT), max_size=2).map(tuple),
)  # fmt: skip
ERRORS = st.builds(
    RecordError, NAME, TEXT, TEXT, TEXT, TEXT, st.sampled_from(["fatal", "nonfatal"]),
    st.sampled_from(["never", "generated", "cleared"]), TEXT, st.none() | AT, st.none() | AT, SCAN, SCAN, TEXT,
    st.sampled_from([None, "simulator", "plc", "program"]), COUNT, st.none() | REACTIONS, TEXT,
    st.lists(st.builds(RecordAccepted, TEXT, TEXT, TEXT, AT), max_size=2).map(tuple), TEXT,
)  # fmt: skip


@st.composite
def records(draw: st.DrawFn) -> TestRecord:
    errors = draw(st.lists(ERRORS, max_size=4, unique_by=lambda error: error.id))
    head = draw(st.builds(RecordHead, TEXT, TEXT, TEXT, COUNT, TEXT, AT, TEXT, TEXT))
    states = draw(st.lists(TEXT, min_size=1, max_size=3, unique=True))
    pairs = [(error.id, state) for error in errors for state in states]
    cells = [
        RecordCell(error, state, draw(st.none() | VERDICT), draw(SCAN), draw(TEXT))
        for error, state in draw(st.lists(st.sampled_from(pairs), unique=True) if pairs else st.just([]))
    ]
    status = draw(st.sampled_from(SWEEP_STATUS))
    sweep = RecordSweep(draw(AT), draw(TEXT), draw(TEXT), status, draw(COUNT), tuple(states), tuple(cells))
    log = draw(st.lists(st.builds(RecordLine, AT, COUNT, TEXT, TEXT), max_size=3))
    return TestRecord(head, tuple(errors), (sweep,), tuple(log))


@settings(max_examples=50, deadline=None)
@given(records())
def test_what_is_written_is_read_again(record: TestRecord) -> None:
    assert from_xml(to_xml(record)) == record
    to_html(record, "ja")
    to_csv(record)


@settings(max_examples=100, deadline=None)
@given(REACTIONS)
def test_reactions_as_json_and_back(reaction: Reaction) -> None:
    assert from_json(to_json(reaction)) == reaction


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (
            {"verdict": "fine"},
            "verdict must be one of acted, decided, displayed, stored, no_effect, not_reached, never_read, stopped, reacted, stored_only, not 'fine'",
        ),
        ({"window": "200"}, "window must be a whole number, not '200'"),
        ({"window": True}, "window must be a whole number, not True"),
        ({"readers": None}, "readers must be a list of objects"),
        ({"lines": [{"file": 1, "line": 2}]}, "file must be a text, not 1"),
        ({"differences": [{"output": "yes"}]}, "output must be true or false, not 'yes'"),
    ],
)
def test_json_that_is_no_reaction(change: dict[str, object], says: str) -> None:
    with pytest.raises(ValueError, match=says):
        from_json({**to_json(REACTION), **change})


@pytest.mark.parametrize(
    ("old", "new", "line", "says"),
    [
        (
            'Version="5"',
            'Version="6"',
            2,
            "of Version 6, and this Scanbench reads Version 1, 2, 3, 4 and 5: bring it in with the version",
        ),
        ('ProgramVersion="3"', 'ProgramVersion="three"', 2, "three"),
        ('ProgramVersion="3"', 'ProgramVersion="-1"', 2, "-1"),
        ('Status="cleared"', 'Status="mended"', None, "mended"),
        ('Verdict="reacted" Window', 'Verdict="good" Window', None, "good"),
        ('GeneratedAt="2026-11-21', 'GeneratedAt="2026-02-31', None, "2026-02-31"),
        (
            'GeneratedAt="2026-11-21T12:00:00.123456+00:00"',
            'GeneratedAt="2026-11-21T12:00:00"',
            None,
            "write a moment as",
        ),
        ('ExportedAt="2026-11-21T12:00:00.123456+00:00"', 'ExportedAt="0001-01-01T00:00:00+14:00"', 2, "no moment"),
        ('Cell Error="fal"', 'Cell Error="fail"', None, "there is no Error with the Id 'fail'"),
        ('State="empty" Verdict', 'State="full" Verdict', None, "no State with the Name 'full'"),
        ('State="empty" Verdict', 'State="filled" Verdict', None, "two Cells for fal from 'filled'"),
        ('Id="battery-error"', 'Id="fal"', None, "ErrorIds"),
        ("<Line ", "<Lines ", None, "Lines"),
        ("</TestRecord>", "", None, "not well-formed XML"),
        ("<TestRecord", "<!DOCTYPE x [<!ENTITY y 'z'>]>\n<TestRecord", 2, "a test record has no DOCTYPE"),
    ],
)
def test_a_broken_record_is_refused_with_its_line(old: str, new: str, line: int | None, says: str) -> None:
    text = to_xml(made())
    assert old in text
    broken = text.replace(old, new, 1)
    found = from_xml(broken)
    assert isinstance(found, list)
    assert any(says in problem.message for problem in found), found
    place = next(problem.span for problem in found if says in problem.message)
    wanted = line or text[: text.index(old)].count("\n") + 1
    assert abs(place.line - wanted) <= 1
    assert place.column >= 1


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ('At="2026-11-21T12:00:00.123456+00:00', 'At="0001-01-01T00:00:00+14:00', "is no moment"),
        ('Scan="7"', 'Scan="seven"', "seven"),
        ('State="S"', 'State="T"', "no State with the Name 'T'"),
    ],
)
def test_of_a_record_that_is_wrong_throughout_the_first_problems_are_told(old: str, new: str, says: str) -> None:
    """To find the place of each took minutes in a file of megabytes."""
    errors = tuple(RecordError(f"e{n}", "", "", "", "", "fatal", "never") for n in range(3000))
    cells = tuple(RecordCell(error.id, "S", None) for error in errors)
    sweep = RecordSweep(NOON + timedelta(days=1), "Ada", "line-1", "done", 200, ("S",), cells)
    lines = tuple(RecordLine(NOON, 7, "Ada", "generated") for _ in range(3000))
    record = TestRecord(replace(HEAD, exported_at=NOON + timedelta(days=1)), errors, (sweep,), lines)
    text = to_xml(record)
    assert from_xml(text) == record
    found = from_xml(text.replace(old, new))
    assert isinstance(found, list)
    assert len(found) == TOLD + 1
    assert says in found[0].message
    assert text.split("\n")[found[0].span.line - 1].count(old) == 1
    assert found[-1].message.startswith("there are more problems from here on")


def test_what_is_no_record_at_all() -> None:
    for text, says in (
        ("", "not well-formed"),
        ("<Model/>", "here belongs <TestRecord>"),
        ("<TestRecord" + " " * 5_000_000 + "/>", "larger than 4 MiB, a test record never is"),
    ):
        found = from_xml(text)
        assert isinstance(found, list)
        assert says in found[0].message
