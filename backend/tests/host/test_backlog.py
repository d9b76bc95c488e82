"""A parent that does not read: what a PLC tells by itself waits as state, not as messages."""

import socket
from collections.abc import Iterator
from itertools import count
from pathlib import Path

import pytest

from scanbench.debug.breakpoint import Breakpoint
from scanbench.host import debugging, log_throttle, traces
from scanbench.host.covering import Covering
from scanbench.host.debugging import Debugging
from scanbench.host.link import Link
from scanbench.host.log_throttle import LogThrottle
from scanbench.host.traces import Traces
from scanbench.recording.timeline import Timeline
from scanbench.taps.trace import TraceDefinition
from scanbench.wire.debugging import BreakpointsAre, LogpointSaid
from scanbench.wire.host import Sources
from scanbench.wire.traces import DefineTrace, TracesAre
from tests.recording.recorded import begun

SOURCE = "PROGRAM Main VAR n : DINT; END_VAR n := n + 1; END_PROGRAM"


class Slow(Link):
    """A link whose other end reads nothing while `full`."""

    def __init__(self, sock: socket.socket) -> None:
        super().__init__(sock)
        self.full, self.posted = False, list[object]()

    @property
    def backlogged(self) -> bool:
        return self.full

    def post(self, message: object) -> None:
        self.posted.append(message)


@pytest.fixture
def link() -> Iterator[Slow]:
    ours, theirs = socket.socketpair()
    with ours, theirs:
        yield Slow(ours)


@pytest.fixture
def timeline(tmp_path: Path) -> Iterator[Timeline]:
    made = begun(tmp_path / "run", SOURCE)
    yield made
    made.close()


@pytest.fixture(autouse=True)
def clock(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each look at the clock is a minute after the one before."""
    looks = count(step=60_000_000_000)
    for module in (debugging, log_throttle, traces):
        monkeypatch.setattr(module, "monotonic_ns", lambda: next(looks))


def test_what_logpoints_say_is_counted_until_somebody_reads(link: Slow) -> None:
    throttle, breakpoint = LogThrottle(link), Breakpoint(1, "line", "Ada", line=1, log="n")
    link.full = True
    for scan in range(1000):
        throttle.said(breakpoint, f"n is {scan}", scan, None)
        throttle.catch_up()
    assert link.posted == []
    link.full = False
    throttle.catch_up()
    assert link.posted == [LogpointSaid(1, "n is 999 (999 more were left out before)", 999, "", 0)]


def test_counts_of_breakpoints_are_told_once_when_somebody_reads(link: Slow, timeline: Timeline) -> None:
    served = Debugging(timeline, link, Covering(timeline, lambda version: Sources("", {}, 0, version)))
    link.full = True
    for _ in range(100):
        served.debugger.changed = True
        served.tick()
    assert link.posted == []
    link.full = False
    served.tick()
    served.tick()
    assert link.posted == [BreakpointsAre(None, ())]


def test_states_of_traces_are_told_once_when_somebody_reads(link: Slow, timeline: Timeline) -> None:
    served = Traces(timeline, link)
    served.serve(DefineTrace(1, 1, TraceDefinition("n", ("Main.n",), 1, 100), "Ada", True))
    link.posted.clear()
    link.full = True
    for _ in range(5):
        timeline.run(1)
        served.drain()
        served.tick()
    assert link.posted == []
    link.full = False
    served.tick()
    (told,) = link.posted
    assert isinstance(told, TracesAre)
    assert told.traces[0].rows == 5
