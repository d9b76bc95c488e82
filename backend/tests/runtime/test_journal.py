"""Entries are kept before they act, and what they add up to is not added up again and again."""

import errno
from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import UTC, datetime

import pytest

from scanbench.runtime.command import Command, Entry, Patch, Plan, Refusal
from scanbench.runtime.forces import FORCED, Force
from scanbench.runtime.journal import Fold, Journal
from scanbench.runtime.modes import SetMode
from scanbench.runtime.programs import Loaded
from scanbench.runtime.resource import Resource
from scanbench.runtime.restart import Restart
from scanbench.runtime.trap import Trapped
from scanbench.runtime.write import Write
from tests.runtime.bench import ENGINES, program, value

SOURCE = "PROGRAM Main\nVAR n : INT; d : INT := 1; END_VAR\n  n := n + 1; n := n / d;\nEND_PROGRAM\n"
AT = datetime(2026, 1, 1, tzinfo=UTC)


def entry(scan: int, command: Command | None = None) -> Entry:
    return Entry(scan, AT, command or Write("Ada", "D0", "1"), Plan((Patch.whole(8192, b"\1"),), "D0 := 1"))


def test_a_fold_steps_over_every_entry_once() -> None:
    stepped: list[int] = []

    def step(total: int, one: Entry) -> int:
        stepped.append(one.scan)
        return total + one.scan

    fold = Fold(0, step)
    journal = Journal([entry(1), entry(2)])
    assert journal.derived(fold) == 3
    journal.append(entry(4))
    assert (journal.derived(fold), journal.derived(fold)) == (7, 7)
    assert stepped == [1, 2, 4]
    assert fold.over(journal[1:]) == 6


def test_the_state_of_a_fold_can_be_kept() -> None:
    journal = Journal([entry(0, Force("Ada", "a", "1"))])
    before: Mapping[str, Force] = journal.derived(FORCED)
    journal.append(entry(1, Force("Ada", "b", "1")))
    assert before.keys() == {"A"}
    assert journal.derived(FORCED).keys() == {"A", "B"}


def test_scans_never_go_back() -> None:
    journal = Journal([entry(7)])
    with pytest.raises(ValueError, match="scan 6"):
        journal.append(entry(6))


@dataclass
class Kept:
    """A recorder; with `trouble` it cannot keep what need not be kept."""

    resource: Resource | None = None
    trouble: OSError | None = None
    entries: list[tuple[Entry, bool]] = field(default_factory=list)
    states: list[bytes] = field(default_factory=list)

    def entry(self, entry: Entry, must: bool) -> None:
        if self.trouble is not None and not must:
            raise self.trouble
        assert self.resource is not None
        self.entries.append((entry, must))
        self.states.append(self.resource.state)

    def why_lost(self, now: int, scan: int) -> str:
        return ""


def recorded() -> tuple[Resource, Kept]:
    kept = Kept()
    kept.resource = Resource(Loaded.make(program(SOURCE), ENGINES[0]), recorder=kept)
    return kept.resource, kept


def test_an_entry_is_kept_ahead_of_the_change() -> None:
    resource, kept = recorded()
    before = resource.state
    outcome = resource.submit(Write("Ada", "Main.n", "7"))
    assert kept.entries == [(outcome, False)]
    assert kept.states == [before]
    assert resource.state != before


@pytest.mark.parametrize(
    ("trouble", "words"), [(errno.ENOSPC, "disk is full"), (errno.EFBIG, "disk is full"), (errno.EIO, "Input/output")]
)
def test_what_cannot_be_kept_does_not_happen(trouble: int, words: str) -> None:
    resource, kept = recorded()
    resource.run(3)
    kept.trouble = OSError(trouble, "Input/output error")
    before = resource.state
    for command in (Write("Ada", "Main.n", "7"), Restart("Ada", "cold"), SetMode("Ada", "PROGRAM")):
        refusal = resource.submit(command)
        assert isinstance(refusal, Refusal)
        assert words in refusal.message
    assert (resource.state, len(resource.journal)) == (before, 0)
    kept.trouble = None
    assert isinstance(resource.submit(Write("Ada", "Main.n", "7")), Entry)
    assert value(resource, "Main.n") == 7


def test_a_trap_stops_the_program_whether_it_can_be_kept_or_not() -> None:
    resource, kept = recorded()
    resource.submit(Write("Ada", "Main.d", "0"))
    kept.trouble = OSError(errno.ENOSPC, "full")
    resource.run(3)
    assert not resource.runnable
    last, must = kept.entries[-1]
    assert isinstance(last.command, Trapped)
    assert must
    assert last is resource.journal[-1]


def test_a_part_of_a_journal_knows_what_the_whole_one_knew() -> None:
    steps = 0

    def step(total: int, one: Entry) -> int:
        nonlocal steps
        steps += 1
        return total + one.scan

    fold = Fold(0, step)
    journal = Journal()
    whole = [entry(scan) for scan in range(20_000)]
    for one in whole:  # asked for in between, as services do
        journal.append(one)
        if one.scan % 7 == 0:
            assert journal.derived(fold) == sum(range(one.scan + 1))
    assert journal.derived(fold) == sum(range(20_000))
    assert steps == 20_000, "each entry once"
    for count in (0, 1, 511, 512, 513, 9_999, 20_000):
        steps = 0
        part = journal.prefix(count)
        assert list(part) == whole[:count]
        assert part.derived(fold) == sum(range(count))
        assert steps < 600
        part.append(entry(50_000))
        assert part.derived(fold) == sum(range(count)) + 50_000
        assert journal.derived(fold) == sum(range(20_000))
    assert len(journal._derived[fold]) < 20_000 / 500 + 3


def test_a_journal_without_its_front_knows_what_it_knew() -> None:
    steps = 0

    def step(found: tuple[int, ...], one: Entry) -> tuple[int, ...]:
        nonlocal steps
        steps += 1
        return (*found, one.scan) if one.scan % 1000 == 3 else found

    nothing: tuple[int, ...] = ()
    fold = Fold(nothing, step)
    journal = Journal(entry(scan) for scan in range(10_000))
    known = journal.derived(fold)
    left = journal.without_front((3, 1003, 2003, 3003), 4000)
    steps = 0
    assert len(left) == 6004
    assert left.derived(fold) == known
    assert steps == 0
    assert left.prefix(3004).derived(fold) == tuple(range(3, 7000, 1000))
    assert left.prefix(2).derived(fold) == (3, 1003)
    assert steps < 600
