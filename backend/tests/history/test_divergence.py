"""Where two runs part."""

from datetime import UTC, datetime
from pathlib import Path

import pytest

from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.engine import NativeEngine
from scanbench.history import divergence
from scanbench.history.contract import BetweenEntry, Divergence
from scanbench.history.divergence import find_divergence
from scanbench.recording.reader import RunReader, Unreadable
from scanbench.recording.timeline import Timeline
from scanbench.runtime.command import Refusal
from scanbench.runtime.programs import EngineFactory
from scanbench.runtime.set_clock import SetClock
from scanbench.runtime.write import Write
from scanbench.wire.codec import ENTRIES
from tests.history.test_writer import _texts
from tests.recording.recorded import advance, begun, of_file, of_file_native, to_program

SOURCE = """
FUNCTION_BLOCK Belt
VAR_INPUT level : INT; END_VAR
VAR_OUTPUT speed : INT; END_VAR
  speed := level * 2;
END_FUNCTION_BLOCK
PROGRAM Main
VAR n, level, sum, unused, scratch : INT; d : INT := 1; belt : ARRAY[1..2] OF Belt; END_VAR
  n := n + 1;
  scratch := 0;
  belt[2](level := level);
  sum := sum + belt[2].speed / d;
END_PROGRAM
"""


def _compared(one: Timeline, other: Timeline, engine: EngineFactory = ReferenceEngine) -> Divergence:
    of = of_file if engine is ReferenceEngine else of_file_native
    with (
        RunReader(one.recording.path, of, ENTRIES, _texts) as a,
        RunReader(other.recording.path, of, ENTRIES, _texts) as b,
    ):
        a.follow(one.live_scan)
        b.follow(other.live_scan)
        return find_divergence(a, b)


def _two(folder: Path, source: str = SOURCE, engine: EngineFactory = ReferenceEngine) -> tuple[Timeline, Timeline]:
    return begun(folder / "one", source, engine), begun(folder / "other", source, engine)


def _write(timeline: Timeline, path: str, value: str, by: str = "Ada") -> None:
    outcome = timeline.submit(Write(by, path, value))
    assert not isinstance(outcome, Refusal), outcome


@pytest.mark.parametrize("engine", [ReferenceEngine, NativeEngine])
def test_runs_that_are_the_same(engine: EngineFactory, tmp_path: Path) -> None:
    one, other = _two(tmp_path, SOURCE, engine)
    for each, by in ((one, "Ada"), (other, "Bob")):
        advance(each, 5)
        _write(each, "Main.level", "3", by)
        advance(each, 5)
    advance(other, 20)
    found = _compared(one, other, engine)
    assert (found.scan, found.cause, found.compared, found.marks) == (None, "", 10, ())
    assert "the same in all 10 scans" in found.text


@pytest.mark.parametrize("engine", [ReferenceEngine, NativeEngine])
def test_a_command_in_one_of_them(engine: EngineFactory, tmp_path: Path) -> None:
    one, other = _two(tmp_path, SOURCE, engine)
    advance(one, 40)
    advance(other, 12)
    _write(other, "Main.level", "3")
    advance(other, 18)
    found = _compared(one, other, engine)
    assert (found.scan, found.cause, found.compared) == (12, "command", 30)
    assert found.place is not None
    assert (found.place.task, found.place.instance, found.place.pou) == ("Main", "Main", "Main")
    assert found.place.text == "belt[2](level := level);"
    assert found.changes is not None
    values = {each.path: (each.before_shown, each.after_shown) for each in found.changes.changes}
    assert next(iter(values)) == "Main.belt[2].level", "the first that was written"
    assert values == {
        "Main.belt[2].speed": ("0", "6"),
        "Main.belt[2].level": ("0", "3"),
        "Main.level": ("0", "3"),
        "Main.sum": ("0", "6"),
    }
    assert found.changes.changes[0].path in found.text
    assert found.entries == (BetweenEntry(12, "B", "Ada", "Write: Main.level := 3"),)
    assert "Ada entered only in B, before scan 12" in found.text
    assert found.marks == ((12, 29),)


def test_a_command_that_changes_nothing_is_no_difference(tmp_path: Path) -> None:
    one, other = _two(tmp_path)
    advance(one, 5)
    _write(one, "Main.level", "0")
    _write(one, "Main.scratch", "7")
    advance(one, 5)
    advance(other, 10)
    found = _compared(one, other)
    assert (found.scan, found.marks) == (None, ())
    assert "2 commands are only in one of them" in found.text
    assert [each.run for each in found.entries] == ["A", "A"]


def test_stretches_in_which_they_differ(tmp_path: Path) -> None:
    one, other = _two(tmp_path)
    for scan in range(0, 60, 20):
        advance(one, 20)
        _write(one, "Main.unused", "1")
        advance(one, 3)
        _write(one, "Main.unused", "0")
        assert scan >= 0
    advance(one, 10)
    advance(other, one.live_scan)
    found = _compared(one, other)
    assert found.scan == 20
    assert found.place is None, "no statement wrote it"
    assert found.marks == ((20, 22), (43, 45), (66, 68))


def test_many_stretches_are_joined(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(divergence, "MAX_MARKS", 2)
    one, other = _two(tmp_path)
    for gap in (1, 2, 30, 1):
        _write(one, "Main.unused", "1")
        advance(one, 1)
        _write(one, "Main.unused", "0")
        advance(one, gap)
    advance(other, one.live_scan)
    assert _compared(one, other).marks == ((0, 5), (36, 36))


def test_another_program(tmp_path: Path) -> None:
    one, other = _two(tmp_path)
    changed = SOURCE.replace("level * 2", "level * 3").replace("VAR n,", "VAR more : LINT; n,")
    other.programs.sources[2] = changed  # type: ignore[attr-defined]
    for each in (one, other):
        advance(each, 5)
    assert not to_program(other, 2, changed)
    for each in (one, other):
        advance(each, 5)
        _write(each, "Main.level", "1")
        advance(each, 5)
    found = _compared(one, other)
    assert (found.scan, found.cause) == (10, "command"), "a change of the program is a command"
    assert "ProgramChange" in found.text
    assert found.changes is not None
    assert {each.path for each in found.changes.changes} == {"Main.belt[2].speed", "Main.sum"}
    assert "by their names" in found.changes.note


def test_another_program_from_the_beginning(tmp_path: Path) -> None:
    one = begun(tmp_path / "one", SOURCE)
    other = begun(tmp_path / "other", SOURCE.replace("n := n + 1", "n := n + 1 + n / 4"))
    advance(one, 20)
    advance(other, 20)
    found = _compared(one, other)
    assert (found.scan, found.cause) == (4, "program")
    assert found.place is not None
    assert found.place.text.startswith("n := n + 1")
    start = begun(tmp_path / "third", SOURCE.replace("n, level, sum", "n : INT := 7; level, sum"))
    advance(start, 20)
    found = _compared(one, start)
    assert (found.scan, found.cause) == (0, "program")
    assert "different where they begin" in found.text


def test_another_program_that_acts_otherwise_only_later(tmp_path: Path) -> None:
    late = SOURCE.replace("scratch := 0;", "IF n > 50 THEN level := 7; END_IF;")
    one = begun(tmp_path / "one", late)
    other = begun(tmp_path / "other", late.replace("n > 50", "n > 55"))
    advance(one, 80)
    advance(other, 80)
    found = _compared(one, other)
    assert (found.scan, found.cause) == (50, "program")
    assert found.text.endswith("different programs run")
    assert (found.compared, found.first, found.last) == (80, 0, 79)


def test_runs_without_a_scan_in_common_are_not_the_same(tmp_path: Path) -> None:
    one, other = _two(tmp_path)
    advance(one, 10)
    with pytest.raises(Unreadable, match="no scan in common"):
        _compared(one, other)


def test_a_run_time_error_in_one_of_them(tmp_path: Path) -> None:
    one, other = _two(tmp_path)
    advance(one, 20)
    advance(other, 8)
    _write(other, "Main.d", "0")
    advance(other, 5)
    assert other.resource.trap is not None
    found = _compared(one, other)
    assert (found.scan, found.cause) == (8, "command")
    again = _compared(other, other)
    assert again.scan is None


def test_a_branch(tmp_path: Path) -> None:
    one = begun(tmp_path / "one", SOURCE)
    _write(one, "Main.level", "2")
    advance(one, 20)
    one.copy(tmp_path / "branch", 10, "Ada", lambda refusal: None)
    one.recording.wait()
    with RunReader(tmp_path / "branch", of_file, ENTRIES) as b, RunReader(tmp_path / "one", of_file, ENTRIES) as a:
        a.follow(20)
        b.follow()
        found = find_divergence(a, b)
        assert (found.scan, found.compared) == (None, 10)


def test_progress_and_an_end(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(divergence, "_CHUNK", 10)
    one, other = _two(tmp_path)
    advance(one, 50)
    advance(other, 50)
    told: list[tuple[int, int]] = []
    with RunReader(tmp_path / "one", of_file, ENTRIES) as a, RunReader(tmp_path / "other", of_file, ENTRIES) as b:
        a.follow(50)
        b.follow(50)
        find_divergence(a, b, lambda done, of: told.append((done, of)))
    assert told[-1] == (50, 50)
    assert len(told) == 5


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    with RunReader(tmp_path / "none", of_file, ENTRIES) as missing, pytest.raises(Unreadable, match="cannot be read"):
        missing.follow()


def test_each_run_has_a_clock_of_its_own(tmp_path: Path) -> None:
    """Every instance sets its clock when it begins: that alone is no difference, what a program makes of it is."""
    source = SOURCE.replace("n := n + 1;", "n := n + 1; IF n > 5 THEN when := kind; END_IF;").replace(
        "VAR n,", "VAR kind AT A351 : WORD; when : WORD; n,"
    )
    one, other = _two(tmp_path, source)
    for each, minute in ((one, 1), (other, 2)):
        outcome = each.submit(SetClock("server", datetime(2030, 1, 1, 0, minute, tzinfo=UTC)))
        assert not isinstance(outcome, Refusal)
        advance(each, 20)
    found = _compared(one, other)
    assert found.scan == 5
    assert found.changes is not None
    assert [each.path for each in found.changes.changes] == ["Main.when"]
    assert "SetClock" in found.text


OF_ONE = (
    "PROGRAM Main\nVAR a, total : INT; arr : ARRAY[0..3] OF INT; END_VAR\na := a + 1;\ntotal := a * 2;\nEND_PROGRAM"
)


@pytest.mark.parametrize(
    ("was", "now", "left"),
    [
        ("a, total", "a, more, total", {"Main.more": "only in B"}),
        ("total", "sum", {"Main.sum": "only in B", "Main.total": "only in A"}),
        (
            "a, total : INT;",
            "a : INT; total : DINT;",
            {"Main.total": "different in A and B (type changed from INT to DINT)"},
        ),
        (
            "[0..3]",
            "[0..5]",
            {"Main.arr": "different in A and B (type changed from ARRAY[0..3] OF INT to ARRAY[0..5] OF INT)"},
        ),
    ],
)
def test_what_only_one_has_is_named(was: str, now: str, left: dict[str, str], tmp_path: Path) -> None:
    one, other = begun(tmp_path / "one", OF_ONE), begun(tmp_path / "other", OF_ONE.replace(was, now))
    for each in (one, other):
        advance(each, 10)
    found = _compared(one, other)
    assert (found.scan, found.same, found.left_count) == (None, "partly", len(left))
    assert {each.path: each.reason for each in found.left} == left
    assert "in what both have they are the same in all 10 scans" in found.text


def test_programs_without_a_common_variable_are_not_the_same(tmp_path: Path) -> None:
    one = begun(tmp_path / "one", OF_ONE)
    other = begun(tmp_path / "other", OF_ONE.replace("Main", "Other"))
    for each in (one, other):
        advance(each, 10)
    found = _compared(one, other)
    assert (found.scan, found.same, found.variables) == (None, "nothing", 0)
    assert {each.path for each in found.left} == {"Main", "Other"}
    assert "no variable in common" in found.text


def test_what_is_not_compared_is_listed_in_part(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(divergence, "MAX_LEFT", 2)
    one = begun(tmp_path / "one", OF_ONE)
    other = begun(tmp_path / "other", OF_ONE.replace("a, total", "a, b, c, d, total"))
    for each in (one, other):
        advance(each, 10)
    found = _compared(one, other)
    assert (len(found.left), found.left_count, found.variables) == (2, 3, 3)


def test_pointers_are_not_compared_between_programs(tmp_path: Path) -> None:
    source = OF_ONE.replace("VAR a", "VAR p : REF_TO INT; a")
    one, other = begun(tmp_path / "one", source), begun(tmp_path / "other", source.replace("VAR p", "VAR b : LINT; p"))
    for each in (one, other):
        advance(each, 10)
    found = _compared(one, other)
    assert (found.scan, found.same) == (None, "partly")
    assert {each.path: each.reason for each in found.left} == {
        "Main.b": "only in B",
        "Main.p": "where it points is not compared between different programs",
    }
    assert found.variables == 3


def test_a_member_of_a_block_that_has_another_name(tmp_path: Path) -> None:
    one, other = begun(tmp_path / "one", SOURCE), begun(tmp_path / "other", SOURCE.replace("speed", "pace"))
    for each in (one, other):
        advance(each, 10)
    found = _compared(one, other)
    assert (found.scan, found.same) == (None, "partly")
    assert {"Main.belt[1].pace", "Main.belt[1].speed"} <= {each.path for each in found.left}
