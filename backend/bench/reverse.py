"""Reverse debugging: how long it takes to find the last write of a variable, and to step back.

`python -m bench.reverse [--scans N]`: a program runs a million scans as fast as possible; a variable was written in
its first ones alone. Then somebody asks for its last write, and steps back over statements from the present position.
"""

import argparse
import tempfile
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter_ns

from bench.run import INTERVAL_NS, MODEL
from scanbench.check.build import check_sources
from scanbench.debug.breakpoint import Breakpoint
from scanbench.debug.debugger import Debugger
from scanbench.engines.native.debugged import DebugBuilds
from scanbench.engines.native.engine import NativeEngine
from scanbench.engines.native.probed import ProbedBuilds
from scanbench.plcmodel.load import model_named
from scanbench.problems import Span
from scanbench.program.program import Program
from scanbench.recording.timeline import Timeline
from scanbench.runtime.command import Entry
from scanbench.runtime.programs import Loaded
from scanbench.wire.codec import ENTRIES

SCANS = 1_000_000
STEPS = 100
FIRST = 10
"""Scans in which the variable is written."""
SOURCE = f"""
FUNCTION_BLOCK Station
VAR_INPUT level : DINT; END_VAR
VAR_OUTPUT seen : DINT; END_VAR
VAR_IN_OUT sum : DINT; END_VAR
  seen := seen + level;
  sum := sum + seen MOD 7;
END_FUNCTION_BLOCK
PROGRAM Main
VAR n, sum, slot, mark : DINT; station : ARRAY[0..3] OF Station; i : DINT; data : ARRAY[0..99] OF DINT; END_VAR
  n := n + 1;
  FOR i := 0 TO 3 DO
    station[i](level := n + i, sum := sum);
  END_FOR;
  slot := (slot + 7) MOD 100;
  data[slot] := data[slot] + sum;
  IF n <= {FIRST} THEN
    mark := sum;
  END_IF;
END_PROGRAM
"""


@dataclass(frozen=True, slots=True)
class Result:
    """What was measured; times in ms."""

    scans: int
    back: int
    """How many scans ago the write was."""
    run_ms: float
    last_write_ms: float
    """Of the first search, which makes code for it, ..."""
    again_ms: float
    """... and of one that ends one write earlier."""
    step_ms: float
    checkpoints: int


class _Nobody:
    """Is told nothing."""

    def said(self, breakpoint: Breakpoint, text: str, scan: int, span: Span | None) -> None:
        """See `Told`."""

    def raised(self, entry: Entry) -> tuple[str, ...]:
        """See `Told`."""
        return ()


class _One:
    """The one program of the bench."""

    def __init__(self, program: Program) -> None:
        self._loaded = Loaded.make(program, NativeEngine)
        self._loaded.debug = DebugBuilds().engine(program, self._loaded.memory)

    def get(self, version: int) -> Loaded:
        """See `Programs`."""
        return self._loaded


def run_reverse(scans: int = SCANS) -> Result:
    """Measures it in a directory of its own."""
    checked = check_sources({"main.st": SOURCE}, model_named(MODEL), INTERVAL_NS)
    if checked.program is None:
        raise RuntimeError(f"the program of the bench does not build: {checked.problems[0]}")
    with tempfile.TemporaryDirectory() as folder:
        timeline = Timeline.begin(Path(folder, "run"), _One(checked.program), 1, SOURCE.encode(), ENTRIES, "bench")
        debugger = Debugger(timeline, _Nobody())
        debugger.search_with(ProbedBuilds().engine)
        begin = perf_counter_ns()
        while timeline.live_scan < scans:
            debugger.run(scans - timeline.live_scan)
        run_ms = _since(begin)
        first = _reverse(debugger)
        halt = debugger.halt
        if halt is None or halt.scan != FIRST - 1:
            raise RuntimeError(f"the last write was found at {halt}")
        timeline.return_live()
        debugger.travelled()
        _reverse(debugger)
        again = _reverse(debugger)
        timeline.return_live()
        debugger.travelled()
        steps = _steps(debugger)
        checkpoints = len(timeline.recording.checkpoints)
        timeline.close()
    return Result(scans, scans - FIRST, run_ms, first, again, steps, checkpoints)


def _reverse(debugger: Debugger) -> float:
    begin = perf_counter_ns()
    refusal = debugger.step("reverse", "bench", path="Main.mark")
    if refusal is not None:
        raise RuntimeError(refusal.message)
    return _since(begin)


def _steps(debugger: Debugger) -> float:
    """ms of one step back."""
    begin = perf_counter_ns()
    for _ in range(STEPS):
        refusal = debugger.step("back", "bench")
        if refusal is not None:
            raise RuntimeError(refusal.message)
    return _since(begin) / STEPS


def _since(begin: int) -> float:
    return (perf_counter_ns() - begin) / 1e6


def main() -> None:
    """Prints it."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scans", type=int, default=SCANS)
    result = run_reverse(parser.parse_args().scans)
    lines = (
        f"{result.scans:,} scans ran in {result.run_ms:.0f} ms, with {result.checkpoints} checkpoints",
        f"last write of a variable, {result.back:,} scans back: {result.last_write_ms:.0f} ms",
        f"the write before that: {result.again_ms:.0f} ms",
        f"a step back: {result.step_ms:.2f} ms",
    )
    print("\n".join(lines))  # noqa: T201


if __name__ == "__main__":
    main()
