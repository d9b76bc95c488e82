"""Entries that repeat one before them but for their time and values, in few bytes: a client writes the same places for weeks.

A brief entry is, with numbers in groups of seven bits, the lowest first, and a sign in their lowest bit:

    number   microseconds since the entry that it repeats
    bytes    the data of each write, as long as there
    of variables only, the sentence for people:
    number   bytes of it that are the same at its beginning
    number   bytes that follow, and those bytes
    then, until its end, what it changed:
    number   offset in the image, from that of the first patch of the entry that it repeats
    number   bytes, and in the lowest bit whether all bits of them change
    bytes    the mask, where not all bits change
    bytes    the data

The sentence of a write into areas is that of the entry that it repeats, with other values. Whatever does not come out the same when it is read is
no brief entry.
"""

from collections.abc import Hashable, Sequence
from dataclasses import replace
from datetime import timedelta
from typing import TypeVar

from scanbench.recording.block import SHORT, SLOTS, Block
from scanbench.runtime.command import Entry, Patch
from scanbench.runtime.write_areas import AreaWrite, WriteAreas
from scanbench.runtime.write_variables import VariableWrite, WriteVariables

W = TypeVar("W", AreaWrite, VariableWrite)
_MICROSECOND = timedelta(microseconds=1)
_WORD = ":= 16#"
_LEVELS = (":= FALSE", ":= TRUE")


class Slots:
    """The entries that others may repeat: on the side that writes them, and on the side that reads."""

    def __init__(self) -> None:
        self._entries: dict[int, Entry] = {}
        self._slots: dict[Hashable, int] = {}

    def clear(self) -> None:
        """After a state, so that no entry before it is needed to read those after it; and where entries are lost."""
        self._entries.clear()
        self._slots.clear()

    def brief(self, entry: Entry) -> tuple[int, bytes] | None:
        """The slot of the entry that this one repeats, and what is left of it."""
        key = _key(entry)
        slot = self._slots.get(key, 0) if key is not None else 0
        if not slot:
            return None
        like = self._entries[slot]
        made = _packed(entry, like)
        try:
            same = _unpacked(made, like, entry.scan) == entry
        except (ValueError, IndexError):
            return None
        return (slot, made) if same else None

    def take(self, entry: Entry) -> int:
        """The slot by which entries after this one may repeat it; 0 where none is to."""
        key = _key(entry)
        if key is None:
            return 0
        slot = self._slots.get(key, len(self._slots) + 1)
        if slot <= SLOTS:
            self._slots[key] = slot
            self.put(slot, entry)
            return slot
        return 0

    def put(self, slot: int, entry: Entry) -> None:
        """The entry of a slot, as it was read."""
        self._entries[slot] = entry

    def read(self, block: Block, data: bytes) -> Entry | None:
        """The entry of a short block; None where the one that it repeats is not known. `ValueError`."""
        like = self._entries.get(block.slot)
        return _unpacked(data, like, block.scan) if like is not None else None


def is_brief(block: Block) -> bool:
    """Whether an entry is read together with the one of its slot."""
    return block.packing == SHORT


def _key(entry: Entry) -> Hashable:
    """What is the same in entries that repeat one another; None of an entry that cannot be brief."""
    command, plan = entry.command, entry.plan
    if not isinstance(command, WriteAreas | WriteVariables) or plan.effect is not None or not plan.patches:
        return None
    return command.author, tuple((replace(each, data=b""), len(each.data)) for each in command.writes)


def _writes(entry: Entry) -> Sequence[AreaWrite | VariableWrite]:
    assert isinstance(entry.command, WriteAreas | WriteVariables)
    return entry.command.writes


def _packed(entry: Entry, like: Entry) -> bytes:
    parts = [_number((entry.at - like.at) // _MICROSECOND), *(each.data for each in _writes(entry))]
    if isinstance(entry.command, WriteVariables):
        said, before = entry.plan.message.encode(), like.plan.message.encode()
        same = next(
            (at for at, pair in enumerate(zip(said, before, strict=False)) if pair[0] != pair[1]),
            min(len(said), len(before)),
        )
        parts += (_unsigned(same), _unsigned(len(said) - same), said[same:])
    base = like.plan.patches[0].offset
    for patch in entry.plan.patches:
        whole = patch.mask.count(0xFF) == len(patch.mask)
        parts += (_number(patch.offset - base), _unsigned(len(patch.data) << 1 | whole))
        parts += (patch.data,) if whole else (patch.mask, patch.data)
    return b"".join(parts)


class _Bytes:
    """Of a brief entry, taken one after the other. `ValueError` where there are no more."""

    def __init__(self, data: bytes) -> None:
        self._data, self._at = data, 0

    @property
    def more(self) -> bool:
        """Whether any are left."""
        return self._at < len(self._data)

    def take(self, count: int) -> bytes:
        """The next ones."""
        self._at += count
        if self._at > len(self._data):
            raise ValueError("it is cut off")
        return self._data[self._at - count : self._at]

    def unsigned(self) -> int:
        """The next number, without a sign."""
        value = 0
        for shift in range(0, 63, 7):
            (each,) = self.take(1)
            value |= (each & 0x7F) << shift
            if each < 0x80:
                return value
        raise ValueError("a number is too long")

    def number(self) -> int:
        """The next number."""
        value = self.unsigned()
        return ~(value >> 1) if value & 1 else value >> 1

    def datas(self, writes: Sequence[AreaWrite | VariableWrite]) -> list[bytes]:
        """As many bytes as each of these writes has."""
        return [self.take(len(each.data)) for each in writes]


def _unpacked(data: bytes, like: Entry, scan: int) -> Entry:
    left, command, said = _Bytes(data), like.command, like.plan.message
    when = like.at + left.number() * _MICROSECOND
    if isinstance(command, WriteVariables):
        values = left.datas(command.writes)
        command = replace(command, writes=tuple(map(_with, command.writes, values)))
        said = (said.encode()[: left.unsigned()] + left.take(left.unsigned())).decode()
    else:
        assert isinstance(command, WriteAreas)
        values = left.datas(command.writes)
        command = replace(command, writes=tuple(map(_with, command.writes, values)))
        said = _said(said, command.writes)
    patches, base = list[Patch](), like.plan.patches[0].offset
    while left.more:
        offset, size = base + left.number(), left.unsigned()
        mask = b"\xff" * (size >> 1) if size & 1 else left.take(size >> 1)
        patches.append(Patch(offset, mask, left.take(size >> 1)))
    return Entry(scan, when, command, replace(like.plan, patches=tuple(patches), message=said))


def _with(write: W, data: bytes) -> W:
    return replace(write, data=data)


def _said(text: str, writes: Sequence[AreaWrite]) -> str:
    """The sentence of the entry that is repeated, with these values (`runtime.write_areas.said`)."""
    parts = text.split("; ")
    for index, write in enumerate(writes[: len(parts)]):
        part = parts[index]
        if write.bit is not None and part.endswith(_LEVELS):
            parts[index] = part[: part.rindex(":=")] + _LEVELS[write.data[0] != 0]
        elif _WORD in part:
            parts[index] = part[: part.rindex(_WORD)] + f"{_WORD}{int.from_bytes(write.data, 'little'):04X}"
    return "; ".join(parts)


def _number(value: int) -> bytes:
    return _unsigned(value << 1 if value >= 0 else ~value << 1 | 1)


def _unsigned(value: int) -> bytes:
    made = bytearray()
    while value > 0x7F:
        made.append(value & 0x7F | 0x80)
        value >>= 7
    made.append(value)
    return bytes(made)
