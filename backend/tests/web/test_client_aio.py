"""The client of `asyncio`: it has what the one that waits has."""

import asyncio
import inspect
from collections.abc import Awaitable, Callable
from itertools import count

import pytest

from scanbench import client
from scanbench.client import Refused, aio, connect
from scanbench.client.asking import asked, asked_value
from tests.web.server import Server

SOURCE = """\
PROGRAM Main
VAR n : INT; level : INT; END_VAR
n := n + 1;
END_PROGRAM
"""
_NUMBERS = count()


def played(server: Server, story: Callable[[aio.Server, aio.Plc], Awaitable[None]]) -> None:
    """The story at a PLC of its own, which is paused before scan 0."""
    name = f"awaited {next(_NUMBERS)}"
    server.instance(name, "GENERIC-IEC", Main=SOURCE)

    async def play() -> None:
        there = aio.connect_async(server.address, user="Ann")
        plc = await there.plc(name)
        await plc.pause()
        await plc.new_run()
        await story(there, plc)

    asyncio.run(play())


def test_what_is_asked_is_awaited(server: Server) -> None:
    async def story(there: aio.Server, plc: aio.Plc) -> None:
        assert plc.id in (await there.plcs()).values()
        await plc.run(scans=5, speed=0)
        assert (await plc.read("Main.n"), (await plc.state)["scan"]) == ("5", 5)
        async with plc.forced("Main.n", 7):
            assert [each["path"] for each in await plc.forces] == ["Main.n"]
        assert await plc.forces == []
        assert (await plc.last_write("Main.n"))["author"] == "Ann"
        with pytest.raises(Refused, match="INT"):
            await plc.write("Main.level", "many")
        with pytest.raises(Refused, match="no instance"):
            await there.plc("nowhere")
        found = await plc.wait_for_verification(await plc.begin_verification(1, 3))
        assert client.verdict(found) == "same"

    played(server, story)


def test_two_plcs_run_at_a_time(server: Server) -> None:
    async def story(there: aio.Server, plc: aio.Plc) -> None:
        other = await plc.branch("other")
        await asyncio.gather(plc.run(until="Main.n >= 20"), other.run(until="Main.n >= 30"))
        assert (await plc.read("Main.n"), await other.read("Main.n")) == ("20", "30")
        copy = await there.take_run(await plc.export_run(), "copy")
        assert isinstance(copy, aio.Plc)
        assert await copy.read("Main.n") == "20"
        await asyncio.gather(other.delete(), copy.delete())

    played(server, story)


def test_what_takes_too_long_is_given_up(server: Server) -> None:
    async def story(_: aio.Server, plc: aio.Plc) -> None:
        with pytest.raises(TimeoutError, match="still runs"):
            await plc.run(until="FALSE", timeout_s=0)
        with pytest.raises(TimeoutError):
            async with asyncio.timeout(0.05):
                await plc.run(until="FALSE")
        await plc.pause()

    played(server, story)


def test_values_are_watched_and_breakpoints_halt(server: Server) -> None:
    async def story(_: aio.Server, plc: aio.Plc) -> None:
        async with plc.watch("Main.n") as frames, plc.debug() as debugger:
            assert (await frames.next(timeout_s=60)).values == {"Main.n": 0}
            await debugger.break_at("Main.st", 3, condition="n = 3")
            await debugger.go()
            stopped = await debugger.wait()
            assert (stopped.reason, stopped.scan) == ("breakpoint", 3)
            assert [each.line for each in await debugger.stack()] == [3]
            async for frame in frames:
                if frame.values["Main.n"] == 3:
                    break
            with pytest.raises(TimeoutError):
                await frames.next(timeout_s=0)
        with pytest.raises(Refused):
            async with plc.watch("Main.nowhere"):
                pass

    played(server, story)


def test_nothing_is_there_in_one_form_only() -> None:
    for waits, awaited in ((client.Plc, aio.Plc), (client.Server, aio.Server), (client.Debugger, aio.Debugger)):
        names = {each for each in dir(waits) if not each.startswith("_")}
        assert names == {each for each in dir(awaited) if not each.startswith("_")}
        for each in names:
            of = inspect.getattr_static(waits, each)
            assert of.__doc__, each
            assert not isinstance(of, asked | asked_value) or of is inspect.getattr_static(awaited, each)


def test_a_server_that_is_not_there_is_an_oserror() -> None:
    with pytest.raises(OSError, match="refused"):
        connect("127.0.0.1:1").plcs()
    with pytest.raises(OSError, match="refused"):
        asyncio.run(aio.connect_async("127.0.0.1:1").plcs())
