"""FINS 2301, forced set and reset: the bits of one frame are forced and released in one seam, all of them or none."""

import asyncio

import pytest

from scanbench.comm.fins.codes import End
from scanbench.comm.fins.commands import respond
from scanbench.comm.fins.frame import parse
from scanbench.recording.journal_roots import journal_roots
from scanbench.runtime import forces, target
from scanbench.runtime.command import Entry, Refusal, View
from scanbench.runtime.forces import FORCED, FORCED_SINCE, Force, forced_values
from scanbench.runtime.journal import Journal
from scanbench.runtime.resource import Resource
from scanbench.symbols.symbols import Symbol
from scanbench.wire.codec import ENTRIES
from tests.comm.bench import LocalDoor, machine

SOURCE = "PROGRAM Main VAR n : INT; lamp AT CIO 100.03 : BOOL; END_VAR n := n + 1; END_PROGRAM"
RESET, SET, RELEASE = "0000", "0001", "FFFF"
RELEASE_OFF, RELEASE_ON = "8000", "8001"
D = "02"


def bit(number: int, area: str = "30") -> str:
    """Of CIO 100."""
    return f"{area}0064{number:02x}"


def force(resource: Resource, *changes: tuple[str, str]) -> int:
    """The end code."""
    body = "2301" + f"{len(changes):04x}" + "".join(what + where for what, where in changes)
    request = parse(bytes.fromhex("80000200010000190001" + body))
    assert request is not None
    answered, end = asyncio.run(respond(request, LocalDoor(resource), False, error_bits=False))
    assert int.from_bytes(answered[12:14], "big") == end
    return int(end)


def forced(resource: Resource) -> dict[str, str]:
    return {each.path: each.value for each in forced_values(resource.view)}


def test_all_of_a_frame_is_one_entry_of_one_author() -> None:
    resource = machine(source=SOURCE)
    assert force(resource, (SET, bit(1))) == End.OK
    assert force(resource, (SET, bit(4)), (RESET, bit(5)), (RELEASE, bit(1)), (RELEASE, bit(9))) == End.OK
    assert forced(resource) == {"CIO100.04": "TRUE", "CIO100.05": "FALSE"}
    entry = resource.journal[-1]
    assert len(resource.journal) == 2
    assert entry.command.author == LocalDoor.author
    assert entry.plan.message == "CIO100.04 forced to TRUE; CIO100.05 forced to FALSE; CIO100.01 released"
    resource.run(3)
    area = resource.program.layout.areas["CIO"]
    assert resource.memory[area + 200] == 0x12, "what was on stays after its release"
    assert ENTRIES.unpack(ENTRIES.pack(entry)) == entry


def test_a_bit_is_released_and_off_or_on() -> None:
    resource = machine(source=SOURCE)
    assert isinstance(resource.submit(Force("Ada", "Main.lamp", "TRUE")), Entry)
    assert force(resource, (SET, bit(1))) == End.OK
    assert force(resource, (RELEASE_OFF, bit(1)), (RELEASE_OFF, bit(3)), (RELEASE_ON, bit(4))) == End.OK
    assert forced(resource) == {}
    resource.run(3)
    area = resource.program.layout.areas["CIO"]
    assert resource.memory[area + 200] == 0x10


def test_where_one_cannot_be_none_is() -> None:
    resource = machine(source=SOURCE)
    assert isinstance(resource.submit(Force("Ada", "Main.lamp", "TRUE")), Entry)
    before = bytes(resource.memory)
    assert force(resource, (SET, bit(1)), (SET, bit(3)), (SET, bit(4))) == End.CANNOT_CHANGE
    assert list(forced(resource)) == ["Main.lamp"]
    assert bytes(resource.memory) == before
    assert force(resource, (SET, bit(1)), (SET, bit(3, area=D))) == End.NO_AREA
    assert len(resource.journal) == 1


def test_releases_of_what_is_not_forced_are_answered_and_not_kept_by_the_seam() -> None:
    resource = machine(source=SOURCE)
    before = bytes(resource.memory)
    assert force(resource, (RELEASE, bit(1)), (RELEASE, bit(2))) == End.OK
    assert bytes(resource.memory) == before


@pytest.mark.parametrize("more", [(), ((RELEASE, bit(2)),)])
def test_what_is_forced_outlives_the_time_it_was_entered_in(more: tuple[tuple[str, str], ...]) -> None:
    resource = machine(source=SOURCE)
    force(resource, (SET, bit(1)), (SET, bit(2)))
    force(resource, (RESET, bit(1)))
    if more:
        force(resource, *more)
    entries = list(resource.journal)
    kept = Journal(entries[each] for each in journal_roots(entries, (FORCED, FORCED_SINCE)))
    found = kept.derived(FORCED)
    assert found == resource.journal.derived(FORCED)
    assert set(found) == {"CIO100.01", *({"CIO100.02"} if not more else set())}


def test_what_a_frame_costs_grows_with_its_bits_and_not_with_their_square(monkeypatch: pytest.MonkeyPatch) -> None:
    """Between two scans: what was copied and looked up again for each bit made the PLC wait for seconds."""
    looked = copied = 0
    find, prefix = target.find, Journal.prefix

    def counting(view: View, path: str) -> Symbol | Refusal:
        nonlocal looked
        looked += 1
        return find(view, path)

    def copying(journal: Journal, count: int) -> Journal:
        nonlocal copied
        copied += 1
        return prefix(journal, count)

    for module in (target, forces):
        monkeypatch.setattr(module, "find", counting)
    monkeypatch.setattr(Journal, "prefix", copying)
    resource, many = machine(source=SOURCE), 60
    bits = [f"300{0x64 + each // 16:03x}{each % 16:02x}" for each in range(many)]
    bits.remove(bit(3))
    for what in (SET, RESET, RELEASE, RELEASE):
        looked = copied = 0
        assert force(resource, *((what, each) for each in bits)) == End.OK
        assert looked <= 8 * many
        assert copied == 0
    assert forced(resource) == {}
