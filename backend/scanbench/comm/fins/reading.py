"""A controller by FINS over UDP or TCP: words of its memory, again and again. What it is asked is 0104, multiple memory area read, and never a write."""

import asyncio
import re
import struct
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from urllib.parse import urlsplit

from scanbench.comm.controller.contract import MOST, Connection, Found, Unreachable
from scanbench.comm.fins.areas import word_code
from scanbench.comm.fins.ask import Answer, BadAnswer, answer_to, read_places, request, words_of_places
from scanbench.comm.fins.line import Line, open_line

PORT = 9600
ANSWER_S = 2.0
"""So long it may take to answer, each time that it is asked."""
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
_Place = tuple[str, int]
"""An area and a word of it."""
TYPES = (*_TYPES, "BOOL")
"""What can be read."""


@dataclass(frozen=True, slots=True)
class _Item:
    """A variable: its words, and what they mean."""

    name: str
    places: tuple[_Place, ...]
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
    try:
        async with asyncio.timeout(ANSWER_S):
            line = await open_line(parts.hostname or "", parts.port or PORT, connection.protocol == "fins+tcp")
    except TimeoutError:
        raise Unreachable(f"{connection.address} does not answer by FINS within {ANSWER_S:g} s") from None
    except (OSError, BadAnswer) as error:
        raise Unreachable(f"{connection.address} cannot be reached: {_words(error)}") from error
    return FinsSource(connection, items, line)


def _words(error: Exception) -> str:
    return (error.strerror if isinstance(error, OSError) else "") or str(error)


class FinsSource:
    """See `Source`."""

    def __init__(self, connection: Connection, items: Sequence[_Item], line: Line) -> None:
        self._connection, self._items, self._line = connection, items, line
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
        cells: list[str] = []
        for items, places in _requests([self._items[each] for each in wanted]):
            words = dict(zip(places, await self._words(places), strict=True))
            cells += (each.cell([words[place] for place in each.places]) for each in items)
        return cells

    async def close(self) -> None:
        """See `Source`."""
        self._line.close()

    async def _words(self, places: Sequence[_Place]) -> list[int]:
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
        line = self._line
        for _ in range(line.tries):
            self._number = (self._number + 1) % 256
            asked = request(_READ_PLACES, body, line.server, line.client, self._number)
            line.send(asked)
            try:
                async with asyncio.timeout(ANSWER_S):
                    return await self._answer(asked)
            except TimeoutError:
                continue
            except (OSError, BadAnswer) as error:
                raise Unreachable(f"{self._connection.address} cannot be reached: {_words(error)}") from error
        raise Unreachable(f"{self._connection.address} does not answer by FINS over {line.name} within {ANSWER_S:g} s")

    async def _answer(self, asked: bytes) -> Answer:
        while True:
            frame = await self._line.answers.get()
            if isinstance(frame, Exception):
                raise frame
            try:
                return answer_to(asked, frame)
            except BadAnswer:  # to a question whose time was over
                continue


def _requests(items: Iterable[_Item]) -> Iterator[tuple[list[_Item], list[_Place]]]:
    """What is asked at once, with its words: all words of an item in one request, as two are answered in different scans."""
    some: list[_Item] = []
    places: dict[_Place, None] = {}
    for each in items:
        more = places | dict.fromkeys(each.places)
        if len(more) > _AT_ONCE:
            yield some, list(places)
            some, more = [], dict.fromkeys(each.places)
        some.append(each)
        places = more
    if some:
        yield some, list(places)


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
