"""Who wrote a variable last."""

from pathlib import Path

import pytest

from scanbench.debug.writers import writers
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.engine import NativeEngine
from scanbench.engines.native.probed import ProbedBuilds
from scanbench.faults.disturb.definition import Disturbance
from scanbench.faults.disturb.disturb import Disturb
from scanbench.faults.disturb.schedule import DisturbanceSchedule
from scanbench.history.contract import Writer
from scanbench.history.writer import find_writer
from scanbench.recording import checkpoints
from scanbench.recording.blocks import KeptProgram
from scanbench.recording.reader import RunReader, Unreadable
from scanbench.recording.timeline import Timeline
from scanbench.runtime.command import Refusal
from scanbench.runtime.forces import Force
from scanbench.runtime.programs import EngineFactory
from scanbench.runtime.restart import Restart
from scanbench.runtime.write import Write
from scanbench.symbols.symbols import resolve
from scanbench.wire.codec import ENTRIES
from tests.recording.recorded import SourcePrograms, advance, begun, of_file, of_file_native, to_program

LINE = """
TYPE Pair : STRUCT a, b : INT; END_STRUCT END_TYPE
FUNCTION_BLOCK Belt
VAR_INPUT go : BOOL; END_VAR
VAR_IN_OUT level : INT; END_VAR
VAR seen : INT; END_VAR
  IF go THEN
    level := level + 1;
    seen := seen + 1;
  END_IF;
END_FUNCTION_BLOCK
PROGRAM Main
VAR n, quiet, one, two : INT; belt : ARRAY[1..3] OF Belt; pair : Pair; list : ARRAY[0..9] OF INT; text : STRING[10];
  lamp AT CIO 100.03 : BOOL; bits : WORD; END_VAR
VAR RETAIN kept : INT; END_VAR
  n := n + 1;
  IF n = 5 THEN quiet := 7; text := 'five'; pair.b := 2; bits.3 := TRUE; kept := 1; END_IF;
  IF n = 7 THEN quiet := 7; lamp := TRUE; END_IF;
  belt[1](go := n = 9, level := one);
  belt[2](go := n = 11, level := two);
  belt[3](go := n = 12, level := one);
  list[n MOD 10] := n;
END_PROGRAM
"""
ENGINES = pytest.mark.parametrize("engine", [ReferenceEngine, NativeEngine])


def _texts(kept: KeptProgram) -> dict[str, str]:
    return {"main.st": kept.sources.decode()}


def _reading(path: Path, engine: EngineFactory = ReferenceEngine) -> RunReader:
    return RunReader(path, of_file if engine is ReferenceEngine else of_file_native, ENTRIES, _texts)


def _last(timeline: Timeline, path: str, scan: int | None = None, engine: EngineFactory = ReferenceEngine) -> Writer:
    prober = ProbedBuilds().engine if engine is NativeEngine else None
    with _reading(timeline.recording.path, engine) as reading:
        reading.follow(timeline.live_scan)
        return find_writer(reading, path, timeline.live_scan if scan is None else scan, prober)


@ENGINES
def test_a_statement(engine: EngineFactory, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checkpoints, "EVERY_NS", 0)
    timeline = begun(tmp_path / "run", LINE, engine)
    advance(timeline, 20)
    found = _last(timeline, "main.quiet", engine=engine)
    assert (found.path, found.by, found.scan, found.value, found.shown) == ("Main.quiet", "program", 6, b"\7\0", "7")
    assert found.place is not None
    assert (found.place.instance, found.place.pou) == ("Main", "Main")
    assert found.place.text.startswith("IF n = 7 THEN quiet := 7;"), "it is written although the value stays"
    assert LINE.splitlines()[found.place.line - 1].strip() == found.place.text
    earlier = _last(timeline, "Main.quiet", 6, engine)
    assert (earlier.by, earlier.scan) == ("program", 4)
    assert _last(timeline, "Main.quiet", 4, engine).by == "start"


NEIGHBOURS = """\
PROGRAM Main
VAR n : INT; motor AT CIO 100.00 : BOOL; lamp AT CIO 100.01 : BOOL; END_VAR
n := n + 1;
lamp := n > 3;
motor := NOT motor;
END_PROGRAM
"""


@ENGINES
@pytest.mark.parametrize(("path", "line"), [("Main.lamp", 4), ("Main.motor", 5), ("CIO100.01", 4), ("CIO100", 5)])
def test_neighbours_in_one_byte(engine: EngineFactory, path: str, line: int, tmp_path: Path) -> None:
    timeline = begun(tmp_path / "run", NEIGHBOURS, engine)
    advance(timeline, 20)
    found = _last(timeline, path, engine=engine)
    assert found.place is not None
    assert (found.scan, found.place.line) == (19, line)


@ENGINES
@pytest.mark.parametrize(
    ("path", "meant", "scan", "instance"),
    [
        ("Main.belt[3].level", "Main.one", 11, "Main.belt[3]"),
        ("Main.one", "Main.one", 11, "Main.belt[3]"),
        ("Main.belt[2].level", "Main.two", 10, "Main.belt[2]"),
        ("Main.belt[1].seen", "Main.belt[1].seen", 8, "Main.belt[1]"),
        ("Main.pair", "Main.pair", 4, "Main"),
        ("Main.list[4]", "Main.list[4]", 13, "Main"),
        ("Main.list", "Main.list", 19, "Main"),
        ("Main.text", "Main.text", 4, "Main"),
        ("Main.bits.3", "Main.bits.3", 4, "Main"),
        ("CIO 100.03", "100.03", 6, "Main"),
        ("Main.lamp", "Main.lamp", 6, "Main"),
        ("CIO 100", "100", 6, "Main"),
    ],
)
def test_paths_of_every_kind(
    path: str, meant: str, scan: int, instance: str, engine: EngineFactory, tmp_path: Path
) -> None:
    timeline = begun(tmp_path / "run", LINE, engine)
    advance(timeline, 20)
    found = _last(timeline, path, engine=engine)
    assert (found.by, found.scan, found.place and found.place.instance) == ("program", scan, instance), found
    assert found.path.replace("CIO", "") == meant


def test_the_position_is_before_the_statement(tmp_path: Path) -> None:
    timeline = begun(tmp_path / "run", LINE)
    advance(timeline, 20)
    with _reading(timeline.recording.path) as reading:
        reading.follow(20)
        found = find_writer(reading, "Main.one", 20)
        reading.goto(found.scan, found.count)
        inside = reading.timeline.resource.listening.inside
        assert inside is not None
        assert found.place is not None
        assert inside.frames[0].pou.name == "Belt"
        assert "level := level + 1" in found.place.text


def test_a_command_that_came_later(tmp_path: Path) -> None:
    timeline = begun(tmp_path / "run", LINE)
    advance(timeline, 8)
    timeline.submit(Write("Ada", "Main.belt[1].level", "40"))
    timeline.submit(Write("Ada", "Main.quiet", "9"))
    advance(timeline, 8)
    found = _last(timeline, "Main.quiet")
    assert (found.by, found.author, found.scan, found.shown) == ("command", "Ada", 8, "9")
    assert found.text.startswith("Main.quiet")
    assert _last(timeline, "Main.quiet", 8).by == "command", "what was entered before the scan is there"
    assert _last(timeline, "Main.quiet", 7).by == "program"
    assert _last(timeline, "Main.one").by == "program", "a statement wrote it since"


def test_a_force_holds(tmp_path: Path) -> None:
    timeline = begun(tmp_path / "run", LINE)
    advance(timeline, 3)
    timeline.submit(Force("Bob", "Main.n", "4"))
    advance(timeline, 8)
    found = _last(timeline, "Main.n")
    assert (found.by, found.author, found.scan) == ("command", "Bob", 3)
    assert "holds" in found.text


def test_a_restart_and_a_program_change(tmp_path: Path) -> None:
    timeline = begun(tmp_path / "run", LINE)
    advance(timeline, 12)
    timeline.submit(Restart("Ada", "warm"))
    found = _last(timeline, "Main.quiet")
    assert (found.by, found.author, found.scan, found.shown) == ("command", "Ada", 12, "0")
    assert _last(timeline, "Main.kept").by == "program", "it is retained"
    second = LINE.replace("VAR n, quiet", "VAR more : LINT; n, quiet").replace("IF n = 5", "IF n = 500")
    timeline.programs.sources[2] = second  # type: ignore[attr-defined]
    advance(timeline, 10)
    assert not to_program(timeline, 2, second)
    advance(timeline, 5)
    assert (_last(timeline, "Main.more").by, _last(timeline, "Main.more").scan) == ("command", 22)
    carried = _last(timeline, "Main.quiet")
    assert (carried.by, carried.scan) == ("program", 18), "the other program wrote it, and it went over"


def test_the_plc_itself(tmp_path: Path) -> None:
    timeline = begun(tmp_path / "run", LINE)
    advance(timeline, 30)
    found = _last(timeline, "A200.11")
    assert (found.by, found.scan) == ("plc", 1), "the first cycle flag goes off"
    assert found.place is None


@pytest.mark.parametrize("path", ["Main.quite", "Nothing", "D99999999"])
def test_an_unknown_path(path: str, tmp_path: Path) -> None:
    timeline = begun(tmp_path / "run", LINE)
    with pytest.raises(Unreadable) as caught:
        _last(timeline, path)
    assert path == "D99999999" or caught.value.near or path == "Nothing"


def test_a_block_that_was_never_called(tmp_path: Path) -> None:
    timeline = begun(tmp_path / "run", LINE)
    with pytest.raises(Unreadable, match="not called yet"):
        _last(timeline, "Main.belt[1].level")


def test_a_new_run_of_the_same_name_has_its_own_programs(tmp_path: Path) -> None:
    first = begun(tmp_path / "run", LINE)
    advance(first, 20)
    first.close()
    with _reading(tmp_path / "run") as reading:
        reading.follow(20)
        assert find_writer(reading, "Main.n", 15).shown == "15"
        (tmp_path / "run").rename(tmp_path / "aside")
        second = begun(tmp_path / "run", LINE.replace("n := n + 1;", "\n  n := n + 10;"))
        advance(second, 20)
        reading.follow(20)
        found = find_writer(reading, "Main.n", 15)
        assert (found.shown, found.place and found.place.text) == ("150", "n := n + 10;")
        second.close()


def test_an_input_of_a_counter_that_no_call_passes(tmp_path: Path) -> None:
    """Its call writes the other members only, so no scan has to be looked at for it."""
    source = "PROGRAM Main VAR n : INT; count : CTU; END_VAR n := n + 1; count(CU := n MOD 2 = 0, PV := 3); END_PROGRAM"
    timeline = begun(tmp_path / "run", source)
    advance(timeline, 20)
    made = timeline.resource.program
    sites = timeline.resource.loaded.debugged().sites

    def written(name: str) -> int:
        return len(writers(made, sites, resolve(made, f"Main.count.{name}")) or ())

    assert {name: written(name) for name in ("CU", "R", "RESET", "PV", "Q", "CV")} == {
        "CU": 1, "R": 0, "RESET": 0, "PV": 1, "Q": 1, "CV": 1,
    }  # fmt: skip
    assert _last(timeline, "Main.count.RESET").by == "start"
    assert _last(timeline, "Main.count.CV").scan == 19


def test_a_reading_follows_its_file(tmp_path: Path) -> None:
    timeline = begun(tmp_path / "run", LINE)
    advance(timeline, 3)
    with _reading(timeline.recording.path) as reading:
        for scan in (3, 9, 20):
            advance(timeline, scan - timeline.live_scan)
            timeline.submit(Write("Ada", "Main.quiet", str(scan)))
            reading.follow(scan)
            assert find_writer(reading, "Main.quiet", scan).shown == str(scan)
            assert reading.follow(scan)
            assert timeline.resource.state == reading.timeline.resource.state or reading.timeline.past
        with pytest.raises(Unreadable, match="has not come yet"):
            find_writer(reading, "Main.quiet", 21)
        timeline.close()
        reading.path.unlink()
        with pytest.raises(Unreadable, match="cannot be read"):
            reading.follow(22)


def test_an_input_that_is_stuck(tmp_path: Path) -> None:
    programs = SourcePrograms({1: LINE}, ReferenceEngine)
    timeline = Timeline.begin(
        tmp_path / "run", programs, 1, LINE.encode(), ENTRIES, "Ada", agenda=DisturbanceSchedule()
    )  # fmt: skip
    advance(timeline, 3)
    outcome = timeline.submit(Disturb("Bob", Disturbance("stuck", "CIO 0.03", scan=5, scans=6)))
    assert not isinstance(outcome, Refusal), outcome
    advance(timeline, 20)
    found = _last(timeline, "CIO 0.03", 8)
    assert (found.by, found.author, found.scan) == ("command", "Bob", 5)
    assert "holds since scan 5" in found.text


BY_VALUE = """\
TYPE Pair : STRUCT a, b : INT; END_STRUCT END_TYPE
{in_out 'value'}
FUNCTION_BLOCK Inner
VAR_IN_OUT total : INT; END_VAR
  total := total + 1;
END_FUNCTION_BLOCK
{in_out 'value'}
FUNCTION_BLOCK Outer
VAR_IN_OUT total, idle : INT; on : BOOL; pair : Pair; END_VAR VAR inner : ARRAY[1..2] OF Inner; END_VAR
  inner[2](total := total);
  on := NOT on;
  pair.b := pair.b + 1;
END_FUNCTION_BLOCK
PROGRAM Main
VAR outer : Outer; pairs : ARRAY[1..2] OF Pair; t, u, v : INT; b : BOOL; w : WORD; END_VAR
  v := 7;
  outer(total := t, idle := u, on := w.3, pair := pairs[1]);
  outer(total := u, idle := v, on := b, pair := pairs[2]);
END_PROGRAM
"""


@ENGINES
@pytest.mark.parametrize(
    ("path", "line", "instance"),
    [
        ("Main.t", 5, "Main.outer.inner[2]"),
        ("Main.u", 5, "Main.outer.inner[2]"),
        ("Main.v", 18, "Main"),  # passed, and only copied back
        ("Main.w.3", 11, "Main.outer"),
        ("Main.b", 11, "Main.outer"),
        ("Main.pairs[1].b", 12, "Main.outer"),
        ("Main.pairs[2].b", 12, "Main.outer"),
    ],
)
def test_through_in_outs_by_value_it_is_the_statement_that_made_the_value(
    engine: EngineFactory, path: str, line: int, instance: str, tmp_path: Path
) -> None:
    timeline = begun(tmp_path / "run", BY_VALUE, engine)
    advance(timeline, 5)
    found = _last(timeline, path, engine=engine)
    assert found.place is not None
    assert (found.place.line, found.place.instance) == (line, instance)
