"""Memory areas over FINS: 0101 read, 0102 write, 0103 fill, 0104 multiple read, 0105 transfer."""

from collections.abc import Sequence

from scanbench.comm.door import Door
from scanbench.comm.fins.areas import Element, Form, element, swapped
from scanbench.comm.fins.codes import End, Refused
from scanbench.comm.fins.frame import HEAD, LARGEST
from scanbench.comm.fins.outcome import enter
from scanbench.runtime.copy_areas import CopyAreas
from scanbench.runtime.write_areas import AreaWrite, WriteAreas

_MOST_READ, _MOST_WRITTEN = 999, 996
"""Words of a request. (W342, section 5-3-2.)"""
_PLACE = 4
"""Bytes of an area code and an address."""
_MOST_ANSWERED = LARGEST - HEAD - 2


async def on_read(door: Door, body: bytes) -> bytes:
    """Elements that follow each other."""
    first, count = _first_and_count(door, body)
    _exactly(body, 6)
    if first.form in (Form.FORCED_BIT, Form.FORCED_WORD):
        raise Refused(End.NO_AREA)
    if count * first.size > 2 * _MOST_READ:
        raise Refused(End.ANSWER_TOO_LONG)
    if not count:
        return b""
    read = await door.read(first.spans(count))
    return first.encode(read.data, count)


async def on_write(door: Door, body: bytes) -> bytes:
    """Elements that follow each other."""
    first, count = _first_and_count(door, body)
    data = body[6:]
    if len(data) != count * first.size:
        raise Refused(End.NOT_AS_MANY)
    if count > _MOST_WRITTEN and first.form is not Form.BIT:
        raise Refused(End.TOO_LONG)
    await _write(door, first, count, data)
    return b""


async def on_fill(door: Door, body: bytes) -> bytes:
    """One word into many."""
    first, count = _first_and_count(door, body)
    _exactly(body, 8)
    if first.form is not Form.WORD:
        raise Refused(End.NO_AREA)
    await _write(door, first, count, body[6:8] * count)
    return b""


async def on_multiple_read(door: Door, body: bytes) -> bytes:
    """Elements from here and there, all of one scan."""
    if not body or len(body) % _PLACE:
        raise Refused(End.TOO_SHORT)
    places = [body[at : at + _PLACE] for at in range(0, len(body), _PLACE)]
    elements = [_element(door, place) for place in places]
    if sum(1 + each.size for each in elements) > _MOST_ANSWERED:
        raise Refused(End.ANSWER_TOO_LONG)
    spans = [each.spans(1) for each in elements]
    read = await door.read([span for several in spans for span in several])
    answer, at = bytearray(), 0
    for place, each, several in zip(places, elements, spans, strict=True):
        answer += place[:1] + each.encode(read.data[at : at + len(several)], 1)
        at += len(several)
    return bytes(answer)


async def on_transfer(door: Door, body: bytes) -> bytes:
    """Words from one place to a second one, all of it in one seam."""
    _exactly(body, 10)
    source, target = _element(door, body[:4]), _element(door, body[4:8])
    count = int.from_bytes(body[8:10], "big")
    if source.form is not Form.WORD or target.form is not Form.WORD:
        raise Refused(End.NO_AREA)
    if count > _MOST_READ:
        raise Refused(End.TOO_LONG)
    if count:
        area, spans = _writable(target, count), source.spans(count)
        if not spans:  # what no program here has reads 0
            await _write(door, target, count, source.encode((), count))
            return b""
        (span,) = spans
        door.noted(spans)
        await enter(door, CopyAreas(door.author, span.area, span.byte, area, 2 * target.word, span.size))
    return b""


async def _write(door: Door, first: Element, count: int, data: bytes) -> None:
    if not count:
        return
    area = _writable(first, count)
    writes: Sequence[AreaWrite]
    if first.form is Form.WORD:
        writes = (AreaWrite(area, 2 * first.word, swapped(data)),)
    else:
        writes = tuple(
            AreaWrite(area, 2 * first.word + at // 8, bytes((value & 1,)), at % 8)
            for at, value in enumerate(data, first.bit)
        )
    await enter(door, WriteAreas(door.author, tuple(writes)))


def _writable(first: Element, count: int) -> str:
    """The area that so many elements may be written to; `Refused`."""
    if first.form not in (Form.BIT, Form.WORD) or first.area is None:
        raise Refused(End.READ_ONLY if first.form is Form.UNUSED else End.NO_AREA)
    (span,) = first.spans(count)
    if first.area.protected(span.byte, span.size, "tool") is not None:
        raise Refused(End.READ_ONLY)
    return first.area.name


def _first_and_count(door: Door, body: bytes) -> tuple[Element, int]:
    if len(body) < _PLACE + 2:
        raise Refused(End.TOO_SHORT)
    return _element(door, body[:_PLACE]), int.from_bytes(body[_PLACE : _PLACE + 2], "big")


def _element(door: Door, place: bytes) -> Element:
    return element(door.model, place[0], int.from_bytes(place[1:3], "big"), place[3])


def _exactly(body: bytes, size: int) -> None:
    if len(body) != size:
        raise Refused(End.TOO_SHORT if len(body) < size else End.TOO_LONG)
