"""What a recording does in a thread of its own: nothing is lost, and nobody waits."""

import os
import sys
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest

from scanbench.recording import checkpoints, smaller
from scanbench.recording import format as runfile
from scanbench.recording.blocks import Codec
from scanbench.recording.timeline import Timeline
from scanbench.recording.worker import Worker
from scanbench.runtime.command import Entry, Refusal
from scanbench.runtime.write import Write
from tests.recording.recorded import advance, begun, resumed, tidy


@pytest.fixture
def hasty() -> Iterator[None]:
    """Threads take turns all the time."""
    before = sys.getswitchinterval()
    sys.setswitchinterval(1e-5)
    yield
    sys.setswitchinterval(before)


def _grow(timeline: Timeline, scans: int) -> None:
    """Commands that leave bytes in the file, and the service of a host beside."""
    for _ in range(scans):
        assert isinstance(timeline.submit(Write("Ada", "Main.other", str(timeline.live_scan))), Entry)
        advance(timeline, 1)
        timeline.note()


@pytest.mark.usefixtures("hasty")
def test_thinning_beside_a_run_never_loses_the_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checkpoints, "EVERY_NS", 0)
    path = tmp_path / "run"
    timeline = begun(path, limit=60_000)
    files: set[int] = set()
    for round in range(3_000):  # so many only where the thread that makes it smaller hardly gets a turn
        if round >= 60 and len(files) > 1:
            break
        _grow(timeline, 30)
        files.add(os.fstat(timeline.recording._writer.file.fd).st_ino)
        assert os.fstat(timeline.recording._writer.file.fd).st_ino == path.stat().st_ino
        assert not timeline.recording.trouble
    assert len(files) > 1, "it was never made smaller"
    state, end = timeline.resource.state, timeline.live_scan
    timeline.close()
    assert [each.name for each in tmp_path.iterdir()] == ["run"]
    again = resumed(path)
    assert (again.recording.damage, again.live_scan, again.resource.state) == ("", end, state)
    again.close()


def test_a_file_that_cannot_be_made_smaller_is_left_alone_for_a_while(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(checkpoints, "EVERY_NS", 0)
    timeline = begun(tmp_path / "run", limit=60_000)
    tried = []
    create, replace = runfile.RunFile.create, os.replace

    def full(path: Path, format: int) -> runfile.RunFile:
        tried.append(path)
        raise OSError(28, "No space left on device")

    def read_only(source: Path, target: Path) -> None:
        tried.append(source)
        raise OSError(30, "Read-only file system")

    for name, failing in ((runfile.RunFile, full), (os, read_only)):
        with monkeypatch.context() as patch:
            patch.setattr(name, "create" if name is runfile.RunFile else "replace", failing)
            tried.clear()
            while not tried:
                _grow(timeline, 1)
                tidy(timeline)
            size = timeline.recording.info.bytes
            for _ in range(20):
                tidy(timeline)
            assert len(tried) == 1
            assert not timeline.recording.trouble
            while timeline.recording.info.bytes < size + 10_000:
                _grow(timeline, 1)
                tidy(timeline)
            assert 1 < len(tried) < 5
    assert (create, replace) == (runfile.RunFile.create, os.replace)
    _grow(timeline, 200)
    tidy(timeline)
    assert timeline.recording.info.thinned_before > 0
    assert sorted(each.name for each in tmp_path.iterdir()) == ["run"]
    timeline.close()


def test_the_run_goes_on_while_a_copy_is_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checkpoints, "EVERY_NS", 0)
    timeline = begun(tmp_path / "run", limit=60_000)
    _grow(timeline, 50)
    states = {timeline.live_scan: timeline.resource.state}
    gate, answers, threads = threading.Event(), list[Refusal | None](), list[threading.Thread]()
    timeline.recording._writer.worker.give(lambda: (gate.wait(), None)[1])

    def done(refusal: Refusal | None) -> None:
        answers.append(refusal)
        threads.append(threading.current_thread())

    timeline.copy(tmp_path / "now", None, "Bob", done)
    timeline.copy(tmp_path / "then", 20, "Bob", done)
    timeline.copy(tmp_path / "run", 20, "Bob", done)
    timeline.copy(tmp_path / "later", 2000, "Bob", done)
    assert [each.message for each in answers if each] == [
        "the run cannot be written to run: there is a file of this name already",
        "scan 2000 has not come yet: the PLC is at scan 50",
    ]
    _grow(timeline, 900)
    assert not (tmp_path / "now").exists()
    gate.set()
    tidy(timeline)
    tidy(timeline)
    assert timeline.recording.info.thinned_before > 0
    assert answers[2:] == [None, None]
    assert threading.current_thread() not in threads[2:]
    timeline.close()
    for name, scan in (("now", 50), ("then", 20)):
        copy = resumed(tmp_path / name)
        assert copy.live_scan == scan
        assert states.get(scan, copy.resource.state) == copy.resource.state
        assert copy.recording.about.by == "Bob"
        copy.close()


def test_a_copy_that_cannot_be_written_says_so(tmp_path: Path) -> None:
    timeline = begun(tmp_path / "run")
    advance(timeline, 10)
    answers: list[Refusal | None] = []
    timeline.copy(tmp_path / "nowhere" / "run", None, "Bob", answers.append)
    timeline.close()
    assert [each.message for each in answers if each] == [
        "the run cannot be written to run: No such file or directory",
    ]


def test_what_is_made_when_a_recording_ends_is_taken_away(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checkpoints, "EVERY_NS", 0)
    timeline = begun(tmp_path / "run", limit=60_000)
    gate = threading.Event()
    timeline.recording._writer.worker.give(lambda: (gate.wait(), None)[1])
    _grow(timeline, 300)
    made: list[smaller.Smaller | None] = []

    def make(seen: smaller.Seen, limit: int, codec: Codec) -> smaller.Smaller | None:
        made.append(smaller.make_smaller(seen, limit, codec))
        return made[-1]

    monkeypatch.setattr("scanbench.recording.recording.make_smaller", make)
    gate.set()
    timeline.close()
    assert made[0] is not None
    assert [each.name for each in tmp_path.iterdir()] == ["run"]


def test_work_is_done_in_order_and_synced_in_the_end() -> None:
    done: list[object] = []
    worker = Worker("test", lambda: done.append("sync"))
    worker.wait()
    worker.give(lambda: done.append(1))

    def wrong() -> None:
        raise ZeroDivisionError

    worker.give(wrong)
    worker.give(lambda: done.append(2))
    worker.wait()
    assert done == [1, 2]
    for _ in range(100):
        worker.sync_soon()
    worker.close()
    assert done[:2] == [1, 2]
    assert set(done[2:]) == {"sync"}
    assert len(done) < 10


def test_nobody_needs_a_thread_to_read(tmp_path: Path) -> None:
    begun(tmp_path / "run").close()
    before = threading.active_count()
    with resumed(tmp_path / "run").recording:
        assert threading.active_count() == before
