"""One block of a run file: how its head is packed and read, in each format that there was. `format.py` has the layout."""

import zlib
from dataclasses import dataclass
from enum import IntEnum
from struct import Struct

FORMAT = 3
NUMBERED = 2
"""Since this format a block says how many entries were before it, and a delta to which keyframe it belongs."""
BRIEF = 3
"""Since this format an entry that repeats one before it, but for its values, is a short block."""
SYNC = b"\xf5RB\n"
PACKED = 1
SHORT = 2
"""The packing of a short block: what it holds is read together with the entry of its slot."""
SLOTS = 255
"""Entries that short blocks may repeat at a time."""
_NUMBERED = Struct("<4sBBHIQQII")
_HEADS = {1: Struct("<4sBBHIQI"), 2: _NUMBERED, 3: _NUMBERED}
_CRC = Struct("<I")
_SHORT = Struct("<BBBHI")
_SHORT_SYNC = 0xF6
_SEEDED = Struct("<QQ")


class Kind(IntEnum):
    """What a block holds."""

    ABOUT = 1
    PROGRAM = 2
    ENTRY = 3
    KEYFRAME = 4
    DELTA = 5
    MARK = 6


@dataclass(frozen=True, slots=True)
class Block:
    """Where a block lies in the file."""

    kind: Kind
    scan: int
    offset: int
    length: int
    """Of the stored payload."""
    packing: int
    head: int
    """Bytes before the payload."""
    entries: int
    """So many entries were made before it since the run began, those among them that are not in the file any more; 0 in format 1."""
    base: int
    """Of a delta: `crc` of the keyframe that it belongs to; else, and in format 1, 0."""
    crc: int
    slot: int = 0
    """Of an entry: short blocks after it repeat it by this number, if it is not 0. Of a short block: which one it repeats."""

    @property
    def payload_offset(self) -> int:
        """Where the payload begins."""
        return self.offset + self.head

    @property
    def end(self) -> int:
        """Where the next block begins."""
        return self.offset + self.head + self.length

    @property
    def size(self) -> int:
        """Bytes in the file."""
        return self.head + self.length

    @property
    def entries_after(self) -> int:
        """So many entries were made when it was there."""
        return self.entries + (self.kind is Kind.ENTRY)


@dataclass(frozen=True, slots=True)
class Head:
    """The fields of a head, whatever is in them."""

    sync: bytes
    kind: int
    packing: int
    reserved: int
    length: int
    scan: int
    entries: int
    base: int
    crc: int

    @property
    def known(self) -> bool:
        """Whether a block of a kind that this version knows can begin with it."""
        known = Kind.ABOUT <= self.kind <= Kind.MARK and self.packing <= PACKED
        return self.sync == SYNC and known and self.reserved <= (SLOTS if self.kind == Kind.ENTRY else 0)


@dataclass(frozen=True, slots=True)
class Place:
    """What a short block is counted on from: how many entries were made before it, and the scan of the last of them; None where
    that is not known."""

    entries: int
    scan: int | None = None

    def after(self, block: Block) -> "Place":
        """The place after this block."""
        return Place(block.entries_after, block.scan if block.kind is Kind.ENTRY else self.scan)


def head_size(format: int) -> int:
    """Bytes of a head."""
    return _HEADS[format].size


def read_head(format: int, data: bytes) -> Head | None:
    """The fields of a head; None where there are too few bytes."""
    if len(data) < head_size(format):
        return None
    sync, kind, packing, reserved, length, scan, *more, crc = _HEADS[format].unpack(data)
    entries, base = more or (0, 0)
    return Head(sync, kind, packing, reserved, length, scan, entries, base, crc)


def pack_head(format: int, head: Head) -> bytes:
    """The bytes of these fields."""
    more = (head.entries, head.base) if format >= NUMBERED else ()
    return _HEADS[format].pack(
        head.sync, head.kind, head.packing, head.reserved, head.length, head.scan, *more, head.crc
    )  # fmt: skip


NOWHERE = Place(0)
"""Where no short block can be read."""


def decode(format: int, data: bytes, offset: int, place: Place = NOWHERE) -> Block | None:
    """The block that begins with these bytes, or None where none can begin. Its checksum is not looked at."""
    if is_short(format, data):
        return _decode_short(data, offset, place)
    head = read_head(format, data)
    if head is None or not head.known:
        return None
    return Block(
        Kind(head.kind), head.scan, offset, head.length, head.packing, head_size(format), head.entries, head.base, head.crc,
        head.reserved,
    )  # fmt: skip


def is_short(format: int, data: bytes) -> bool:
    """Whether a short block begins with these bytes, if any block does."""
    return format >= BRIEF and data[:1] == bytes((_SHORT_SYNC,))


def _decode_short(data: bytes, offset: int, place: Place) -> Block | None:
    if len(data) < _SHORT.size or data[0] != _SHORT_SYNC or place.scan is None:
        return None
    _, slot, length, scans, crc = _SHORT.unpack_from(data)
    if not slot:
        return None
    return Block(
        Kind.ENTRY, place.scan + scans, offset, length, SHORT, _SHORT.size, place.entries, 0, crc, slot
    )  # fmt: skip


def encode_short(slot: int, scan: int, place: Place, payload: bytes) -> tuple[bytes, int] | None:
    """The bytes of a short block, and its checksum; None where it cannot be one."""
    scans = scan - place.scan if place.scan is not None else -1
    if not 0 <= scans < 1 << 16 or len(payload) > 255:
        return None
    head = _SHORT.pack(_SHORT_SYNC, slot, len(payload), scans, 0)[: -_CRC.size]
    crc = zlib.crc32(payload, short_checksum_begun(head, place.entries, scan))
    return head + _CRC.pack(crc) + payload, crc


def short_checksum_begun(head: bytes, entries: int, scan: int) -> int:
    """Of a short block, before the payload was added: what it is counted on from belongs to it. `head`: without the checksum."""
    return zlib.crc32(head[: _SHORT.size - _CRC.size], zlib.crc32(_SEEDED.pack(entries, scan)))


def checksum(head: bytes, payload: bytes) -> int:
    """Of a block, with all bytes of its head."""
    return zlib.crc32(payload, checksum_begun(head))


def checksum_begun(head: bytes) -> int:
    """The same, before the payload was added."""
    return zlib.crc32(head[: -_CRC.size])


def encode(
    format: int, kind: Kind, packing: int, scan: int, entries: int, base: int, payload: bytes, slot: int = 0
) -> tuple[bytes, int]:
    """The bytes of a block, and its checksum."""
    head = Head(SYNC, kind, packing, slot, len(payload), scan, entries, base, 0)
    packed = pack_head(format, head)
    crc = checksum(packed, payload)
    return packed[: -_CRC.size] + _CRC.pack(crc) + payload, crc
