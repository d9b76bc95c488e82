"""What is entered inside of a scan is data of the run like everything else: replayed, copied, branched, gone on with."""

import hashlib
from pathlib import Path

import pytest

from scanbench.engines.debug import Listen
from scanbench.engines.engine import Reason
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.engine import NativeEngine
from scanbench.recording.replay_file import replay_file
from scanbench.recording.timeline import Timeline
from scanbench.runtime.command import Command, Entry, Refusal
from scanbench.runtime.forces import FORCED, Force
from scanbench.runtime.inside import Diverged, HaltAt
from scanbench.runtime.modes import SetMode
from scanbench.runtime.programs import EngineFactory
from scanbench.runtime.restart import Restart
from scanbench.runtime.write import Write
from scanbench.wire.codec import ENTRIES
from tests.recording.recorded import SECOND, advance, begun, of_file, of_file_native, resumed, to_program
from tests.runtime.bench import ENGINES, value


def halt(timeline: Timeline, count: int) -> None:
    """Halts before the statement with this count in the next scan."""
    resource = timeline.resource
    resource.listening.attach(HaltAt(count), Listen(count=count))
    while (stop := timeline.run(1)).reason is Reason.INTERRUPTED:
        pass
    resource.listening.attach(None)
    assert stop.reason is Reason.HALTED
    assert resource.listening.inside is not None
    assert resource.listening.inside.count == count


def enter(timeline: Timeline, command: Command) -> Entry:
    entry = timeline.submit(command)
    assert not isinstance(entry, Refusal), entry.message
    return entry


def written(path: Path, engine: EngineFactory = ReferenceEngine) -> tuple[Timeline, dict[int, bytes]]:
    """A run with commands inside of two of its scans, and the states in which its scans began."""
    timeline = begun(path, engine=engine)
    resource = advance(timeline, 5)
    halt(timeline, 2)
    assert enter(timeline, Write("Ada", "Main.n", "50")).step == 2
    assert enter(timeline, Force("Ada", "Main.other", "9")).step == 2
    halt(timeline, 5)
    assert enter(timeline, Write("Ada", "Main.d", "4")).step == 5
    states = {}
    for _ in range(4):
        advance(timeline, 1)
        states[timeline.live_scan] = resource.state
    halt(timeline, 1)
    enter(timeline, Write("Ada", "Main.kept", "1000"))
    for _ in range(5):
        advance(timeline, 1)
        states[timeline.live_scan] = resource.state
    return timeline, states


@pytest.mark.parametrize("engine", ENGINES)
def test_any_scan_after_it_is_shown_again(engine: EngineFactory, tmp_path: Path) -> None:
    timeline, states = written(tmp_path / "a.run", engine)
    assert value(timeline.resource, "Main.n") == 58
    for scan in (6, 14, 9, 7, 8, 13, 10):
        assert timeline.goto(scan) is None
        assert timeline.resource.state == states[scan]
    assert timeline.goto(5) is None
    assert value(timeline.resource, "Main.n") == 5, "it has no effect in the seam before it"
    assert not timeline.resource.journal.derived(FORCED)
    timeline.return_live()
    timeline.close()


@pytest.mark.parametrize("programs", [of_file, of_file_native])
def test_a_replay_of_the_file_comes_to_the_same(programs: object, tmp_path: Path) -> None:
    path = tmp_path / "a.run"
    timeline, states = written(path)
    timeline.close()
    for scan in (6, 10, 14):
        found = replay_file(path, programs, ENTRIES, scan)  # type: ignore[arg-type]
        assert found.hash == hashlib.sha256(states[scan]).hexdigest()


@pytest.mark.parametrize("scan", [5, 6, 9, 12])
def test_a_copy_goes_on_as_a_branch(scan: int, tmp_path: Path) -> None:
    timeline, _ = written(tmp_path / "a.run")
    found: list[Refusal | None] = []
    timeline.copy(tmp_path / "b.run", scan, "Ada", found.append)
    timeline.recording.wait()
    assert found == [None]
    assert timeline.goto(scan) is None
    expected = timeline.resource.state
    timeline.close()
    branch = resumed(tmp_path / "b.run")
    assert branch.resource.state == expected
    assert not branch.resource.begun
    advance(branch, 3)
    branch.close()


def test_a_copy_of_a_halted_scan_ends_before_it(tmp_path: Path) -> None:
    timeline = begun(tmp_path / "a.run")
    advance(timeline, 3)
    state = timeline.resource.state
    halt(timeline, 3)
    enter(timeline, Write("Ada", "Main.n", "50"))
    for name, scan in (("b.run", None), ("c.run", 3)):
        timeline.copy(tmp_path / name, scan, "Ada", lambda refusal: None)
        timeline.recording.wait()
        branch = resumed(tmp_path / name)
        assert (branch.live_scan, branch.resource.state, branch.resource.begun) == (3, state, False)
        branch.close()
    assert timeline.resource.listening.inside is not None
    assert value(advance(timeline, 1), "Main.n") == 50
    timeline.close()


def test_the_past_can_be_looked_at_from_a_halt_and_back(tmp_path: Path) -> None:
    timeline = begun(tmp_path / "a.run")
    resource = advance(timeline, 5)
    halt(timeline, 2)
    enter(timeline, Write("Ada", "Main.n", "50"))
    image, inside = bytes(resource.memory), resource.listening.inside
    assert timeline.goto(2) is None
    assert resource.listening.inside is None
    assert timeline.goto(3, 4) is None
    assert (value(resource, "Main.n"), resource.listening.inside is not None) == (4, True)
    assert isinstance(timeline.goto(3, 400), Refusal)
    assert resource.header.scan == 3
    timeline.return_live()
    assert (bytes(resource.memory), resource.listening.inside) == (image, inside)
    assert value(advance(timeline, 1), "Main.n") == 50
    timeline.close()


def test_what_needs_the_seam_ends_the_scan_first(tmp_path: Path) -> None:
    for name, command in (("a", SetMode("Ada", "PROGRAM")), ("b", Restart("Ada", "warm"))):
        timeline = begun(tmp_path / f"{name}.run")
        resource = advance(timeline, 5)
        halt(timeline, 2)
        entry = enter(timeline, command)
        assert (entry.scan, entry.step, resource.listening.inside) == (6, 0, None)
        timeline.close()
    timeline = begun(tmp_path / "c.run")
    advance(timeline, 5)
    halt(timeline, 2)
    assert to_program(timeline, 2, SECOND) == ""
    assert value(timeline.resource, "Main.n") == 6
    timeline.close()


def test_a_run_that_was_ended_while_halted_runs_that_scan_as_the_journal_says(tmp_path: Path) -> None:
    path = tmp_path / "a.run"
    timeline = begun(path)
    resource = advance(timeline, 5)
    state = resource.state
    halt(timeline, 2)
    enter(timeline, Write("Ada", "Main.n", "50"))
    timeline.recording.close()  # as after a kill: nothing is noted
    again = resumed(path, 5)
    assert (again.live_scan, again.resource.state, again.resource.begun) == (5, state, True)
    assert again.goto(3) is None
    again.return_live()
    entry = enter(again, Write("Ada", "Main.other", "1"))
    assert entry.scan == 6, "the scan that had begun came to its end first"
    assert value(again.resource, "Main.n") == 50
    after = advance(again, 2).state
    again.close()
    found = replay_file(path, of_file, ENTRIES)
    assert found.hash == hashlib.sha256(after).hexdigest()


def test_a_scan_that_traps_after_what_was_entered_in_it(tmp_path: Path) -> None:
    path = tmp_path / "a.run"
    timeline = begun(path)
    resource = advance(timeline, 5)
    halt(timeline, 3)
    enter(timeline, Write("Ada", "Main.d", "0"))
    assert timeline.run(1).reason is Reason.TRAP
    trapped = resource.state
    assert timeline.goto(5) is None
    assert resource.state == trapped
    timeline.return_live()
    enter(timeline, Restart("Ada", "cold"))
    halt(timeline, 2)
    enter(timeline, Write("Ada", "Main.n", "7"))
    after = advance(timeline, 4).state
    assert timeline.goto(7) is None
    timeline.return_live()
    timeline.close()
    for programs in (of_file, of_file_native):
        assert replay_file(path, programs, ENTRIES).hash == hashlib.sha256(after).hexdigest()


def test_an_entry_that_the_scan_does_not_get_to_is_told(tmp_path: Path) -> None:
    timeline = begun(tmp_path / "a.run", engine=NativeEngine)
    resource = advance(timeline, 2)
    halt(timeline, 2)
    entry = enter(timeline, Write("Ada", "Main.n", "1"))
    resource.listening.inside = None
    timeline.rewind()
    resource.journal = resource.journal.prefix(0)
    resource.await_step(Entry(entry.scan, entry.at, entry.command, entry.plan, 100))
    with pytest.raises(Diverged, match="statement 100 when it was recorded"):
        resource.rerun(1)


def test_what_needs_the_seam_waits_for_it_whoever_wants_to_halt(tmp_path: Path) -> None:
    timeline = begun(tmp_path / "a.run")
    advance(timeline, 5)
    halt(timeline, 2)
    timeline.resource.listening.attach(HaltAt(2))
    entry = enter(timeline, Restart("Ada", "cold"))
    assert (entry.scan, entry.step, timeline.resource.listening.inside) == (6, 0, None)
    timeline.resource.listening.attach(None)
    state = advance(timeline, 4).state
    scan = timeline.live_scan
    timeline.close()
    again = replay_file(tmp_path / "a.run", of_file, ENTRIES, scan)
    assert (again.scan, again.hash) == (scan, hashlib.sha256(state).hexdigest())
