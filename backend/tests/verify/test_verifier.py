"""Verification of runs: ranges, rows, differences, set data, steps; against the lines of "Must hold"."""

from itertools import pairwise
from pathlib import Path

import pytest

from scanbench.check.build import check_sources
from scanbench.engines.available import flavours
from scanbench.engines.debug import Listen
from scanbench.engines.engine import Pace, Reason, Stop
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.engine import NativeEngine
from scanbench.faults.disturb.definition import Disturbance
from scanbench.faults.disturb.disturb import Disturb
from scanbench.faults.disturb.schedule import DisturbanceSchedule
from scanbench.recording.headless import run_headless
from scanbench.recording.programs import on, reference
from scanbench.recording.reader import Unreadable
from scanbench.recording.recording import Recording
from scanbench.reports.value_text import value_text
from scanbench.runtime.command import Entry
from scanbench.runtime.inside import HaltAt
from scanbench.runtime.modes import SetMode
from scanbench.runtime.program_change import ProgramChange
from scanbench.runtime.programs import Loaded, LoadedPrograms
from scanbench.runtime.resource import Resource
from scanbench.runtime.restart import Restart
from scanbench.runtime.write import Write
from scanbench.server.samples import Sample, samples
from scanbench.symbols.names import Names
from scanbench.symbols.symbols import resolve
from scanbench.verify.contract import Range
from scanbench.verify.sentences import values
from scanbench.verify.verifier import BadEdit
from scanbench.wire.codec import ENTRIES
from tests.caseformat import MODELS
from tests.programs import INGREDIENTS, generate
from tests.programs.compare import checked
from tests.runtime.bench import program
from tests.verify.verified_runs import differences, opened, record, rows, verifier

SAMPLES = {sample.name: sample for sample in samples()}
BELTS = """\
TYPE Pair : STRUCT a : INT; b : LREAL; END_STRUCT END_TYPE
FUNCTION Twice : INT
VAR_INPUT x : INT; END_VAR
  Twice := x * 2;
END_FUNCTION
FUNCTION_BLOCK Belt
VAR_INPUT go : BOOL; END_VAR VAR_IN_OUT total : DINT; END_VAR VAR_OUTPUT pos : INT; pair : Pair; END_VAR VAR name : STRING[8]; i : INT; END_VAR
  IF go THEN
    pos := pos + Twice(3);
    total := total + 1;
  END_IF;
  FOR i := 1 TO 3 DO
    pair.b := pair.b + 0.5;
  END_FOR;
  pair.a := pos;
  name := CONCAT('b', LEFT(name, 3));
END_FUNCTION_BLOCK
VAR_GLOBAL start AT CIO0.03 : BOOL; level AT D120 : INT; END_VAR
PROGRAM Main
VAR belt : ARRAY[1..3] OF Belt; total : DINT; copy : Pair; n : INT; END_VAR
  n := n + level;
  belt[1](go := start, total := total);
  belt[2](go := TRUE, total := total);
  belt[3](go := NOT start, total := total);
  copy := belt[1].pair;
END_PROGRAM
"""


def value(data: bytes | None) -> int:
    assert data is not None
    return int.from_bytes(data, "little", signed=True)


# ---- no difference without a disturbance --------------------------------------------------------------------------


@pytest.mark.parametrize("sample", SAMPLES.values(), ids=SAMPLES)
@pytest.mark.parametrize("make", [on(flavours()), reference], ids=("native", "reference"))
def test_a_sample_has_no_difference(sample: Sample, make: object, tmp_path: Path) -> None:
    found = check_sources(sample.files, MODELS[sample.model])
    assert found.program is not None
    record(tmp_path / "run", found.program, 130, engine=NativeEngine)
    verified = verifier(tmp_path / "run", found.program, make=make)  # type: ignore[arg-type]
    made = rows(verified)
    assert len(made) == 130
    assert differences(made) == []
    assert any(row.outputs for row in made)


@pytest.mark.parametrize("in_out", ["reference", "value"])
def test_generated_programs_have_no_difference(in_out: str, tmp_path: Path) -> None:
    compared = 0
    for seed in range(12):
        source = generate(seed, INGREDIENTS)
        made = checked(source, in_out)  # type: ignore[arg-type]
        if made is None:
            continue
        record(tmp_path / f"{seed}", made, 3)
        found = rows(verifier(tmp_path / f"{seed}", made, make=on(flavours()) if seed % 4 == 0 else reference))
        assert differences(found) == [], f"seed {seed}\n{source}"
        compared += 1
    assert compared > 8


def test_what_people_do_is_no_difference(tmp_path: Path) -> None:
    commands = [
        (2, Write("Ada", "level", "7")), (3, SetMode("Ada", "PROGRAM")), (6, SetMode("Ada", "MONITOR")),
        (8, Restart("Ada", "cold")), (9, Write("Ada", "start", "TRUE")),
    ]  # fmt: skip
    record(tmp_path / "run", program(BELTS), 12, commands)
    found = rows(verifier(tmp_path / "run", program(BELTS), "Main"))
    assert differences(found) == []
    assert [row.kind for row in found] == ["pass"] * 3 + ["none"] * 3 + ["pass"] * 6
    assert "mode PROGRAM" in found[4].note


# ---- ranges -------------------------------------------------------------------------------------------------------


def test_a_block_that_is_called_three_times_has_a_row_each(tmp_path: Path) -> None:
    record(tmp_path / "run", program(BELTS), 4)
    verified = verifier(tmp_path / "run", program(BELTS), "Belt")
    found = verified.verify(2).rows
    assert [(row.kind, row.call, row.instance) for row in found] == [
        ("pass", 1, "Main.belt[1]"), ("pass", 2, "Main.belt[2]"), ("pass", 3, "Main.belt[3]"),
    ]  # fmt: skip
    assert list(found[1].outputs) == ["pos", "total", "i", "pair.b", "pair.a", "name"]
    assert [value(row.outputs["pair.a"].control) for row in found] == [0, 18, 18]
    assert {name: value(each.recorded) for name, each in found[1].inputs.items() if name in ("go", "pos", "total")} == {
        "go": 1, "pos": 12, "total": 4,
    }  # fmt: skip
    assert "pos" not in found[0].outputs  # a branch not taken
    assert verified.columns["name"].kind == "string"
    assert verified.columns["pair.b"].type == "LREAL"
    only = verifier(tmp_path / "run", program(BELTS), "Belt@Main.belt[2]").verify(2).rows
    assert [(row.call, row.instance) for row in only] == [(1, "Main.belt[2]")]


@pytest.mark.parametrize(
    ("range", "outputs"),
    [
        ("Belt:9-10", [set(), {"pos", "total"}, {"pos", "total"}]),
        ("Belt:13", [{"pair.b"}] * 3),  # inside of a loop: one pass
        ("Belt:12", [{"i", "pair.b"}] * 3),  # the loop as it begins; its counter is stored each round
        ("Twice", [{"Twice"}] * 2),
        ("Main:25", [{"Main.copy.a", "Main.copy.b"}]),
    ],
)
def test_ranges(range: str, outputs: list[set[str]], tmp_path: Path) -> None:
    record(tmp_path / "run", program(BELTS), 4)
    found = verifier(tmp_path / "run", program(BELTS), range).verify(3).rows
    if range == "Belt:9-10":
        assert [set(row.outputs) for row in found] == outputs[1:]
    elif range == "Belt:12":
        assert all("i" in row.outputs for row in found)
    else:
        assert [set(row.outputs) for row in found] == outputs


def test_a_range_that_does_not_run(tmp_path: Path) -> None:
    source = BELTS.replace("go := TRUE", "go := FALSE").replace("NOT start", "start")
    record(tmp_path / "run", program(source), 3)
    found = verifier(tmp_path / "run", program(source), "Belt:9").verify(1).rows
    assert [(row.kind, row.note) for row in found] == [("none", "not run in this scan")]


def test_a_full_record_has_a_mark(tmp_path: Path) -> None:
    record(tmp_path / "run", program(BELTS), 3)
    (row,) = verifier(tmp_path / "run", program(BELTS), limit=10).verify(1).rows
    assert row.used > 10
    assert row.note == f"record full: 10 of {row.used} uses kept"
    assert row.differences == ()


def test_uses_are_in_their_order(tmp_path: Path) -> None:
    record(tmp_path / "run", program(BELTS), 3)
    verified = verifier(tmp_path / "run", program(BELTS), "Belt:8-11")
    found = verified.uses(1, 2)
    shown = [f"{'w' if each.written else 'r'} {each.name} {each.place.instance}:{each.place.line}" for each in found]
    belt = "Main.belt[2]"
    assert [each for each in shown if "Twice" not in each] == [
        f"r go {belt}:8", f"r pos {belt}:9", f"w pos {belt}:9", f"r total {belt}:10", f"w total {belt}:10",
    ]  # fmt: skip
    assert all(each.control == each.monitor for each in found)
    assert "w Twice.Twice Twice:4" in shown


# ---- disturbances -------------------------------------------------------------------------------------------------


def disturbed(tmp_path: Path, wanted: Disturbance, scans: int = 12, at: int = 5, source: str = BELTS) -> Path:
    return record(
        tmp_path / "run", program(source), scans, [(at, Disturb("Ada", wanted))], agenda=DisturbanceSchedule()
    )  # fmt: skip


def test_a_disturbance_that_did_not_come_about_is_said_to_be_so(tmp_path: Path) -> None:
    source = (
        "PROGRAM Main\nVAR n, m : INT; END_VAR\n  n := n + 1;\n  IF n < 0 THEN\n    m := 1;\n  END_IF;\nEND_PROGRAM"
    )
    path = disturbed(tmp_path, Disturbance("result", site="main.st:5", bit=1, scan=7), source=source)
    found = rows(verifier(path, program(source)))
    assert differences(found) == []
    assert not any(row.disturbances for row in found)
    assert {row.scan: row.note for row in found if row.note} == {
        8: "disturbance 1 did not come about in scan 7: the statement did not run"
    }


@pytest.mark.parametrize("range", ["", "Main", "Belt"])
def test_a_flipped_bit_is_found_in_its_scan_by_its_variable(range: str, tmp_path: Path) -> None:
    path = disturbed(tmp_path, Disturbance("flip", "Main.belt[2].pos", 3, scan=7))
    found = rows(verifier(path, program(BELTS), range))
    wrong = [row for row in found if row.differs]
    assert {row.scan for row in wrong} == {7}
    assert wrong[0].disturbances == ("Memory Main.belt[2].pos, bit 3",)
    (difference,) = differences(wrong)
    assert difference.cause == "input"
    assert "Main.belt[2].pos was" in difference.message
    assert value(difference.control) ^ value(difference.monitor) == 8


def test_a_flipped_bit_that_nobody_reads_is_found(tmp_path: Path) -> None:
    path = disturbed(tmp_path, Disturbance("flip", "D777", 0, scan=7))
    found = rows(verifier(path, program(BELTS), "Belt"))
    (difference,) = differences(found)
    assert (difference.cause, difference.name, difference.kind) == ("input", "D777", "bits")


OVERWRITTEN = """\
PROGRAM Main
VAR n, x, y : INT; u : BOOL; s AT D10 : WORD; END_VAR
  x := n MOD 2;
  s.3 := n MOD 2 = 1;
  y := x;
  u := s.3;
  u := u OR s.4;
  n := n + 1;
END_PROGRAM
"""


@pytest.mark.parametrize(("range", "flip", "bit", "read"), [
    ("Main:5", "Main.x", 0, None), ("Main:6", "D10", 3, None), ("Main:7", "D10", 4, "Main.s.4"), ("Main:3-5", "Main.x", 0, None),
    ("", "Main.x", 0, None),
])  # fmt: skip
def test_what_the_program_wrote_over_a_flipped_bit_is_no_input_difference(
    range: str, flip: str, bit: int, read: str | None, tmp_path: Path
) -> None:
    path = disturbed(tmp_path, Disturbance("flip", flip, bit, scan=7), source=OVERWRITTEN)
    found = rows(verifier(path, program(OVERWRITTEN), range))
    (row,) = [row for row in found if row.differs]
    assert row.scan == 7
    assert {name for name, each in row.inputs.items() if each.expected is not None} == ({read} if read else set())
    (difference,) = row.differences
    assert difference.cause == "input"
    assert ("nobody wrote it" in difference.message) == (read is None)


def test_a_stuck_input_is_an_input_difference_while_it_differs(tmp_path: Path) -> None:
    path = record(
        tmp_path / "run", program(BELTS), 14,
        [(4, Disturb("Ada", Disturbance("stuck", "start", scan=5, scans=5))), (7, Write("Bob", "start", "TRUE"))],
        agenda=DisturbanceSchedule(),
    )  # fmt: skip
    verified = verifier(path, program(BELTS), "Main")
    found = rows(verified)
    wrong = [row for row in found if row.differs]
    assert [row.scan for row in wrong] == [7, 8, 9]
    for row in wrong:
        assert row.inputs["start"].recorded == b"\0"
        assert row.inputs["start"].expected == b"\1"
        assert [each.cause for each in row.differences] == ["input"]
    assert {row.scan: row.disturbances for row in found if row.disturbances} == dict.fromkeys(
        range(5, 10), ("Input start stuck",)
    )
    assert verifier(path, program(BELTS), "Main").step(8, 1).rows[0].disturbances == ("Input start stuck",)
    # the same when one goes there at once
    assert verifier(path, program(BELTS), "Main").verify(8).rows == (wrong[1],)


def test_a_corrupted_result_is_found_at_its_statement(tmp_path: Path) -> None:
    path = disturbed(tmp_path, Disturbance("result", site="main.st:21", bit=1, scan=7))
    found = rows(verifier(path, program(BELTS)))
    wrong = [row for row in found if row.differs]
    assert {row.scan for row in wrong} == {7}
    first = wrong[0].differences[0]
    assert first.cause == "logic"
    assert first.place is not None
    assert (first.place.file, first.place.line, first.place.instance) == ("main.st", 21, "Main")
    assert first.name == "Main.n"


# ---- set data -----------------------------------------------------------------------------------------------------


def test_set_data_changes_the_monitor_only(tmp_path: Path) -> None:
    record(tmp_path / "run", program(BELTS), 6)
    verified = verifier(tmp_path / "run", program(BELTS), "Belt")
    before = verified.verify(3).rows
    (row,) = verified.set_inputs([(3, 2, "pos", "100"), (3, 2, "name", "'xyz'")])
    assert value(row.outputs["pos"].set) == 106
    assert row.outputs["name"].set is not None
    assert row.outputs["name"].set[:6] == b"\4\0bxyz"
    assert value(row.inputs["pos"].set) == 100
    for name, each in row.outputs.items():
        assert (each.control, each.monitor) == (before[1].outputs[name].control, before[1].outputs[name].monitor)
    assert verified.verify(3).rows == (before[0], row, before[2])
    after = verified.verify(4).rows
    assert after == verifier(tmp_path / "run", program(BELTS), "Belt").verify(4).rows
    (row,) = verified.set_inputs([(3, 2, "go", "FALSE"), (3, 2, "pos", ""), (3, 2, "name", "")])
    assert row.outputs["pos"].set is None
    (row,) = verified.set_inputs([(3, 2, "go", "")])
    assert row == before[1]


def test_bad_edits_are_refused_and_nothing_is_kept(tmp_path: Path) -> None:
    record(tmp_path / "run", program(BELTS), 6)
    verified = verifier(tmp_path / "run", program(BELTS), "Belt")
    before = verified.verify(3).rows
    with pytest.raises(BadEdit, match=r"`poss` is no input.*Did you mean `pos`"):
        verified.set_inputs([(3, 2, "pos", "1"), (3, 2, "poss", "1")])
    with pytest.raises(BadEdit, match="pos: `x` is not INT"):
        verified.set_inputs([(3, 2, "pos", "x")])
    with pytest.raises(BadEdit, match="ran 3 times in scan 3: there is no call 4"):
        verified.set_inputs([(3, 4, "pos", "1")])
    assert verified.verify(3).rows == before


# ---- back, forth, swaps, traps ------------------------------------------------------------------------------------


def test_any_order_gives_the_same_rows(tmp_path: Path) -> None:
    path = disturbed(tmp_path, Disturbance("flip", "Main.n", 3, scan=7))
    one = verifier(path, program(BELTS), "Main")
    forward = [one.verify(scan).rows for scan in range(12)]
    for scan in (9, 3, 7, 6, 7, 11, 0):
        assert one.verify(scan).rows == forward[scan]
    with pytest.raises(Unreadable, match="scans 0 to 11 can be verified: 12 is none of them"):
        one.verify(12)


def test_a_program_change_on_the_way(tmp_path: Path) -> None:
    old, new = program(BELTS), program(BELTS.replace("Twice := x * 2", "Twice := x * 3"))
    programs = LoadedPrograms(Loaded.make(old, ReferenceEngine, 1), Loaded.make(new, ReferenceEngine, 2))
    path = record(
        tmp_path / "run", old, 8, [(4, ProgramChange("Ada", 2))], programs=programs, more=[(2, new)]
    )  # fmt: skip
    verified = verifier(path, old, "Belt", others={2: new})
    found = rows(verified)
    assert differences(found) == []
    steps = [value(row.outputs["pos"].monitor) for row in found if row.call == 2]
    assert [b - a for a, b in pairwise(steps)] == [6, 6, 6, 9, 9, 9, 9]


def test_a_block_that_a_program_in_between_does_not_have(tmp_path: Path) -> None:
    small, big = program("PROGRAM Main VAR n : INT; END_VAR n := n + 1; END_PROGRAM"), program(BELTS)
    programs = LoadedPrograms(
        *(Loaded.make(each, ReferenceEngine, number) for number, each in ((1, big), (2, small), (3, big)))
    )
    path = record(
        tmp_path / "run", big, 12, [(4, ProgramChange("Ada", 2)), (8, ProgramChange("Ada", 3))], programs=programs,
        more=[(2, small), (3, big)],
    )  # fmt: skip
    verified = verifier(path, big, "Belt", make=on(flavours()), others={2: small, 3: big})
    found = rows(verified)
    assert {row.scan for row in found} == set(range(12))
    assert differences(found) == []


def test_a_new_run_of_the_same_name_has_its_own_programs(tmp_path: Path) -> None:
    text = "PROGRAM Main VAR n : DINT; END_VAR n := n + %d; END_PROGRAM"
    made = {b"1": program(text % 1), b"2": program(text % 10)}

    def run(sources: bytes) -> None:
        with Recording.begin(tmp_path / "run", made[sources], 1, sources, ENTRIES, "Ada") as recording:
            run_headless(made[sources], 20, ReferenceEngine, recording=recording)

    run(b"1")
    with opened(tmp_path / "run", lambda kept: made[kept.sources], reference) as verified:
        verified.begin(Range("Main"))
        assert verified.verify(5).rows[0].outputs["Main.n"].control == (6).to_bytes(4, "little")
        (tmp_path / "run").rename(tmp_path / "aside")
        run(b"2")
        verified.follow(20)
        assert verified.verify(5).rows[0].outputs["Main.n"].control == (60).to_bytes(4, "little")
        assert verified.verify(5).rows[0].outputs["Main.n"].monitor == (60).to_bytes(4, "little")


def test_a_run_time_error_in_the_range(tmp_path: Path) -> None:
    source = "PROGRAM Main\nVAR n, m : INT; END_VAR\n  n := n + 1;\n  m := 10 / (5 - n);\n  m := m + 1;\nEND_PROGRAM"
    path = record(tmp_path / "run", program(source), 10)
    verified = verifier(path, program(source), "Main")
    assert verified.end == 5  # the scan that ended it is over
    found = rows(verified)
    assert differences(found) == []
    assert "ended by a run-time error: main.st:4" in found[-1].note
    assert value(found[-1].outputs["Main.n"].monitor) == 5


INDEXED = """\
PROGRAM Main
VAR ix, n : INT; arr : ARRAY[0..9] OF INT; END_VAR
  ix := (ix + 1) MOD 10;
  arr[ix] := arr[ix] + 1;
  n := n + 1;
END_PROGRAM
"""
TRAP = "a run-time error ended scan 7: main.st:4:18: index outside of 0..9 (scan 7); the reference went on"


@pytest.mark.parametrize(("range", "others"), [("", ["Main.ix"]), ("Main", ["Main.ix"]), ("Main:5", ["Main.ix"])])
def test_a_run_time_error_on_one_side_is_the_difference(range: str, others: list[str], tmp_path: Path) -> None:
    wanted = Disturbance("result", site="main.st:3", bit=4, scan=7)
    verified = verifier(disturbed(tmp_path, wanted, source=INDEXED), program(INDEXED), range)
    assert verified.end == 8
    found = rows(verified)
    assert {row.scan for row in found if row.differs} == {7}
    told = {each.name: each for each in differences(found)}
    assert told.keys() == {"run-time error", *others}  # and nothing of what the system counts, or was not reached
    trap = told["run-time error"]
    assert (trap.cause, trap.message, trap.control, trap.place and trap.place.line) == ("trap", TRAP, b"", 4)


def test_scans_in_which_the_program_does_not_run_are_not_compared(tmp_path: Path) -> None:
    stopped = [(3, SetMode("Ada", "PROGRAM")), (6, SetMode("Ada", "RUN"))]
    path = record(tmp_path / "run", program(BELTS), 8, stopped)
    verified = verifier(path, program(BELTS))
    assert [verified.verify(scan).compared for scan in range(8)] == [True] * 3 + [False] * 3 + [True] * 2


# ---- files that grow, and code that was not the same --------------------------------------------------------------


def test_a_file_is_followed_while_it_grows(tmp_path: Path) -> None:
    made = program(BELTS)
    with Recording.begin(tmp_path / "run", made, 1, b"1", ENTRIES, "Ada") as recording:
        resource = Resource(Loaded.make(made, ReferenceEngine), recorder=recording)
        verified = verifier(tmp_path / "run", made, "Main")
        with pytest.raises(Unreadable):
            verified.verify(0)
        resource.run(3)
        verified.follow(3)
        assert differences(rows(verified)) == []
        resource.submit(Write("Ada", "level", "7"))
        resource.run(2)
        verified.follow(5)
        assert value(verified.verify(3).rows[0].outputs["Main.n"].control) == 7
        assert value(verified.verify(4).rows[0].outputs["Main.n"].monitor) == 14
        assert verified.end == 5


class Forgetful(ReferenceEngine):
    """Live it came to something else than ever after."""

    def run(self, scans: int, pace: Pace | None = None) -> Stop:
        stop = super().run(scans, pace)
        self.memory[self.program.layout.areas["D"] + 2 * 777] = 5
        return stop


def test_code_that_came_to_something_else_when_it_ran_live_is_told(tmp_path: Path) -> None:
    path = record(tmp_path / "run", program(BELTS), 6, engine=Forgetful)
    found = rows(verifier(path, program(BELTS), "Main"))
    (difference,) = differences(found)
    assert [row.scan for row in found if row.differs] == [5]  # where the run file has a state again
    assert (difference.cause, difference.name) == ("recorded", "D777")
    assert "when it was recorded" in difference.message


def test_a_debuggers_write_inside_of_a_scan_is_no_difference(tmp_path: Path) -> None:
    made = program(BELTS)
    with Recording.begin(tmp_path / "run", made, 1, b"1", ENTRIES, "Ada") as recording:
        resource = Resource(Loaded.make(made, ReferenceEngine), recorder=recording)
        resource.run(2)
        resource.listening.attach(HaltAt(2), Listen(count=2))
        assert resource.run(1).reason is Reason.HALTED
        entry = resource.submit(Write("Ada", "Main.n", "50"))
        assert isinstance(entry, Entry)
        assert entry.step == 2
        resource.finish()
        resource.listening.attach(None)
        resource.run(2)
        verified = verifier(tmp_path / "run", made, "Main")
        verified.follow(resource.header.scan)
        found = rows(verified)
    assert differences(found) == []
    assert value(found[2].outputs["Main.n"].control) == 50


def test_a_reference_is_shown_by_the_name_of_what_it_refers_to(tmp_path: Path) -> None:
    checked_program = program("""\
TYPE Tank : STRUCT level : INT; END_STRUCT END_TYPE
PROGRAM Main
VAR a, b : Tank; p, none : REF_TO Tank; f : BOOL; bit : REF_TO BOOL; n : INT; END_VAR
IF n MOD 2 = 0 THEN p := REF(a); ELSE p := REF(b); END_IF;
bit := REF(f);
none := NULL;
n := n + 1;
END_PROGRAM
""")
    with verifier(record(tmp_path / "r.sbrun", checked_program, 3), checked_program) as verifying:
        found = rows(verifying)
        columns = verifying.columns
    shown = [value_text(columns["Main.p"], row.outputs["Main.p"].control) for row in found]
    assert shown == ["-> Main.a", "-> Main.b", "-> Main.a"]
    assert value_text(columns["Main.bit"], found[0].outputs["Main.bit"].monitor) == "-> Main.f"
    assert value_text(columns["Main.none"], found[0].outputs["Main.none"].control) == "NULL"


def test_a_difference_of_references_says_their_names(tmp_path: Path) -> None:
    names = Names(
        checked_of := program("PROGRAM Main\nVAR a, b : INT; p : REF_TO INT; END_VAR\np := REF(b);\nEND_PROGRAM\n")
    )
    a, b, p = (resolve(checked_of, f"Main.{each}") for each in "abp")
    leaf = names.at(p.offset, 8)[0]
    slots = [each.offset.to_bytes(8, "little") for each in (a, b)]
    assert values(names, leaf, *slots) == ("-> Main.a", "-> Main.b")
