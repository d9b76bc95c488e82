"""What the columns of a trace mean, and what is refused before anything runs: with row and column."""

import math
import struct
from dataclasses import replace

import pytest

from scanbench.program.program import Program
from scanbench.program.types import ELEMENTARY, StringType
from scanbench.verify.trace.bind import Checked, check
from scanbench.verify.trace.mapping import BadMapping, ColumnMap, TraceMapping, fits
from scanbench.verify.trace.propose import propose as proposal
from scanbench.verify.trace.read import read_trace
from scanbench.verify.trace.table import Table
from scanbench.verify.trace.values import cell_value, exactness
from tests.verify.trace_parts import checked, conveyor, conveyor_csv, mapped, program_of

LINE = """
TYPE Mode : (OFF, SLOW, FAST); END_TYPE
TYPE Pair : STRUCT a, b : INT; END_STRUCT END_TYPE
PROGRAM Main
VAR go AT CIO 0.00 : BOOL; lamp AT CIO 100.00 : BOOL; speed : REAL; n : INT; delay : TIME; mode : Mode; text : STRING[8];
  pair : Pair; list : ARRAY[1..3] OF INT; day : DATE; bits : WORD; END_VAR
VAR CONSTANT LIMIT_OF_IT : INT := 7; END_VAR
  lamp := go AND speed > 1.0 AND delay > T#1s AND LIMIT_OF_IT > 3;
  n := n + 1;
END_PROGRAM
"""


def propose(table: Table, program: Program) -> TraceMapping:
    return proposal(table, program).mapping


def problems(found: Checked) -> list[tuple[int | None, str, str]]:
    return [(each.row, each.column, each.message) for each in found.problems]


def proposed(header: str, source: str = LINE) -> dict[str, tuple[str, str]]:
    mapping = propose(read_trace(f"{header}\n{',' * header.count(',')}0\n".encode(), "t.csv"), program_of(source))
    return {each.column: (each.path, each.role) for each in mapping.columns}


def test_names_are_found_as_people_write_them() -> None:
    found = proposed("scan,main.GO,lamp,Main.speed,N,0.01,d100,list[2],Main.delay [s],pair.a")
    assert found == {
        "main.GO": ("Main.go", "input"),
        "lamp": ("Main.lamp", "output"),
        "Main.speed": ("Main.speed", "input"),
        "N": ("Main.n", "output"),
        "0.01": ("CIO0.01", "input"),
        "d100": ("D100", "input"),
        "list[2]": ("Main.list[2]", "input"),
        "Main.delay [s]": ("Main.delay", "input"),
        "pair.a": ("Main.pair.a", "input"),
    }


@pytest.mark.parametrize(
    ("header", "axis", "unit"),
    [
        ("scan,lamp", "scan", "scan"),
        ("time,lamp", "time", "s"),
        ("Time (ms),lamp", "Time (ms)", "ms"),
        ("t_us,lamp", "t_us", "us"),
        ("timestamp [ns],scan,lamp", "scan", "scan"),
        ("go,lamp", "", "scan"),
    ],
)
def test_the_axis_is_found(header: str, axis: str, unit: str) -> None:
    mapping = propose(read_trace(f"{header}\n{'0,' * header.count(',')}0\n".encode(), "t.csv"), program_of(LINE))
    assert (mapping.axis, mapping.unit) == (axis, unit)
    assert all(each.role == "ignore" for each in mapping.columns if each.column.startswith(("time", "scan")))


def test_our_own_export_is_mapped_without_edits() -> None:
    table = read_trace(conveyor_csv().encode(), "conveyor.csv")
    mapping = propose(table, conveyor())
    roles = {each.column: each.role for each in mapping.columns}
    assert mapping.axis == "scan"
    assert {each for each, role in roles.items() if role == "input"} == {"start", "stop", "reset", "basicIoError"}
    ignored = {"time [s]", "Main.parts.total + 1", "D100", "Main.buffer.level"}
    assert {each for each, role in roles.items() if role == "ignore"} == ignored
    found = check(table, mapping, conveyor())
    assert found.problems == ()
    assert (found.first, found.last, found.missing) == (0, 299, 0)
    assert found.trace is not None
    assert found.trace.scans.cold


def test_an_unknown_column_is_told_and_nothing_is_made() -> None:
    program = program_of(LINE)
    table = read_trace(b"scan,lamp,sped\n0,1,2\n", "t.csv")
    found = check(table, propose(table, program), program)
    assert problems(found) == [
        (
            1,
            "sped",
            "Nothing in the program is called `sped`. Did you mean `Main.speed`? Map it to a variable, or ignore the column.",
        )
    ]
    assert not found.ok
    assert found.trace is None


@pytest.mark.parametrize(
    ("text", "row", "column", "words"),
    [
        ("scan,go,lamp\n0,1,1\n1,maybe,1\n", 3, "go", "`maybe` is not a BOOL; write TRUE or FALSE"),
        ("scan,n,lamp\n0,1,1\n1,70000,1\n", 3, "n", "70000 is outside of INT"),
        ("scan,n,lamp\n0,x,1\n", 2, "n", "`x` is not INT"),
        ("scan,speed,lamp\n0,fast,1\n", 2, "speed", "`fast` is not a number"),
        ('scan,speed,lamp\n0,"1,5",1\n', 2, "speed", "has a comma: write the number with a decimal point"),
        ("scan,delay,lamp\n0,1.5,1\n", 2, "delay", "write T#1s500ms, or put the unit after the column's name"),
        ("scan,mode,lamp\n0,QUICK,1\n", 2, "mode", "write OFF, SLOW, FAST"),
        ("scan,text,lamp\n0,123456789,1\n", 2, "text", "9 characters do not fit"),
        ("scan,go,lamp\n0,1,1\n0,1,1\n", 3, "scan", "Scan 0 has two rows"),
        ("scan,go,lamp\n5,1,1\n4,1,1\n", 3, "scan", "Scan 4 comes after scan 5"),
        ("scan,go,lamp\n5,1,1\n9,1,1\n", 3, "scan", "scans 6 to 8 are missing"),
        ("scan,go,lamp\n5,1,1\n7,1,1\n", 3, "scan", "scan 6 is missing"),
        ("scan,go,lamp\n0,1,1\n,1,1\n", 3, "scan", "the cell is empty"),
        ("scan,go,lamp\n0,1,1\nx,1,1\n", 3, "scan", "`x` is not a number"),
        ("scan,go,lamp\n0.5,1,1\n", 2, "scan", "not the number of a scan"),
        ("scan,go,lamp\n-1,1,1\n", 2, "scan", "not the number of a scan"),
        (
            "time [ms],go,lamp\n0,1,1\n15,1,1\n",
            3,
            "time [ms]",
            "15 ms is between two scans: the program's interval is 10 ms",
        ),
        ("time,go,lamp\n0.02,1,1\n0.01,1,1\n", 3, "time", "Scan 1 comes after scan 2"),
        ("time,go,lamp\nnoon,1,1\n", 2, "time", "`noon` is not a number"),
    ],
)
def test_bad_cells_and_axes_are_refused_with_row_and_column(text: str, row: int, column: str, words: str) -> None:
    program = program_of(LINE)
    table = read_trace(text.encode(), "t.csv")
    found = check(table, propose(table, program), program)
    told = [each for each in found.problems if not each.warning]
    assert [(each.row, each.column) for each in told] == [(row, column)]
    assert words in told[0].message
    assert found.trace is None


def test_rows_of_a_json_file_count_from_0() -> None:
    program = program_of(LINE)
    table = read_trace(b'[{"scan": 0, "lamp": true}, {"scan": 1, "lamp": 7}]', "t.json")
    assert [(each.row, each.column) for each in check(table, propose(table, program), program).problems] == [
        (1, "lamp")
    ]


TEXT = "scan,a,b\n0,1,1\n1,0,0\n"


@pytest.mark.parametrize(
    ("mapping", "column", "words"),
    [
        (mapped(("a", "Main.go", "input"), ("b", "Main.lamp", "output"), axis="scn"), "scn", "Did you mean `scan`?"),
        (mapped(("a", "Main.go", "input"), ("b", "Main.lamp", "output"), ("c", "", "output")), "c", "no such column"),
        (mapped(("a", "Main.go", "input"), ("a", "Main.n", "input"), ("b", "Main.lamp", "output")), "a", "twice"),
        (mapped(("b", "Main.lamp", "output")), "a", "says nothing of this column"),
        (mapped(("a", "Main.go", "input"), ("b", "Main.go", "output")), "b", "what column `a` is mapped to"),
        (mapped(("a", "0.00", "input"), ("b", "CIO0", "output")), "b", "what column `a` is mapped to (`0.00`)"),
        (mapped(("a", "Main.go", "input"), ("b", "Main.lamb", "output")), "b", "Did you mean `Main.lamp`?"),
        (mapped(("a", "Main.go", "input"), ("b", "", "output")), "b", "Nothing in the program is called `b`"),
        (mapped(("a", "Main.go", "input"), ("b", "Main.pair", "output")), "b", "map the column to one of its members"),
        (mapped(("a", "Main.LIMIT_OF_IT", "input"), ("b", "Main.lamp", "output")), "a", "is a constant"),
        (
            mapped(("scan", "Main.n", "input"), ("a", "", "ignore"), ("b", "Main.lamp", "output")),
            "scan",
            "scan or time",
        ),
        (mapped(("a", "Main.go", "input"), ("b", "", "ignore")), "", "nothing to compare"),
    ],
)
def test_bad_mappings_are_refused(mapping: TraceMapping, column: str, words: str) -> None:
    found = checked(TEXT, mapping, program_of(LINE))
    told = [each for each in found.problems if not each.warning]
    assert column in [each.column for each in told]
    assert any(words in each.message for each in told)
    assert found.trace is None


def test_what_is_perhaps_not_meant_is_told_and_taken() -> None:
    found = checked(TEXT, mapped(("a", "Main.n", "input"), ("b", "Main.speed", "output")), program_of(LINE))
    assert found.ok
    assert [(each.column, each.warning) for each in found.problems] == [("a", True), ("b", True)]
    assert "never writes `Main.speed`" in found.problems[1].message


def test_times_count_from_the_start_or_from_the_first_row() -> None:
    program = program_of(LINE)
    for text, first, last, cold in (
        ("time [ms],lamp\n0,1\n10,1\n", 0, 1, True),
        ("time [ms],lamp\n50,1\n60.4,1\n", 5, 6, False),
        ("time [ms],lamp\n1234.5,1\n1244.5,1\n", 1, 2, False),
        ("time,lamp\nT#20ms,1\nT#30ms,1\n", 2, 3, False),
    ):
        table = read_trace(text.encode(), "t.csv")
        found = check(table, propose(table, program), program)
        assert found.trace is not None, found.problems
        assert (found.first, found.last, found.trace.scans.cold) == (first, last, cold)


def test_gaps_are_taken_when_the_mapping_says_how() -> None:
    table = read_trace(b"scan,lamp\n3,1\n9,1\n", "t.csv")
    for gaps in ("hold", "skip"):
        mapping = replace(propose(table, program_of(LINE)), gaps=gaps)
        found = check(table, mapping, program_of(LINE))
        assert (found.ok, found.first, found.last, found.missing) == (True, 3, 9, 5)


def test_mappings_are_kept_as_json() -> None:
    mapping = TraceMapping("scan", "scan", "hold", (ColumnMap("Füller", "Main.go", "input"), ColumnMap("b")))
    assert TraceMapping.from_json(mapping.to_json()) == mapping
    assert TraceMapping.from_json("{}") == TraceMapping()


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("[", "not JSON"),
        ("[]", "is an object"),
        ('{"axes": "x"}', "`axes` is unknown in a mapping"),
        ('{"gaps": "fill"}', "it may be refuse, skip, hold"),
        ('{"columns": {}}', "is a list"),
        ('{"columns": [1]}', "Column 0"),
        ('{"columns": [{"path": "x"}]}', "needs its name"),
        ('{"columns": [{"column": "x", "role": "both"}]}', "it may be input, output, ignore"),
    ],
)
def test_what_is_no_mapping(text: str, words: str) -> None:
    with pytest.raises(BadMapping, match=words):
        TraceMapping.from_json(text)


def test_a_saved_mapping_fits_files_with_the_same_columns() -> None:
    mapping = mapped(("a", "Main.go", "input"), ("b", "Main.lamp", "output"), ("c", "", "ignore"))
    fitting = {
        "scan,a,b\n0,1,1\n": True,
        "b,c,a,scan\n0,1,1,1\n": True,
        "scan,a\n0,1\n": False,
        "scan,a,b,d\n0,1,1,1\n": False,
    }
    for text, fit in fitting.items():
        assert fits(mapping, read_trace(text.encode(), "t.csv")) is fit


@pytest.mark.parametrize(
    ("type", "text", "value"),
    [
        ("BOOL", "true", 1),
        ("INT", "-7", -7),
        ("INT", "42.0", 42),
        ("INT", "16#7F", 127),
        ("WORD", "65535", 65535),
        ("TIME", "T#1s500ms", 1_500_000_000),
        ("DATE", "86400000000000", 86_400_000_000_000),
        ("DATE", "D#1970-01-02", 86_400_000_000_000),
    ],
)
def test_cells(type: str, text: str, value: int) -> None:
    known = ELEMENTARY[type]
    assert cell_value(known, text, None, comma=False) == value.to_bytes(known.size, "little", signed=value < 0)


def test_cells_with_units_commas_and_texts() -> None:
    assert cell_value(ELEMENTARY["TIME"], "1,5", "s", comma=True) == (1_500_000_000).to_bytes(8, "little")
    assert cell_value(ELEMENTARY["REAL"], "1,5", None, comma=True) == struct.pack("<f", 1.5)
    assert math.isnan(struct.unpack("<f", cell_value(ELEMENTARY["REAL"], "nan", None, comma=False))[0])
    assert cell_value(StringType(5), "ab", None, comma=False) == b"\2\0ab".ljust(StringType(5).size, b"\0")
    assert cell_value(StringType(5), "''", None, comma=False) == bytes(StringType(5).size)


@pytest.mark.parametrize(
    ("texts", "one", "other", "same"),
    [
        (["1.23457", "0.5"], 1.23457, 1.2345678, True),
        (["1.23457", "0.5"], 1.23457, 1.23459, False),
        (["20.0", "20.5"], 20.5, 20.54, True),
        (["20.0", "20.5"], 20.5, 20.56, False),
        (["20", "20.5"], 20.5, 20.54, True),
        (["20", "20.5"], 20.5, 20.56, False),
        (["", "99.98", "1.21", "", "12.34"], 99.98, 99.9849, True),
        (["", "99.98", "1.21", "", "12.34"], 1.21, 1.2149, True),
        (["", "99.98", "1.21", "", "12.34"], 12.34, 12.3451, False),
        (["1.5", "12.34"], 1.5, 1.5049, True),
        (["1.5e-3", "2"], 0.0015, 0.00154, True),
        (["1.5e-3", "2"], 0.0015, 0.00156, False),
        (["20", "21"], 20.0, 20.01, False),
        (["1.234567891"], 1.5, 1.50001, False),
        (["0", "1e-9"], 0.0, 1e-9, False),
        (["0"], 0.0, -0.0, True),
        (["1"], 1.0, float("nan"), False),
        (["NaN"], float("nan"), float("nan"), True),
        (["INF"], float("inf"), float("-inf"), False),
    ],
)
def test_reals_are_compared_in_the_digits_of_their_column(
    texts: list[str], one: float, other: float, same: bool
) -> None:
    type = ELEMENTARY["LREAL"]
    exact = exactness(type, texts, None)
    assert exact.same(type, struct.pack("<d", one), struct.pack("<d", other)) is same
    assert exact.same(type, struct.pack("<d", other), struct.pack("<d", one)) is same


def test_all_else_is_compared_exactly() -> None:
    assert not exactness(ELEMENTARY["INT"], ["1"], None).same(ELEMENTARY["INT"], b"\1\0", b"\2\0")
    assert exactness(StringType(4), ["a"], None).same(StringType(4), b"\1\0a", b"\1\0aXYZ")
    assert not exactness(StringType(4), ["a"], None).same(StringType(4), b"\1\0a", b"\2\0ab")
    seconds = exactness(ELEMENTARY["TIME"], ["1.5"], "s")
    type = ELEMENTARY["TIME"]
    assert seconds.same(type, (1_500_000_000).to_bytes(8, "little"), (1_500_000_400).to_bytes(8, "little"))
    assert not seconds.same(type, (1_500_000_000).to_bytes(8, "little"), (1_500_100_000).to_bytes(8, "little"))
