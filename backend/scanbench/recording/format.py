"""The bytes of a run file: blocks with checksums, one after the other. What they mean is `blocks.py`'s.

    0   14 bytes  "scanbench run\\n"
    14  u16       format version, 1
    16  blocks

A block, little endian:

    0   4 bytes   F5 'R' 'B' 0A, so that the next good block is found after damage
    4   u8        kind, see `Kind`
    5   u8        packing of the payload: 0 as it is, 1 Zstandard
    6   u16       0
    8   u32       bytes of the payload as stored
    12  u64       scan that the block belongs to
    20  u32       CRC-32 of bytes 0 to 19 and the payload
    24  payload

Blocks are only ever appended, but for one: a mark without a payload (the last known scan) at the very end is overwritten by
what comes next. So a write that did not come to its end costs the block that was written, and nothing before it.
"""

import os
import zlib
from collections import Counter
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from enum import IntEnum
from pathlib import Path
from struct import Struct

import zstandard

FORMAT = 1
_MAGIC = b"scanbench run\n"
_HEAD = Struct("<14sH")
_SYNC = b"\xf5RB\n"
_BLOCK = Struct("<4sBBHIQI")
_CRC = Struct("<I")
_PACKED = 1
_WORTH_PACKING = 200
_CHUNK = 1 << 20
LARGEST = 1 << 26
"""Bytes of a payload once unpacked, where nobody knows better: a file from elsewhere must not fill the memory."""
_SEARCH = 1 << 28
"""Bytes that are looked at for blocks after damage, ..."""
_LOOK = 1 << 12
"""... where each place that might be one counts at least so much."""


class RunFileError(Exception):
    """This run file cannot be used; the message says why, and what to do."""


class Damaged(RunFileError):
    """It is damaged where all begins, so that nothing can be recovered."""


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

    @property
    def payload_offset(self) -> int:
        """Where the payload begins."""
        return self.offset + _BLOCK.size

    @property
    def end(self) -> int:
        """Where the next block begins."""
        return self.offset + _BLOCK.size + self.length

    @property
    def size(self) -> int:
        """Bytes in the file."""
        return _BLOCK.size + self.length


@dataclass(frozen=True, slots=True)
class Damage:
    """Where the good blocks end. `last_scan` is the last scan that the rest still names, -1 when it names none."""

    offset: int
    torn: bool
    """The file ends inside this block: its writer was ended while writing it."""
    last_scan: int
    lost: tuple[tuple[Kind, int], ...] = ()
    """Good blocks after the damage, which nobody can use: how many of each kind."""


class RunFile:
    """A run file open for reading, or for reading and appending.

    One thread appends. Others may read before an `end` that they were told.
    """

    def __init__(self, path: Path, fd: int, end: int) -> None:
        self.path, self.fd = path, fd
        self.end = end
        """After the last block that is no trailing mark."""
        self.damage: Damage | None = None
        """What `scan_blocks` came upon."""
        self._marked: int | None = None
        self._packer = zstandard.ZstdCompressor(level=1)

    @classmethod
    def create(cls, path: Path) -> "RunFile":
        """A new file with no blocks; `FileExistsError` if there is one."""
        fd = os.open(path, os.O_RDWR | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, 0o644)
        try:
            _write(fd, _HEAD.pack(_MAGIC, FORMAT), 0)
        except OSError:
            os.close(fd)
            path.unlink()
            raise
        return cls(path, fd, _HEAD.size)

    @classmethod
    def open(cls, path: Path, read_only: bool = False) -> "RunFile":
        """An existing file. Nothing is read but its first bytes: see `scan_blocks`."""
        fd = os.open(path, (os.O_RDONLY if read_only else os.O_RDWR) | os.O_CLOEXEC)
        try:
            _check_head(path, os.pread(fd, _HEAD.size, 0))
        except RunFileError:
            os.close(fd)
            raise
        return cls(path, fd, _HEAD.size)

    def close(self) -> None:
        """Closes the file."""
        os.close(self.fd)

    def append(self, kind: Kind, scan: int, payload: bytes) -> Block:
        """Writes a block after all others. On `OSError` the file is as it was."""
        packing = 0
        if len(payload) >= _WORTH_PACKING:
            payload, packing = self._packer.compress(payload), _PACKED
        self._put(_encode(kind, packing, scan, payload))
        block = Block(kind, scan, self.end, len(payload), packing)
        self.end, self._marked = block.end, None
        return block

    def append_raw(self, data: bytes) -> None:
        """Appends whole blocks that were copied from a different run file."""
        self._put(data)
        self.end += len(data)
        self._marked = None

    def mark(self, scan: int) -> None:
        """Writes the last known scan at the end, over the mark that may be there."""
        if scan != self._marked:
            self._put(_encode(Kind.MARK, 0, scan, b""))
            self._marked = scan

    def payload(self, block: Block, most: int = LARGEST) -> bytes:
        """What a block holds, unpacked; `RunFileError` when that is more than `most` bytes, or none at all."""
        data = os.pread(self.fd, block.length, block.payload_offset)
        size = len(data)
        try:
            if block.packing == _PACKED:
                size = zstandard.frame_content_size(data)
            if 0 <= size <= most:
                return zstandard.ZstdDecompressor().decompress(data) if block.packing == _PACKED else data
        except zstandard.ZstdError as error:
            raise self.unreadable(block, str(error)) from error
        raise self.unreadable(block, f"it says that it holds {size} bytes, and {most} is the most that can be")

    def beginning(self, block: Block, count: int) -> bytes:
        """The first bytes of what a block holds."""
        if block.packing != _PACKED:
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
        offset = _HEAD.size
        while offset < end:
            block = _decode(os.pread(self.fd, _BLOCK.size, offset), offset)
            if block is None:
                raise RunFileError(f"{self.path.name} was damaged at byte {offset} while it was in use")
            yield block
            offset = block.end

    def scan_blocks(self) -> Iterator[Block]:
        """Every good block after `end`, each with a right checksum: all blocks of a file just opened. `end` moves past them,
        and `damage` says why they end. `RunFileError` at one that only a newer version knows: that is no damage."""
        size = os.fstat(self.fd).st_size
        offset, block = self.end, None
        self.damage = None
        while offset < size:
            good = self._good_block(offset, size)
            if good is None:
                self._refuse_newer(offset, size)
                self.damage = self._damage(offset, size)
                break
            yield good
            block, offset = good, good.end
        self.end, self._marked = offset, None
        if block is not None and block.kind is Kind.MARK and not block.length:
            self.end, self._marked = block.offset, block.scan

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
                if self._marked is not None:
                    _write(self.fd, _encode(Kind.MARK, 0, self._marked, b""), self.end)
            raise

    def _head(self, offset: int, size: int) -> bytes:
        """The head of a block, as far as it lies before `size`: another process may have appended since that was asked."""
        return os.pread(self.fd, min(_BLOCK.size, size - offset), offset)

    def _good_block(self, offset: int, size: int) -> Block | None:
        head = self._head(offset, size)
        block = _decode(head, offset)
        if block is None or block.end > size:
            return None
        return block if self._is_right(head, block.payload_offset, block.end) else None

    def _is_right(self, head: bytes, begin: int, end: int) -> bool:
        """Whether the checksum in the head of a block is that of the block."""
        crc = zlib.crc32(head[: -_CRC.size])
        for at in range(begin, end, _CHUNK):
            crc = zlib.crc32(os.pread(self.fd, min(_CHUNK, end - at), at), crc)
        return bool(crc == _CRC.unpack_from(head, _BLOCK.size - _CRC.size)[0])

    def _refuse_newer(self, offset: int, size: int) -> None:
        head = self._head(offset, size)
        if len(head) < _BLOCK.size or _decode(head, offset) is not None:
            return
        sync, kind, packing, reserved, length, _, _ = _BLOCK.unpack(head)
        begin = offset + _BLOCK.size
        if sync == _SYNC and begin + length <= size and self._is_right(head, begin, begin + length):
            raise RunFileError(
                f"{self.path.name}: the block at byte {offset} is of kind {kind}, packed in way {packing}, with {reserved} in its reserved "
                "field, and this scanbench does not know that together. Open it with the version of scanbench that wrote it"
            )

    def _damage(self, offset: int, size: int) -> Damage:
        last, lost = self._after(offset + 1, size)
        head = self._head(offset, size)
        block = _decode(head, offset)
        short = len(head) < _BLOCK.size or (block is not None and block.end > size)
        torn = short and last < 0 and not self._has_wrong_length(head, offset, size)
        return Damage(offset, torn, last, tuple(sorted(lost.items())))

    def _has_wrong_length(self, head: bytes, offset: int, size: int) -> bool:
        """Whether the block is whole but for its length: it ends where the file does."""
        if len(head) < _BLOCK.size:
            return False
        sync, kind, packing, reserved, _, scan, crc = _BLOCK.unpack(head)
        length = size - offset - _BLOCK.size
        if length > LARGEST:
            return False
        right = _BLOCK.pack(sync, kind, packing, reserved, length, scan, crc)
        found = zlib.crc32(os.pread(self.fd, length, offset + _BLOCK.size), zlib.crc32(right[: -_CRC.size]))
        return bool(found == crc)

    def _after(self, offset: int, size: int) -> tuple[int, Counter[Kind]]:
        """The last scan that a good block after the damage names, and how many there are of each kind, as far as that is
        found with reasonable trouble."""
        last, after, left, lost = -1, offset, _SEARCH, Counter[Kind]()
        for at in self._places(offset, size):
            if at < after:
                continue
            if left <= 0:
                break
            claimed = _decode(self._head(at, size), at)
            left -= max(_LOOK, claimed.length if claimed is not None and claimed.end <= size else 0)
            block = self._good_block(at, size)
            if block is not None:
                last, after = max(last, block.scan), block.end
                lost[block.kind] += 1
        return last, lost

    def _places(self, offset: int, size: int) -> Iterator[int]:
        """Where blocks may begin."""
        for begin in range(offset, size, _CHUNK):
            chunk = os.pread(self.fd, min(_CHUNK + len(_SYNC) - 1, size - begin), begin)
            at = chunk.find(_SYNC)
            while at >= 0:
                yield begin + at
                at = chunk.find(_SYNC, at + 1)


def is_run_file(path: Path) -> bool:
    """Whether a file begins like one, of whatever format; `OSError`."""
    with path.open("rb") as file:
        return file.read(len(_MAGIC)) == _MAGIC


def _check_head(path: Path, head: bytes) -> None:
    if len(head) < _HEAD.size or head[: len(_MAGIC)] != _MAGIC:
        raise RunFileError(f"{path.name} is not a run file: its first bytes are not those of one")
    _, version = _HEAD.unpack(head)
    if version != FORMAT:
        raise RunFileError(
            f"{path.name} is a run file of format {version}; this scanbench reads format {FORMAT}: "
            "open it with the version of scanbench that wrote it"
        )


def _encode(kind: Kind, packing: int, scan: int, payload: bytes) -> bytes:
    head = _BLOCK.pack(_SYNC, kind, packing, 0, len(payload), scan, 0)[: -_CRC.size]
    return head + _CRC.pack(zlib.crc32(payload, zlib.crc32(head))) + payload


def _decode(head: bytes, offset: int) -> Block | None:
    """The block that begins with these bytes, or None where none can begin."""
    if len(head) < _BLOCK.size:
        return None
    sync, kind, packing, reserved, length, scan, _ = _BLOCK.unpack(head)
    if sync != _SYNC or reserved or packing > _PACKED or not Kind.ABOUT <= kind <= Kind.MARK:
        return None
    return Block(Kind(kind), scan, offset, length, packing)


def _write(fd: int, data: bytes, offset: int) -> None:
    """Writes all of it; `OSError` when it does not fit."""
    view = memoryview(data)
    while view:
        done = os.pwrite(fd, view, offset)
        view, offset = view[done:], offset + done
