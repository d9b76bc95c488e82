"""Scans of rows by their times: clocks, jitter, several tasks; and what an output may differ by."""

from dataclasses import replace
from decimal import Decimal

import pytest

from scanbench.verify.contract import Row
from scanbench.verify.ranges import parse_range
from scanbench.verify.trace.bind import Checked, check
from scanbench.verify.trace.clock import seconds
from scanbench.verify.trace.mapping import BadMapping, ColumnMap, TraceMapping
from scanbench.verify.trace.propose import propose
from scanbench.verify.trace.read import read_trace
from scanbench.verify.trace.subject import TraceSubject
from scanbench.verify.verifier import Verifier
from tests.verify.trace_parts import program_of

COUNT = """
PROGRAM Main
VAR go AT CIO 0.00 : BOOL; lamp AT CIO 100.00 : BOOL; n : INT; slow : REAL; END_VAR
  IF go THEN n := n + 1; END_IF;
  lamp := n >= 3;
  slow := slow + 0.1;
END_PROGRAM
"""


def proposed(text: str) -> TraceMapping:
    return propose(read_trace(text.encode(), "t.csv"), program_of(COUNT)).mapping


def checked(text: str, mapping: TraceMapping | None = None) -> Checked:
    program = program_of(COUNT)
    table = read_trace(text.encode(), "t.csv")
    return check(table, mapping or propose(table, program).mapping, program)


def scans(text: str) -> tuple[int, ...]:
    found = checked(text)
    assert found.trace is not None, found.problems
    return tuple(found.trace.scans.of_rows)


def rows_of(text: str, mapping: TraceMapping) -> list[Row]:
    found = checked(text, mapping)
    assert found.trace is not None, found.problems
    verifier = Verifier(TraceSubject(program_of(COUNT), found.trace))
    verifier.begin(parse_range(""))
    return [row for scan in range(verifier.first, verifier.end) for row in verifier.verify(scan).rows]


def differing(rows: list[Row]) -> list[tuple[int, str]]:
    return [(row.scan, each.name) for row in rows for each in row.differences]


# ---- times ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("texts", "expected"),
    [
        (("2026-11-28 23:59:59.99", "2026-11-29T00:00:00.01"), "0.02"),
        (("28.11.2026 10:00:00,5", "28.11.2026 10:00:01,75"), "1.25"),
        (("12/31/2026 11:59:59 PM", "1/1/2027 12:00:00 AM"), "1"),
        (("10:15:20;125", "10:15:20;135"), "0.010"),
        (("23:59:59.995", "00:00:00.005"), "0.010"),
        (("DT#2026-11-28-10:00:00", "DT#2026-11-28-10:00:00.1"), "0.1"),
        (("2026/11/28 10:00:00.1Z", "2026/11/28 10:00:00.2Z"), "0.1"),
    ],
)
def test_clocks(texts: tuple[str, str], expected: str) -> None:
    assert seconds(texts)[1] == Decimal(expected)


@pytest.mark.parametrize("text", ["noon", "25:00:00", "10:61:00", "2026-13-45 10:00:00", "2026-11-28", ""])
def test_what_is_no_clock(text: str) -> None:
    with pytest.raises(ValueError, match="no date and time of day"):
        seconds([text])


def test_times_with_jitter_are_the_scans_that_are_nearest() -> None:
    assert scans("time [ms],lamp\n101,0\n112,0\n119,0\n131,0\n139,0\n") == (10, 11, 12, 13, 14)
    assert scans("time [ms],lamp\n104,0\n114,0\n121,0\n133,0\n141,0\n") == (1, 2, 3, 4, 5)
    assert scans("time [ms],lamp\n0,0\n12,0\n19,0\n32,0\n") == (0, 1, 2, 3)


def test_a_clock_that_runs_a_little_fast_is_followed() -> None:
    text = "time [ms],lamp\n" + "".join(f"{5 + 10.02 * row:.2f},0\n" for row in range(2000))
    assert scans(text) == tuple(range(1, 2001))


def test_clock_times_are_found_and_count_from_the_first_row() -> None:
    text = "Time,lamp\n2026-11-28 10:00:00.000,0\n2026-11-28 10:00:00.010,0\n2026-11-28 10:00:00.020,0\n"
    assert proposed(text).unit == "s"
    found = checked(text)
    assert found.trace is not None
    assert (found.first, found.trace.scans.cold) == (1, False)


def test_rows_of_several_tasks_become_one() -> None:
    assert scans("time [ms];variable;value\n0;lamp;0\n1;n;0\n10;lamp;0\n11;n;0\n21;n;0\n20;lamp;0\n") == (0, 1, 2)


def test_an_interval_that_is_not_the_controllers_is_one_message() -> None:
    text = "time [ms],n\n" + "".join(f"{4 * row},{row}\n" for row in range(500))
    assert [(each.column, each.message) for each in checked(text).problems if not each.warning] == [
        (
            "time [ms]",
            "The rows are 4 ms apart, but the program's interval is 10 ms: give the task the interval that it has in the controller.",
        )
    ]


def test_a_recorder_that_takes_every_tenth_scan_holds_the_inputs() -> None:
    text = "time [ms],lamp,go\n" + "".join(f"{100 * row},0,0\n" for row in range(20))
    assert proposed(text).gaps == "hold"
    assert proposed(text.replace("\n1900,0,0", "\n1810,0,0")).gaps == "hold"


def test_a_cause_is_one_problem_however_many_rows_have_it() -> None:
    text = "scan,go,lamp\n" + "".join(f"{2 * row},maybe{row},1\n" for row in range(300))
    told = [
        (each.column, each.more, each.last) for each in checked(text, replace(proposed(text), gaps="refuse")).problems
    ]
    assert told == [("scan", 298, 301), ("go", 299, 301)]


# ---- gaps -----------------------------------------------------------------------------------------------------------


def test_what_was_not_compared_is_never_without_a_difference() -> None:
    """Every row is after a gap, so its values are believed: nothing is compared, whatever they are."""
    text = "scan,go,n\n" + "".join(f"{10 * row},0,{row}\n" for row in range(20))
    rows = rows_of(text, replace(proposed(text), gaps="skip"))
    assert differing(rows) == []
    assert [row.scan for row in rows if row.compared] == [0]
    later = text.replace("\n0,0,0", "")
    assert not any(row.compared for row in rows_of(later, replace(proposed(later), gaps="skip")))


# ---- what may differ ------------------------------------------------------------------------------------------------

LOG = "scan,go,lamp,n,slow\n0,1,0,1,0.1\n1,1,0,2,0.2\n2,1,1,3,0.3\n3,1,1,4,0.4\n4,1,1,5,0.5\n"


def with_tolerance(column: str, **within: float) -> TraceMapping:
    made = proposed(LOG)
    columns = tuple(replace(each, **within) if each.column == column else each for each in made.columns)  # type: ignore[arg-type]
    return replace(made, columns=columns)


@pytest.mark.parametrize(
    ("text", "column", "within", "found"),
    [
        ("3,1,1,4,0.42", "slow", {}, [(3, "Main.slow"), (4, "Main.slow")]),
        ("3,1,1,4,0.42", "slow", {"absolute": 0.02}, []),
        ("3,1,1,4,0.42", "slow", {"absolute": 0.01}, [(3, "Main.slow"), (4, "Main.slow")]),
        ("3,1,1,4,0.42", "slow", {"relative": 0.05}, []),
        ("3,1,1,5,0.4", "n", {"absolute": 1.0}, []),
        ("3,1,1,6,0.4", "n", {"absolute": 1.0}, [(3, "Main.n")]),
        ("3,1,0,4,0.4", "lamp", {"absolute": 5.0}, [(3, "Main.lamp")]),
    ],
)
def test_an_output_may_differ_by_what_somebody_chose(
    text: str, column: str, within: dict[str, float], found: list[tuple[int, str]]
) -> None:
    log = LOG.replace("3,1,1,4,0.4", text)
    rows = rows_of(log, with_tolerance(column, **within))
    assert differing(rows)[:1] == found[:1]
    assert any("within the tolerance" in row.note for row in rows) is (not found)


LATE = "scan,go,lamp\n" + "".join(f"{scan},{int(scan < 8)},{int(scan >= 2)}\n" for scan in range(20))


@pytest.mark.parametrize(
    ("wrong", "late_ms", "found"),
    [
        ({2: "0"}, 0.0, [2]),
        ({2: "0"}, 10.0, []),
        ({2: "0", 3: "0"}, 10.0, [2]),
        ({2: "0", 3: "0"}, 20.0, []),
        ({1: "1"}, 10.0, []),
        ({0: "1", 1: "1"}, 20.0, [0]),
        ({1: "1"}, 0.0, [1]),
        ({12: "0"}, 30.0, [12]),
        (dict.fromkeys(range(2, 20), "0"), 30.0, [2]),
    ],
)
def test_an_output_may_come_earlier_or_later(wrong: dict[int, str], late_ms: float, found: list[int]) -> None:
    """A pulse that the reference does not have, and an edge that never comes, are differences whatever the tolerance is."""
    log = LATE
    for scan, value in wrong.items():
        log = log.replace(f"\n{scan},{int(scan < 8)},{int(scan >= 2)}\n", f"\n{scan},{int(scan < 8)},{value}\n")
    made = proposed(log)
    mapping = replace(
        made, columns=tuple(replace(each, late_ms=late_ms) if each.column == "lamp" else each for each in made.columns)
    )
    rows = rows_of(log, mapping)
    assert [scan for scan, _ in differing(rows)][:1] == found
    again = [row for row in rows_of(log, mapping) if row.scan == 5]
    assert again == [row for row in rows if row.scan == 5]


def test_samples_before_the_program_have_the_outputs_of_the_scan_before() -> None:
    log = "scan,go,n\n" + "".join(f"{scan},1,{scan}\n" for scan in range(10))
    made = proposed(log)
    assert differing(rows_of(log, made))[0] == (0, "Main.n")
    rows = rows_of(log, replace(made, sampled="begin"))
    assert differing(rows) == []
    assert [row.compared for row in rows] == [True] * 9 + [False]


@pytest.mark.parametrize(
    "text", ['"absolute": -1', '"relative": 2', '"late_ms": "x"', '"late_ms": 1e9', '"absolute": true']
)
def test_tolerances_that_are_none(text: str) -> None:
    with pytest.raises(BadMapping, match="it may be a number from 0"):
        TraceMapping.from_json(f'{{"columns": [{{"column": "x", {text}}}]}}')


# ---- names ----------------------------------------------------------------------------------------------------------

NESTED = """
FUNCTION_BLOCK Valve VAR_INPUT open : BOOL; END_VAR VAR_OUTPUT position : REAL; END_VAR position := BOOL_TO_REAL(open); END_FUNCTION_BLOCK
PROGRAM Main
VAR valve : ARRAY[1..2] OF Valve; start : BOOL; partsTotal : INT; level : REAL; END_VAR
  valve[1](open := start); valve[2](open := NOT start); partsTotal := partsTotal + 1; level := valve[1].position;
END_PROGRAM
"""


@pytest.mark.parametrize(
    ("column", "path"),
    [
        ("Application.PLC_PRG.valve[2].position", "Main.valve[2].position"),
        ("PLC1/Main/fbValve[1]/rPosition", "Main.valve[1].position"),
        ('"DB_Line"."bStart"', "Main.start"),
        ("GVL.start", "Main.start"),
        ("MAIN.nPartsTotal", "Main.partsTotal"),
        ("Parts_Total [pcs]", "Main.partsTotal"),
        ("Line.part_total", "Main.partsTotal"),
        ("x.position", ""),
        ("sped", ""),
        ("Main.valve[3].position", ""),
    ],
)
def test_what_is_alike_is_proposed_with_a_score(column: str, path: str) -> None:
    program = program_of(NESTED)
    table = read_trace(
        f"scan;{column.replace(chr(34), chr(34) * 2).join((chr(34), chr(34)))}\n0;1\n1;1\n".encode(), "t.csv"
    )
    made = propose(table, program)
    assert made.mapping.columns[0].path == path
    assert (made.guesses[0].score >= 0.7) is bool(path)


def test_two_columns_do_not_get_one_variable_and_values_have_to_fit() -> None:
    program = program_of(NESTED)
    table = read_trace(b"scan,a.start,b.start,c.level\n0,1,0,x\n1,1,0,x\n", "t.csv")
    assert [each.path for each in propose(table, program).mapping.columns] == ["Main.start", "", ""]


def test_what_was_mapped_before_is_mapped_so_again() -> None:
    program = program_of(NESTED)
    table = read_trace(b"scan,B7,start\n0,1,1\n", "t.csv")
    made = propose(table, program, {"B7": "Main.level", "start": "Main.valve[1].open"})
    assert made.mapping.columns == (
        ColumnMap("B7", "Main.level", "output"),
        ColumnMap("start", "Main.valve[1].open", "output"),
    )


# ---- what was compared ----------------------------------------------------------------------------------------------


def test_what_was_compared_is_counted_for_each_output() -> None:
    log = "scan,go,lamp,n,slow,remark\n3,1,0,1,0.4,x\n4,1,0,2,,x\n5,1,1,3,0.61,x\n6,1,1,5,0.7,x\n"
    made = proposed(log)
    columns = [replace(each, role="ignore") if each.column == "remark" else each for each in made.columns]
    columns = [replace(each, absolute=0.02) if each.column == "slow" else each for each in columns]
    found = checked(log, replace(made, columns=tuple(columns)))
    assert found.trace is not None, found.problems
    verifier = Verifier(TraceSubject(program_of(COUNT), found.trace))
    verifier.begin(parse_range(""))
    for scan in (3, 4, 5, 6, 5, 3):  # one that is looked at again counts once
        verifier.verify(scan)
    coverage = verifier.coverage
    assert coverage is not None
    counted = {each.path: (each.compared, each.differing, each.allowed, each.missing) for each in coverage.outputs}
    assert counted == {"Main.lamp": (3, 0, 0, 0), "Main.n": (3, 1, 0, 0), "Main.slow": (2, 0, 1, 1)}
    assert {each.path: round(each.largest, 3) for each in coverage.outputs}["Main.n"] == 1
    assert (coverage.inputs, coverage.ignored, coverage.unrecorded) == (("Main.go",), ("remark",), ())


def test_what_the_file_has_no_column_of_is_named() -> None:
    log = "scan,go,lamp\n3,1,0\n4,1,1\n5,1,1\n"
    found = checked(log)
    assert found.trace is not None
    verifier = Verifier(TraceSubject(program_of(COUNT), found.trace))
    verifier.begin(parse_range(""))
    for scan in (3, 4, 5):
        verifier.verify(scan)
    coverage = verifier.coverage
    assert coverage is not None
    assert set(coverage.unrecorded) == {"Main.n", "Main.slow"}
    assert set(coverage.remembered) == {"Main.n", "Main.slow"}


# ---- what the program remembers -------------------------------------------------------------------------------------

LATCH = """
TYPE Phase : (IDLE, FILL, DRAIN); END_TYPE
PROGRAM Main
VAR start, stop, motor, on : BOOL; count, shown, ramp : INT; phase : Phase; pump : BOOL; delay : TON; late : TIME; END_VAR
  on := (start OR on) AND NOT stop;
  motor := on;
  IF on THEN count := count + 1; END_IF;
  shown := count + 5;
  IF phase = DRAIN AND stop THEN phase := IDLE; END_IF;
  pump := phase = DRAIN;
  delay(IN := TRUE, PT := T#10s);
  late := delay.ET;
END_PROGRAM
"""


def latched(rows: str) -> tuple[list[tuple[int, str]], tuple[str, ...], str]:
    program = program_of(LATCH)
    table = read_trace(("scan,start,stop,motor,shown,pump,late [ms]\n" + rows).encode(), "t.csv")
    found = check(table, propose(table, program).mapping, program)
    assert found.trace is not None, found.problems
    verifier = Verifier(TraceSubject(program, found.trace))
    begun = verifier.begin(parse_range(""))
    rows_of_all = [row for scan in range(verifier.first, verifier.end) for row in verifier.verify(scan).rows]
    coverage = verifier.coverage
    assert coverage is not None
    return differing(rows_of_all), coverage.assumed, begun.note


def test_what_a_program_remembers_is_taken_from_the_second_row() -> None:
    rows = "".join(f"{scan},0,0,1,{scan + 60},1,{700 + 10 * scan}\n" for scan in range(50, 70))
    found, assumed, note = latched(rows)
    assert found == []
    assert {each.split(" = ")[0] for each in assumed} == {"Main.on", "Main.count", "Main.phase", "Main.delay.start"}
    assert "Main.on = TRUE" in assumed
    assert "Main.phase = DRAIN" in assumed
    assert "its first rows tell" in note


def test_a_fault_after_that_is_found_all_the_same() -> None:
    rows = "".join(f"{scan},0,0,{int(scan != 60)},{scan + 60},1,{700 + 10 * scan}\n" for scan in range(50, 70))
    assert latched(rows)[0] == [(60, "Main.motor")]


def test_a_cold_start_assumes_nothing() -> None:
    rows = "".join(f"{scan},0,0,1,0,0,{10 * scan}\n" for scan in range(5))
    found, assumed, note = latched(rows)
    assert [scan for scan, name in found if name == "Main.motor"] == [0, 1, 2, 3, 4]
    assert (assumed, note) == ((), "")
