"""Traces: 16 signals of every scan of a 1 ms task, without a lost sample, and what a scan costs more.

`python -m bench.trace [--minutes N] [--seconds N]`: `minutes` of virtual time as fast as possible, then
`seconds` at the real pace of 1 ms with a drain each 50 ms, as the host does it.
"""

import argparse
import json
import sys
import time
from dataclasses import asdict, dataclass

from scanbench.check.build import check_sources
from scanbench.engines.engine import Pace, Reason
from scanbench.engines.native.engine import NativeEngine
from scanbench.plcmodel.load import model_named
from scanbench.program.program import Program
from scanbench.runtime.programs import Loaded
from scanbench.runtime.resource import Resource
from scanbench.taps.trace import Trace, TraceDefinition, TraceTrigger

SIGNALS = 16
TICK_SCANS = 50
INTERVAL_NS = 1_000_000
_VARIABLES = "".join(f"i{k} : INT; r{k} : REAL; b{k} : BOOL; " for k in range(8))
_BODY = "".join(f"i{k} := i{k} + {k}; r{k} := r{k} * 0.99 + {k}.5; b{k} := n MOD {k + 2} = 0; " for k in range(8))
SOURCE = f"PROGRAM Main VAR n : DINT; {_VARIABLES} END_VAR n := n + 1; {_BODY} END_PROGRAM"


@dataclass(frozen=True, slots=True)
class TraceFigures:
    """What was measured."""

    scans: int
    """Recorded in virtual time, as fast as possible; `lost` of them are missing or wrong."""
    lost: int
    plain_ns: float
    """A scan without a trace, as fast as possible."""
    traced_ns: float
    paced_scans: int
    paced_lost: int
    drained_share: float
    """Of a core at the real pace: what taking the samples costs."""

    @property
    def ratio(self) -> float:
        """A scan with the trace in terms of one without."""
        return self.traced_ns / self.plain_ns


def run_trace_bench(minutes: float = 10, seconds: float = 60) -> TraceFigures:
    """Both parts."""
    scans = round(minutes * 60_000)
    plain = min(_timed(_plc(), scans) for _ in range(3))
    resource = _plc()
    trace = _trace(resource, scans)
    traced = _timed(resource, scans, trace)
    paced = round(seconds * 1000)
    lost, share = _paced(paced)
    return TraceFigures(scans, _lost(trace, 0, scans), plain / scans, traced / scans, paced, lost, share)


def _program() -> Program:
    checked = check_sources({"main.st": SOURCE}, model_named("CJ1M-CPU63"), INTERVAL_NS)
    assert checked.program is not None, checked.problems
    return checked.program


def _plc() -> Resource:
    return Resource(Loaded.make(_program(), NativeEngine))


def _trace(resource: Resource, scans: int) -> Trace:
    """The first signal counts the scans, so that any that is missing shows; with a trigger that never comes."""
    names = ["Main.n", *(f"Main.{kind}{k}" for k in range(5) for kind in "irb")]
    trigger = TraceTrigger("Main.n", "below", "-1")
    definition = TraceDefinition("bench", tuple(names[:SIGNALS]), scans=max(2, scans), trigger=trigger)
    trace = Trace(1, definition, "bench")
    trace.define(definition, resource.program, "bench")
    trace.start(resource.program, resource.header.scan)
    resource.waiting.samplings = trace.samplings
    return trace


def _timed(resource: Resource, scans: int, trace: Trace | None = None) -> float:
    """Nanoseconds that so many scans take, drains included."""
    resource.run(1)  # what is compiled is compiled then
    begin = time.perf_counter_ns()
    while (left := scans - resource.header.scan) > 0:
        if resource.run(left).reason not in (Reason.DONE, Reason.INTERRUPTED):
            raise RuntimeError("the program stopped")
        if trace is not None:
            trace.drain(resource.header.scan)
    return time.perf_counter_ns() - begin


def _paced(scans: int) -> tuple[int, float]:
    """Lost samples at the real pace, and the share of a core that draining takes."""
    resource = _plc()
    trace = _trace(resource, scans)
    resource.run(1)
    pace, spent, begin = Pace(INTERVAL_NS, time.monotonic_ns()), 0, time.monotonic_ns()
    while (left := scans - resource.header.scan) > 0:
        resource.run(min(TICK_SCANS, left), pace)
        at = time.perf_counter_ns()
        trace.drain(resource.header.scan)
        spent += time.perf_counter_ns() - at
    return _lost(trace, 0, scans), spent / max(1, time.monotonic_ns() - begin)


def _lost(trace: Trace, first: int, end: int) -> int:
    """Scans from `first` to before `end` that are missing or wrong; a part at a time, as all are too many to be read at once."""
    good = set[int]()
    for part in trace.buffer.pieces(first, end - 1):
        pairs = zip(part.scans.tolist(), part.values[0].tolist(), strict=True)
        good.update(scan for scan, n in pairs if n == scan + 1)
    return len(set(range(first, end)) - good)


def told(figures: TraceFigures) -> str:
    """The figures, for people."""
    return (
        f"{SIGNALS} signals, every scan: {figures.scans:,} scans as fast as possible, {figures.lost:,} lost;"
        f" {figures.traced_ns:.0f} ns a scan, {figures.plain_ns:.0f} ns without (x{figures.ratio:.2f})\n"
        f"at 1 ms: {figures.paced_scans:,} scans, {figures.paced_lost:,} lost; taking the samples takes"
        f" {100 * figures.drained_share:.2f} % of a core"
    )


def main() -> int:
    """Measures, prints; 1 where a sample was lost."""
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    options.add_argument("--minutes", type=float, default=10)
    options.add_argument("--seconds", type=float, default=60)
    options.add_argument("--json", action="store_true")
    given = options.parse_args()
    figures = run_trace_bench(given.minutes, given.seconds)
    text = json.dumps({**asdict(figures), "ratio": figures.ratio}) if given.json else told(figures)
    sys.stdout.write(text + "\n")
    return int(figures.lost > 0 or figures.paced_lost > 0)


if __name__ == "__main__":
    raise SystemExit(main())
