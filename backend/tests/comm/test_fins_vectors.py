"""What six real clients sent, answered as they took it for good: captured bytes (`vectors.txt`)."""

import asyncio
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

import pytest

from scanbench.comm.fins import tcp_frame
from scanbench.comm.fins.areas import element, swapped
from scanbench.comm.fins.commands import respond
from scanbench.comm.fins.frame import HEAD, Request, parse
from scanbench.plcmodel.model import Model
from scanbench.runtime.command import Patch, Refusal
from scanbench.runtime.modes import SetMode
from scanbench.runtime.resource import Resource
from scanbench.runtime.set_clock import SetClock
from tests.comm.bench import LocalDoor, machine

_TCP = 16
_ANSWER = HEAD + 2
# What the throw-away server answered and no CPU Unit of ours can say: sixteen CPU Units, an object code of zeros, the cycle
# times, the text of a FAL and the records of errors that were never raised here.
_OF_THE_MOMENT = {0x0502: 0, 0x0306: 6, 0x0620: 0, 0x0920: 2, 0x2102: 2, 0x0601: 0}


@dataclass(frozen=True, slots=True)
class Vector:
    what: str
    request: bytes
    answer: bytes

    @property
    def tcp(self) -> bool:
        return self.request.startswith(b"FINS")


def vectors() -> list[Vector]:
    found: list[Vector] = []
    what, request, client = "", b"", ""
    for line in Path(__file__).with_name("vectors.txt").read_text().splitlines():
        if line.startswith("## "):
            client = line[3:]
        elif line.startswith("> "):
            request = bytes.fromhex(line[2:])
        elif line.startswith("< "):
            found.append(Vector(f"{client} {what}", request, bytes.fromhex(line[2:])))
        elif line and not line.startswith("#"):
            what = line
    return found


VECTORS = vectors()


def test_all_are_there() -> None:
    assert len(VECTORS) == 113


def request_of(vector: Vector) -> Request:
    frame = vector.request[_TCP:] if vector.tcp else vector.request
    found = parse(frame)
    assert found is not None
    return found


def put(resource: Resource, request: Request, answered: bytes) -> None:
    """Has the memory hold what the answer tells, also where no tool may write."""
    if request.command == 0x0101:
        put_elements(resource, request.body[:4], answered)
    if request.command == 0x0104:
        at = 0
        for place in (request.body[begin : begin + 4] for begin in range(0, len(request.body), 4)):
            size = element(resource.program.layout.model, place[0], int.from_bytes(place[1:3], "big"), place[3]).size
            put_elements(resource, place, answered[at + 1 : at + 1 + size])
            at += 1 + size
    if request.command == 0x0701:
        told = [10 * (byte >> 4) + (byte & 15) for byte in answered]
        year, month, day, hour, minute, second, _ = told
        at_ = datetime(2000 + year, month, day, hour, minute, second, tzinfo=UTC)
        assert not isinstance(resource.submit(SetClock("Ada", at_)), Refusal)


def put_elements(resource: Resource, place: bytes, data: bytes) -> None:
    model: Model = resource.program.layout.model
    found = element(model, place[0], int.from_bytes(place[1:3], "big"), place[3])
    if found.area is None:
        return
    begin = resource.program.layout.areas[found.area.name] + 2 * found.word
    if found.size == 2:
        resource.memory[begin : begin + len(data)] = swapped(data)
        return
    for at, value in enumerate(data, found.bit):
        patch = Patch.of_bit(begin + at // 8, at % 8, bool(value))
        byte = resource.memory[patch.offset]
        resource.memory[patch.offset] = byte & ~patch.mask[0] | patch.data[0]


@pytest.fixture(scope="module")
def resource() -> Resource:
    return machine()


@pytest.mark.parametrize(
    "vector", [each for each in VECTORS if "handshake" not in each.what], ids=lambda each: each.what
)
def test_an_answer_is_what_the_client_took_for_good(vector: Vector, resource: Resource) -> None:
    request = request_of(vector)
    expected = vector.answer[_TCP:] if vector.tcp else vector.answer
    resource.submit(SetMode("Ada", "MONITOR"))
    refused = expected[HEAD:_ANSWER] != b"\0\0"
    if not refused:
        put(resource, request, expected[_ANSWER:])
    answered, _ = asyncio.run(respond(request, LocalDoor(resource), read_only=False, error_bits=False))
    same = _ANSWER + _OF_THE_MOMENT.get(request.command, len(expected))
    assert answered[:same].hex() == expected[:same].hex()
    if request.command in (0x0601, 0x0620, 0x0920):
        assert len(answered) == len(expected)
    if vector.tcp and same >= len(expected):
        assert tcp_frame.message(tcp_frame.Kind.FRAME, answered) == vector.answer


def test_the_handshake_gives_a_node() -> None:
    shaken = [each for each in VECTORS if "handshake" in each.what]
    assert len(shaken) == 3
    for vector in shaken:
        (message,) = tcp_frame.Stream().feed(vector.request)
        assert message.kind == tcp_frame.Kind.ASK_NODE
        assert tcp_frame.asked_node(message.content) == 0
        assert tcp_frame.given_nodes(200, 1) == vector.answer
