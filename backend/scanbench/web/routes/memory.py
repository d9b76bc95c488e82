"""REST: the memory of a PLC, area by area."""

from typing import Annotated, Literal

from fastapi import APIRouter, Query

from scanbench.web.messages_base import Id
from scanbench.web.messages_values import MemoryPlace, MemoryWord, WordsFound
from scanbench.web.reach import Bench
from scanbench.wire import memory
from scanbench.wire.refused import Refused

router = APIRouter(prefix="/api/instances/{instance}/memory", tags=["values"])
_MOST_WORDS = 1000
_MOST_FOUND = 200
_FIRST = Annotated[int, Query(ge=0, lt=1 << 31, description="number of a word within the area, 0 is its first")]


@router.get("")
async def on_place(bench: Bench, instance: Id, path: Annotated[str, Query(max_length=2000)]) -> MemoryPlace:
    """The word of memory in which an address, or a variable that has one, lies."""
    found = await bench.session(instance).instance.ask(lambda ref: memory.WantPlace(ref, path), memory.PlaceIs)
    if found.message:
        raise Refused(found.message, found.near)
    return MemoryPlace(area=found.area, word=found.word)


@router.get("/{area}/words")
async def on_words(
    bench: Bench, instance: Id, area: str, first: _FIRST = 0, count: Annotated[int, Query(ge=1, le=_MOST_WORDS)] = 100
) -> list[MemoryWord]:
    """What the words of a memory area are called, and the variables of the running program that lie in them."""
    session = bench.session(instance)
    found = await session.instance.ask(lambda ref: memory.WantWords(ref, area, first, count), memory.WordsAre)
    if found.message:
        raise Refused(found.message)
    return [MemoryWord(address=each.address, symbols=list(each.symbols)) for each in found.words]


@router.get("/{area}/find")
async def on_find(
    bench: Bench, instance: Id, area: str, value: Annotated[int, Query(ge=-(1 << 63), lt=1 << 64)],
    bits: Literal["16", "32", "64"] = "16", first: _FIRST = 0,
) -> WordsFound:  # fmt: skip
    """The words of a memory area at which a number of so many bits begins, its low word first; at most 200 at once."""
    width = int(bits)
    if not -(1 << (width - 1)) <= value < 1 << width:
        raise Refused(f"{value} does not fit into {bits} bits. Look for it in more bits")
    pattern = (value % (1 << width)).to_bytes(width // 8, "little")
    session = bench.session(instance)
    found = await session.instance.ask(
        lambda ref: memory.FindWords(ref, area, pattern, first, _MOST_FOUND), memory.WordsFound
    )
    if found.message:
        raise Refused(found.message)
    return WordsFound(scan=found.scan, words=list(found.words), more=len(found.words) == _MOST_FOUND)
