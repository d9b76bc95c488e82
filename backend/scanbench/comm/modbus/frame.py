"""Frames of Modbus TCP. (MODBUS Messaging on TCP/IP V1.0b, section 3.1; Application Protocol V1.1b3.)

0  u16  transaction, which comes back
2  u16  protocol, 0
4  u16  bytes that follow
6  u8   unit
7  u8   function, and its data
"""

from dataclasses import dataclass
from enum import IntEnum
from struct import Struct

from scanbench.comm.pieces import Pieces

_HEAD = Struct(">HHHB")
_LEAST, _MOST = 2, 254
"""What a length may be: unit and function at least."""
FAILED = 0x80


class Code(IntEnum):
    """Exceptions."""

    FUNCTION = 0x01
    ADDRESS = 0x02
    VALUE = 0x03
    FAILURE = 0x04
    NO_TARGET = 0x0B


class Refused(Exception):
    """The request is answered with this exception."""

    def __init__(self, code: Code) -> None:
        super().__init__(code.name)
        self.code = code


class Broken(Exception):
    """What came is no Modbus: the connection is closed."""


@dataclass(frozen=True, slots=True)
class Request:
    """A request as it came."""

    transaction: int
    unit: int
    function: int
    data: bytes


class Stream(Pieces[tuple[Request, bytes]]):
    """The requests of a connection, each with its bytes; `Broken`."""

    def size(self, begun: bytearray) -> int:
        """See `Pieces`."""
        if len(begun) < _HEAD.size:
            return 0
        _, protocol, length, _ = _HEAD.unpack_from(begun)
        if protocol or not _LEAST <= length <= _MOST:
            raise Broken
        return _HEAD.size - 1 + int(length)

    def made(self, frame: bytes) -> tuple[Request, bytes]:
        """See `Pieces`."""
        transaction, _, _, unit = _HEAD.unpack_from(frame)
        return Request(transaction, unit, frame[_HEAD.size], frame[_HEAD.size + 1 :]), frame


def answer(request: Request, data: bytes) -> bytes:
    """The frame that answers it."""
    return _frame(request, bytes((request.function,)) + data)


def failure(request: Request, code: Code) -> bytes:
    """The frame of an exception."""
    return _frame(request, bytes((request.function | FAILED, code)))


def _frame(request: Request, pdu: bytes) -> bytes:
    return _HEAD.pack(request.transaction, 0, len(pdu) + 1, request.unit) + pdu
