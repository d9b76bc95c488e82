"""Run files from elsewhere: whatever is in them, they are refused with a sentence, cheaply, and closed again."""

import json
import os
import struct
import zlib
from contextlib import suppress
from dataclasses import asdict, fields, replace
from datetime import UTC, datetime
from pathlib import Path

import pytest
import zstandard

from scanbench.recording import blocks as contents
from scanbench.recording.blocks import About, KeptProgram, keyframe
from scanbench.recording.format import LARGEST, Kind, RunFile, RunFileError
from scanbench.recording.reader import Unreadable
from scanbench.recording.recording import Recording
from scanbench.recording.replay_file import replay_file
from scanbench.runtime.command import Entry, Patch, Plan, Swapped
from scanbench.runtime.program_change import ProgramChange
from scanbench.runtime.write import Write
from scanbench.wire.codec import ENTRIES
from tests.recording.recorded import COUNTER, advance, begun, of_file, resumed
from tests.runtime.bench import program
from tests.wire.packed import packed_with

AT = datetime(2026, 1, 1, tzinfo=UTC)
Blocks = list[tuple[Kind, int, bytes]]
ABOUT = About.of(program(COUNTER), "Ada")
PROGRAM = KeptProgram(1, COUNTER.encode(), "0" * 64).packed()
FIRST: Blocks = [(Kind.ABOUT, 0, ABOUT.packed()), (Kind.PROGRAM, 0, PROGRAM)]
STATE = (Kind.KEYFRAME, 0, keyframe(1, b"abc"))


def entry(scan: int, *patches: Patch) -> bytes:
    return ENTRIES.pack(Entry(scan, AT, Write("Ada", "Main.n", "1"), Plan(patches, "")))


CHANGE = ENTRIES.pack(Entry(0, AT, ProgramChange("Ada", 7), Plan((), "", Swapped(7, False, ()))))
NONSENSE = ENTRIES.pack(Entry(0, AT, ProgramChange("Ada", 7), Plan((), "", Swapped([7], False, ()))))  # type: ignore[arg-type]


def about(**changed: object) -> bytes:
    return json.dumps({**asdict(ABOUT), **changed}).encode()


def newer_entry() -> bytes:
    """With a field that only a newer version knows: whoever does not know it would replay it wrong."""
    kept = ENTRIES.unpack(entry(0))
    return packed_with("Entry", *(getattr(kept, each.name) for each in fields(kept)), "more")


CASES: dict[str, tuple[Blocks, str]] = {
    "nothing": ([], "damaged at its beginning"),
    "no about": ([STATE], "damaged at its beginning"),
    "about is no JSON": ([(Kind.ABOUT, 0, b"{")], "does not say what was recorded"),
    "about is deep": ([(Kind.ABOUT, 0, b"[" * 60_000)], "does not say what was recorded"),
    "about is long": ([(Kind.ABOUT, 0, b" " * 70_000)], "70000 bytes, and 65536 is the most"),
    "about of something else": ([(Kind.ABOUT, 0, b'{"model": 1}')], "does not say what was recorded"),
    "about with a list": ([(Kind.ABOUT, 0, about(model=[1]))], "model must be a text"),
    "no program": ([FIRST[0], STATE], "needs program version 1, which is not before it"),
    "no checkpoint": (FIRST, "before its first checkpoint"),
    "a short program": ([FIRST[0], (Kind.PROGRAM, 0, b"\1\0\0\0abc"), STATE], "it is too short"),
    "a state of no program": ([*FIRST, (Kind.KEYFRAME, 0, keyframe(2, b"abc"))], "needs program version 2"),
    "a change to no program": ([*FIRST, STATE, (Kind.ENTRY, 0, CHANGE)], "needs program version 7"),
    "a change to nonsense": ([*FIRST, STATE, (Kind.ENTRY, 0, NONSENSE)], "must be a whole number, not"),
    "an empty keyframe": ([*FIRST, (Kind.KEYFRAME, 0, b"")], "it is too short"),
    "a delta of nothing": ([*FIRST, (Kind.DELTA, 0, b"abc")], "nothing of this kind can be here"),
    "an entry that is none": ([*FIRST, STATE, (Kind.ENTRY, 0, b"\xc1")], "the entry at byte"),
    "an entry that is something else": ([*FIRST, STATE, (Kind.ENTRY, 0, b"\x01")], "the entry at byte"),
    "an entry of a newer version": (
        [*FIRST, STATE, (Kind.ENTRY, 0, newer_entry())],
        "Entry has 5 fields, not 6. Open it with the version of scanbench that wrote it",
    ),
    "an entry of another scan": ([*FIRST, STATE, (Kind.ENTRY, 3, entry(2))], "of scan 2, and is kept at scan 3"),
    "time goes back": ([*FIRST, (Kind.KEYFRAME, 5, STATE[2]), (Kind.ENTRY, 2, entry(2))], "after one of scan 5"),
}


def write(path: Path, blocks: Blocks) -> Path:
    path.unlink(missing_ok=True)
    file = RunFile.create(path)
    for block in blocks:
        file.append(*block)
    file.close()
    return path


def raw(kind: Kind, packing: int, payload: bytes, scan: int = 0) -> bytes:
    """A block with a right checksum, whatever is in it."""
    head = struct.pack("<4sBBHIQQI", b"\xf5RB\n", kind, packing, 0, len(payload), scan, 0, 0)
    return head + struct.pack("<I", zlib.crc32(payload, zlib.crc32(head))) + payload


def open_files(folder: Path) -> list[str]:
    """Files of this folder that the process has open; what other tests left open may be closed at any time."""
    found = []
    for each in os.listdir("/proc/self/fd"):
        with suppress(FileNotFoundError):
            found.append(os.readlink(f"/proc/self/fd/{each}"))
    return [each for each in found if each.startswith(str(folder))]


@pytest.mark.parametrize("name", CASES)
def test_a_file_that_makes_no_sense_is_refused(name: str, tmp_path: Path) -> None:
    blocks, message = CASES[name]
    path = write(tmp_path / "run", blocks)
    for read_only in (True, False):
        with pytest.raises(RunFileError, match=message):
            Recording.open(path, ENTRIES, read_only=read_only)
    with pytest.raises(Unreadable, match=message):
        replay_file(path, of_file, ENTRIES)
    with pytest.raises(RunFileError, match=message):
        resumed(path)
    assert open_files(tmp_path) == []


@pytest.mark.parametrize(
    "payload",
    [
        b"no frame at all",
        zstandard.compress(b"x" * 1000)[:-9],
        zstandard.ZstdCompressor(write_content_size=False).compress(b"x" * 1000),
        zstandard.compress(bytes(LARGEST + 1)),
    ],
    ids=["no frame", "half a frame", "of unknown size", "a bomb"],
)
@pytest.mark.parametrize("kind", [Kind.PROGRAM, Kind.ENTRY])
def test_what_cannot_be_unpacked_is_refused(kind: Kind, payload: bytes, tmp_path: Path) -> None:
    path = write(tmp_path / "run", [*FIRST, STATE])
    with path.open("ab") as file:
        file.write(raw(kind, 1, payload))
    with pytest.raises(RunFileError, match=f"the {kind.name.lower()} at byte"):
        Recording.open(path, ENTRIES, read_only=True)
    assert open_files(tmp_path) == []


@pytest.mark.parametrize(
    ("told", "read"),
    [
        (about(of_a_newer_version=[1]), ABOUT),
        (about()[:-1].rpartition(b",")[0] + b"}", replace(ABOUT, marks=False)),  # as before there were marks at the end
    ],
)
def test_what_was_recorded_may_say_more_or_less(told: bytes, read: About, tmp_path: Path) -> None:
    path = write(tmp_path / "run", [(Kind.ABOUT, 0, told), FIRST[1], STATE])
    with Recording.open(path, ENTRIES, read_only=True) as recording:
        assert recording.about == read


@pytest.mark.parametrize(("kind", "packing", "reserved"), [(7, 0, 0), (0, 0, 0), (3, 2, 0), (3, 0, 256), (4, 0, 1)])
def test_a_block_of_a_newer_version_is_no_damage(kind: int, packing: int, reserved: int, tmp_path: Path) -> None:
    """What is damaged is cut off when the run goes on."""
    path = write(tmp_path / "run", [*FIRST, STATE])
    with path.open("ab") as file:
        head = struct.pack("<4sBBHIQQI", b"\xf5RB\n", kind, packing, reserved, 3, 0, 0, 0)
        file.write(head + struct.pack("<I", zlib.crc32(b"abc", zlib.crc32(head))) + b"abc")
    before = path.read_bytes()
    for read_only in (True, False):
        with pytest.raises(
            RunFileError, match=f"is of kind {kind}, .* Open it with the version of scanbench that wrote"
        ):
            Recording.open(path, ENTRIES, read_only=read_only)
    assert path.read_bytes() == before


def test_many_programs_are_not_read_for_ever(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(contents, "_UNPACKED", 1 << 20)
    big = [(Kind.PROGRAM, 0, KeptProgram(version, bytes(300_000), "0" * 64).packed()) for version in range(2, 6)]
    with pytest.raises(RunFileError, match="of more than"):
        Recording.open(write(tmp_path / "run", [*FIRST, STATE, *big]), ENTRIES, read_only=True)


@pytest.mark.parametrize("hit", ["short keyframe", "long keyframe", "short delta", "packed bomb"])
def test_a_state_of_a_different_size_is_never_used(hit: str, tmp_path: Path) -> None:
    path = tmp_path / "run"
    timeline = begun(path)
    state = timeline.resource.state
    advance(timeline, 4)
    timeline.close()
    file = RunFile.open(path)
    list(file.scan_blocks())
    match hit:
        case "short keyframe":
            file.append(Kind.KEYFRAME, 4, keyframe(1, state[:-1]))
        case "long keyframe":
            file.append(Kind.KEYFRAME, 4, keyframe(1, state + b"\0"))
        case "short delta":
            file.append(Kind.DELTA, 4, state[1:])
        case "packed bomb":
            file.append(Kind.KEYFRAME, 4, keyframe(1, bytes(LARGEST)))
    file.close()
    for use in (lambda: resumed(path), lambda: replay_file(path, of_file, ENTRIES)):
        with pytest.raises((RunFileError, Unreadable), match="at byte"):
            use()
    assert open_files(tmp_path) == []


@pytest.mark.parametrize(
    "patch",
    [Patch(1 << 30, b"a", b"\xff"), Patch(-5, b"a", b"\xff"), Patch(900, b"ab", b"\x0f"), Patch(900, 7, 8)],  # type: ignore[arg-type]
)
def test_a_plan_that_leads_outside_is_refused(patch: Patch, tmp_path: Path) -> None:
    path = tmp_path / "run"
    begun(path).close()
    file = RunFile.open(path)
    list(file.scan_blocks())
    file.append(Kind.ENTRY, 4, entry(4, patch))
    file.close()
    for use in (lambda: resumed(path), lambda: replay_file(path, of_file, ENTRIES)):
        with pytest.raises((RunFileError, Unreadable), match="cannot be"):
            use()
    assert open_files(tmp_path) == []


def test_the_search_for_blocks_after_damage_has_an_end(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A file full of beginnings of blocks that all reach to its end."""
    monkeypatch.setattr("scanbench.recording.format._SEARCH", 1 << 24)
    path = write(tmp_path / "run", [*FIRST, STATE])
    size = 1 << 20
    heads = (
        struct.pack("<4sBBHIQQII", b"\xf5RB\n", 3, 0, 0, size - at - 36, 7, 0, 0, 0) for at in range(0, size - 36, 36)
    )
    with path.open("ab") as file:
        file.write(b"x" + b"".join(heads))
    checked = 0
    crc32 = zlib.crc32

    def counting(data: bytes, value: int = 0) -> int:
        nonlocal checked
        checked += len(data)
        return crc32(data, value)

    monkeypatch.setattr("scanbench.recording.format.zlib.crc32", counting)
    with Recording.open(path, ENTRIES, read_only=True) as recording:
        assert "is damaged at byte" in recording.damage
    assert checked < 20 << 20


def test_blocks_far_after_damage_are_found(tmp_path: Path) -> None:
    path = tmp_path / "run"
    for gap in (1, (1 << 20) - 3, (1 << 20) - 2, 3 << 20):
        write(path, [*FIRST, STATE])
        with path.open("ab") as file:
            file.write(bytes(gap) + raw(Kind.MARK, 0, b"", 99))
        with Recording.open(path, ENTRIES, read_only=True) as recording:
            assert recording.last_scan == 99
            assert "No scan is lost: all that was entered is there" in recording.damage
