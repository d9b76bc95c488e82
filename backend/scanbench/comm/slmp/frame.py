"""3E frames: bytes to a request, an answer to bytes. (MELSEC Communication Protocol, SH-080008; PyPI pymcprotocol.)

    0   5000  subheader; that of an answer is D000
    2   u8    network
    3   u8    PC
    4   u16   module I/O
    6   u8    module station
    7   u16   bytes that follow
    9   u16   timer; of an answer the end code
    11  u16   command, u16 subcommand, and their data

Numbers are little endian. In ASCII code each of them is so many hexadecimal digits, the high one first. Which code it is shows
the first byte.
"""

from dataclasses import dataclass
from enum import IntEnum

from scanbench.comm.pieces import Pieces

_REQUEST, _ANSWER = 0x5000, 0xD000
_FIXED = 9
"""Bytes up to the length, that included."""
_LEAST, _MOST = 6, 4096
_ASCII_FIRST = ord("5")
DECIMAL, HEXADECIMAL = b"0123456789", b"0123456789ABCDEFabcdef"
"""Digits of a number in ASCII code."""


class End(IntEnum):
    """End codes. (SH-080008, appendix; those marked own are the nearest that fits.)"""

    OK = 0x0000
    NO_STATION = 0x4B00
    NOT_HEXADECIMAL = 0xC050
    TOO_MANY = 0xC051
    OUTSIDE = 0xC056
    COMMAND = 0xC059
    CANNOT = 0xC05B
    DATA = 0xC05C
    LENGTH = 0xC061
    AWAY = 0xC0B2


class Refused(Exception):
    """The request is answered with this end code."""

    def __init__(self, code: End) -> None:
        super().__init__(code.name)
        self.code = code


class Broken(Exception):
    """What came is no 3E frame: the connection is closed."""


class NoDigits(Broken):
    """A number in ASCII code has a character that is no digit."""


@dataclass(frozen=True, slots=True)
class Request:
    """A request as it came."""

    ascii: bool
    route: tuple[int, int, int, int]
    """Network, PC, module I/O, module station."""
    command: int
    sub: int
    data: bytes
    """What follows; in ASCII code its characters."""


class Cursor:
    """Reads numbers one after the other. `Broken` in a head; commands turn it into an end code."""

    def __init__(self, data: bytes, ascii: bool) -> None:
        self._data, self.ascii = data, ascii
        self._at = 0

    def take(self, size: int) -> bytes:
        """So many bytes."""
        found = self._data[self._at : self._at + size]
        if len(found) != size:
            raise Broken
        self._at += size
        return found

    def number(self, size: int) -> int:
        """A number of so many bytes."""
        if not self.ascii:
            return int.from_bytes(self.take(size), "little")
        return self.digits(2 * size, HEXADECIMAL)

    def digits(self, count: int, allowed: bytes) -> int:
        """A number in ASCII code, `DECIMAL` or `HEXADECIMAL`. `int` alone would take signs, blanks, `_` and `0x`."""
        found = self.take(count)
        if found.strip(allowed):
            raise NoDigits
        return int(found, 10 if allowed == DECIMAL else 16)

    def subheader(self) -> int:
        """The one number that has its high byte first, also in binary code."""
        return self.number(2) if self.ascii else int.from_bytes(self.take(2), "big")

    def rest(self) -> bytes:
        """All that is left."""
        found = self._data[self._at :]
        self._at = len(self._data)
        return found

    @property
    def left(self) -> int:
        """Bytes that were not read."""
        return len(self._data) - self._at


class Stream(Pieces[tuple[Request, bytes]]):
    """The requests of a connection, each with its bytes; `Broken`."""

    def size(self, begun: bytearray) -> int:
        """See `Pieces`."""
        if not begun:
            return 0
        digits = _digits(begun)
        head = _FIXED * digits
        if len(begun) < head:
            return 0
        at = Cursor(bytes(begun[:head]), digits > 1)
        subheader = at.subheader()
        at.take(5 * digits)  # the route
        length = at.number(2)
        if subheader != _REQUEST or not _LEAST * digits <= length <= _MOST * digits:
            raise Broken
        return head + length

    def made(self, frame: bytes) -> tuple[Request, bytes]:
        """See `Pieces`."""
        digits = _digits(frame)
        at = Cursor(frame, digits > 1)
        at.subheader()
        route = (at.number(1), at.number(1), at.number(2), at.number(1))
        at.take(4 * digits)  # length and timer
        return Request(at.ascii, route, at.number(2), at.number(2), at.rest()), frame


def _digits(begun: bytes | bytearray) -> int:
    """Characters of a byte: two in ASCII code."""
    return 2 if begun[0] == _ASCII_FIRST else 1


def number(value: int, size: int, ascii: bool) -> bytes:
    """A number as a frame has it."""
    return f"{value:0{2 * size}X}".encode() if ascii else value.to_bytes(size, "little")


def answer(request: Request, data: bytes) -> bytes:
    """The frame that answers it; `data` in the code of the request."""
    return _frame(request, End.OK, data)


def failure(request: Request, end: End) -> bytes:
    """The frame of an end code: who answers, and to which command."""
    told = _route(request) + number(request.command, 2, request.ascii) + number(request.sub, 2, request.ascii)
    return _frame(request, end, told)


def _frame(request: Request, end: End, data: bytes) -> bytes:
    ascii = request.ascii
    head = f"{_ANSWER:04X}".encode() if ascii else _ANSWER.to_bytes(2, "big")
    told = number(end, 2, ascii) + data
    return head + _route(request) + number(len(told), 2, ascii) + told


def _route(request: Request) -> bytes:
    return b"".join(number(each, size, request.ascii) for each, size in zip(request.route, (1, 1, 2, 1), strict=True))
