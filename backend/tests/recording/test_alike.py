"""Writes of clients that repeat each other: how many bytes they take, and that they are read as they were."""

import os
import random
from contextlib import suppress
from datetime import timedelta
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scanbench.recording.alike import Slots
from scanbench.recording.block import SHORT, Block, Kind
from scanbench.recording.format import RunFile, RunFileError
from scanbench.recording.recording import Recording
from scanbench.recording.replay_file import replay_file
from scanbench.runtime.clock import wall_time
from scanbench.runtime.command import Entry, Patch, Plan
from scanbench.runtime.write import Write
from scanbench.runtime.write_areas import AreaWrite, WriteAreas
from scanbench.runtime.write_variables import VariableWrite, WriteVariables
from scanbench.wire.codec import ENTRIES
from tests.recording.recorded import advance, begun, of_file, resumed, tidy

AUTHOR = "FINS 192.168.0.7, node 25"


def word(value: int, author: str = AUTHOR) -> WriteAreas:
    return WriteAreas(author, (AreaWrite("D", 200, value.to_bytes(2, "little")),))


def bit(on: bool) -> WriteAreas:
    return WriteAreas(AUTHOR, (AreaWrite("CIO", 7, bytes((on,)), 3),))


def blocks_of(path: Path) -> list[Block]:
    file = RunFile.open(path, read_only=True)
    try:
        return list(file.scan_blocks())
    finally:
        file.close()


def test_a_heartbeat_takes_20_bytes_a_write_at_most(tmp_path: Path) -> None:
    """At 10 Hz, with scans of 10 ms. The first write of each client after a state is whole."""
    timeline = begun(tmp_path / "run")
    entered = []
    for number in range(1, 3_000):
        outcome = timeline.submit(word(number))
        assert isinstance(outcome, Entry)
        entered.append(outcome)
        timeline.resource.pass_time(10)
    expected = tuple(entered)
    assert tuple(timeline.live_journal) == expected
    timeline.close()
    blocks = [each for each in blocks_of(tmp_path / "run") if each.kind is Kind.ENTRY]
    assert sum(each.size for each in blocks) <= 20 * len(blocks)
    again = resumed(tmp_path / "run")
    assert tuple(again.live_journal) == expected
    again.close()


def test_clients_that_take_turns_are_told_apart(tmp_path: Path) -> None:
    timeline = begun(tmp_path / "run")
    advance(timeline, 2)
    for number in range(1, 40):
        speed = WriteVariables("OPC UA Eve", (VariableWrite("Main.other", "DINT", number.to_bytes(4, "little")),))
        for command in (
            speed,
            word(number),
            word(number << 8, "Modbus 10.0.0.1"),
            bit(number % 2 == 1),
            Write("Ada", "Main.other", "3"),
        ):
            assert isinstance(timeline.submit(command), Entry)
        advance(timeline, 3)
    journal, state = tuple(timeline.live_journal), timeline.resource.state
    messages = {each.plan.message for each in journal}
    assert {"Main.other := 7", "D100 := 16#0007", "D100 := 16#0700", "CIO3.11 := TRUE", "CIO3.11 := FALSE"} <= messages
    timeline.close()
    short = [each for each in blocks_of(tmp_path / "run") if each.packing == SHORT]
    assert len(short) > 130
    again = resumed(tmp_path / "run")
    assert tuple(again.live_journal) == journal
    assert again.resource.state == state
    assert again.goto(50) is None
    again.close()
    assert replay_file(tmp_path / "run", of_file, ENTRIES).entries == len(journal)


def test_nothing_is_left_of_a_longer_mark(tmp_path: Path) -> None:
    timeline = begun(tmp_path / "run")
    for number in range(1, 9):
        timeline.submit(word(number))
        timeline.resource.pass_time(5)
        timeline.note()
    timeline.submit(word(99))
    path, journal = timeline.recording.path, tuple(timeline.live_journal)
    with Recording.open(path, ENTRIES, read_only=True) as found:  # as after a kill: nobody closed it
        assert not found.damage
        assert tuple(found.take_entries()) == journal
    timeline.close()


def test_they_are_read_on_while_they_are_written(tmp_path: Path) -> None:
    timeline = begun(tmp_path / "run")
    timeline.submit(word(1))
    with Recording.open(timeline.recording.path, ENTRIES, read_only=True) as reading:
        entries = reading.take_entries()
        for number in range(2, 30):
            timeline.submit(word(number))
            timeline.resource.pass_time(1)
            if number % 3:
                timeline.note()
            entries += reading.read_on()
        assert tuple(entries) == tuple(timeline.live_journal)
    timeline.close()


def test_a_file_is_made_smaller_with_them_in_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("scanbench.recording.smaller.ENTRY_LIMIT", 60)
    timeline = begun(tmp_path / "run")
    timeline.recording.bounds.tried(0, 0)
    for number in range(1, 300):
        timeline.submit(word(number))
        if number % 10 == 0:
            timeline.recording.checkpoint(timeline.live_scan, 1, timeline.resource.state)
            tidy(timeline)
        advance(timeline, 1)
    journal, state = tuple(timeline.live_journal), timeline.resource.state
    assert timeline.recording.about.dropped_before
    timeline.close()
    again = resumed(tmp_path / "run")
    assert tuple(again.live_journal) == journal
    assert again.resource.state == state
    again.close()


@cache
def _whole() -> tuple[bytes, tuple[bytes, ...], tuple[Entry, ...]]:
    with TemporaryDirectory() as folder:
        path = Path(folder, "run")
        timeline, states = begun(path), []
        for scan in range(60):
            timeline.submit(word(scan + 1))
            timeline.submit(bit(scan % 2 == 0))
            if scan % 20 == 10:
                timeline.recording.checkpoint(scan, 1, timeline.resource.state)
            states.append(timeline.resource.state)
            advance(timeline, 1)
        journal = tuple(timeline.live_journal)
        timeline.close()
        return path.read_bytes(), tuple(states), journal


@settings(max_examples=60, deadline=None)
@given(seed=st.integers(0, 1 << 32))
def test_damage_costs_what_lies_before_the_next_state(tmp_path_factory: pytest.TempPathFactory, seed: int) -> None:
    data, states, journal = _whole()
    chance = random.Random(seed)
    at = chance.randrange(16, len(data))
    size = chance.choice((1, 3, 40))
    path = tmp_path_factory.mktemp("damage") / "run"
    path.write_bytes(data[:at] + os.urandom(size) + data[at + size :])
    try:
        found = Recording.open(path, ENTRIES, read_only=True)
    except RunFileError:
        return
    with found:
        assert set(found.take_entries()) <= set(journal)
    timeline = resumed(path)
    gaps = timeline.recording.info.lost
    for scan in {0, 10, 20, 30, 31, 50, timeline.live_scan - 1}:
        if scan < timeline.live_scan and not any(each.first <= scan < each.until for each in gaps):
            if scan >= timeline.recording.first_scan and timeline.goto(scan) is None:
                entered = [each for each in timeline.resource.journal if each.scan <= scan]
                assert set(entered) <= set(journal)
                if entered == [each for each in journal if each.scan <= scan]:
                    assert timeline.resource.state == states[scan]
    timeline.close()


def test_what_would_not_come_out_the_same_is_kept_whole() -> None:
    slots = Slots()
    patch = Patch(4_000, b"\xff\xff", b"\x01\x00")
    first = Entry(5, wall_time(), word(1), Plan((patch,), "D100 := 16#0001"))
    assert slots.take(first) == 1
    second = Entry(
        9, first.at - timedelta(days=400), word(2), Plan((Patch(3_999, b"\xf0", b"\x10"),), "D100 := 16#0002")
    )
    made = slots.brief(second)
    assert made is not None
    assert slots.brief(Entry(9, first.at, word(2), Plan((patch,), "said in another way"))) is None
    assert slots.brief(Entry(9, first.at, word(2), Plan((patch,), "D100 := 16#0002"), step=4)) is None
    block = Block(Kind.ENTRY, 9, 0, len(made[1]), SHORT, 9, 1, 0, 0, made[0])
    assert slots.read(block, made[1]) == second
    for end in range(len(made[1])):
        with suppress(ValueError):
            assert slots.read(block, made[1][:end]) != second
    slots.clear()
    assert slots.read(block, made[1]) is None
