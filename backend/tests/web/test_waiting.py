"""A WebSocket whose other side does not read."""

import asyncio

import pytest

from scanbench.web.socket.waiting import Waiting


def test_texts_come_out_in_order() -> None:
    async def talk() -> list[str]:
        waiting = Waiting()
        waiting.add("b")
        waiting.add("c")
        waiting.first("a")
        return [waiting.take() for _ in range(3)] + [str(bool(waiting))]

    assert asyncio.run(talk()) == ["a", "b", "c", "False"]


def test_too_many_end_the_task_that_reads() -> None:
    async def read() -> Waiting:
        waiting = Waiting(limit=3)
        for text in "abcd":
            waiting.add(text)
        try:
            await asyncio.Event().wait()  # for what the other side says
        except asyncio.CancelledError:
            assert waiting.over
            waiting.add("e")
            return waiting
        raise AssertionError

    waiting = asyncio.run(asyncio.wait_for(_shielded(read), 5))
    assert not waiting, "nothing is kept for a connection that has ended"


async def _shielded(read: object) -> Waiting:
    assert callable(read)
    task = asyncio.get_running_loop().create_task(read())
    found: Waiting = await task
    return found


def test_below_the_limit_nothing_ends() -> None:
    async def read() -> bool:
        waiting = Waiting(limit=3)
        for text in "abc":
            waiting.add(text)
        await asyncio.sleep(0)
        return waiting.over

    assert asyncio.run(read()) is False
    with pytest.raises(IndexError):
        Waiting.take(asyncio.run(_empty()))


async def _empty() -> Waiting:
    return Waiting()
