"""`python -m bench heartbeat`: a client that writes one word ten times a second for a week, on virtual time.

What a write takes in the run file, how large the file and the journal in memory become, what the process grew by from the first day on, and whether
the file is gone on with afterwards. There is no clock in it: a week takes as long as its writes do.
"""

import argparse
import json
import sys
import tempfile
import time
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path

from scanbench.check.build import check_sources
from scanbench.engines.native.engine import NativeEngine
from scanbench.plcmodel.load import model_named
from scanbench.recording.block import Kind
from scanbench.recording.blocks import KeptProgram
from scanbench.recording.format import RunFile
from scanbench.recording.timeline import Timeline
from scanbench.runtime.command import Refusal
from scanbench.runtime.programs import Loaded
from scanbench.runtime.write_areas import AreaWrite, WriteAreas
from scanbench.wire.codec import ENTRIES

PER_SECOND, SCANS = 10, 10
"""Writes, and scans of 10 ms from one to the next."""
_WAITS = 500
"""After so many writes the thread that makes the file smaller is waited for: at ten writes a second it has the time."""
_DAY = 24 * 60 * 60
_SOURCE = (
    "PROGRAM Main VAR n : DINT; beat AT D200 : WORD; alive : BOOL; END_VAR n := n + 1; alive := beat <> 0; END_PROGRAM"
)


@dataclass(frozen=True, slots=True)
class Week:
    """What came of it."""

    days: float
    writes: int
    seconds: float
    """That it took."""
    bytes_a_write: float
    """Of those that are still in the file."""
    file_mib: float
    most_file_mib: float
    entries: int
    """In memory at the end; the most of any time beside."""
    most_entries: int
    memory_mib: float
    grown_mib: float
    """The process, since a seventh of the time was over."""
    gone_on: bool
    """The file gives the same journal and the same state again."""


class _Programs:
    """The program of this bench, whatever a run file kept."""

    def __init__(self) -> None:
        program = check_sources({"main.st": _SOURCE}, model_named("CJ1M-CPU13")).program
        assert program is not None
        self._loaded = Loaded.make(program, NativeEngine, 1)

    def get(self, version: int) -> Loaded:
        return self._loaded


def _of_file(_kept: Mapping[int, KeptProgram]) -> _Programs:
    return _Programs()


def run_heartbeat(path: Path, days: float) -> Week:
    """The run file is made at `path`."""
    timeline = Timeline.begin(path, _Programs(), 1, _SOURCE.encode(), ENTRIES, "Ada")
    writes, most_file, most_entries, early = int(days * _DAY * PER_SECOND), 0, 0, 0.0
    begin = time.perf_counter()
    for number in range(writes):
        beat = WriteAreas(
            "FINS 192.168.0.7, node 25", (AreaWrite("D", 400, (number % 65_535 + 1).to_bytes(2, "little")),)
        )
        outcome = timeline.submit(beat)
        assert not isinstance(outcome, Refusal), outcome
        end = timeline.live_scan + SCANS
        while timeline.live_scan < end:
            timeline.run(end - timeline.live_scan)
        if number % PER_SECOND == 0:
            timeline.note()
            if number % _WAITS == 0:
                timeline.recording.wait()
                timeline.note()
            most_file = max(most_file, path.stat().st_size)
            most_entries = max(most_entries, len(timeline.live_journal))
        if number == writes // 7:
            early = _memory_mib()
    timeline.note()
    timeline.recording.wait()
    timeline.note()
    memory, lasted = _memory_mib(), time.perf_counter() - begin
    journal, state = tuple(timeline.live_journal), timeline.resource.state
    timeline.close()
    again = Timeline.resume(path, _of_file, ENTRIES)
    same = tuple(again.live_journal) == journal and again.resource.state == state
    again.close()
    return Week(
        days, writes, lasted, _bytes_a_write(path), path.stat().st_size / (1 << 20), most_file / (1 << 20), len(journal),
        most_entries, memory, memory - early, same,
    )  # fmt: skip


def _bytes_a_write(path: Path) -> float:
    file = RunFile.open(path, read_only=True)
    try:
        sizes = [each.size for each in file.scan_blocks() if each.kind is Kind.ENTRY]
    finally:
        file.close()
    return sum(sizes) / max(1, len(sizes))


def _memory_mib() -> float:
    text = Path("/proc/self/status").read_text().partition("VmRSS:")[2]
    return int(text.split()[0]) / 1024


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m bench heartbeat", description=__doc__)
    parser.add_argument("--days", type=float, default=7)
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        week = run_heartbeat(Path(folder, "run"), given.days)
    if given.json:
        sys.stdout.write(json.dumps(asdict(week)) + "\n")
        return
    sys.stdout.write(
        f"{week.days:g} days, {week.writes} writes, in {week.seconds:.0f} s: {week.bytes_a_write:.1f} bytes a write\n"
        f"run file {week.file_mib:.1f} MiB, {week.most_file_mib:.1f} at most\n"
        f"journal in memory {week.entries} entries, {week.most_entries} at most; the process has {week.memory_mib:.0f} MiB,"
        f" {week.grown_mib:+.0f} since a seventh of the time\n"
        f"gone on with from the file: {'the same' if week.gone_on else 'NOT the same'}\n"
    )


if __name__ == "__main__":
    main()
