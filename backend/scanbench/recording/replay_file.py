"""A run file replayed from its beginning, with every checkpoint on the way compared: the proof that it determines its run."""

import hashlib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from scanbench.recording.blocks import Codec
from scanbench.recording.gaps import Gap, LostScans, gap_of
from scanbench.recording.programs import ProgramsOf
from scanbench.recording.reader import RunReader, Unreadable
from scanbench.recording.recording import Recording
from scanbench.recording.replay import NOT_AS_RECORDED, Diverged, replay
from scanbench.recording.thinning import Checkpoint
from scanbench.runtime.inside import front
from scanbench.runtime.resource import Resource


@dataclass(frozen=True, slots=True)
class Replayed:
    """What came out: the state before `scan`."""

    first_scan: int
    scan: int
    hash: str
    """SHA-256 of the state."""
    entries: int
    checkpoints: int
    """So many agreed."""
    damage: str
    lost: bool
    """The file is damaged, and not only in its last write: scans or commands are missing."""
    gaps: tuple[LostScans, ...]
    """Scans in the middle that are missing."""
    damaged: bool
    """There is damage, also where nothing is missing."""
    by: str
    """Who began the run, ..."""
    created: str
    """... and when, ISO 8601."""

    @property
    def scans(self) -> int:
        """Scans that the file has, and that came out as recorded."""
        lost = sum(max(0, min(each.until, self.scan) - each.first) for each in self.gaps if each.first < self.scan)
        return self.scan - self.first_scan - lost


def replay_file(
    path: Path, programs_of: ProgramsOf, codec: Codec, until: int | None = None,
    on_agreed: Callable[[int], None] = lambda scan: None,
) -> Replayed:  # fmt: skip
    """Replays up to the last scan that the file knows of, or to the end of scan `until` - 1. Each checkpoint that agrees
    is told with its scan.

    `Diverged` when the run does not go as recorded, with the scan; `Unreadable` when the file cannot be used.
    """
    with RunReader(path, programs_of, codec) as reader:
        reader.follow()
        first, end = reader.first, reader.end
        if until is not None:
            if not first <= until <= end:
                raise Unreadable(f"{path.name} holds scans {first} to {end}: scan {until} is none of them")
            gap = gap_of(reader.recording.gaps, until)
            if gap is not None:
                raise Unreadable(f"{path.name} cannot be replayed up to scan {until}: {gap}")
            end = until
        try:
            with reader.reading():
                resource, agreed = _compared(reader, end, on_agreed)
        except NOT_AS_RECORDED as error:
            raise Unreadable(f"{path.name} cannot be replayed: {error}") from error
        digest = hashlib.sha256(resource.state).hexdigest()
        recording = reader.recording
        about, damage, damaged = recording.about, recording.damage, recording.damaged
        if until is None and not damaged and not recording.marked:
            cut = f"{path.name} ends without the mark of its last scan: its writer was ended, or the file was cut off"
            if not about.marks:
                cut = f"{path.name} is from a version that left no mark at the end of a run"
            damage, damaged = f"{cut}. Whether more than scan {end} was recorded is not known", about.marks
        return Replayed(
            first, resource.header.scan, digest, len(resource.journal), agreed, damage, recording.lost,
            recording.info.lost, damaged, about.by, about.created,
        )  # fmt: skip


def _compared(reader: RunReader, end: int, on_agreed: Callable[[int], None]) -> tuple[Resource, int]:
    """Runs from checkpoint to checkpoint, and on to `end`: the PLC there, and how many checkpoints agreed."""
    recording, entries, agreed = reader.recording, reader.entries, 0
    resource = reader.open_checkpoint(recording.checkpoints[0])
    last = recording.checkpoints[0].scan
    again = {each.at: each for each in recording.gaps}
    for checkpoint in recording.checkpoints:
        if checkpoint.scan > end:
            break
        gap = again.pop(checkpoint.at, None)
        if gap is not None and checkpoint is not recording.checkpoints[0]:
            _up_to(reader, resource, gap)
            resource, last = reader.open_checkpoint(checkpoint), checkpoint.scan
            continue
        resource.proved = last if last >= recording.about.thinned_before else checkpoint.scan
        last = checkpoint.scan
        replay(resource, entries[len(resource.journal) : checkpoint.entries], checkpoint.scan)
        if resource.version != checkpoint.version or resource.state != _recorded(recording, resource, checkpoint):
            raise Diverged(_difference(recording, resource, checkpoint))
        agreed += 1
        on_agreed(checkpoint.scan)
    resource.proved = recording.checkpoints[-1].scan
    left = [entry for entry in entries[len(resource.journal) :] if entry.scan <= end]
    replay(resource, left[: front(left, end)], end)
    return resource, agreed


def _up_to(reader: RunReader, resource: Resource, gap: Gap) -> None:
    """Runs as far as is known before a gap."""
    resource.proved = gap.first
    left = [each for each in reader.entries[len(resource.journal) : gap.entries] if each.scan < gap.first]
    if gap.last > resource.header.scan:
        replay(resource, left[: front(left, gap.last)], gap.last)


def _recorded(recording: Recording, resource: Resource, checkpoint: Checkpoint) -> bytes:
    return recording.state(checkpoint, resource.program.layout.state_size)


def _difference(recording: Recording, resource: Resource, checkpoint: Checkpoint) -> str:
    if resource.version != checkpoint.version:
        return f"before scan {checkpoint.scan} program {resource.version} runs, and {checkpoint.version} was recorded"
    recorded, found = _recorded(recording, resource, checkpoint), resource.state
    at = next(index for index, (one, other) in enumerate(zip(recorded, found, strict=True)) if one != other)
    return (
        f"before scan {checkpoint.scan} byte {at} of the image is {found[at]:02X}, and {recorded[at]:02X} was recorded"
    )
