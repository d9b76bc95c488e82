"""Whatever comes: an answer or none, and nothing is written that a tool may not write."""

import asyncio
from contextlib import suppress

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scanbench.comm.fins import tcp_frame
from scanbench.comm.fins.commands import COMMANDS, respond
from scanbench.comm.fins.describe import described, outcome
from scanbench.comm.fins.frame import LARGEST, parse
from scanbench.comm.modbus import frame as modbus
from scanbench.comm.modbus import functions
from scanbench.comm.modbus.mapping import default
from scanbench.comm.slmp import commands as slmp_commands
from scanbench.comm.slmp import frame as slmp
from scanbench.runtime.resource import Resource
from tests.comm.bench import LocalDoor, machine
from tests.comm.test_fins_vectors import VECTORS

FRAMES = [each.request[16:] if each.tcp else each.request for each in VECTORS if "handshake" not in each.what]


@pytest.fixture(scope="module")
def resource() -> Resource:
    return machine()


@pytest.fixture(scope="module")
def melsec() -> Resource:
    return machine("Q03UD")


@st.composite
def mutated(draw: st.DrawFn) -> bytes:
    """A captured request with bytes changed, taken out or added; or a known command with any body."""
    if draw(st.booleans()):
        return (
            bytes.fromhex("80000200010000190001")
            + draw(st.sampled_from(sorted(COMMANDS))).to_bytes(2, "big")
            + draw(st.binary(max_size=40))
        )
    frame = bytearray(draw(st.sampled_from(FRAMES)))
    for _ in range(draw(st.integers(0, 4))):
        at = draw(st.integers(0, len(frame)))
        frame[at : at + draw(st.integers(0, 2))] = draw(st.binary(max_size=3))
    return bytes(frame)


def read_only(resource: Resource) -> bytes:
    """A400 to A447: error memory."""
    begin = resource.program.layout.areas["A"]
    return bytes(resource.memory[begin + 800 : begin + 896])


@given(st.one_of(mutated(), st.binary(max_size=60)))
def test_fins(resource: Resource, data: bytes) -> None:
    request = parse(data)
    if request is None:
        return
    before = read_only(resource)
    answered, end = asyncio.run(respond(request, LocalDoor(resource), read_only=False))
    assert len(answered) <= LARGEST
    assert answered[10:12] == data[10:12]
    assert described(request, resource.program.layout.model)
    assert (outcome(end) == "") == (end == 0)
    assert read_only(resource) == before
    assert not resource.journal or resource.journal[-1].command.author == LocalDoor.author


@given(st.lists(st.binary(max_size=40), max_size=6), st.booleans())
def test_pieces_of_fins_over_tcp(pieces: list[bytes], honest: bool) -> None:
    stream = tcp_frame.Stream()
    try:
        for piece in pieces:
            for message in stream.feed(tcp_frame.message(tcp_frame.Kind.FRAME, piece) if honest else piece):
                assert not honest or message.content in pieces
    except tcp_frame.Broken:
        assert not honest


@given(st.integers(0, 127), st.binary(max_size=260), st.integers(0, 255))
def test_modbus(resource: Resource, function: int, data: bytes, unit: int) -> None:
    before = read_only(resource)
    target = functions.Target(LocalDoor(resource), default(resource.program.layout.model))
    answered, code = asyncio.run(functions.respond(modbus.Request(7, unit, function, data), target, read_only=False))
    assert answered[:4] == b"\0\7\0\0"
    assert int.from_bytes(answered[4:6], "big") == len(answered) - 6 <= 254
    assert (answered[7] == function) == (code is None)
    assert read_only(resource) == before


def test_values_of_two_and_four_registers_have_their_high_word_first() -> None:
    resource = machine(
        "GENERIC-IEC", "PROGRAM Main VAR d AT %MD4 : DWORD; l AT %ML3 : LWORD; n : INT; END_VAR n := n + 1; END_PROGRAM"
    )
    target = functions.Target(LocalDoor(resource), default(resource.program.layout.model))

    def ask(function: int, data: str) -> str:
        request = modbus.Request(1, 1, function, bytes.fromhex(data))
        answered, code = asyncio.run(functions.respond(request, target, read_only=False))
        assert code is None
        return answered[8:].hex()

    ask(16, "0808" + "0002" + "04" + "12345678")
    ask(16, "100c" + "0004" + "08" + "0123456789abcdef")
    area = resource.program.layout.areas["M"]
    assert resource.memory[area + 16 : area + 20].hex() == "78563412"
    assert resource.memory[area + 24 : area + 32].hex() == "efcdab8967452301"
    assert ask(3, "0808" + "0002") == "04" + "12345678"
    assert ask(3, "100c" + "0004") == "08" + "0123456789abcdef"


@given(st.booleans(), st.sampled_from(sorted(slmp_commands.COMMANDS)), st.integers(0, 2), st.binary(max_size=60))
def test_slmp(melsec: Resource, ascii: bool, command: int, sub: int, data: bytes) -> None:
    if ascii:
        data = data.hex().upper().encode()[: len(data)]
    request = slmp.Request(ascii, (0, 255, 0x3FF, 0), command, sub, data)
    begin = melsec.program.layout.areas["SD"]
    before = bytes(melsec.memory[begin : begin + 100])
    answered, end = asyncio.run(slmp_commands.respond(request, LocalDoor(melsec), read_only=False))
    assert answered[:2] == (b"D0" if ascii else b"\xd0\0")
    assert (slmp_commands.outcome(end) == "") == (end == 0)
    assert slmp_commands.described(request, LocalDoor(melsec))
    assert bytes(melsec.memory[begin : begin + 100]) == before


@given(st.lists(st.binary(max_size=40), max_size=6))
def test_pieces_of_slmp(pieces: list[bytes]) -> None:
    stream = slmp.Stream()
    with suppress(slmp.Broken):
        for piece in pieces:
            assert all(request.data in frame for request, frame in stream.feed(piece))
