"""A run file written again with some of its blocks: thinned, cut off at the front, or copied up to a scan."""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path

from scanbench.recording.format import Block, Kind, RunFile

_CHUNK = 1 << 20


@dataclass(slots=True)
class Rewritten:
    """A new file next to the old one."""

    source: RunFile
    file: RunFile
    tail: int
    """From this byte on all blocks of the source follow each other in the new file too."""
    upto: int
    """Bytes of the source that are in the new file; what was appended after them is still to be copied."""
    blocks: dict[int, Block] = field(default_factory=dict)
    """Where keyframes and deltas before the tail are now, by their old offsets."""

    def follow(self, end: int) -> None:
        """Copies what was appended to the source meanwhile, up to the byte `end`."""
        for begin in range(self.upto, end, _CHUNK):
            self.file.append_raw(self.source.read(begin, min(_CHUNK, end - begin)))
        self.upto = end

    def moved(self, block: Block) -> Block | None:
        """Where a keyframe or delta of the source is in the new file, if it is."""
        if block.offset >= self.tail:
            return replace(block, offset=block.offset + self.file.end - self.upto)
        return self.blocks.get(block.offset)

    def abandon(self) -> None:
        """It is not wanted after all."""
        self.file.close()
        with suppress(OSError):
            self.file.path.unlink()


def rewrite(source: RunFile, end: int, path: Path, about: bytes, keep: Callable[[Block, int], bool]) -> Rewritten:
    """Copies the blocks up to the byte `end` that `keep(block, entries before it)` wants, after a new ABOUT. Any thread."""
    made = Rewritten(source, RunFile.create(path), end, end)
    try:
        made.file.append(Kind.ABOUT, 0, about)
        _copy(source, made, keep)
    except BaseException:
        made.abandon()
        raise
    return made


def _copy(source: RunFile, made: Rewritten, keep: Callable[[Block, int], bool]) -> None:
    """Runs of blocks that follow each other are copied at once."""
    begin = end = 0
    entries = 0
    for block in source.walk(made.upto):
        wanted = block.kind is not Kind.ABOUT and keep(block, entries)
        entries += block.kind is Kind.ENTRY
        if not wanted:
            continue
        if block.offset != end or end - begin > _CHUNK:
            _copy_range(source, made.file, begin, end)
            begin = block.offset
        end = block.end
        if block.kind in (Kind.KEYFRAME, Kind.DELTA):
            made.blocks[block.offset] = replace(block, offset=made.file.end + block.offset - begin)
    _copy_range(source, made.file, begin, end)


def _copy_range(source: RunFile, target: RunFile, begin: int, end: int) -> None:
    """Appends bytes, which are whole blocks in the end."""
    if end > begin:
        target.append_raw(source.read(begin, end - begin))
