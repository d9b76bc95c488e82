"""Time travel: what recording costs, and how long it takes to show any scan of a long run.

`python -m bench.goto [--scans N] [--words N]`: a program that changes an image of 64 KiB all the time runs 10
million scans as fast as possible, with commands on the way, once recorded and once not; then scans all over the run
are gone to, and the run file is opened again as after a crash.
"""

import argparse
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from statistics import median
from time import perf_counter_ns

from bench.run import INTERVAL_NS, MODEL
from scanbench.check.build import check_sources
from scanbench.engines.native.engine import NativeEngine
from scanbench.plcmodel.load import model_named
from scanbench.program.program import Program
from scanbench.recording.timeline import Timeline
from scanbench.runtime.programs import Loaded
from scanbench.runtime.resource import Resource
from scanbench.runtime.write import Write
from scanbench.wire.codec import ENTRIES

SCANS = 10_000_000
IMAGE_WORDS = 16_384
SAMPLES = 100
COMMANDS = 200
_STRIDE = 61_803_399
"""From one scan that is gone to to the next: everywhere, in no order."""
SOURCE = """
PROGRAM Main
VAR n : DINT; slot : DINT; i : DINT; seed : DINT := 12345; data : ARRAY[0..{last}] OF DINT; gain : DINT := 3; END_VAR
  n := n + 1;
  FOR i := 1 TO 100 DO
    seed := seed * 1103515245 + 12345;
    slot := (slot + 7) MOD {count};
    data[slot] := data[slot] + seed / 65536 * gain;
  END_FOR;
END_PROGRAM
"""


@dataclass(frozen=True, slots=True)
class Result:
    """What was measured; times in ms."""

    image_bytes: int
    scans: int
    plain_per_second: float
    recorded_per_second: float
    file_bytes: int
    checkpoints: int
    goto_median: float
    goto_worst: float
    return_worst: float
    open_ms: float


class _One:
    """The one program of the bench."""

    def __init__(self, program: Program) -> None:
        self._loaded = Loaded.make(program, NativeEngine)

    def get(self, version: int) -> Loaded:
        """See `Programs`."""
        return self._loaded


def run_goto(scans: int = SCANS, words: int = IMAGE_WORDS) -> Result:
    """Measures it in a directory of its own."""
    text = SOURCE.format(last=words - 1, count=words)
    model = model_named(MODEL)
    checked = check_sources({"main.st": text}, model, INTERVAL_NS)
    if checked.program is None:
        raise RuntimeError(f"the program of the bench does not build: {checked.problems[0]}")
    program = checked.program
    programs = _One(program)
    plain = _per_second(Resource(programs.get(1)), scans)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "run")
        timeline = Timeline.begin(path, programs, 1, text.encode(), ENTRIES, "bench")
        recorded = _recorded(timeline, scans)
        places = [index * _STRIDE % scans for index in range(1, SAMPLES + 1)]
        goes = [_ms(partial(_must, timeline, scan)) for scan in places]
        returns = []
        for scan in places[:10]:
            _must(timeline, scan)
            returns.append(_ms(timeline.return_live))
        info, count = timeline.recording.info, len(timeline.recording.checkpoints)
        timeline.close()
        opened = _ms(lambda: Timeline.resume(path, lambda kept: programs, ENTRIES).close())
    return Result(
        program.layout.state_size, scans, plain, recorded, info.bytes, count, median(goes), max(goes), max(returns), opened
    )  # fmt: skip


def _per_second(resource: Resource, scans: int) -> float:
    resource.run(1000)
    start = perf_counter_ns()
    resource.run(scans)
    return scans / (perf_counter_ns() - start) * 1e9


def _recorded(timeline: Timeline, scans: int) -> float:
    """As the host does it: slices, commands, marks."""
    start = perf_counter_ns()
    next_command = every = scans // COMMANDS
    while (now := timeline.live_scan) < scans:
        timeline.run(min(next_command, scans) - now)
        timeline.note()
        if timeline.live_scan == next_command:
            timeline.submit(Write("bench", "Main.gain", str(next_command % 17)))
            next_command += every
    return scans / (perf_counter_ns() - start) * 1e9


def _must(timeline: Timeline, scan: int) -> None:
    refusal = timeline.goto(scan)
    if refusal is not None:
        raise RuntimeError(refusal.message)


def _ms(action: Callable[[], None]) -> float:
    start = perf_counter_ns()
    action()
    return (perf_counter_ns() - start) / 1e6


def _report(result: Result) -> str:
    return "\n".join(
        (
            f"image {result.image_bytes / 1024:.0f} KiB, {result.scans:,} scans, {COMMANDS} commands",
            f"scans a second: {result.plain_per_second:,.0f} unrecorded, {result.recorded_per_second:,.0f} recorded "
            f"({100 * result.recorded_per_second / result.plain_per_second:.0f} %)",
            f"run file: {result.file_bytes / 2**20:.1f} MiB, {result.checkpoints} checkpoints",
            f"goto any scan: median {result.goto_median:.1f} ms, worst of {SAMPLES} {result.goto_worst:.1f} ms",
            f"return to live: worst {result.return_worst:.1f} ms; open again: {result.open_ms:.0f} ms",
        )
    )


def main() -> None:
    """Prints the figures."""
    parser = argparse.ArgumentParser(description="what recording costs, and how long time travel takes")
    parser.add_argument("--scans", type=int, default=SCANS)
    parser.add_argument("--words", type=int, default=IMAGE_WORDS, help="32-bit words that change")
    options = parser.parse_args()
    print(_report(run_goto(options.scans, options.words)))  # noqa: T201


if __name__ == "__main__":
    main()
