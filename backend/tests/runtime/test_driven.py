"""How a PLC is driven is in its run file, whatever becomes of the rest."""

import os
from pathlib import Path

import pytest

from scanbench.recording import checkpoints
from scanbench.recording import recording as recordings
from scanbench.recording.format import RunFile
from scanbench.recording.recording import Recording
from scanbench.runtime.write import Write
from scanbench.wire.codec import ENTRIES
from tests.recording.recorded import advance, begun, resumed, tidy


def driven(path: Path) -> bytes:
    with Recording.open(path, ENTRIES, read_only=True) as recording:
        return recording.driven


def test_it_is_there_again_after_whatever_was_written_later(tmp_path: Path) -> None:
    path = tmp_path / "run"
    timeline = begun(path)
    advance(timeline, 5)
    assert driven(path) == b""
    timeline.drive(b"paused")
    assert driven(path) == b"paused"
    timeline.submit(Write("Ada", "Main.n", "5"))
    timeline.drive(b"x10")
    advance(timeline, 5)
    timeline.submit(Write("Ada", "Main.n", "6"))
    timeline.note()
    state = timeline.resource.state
    timeline.close()
    for _ in range(2):  # a kept mark at the very end is not written over by the next life
        again = resumed(path)
        assert (again.recording.driven, again.live_scan, again.resource.state) == (b"x10", 10, state)
        again.note()
        again.close()


def test_it_outlives_the_part_that_it_was_said_in(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checkpoints, "EVERY_NS", 0)
    monkeypatch.setattr(recordings, "DELTAS", 7)
    path = tmp_path / "run"
    timeline = begun(path, limit=60_000)
    timeline.drive(b"paused")
    for number in range(400):
        for word in range(5):
            timeline.submit(Write("Ada", f"D{(number * 7919 + word) % 3000}", f"16#{number * 31 + word:04X}"))
        timeline.run(1)
        tidy(timeline)
    assert timeline.recording.info.dropped_before > 0
    state = timeline.resource.state
    assert timeline.goto(timeline.recording.first_scan) is None
    timeline.return_live()
    timeline.close()
    again = resumed(path)
    assert (again.recording.driven, again.resource.state) == (b"paused", state)
    again.close()


def test_a_copy_is_driven_as_whoever_opens_it_wants(tmp_path: Path) -> None:
    timeline = begun(tmp_path / "run")
    timeline.drive(b"x10")
    advance(timeline, 5)
    timeline.copy(tmp_path / "copy", None, "Ada", lambda refusal: None)
    timeline.recording.wait()
    assert driven(tmp_path / "copy") == b""
    timeline.close()


def test_a_smaller_file_never_ends_before_its_last_entry(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Killed when it has just taken the place of the old one, it must be one that can be read."""
    monkeypatch.setattr(checkpoints, "EVERY_NS", 0)
    path = tmp_path / "run"
    timeline = begun(path, limit=20_000)
    seen: list[bytes] = []

    def replaced(source: Path, target: Path) -> None:
        seen.append(Path(source).read_bytes())
        os.rename(source, target)

    monkeypatch.setattr("scanbench.recording.recording.os.replace", replaced)
    for number in range(300):
        timeline.note()
        advance(timeline, 3)
        timeline.submit(Write("Ada", "Main.n", str(number)))
        timeline.recording.wait()
    timeline.close()
    assert seen
    for number, data in enumerate(seen):
        there = tmp_path / f"then-{number}"
        there.write_bytes(data)
        Recording.open(there, ENTRIES, read_only=True).close()


def test_who_is_killed_before_a_run_has_begun_leaves_no_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path, written = tmp_path / "run", RunFile.append

    class Killed(BaseException):
        pass

    for count in range(3):
        calls = iter(range(10))

        def append(self: RunFile, *block: object) -> object:
            if next(calls) == count:  # noqa: B023
                raise Killed
            return written(self, *block)  # type: ignore[arg-type]

        monkeypatch.setattr(RunFile, "append", append)
        with pytest.raises(Killed):
            begun(path)
        assert not path.exists()
        monkeypatch.setattr(RunFile, "append", written)
    begun(path).close()
    resumed(path).close()
