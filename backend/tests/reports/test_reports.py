"""Reports of a verification, from rows that are written by hand: JSON, CSV, the page, and what a collection keeps."""

import csv
import io
import json
import re
from dataclasses import replace
from html.parser import HTMLParser

import pytest

from scanbench.reports.report import CONTEXT, MAX_ROWS, Collected, Report, ReportHead
from scanbench.reports.report_html import DIFFERENCES, to_html
from scanbench.reports.report_json import to_json
from scanbench.reports.table_csv import to_csv
from scanbench.reports.value_text import differing_bits, value_text
from scanbench.symbols.values import Format
from scanbench.verify.contract import Column, Input, Mismatch, Output, Place, Row, ScanVerified

SPEED = Column("speed", "INT", "int", 2)
RUN = Column("run", "BOOL", "bool", 1)
NAME = Column("name", "STRING[6]", "string", 8)
STATE = Column("state", "E_State", "int", 2, (("IDLE", 0), ("BUSY", 1)))
COLUMNS = (SPEED, RUN, NAME, STATE)
PLACE = Place("Cyclic", "Main.belt[3]", "FB_Belt", "Belt.st", 34, "speed := LIMIT(0, <x> & y, 600);")
HEAD = ReportHead(
    "Conveyor <1>", "line-1", "CJ1M-CPU63", "Ada", "2026-11-21T12:00:00.000Z", 14, "FB_Belt, lines 33 to 42", "past",
    100, 199, 100, 0, 1, "Scanbench 1", interval_ns=10_000_000,
)  # fmt: skip


def word(number: int) -> bytes:
    return number.to_bytes(2, "little", signed=True)


def row(scan: int, control: int = 600, monitor: int = 600, call: int = 1) -> Row:
    differences: tuple[Mismatch, ...] = ()
    if control != monitor:
        message = f"Main.belt[3].speed is {control}, the reference gives {monitor}, at Belt.st:34 in scan {scan}"
        differences = (Mismatch("logic", "speed", word(control), word(monitor), PLACE, message, "INT", "int", 2),)
    return Row(
        "pass", scan, call, instance="Main.belt[3]",
        outputs={"speed": Output(word(control), word(monitor)), "run": Output(b"\1", b"\1"), "name": Output(b"\2\0=Axxxx", None)},
        inputs={"state": Input(word(1)), "speed": Input(word(575))},
        differences=differences, disturbances=("Result of LIMIT, bit 6",) if differences else (), used=4,
    )  # fmt: skip


def report(*rows: Row) -> Report:
    differing = sum(each.differs for each in rows)
    return Report(
        replace(HEAD, differing=differing), COLUMNS, rows, ("state", "speed"), ("speed", "run", "name")
    )  # fmt: skip


def rows_of(text: str) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(text)))


def test_json_has_the_head_the_rows_and_each_difference() -> None:
    told = json.loads(to_json(report(row(187), row(188, 536), row(189))))
    assert (told["project"], told["range"], told["program_version"]) == ("Conveyor <1>", "FB_Belt, lines 33 to 42", 14)
    assert (told["first"], told["last"], told["compared"], told["same"]) == (100, 199, 100, False)
    assert [each["name"] for each in told["columns"]] == ["speed", "run", "name", "state"]
    assert told["columns"][0] == {"name": "speed", "type": "INT", "size": 2, "input": True, "output": True}
    (difference,) = told["differences"]
    assert (difference["scan"], difference["was"], difference["is"], difference["bits"]) == (188, "536", "600", [6])
    assert difference["place"] == {
        "task": "Cyclic", "instance": "Main.belt[3]", "pou": "FB_Belt", "file": "Belt.st", "line": 34, "text": PLACE.text
    }  # fmt: skip
    assert difference["disturbances"] == ["Result of LIMIT, bit 6"]
    assert [each["differs"] for each in told["rows"]] == [False, True, False]
    assert told["rows"][1]["outputs"]["speed"] == {"control": "536", "monitor": "600", "set": None}
    assert told["rows"][1]["outputs"]["name"] == {"control": "'=A'", "monitor": None, "set": None}
    assert told["rows"][1]["inputs"]["state"] == {"recorded": "BUSY", "expected": None, "set": None}
    assert json.loads(to_json(report(row(1))))["same"] is True


def test_csv_has_a_line_for_each_row() -> None:
    first, second = rows_of("".join(to_csv(report(row(187), row(188, 536)))))
    assert (first["scan"], first["differs"], first["speed A"], first["speed A'"]) == ("187", "", "600", "600")
    assert (second["differs"], second["speed A"], second["speed A'"]) == ("yes", "536", "600")
    assert (second["name A"], second["name A'"], second["state in"]) == ("'=A'", "", "BUSY")
    assert second["disturbances"] == "Result of LIMIT, bit 6"
    assert "the reference gives 600" in second["differences"]
    assert not any("set" in head for head in first)


def test_csv_takes_formats_and_columns_in_an_order() -> None:
    formats: dict[str, Format] = {"speed": "hex"}
    text = "".join(to_csv(report(row(188, -1)), formats, ["state", "speed", "nothing"]))
    (only,) = rows_of(text)
    assert list(only)[6:10] == ["speed A", "speed A'", "state in", "speed in"]
    assert (only["speed A"], only["speed in"]) == ("16#FFFF", "16#023F")


def test_csv_shows_what_was_set_and_expected_where_there_is_any() -> None:
    edited = replace(
        row(5),
        outputs={"speed": Output(word(1), word(1), word(-7))},
        inputs={"state": Input(word(1), expected=word(0), set=word(0))},
    )
    first, second = rows_of("".join(to_csv(report(row(4), edited))))
    assert (first["speed A' set"], second["speed A' set"]) == ("", "-7")  # a number, and no formula
    assert (second["state in expected"], second["state in set"]) == ("IDLE", "IDLE")


def test_a_name_that_looks_like_a_formula_is_no_formula() -> None:
    strange = Column("=A1", "INT", "int", 2)
    made = Report(HEAD, (strange,), (Row("pass", 1, outputs={"=A1": Output(word(1), word(1))}),), (), ("=A1",))
    assert "'=A1 A" in next(iter(to_csv(made)))


class _Page(HTMLParser):
    """Checks that elements are closed in order, and that nothing is loaded from elsewhere."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.marks = 0

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        assert tag not in ("script", "link", "img", "iframe")
        assert not {"src", "href", "style"} & {name for name, _ in attrs}
        self.marks += tag == "mark"
        if tag not in ("meta", "br"):
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


@pytest.mark.parametrize("language", ["en", "ja"])
def test_the_page_needs_nothing_else_and_shows_each_difference(language: str) -> None:
    text = to_html(report(row(187), row(188, 536), row(189)), "ja" if language == "ja" else "en")
    page = _Page()
    page.feed(text)
    assert page.open == []
    assert page.marks == 2  # one bit of A, and of A'
    assert "speed := LIMIT(0, &lt;x&gt; &amp; y, 600);" in text
    assert "Conveyor &lt;1&gt;" in text
    assert "Result of LIMIT, bit 6" in text
    assert re.search(r'<td class="value mono bad">536</td><td class="value mono">600</td>', text)
    assert "url(" not in text


def test_a_page_of_a_trace_with_skipped_scans_says_what_was_not_compared() -> None:
    head = replace(
        HEAD, source="trace", trace="press {4}.csv", skipped=12, stretches=((5, 5), (7, 17)), forgotten=3, differing=0
    )
    text = to_html(Report(head, COLUMNS, (row(1),), ("state",), ("speed",)))
    assert "controller log: press {4}.csv" in text
    assert "Not compared: 5, 7 – 17. 3 rows are not in this report." in text
    assert "All scans were compared" not in text


def test_a_page_without_a_difference_says_so() -> None:
    text = to_html(report(row(187)))
    assert "No difference" in text
    assert "Differences found" not in text
    nothing = Report(replace(HEAD, differing=0, compared=0), (), ())
    assert "Nothing was compared" in to_html(nothing)


def test_a_page_shows_the_first_differences_and_says_how_many_there_are() -> None:
    text = to_html(report(*(row(scan, 536) for scan in range(DIFFERENCES + 7))))
    assert text.count("<section>") == DIFFERENCES
    assert "7 more differences" in text


def test_a_collection_keeps_what_differs_and_what_is_around_it() -> None:
    collected = Collected()
    for scan in range(100):
        rows = (row(scan, 536 if scan in (40, 41, 90) else 600),)
        first = ScanVerified(scan, rows, COLUMNS, ("state",), ("speed",))
        collected.add(ScanVerified(scan, rows, ()) if scan else first)
    kept = [each.scan for each in collected.rows()]
    assert kept == [*range(40 - CONTEXT, 42 + CONTEXT), *range(90 - CONTEXT, 91 + CONTEXT)]
    assert (collected.compared, collected.differing, collected.seen) == (100, 3, 100)
    made = collected.report(HEAD)
    assert made.columns == COLUMNS
    assert made.outputs == ("speed",)


def test_a_collection_is_bounded() -> None:
    collected = Collected()
    for scan in range(MAX_ROWS + 500):
        collected.add(ScanVerified(scan, (row(scan, 536),), ()))
    assert len(collected.rows()) == MAX_ROWS
    assert collected.differing == MAX_ROWS + 500
    same = Collected()
    for scan in range(50):
        same.add(ScanVerified(scan, (row(scan),), ()))
    assert [each.scan for each in same.rows()] == [48, 49]


@pytest.mark.parametrize(
    ("column", "data", "format", "text"),
    [
        (SPEED, word(-2), "default", "-2"),
        (SPEED, word(-2), "unsigned", "65534"),
        (SPEED, word(-2), "binary", "2#1111111111111110"),
        (SPEED, word(0x1234), "bcd", "1234"),
        (SPEED, word(1500), "time", "T#1s500ms"),
        (SPEED, word(0x4142), "ascii", "'AB'"),
        (RUN, b"\1", "hex", "TRUE"),
        (STATE, word(1), "hex", "BUSY"),
        (STATE, word(9), "default", "9"),
        (NAME, b"\3\0abcdef", "default", "'abc'"),
        (Column("w", "WSTRING[2]", "string", 6), b"\1\0\x42\x30\0\0", "default", '"あ"'),
        (Column("r", "REAL", "real", 4), b"\0\0\xc0\x3f", "default", "1.5"),
        (Column("r", "REAL", "real", 4), b"\0\0\xc0\x3f", "hex", "16#3FC00000"),
        (Column("t", "TIME", "time", 8), (1_500_000_000).to_bytes(8, "little"), "default", "T#1s500ms"),
        (Column("t", "TIME", "time", 8), (1_500_000_000).to_bytes(8, "little"), "decimal", "1500"),
        (Column("d", "DATE", "date", 8), bytes(8), "default", "D#1970-01-01"),
        (Column("d", "MY_DATE", "date", 8), bytes(8), "default", "16#0000000000000000"),
        (Column("w", "DWORD", "bits", 4), b"\1\0\0\0", "default", "16#00000001"),
        (Column("f", "DWORD", "bits", 4), b"\0\0\xc0\x3f", "float", "1.5"),
        (Column("x", "FB", "block", 12), bytes(12), "default", f"16#{'0' * 24}"),
    ],
)  # fmt: skip
def test_values_read_as_in_the_watch_table(column: Column, data: bytes, format: Format, text: str) -> None:
    assert value_text(column, data, format) == text


def test_nothing_and_bits() -> None:
    assert value_text(SPEED, None) == ""
    assert value_text(SPEED, b"") == ""
    assert differing_bits(word(536), word(600)) == [6]
    assert differing_bits(b"", word(600)) == []
