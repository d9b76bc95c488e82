"""The bytes of a run file: blocks with checksums, one after the other. What they mean is `blocks.py`'s.

    0   14 bytes  "scanbench run\\n"
    14  u16       format version, 3
    16  blocks

A block, little endian:

    0   4 bytes   F5 'R' 'B' 0A, so that the next good block is found after damage
    4   u8        kind, see `Kind`
    5   u8        packing of the payload: 0 as it is, 1 Zstandard
    6   u16       of an entry that short blocks may repeat: its slot, 1 to 255; else 0
    8   u32       bytes of the payload as stored
    12  u64       scan that the block belongs to
    20  u64       entries that were made before it since the run began: whether one is missing is seen from that
    28  u32       of a delta: the CRC-32 of the keyframe that it belongs to; else 0
    32  u32       CRC-32 of bytes 0 to 31 and the payload
    36  payload

An entry that repeats the one of a slot but for its time and values (`alike.py`) is a short block:

    0   u8        F6
    1   u8        slot
    2   u8        bytes of the payload
    3   u16       scans since the entry before it
    5   u32       CRC-32 of two u64 (the entries that were made before it, its scan), bytes 0 to 4 and the payload
    9   payload

It is not searched for after damage: it can be read if all is there from the entry of its slot on, which is after the last state.
Format 2 had no short blocks and no slots. In format 1 the two fields before the CRC-32 were missing: the head had 24 bytes. A file of format 1 is read, and gone on with in
format 1; it ends at its first bad block, as nobody can tell what is missing there.

Blocks are only ever appended, but for one: a mark without a payload (the last known scan) at the very end is overwritten by
what comes next. So a write that did not come to its end costs the block that was written, and nothing before it.
"""

import os
import zlib
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from struct import Struct

import zstandard

from scanbench.recording.block import (
    FORMAT,
    PACKED,
    SHORT,
    SYNC,
    Block,
    Head,
    Kind,
    Place,
    checksum_begun,
    decode,
    encode,
    encode_short,
    head_size,
    is_short,
    pack_head,
    read_head,
    short_checksum_begun,
)

__all__ = ["FORMAT", "LARGEST", "Block", "Damage", "Damaged", "Kind", "RunFile", "RunFileError", "is_run_file"]

_MAGIC = b"scanbench run\n"
_HEAD = Struct("<14sH")
_WORTH_PACKING = 200
_CHUNK = 1 << 20
LARGEST = 1 << 26
"""Bytes of a payload once unpacked, where nobody knows better: a file from elsewhere must not fill the memory."""
_SEARCH = 1 << 28
"""Bytes that are looked at for blocks after damage, where there are none, ..."""
_LOOK = 1 << 12
"""... where each place that might be one counts at least so much."""
_MOST_AFTER = 1 << 20
"""Blocks after damage that are taken at most."""


class RunFileError(Exception):
    """This run file cannot be used; the message says why, and what to do."""


class Damaged(RunFileError):
    """It is damaged where all begins, so that nothing can be recovered."""


@dataclass(frozen=True, slots=True)
class Damage:
    """Where the good blocks end."""

    offset: int
    torn: bool
    """The file ends inside this block: its writer was ended while writing it."""
    after: tuple[Block, ...] = ()
    """The good blocks after it, as far as they are found with reasonable trouble."""


@dataclass(frozen=True, slots=True)
class Mended:
    """The good blocks of a damaged file, in order."""

    blocks: tuple[Block, ...]
    end: int
    """The byte after the last of them; from there on the file is good."""
    unread: frozenset[int] = frozenset()
    """Where those begin that cannot be understood, as what they repeat is lost: they are never written again."""

    def holes(self) -> list[int]:
        """Where bytes begin that belong to no block."""
        found, at = list[int](), _HEAD.size
        for block in sorted(self.blocks, key=lambda each: each.offset):
            if block.offset > at:
                found.append(at)
            at = block.end
        return [*found, at] if self.end > at else found


class RunFile:
    """A run file open for reading, or for reading and appending.

    One thread appends. Others may read before an `end` that they were told.
    """

    def __init__(self, path: Path, fd: int, format: int = FORMAT) -> None:
        self.path, self.fd, self.format = path, fd, format
        self.end = _HEAD.size
        """After the last block that is no trailing mark."""
        self._upto = self.end
        """After the last block."""
        self.place = Place(0)
        """How many entries were made since the run began: the number that the next block gets; and the scan of the last."""
        self.damage: Damage | None = None
        """What `scan_blocks` came upon."""
        self.mended: Mended | None = None
        """Its blocks, where there is damage between them."""
        self.marked: int | None = None
        """The scan of the mark at its end, which every writer that comes to its end leaves there; None where there is none."""
        self._packer = zstandard.ZstdCompressor(level=1)

    @classmethod
    def create(cls, path: Path, format: int = FORMAT) -> "RunFile":
        """A new file with no blocks; `FileExistsError` if there is one."""
        fd = os.open(path, os.O_RDWR | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, 0o644)
        try:
            _write(fd, _HEAD.pack(_MAGIC, format), 0)
        except OSError:
            os.close(fd)
            path.unlink()
            raise
        return cls(path, fd, format)

    @classmethod
    def open(cls, path: Path, read_only: bool = False) -> "RunFile":
        """An existing file. Nothing is read but its first bytes: see `scan_blocks`."""
        fd = os.open(path, (os.O_RDONLY if read_only else os.O_RDWR) | os.O_CLOEXEC)
        try:
            format = _format_of(path, os.pread(fd, _HEAD.size, 0))
        except RunFileError:
            os.close(fd)
            raise
        return cls(path, fd, format)

    def close(self) -> None:
        """Closes the file."""
        os.close(self.fd)

    @property
    def entries(self) -> int:
        """So many entries were made since the run began."""
        return self.place.entries

    def append(self, kind: Kind, scan: int, payload: bytes, base: int = 0, slot: int = 0) -> Block:
        """Writes a block after all others; `base`: the checksum of the keyframe that a delta belongs to; `slot`: see above. On
        `OSError` the file is as it was."""
        packing = 0
        if len(payload) >= _WORTH_PACKING:
            payload, packing = self._packer.compress(payload), PACKED
        data, crc = encode(self.format, kind, packing, scan, self.entries, base, payload, slot)
        self._put(data)
        block = Block(
            kind, scan, self.end, len(payload), packing, head_size(self.format), self.entries, base, crc, slot
        )  # fmt: skip
        self.end, self.place, self.marked = block.end, self.place.after(block), None
        return block

    def append_short(self, slot: int, scan: int, payload: bytes) -> bool:
        """Writes an entry as a short block; false where that is not possible. On `OSError` the file is as it was."""
        made = encode_short(slot, scan, self.place, payload)
        if made is None:
            return False
        data, _ = made
        place = Place(self.entries + 1, scan)
        marked = (
            self.marked is not None
        )  # it may be longer than what takes its place: there is to be nothing left of it
        self._put(data + self._mark(scan, place.entries) if marked else data)
        self.end, self.place, self.marked = self.end + len(data), place, scan if marked else None
        return True

    def append_raw(self, data: bytes) -> None:
        """Appends whole blocks that were copied from a different run file."""
        self._put(data)
        self.end += len(data)
        self.marked = None

    def mark(self, scan: int) -> None:
        """Writes the last known scan at the end, over the mark that may be there."""
        if scan != self.marked:
            self._put(self._mark(scan))
            self.marked = scan

    def payload(self, block: Block, most: int = LARGEST) -> bytes:
        """What a block holds, unpacked; `RunFileError` when that is more than `most` bytes, or none at all."""
        data = os.pread(self.fd, block.length, block.payload_offset)
        size = len(data)
        try:
            if block.packing == PACKED:
                size = zstandard.frame_content_size(data)
            if 0 <= size <= most:
                return zstandard.ZstdDecompressor().decompress(data) if block.packing == PACKED else data
        except zstandard.ZstdError as error:
            raise self.unreadable(block, str(error)) from error
        raise self.unreadable(block, f"it says that it holds {size} bytes, and {most} is the most that can be")

    def beginning(self, block: Block, count: int) -> bytes:
        """The first bytes of what a block holds."""
        if block.packing != PACKED:
            return os.pread(self.fd, min(count, block.length), block.payload_offset)
        data = os.pread(self.fd, block.length, block.payload_offset)
        try:
            return zstandard.ZstdDecompressor().stream_reader(data).read(count)
        except zstandard.ZstdError as error:
            raise self.unreadable(block, str(error)) from error

    def unreadable(self, block: Block, why: str) -> RunFileError:
        """What to say of a block that is whole, and cannot be understood."""
        return RunFileError(
            f"{self.path.name}: the {block.kind.name.lower()} at byte {block.offset} cannot be read: {why}. "
            "Open it with the version of scanbench that wrote it"
        )

    def read(self, offset: int, length: int) -> bytes:
        """Bytes as they are stored."""
        return os.pread(self.fd, length, offset)

    def walk(self, end: int) -> Iterator[Block]:
        """The blocks from the first up to the byte `end`, which were good."""
        offset, place = _HEAD.size, Place(0)
        if self.mended is not None:
            for block in self.mended.blocks:
                if block.end <= end:
                    place = place.after(block)
                    if block.offset not in self.mended.unread:
                        yield block
            offset = max(offset, self.mended.end)
        while offset < end:
            found = decode(self.format, os.pread(self.fd, head_size(self.format), offset), offset, place)
            if found is None:
                raise RunFileError(f"{self.path.name} was damaged at byte {offset} while it was in use")
            yield found
            offset, place = found.end, place.after(found)

    def scan_blocks(self) -> Iterator[Block]:
        """Every good block after `end`, each with a right checksum: all blocks of a file just opened. `end` moves past them,
        and `damage` says why they end. `RunFileError` at one that only a newer version knows: that is no damage."""
        size = os.fstat(self.fd).st_size
        offset, block, place = self.end, None, self.place
        self.damage = None
        while offset < size:
            good = self._good_block(offset, size, place)
            if good is None:
                self._refuse_newer(offset, size)
                self.damage = self._damage(offset, size, place)
                break
            yield good
            block, offset, place = good, good.end, place.after(good)
        self.end_after(block, offset, place)

    def end_after(self, block: Block | None, offset: int, place: Place) -> None:
        """What is appended next is written at `offset`, where this block ends; over it, should it be a mark."""
        self.end, self._upto, self.marked, self.place = offset, offset, None, place
        if block is None:
            return
        if block.kind is Kind.MARK and not block.length:
            self.end, self.marked = block.offset, block.scan

    def go_on_with(self, blocks: Sequence[Block]) -> None:
        """Takes these for its blocks, which are in order, not without damage between them; `damage` is then what is after all."""
        size, last = os.fstat(self.fd).st_size, max(blocks, key=lambda each: each.offset)
        scan = next((each.scan for each in reversed(blocks) if each.kind is Kind.ENTRY), None)
        place = Place(blocks[-1].entries_after, scan)
        self.damage = self._damage(last.end, size, place) if last.end < size else None
        self.end_after(last, last.end, place)
        self._mend(blocks)

    def end_before_loss(self, block: Block) -> None:
        """Nothing after this block can be used: it is the last one, and `damage` is what comes after it."""
        blocks = list(self.walk(self._upto))
        at = next(index for index, each in enumerate(blocks) if each.offset == block.offset)
        end = max(each.end for each in blocks[: at + 1])
        self.damage = Damage(end, False, (*blocks[at + 1 :], *(self.damage.after if self.damage is not None else ())))
        self.end_after(block, end, Place(block.entries_after))
        if self.mended is not None:
            self._mend(blocks[: at + 1])

    def _mend(self, blocks: Sequence[Block]) -> None:
        """These are its blocks up to `end`, where a mark may be overwritten."""
        self.mended = Mended(tuple(each for each in blocks if each.end <= self.end), self.end)

    def cut(self, offset: int, aside: Path | None) -> None:
        """Ends the file at `offset`; what was after it is moved to `aside`."""
        if aside is not None:
            size = os.fstat(self.fd).st_size
            with aside.open("wb") as file:
                file.writelines(os.pread(self.fd, min(1 << 20, size - at), at) for at in range(offset, size, 1 << 20))
        os.ftruncate(self.fd, offset)

    def _put(self, data: bytes) -> None:
        try:
            _write(self.fd, data, self.end)
        except OSError:
            with suppress(OSError):
                os.ftruncate(self.fd, self.end)
                if self.marked is not None:
                    _write(self.fd, self._mark(self.marked), self.end)
            raise

    def _mark(self, scan: int, entries: int | None = None) -> bytes:
        return encode(self.format, Kind.MARK, 0, scan, self.entries if entries is None else entries, 0, b"")[0]

    def _head(self, offset: int, size: int) -> bytes:
        """The head of a block, as far as it lies before `size`: another process may have appended since that was asked."""
        return os.pread(self.fd, min(head_size(self.format), size - offset), offset)

    def _good_block(self, offset: int, size: int, place: Place) -> Block | None:
        head = self._head(offset, size)
        block = decode(self.format, head, offset, place)
        if block is None or block.end > size:
            return None
        short = block.packing == SHORT
        begun = short_checksum_begun(head, block.entries, block.scan) if short else checksum_begun(head)
        return block if self._is_right(begun, block.crc, block.payload_offset, block.end) else None

    def _is_right(self, found: int, crc: int, begin: int, end: int) -> bool:
        """Whether this is the checksum of a block, of which `found` was begun with its head."""
        for at in range(begin, end, _CHUNK):
            found = zlib.crc32(os.pread(self.fd, min(_CHUNK, end - at), at), found)
        return found == crc

    def _refuse_newer(self, offset: int, size: int) -> None:
        data = self._head(offset, size)
        head = read_head(self.format, data)
        if head is None or head.known:
            return
        begin = offset + len(data)
        if (
            head.sync == SYNC
            and begin + head.length <= size
            and self._is_right(checksum_begun(data), head.crc, begin, begin + head.length)
        ):
            raise RunFileError(
                f"{self.path.name}: the block at byte {offset} is of kind {head.kind}, packed in way {head.packing}, with "
                f"{head.reserved} in its reserved field, and this scanbench does not know that together. Open it with the "
                "version of scanbench that wrote it"
            )

    def _damage(self, offset: int, size: int, place: Place) -> Damage:
        after = tuple(self._after(offset + 1, size))
        data = self._head(offset, size)
        head = read_head(self.format, data)
        if is_short(self.format, data):
            block = decode(self.format, data, offset, place)
            short = block is None or block.end > size
        else:
            short = head is None or (head.known and offset + head_size(self.format) + head.length > size)
        torn = short and not after and not (head is not None and self._has_wrong_length(head, offset, size))
        return Damage(offset, torn, after)

    def _has_wrong_length(self, head: Head, offset: int, size: int) -> bool:
        """Whether the block is whole but for its length: it ends where the file does."""
        begin = offset + head_size(self.format)
        length = size - begin
        if length > LARGEST:
            return False
        right = pack_head(self.format, replace(head, length=length))
        return self._is_right(checksum_begun(right), head.crc, begin, size)

    def _after(self, offset: int, size: int) -> Iterator[Block]:
        """The good blocks after damage, as far as they are found with reasonable trouble."""
        after, left, most = offset, _SEARCH, _MOST_AFTER
        for at in self._places(offset, size):
            if at < after:
                continue
            if left <= 0 or most <= 0:
                return
            block = self._good_block(at, size, Place(0))
            if block is None:
                claimed = decode(self.format, self._head(at, size), at)
                left -= max(_LOOK, claimed.length if claimed is not None and claimed.end <= size else 0)
                continue
            place = Place(0)
            while block is not None:  # short blocks are not searched for: they follow
                yield block
                after, most, place = block.end, most - 1, place.after(block)
                follows = is_short(self.format, self._head(after, size)) if most > 0 and after < size else False
                block = self._good_block(after, size, place) if follows else None

    def _places(self, offset: int, size: int) -> Iterator[int]:
        """Where blocks may begin."""
        for begin in range(offset, size, _CHUNK):
            chunk = os.pread(self.fd, min(_CHUNK + len(SYNC) - 1, size - begin), begin)
            at = chunk.find(SYNC)
            while at >= 0:
                yield begin + at
                at = chunk.find(SYNC, at + 1)


def is_run_file(path: Path) -> bool:
    """Whether a file begins like one, of whatever format; `OSError`."""
    with path.open("rb") as file:
        return file.read(len(_MAGIC)) == _MAGIC


def _format_of(path: Path, head: bytes) -> int:
    """The format of a file that begins so."""
    if len(head) < _HEAD.size or head[: len(_MAGIC)] != _MAGIC:
        raise RunFileError(f"{path.name} is not a run file: its first bytes are not those of one")
    format: int = _HEAD.unpack(head)[1]
    if not 1 <= format <= FORMAT:
        raise RunFileError(
            f"{path.name} is a run file of format {format}; this scanbench reads formats 1 to {FORMAT}: "
            "open it with the version of scanbench that wrote it"
        )
    return format


def _write(fd: int, data: bytes, offset: int) -> None:
    """Writes all of it; `OSError` when it does not fit."""
    view = memoryview(data)
    while view:
        done = os.pwrite(fd, view, offset)
        view, offset = view[done:], offset + done
