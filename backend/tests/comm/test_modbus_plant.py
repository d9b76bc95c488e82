"""Wires to a plant, and Modbus as a client: what it asks is what our server understands."""

import asyncio
from asyncio import StreamReader, StreamWriter
from collections import deque
from collections.abc import Sequence
from dataclasses import replace
from unittest.mock import MagicMock

import pytest

from scanbench.comm.desk import Desk
from scanbench.comm.door import Away, Read
from scanbench.comm.modbus import ask
from scanbench.comm.modbus.frame import Code, Request, Stream, failure
from scanbench.comm.modbus.functions import Target, respond
from scanbench.comm.modbus.mapping import default
from scanbench.comm.modbus.plant import PATIENCE_S, Line, PlantClient
from scanbench.comm.modbus.wires import PlantRange, PlantWanted, answers_bit, cleared, wires
from scanbench.runtime.write_areas import WriteAreas
from scanbench.wire.memory import AreaSpan
from scanbench.wire.refused import Refused
from tests.comm.bench import LocalDoor, machine

OMRON = machine().program.layout.model


def asked(door: LocalDoor, request: Request) -> Request:
    answered, _ = asyncio.run(respond(request, Target(door, default(door.model)), False))
    ((came, _),) = Stream().feed(answered)
    return came


def test_what_is_written_is_read_back() -> None:
    door = LocalDoor(machine())
    request, frame = ask.write(7, 1, "holding register", 100, 2, b"\x12\x34\x00\x01")
    assert [each for each, _ in Stream().feed(frame)] == [request]
    ask.check_written(request, asked(door, request))
    request, _ = ask.read(8, 1, "holding register", 100, 2)
    assert ask.data_of(request, asked(door, request), bits=False) == b"\x12\x34\x00\x01"
    request, _ = ask.write(9, 1, "coil", 3, 3, b"\x05")
    ask.check_written(request, asked(door, request))
    request, _ = ask.read(10, 1, "coil", 0, 9)
    assert ask.data_of(request, asked(door, request), bits=True) == b"\x28\x00"


def test_an_exception_and_a_wrong_answer_say_why() -> None:
    door = LocalDoor(machine())
    request, _ = ask.read(1, 1, "holding register", 60000, 1)
    with pytest.raises(ask.BadAnswer, match="exception 02: it has no such address"):
        ask.data_of(request, asked(door, request), bits=False)
    other, _ = ask.read(2, 1, "holding register", 0, 1)
    with pytest.raises(ask.BadAnswer, match="a different request"):
        ask.data_of(request, asked(door, other), bits=False)
    short = replace(asked(door, other), transaction=1, data=b"\x01\x00")
    with pytest.raises(ask.BadAnswer, match="1 bytes came where 2 were asked for"):
        ask.data_of(request, short, bits=False)
    ((no_unit, _),) = Stream().feed(failure(request, Code.NO_TARGET))
    with pytest.raises(ask.BadAnswer, match="no unit of this number"):
        ask.check_written(request, no_unit)


@pytest.mark.parametrize(("address", "count"), [("CIO0.00", 16), ("CIO0.03", 20), ("CIO10.07", 1), ("CIO1.15", 40)])
def test_bits_come_where_they_are_wired_to_and_go_from_there(address: str, count: int) -> None:
    door = LocalDoor(machine())
    inputs, outputs = wires(
        OMRON,
        PlantWanted(
            ranges=(
                PlantRange("discrete input", 5, count, address),
                PlantRange("coil", 5, count, address, "plant"),
            )
        ),
    )
    data = (0xA5C3_9F1B_77 & (1 << count) - 1).to_bytes((count + 7) // 8, "little")
    assert asyncio.run(door.submit(WriteAreas("plant", tuple(inputs.writes(data))))).ok
    span = outputs.span
    (memory,) = asyncio.run(door.read([span])).data
    assert len(memory) == span.size
    assert outputs.values(memory) == data
    asyncio.run(door.submit(WriteAreas("plant", tuple(cleared([inputs, outputs])))))
    assert outputs.values(asyncio.run(door.read([span])).data[0]) == bytes(len(data))


def test_words_have_the_high_byte_first_on_the_line_and_many_are_several_requests() -> None:
    wanted = PlantWanted(ranges=(PlantRange("input register", 0, 300, "D100"),))
    (found,) = wires(OMRON, wanted)
    assert [(each.first, each.count, each.span.byte) for each in found.pieces()] == [
        (0, 125, 200), (125, 125, 450), (250, 50, 700),
    ]  # fmt: skip
    (write,) = next(found.pieces()).writes(b"\x12\x34" * 125)
    assert write.data == b"\x34\x12" * 125


@pytest.mark.parametrize(
    ("wanted", "why"),
    [
        (PlantRange("coil", 0, 1, "nowhere"), "range 1: 'nowhere' is not an address"),
        (PlantRange("coil", 0, 1, "D5"), "range 1: D5 has 16 bits, and a bit is needed"),
        (PlantRange("input register", 0, 2, "D32767"), "range 1: 2 from D32767 on do not fit into D"),
        (PlantRange("input register", 0, 1, "A400"), "range 1: A400 is read-only for tools"),
        (PlantRange("input register", 65535, 2, "D0"), "range 1: input register 65535 to 65536 is outside of 0 to 65535"),
        (PlantRange("discrete input", 0, 1, "CIO0.00", "plant"), "range 1: a discrete input of a plant can only be read"),
        (PlantRange("holding register", 0, 5000, "D0"), "up to 4096 coils and registers"),
    ],
)  # fmt: skip
def test_ranges_that_make_no_sense_are_refused(wanted: PlantRange, why: str) -> None:
    with pytest.raises(Refused, match=why):
        wires(OMRON, PlantWanted(ranges=(wanted,)))


def test_other_settings_that_make_no_sense_are_refused() -> None:
    for wanted, why in (
        (PlantWanted(host=" "), "needs an address"), (PlantWanted(port=0), "port 0 of the plant is outside of 1 to 65535"),
        (PlantWanted(unit=256), "unit 256 of the plant is outside"), (PlantWanted(every_ms=1), "interval of 1 ms is outside of 10 to 60000"),
    ):  # fmt: skip
        with pytest.raises(Refused, match=why):
            wires(OMRON, wanted)
    with pytest.raises(Refused, match="plant answers: D0 has 16 bits"):
        answers_bit(OMRON, PlantWanted(answers="D0"))
    assert answers_bit(OMRON, PlantWanted()) is None


@pytest.mark.parametrize("turns", range(6))
def test_an_exchange_ends_when_it_is_cancelled_just_as_the_answer_comes(turns: int) -> None:
    """Otherwise a plant that is switched off is exchanged with for ever, and the request that did it never gets its answer."""

    async def cancelled() -> bool:
        reader, writer = asyncio.StreamReader(), MagicMock(StreamWriter)
        line = Line(reader, writer, Stream(), deque())

        async def exchange() -> None:
            while True:
                await line.answer()

        task = asyncio.create_task(exchange())
        for _ in range(5):  # until it waits
            await asyncio.sleep(0)
        reader.feed_data(failure(ask.read(1, 1, "coil", 0, 1)[0], Code.NO_TARGET))
        for _ in range(turns):
            await asyncio.sleep(0)
        task.cancel()
        done, _ = await asyncio.wait([task], timeout=PATIENCE_S)
        return bool(done)

    assert asyncio.run(cancelled())


class Leaving(LocalDoor):
    """Of a PLC whose process is gone between two halves of an exchange."""

    def __init__(self) -> None:
        super().__init__(machine())
        self.reads, self.back = 0, asyncio.Event()

    async def read(self, spans: Sequence[AreaSpan], also: Sequence[AreaSpan] = ()) -> Read:
        self.reads += 1
        if self.reads == 2:
            raise Away("the PLC is starting")
        if self.reads == 3:
            self.back.set()
        return await super().read(spans, also)


def test_values_are_exchanged_again_when_the_plc_is_back() -> None:
    async def run() -> None:
        plant, door = LocalDoor(machine()), Leaving()

        async def serve(reader: StreamReader, writer: StreamWriter) -> None:
            stream = Stream()
            while data := await reader.read(4096):
                for request, _ in stream.feed(data):
                    answered, _ = await respond(request, Target(plant, default(plant.model)), False)
                    writer.write(answered)
            writer.close()

        async with await asyncio.start_server(serve, "127.0.0.1") as server:
            ranges = (PlantRange("input register", 0, 1, "D1"), PlantRange("holding register", 1, 1, "D2", "plant"))
            wanted = PlantWanted(on=True, port=server.sockets[0].getsockname()[1], every_ms=10, ranges=ranges)
            client = PlantClient(door, wanted, Desk(lambda _: door, lambda: None, False), lambda _: None)
            task = asyncio.create_task(client.run())
            try:
                async with asyncio.timeout(PATIENCE_S):
                    await door.back.wait()
                assert client.answers
            finally:
                task.cancel()
                await asyncio.wait([task])

    asyncio.run(run())
