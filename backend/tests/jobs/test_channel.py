"""Questions to another process: answers of their kind, deadlines, parts, and the death of the process. Time is the loop's own."""

import asyncio
import selectors
import socket
from collections.abc import Callable, Coroutine
from typing import TypeVar

import pytest

from scanbench.jobs import channel as channels
from scanbench.jobs.channel import Channel, messages
from scanbench.wire.codec import LENGTH, BadMessage, Splitter, pack
from scanbench.wire.host import Ack, Found, Lookup, Ping, Pong, SourcesOf
from scanbench.wire.jobs import JobRefused
from scanbench.wire.refused import Refused, Unavailable
from scanbench.wire.verification import PastAt, UsesAre, UsesOf

T = TypeVar("T")


class _Selector(selectors.DefaultSelector):
    """Where nothing comes, it is later at once."""

    now = 0.0

    def select(self, timeout: float | None = None) -> "list[tuple[selectors.SelectorKey, int]]":
        ready = super().select(0)
        if not ready and timeout is None:
            return super().select(None)
        if not ready and timeout:
            self.now += timeout
        return ready


class _Loop(asyncio.SelectorEventLoop):
    """Its clock goes on while it waits, and no other way."""

    def __init__(self) -> None:
        self._clock = _Selector()
        super().__init__(self._clock)

    def time(self) -> float:
        return self._clock.now


class Process:
    """The other end of a channel."""

    def __init__(self, in_turn: bool = False) -> None:
        self.killed = 0
        self.channel = Channel("line", self._kill, Unavailable, in_turn)
        self.others: list[object] = []
        self.splitter = Splitter()
        self.asked: list[object] = []

    def _kill(self) -> None:
        self.killed += 1

    async def start(self) -> None:
        ours, self.sock = socket.socketpair()
        self.sock.setblocking(False)
        reader, self.writer = await asyncio.open_unix_connection(sock=ours)
        self.channel.begin(self.writer)
        self.reading = asyncio.ensure_future(self._read(reader))

    async def _read(self, reader: asyncio.StreamReader) -> None:
        async for message in messages(reader):
            if not await self.channel.take(message):
                self.others.append(message)
        self.channel.end("it died")

    async def hear(self) -> object:
        """What it is asked next."""
        while not self.asked:
            data = await asyncio.get_running_loop().sock_recv(self.sock, 1 << 16)
            self.asked.extend(self.splitter.feed(data))
        return self.asked.pop(0)

    async def say(self, *said: object) -> None:
        """Says this; all of it is taken when this returns, up to what is waited for."""
        for message in said:
            self.sock.sendall(pack(message))
        await settle()

    async def die(self) -> None:
        self.sock.close()
        await self.reading

    async def end(self) -> None:
        self.sock.close()
        await self.reading
        self.writer.close()


async def settle() -> None:
    """Everything that can go on without time has gone on."""
    for _ in range(20):
        await asyncio.sleep(0)


def story(of: Callable[[Process], Coroutine[None, None, T]], in_turn: bool = False) -> T:
    async def run() -> T:
        process = Process(in_turn)
        await process.start()
        found = await of(process)
        await process.end()
        return found

    with asyncio.Runner(loop_factory=_Loop) as runner:
        return runner.run(run())


def look(text: str) -> Callable[[int], Lookup]:
    return lambda ref: Lookup(ref, "members", text)


def test_each_question_gets_its_own_answer_and_the_rest_is_for_others() -> None:
    async def ask(process: Process) -> None:
        ask = process.channel.ask
        first = asyncio.ensure_future(ask(look("a"), Found, 5))
        second = asyncio.ensure_future(ask(look("b"), Found, 5))
        heard = [await process.hear(), await process.hear()]
        assert [(each.ref, each.text) for each in heard if isinstance(each, Lookup)] == [(1, "a"), (2, "b")]
        await process.say(Pong(), Found(2, (), "b"), Found(1, (), "a"))
        assert ((await first).message, (await second).message) == ("a", "b")
        assert process.others == [Pong()]

    story(ask)


@pytest.mark.parametrize(
    "refusal", [Ack(1, False, "there is none", 3, ("Main",)), JobRefused(1, "there is none", ("Main",))]
)
def test_a_refusal_comes_in_place_of_any_answer(refusal: Ack | JobRefused) -> None:
    async def ask(process: Process) -> None:
        asking = asyncio.ensure_future(process.channel.ask(look("a"), Found, 5))
        await process.hear()
        await process.say(refusal)
        with pytest.raises(Refused, match="there is none") as raised:
            await asking
        assert raised.value.near == ("Main",)

    story(ask)


def test_an_acknowledgement_that_was_asked_for_is_an_answer_also_where_it_refuses() -> None:
    async def ask(process: Process) -> Ack:
        asking = asyncio.ensure_future(process.channel.ask(look("a"), Ack, 5))
        await process.hear()
        await process.say(Ack(1, False, "no", 3))
        return await asking

    assert story(ask) == Ack(1, False, "no", 3)


def test_an_answer_of_a_different_kind_is_none() -> None:
    async def ask(process: Process) -> None:
        asking = asyncio.ensure_future(process.channel.ask(look("a"), Found, 5))
        await process.hear()
        await process.say(SourcesOf(1, None))
        with pytest.raises(TypeError, match="Found was asked for, SourcesOf came"):
            await asking

    story(ask)


def test_a_late_answer_is_nobodys() -> None:
    async def ask(process: Process) -> None:
        with pytest.raises(TimeoutError):
            await process.channel.ask(look("a"), Found, 5)
        assert asyncio.get_running_loop().time() == pytest.approx(5)
        asking = asyncio.ensure_future(process.channel.ask(look("b"), Found, 5))
        await process.say(Found(1, (), "a"), Found(2, (), "b"))
        assert (await asking).message == "b"
        assert process.others == []

    story(ask)


def test_where_nobody_waits_any_more_nothing_is_kept() -> None:
    async def ask(process: Process) -> None:
        asking = asyncio.ensure_future(process.channel.ask(look("a"), Found, None))
        await process.hear()
        asking.cancel()
        await settle()
        await process.say(Found(1, (), "a"))
        assert asking.cancelled()
        assert process.others == []

    story(ask)


@pytest.mark.parametrize("in_turn", [False, True])
def test_a_deadline_after_other_questions(in_turn: bool) -> None:
    """One that answers in turn is busy with those before it; one that answers them all is not."""

    async def ask(process: Process) -> bool:
        first = asyncio.ensure_future(process.channel.ask(look("a"), Found, None))
        second = asyncio.ensure_future(process.channel.ask(look("b"), Found, 5))
        await asyncio.sleep(4)
        await process.say(Found(1, (), "a"))
        assert (await first).message == "a"
        await asyncio.sleep(4)
        await process.say(Found(2, (), "b"))
        return (await asyncio.gather(second, return_exceptions=True))[0] == Found(2, (), "b")

    assert story(ask, in_turn) == in_turn


def test_one_that_answers_in_turn_and_says_nothing_is_not_waited_for() -> None:
    async def ask(process: Process) -> float:
        with pytest.raises(TimeoutError):
            await process.channel.ask(look("a"), Found, 5)
        return asyncio.get_running_loop().time()

    assert story(ask, in_turn=True) == pytest.approx(5)


def test_what_is_open_when_it_dies_is_given_up() -> None:
    async def ask(process: Process) -> None:
        asking = [asyncio.ensure_future(process.channel.ask(look(text), Found, None)) for text in "ab"]
        await process.hear()
        await process.die()
        for each in asking:
            with pytest.raises(Unavailable, match="it died"):
                await each
        assert not process.channel.open
        assert not process.channel.tell(Ping())

    story(ask)


def test_what_is_given_up_while_it_is_silent() -> None:
    async def ask(process: Process) -> None:
        asking = asyncio.ensure_future(process.channel.ask(look("a"), Found, None))
        await process.hear()
        process.channel.give_up("it does not answer")
        with pytest.raises(Unavailable, match="does not answer"):
            await asking
        assert process.channel.open
        assert process.channel.tell(Ping())
        assert await process.hear() == Ping()

    story(ask)


def test_parts_come_in_order_and_hold_up_what_is_read() -> None:
    async def ask(process: Process) -> None:
        told: list[int] = []
        go_on = asyncio.Event()

        async def on_part(part: object) -> None:
            assert isinstance(part, PastAt)
            told.append(part.done)
            await go_on.wait()

        asking = asyncio.ensure_future(process.channel.ask(lambda ref: UsesOf(ref, 1, 1), UsesAre, None, on_part))
        await process.hear()
        await process.say(PastAt(1, 10, 30), PastAt(1, 20, 30), UsesAre(1, ()), Pong())
        assert told == [10]
        assert not asking.done()
        assert process.others == []
        go_on.set()
        assert await asking == UsesAre(1, ())
        await settle()
        assert told == [10, 20]
        assert process.others == [Pong()]

    story(ask)


def test_who_cannot_take_a_part_is_told_so() -> None:
    async def ask(process: Process) -> None:
        async def on_part(part: object) -> None:
            raise OSError("the disk is full")

        asking = asyncio.ensure_future(process.channel.ask(lambda ref: UsesOf(ref, 1, 1), UsesAre, None, on_part))
        await process.hear()
        await process.say(PastAt(1, 10, 30), PastAt(1, 20, 30), Pong())
        with pytest.raises(OSError, match="the disk is full"):
            await asking
        assert process.others == [Pong()]  # it goes on for others

    story(ask)


def test_a_process_that_does_not_read_is_ended(monkeypatch: pytest.MonkeyPatch) -> None:
    async def tell(process: Process) -> None:
        monkeypatch.setattr(channels, "UNREAD_BYTES", 100_000)
        process.sock.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        told = 0
        while not process.killed:
            assert process.channel.tell(Lookup(0, "members", "x" * 10_000))
            told += 1
            assert told < 1000, "it keeps everything"

    story(tell)


def test_what_is_no_message_ends_the_reading() -> None:
    async def read(process: Process) -> None:
        process.sock.sendall(LENGTH.pack(3) + b"\xc1\xc1\xc1")
        with pytest.raises(BadMessage):
            await process.reading
        process.reading = asyncio.ensure_future(asyncio.sleep(0))

    story(read)
