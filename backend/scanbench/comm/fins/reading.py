"""A controller by FINS over UDP: words of its memory, again and again. What it is asked is 0104, multiple memory area read, and never a write."""

import asyncio
import re
import socket
import struct
from collections.abc import Sequence
from dataclasses import dataclass
from urllib.parse import urlsplit

from scanbench.comm.controller.contract import MOST, Connection, Found, Unreachable
from scanbench.comm.fins.areas import word_code
from scanbench.comm.fins.ask import Address, Answer, BadAnswer, answer_to, read_places, request, words_of_places

PORT = 9600
ANSWER_S = 2.0
"""So long it may take to answer, each of so many times: a datagram may be lost."""
_TRIES = 3
_READ_PLACES = 0x0104
_AT_ONCE = 160
"""Words in one request: an answer of 3 bytes each fits into the frame of every network."""
_NODE = re.compile(
    r"(?:(?P<name>[^=]+)=)?\s*(?P<area>CIO|[WHAD]|E(?P<bank>[0-9A-F]{1,2})_)\s*(?P<word>\d{1,5})(?:\.(?P<bit>\d{1,2}))?\s*(?::\s*(?P<type>\w+))?",
    re.IGNORECASE,
)
_TYPES = {
    "INT": "<h", "UINT": "<H", "WORD": "<H", "DINT": "<i", "UDINT": "<I", "DWORD": "<I", "REAL": "<f", "LINT": "<q", "ULINT": "<Q",
    "LWORD": "<Q", "LREAL": "<d",
}  # fmt: skip
TYPES = (*_TYPES, "BOOL")
"""What can be read."""


@dataclass(frozen=True, slots=True)
class _Item:
    """A variable: its words, and what they mean."""

    name: str
    places: tuple[tuple[str, int], ...]
    format: str = ""
    bit: int = 0

    def cell(self, words: Sequence[int]) -> str:
        """As a log has it."""
        if not self.format:
            return str(words[0] >> self.bit & 1)
        (value,) = struct.unpack(self.format, struct.pack(f"<{len(words)}H", *words))
        return "" if value != value else str(value)


async def open_fins(connection: Connection) -> "FinsSource":
    """Connects; `Unreachable`."""
    parts = urlsplit(connection.address)
    items = [_item(each) for each in dict.fromkeys(connection.nodes)]
    if not items:
        raise Unreachable(
            "FINS tells no names: say what is read, as D100, D101:INT, CIO 100.03, level=D102:REAL", for_good=True
        )
    loop = asyncio.get_running_loop()
    try:
        transport, asking = await loop.create_datagram_endpoint(
            _Asking, remote_addr=(parts.hostname or "", parts.port or PORT), family=socket.AF_INET
        )
    except OSError as error:
        raise Unreachable(f"{connection.address} cannot be reached: {error.strerror or error}") from error
    return FinsSource(connection, items, transport, asking)


class FinsSource:
    """See `Source`."""

    def __init__(
        self, connection: Connection, items: Sequence[_Item], transport: asyncio.DatagramTransport, asking: "_Asking"
    ) -> None:
        self._connection, self._items, self._transport, self._asking = connection, items, transport, asking
        self._number = 0

    async def find(self) -> Found:
        """See `Source`: each that was named has to be there."""
        names = [each.name for each in self._items]
        if len({each.casefold() for each in names}) < len(names):
            raise Unreachable("two of what is to be read have the same name", for_good=True)
        await self.read(range(min(len(self._items), MOST)))
        left = self._items[MOST:]
        return Found(tuple(names[:MOST]), (f"{len(left):,} more variables",) if left else ())

    async def read(self, wanted: Sequence[int]) -> Sequence[str]:
        """See `Source`."""
        items = [self._items[each] for each in wanted]
        places = list(dict.fromkeys(place for each in items for place in each.places))
        words: dict[tuple[str, int], int] = {}
        for at in range(0, len(places), _AT_ONCE):
            some = places[at : at + _AT_ONCE]
            words |= zip(some, await self._words(some), strict=True)
        return [each.cell([words[place] for place in each.places]) for each in items]

    async def close(self) -> None:
        """See `Source`."""
        self._transport.close()

    async def _words(self, places: Sequence[tuple[str, int]]) -> list[int]:
        answer = await self._asked(read_places(places))
        if answer.end:
            raise Unreachable(
                f"{self._connection.address} refuses to read {places[0][0]}{places[0][1]} and {len(places) - 1} more: end code {answer.end:04X}",
                for_good=True,
            )
        try:
            return words_of_places(answer, places)
        except BadAnswer as error:
            raise Unreachable(f"{self._connection.address}: {error}") from error

    async def _asked(self, body: bytes) -> Answer:
        to, own = (self._transport.get_extra_info(each)[0] for each in ("peername", "sockname"))
        for _ in range(_TRIES):
            self._number = (self._number + 1) % 256
            asked = request(_READ_PLACES, body, _node(to), _node(own), self._number)
            self._asking.answers = asyncio.Queue()
            self._transport.sendto(asked)
            try:
                async with asyncio.timeout(ANSWER_S):
                    return await self._answer(asked)
            except TimeoutError:
                continue
            except OSError as error:
                raise Unreachable(f"{self._connection.address} cannot be reached: {error.strerror or error}") from error
        raise Unreachable(f"{self._connection.address} does not answer by FINS over UDP within {ANSWER_S:g} s")

    async def _answer(self, asked: bytes) -> Answer:
        while True:
            frame = await self._asking.answers.get()
            if isinstance(frame, Exception):
                raise frame
            try:
                return answer_to(asked, frame)
            except BadAnswer:  # to a question whose time was over
                continue


class _Asking(asyncio.DatagramProtocol):
    def __init__(self) -> None:
        self.answers: asyncio.Queue[bytes | Exception] = asyncio.Queue()

    def datagram_received(self, data: bytes, addr: tuple[str, int]) -> None:
        self.answers.put_nowait(data)

    def error_received(self, exc: Exception) -> None:
        self.answers.put_nowait(exc)


def _node(host: str) -> Address:
    """By the last number of an IP address, which is what makes nodes of addresses unless somebody sets a unit otherwise."""
    return Address(node=int(host.rpartition(".")[2]))


def _item(text: str) -> _Item:
    match = _NODE.fullmatch(text.strip())
    type = "" if match is None else (match["type"] or ("WORD" if match["bit"] is None else "BOOL")).upper()
    if match is None or type not in TYPES or (match["bit"] is None) != (type != "BOOL") or int(match["bit"] or 0) > 15:
        raise Unreachable(
            f"`{text}` is nothing that is read by FINS: write D100, D101:INT, CIO 100.03, level=D102:REAL; types are {', '.join(_TYPES)}",
            for_good=True,
        )
    area = f"E{int(match['bank'], 16):X}" if match["bank"] else match["area"].upper()
    if word_code(area) is None:
        raise Unreachable(f"`{text}`: FINS has no area {area}", for_good=True)
    name = (match["name"] or text).strip()
    format = "" if type == "BOOL" else _TYPES[type]
    count = struct.calcsize(format) // 2 if format else 1
    places = tuple((area, int(match["word"]) + at) for at in range(count))
    if places[-1][1] > 0xFFFF:
        raise Unreachable(f"`{text}`: FINS has no word {places[-1][1]:,}", for_good=True)
    return _Item(name, places, format, int(match["bit"] or 0))
