"""Forward and back through a run: every position shows what a straight run showed there."""

import tempfile
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scanbench.debug.breakpoint import Breakpoint
from scanbench.engines.interpreter.debugged import debug_engine
from scanbench.engines.native.debugged import DebugBuilds
from scanbench.recording.replay_file import replay_file
from scanbench.runtime.forces import Force, Release
from scanbench.runtime.restart import Restart
from scanbench.runtime.write import Write
from scanbench.wire.codec import ENTRIES
from tests.amounts import amount
from tests.debug.walking import MakeDebug, Walker
from tests.recording.recorded import of_file, of_file_native

BUILDS = DebugBuilds()
ENGINES = pytest.mark.parametrize("make", [debug_engine, BUILDS.engine], ids=["reference", "native"])
WRITES = [
    Write("Ann", "Main.n", "50"),
    Write("Ann", "Main.sum", "-7"),
    Write("Ann", "Main.list[1]", "900"),
    Write("Ann", "Main.a.total", "3"),
    Force("Ann", "Main.other", "11"),
    Force("Ann", "CIO 100.00", "TRUE"),
    Release("Ann", None),
    Restart("Ann", "warm"),
]
ACTIONS = ["in", "in", "in", "over", "out", "scan", "continue", "back", "back", "back", "reverse", "write", "past"]
MOVES = st.lists(st.tuples(st.sampled_from(ACTIONS), st.integers(0, 99)), min_size=5, max_size=40)


@ENGINES
def test_stepping_back_over_a_thousand_statements_shows_what_forward_showed(make: MakeDebug, tmp_path: Path) -> None:
    walker = Walker(tmp_path / "a.run", make=make)
    walker.step("in")
    forward = [walker.seen]
    for _ in range(1000):
        walker.step("in")
        forward.append(walker.seen)
    scans = {scan for scan, *_ in forward}
    assert len(scans) > 30, "the steps lead over many scans"
    for expected in reversed(forward[:-1]):
        walker.step("back")
        assert walker.halt.past
        assert walker.seen == expected
    for expected in forward[1:50]:
        walker.step("in")
        assert walker.seen == expected
    walker.step("continue")
    assert not walker.halt.past
    assert walker.seen == forward[-1]
    walker.close()


@ENGINES
@settings(max_examples=amount(50, 8), deadline=None)
@given(MOVES)
def test_wherever_one_goes_a_position_shows_the_same(make: MakeDebug, moves: list[tuple[str, int]]) -> None:
    with tempfile.TemporaryDirectory() as folder:
        walker = Walker(Path(folder) / "a.run", make=make)
        walker.set(
            Breakpoint(1, "line", "Ann", file="main.st", line=14, instance="Main.b"),
            Breakpoint(2, "line", "Ann", file="main.st", line=26, condition="i = 1"),
        )
        walker.step("in")
        known: dict[tuple[int, int], tuple[object, ...]] = {}
        for action, number in moves:
            _move(walker, action, number, known)
            # what is written at a halt shows there at once; so only later positions count from then on
            if not walker.halt.past and action != "write":
                known[walker.here] = walker.seen
            assert known.get(walker.here, walker.seen) == walker.seen, (action, walker.halt)
        live = walker.timeline.live_scan
        if walker.timeline.past:
            walker.timeline.return_live()
            walker.debugger.travelled()
        walker.set()
        walker.step("continue")
        state = walker.timeline.resource.state
        scan = walker.timeline.live_scan
        assert scan > live
        walker.timeline.note()
        walker.close()
        for programs in (of_file, of_file_native):
            replayed = replay_file(Path(folder) / "a.run", programs, ENTRIES, scan)
            assert (replayed.scan, replayed.hash) == (scan, _hash(state))


def _move(walker: Walker, action: str, number: int, known: dict[tuple[int, int], tuple[object, ...]]) -> None:
    if action == "write":
        if not walker.halt.past:
            here = walker.here
            walker.submit(WRITES[number % len(WRITES)])
            for position in [each for each in known if each >= min(here, walker.here)]:
                del known[position]
    elif action == "past":
        positions = sorted(known)
        scan, count = positions[number % len(positions)] if positions else walker.here
        if (scan, count) < walker.here and not walker.halt.past:
            walker.step("back")
    elif action in ("back", "reverse"):
        if walker.debugger.step(action, "Ann") is None:
            walker.run()
    else:
        walker.step(action)


def _hash(state: bytes) -> str:
    import hashlib

    return hashlib.sha256(state).hexdigest()
