"""The other side of Modbus TCP: requests as a client sends them, and what their answers say. No socket. (Application Protocol V1.1b3.)"""

from collections.abc import Mapping
from types import MappingProxyType

from scanbench.comm.modbus.frame import FAILED, Request, answer
from scanbench.comm.modbus.mapping import Group

MOST_BITS, MOST_WORDS, MOST_BITS_WRITTEN, MOST_WORDS_WRITTEN = 2000, 125, 1968, 123
"""Of one request."""
READS: Mapping[Group, int] = MappingProxyType({
    "coil": 1, "discrete input": 2, "holding register": 3, "input register": 4,
})  # fmt: skip
"""The function that reads each group."""
WRITES: Mapping[Group, int] = MappingProxyType({"coil": 15, "holding register": 16})
_EXCEPTIONS: Mapping[int, str] = MappingProxyType({
    1: "it does not know this function", 2: "it has no such address", 3: "a count or a length is wrong",
    4: "it cannot do that now", 6: "it is busy", 10: "no way to this unit", 11: "no unit of this number answers",
})  # fmt: skip


class BadAnswer(Exception):
    """What came does not answer what was asked, or refuses it: the message says why."""


def is_bits(group: Group) -> bool:
    """Whether these are bits; else they are words."""
    return group in ("coil", "discrete input")


def read(transaction: int, unit: int, group: Group, first: int, count: int) -> tuple[Request, bytes]:
    """The request that reads so many, and its frame."""
    return _made(transaction, unit, READS[group], _two(first, count))


def write(transaction: int, unit: int, group: Group, first: int, count: int, data: bytes) -> tuple[Request, bytes]:
    """The request that writes so many, and its frame. `data`: bits from bit 0 of the first byte on, or words with the high byte
    first."""
    return _made(transaction, unit, WRITES[group], _two(first, count) + bytes((len(data),)) + data)


def data_of(request: Request, came: Request, bits: bool) -> bytes:
    """What the answer to a read gives: bits from bit 0 of the first byte on, or words with the high byte first. `BadAnswer`."""
    _check(request, came)
    count = int.from_bytes(request.data[2:4], "big")
    size = (count + 7) // 8 if bits else 2 * count
    if len(came.data) != 1 + size or came.data[0] != size:
        raise BadAnswer(f"{max(0, len(came.data) - 1)} bytes came where {size} were asked for")
    return came.data[1:]


def check_written(request: Request, came: Request) -> None:
    """`BadAnswer` where it was not written."""
    _check(request, came)
    if came.data != request.data[:4]:
        raise BadAnswer("it answers a different request")


def _check(request: Request, came: Request) -> None:
    if came.transaction != request.transaction or came.function & ~FAILED != request.function:
        raise BadAnswer("it answers a different request")
    if came.function & FAILED:
        code = came.data[0] if came.data else 0
        raise BadAnswer(f"exception {code:02X}: {_EXCEPTIONS.get(code, 'the code is unknown')}")


def _made(transaction: int, unit: int, function: int, data: bytes) -> tuple[Request, bytes]:
    request = Request(transaction, unit, function, data)
    return request, answer(request, data)


def _two(first: int, count: int) -> bytes:
    return first.to_bytes(2, "big") + count.to_bytes(2, "big")
