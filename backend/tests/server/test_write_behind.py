"""What waits to be written is bounded, and what cannot be written takes nothing else with it."""

import asyncio
import threading
from collections.abc import AsyncIterator, Iterator, Sequence
from contextlib import asynccontextmanager
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path

import pytest

from scanbench.faults.history import ErrorRow
from scanbench.server.write_behind import LOG_TRIMMED_EVERY, WriteBehind
from scanbench.store.errors import Errors
from scanbench.store.instances import Logs
from scanbench.store.records import HistoryRow, LogRow, StoreError
from scanbench.store.store import Store
from scanbench.wire.events import LogEntry

NOON = datetime(2026, 11, 21, 12, 0, tzinfo=UTC)
ROW = ErrorRow(
    "battery-error", "Battery error", "nonfatal", "generated", "00F7", "", NOON, None, 7, None, "ada", "simulator", 1,
    None, 3,
)  # fmt: skip


class Slow(Store):
    """Counts its batches, and waits with the rows of each until it may go on."""

    def __init__(self, url: str) -> None:
        super().__init__(url)
        self.begun, self.may = threading.Event(), threading.Event()
        self.may.set()
        self.rows: list[int] = []
        self.lines: list[int] = []
        self.errors, self.log = _Errors(self), _Logs(self)


class _Errors(Errors):
    def __init__(self, slow: Slow) -> None:
        super().__init__(slow._database)
        self._slow = slow

    def keep(self, instance: int, errors: Sequence[HistoryRow]) -> None:
        self._slow.rows.append(len(errors))
        self._slow.begun.set()
        self._slow.may.wait(60)
        super().keep(instance, errors)


class _Logs(Logs):
    def __init__(self, slow: Slow) -> None:
        super().__init__(slow._database)
        self._slow = slow

    def add(self, instance: int, lines: Sequence[LogRow], keep: int | None = None) -> None:
        self._slow.lines.append(len(lines))
        super().add(instance, lines, keep)


@pytest.fixture
def store(tmp_path: Path) -> Iterator[Slow]:
    opened = Slow(f"sqlite:///{tmp_path / 'bench.db'}")
    yield opened
    opened.close()


@pytest.fixture
def instance(store: Slow) -> int:
    return store.instances.create(store.projects.create("p", "CJ1M-CPU63").id, "i").id


@asynccontextmanager
async def keeping(store: Store) -> AsyncIterator[WriteBehind]:
    write_behind = WriteBehind(store, KEPT, WAITING)
    write_behind.start()
    try:
        yield write_behind
    finally:
        await write_behind.close()


KEPT, WAITING = 3000, 2000


def line(text: str) -> LogEntry:
    return LogEntry(NOON, 1, "ada", text, "error")


def texts(store: Store, instance: int) -> list[str]:
    return [each.text for each in store.log.last(instance, 10 * KEPT)]


def test_what_a_slow_database_cannot_follow_is_one_batch(store: Slow, instance: int) -> None:
    async def story() -> None:
        async with keeping(store) as write_behind:
            store.may.clear()
            write_behind.keep_rows(instance, [ROW])
            await asyncio.to_thread(store.begun.wait, 60)
            for count in range(2, 30_001):
                write_behind.keep_rows(instance, [replace(ROW, count=count)])
                write_behind.keep_line(instance, line(f"line {count}"), 3)
            write_behind.keep_rows(instance, [replace(ROW, id="fal", count=2), replace(ROW, program_version=4)])
            store.may.set()
            await write_behind.flush()
            assert store.rows == [1, 3]
            assert store.lines == [WAITING + 1]
            told = {(row.error, row.program_version): row.count for row in store.errors.history(instance)}
            assert told == {("battery-error", 3): 30_000, ("fal", 3): 2, ("battery-error", 4): 1}
            lost = f"{29_999 - WAITING:,} lines before this one could not be kept, as the database could not be used"
            assert texts(store, instance) == [lost, *(f"line {count}" for count in range(30_001 - WAITING, 30_001))]

    asyncio.run(story())


def test_waiting_ends_while_more_and_more_comes(store: Slow, instance: int) -> None:
    async def story() -> None:
        async with keeping(store) as write_behind:
            over = False

            async def chatter() -> None:
                while not over:
                    write_behind.keep_rows(instance, [ROW])
                    await asyncio.sleep(0)

            task = asyncio.get_running_loop().create_task(chatter())
            for number in range(5):
                write_behind.keep_line(instance, line(f"mark {number}"), 3)
                await write_behind.flush()
                assert f"mark {number}" in texts(store, instance)
            over = True
            await task

    asyncio.run(story())


def test_the_end_writes_the_rest(store: Slow, instance: int) -> None:
    async def story() -> None:
        async with keeping(store) as write_behind:
            write_behind.keep_rows(instance, [ROW])
            write_behind.keep_line(instance, line("last"), 3)
        assert texts(store, instance) == ["last"]
        assert [row.count for row in store.errors.history(instance)] == [1]
        await write_behind.flush()  # nothing writes any more, and nobody waits for it

    asyncio.run(story())


def test_old_lines_go(store: Slow, instance: int) -> None:
    async def story() -> None:
        store.log.add(instance, [LogRow(NOON, 1, "ada", "error", f"old {number}") for number in range(KEPT)])
        async with keeping(store) as write_behind:
            write_behind.keep_line(instance, line("first"), 3)
            await write_behind.flush()
            assert len(texts(store, instance)) == KEPT
            for _ in range(LOG_TRIMMED_EVERY + 1):
                write_behind.keep_line(instance, line("more"), 3)
            await write_behind.flush()
            assert len(texts(store, instance)) == KEPT
            assert texts(store, instance)[0] == f"old {LOG_TRIMMED_EVERY + 2}"

    asyncio.run(story())


def test_an_instance_that_is_gone_takes_nothing_with_it(
    store: Slow, instance: int, caplog: pytest.LogCaptureFixture
) -> None:
    async def story() -> None:
        gone = store.instances.create(store.projects.create("q", "CJ1M-CPU63").id, "j").id
        store.instances.delete(gone)
        async with keeping(store) as write_behind:
            for id in (gone, instance):
                write_behind.keep_rows(id, [ROW])
                write_behind.keep_line(id, line("here"), 3)
            await write_behind.flush()
        assert texts(store, instance) == ["here"]
        assert len(store.errors.history(instance)) == 1
        said = [record.getMessage() for record in caplog.records]
        assert said == [
            f"{what} of instance {gone} could not be written, 1 of it: there is no instance {gone}"
            for what in ("the error history", "the log")
        ]

    asyncio.run(story())


def test_a_row_that_cannot_be_written_takes_nothing_with_it(
    store: Slow, instance: int, caplog: pytest.LogCaptureFixture
) -> None:
    async def story() -> None:
        rows = [replace(ROW, id=f"error-{number}") for number in range(9)]
        rows[5] = replace(rows[5], generated_at=NOON.replace(tzinfo=None))
        async with keeping(store) as write_behind:
            write_behind.keep_rows(instance, rows)
            await write_behind.flush()
        assert [row.error for row in store.errors.history(instance)] == [
            f"error-{number}" for number in range(9) if number != 5
        ]
        (said,) = caplog.records
        assert "error-5" in said.getMessage()

    asyncio.run(story())


def test_what_the_database_refuses_is_written_when_it_can_be(
    store: Slow, instance: int, caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("scanbench.server.write_behind.AGAIN_S", 0.01)
    add, full, written = Logs.add, True, threading.Event()

    def refuse(self: Logs, instance: int, lines: Sequence[LogRow], keep: int | None = None) -> None:
        if full:
            raise StoreError("the database cannot be used now: database or disk is full")
        add(self, instance, lines, keep)
        written.set()

    monkeypatch.setattr(Logs, "add", refuse)

    async def story() -> None:
        nonlocal full
        async with keeping(store) as write_behind:
            for number in range(3):
                write_behind.keep_rows(instance, [replace(ROW, count=number)])
                write_behind.keep_line(instance, line(f"line {number}"), 3)
                await write_behind.flush()
            assert texts(store, instance) == []
            full = False
            await asyncio.to_thread(written.wait, 60)  # nobody asks for it
            assert texts(store, instance) == ["line 0", "line 1", "line 2"]
            assert [row.count for row in store.errors.history(instance)] == [2]

    asyncio.run(story())
    (said,) = caplog.records
    assert "database or disk is full" in said.getMessage()


def test_what_was_written_before_the_database_refused_is_not_written_again(
    store: Slow, instance: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("scanbench.server.write_behind.AGAIN_S", 0.01)
    add, batches, whole = Logs.add, 0, threading.Event()

    def refuse(self: Logs, instance: int, lines: Sequence[LogRow], keep: int | None = None) -> None:
        nonlocal batches
        batches += 1
        if batches == 3:  # all of them, the first half, the rest
            raise StoreError("the database cannot be used now: disk I/O error")
        add(self, instance, lines, keep)
        if lines[-1].text == "line 7":
            whole.set()

    monkeypatch.setattr(Logs, "add", refuse)

    async def story() -> None:
        async with keeping(store) as write_behind:
            for number in range(8):
                bad = replace(line(f"line {number}"), at=NOON.replace(tzinfo=None) if number == 5 else NOON)
                write_behind.keep_line(instance, bad, 3)
            await asyncio.to_thread(whole.wait, 60)
        assert texts(store, instance) == [f"line {number}" for number in range(8) if number != 5]

    asyncio.run(story())
