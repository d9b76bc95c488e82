"""What stays of entries whose time is dropped: what still holds, and nothing else."""

from collections.abc import Mapping
from datetime import UTC, datetime
from pathlib import Path

import pytest

from scanbench.faults.detect import Detection
from scanbench.faults.inject import ACTIVE, Generate, Recover
from scanbench.faults.reference import ErrorRef
from scanbench.recording import checkpoints
from scanbench.recording.blocks import KeptProgram
from scanbench.recording.journal_roots import journal_roots
from scanbench.recording.recording import Recording
from scanbench.recording.timeline import Timeline
from scanbench.runtime.command import Command, Effect, Entry, Plan, Restarted, Swapped
from scanbench.runtime.forces import FORCED, Force, Release
from scanbench.runtime.journal import Fold, Journal
from scanbench.runtime.programs import Programs
from scanbench.runtime.trap import TRAPPED, TrapInfo, Trapped
from scanbench.runtime.write import Write
from scanbench.wire.codec import ENTRIES
from tests.amounts import amount, nightly
from tests.recording.recorded import SourcePrograms, advance, of_file, tidy
from tests.runtime.bench import ENGINES
from tests.runtime.random_runs import live, loaded_programs, random_steps

A, B, C = (ErrorRef(id) for id in ("battery-error", "memory-error", "io-bus-error"))


def raised(*refs: ErrorRef, origin: str = "simulator") -> Generate:
    return Generate("Ada", refs, "program" if origin == "program" else "simulator")


def number(number: int) -> ErrorRef:
    return ErrorRef("fal-error", (("number", str(number)),))


def trapped(scan: int) -> Trapped:
    return Trapped("PLC", TrapInfo("division", "", "main.st", 1, 1, scan))


def journal(*commands: Command | Effect) -> list[Entry]:
    """One entry a scan; an effect means a command that has it."""
    made, at = [], datetime(2026, 1, 1, tzinfo=UTC)
    for scan, each in enumerate(commands):
        command = each if isinstance(each, Command) else Write("Ada", "D0", "1")
        made.append(Entry(scan, at, command, Plan((), "", None if isinstance(each, Command) else each)))
    return made


def force(path: str, value: str = "1") -> Force:
    return Force("Ada", path, value)


CASES: list[tuple[list[Command | Effect], list[int]]] = [
    ([], []),
    ([Write("Ada", "D0", "1"), trapped(1), trapped(2)], [2]),
    ([force("a"), force("b"), Release("Ada", "a")], [1]),
    ([force("a"), Release("Ada", None), force("a"), force("A", "2"), force("a", "3")], [4]),
    ([force("a"), force("b"), force("a", "2")], [0, 1, 2]),  # a stays the first one
    ([force("a"), Restarted("warm"), force("b"), Restarted("power")], []),
    ([force("a"), Swapped(2, False, ("a",)), force("b"), Swapped(3, True, ())], [1, 2, 3]),
    ([raised(A), Recover("Ada", None), raised(A), Recover("Ada", (A.id,))], []),
    ([raised(A, B), Recover("Ada", (A.id,)), raised(C), Recover("Ada", (C.id,))], [0, 1]),
    ([raised(A, B), Recover("Ada", (A.id,)), raised(A), Restarted("warm"), raised(C)], [4]),
    ([raised(A, B), raised(A), raised(C)], [0, 1, 2]),
    ([*(raised(number(each), origin="program") for each in (1, 2, 3)), Recover("Ada", (number(1).id,))], []),
    ([*(raised(number(each), origin="program") for each in (1, 2, 3, 4))], [0, 1, 2, 3]),
    ([*(raised(number(each)) for each in (1, 2, 3, 4))], [3]),
]


@pytest.mark.parametrize(("commands", "expected"), CASES)
def test_what_holds_stays(commands: list[Command | Effect], expected: list[int]) -> None:
    entries = journal(*commands)
    assert list(journal_roots(entries, ENTRIES.folds)) == expected
    _comes_to_the_same(entries)


@nightly
@pytest.mark.parametrize("seed", range(amount(40, 10)))
def test_folds_come_to_the_same_wherever_a_run_is_cut(seed: int) -> None:
    _, entries = live(loaded_programs(ENGINES[0]), random_steps(seed, 150))
    for count in range(0, len(entries) + 1, 3):
        _comes_to_the_same(entries[:count])


def test_a_fold_that_needs_more_than_the_first_and_the_last_gets_it() -> None:
    def step(state: Mapping[str, int], entry: Entry) -> Mapping[str, int]:
        return {"sum": state.get("sum", 0) + entry.scan} if entry.scan % 3 else state

    entries = journal(*(Write("Ada", "D0", "1") for _ in range(10)))
    fold: Fold[Mapping[str, int]] = Fold({}, step)
    assert list(journal_roots(entries, [fold])) == [1, 2, 4, 5, 7, 8]


def _comes_to_the_same(entries: list[Entry]) -> None:
    kept = journal_roots(entries, ENTRIES.folds)
    left = Journal(entries[index] for index in kept)
    whole = Journal(entries)
    assert list(left.derived(FORCED).items()) == list(whole.derived(FORCED).items())
    assert list(left.derived(ACTIVE).items()) == list(whole.derived(ACTIVE).items())
    assert left.derived(TRAPPED) == whole.derived(TRAPPED)


BLINKING = """
PROGRAM Main
VAR n : DINT; list : ARRAY[0..99] OF DINT; END_VAR
  n := n + 1; list[n MOD 100] := n * 7919;
  IF n = 1 THEN FAL(500); END_IF;
  IF n = 2 THEN FAL(0); FAL(7); END_IF;
  IF n > 2 AND n MOD 4 = 0 THEN FAL(0); END_IF;
  IF n > 2 AND n MOD 4 = 1 THEN FAL(5); FAL(6); END_IF;
END_PROGRAM
"""


def test_a_program_that_raises_and_clears_for_ever_stays_within_the_limit(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(checkpoints, "EVERY_NS", 0)
    limit, path = 60_000, tmp_path / "run"
    programs = SourcePrograms({1: BLINKING})
    timeline = Timeline.begin(path, programs, 1, BLINKING.encode(), ENTRIES, "Ada", Detection(), limit)
    timeline.submit(force("Main.list[3]", "5"))
    longest = 0
    for _ in range(150):
        advance(timeline, 10)
        tidy(timeline)
        longest = max(longest, len(timeline.live_journal))
        assert timeline.recording.info.bytes <= limit * 1.3
    assert timeline.recording.info.dropped_before > 100
    assert longest < 400, "entries that mean nothing any more are kept"
    present = timeline.resource.journal.derived(ACTIVE)
    assert len(timeline.resource.journal.derived(FORCED)) == 1
    state, entries = timeline.resource.state, len(timeline.live_journal)
    timeline.close()

    def made(kept: Mapping[int, KeptProgram]) -> Programs:
        return of_file(kept)

    again = Timeline.resume(path, made, ENTRIES, detect=Detection(), limit=limit)
    assert again.resource.state == state
    assert len(again.live_journal) == entries
    assert list(again.resource.journal.derived(ACTIVE).items()) == list(present.items())
    assert again.resource.journal.derived(FORCED).keys() == {"MAIN.LIST[3]"}
    again.close()
    with Recording.open(path, ENTRIES, read_only=True) as recording:
        assert not recording.damage
