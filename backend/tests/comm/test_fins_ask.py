"""FINS as a client: what it sends is what the server understands, and the other way round."""

import asyncio

import pytest

from scanbench.comm.controller.contract import Connection
from scanbench.comm.fins import ask, tcp_frame
from scanbench.comm.fins.commands import respond
from scanbench.comm.fins.frame import parse
from scanbench.comm.fins.reading import open_fins
from scanbench.faults.inject import Generate
from scanbench.faults.reference import ErrorRef
from tests.comm.bench import LocalDoor, machine

HERE, THERE = ask.Address(node=25), ask.Address(node=1)


def asked(door: LocalDoor, command: int, body: bytes) -> ask.Answer:
    frame = ask.request(command, body, THERE, HERE, 7)
    request = parse(frame)
    assert request is not None
    answered, _ = asyncio.run(respond(request, door, False))
    return ask.answer_to(frame, answered)


def test_words_are_written_and_read_back() -> None:
    door = LocalDoor(machine())
    assert asked(door, 0x0102, ask.write_words("D", 100, b"\x34\x12\x01\x00")) == ask.Answer(0, False, False, b"")
    assert ask.words_of(asked(door, 0x0101, ask.read_words("D", 100, 2)), 2) == b"\x34\x12\x01\x00"
    places = [("D", 101), ("W", 3), ("D", 100)]
    assert ask.words_of_places(asked(door, 0x0104, ask.read_places(places)), places) == [1, 0, 0x1234]


def test_a_request_is_as_clients_send_it() -> None:
    """npm omron-fins, of `vectors.txt`: D100, 3 words."""
    frame = ask.request(0x0101, ask.read_words("D", 100, 3), ask.Address(node=1), ask.Address(node=25), 5)
    assert frame == bytes.fromhex("80 00 02 00 01 00 00 19 00 05 01 01 82 00 64 00 00 03")
    assert ask.request(0x0101, b"", THERE, HERE, 0, wants_answer=False)[0] == 0x81


def test_a_refusal_and_errors_of_the_cpu_unit_are_told_apart() -> None:
    door = LocalDoor(machine())
    door.resource.submit(Generate("Ada", (ErrorRef("battery-error"),)))
    assert asked(door, 0x0102, ask.write_words("A", 400, b"\0\0")) == ask.Answer(0x2101, True, False, b"")
    found = asked(door, 0x0101, ask.read_words("A", 400, 1))
    assert (found.end, found.nonfatal, ask.words_of(found, 1)) == (0, True, b"\xf7\x00")


@pytest.mark.parametrize(
    "frame", ["", "c0 00 02", "80 00 02 00 19 00 00 01 00 07 01 01 00 00", "c0 00 02 00 19 00 00 01 00 08 01 01 00 00"]
)
def test_what_is_no_answer_is_told(frame: str) -> None:
    with pytest.raises(ask.BadAnswer):
        ask.answer_to(ask.request(0x0101, b"", THERE, HERE, 7), bytes.fromhex(frame))


def test_areas_that_fins_does_not_have() -> None:
    assert ask.read_words("E0", 1, 1)[0] == 0xA0
    assert ask.read_words("E10", 1, 1)[0] == 0x60
    for area in ("X", "E19", "Ex", "T"):
        with pytest.raises(ValueError, match="FINS has no area"):
            ask.read_words(area, 0, 1)


def test_a_client_over_tcp_takes_its_node() -> None:
    (message,) = tcp_frame.Stream().feed(tcp_frame.given_nodes(239, 1))
    assert ask.nodes_of(message) == (239, 1)
    (message,) = tcp_frame.Stream().feed(ask.hello())
    assert (message.kind, tcp_frame.asked_node(message.content)) == (tcp_frame.Kind.ASK_NODE, 0)
    with pytest.raises(ask.BadAnswer):
        ask.nodes_of(message)


class Counting(asyncio.DatagramProtocol):
    """A controller that answers each request in a scan of its own, in which every word is the number of this scan."""

    scan = 0
    asked: list[int]

    def connection_made(self, transport: asyncio.DatagramTransport) -> None:  # type: ignore[override]
        self.transport, self.asked = transport, []

    def datagram_received(self, data: bytes, addr: tuple[str, int]) -> None:
        self.scan += 1
        places = data[12:]
        self.asked.append(len(places) // 4)
        words = b"".join(places[at : at + 1] + self.scan.to_bytes(2, "big") for at in range(0, len(places), 4))
        header = b"\xc0" + data[1:3] + data[6:9] + data[3:6] + data[9:10]
        self.transport.sendto(header + data[10:12] + b"\0\0" + words, addr)


def test_all_words_of_a_variable_are_asked_for_at_once() -> None:
    async def read() -> tuple[list[str], list[int]]:
        loop = asyncio.get_running_loop()
        transport, controller = await loop.create_datagram_endpoint(Counting, local_addr=("127.0.0.1", 0))
        port = transport.get_extra_info("sockname")[1]
        nodes = (
            "D0",
            *(f"D{10 + 2 * at}:DINT" for at in range(90)),
            "D0.00",
            *(f"E0_{4 * at}:LINT" for at in range(45)),
        )
        source = await open_fins(Connection(f"fins://127.0.0.1:{port}", nodes=nodes))
        try:
            cells = list(await source.read(range(len(nodes))))
        finally:
            await source.close()
            transport.close()
        return cells, controller.asked

    cells, asked = asyncio.run(read())
    assert (sum(asked), max(asked)) == (1 + 2 * 90 + 1 + 4 * 45, 159)
    longs, longer = cells[1:91], cells[92:]
    assert {divmod(int(each), 0x1_0001) for each in longs} == {(1, 0), (2, 0)}
    assert {divmod(int(each), 0x1_0001_0001_0001)[1] for each in longer} == {0}
