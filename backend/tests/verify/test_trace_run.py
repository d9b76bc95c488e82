"""Verification against traces of controllers: our own runs as CSV; what differs in them is found at its scan and variable."""

from collections.abc import Iterable
from dataclasses import replace

import pytest

from scanbench.check.build import check_sources
from scanbench.engines.native.engine import NativeEngine
from scanbench.engines.sample import MAX_SIGNALS
from scanbench.program.program import Program
from scanbench.recording.reader import Unreadable
from scanbench.runtime.programs import Loaded
from scanbench.runtime.resource import Resource
from scanbench.runtime.write import Write
from scanbench.server.samples import Sample, samples
from scanbench.symbols.symbols import resolve
from scanbench.symbols.values import format_value
from scanbench.verify.contract import AT_END, BadRange, Mismatch, Row
from scanbench.verify.edits import BadEdit
from scanbench.verify.ranges import parse_range
from scanbench.verify.trace.mapping import BadMapping, Gaps, TraceMapping
from scanbench.verify.trace.monitor import EVERY
from scanbench.verify.trace.propose import propose
from scanbench.verify.trace.read import read_trace
from scanbench.verify.trace.subject import open_trace
from scanbench.verify.verifier import Verifier
from tests.amounts import slow
from tests.caseformat import MODELS
from tests.verify.trace_parts import conveyor, conveyor_csv, exported, leaves, program_of, with_cell


def opened(text: str, program: Program, range: str = "", gaps: Gaps = "refuse", limit: int = 4096) -> Verifier:
    mapping = propose(read_trace(text.encode(), "trace.csv"), program).mapping
    verifier = open_trace(text.encode(), "trace.csv", replace(mapping, gaps=gaps).to_json(), program)
    verifier.begin(parse_range(range), limit)
    return verifier


def verified(verifier: Verifier, scans: Iterable[int] | None = None) -> list[Row]:
    scans = range(verifier.first, verifier.end) if scans is None else scans
    return [row for scan in scans for row in verifier.verify(scan).rows]


def found(rows: Iterable[Row]) -> list[tuple[int, str, str]]:
    return [(row.scan, each.cause, each.name) for row in rows for each in row.differences]


# ---- the conveyor ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("range", ["", "Main", "Main:15-22", "Belt", "Buffer", "PartCounter"])
def test_our_own_export_has_no_difference(range: str) -> None:
    rows = verified(opened(conveyor_csv(), conveyor(), range))
    assert len(rows) == 300
    assert found(rows) == []
    if not range:
        assert all(row.outputs["motor"].control == row.outputs["motor"].monitor for row in rows)
        assert {row.outputs["motor"].control for row in rows} == {b"\0", b"\1"}
        assert {row.inputs["start"].recorded for row in rows} == {b"\0", b"\1"}


@pytest.mark.parametrize(
    "sample",
    [pytest.param(each, marks=slow if each.name == "Filling" else []) for each in samples()],
    ids=[each.name for each in samples()],
)
def test_no_variable_of_any_sample_differs(sample: Sample) -> None:
    program = check_sources(sample.files, MODELS[sample.model]).program
    assert program is not None
    names = leaves(program)
    assert names
    for at in range(0, len(names), MAX_SIGNALS):
        text = exported(program, names[at : at + MAX_SIGNALS], 0, 120, {})
        assert found(verified(opened(text, program))) == []


@pytest.mark.parametrize(
    ("column", "name", "scan", "value", "file", "line"),
    [
        ("lamp", "lamp", 100, "1", "Main.st", 21),
        ("motor", "motor", 299, "0", "Main.st", 24),
        ("partsTotal", "partsTotal", 0, "9", "Main.st", 27),
        ("Main.uptime [s]", "Main.uptime", 42, "0.43", "Main.st", 14),
    ],
)
def test_one_changed_cell_is_found_at_its_scan_and_variable(
    column: str, name: str, scan: int, value: str, file: str, line: int
) -> None:  # fmt: skip
    rows = verified(opened(with_cell(conveyor_csv(), scan, column, value), conveyor()))
    assert found(rows) == [(scan, "logic", name)]
    difference = next(row for row in rows if row.differs).differences[0]
    assert difference.place is not None
    assert (difference.place.file, difference.place.line, difference.place.task) == (file, line, "Cyclic")
    assert f"in scan {scan}" in difference.message


def test_state_of_the_program_is_taken_over_where_it_differed() -> None:
    """The level was 33 instead of 21 in one scan of the trace: that scan differs, and so does the one that was right again."""
    text = with_cell(conveyor_csv(), 60, "bufferLevel", "33")
    rows = verified(opened(text, conveyor(), "Buffer"))
    assert found(rows) == [(60, "logic", "level"), (61, "logic", "level")]
    assert found(verified(opened(text, conveyor()))) == [(60, "logic", "bufferLevel"), (61, "logic", "bufferLevel")]


def test_a_wrong_input_gives_a_different_result() -> None:
    """The controller saw no stop button: its trace says that it was pressed, and went on."""
    text = conveyor_csv()
    for scan in (160, 161, 162):
        text = with_cell(text, scan, "stop", "0")
    rows = verified(opened(text, conveyor()))
    assert found(rows)[0] == (160, "logic", "motor")


def test_scans_in_any_order_are_the_same() -> None:
    text = with_cell(conveyor_csv(), 250, "lamp", "1")
    forwards = opened(text, conveyor())
    rows = {row.scan: row for row in verified(forwards)}
    jumping = opened(text, conveyor())
    assert EVERY < 250
    for scan in (250, 10, 299, 251, 0, 205, 250):
        assert jumping.verify(scan).rows == (rows[scan],)


def test_a_trace_from_the_middle_of_a_run_is_taken_over_first() -> None:
    """What the program remembers and the trace has goes on; so a program without other memory has no difference."""
    program = program_of(COUNTER)
    for first in (0, 7):
        verifier = opened(trace_of(program, ["Main.go", "Main.n", "Main.total"], 30, GO, first), program)
        rows = verified(verifier)
        assert found(rows) == []
        assert ("taken over" in rows[0].note) is (first > 0)
        begun = verifier.begin(parse_range(""))
        assert ("begins in the middle" in begun.note) is (first > 0)
        assert (begun.first, begun.end) == (first, 30)


# ---- what a program may do ------------------------------------------------------------------------------------------

COUNTER = """
FUNCTION_BLOCK Adder
VAR_INPUT by : INT; END_VAR
VAR_IN_OUT sum : INT; END_VAR
  sum := sum + by;
END_FUNCTION_BLOCK
PROGRAM Main
VAR go : BOOL; n, total, i : INT; one, two : Adder; text : STRING[10]; speed : REAL; END_VAR
  IF go THEN
    one(by := 1, sum := n);
    two(by := 2, sum := total);
  END_IF;
  FOR i := 1 TO 3 DO
    speed := speed + 0.1;
  END_FOR;
  IF n = 5 THEN text := 'five'; END_IF;
END_PROGRAM
"""
GO = {3: {"Main.go": "1"}, 12: {"Main.go": "0"}}


def trace_of(
    program: Program, signals: list[str], scans: int, writes: dict[int, dict[str, str]], first: int = 0, every: int = 1
) -> str:  # fmt: skip
    """A native run as a file, one value a signal a scan, as text that the watch table shows."""
    resource = Resource(Loaded.make(program, NativeEngine))
    lines = [";".join(["scan", *signals])]
    for scan in range(scans):
        for path, value in writes.get(scan, {}).items():
            resource.submit(Write("Ada", path, value))
        resource.run(1)
        cells = []
        for signal in signals:
            symbol = resolve(program, signal)
            offset, bit = symbol.locate(resource.memory) or (0, None)
            data = bytes(resource.memory[offset : offset + symbol.type.size])
            cells.append(format_value(symbol.type, data if bit is None else bytes((data[0] >> bit & 1,))))
        if scan >= first and scan % every == 0:
            lines.append(";".join([str(scan), *cells]))
    return "\n".join(lines) + "\n"


ALL = ["Main.go", "Main.n", "Main.total", "Main.text", "Main.speed"]


def test_a_block_called_several_times_has_a_row_for_each_call() -> None:
    program = program_of(COUNTER)
    text = trace_of(program, ALL, 20, GO)
    rows = verified(opened(text, program, "Adder"))
    assert found(rows) == []
    assert [(row.kind, row.note) for row in rows[:3]] == 3 * [("none", "not run in this scan")]
    assert [(row.call, row.instance) for row in rows[3:5]] == [(1, "Main.one"), (2, "Main.two")]
    assert rows[3].outputs["sum"].control == rows[3].outputs["sum"].monitor == b"\1\0"
    assert rows[4].outputs["sum"].control == b"\2\0"
    assert rows[3].inputs["by"].recorded == b"\1\0"


def test_a_difference_is_in_the_row_of_the_call_that_wrote_it() -> None:
    program = program_of(COUNTER)
    text = trace_of(program, ALL, 20, GO).replace("\n8;TRUE;6;12;", "\n8;TRUE;6;13;")
    rows = [row for row in verified(opened(text, program, "Adder")) if row.differs]
    assert (rows[0].scan, rows[0].call, rows[0].differences[0].name) == (8, 2, "sum")
    assert rows[0].differences[0].message == "Main.total is 13, the reference gives 12, at Main.st:5 in scan 8"
    place = rows[0].differences[0].place
    assert place is not None
    assert place.instance == "Main.two"


def test_strings_and_reals() -> None:
    program = program_of(COUNTER)
    text = trace_of(program, ALL, 20, GO)
    assert "'five'" in text
    assert found(verified(opened(text, program))) == []
    assert found(verified(opened(text.replace("'five'", "'fife'"), program)))[0] == (7, "logic", "Main.text")
    line = next(each for each in text.splitlines() if each.startswith("9;"))
    speed = line.rpartition(";")[2]
    rows = verified(opened(text.replace(line, line.replace(speed, "3.1")), program))
    assert found(rows)[0] == (9, "logic", "Main.speed")


def test_a_branch_that_is_not_taken_and_a_loop() -> None:
    program = program_of(COUNTER)
    text = trace_of(program, ALL, 20, GO)
    rows = verified(opened(text, program, "Main:10-11"))
    assert [row.kind for row in rows[:4]] == ["none", "none", "none", "pass"]
    rows = verified(opened(text, program, "Main:13-15"))
    assert [row.kind for row in rows] == 20 * ["pass"]
    assert "speed" in {name.removeprefix("Main.") for name in rows[0].outputs}


def test_a_full_record_says_so() -> None:
    program = program_of(COUNTER)
    text = trace_of(program, ALL, 5, GO)
    row = opened(text, program, limit=4).verify(4).rows[0]
    assert row.note.startswith("record full: 4 of ")
    assert row.used > 4
    assert found([row]) == []


def test_a_plant_does_not_get_in_the_way_of_recorded_inputs() -> None:
    sources = {
        "Main.st": "PROGRAM Main VAR go AT CIO 0.00 : BOOL; seen : INT; END_VAR IF go THEN seen := seen + 1; END_IF; END_PROGRAM",
        "plant/P.st": "PROGRAM P VAR button AT CIO 0.00 : BOOL; END_VAR button := FALSE; END_PROGRAM",
    }
    program = check_sources(sources, MODELS["CJ1M-CPU63"]).program
    assert program is not None
    text = "scan,0.00,Main.seen\n0,0,0\n1,1,1\n2,1,2\n3,0,2\n"
    assert found(verified(opened(text, program))) == []
    assert found(verified(opened(text.replace("2,1,2", "2,0,2"), program))) == [(2, "logic", "Main.seen")]
    step = opened(text, program).step(2, 0).rows[0]
    assert (step.kind, step.count, step.place) == ("step", 1, None)
    assert step.next is not None


def test_a_run_time_error_of_the_reference_is_a_difference_and_the_trace_goes_on() -> None:
    program = program_of("PROGRAM Main VAR n, by : INT; END_VAR n := 100 / by; END_PROGRAM")
    rows = verified(opened("scan,Main.by,Main.n\n0,5,20\n1,0,20\n2,4,25\n3,4,26\n", program))
    assert found(rows) == [(1, "trap", ""), (3, "logic", "Main.n")]
    assert "ended by a run-time error" in rows[1].note
    assert rows[1].differences[0].place is not None


# ---- gaps -----------------------------------------------------------------------------------------------------------


def test_gaps_are_run_with_inputs_held_or_skipped() -> None:
    program = program_of(COUNTER)
    lines = trace_of(program, ["Main.go", "Main.n", "Main.total"], 30, GO).splitlines()
    text = "\n".join(each for each in lines if not 5 <= int("0" + each.split(";")[0].replace("scan", "")) <= 8) + "\n"
    rows = verified(opened(text, program, gaps="hold"))
    assert found(rows) == []
    assert [row.note for row in rows[5:9]] == 4 * ["not in the trace: inputs held"]
    assert [row.compared for row in rows] == [True] * 5 + [False] * 4 + [True] * 21
    assert rows[5].outputs["Main.n"].control is None
    rows = verified(opened(text, program, gaps="skip"))
    assert found(rows) == []
    assert [row.scan for row in rows] == [*range(6), *range(9, 30)]
    assert (rows[5].kind, rows[5].note) == ("none", "scans 5 to 8 are not in the trace: skipped")
    assert "taken over" in rows[6].note
    assert [row.compared for row in rows] == [True] * 5 + [False] * 2 + [True] * 20
    verifier = opened(text, program, gaps="skip")
    assert [verifier.verify(scan).compared for scan in range(4, 11)] == [True] + [False] * 5 + [True]
    assert opened(text, program, gaps="skip").verify(20).rows == (rows[17],)
    late = text.replace("\n20;FALSE;9;18\n", "\n20;FALSE;9;17\n")
    assert late != text
    assert found(verified(opened(late, program, gaps="skip")))[0] == (20, "logic", "Main.total")


def test_cells_without_a_value() -> None:
    """An input stays as it was; an output is not compared."""
    program = program_of(COUNTER)
    text = "scan,Main.go,Main.n\n0,1,1\n1,,2\n2,,\n3,0,3\n4,,3\n"
    rows = verified(opened(text, program))
    assert found(rows) == []
    assert rows[2].outputs["Main.n"].control is None
    assert [row.compared for row in rows] == [True, True, False, True, True]
    assert "no value to compare" in rows[2].note
    assert found(verified(opened(text.replace("2,,\n", "2,,4\n"), program)))[0] == (2, "logic", "Main.n")


def test_a_real_column_is_compared_in_the_decimals_of_the_file() -> None:
    """Cells without a value say nothing of the decimals."""
    program = program_of(
        "PROGRAM Main VAR raw : INT; level : REAL; END_VAR level := INT_TO_REAL(raw) / 7.0; END_PROGRAM"
    )
    lines = [f"{scan},{scan},{'' if scan == 3 else format(scan / 7, '.2f')}\n" for scan in range(5, 60)]
    text = "scan,Main.raw,Main.level\n0,1,0.14\n1,2,\n2,3,0.43\n3,4,0.57\n4,4,0.57\n" + "".join(lines)
    assert found(verified(opened(text, program))) == []
    assert found(verified(opened(text.replace("4,4,0.57", "4,4,0.58"), program))) == [(4, "logic", "Main.level")]


def test_a_range_that_did_not_run_was_not_compared() -> None:
    program = program_of(COUNTER)
    verifier = opened(trace_of(program, ["Main.go", "Main.n"], 5, GO), program, "Adder")
    assert [verifier.verify(scan).compared for scan in range(5)] == [False] * 3 + [True] * 2


# ---- questions ------------------------------------------------------------------------------------------------------


def test_set_data_changes_a_prime_on_set_data_only() -> None:
    program = program_of(COUNTER)
    verifier = opened(trace_of(program, ALL, 20, GO), program, "Adder")
    before = verifier.verify(6).rows
    rows = verifier.set_inputs([(6, 2, "by", "10")])
    assert len(rows) == 1
    row = rows[0]
    assert (row.scan, row.call) == (6, 2)
    assert row.inputs["by"].set == b"\x0a\0"
    assert row.outputs["sum"].set == (6 + 10).to_bytes(2, "little")
    assert (row.outputs["sum"].control, row.outputs["sum"].monitor) == (b"\x08\0", b"\x08\0")
    assert row.differences == ()
    assert verifier.verify(6).rows == (before[0], row)
    assert found(verified(verifier)) == []
    assert verifier.set_inputs([(6, 2, "by", "")]) == (before[1],)
    assert verifier.verify(6).rows == before


def test_set_data_of_the_whole_scan() -> None:
    verifier = opened(conveyor_csv(), conveyor())
    row = verifier.set_inputs([(100, 0, "stop", "TRUE")])[0]
    assert (row.outputs["motor"].monitor, row.outputs["motor"].set) == (b"\1", b"\0")
    assert verifier.verify(101).rows[0].outputs["motor"].monitor == b"\1"


@pytest.mark.parametrize(
    ("edit", "words"),
    [
        ((6, 2, "bye", "10"), "Did you mean `by`?"),
        ((6, 2, "by", "ten"), "`ten` is not INT"),
        ((6, 3, "by", "10"), "no run 3"),
        ((99, 1, "by", "10"), "not in the trace"),
    ],
)
def test_bad_edits_change_nothing(edit: tuple[int, int, str, str], words: str) -> None:
    program = program_of(COUNTER)
    verifier = opened(trace_of(program, ALL, 20, GO), program, "Adder")
    before = verifier.verify(6).rows
    with pytest.raises(BadEdit, match=words.replace("?", r"\?")):
        verifier.set_inputs([(6, 1, "by", "5"), edit])
    assert verifier.verify(6).rows == before


def test_uses_are_in_order_with_both_sides_where_the_trace_has_any() -> None:
    program = program_of(COUNTER)
    verifier = opened(trace_of(program, ALL, 20, GO), program, "Adder")
    uses = verifier.uses(6, 2)
    assert [(each.name, each.written) for each in uses] == [("sum", False), ("by", False), ("sum", True)]
    assert (uses[2].control, uses[2].monitor) == (b"\x08\0", b"\x08\0")
    assert uses[1].control is None
    assert (uses[0].place.instance, uses[0].place.line) == ("Main.two", 5)
    assert verifier.verify(7).scan == 7


def test_step_by_step() -> None:
    text = with_cell(conveyor_csv(), 100, "lamp", "1")
    verifier = opened(text, conveyor())
    begin = verifier.step(100, 0).rows[0]
    assert (begin.kind, begin.place, begin.count) == ("step", None, 1)
    first = verifier.step(100, 1).rows[0]
    assert first.place is not None
    assert (first.next and first.next.line, first.count) == (15, 2)
    assert (first.place.file, first.place.line) == ("Main.st", 14)
    end = verifier.step(100, 2, AT_END).rows[0]
    assert end.note == "end of the scan"
    assert found([end]) == [(100, "logic", "lamp")]
    assert found(verifier.verify(100).rows) == [(100, "logic", "lamp")]


def test_what_is_not_there() -> None:
    verifier = opened(conveyor_csv(), conveyor())
    with pytest.raises(Unreadable, match="scans 0 to 299"):
        verifier.verify(300)
    with pytest.raises(BadRange):
        verifier.begin(parse_range("Blet"))
    with pytest.raises(BadMapping, match="`strat`"):
        open_trace(b"scan,strat\n0,1\n", "t.csv", TraceMapping.from_json('{"axis":"scan","columns":[{"column":"strat","role":"output"}]}').to_json(), conveyor())  # fmt: skip


def test_mismatches_are_complete() -> None:
    rows = verified(opened(with_cell(conveyor_csv(), 10, "partsTotal", "5"), conveyor()))
    assert [each for row in rows for each in row.differences] == [
        Mismatch(
            "logic", "partsTotal", b"\5\0", b"\1\0", rows[10].differences[0].place,
            "partsTotal is 5, the reference gives 1, at Main.st:27 in scan 10", "INT", "int", 2,
        )
    ]  # fmt: skip


OWN_FIRST = """
PROGRAM Main
VAR go, motor, other, unseen : BOOL; n, limit : INT; END_VAR
  unseen := NOT unseen; n := n + limit; other := NOT other; motor := go;
END_PROGRAM
"""


@pytest.mark.parametrize("range", ["", "Main"])
def test_what_the_log_has_comes_before_what_only_the_reference_has(range: str) -> None:
    verifier = opened("scan;Main.go;Main.motor\n0;0;0\n1;1;1\n", program_of(OWN_FIRST), range)
    came = [verifier.verify(scan) for scan in (0, 1)]
    assert came[0].columns[0].name == came[0].outputs[0] == "Main.motor"
    assert came[0].inputs[0] == "Main.go"
    assert len(came[0].outputs) == 4
