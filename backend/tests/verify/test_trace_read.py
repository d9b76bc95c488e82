"""Reading trace files: what every form comes to, and that a bad one is refused whole, with row and column."""

import json

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scanbench.verify.trace import table as trace_table
from scanbench.verify.trace.read import read_trace
from scanbench.verify.trace.table import BadTraceFile, Table, TraceProblem

WIDE = "scan,start,level\n0,FALSE,1.5\n1,TRUE,\n"


def read(text: str, name: str = "trace.csv") -> Table:
    return read_trace(text.encode(), name)


def refused(data: str | bytes, name: str = "trace.csv") -> tuple[TraceProblem, ...]:
    with pytest.raises(BadTraceFile) as caught:
        read_trace(data.encode() if isinstance(data, str) else data, name)
    return caught.value.problems


def test_a_wide_file() -> None:
    table = read(WIDE)
    assert table.columns == ("scan", "start", "level")
    assert table.rows == (("0", "FALSE", "1.5"), ("1", "TRUE", ""))
    assert (list(table.numbers), table.header, table.comma, table.note) == ([2, 3], 1, False, "")


@pytest.mark.parametrize("separator", [";", "\t"])
def test_semicolons_tabs_and_decimal_commas(separator: str) -> None:
    text = f"scan{separator}x{separator}y, z\r\n0{separator}1,5{separator}2\r\n"
    table = read(text)
    assert table.columns == ("scan", "x", "y, z")
    assert table.rows == (("0", "1,5", "2"),)
    assert table.comma


def test_the_separator_line_of_excel_counts_as_a_line() -> None:
    table = read("sep=;\r\nscan;a,b\r\n0;1\r\n")
    assert table.columns == ("scan", "a,b")
    assert (table.header, list(table.numbers)) == (2, [3])


def test_quotes_empty_lines_and_trailing_separators() -> None:
    table = read('scan,"a,""b""",\n\n0,"x\ny",\n\n1,2\n')
    assert table.columns == ("scan", 'a,"b"')
    assert table.rows == (("0", "x\ny"), ("1", "2"))
    assert list(table.numbers) == [3, 6]


def test_what_was_guarded_against_spreadsheets() -> None:
    assert read("scan,'-Main.a\n0,1\n").columns == ("scan", "-Main.a")


@pytest.mark.parametrize(
    "text",
    [
        '{"axis": "scan", "columns": ["scan", "start", "level"], "rows": [[0, false, 1.5], [1, true, null]]}',
        '[{"scan": 0, "start": false, "level": 1.5}, {"scan": 1, "start": true}]',
        '[{"scan": 1, "variable": "start", "value": true}, {"scan": 0, "variable": "start", "value": false},'
        ' {"scan": 0, "variable": "level", "value": 1.5}]',
    ],
)
def test_json_is_the_same_table(text: str) -> None:
    table = read(text, "trace.json")
    assert table.columns == ("scan", "start", "level")
    assert table.rows == (("0", "FALSE", "1.5"), ("1", "TRUE", ""))
    assert table.header is None


def test_json_numbers_keep_their_digits_and_empty_texts_are_values() -> None:
    table = read('[{"x": 1.50, "y": 123456789012345678901234567890, "z": "", "n": NaN}]', "a.json")
    assert table.rows == (("1.50", "123456789012345678901234567890", "''", "NaN"),)


def test_the_unit_of_a_json_axis() -> None:
    table = read('{"axis": "when", "unit": "ms", "columns": ["when", "x"], "rows": [[0, 1]]}', "a.json")
    assert table.columns == ("when [ms]", "x")


def test_the_long_form_in_any_order() -> None:
    table = read("time [ms];variable;value\n0;b;1\n10;b;2\n20;b;3\n0;a;7\n20;a;8\n")
    assert table.columns == ("time [ms]", "b", "a")
    assert table.rows == (("0", "1", "7"), ("10", "2", ""), ("20", "3", "8"))
    assert list(table.numbers) == [2, 3, 4]


def test_the_long_form_by_number_not_by_text() -> None:
    assert [row[0] for row in read("scan,signal,value\n10,a,1\n9,a,1\n").rows] == ["9", "10"]


@pytest.mark.parametrize(
    ("data", "note"),
    [
        (b"\xef\xbb\xbf" + "scan,Füller\n0,1\n".encode(), ""),
        ("scan,Füller\n0,1\n".encode("utf-16"), ""),
        ("scan,Füller\n0,1\n".encode("latin-1"), "Latin-1"),
        ("scan,起動\n0,1\n".encode("cp932"), "Shift_JIS"),
        ("scan,モータ\n0,1\n".encode("cp932"), "Shift_JIS"),
    ],
)
def test_encodings(data: bytes, note: str) -> None:
    table = read_trace(data, "t.csv")
    assert table.columns[1] in ("Füller", "起動", "モータ")
    assert table.rows == (("0", "1"),)
    assert note in table.note
    assert bool(table.note) is bool(note)


@pytest.mark.parametrize(
    ("text", "row", "column", "words"),
    [
        ("", None, "", "empty"),
        ("scan,a\n", 1, "", "no row with values"),
        ("scan,a,a\n0,1,2\n", 1, "a", "two columns `a`"),
        ("scan,,a\n0,1,2\n", 1, "", "Column 2 has no name"),
        ("scan,a\n0,1\n1\n2,3\n", 3, "", "1 cells, but there are 2 columns"),
        ("scan,a\n0,1,9\n", 2, "", "3 cells"),
        ('scan,a\n0,"x"y\n', 2, "", "cannot be read"),
        ("scan,variable,value\n0,a,1\n0,a,2\n", 3, "a", "two values"),
        ("scan,variable,value\n,a,1\n", 2, "scan", "is empty"),
        ("scan,variable,value\n0,,1\n", 2, "variable", "is empty"),
    ],
)
def test_bad_csv_is_refused_whole_with_its_place(text: str, row: int | None, column: str, words: str) -> None:
    problem = refused(text)[0]
    assert (problem.row, problem.column) == (row, column)
    assert words in problem.message


@pytest.mark.parametrize(
    ("text", "row", "column", "words"),
    [
        ("[", None, "", "line 1, column 2"),
        ("7", None, "", "list of objects"),
        ("[7]", 0, "", "no object"),
        ('[{"a": 1, "a": 2}]', None, "", "`a` twice"),
        ('[{"a": 1}, {"a": [2]}]', 1, "a", "list or an object"),
        ('{"columns": ["a"]}', None, "", '"rows"'),
        ('{"columns": ["a"], "rows": [[1, 2]]}', 0, "", "2 cells"),
        ('{"columns": ["a", "a"], "rows": [[1, 2]]}', None, "a", "two columns"),
        ('{"columns": [1], "rows": [[1]]}', None, "", "no name"),
        ('{"axis": "b", "columns": ["a"], "rows": [[1]]}', None, "", "`b`"),
        ('{"axis": "a", "unit": "h", "columns": ["a"], "rows": [[1]]}', None, "", '"unit" is `h`'),
        ("[" * 100_000, None, "", "nested too deeply"),
    ],
)
def test_bad_json_is_refused_whole_with_its_place(text: str, row: int | None, column: str, words: str) -> None:
    problem = refused(text, "t.json")[0]
    assert (problem.row, problem.column) == (row, column)
    assert words in problem.message


def test_a_cause_is_told_once_with_the_number_of_its_rows() -> None:
    rows = "".join("1\n" for _ in range(500))
    problems = refused("scan,a\n" + rows)
    assert [(each.row, each.more, each.last) for each in problems] == [(2, 499, 501)]
    assert "499 more rows, the last one is row 501" in str(problems[0])


def test_what_is_no_text() -> None:
    assert "no text" in refused(b"\x89PNG\0\0\xff")[0].message
    assert "zero bytes" in refused(b"scan,a\0\n")[0].message


def test_bounds(monkeypatch: pytest.MonkeyPatch) -> None:
    assert "at most 1,000" in refused(",".join(f"c{n}" for n in range(1001)) + "\n")[0].message
    assert "at most 1,000" in refused(json.dumps([{f"c{n}": 1 for n in range(1001)}]), "t.json")[0].message
    monkeypatch.setattr(trace_table, "MAX_ROWS", 3)
    assert "more than 3 rows" in refused("a\n1\n2\n3\n4\n")[0].message
    monkeypatch.setattr(trace_table, "MAX_CELLS", 5)
    assert "more than 5 cells" in refused("a,b\n1,1\n2,2\n3,3\n")[0].message


@settings(max_examples=200)
@given(st.binary(max_size=200), st.sampled_from(["t.csv", "t.json", "t"]))
def test_any_bytes_are_read_or_refused(data: bytes, name: str) -> None:
    try:
        table = read_trace(data, name)
    except BadTraceFile:
        return
    assert table.rows
    assert all(len(row) == len(table.columns) for row in table.rows)


@settings(max_examples=100)
@given(st.text(alphabet='ab01,;\t"\n{}[]: ', max_size=60))
def test_any_text_is_read_or_refused(text: str) -> None:
    for name in ("t.csv", "t.json"):
        try:
            table = read_trace(text.encode(), name)
        except BadTraceFile:
            continue
        assert all(len(row) == len(table.columns) for row in table.rows)
