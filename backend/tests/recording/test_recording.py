"""The run file: what is found again after damage, on a full disk, and when it is over its limit."""

import random
import resource as limits
import subprocess
import sys
import textwrap
from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scanbench.recording import checkpoints
from scanbench.recording import recording as recordings
from scanbench.recording.block import Place
from scanbench.recording.format import Kind, RunFile, RunFileError
from scanbench.recording.reader import Unreadable
from scanbench.recording.recording import Recording
from scanbench.recording.replay import Diverged
from scanbench.recording.replay_file import replay_file
from scanbench.recording.timeline import Timeline
from scanbench.runtime.command import Entry, Refusal
from scanbench.runtime.forces import FORCED, Force
from scanbench.runtime.write import Write
from scanbench.wire.codec import ENTRIES
from tests.amounts import amount, slow
from tests.recording.recorded import SECOND, advance, begun, of_file, of_file_native, resumed, tidy, to_program
from tests.runtime.bench import value

SCANS = 60


@cache
def whole_run() -> tuple[bytes, tuple[bytes, ...], tuple[Entry, ...]]:
    """The bytes of a run file with a bit of everything, the state at each scan, and the journal."""
    import tempfile

    with tempfile.TemporaryDirectory() as folder, pytest.MonkeyPatch.context() as patch:
        patch.setattr(checkpoints, "EVERY_NS", 0)
        patch.setattr(recordings, "DELTAS", 5)
        path = Path(folder, "run")
        timeline = begun(path)
        states = []
        for scan in range(SCANS):
            if scan % 7 == 3:
                timeline.submit(Write("Ada", "Main.other", str(scan)))
            if scan == 20:
                timeline.submit(Force("Bob", "Main.d", "3"))
            if scan == 30:
                assert not to_program(timeline, 2, SECOND)
            states.append(timeline.resource.state)
            advance(timeline, 1)
        states.append(timeline.resource.state)
        timeline.close()
        return path.read_bytes(), tuple(states), tuple(timeline.live_journal)


def _recovered(tmp_path: Path, data: bytes, damaged_at: int) -> None:
    """Everything before the damage is there unchanged, and recording continues."""
    path = tmp_path / "run"
    for old in tmp_path.glob("run*"):
        old.unlink()
    path.write_bytes(data)
    _, states, journal = whole_run()
    try:
        timeline = resumed(path)
    except RunFileError:
        assert path.read_bytes() == data, "what cannot be used is left as it was"
        return
    scan = timeline.live_scan
    known = tuple(timeline.live_journal)
    assert set(known) <= set(journal)
    if known == tuple(entry for entry in journal if entry.scan <= scan):
        assert timeline.resource.state == states[scan]
    asides = list(tmp_path.glob("run.damaged-*"))
    if timeline.recording.ends_early:
        assert asides
    if asides:
        at = len(data) - asides[0].stat().st_size
        assert data[at:] == asides[0].read_bytes()
        assert at <= damaged_at, "only what is damaged goes"
        assert f"byte {at}" in timeline.recording.damage
        assert f"scan {scan}" in timeline.recording.damage
    damage, gaps = bool(asides) and not timeline.recording.gaps, timeline.recording.info.lost
    advance(timeline, 3)
    assert isinstance(timeline.submit(Write("Ada", "Main.n", "5")), Entry)
    state, end = timeline.resource.state, timeline.live_scan
    timeline.close()
    again = resumed(path)
    assert again.recording.info.lost == gaps, "what is lost stays lost"
    assert not damage or not again.recording.damage, "what was put aside is not told again"
    assert (again.live_scan, again.resource.state) == (end, state)
    first = again.recording.first_scan
    for wanted in {first, (first + scan) // 2, max(first, scan - 1)}:
        if any(each.first <= wanted < each.until for each in gaps):
            continue
        assert again.goto(wanted) is None
        assert again.resource.state == states[wanted]
    again.close()


@settings(max_examples=amount(120, 20), deadline=None)
@given(part=st.floats(0, 1))
def test_a_file_that_was_cut_short_is_recovered_up_to_there(
    tmp_path_factory: pytest.TempPathFactory, part: float
) -> None:
    data = whole_run()[0]
    at = round(part * len(data))
    _recovered(tmp_path_factory.mktemp("cut"), data[:at], at)


@settings(max_examples=amount(160, 26), deadline=None)
@given(part=st.floats(0, 1, exclude_max=True), flip=st.integers(1, 255))
def test_a_flipped_byte_costs_what_follows_it(tmp_path_factory: pytest.TempPathFactory, part: float, flip: int) -> None:
    data = whole_run()[0]
    at = int(part * len(data))
    _recovered(tmp_path_factory.mktemp("flip"), data[:at] + bytes((data[at] ^ flip,)) + data[at + 1 :], at)


def test_what_was_lost_is_counted(tmp_path: Path) -> None:
    data = whole_run()[0]
    path = tmp_path / "run"
    path.write_bytes(data)
    file = RunFile.open(path)
    blocks = list(file.scan_blocks())
    hit = [each for each in blocks if each.kind is Kind.ENTRY][-1]
    file.cut(hit.end, None)  # no state comes after it
    file.end_after(hit, hit.end, Place(hit.entries_after))
    file.mark(SCANS)
    file.close()
    data = path.read_bytes()
    path.write_bytes(data[: hit.offset + 40] + b"\0\0" + data[hit.offset + 42 :])
    timeline = resumed(path, until=SCANS)  # what the parent knew does not count after damage: entries are missing
    assert timeline.live_scan <= hit.scan
    assert f"{SCANS - timeline.live_scan} scans after it, up to {SCANS}, are lost" in timeline.recording.damage
    assert timeline.recording.info.damage == timeline.recording.damage
    timeline.close()


def test_what_is_no_run_file_is_refused_and_left_alone(tmp_path: Path) -> None:
    path = tmp_path / "run"
    for data, message in (
        (b"", "is not a run file"),
        (b"PK\x03\x04 something else altogether", "is not a run file"),
        (whole_run()[0][:14] + b"\x07\0" + whole_run()[0][16:], "format 7"),
        (whole_run()[0][:16], "nothing of the run can be recovered"),
    ):
        path.write_bytes(data)
        with pytest.raises(RunFileError, match=message):
            resumed(path)
        assert path.read_bytes() == data


def test_a_different_model_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "run"
    begun(path).close()
    monkeypatch.setattr("scanbench.recording.replay.model_fingerprint", lambda model: "another")
    with pytest.raises(RunFileError, match="a different description of the model CJ1M-CPU63"):
        resumed(path)


# ---- a full disk ---------------------------------------------------------------------------------------------------

FULL = """
import resource, sys
from pathlib import Path
from scanbench.recording import checkpoints
from scanbench.runtime.command import Refusal, Entry
from scanbench.runtime.write import Write
from tests.recording.recorded import advance, begun, resumed
checkpoints.EVERY_NS = 0
path = Path(sys.argv[1])
timeline = begun(path)
advance(timeline, 10)
assert isinstance(timeline.submit(Write("Ada", "Main.n", "100")), Entry)
soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
resource.setrlimit(resource.RLIMIT_FSIZE, (path.stat().st_size + 10, hard))
before = timeline.resource.state
refused = timeline.submit(Write("Ada", "Main.n", "200"))
assert isinstance(refused, Refusal) and "disk is full" in refused.message, refused
assert timeline.resource.state == before
advance(timeline, 10)
timeline.note()
assert "cannot be written" in timeline.recording.info.recording
assert timeline.live_scan == 20
timeline.submit(Write("Ada", "Main.n", "200"))
assert timeline.goto(15) is None
timeline.return_live()
resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
advance(timeline, 10)
timeline.note()
assert timeline.recording.info.recording == ""
assert isinstance(timeline.submit(Write("Ada", "Main.n", "300")), Entry)
state = timeline.resource.state
timeline.close()
again = resumed(path)
assert again.resource.state == state and not again.recording.damage and again.live_scan == 30
print("well")
"""


def test_on_a_full_disk_the_plc_goes_on_and_commands_are_refused(tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-c", FULL, str(tmp_path / "run")], capture_output=True, text=True, check=False
    )  # fmt: skip
    assert done.stdout == "well\n", done.stderr
    assert limits.getrlimit(limits.RLIMIT_FSIZE)[0] in (-1, limits.RLIM_INFINITY)


def test_what_the_plc_found_itself_is_written_when_there_is_room(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "run"
    timeline = begun(path)
    advance(timeline, 5)
    timeline.submit(Write("Ada", "Main.d", "0"))
    write: Callable[[int, bytes, int], None] = __import__("scanbench.recording.format", fromlist=["_write"])._write

    def full(fd: int, data: bytes, offset: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("scanbench.recording.format._write", full)
    advance(timeline, 1)
    assert timeline.resource.trap is not None
    assert timeline.recording.trouble
    monkeypatch.setattr("scanbench.recording.format._write", write)
    assert not isinstance(timeline.submit(Write("Ada", "Main.d", "1")), Refusal)
    state = timeline.resource.state
    timeline.close()
    again = resumed(path)
    assert again.resource.state == state
    assert again.resource.trap is not None
    assert [type(entry.command).__name__ for entry in again.live_journal] == ["Write", "Trapped", "Write"]


# ---- bounds --------------------------------------------------------------------------------------------------------


def _long_run(path: Path, limit: int, rounds: int, monkeypatch: pytest.MonkeyPatch, entries: int) -> dict[int, bytes]:
    """Many checkpoints with noise in them; some states on the way."""
    monkeypatch.setattr(checkpoints, "EVERY_NS", 0)
    monkeypatch.setattr(recordings, "DELTAS", 7)
    chance = random.Random(5)
    timeline = begun(path, limit=limit)
    timeline.submit(Force("Bob", "Main.other", "77"))
    states = {0: timeline.resource.state}
    for _ in range(rounds):
        for _ in range(entries):
            noise = "".join(chance.choices("0123456789ABCDEF", k=16))
            timeline.submit(Write("Ada", f"D{chance.randrange(3000)}", f"16#{noise[:4]}"))
        states[timeline.live_scan] = timeline.resource.state
        timeline.run(1)
        tidy(timeline)
    assert timeline.resource.journal.derived(FORCED).keys() == {"MAIN.OTHER"}
    info = timeline.recording.info
    assert info.bytes <= limit * 1.3
    assert path.stat().st_size <= limit * 1.3
    _reachable(timeline, states)
    state = timeline.resource.state
    timeline.close()
    assert not path.with_name(path.name + ".part").exists()
    again = resumed(path, limit=limit)
    assert again.resource.state == state
    assert again.recording.info.thinned_before == info.thinned_before
    assert again.recording.info.dropped_before == info.dropped_before
    assert again.resource.journal.derived(FORCED).keys() == {"MAIN.OTHER"}
    _reachable(again, states)
    again.close()
    return states


def _reachable(timeline: Timeline, states: dict[int, bytes]) -> None:
    """Every scan from the first on."""
    first = timeline.recording.info.first_scan
    for scan, state in states.items():
        if scan >= first:
            assert timeline.goto(scan) is None
            assert timeline.resource.state == state
        else:
            assert isinstance(timeline.goto(scan), Refusal)
    timeline.return_live()


def test_over_its_limit_older_checkpoints_are_thinned(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "run"
    _long_run(path, 60_000, 600, monkeypatch, 1)
    recording = Recording.open(path, ENTRIES)
    info = recording.info
    recording.close()
    assert info.thinned_before > 0


def test_when_nothing_is_left_to_thin_the_oldest_part_goes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "run"
    _long_run(path, 100_000, 400, monkeypatch, 5)
    recording = Recording.open(path, ENTRIES)
    info = recording.info
    recording.close()
    assert 0 < info.dropped_before <= info.first_scan


def test_a_run_with_plenty_of_room_is_never_thinned(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "run"
    states = _long_run(path, 10_000_000, 300, monkeypatch, 1)
    recording = Recording.open(path, ENTRIES)
    assert (recording.info.first_scan, recording.info.thinned_before, recording.info.dropped_before) == (0, 0, 0)
    assert len(recording.checkpoints) >= len(states)
    recording.close()


# ---- replay --------------------------------------------------------------------------------------------------------


def test_a_run_file_replays_with_every_checkpoint(tmp_path: Path) -> None:
    path = tmp_path / "run"
    path.write_bytes(whole_run()[0])
    replayed = replay_file(path, of_file, ENTRIES)
    assert (replayed.first_scan, replayed.scan, replayed.scans) == (0, SCANS, SCANS)
    assert replayed.checkpoints >= SCANS
    part = replay_file(path, of_file, ENTRIES, until=31)
    assert part.scan == 31
    assert part.hash != replayed.hash
    with pytest.raises(Unreadable, match="scan 99 is none of them"):
        replay_file(path, of_file, ENTRIES, until=99)
    assert path.read_bytes() == whole_run()[0]


def test_a_replay_that_goes_otherwise_says_where(tmp_path: Path) -> None:
    path = tmp_path / "run"
    timeline = begun(path)
    advance(timeline, 7)
    at = timeline.resource.program.layout.areas["D"]
    timeline.resource.memory[at + 9] ^= 1  # as nothing may: past the door
    timeline._checkpoints.take(timeline.resource)
    timeline.close()
    with pytest.raises(Diverged, match=f"before scan 7 byte {at + 9} of the image"):
        replay_file(path, of_file, ENTRIES)


REPLAY = """
import sys
from pathlib import Path
from scanbench.recording.replay_file import replay_file
from scanbench.wire.codec import ENTRIES
from tests.recording.recorded import of_file_native
print(replay_file(Path(sys.argv[1]), of_file_native, ENTRIES).hash)
"""
RECORD = """
import sys
from pathlib import Path
from scanbench.engines.native.engine import NativeEngine
from scanbench.runtime.write import Write
from scanbench.runtime.forces import Force
from tests.recording.recorded import SECOND, advance, begun, to_program
timeline = begun(Path(sys.argv[1]), engine=NativeEngine)
for scans, command in ((300_000, Write("Ada", "Main.n", "5")), (1, Force("Bob", "Main.d", "7")), (299_999, None)):
    advance(timeline, scans)
    if command is not None:
        timeline.submit(command)
assert not to_program(timeline, 2, SECOND)
advance(timeline, 400_000)
timeline.note()
print("killed", flush=True)
import os, signal
os.kill(os.getpid(), signal.SIGKILL)
"""


@slow
def test_two_processes_replay_a_million_scans_of_a_killed_run_to_the_same_hash(tmp_path: Path) -> None:
    path = tmp_path / "run"
    killed = _python(RECORD, path)
    assert killed.stdout == "killed\n", killed.stderr
    hashes = {_python(REPLAY, path).stdout for _ in range(2)}
    assert len(hashes) == 1
    timeline = Timeline.resume(path, of_file_native, ENTRIES)
    assert timeline.live_scan == 1_000_000
    assert value(timeline.resource, "Main.d") == 7
    timeline.close()
    assert {_python(REPLAY, path).stdout} == hashes
    assert len(hashes.pop()) == 65


def _python(text: str, path: Path) -> "subprocess.CompletedProcess[str]":
    return subprocess.run(
        [sys.executable, "-c", textwrap.dedent(text), str(path)], capture_output=True, text=True, check=False
    )  # fmt: skip
