"""What changed between two scans, or between two runs."""

from datetime import UTC, datetime
from pathlib import Path

import pytest

from scanbench.history import changes as changing
from scanbench.history.changes import find_changes
from scanbench.history.contract import Changes
from scanbench.recording.reader import RunReader, Unreadable
from scanbench.runtime.set_clock import SetClock
from scanbench.runtime.write import Write
from scanbench.wire.codec import ENTRIES
from tests.history.test_writer import LINE
from tests.recording.recorded import advance, begun, of_file, to_program


def _between(path: Path, first: int, last: int, until: int) -> Changes:
    with RunReader(path, of_file, ENTRIES) as reading:
        reading.follow(until)
        return find_changes(reading, first, last)


def _shown(found: Changes) -> dict[str, tuple[str, str]]:
    assert found.count == len(found.changes)
    return {each.path: (each.before_shown, each.after_shown) for each in found.changes}


def test_variables_that_changed(tmp_path: Path) -> None:
    timeline = begun(tmp_path / "run", LINE)
    advance(timeline, 20)
    path = timeline.recording.path
    assert _shown(_between(path, 4, 5, 20)) == {
        "Main.n": ("4", "5"),
        "Main.quiet": ("0", "7"),
        "Main.text": ("''", "'five'"),
        "Main.pair.b": ("0", "2"),
        "Main.bits": ("16#0000", "16#0008"),
        "Main.kept": ("0", "1"),
        "Main.list[5]": ("0", "5"),
    }
    assert _shown(_between(path, 6, 7, 20)) == {
        "Main.n": ("6", "7"),
        "Main.lamp": ("FALSE", "TRUE"),
        "Main.list[7]": ("0", "7"),
    }
    belt = _shown(_between(path, 8, 9, 20))
    assert belt["Main.belt[1].seen"] == ("0", "1"), "what nothing reads counts as well"
    assert belt["Main.belt[1].go"] == ("FALSE", "TRUE")
    assert not _between(path, 7, 7, 20).changes


def test_what_was_entered_in_between(tmp_path: Path) -> None:
    timeline = begun(tmp_path / "run", LINE)
    advance(timeline, 4)
    timeline.submit(Write("Ada", "Main.quiet", "1"))
    timeline.submit(SetClock("Bob", datetime(2030, 1, 2, tzinfo=UTC)))
    advance(timeline, 4)
    timeline.submit(Write("Cleo", "D100", "7"))
    path = timeline.recording.path
    found = _between(path, 3, 8, 8)
    assert [(each.scan, each.author) for each in found.entries] == [(4, "Ada"), (4, "Bob"), (8, "Cleo")]
    assert found.entries[0].text.startswith("Write: Main.quiet")
    assert _shown(found)["D100"] == ("16#0000", "16#0007")
    assert not any(each.path.startswith("A") for each in found.changes), "the clock is nobody's change"
    assert not _between(path, 4, 5, 8).entries, "they were entered before scan 4"


def test_another_program_in_between(tmp_path: Path) -> None:
    timeline = begun(tmp_path / "run", LINE)
    advance(timeline, 8)
    second = LINE.replace("VAR n, quiet", "VAR more : LINT; quiet, n").replace("quiet := 7; lamp", "quiet := 8; lamp")
    timeline.programs.sources[2] = second  # type: ignore[attr-defined]
    assert not to_program(timeline, 2, second)
    advance(timeline, 2)
    found = _between(timeline.recording.path, 7, 10, 10)
    values = _shown(found)
    assert values.pop("Main.list[8]") == ("0", "8")
    assert values.pop("Main.n") == ("7", "10")
    assert values.pop("Main.one") == ("0", "1")
    assert set(values) == {"Main.list[0]", "Main.list[9]", "Main.belt[1].seen"}
    assert "by their names" in found.note
    assert "Main.more" not in _shown(found)
    assert found.entries[0].text.startswith("ProgramChange")


def test_two_runs(tmp_path: Path) -> None:
    one, other = begun(tmp_path / "one", LINE), begun(tmp_path / "other", LINE)
    advance(one, 6)
    other.submit(Write("Ada", "Main.two", "5"))
    advance(other, 6)
    with RunReader(tmp_path / "one", of_file, ENTRIES) as a, RunReader(tmp_path / "other", of_file, ENTRIES) as b:
        a.follow(6)
        b.follow(6)
        assert _shown(find_changes(a, 6, 6, b)) == {"Main.two": ("0", "5")}
        assert not find_changes(a, 6, 6, b).entries


def test_so_many_that_they_are_not_all_listed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(changing, "MAX_CHANGES", 2)
    timeline = begun(tmp_path / "run", LINE)
    advance(timeline, 20)
    found = _between(timeline.recording.path, 4, 5, 20)
    assert (len(found.changes), found.count) == (2, 7)
    assert "the first 2 variables" in found.note
    assert not found.at_least


def test_more_than_is_looked_at_is_at_least_so_many(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    timeline = begun(tmp_path / "run", LINE)
    advance(timeline, 20)
    monkeypatch.setattr(changing, "_MOST", 3)
    found = _between(timeline.recording.path, 4, 5, 20)
    assert (found.count < 7, found.at_least) == (True, True)


def test_what_cannot_be_told(tmp_path: Path) -> None:
    timeline = begun(tmp_path / "run", LINE)
    advance(timeline, 5)
    path = timeline.recording.path
    with pytest.raises(Unreadable, match="before scan 3"):
        _between(path, 3, 2, 5)
    with pytest.raises(Unreadable, match="has not come yet"):
        _between(path, 3, 9, 5)
