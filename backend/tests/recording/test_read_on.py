"""A run file that is read while somebody else writes it."""

import os
import threading
from pathlib import Path

import pytest

from scanbench.recording import checkpoints
from scanbench.recording import recording as recordings
from scanbench.recording.format import RunFile, RunFileError
from scanbench.recording.recording import Recording, Replaced
from scanbench.runtime.command import Entry
from scanbench.runtime.write import Write
from scanbench.wire.codec import ENTRIES
from tests.recording.recorded import SECOND, advance, begun, to_program
from tests.recording.test_recording import whole_run


def _opened(path: Path) -> Recording:
    return Recording.open(path, ENTRIES, read_only=True)


def test_what_is_appended_is_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checkpoints, "EVERY_NS", 0)
    monkeypatch.setattr(recordings, "DELTAS", 3)
    timeline = begun(tmp_path / "run")
    advance(timeline, 5)
    timeline.note()
    with _opened(timeline.recording.path) as reading:
        entries = reading.take_entries()
        assert reading.read_on() == []
        for scan in range(5, 40):
            timeline.submit(Write("Ada", "Main.other", str(scan)))
            if scan == 20:
                assert not to_program(timeline, 2, SECOND)
            advance(timeline, 1)
            if scan % 3:
                timeline.note()
            entries += reading.read_on()
            assert entries == list(timeline.live_journal)
            assert reading.last_scan == timeline.live_scan
            assert [each.scan for each in reading.checkpoints] == [each.scan for each in timeline.recording.checkpoints]
            assert [each.entries for each in reading.checkpoints] == [
                each.entries for each in timeline.recording.checkpoints
            ]
            newest, size = reading.checkpoints[-1], timeline.resource.program.layout.state_size
            assert reading.state(newest, size) == timeline.recording.state(newest, size)
            assert not reading.damage
        assert set(reading.programs) == {1, 2}
    timeline.close()


def test_a_block_that_is_not_whole_yet_is_read_later(tmp_path: Path) -> None:
    """The file grows byte by byte: nothing is missed, nothing read twice, whatever the reader sees of the last block."""
    data, _, journal = whole_run()
    path = tmp_path / "run"
    with Recording.open(_written(tmp_path / "whole", data), ENTRIES, read_only=True) as whole:
        first = whole.checkpoints[1].block.end
        known = [(each.scan, each.entries) for each in whole.checkpoints]
    path.write_bytes(data[:first])
    with _opened(path) as reading:
        entries: list[Entry] = reading.take_entries()
        for end in range(first, len(data) + 1, 7):
            with path.open("r+b") as file:
                file.seek(max(first, end - 7))
                file.write(data[max(first, end - 7) : end])
            entries += reading.read_on()
            assert entries == list(journal[: len(entries)])
        path.write_bytes(data)
        entries += reading.read_on()
        assert tuple(entries) == journal
        assert [(each.scan, each.entries) for each in reading.checkpoints] == known
        assert not reading.damage


def test_a_file_that_grows_while_it_is_read_is_read_as_long_as_it_was(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The writer appends after the reader has asked how long the file is: what came later is read later."""
    data = whole_run()[0]
    path = tmp_path / "run"
    ask = os.fstat

    def ask_then_grow(fd: int) -> os.stat_result:
        found = ask(fd)
        path.write_bytes(data)
        return found

    monkeypatch.setattr(os, "fstat", ask_then_grow)
    file = RunFile.open(_written(path, data), read_only=True)
    whole = list(file.scan_blocks())
    file.close()
    assert file.damage is None
    last = whole[-8:]
    for end in range(last[0].offset + 1, len(data)):
        path.write_bytes(data[:end])
        file = RunFile.open(path, read_only=True)
        assert list(file.scan_blocks()) == [each for each in whole if each.end <= end]
        assert file.damage is None or file.damage.torn
        file.close()


def test_a_mark_that_is_being_overwritten_is_no_damage(tmp_path: Path) -> None:
    timeline = begun(tmp_path / "run")
    advance(timeline, 5)
    timeline.note()
    path = timeline.recording.path
    with _opened(path) as reading:
        before = path.read_bytes()
        end = timeline.recording.info.bytes
        assert len(before) > end, "there is a mark"
        timeline.submit(Write("Ada", "Main.other", "1"))
        after = path.read_bytes()
        for done in range(end, len(after)):  # what came of the write so far, over the mark
            half = after[:done] + before[done:]
            path.write_bytes(half)
            assert reading.read_on() == []
        path.write_bytes(after)
        assert reading.read_on() == list(timeline.live_journal)
        assert not reading.damage
    timeline.close()


def test_a_reader_follows_a_writer(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Both at work at the same time."""
    monkeypatch.setattr(checkpoints, "EVERY_NS", 0)
    timeline = begun(tmp_path / "run")
    advance(timeline, 1)
    written = threading.Event()

    def write() -> None:
        for scan in range(400):
            timeline.submit(Write("Ada", "Main.other", str(scan)))
            advance(timeline, 1)
            timeline.note()
        written.set()

    with _opened(timeline.recording.path) as reading:
        entries = reading.take_entries()
        thread = threading.Thread(target=write)
        thread.start()
        while not written.is_set():
            entries += reading.read_on()
        thread.join()
        entries += reading.read_on()
        assert entries == list(timeline.live_journal)
        assert reading.last_scan == timeline.live_scan
        assert not reading.damage
    timeline.close()


def test_a_file_that_was_replaced_or_deleted_is_told(tmp_path: Path) -> None:
    data = whole_run()[0]
    path = _written(tmp_path / "run", data)
    with _opened(path) as reading:
        assert reading.read_on() == []
        os.replace(_written(tmp_path / "smaller", data), path)
        with pytest.raises(Replaced, match="open it again"):
            reading.read_on()
    with _opened(path) as reading:
        path.unlink()
        with pytest.raises(Replaced, match="gone"):
            reading.read_on()


def test_a_file_that_was_cut_off_is_told(tmp_path: Path) -> None:
    path = _written(tmp_path / "run", whole_run()[0])
    with _opened(path) as reading:
        os.truncate(path, 100)
        with pytest.raises(RunFileError, match="cut off at byte 100"):
            reading.read_on()


def test_damage_is_reported_until_it_is_repaired(tmp_path: Path) -> None:
    data = whole_run()[0]
    path = _written(tmp_path / "run", data[:-100])
    with _opened(path) as reading:
        known = len(reading.take_entries())
        assert "damaged" in reading.damage or "ended in the middle" in reading.damage
        path.write_bytes(data)
        assert known + len(reading.read_on()) == len(whole_run()[2])
        assert not reading.damage


def _written(path: Path, data: bytes) -> Path:
    path.write_bytes(data)
    return path
