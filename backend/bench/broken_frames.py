"""Requests of each protocol, and what comes of them when bytes are changed, taken out or added: for `bench comm` and the tests."""

import asyncio
import random
from collections.abc import Iterator, Sequence
from contextlib import suppress

from asyncua import Client
from asyncua.common.utils import Buffer
from asyncua.ua.ua_binary import nodeid_from_binary, nodeid_to_binary

AT_ONCE = 16
"""Requests on one connection: a length that is wrong swallows what comes after it."""
SLMP = [
    bytes.fromhex(each)
    for each in (
        "500000ffff03000c00100001040000640000a80300",  # D100 to D102, in words
        "500000ffff03000d001000010401000000009c010000",
        "500000ffff03000e00100001140000640000a801002a00",
        "500000ffff03000600100001010000",
        "500000ffff030014001000030400000201640000a8650000a8c80000a8",
        "353030303030464630334646303030303138303031303034303130303030442a3030303130303030303031",
    )
]
MODBUS = [
    bytes.fromhex(each)
    for each in (
        "000100000006010300640003", "00020000000601060064002a", "000300000006010100000010", "00040000000601050000ff00",
        "00050000000b0110006400020400010002", "000600000008010f0000000a02cd01", "0007000000080116000400f20025",
        "00080000000f011700030006000e00030600ff00ff00ff", "000900000005012b0e0100",
    )
]  # fmt: skip
FINS = [
    bytes.fromhex("80000200010000190001" + each)
    for each in ("0101820064000003", "0102820064000001002a", "0501", "21020000000a")
]


def fins_over_tcp(frame: bytes) -> bytes:
    """A frame of FINS with the header of TCP."""
    return b"FINS" + (len(frame) + 8).to_bytes(4, "big") + bytes.fromhex("0000000200000000") + frame


def mutated(whole: Sequence[bytes], frames: int, seed: int) -> Iterator[bytes]:
    """Requests with bytes changed, taken out or added."""
    chance = random.Random(seed)
    for _ in range(frames):
        frame = bytearray(chance.choice(whole))
        for _ in range(chance.randrange(1, 5)):
            at = chance.randrange(len(frame) + 1)
            frame[at : at + chance.randrange(3)] = chance.randbytes(chance.randrange(3))
        yield bytes(frame)


async def sent(port: int, frames: Sequence[bytes]) -> bytes:
    """What comes back on a connection of its own, until the server has answered or closed."""
    reader, writer = await asyncio.open_connection("127.0.0.1", port)
    answered = b""
    with suppress(OSError):
        writer.write(b"".join(frames))
        writer.write_eof()
        while piece := await reader.read(1 << 16):
            answered += piece
    await _closed(writer)
    return answered


async def _closed(writer: asyncio.StreamWriter) -> None:
    writer.close()
    with suppress(OSError):
        await writer.wait_closed()


async def messages_of_opcua(port: int) -> list[bytes]:
    """Hello, OpenSecureChannel and requests, as asyncua sends them to the server at this port."""
    messages: list[bytes] = []
    over = asyncio.Event()

    async def pump(reader: asyncio.StreamReader, writer: asyncio.StreamWriter, note: bool) -> None:
        kept = b""
        while data := await reader.read(1 << 16):
            writer.write(data)
            kept += data if note else b""
            while len(kept) >= 8 and len(kept) >= (size := int.from_bytes(kept[4:8], "little")):
                messages.append(kept[:size])
                kept = kept[size:]
        await _closed(writer)

    async def between(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        ours, theirs = await asyncio.open_connection("127.0.0.1", port)
        await asyncio.gather(pump(reader, theirs, True), pump(ours, writer, False))
        over.set()

    listening = await asyncio.start_server(between, "127.0.0.1", 0)
    async with Client(f"opc.tcp://127.0.0.1:{listening.sockets[0].getsockname()[1]}", timeout=60) as client:
        level = client.get_node("ns=2;s=Main.level")
        await level.read_value()
        subscription = await client.create_subscription(100, _Nobody())
        await subscription.subscribe_data_change(level)
    await over.wait()
    listening.close()
    return messages


_REQUEST = 28
"""Where the header of a request begins, with the token of its session."""
_RESPONSE = _REQUEST + 24
"""Where what a response tells begins."""


class _Nobody:
    """Does not care for changes."""

    def datachange_notification(self, node: object, value: object, data: object) -> None:
        pass


async def broken_opcua(port: int, whole: Sequence[bytes], chance: random.Random) -> None:
    """One connection that begins as it should, with a channel and a session of its own, and goes on with broken requests: the first
    that is no message ends it."""
    reader, writer = await asyncio.open_connection("127.0.0.1", port)
    hello, channel, session, *requests = whole
    try:
        await _asked(reader, writer, hello)
        opened = await _asked(reader, writer, channel)
        ids = opened[8:12] + opened[-20:-16]  # the number of the token; after it come its times, and an empty nonce
        made = Buffer(await _asked(reader, writer, _in_channel(session, ids)))
        made.skip(_RESPONSE)
        nodeid_from_binary(made)  # of the session
        token = nodeid_to_binary(nodeid_from_binary(made))
        for number in range(AT_ONCE):
            asked = Buffer(requests[min(number, len(requests) - 1)] if number < 2 else chance.choice(requests))
            old = asked.copy()
            old.skip(_REQUEST)
            nodeid_from_binary(old)
            body = token + old.read(len(old))
            frame = bytearray(_in_channel(asked.read(_REQUEST) + body, ids))
            turn = (number + 3).to_bytes(4, "little")  # those before it had 1 and 2
            frame[4:8], frame[16:20], frame[20:24] = len(frame).to_bytes(4, "little"), turn, turn
            for _ in range(chance.randrange(3) if number else 0):  # the first one activates the session
                frame[chance.randrange(0 if chance.random() < 0.1 else _REQUEST, len(frame))] = chance.randrange(256)
            writer.write(frame)
        writer.write_eof()
        while await reader.read(1 << 16):
            pass
    except (OSError, asyncio.IncompleteReadError):  # it was ended
        pass
    finally:
        await _closed(writer)


async def _asked(reader: asyncio.StreamReader, writer: asyncio.StreamWriter, message: bytes) -> bytes:
    writer.write(message)
    head = await reader.readexactly(8)
    return head + await reader.readexactly(int.from_bytes(head[4:], "little") - 8)


def _in_channel(message: bytes, ids: bytes) -> bytes:
    """With the numbers of the channel that there is now, and of its token."""
    return message[:8] + ids + message[16:]
