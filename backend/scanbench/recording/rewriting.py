"""A run file written again with some of its blocks: thinned, cut off at the front, or copied up to a scan."""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path

from scanbench.recording.block import NUMBERED
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
    about: bytes = b""
    programs: list[Block] = field(default_factory=list)
    """One of each, in the source."""

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

    def repeat(self) -> None:
        """Writes once more what all the rest needs."""
        if self.file.format < NUMBERED:
            return
        self.file.append(Kind.ABOUT, 0, self.about)
        for block in self.programs:
            self.file.append(Kind.PROGRAM, 0, self.source.payload(block))

    def abandon(self) -> None:
        """It is not wanted after all."""
        self.file.close()
        with suppress(OSError):
            self.file.path.unlink()


def rewrite(source: RunFile, end: int, path: Path, about: bytes, keep: Callable[[Block, int], bool]) -> Rewritten:
    """Copies all programs, and the blocks up to the byte `end` that `keep(block, entries before it)` wants, after a new ABOUT.
    Any thread."""
    made = Rewritten(source, RunFile.create(path, source.format), end, end, about=about)
    try:
        made.file.append(Kind.ABOUT, 0, about)
        _copy_programs(made)
        _copy(source, made, keep)
    except BaseException:
        made.abandon()
        raise
    return made


def _copy_programs(made: Rewritten) -> None:
    """One of each: they are before all that needs them."""
    versions = set[bytes]()
    for block in made.source.walk(made.upto):
        if block.kind is Kind.PROGRAM:
            version = made.source.beginning(block, 4)
            if version not in versions:
                versions.add(version)
                made.programs.append(block)
                _copy_range(made.source, made.file, block.offset, block.end)


def _copy(source: RunFile, made: Rewritten, keep: Callable[[Block, int], bool]) -> None:
    """Runs of blocks that follow each other are copied at once."""
    begin = end = 0
    entries = 0
    for block in source.walk(made.upto):
        wanted = block.kind not in (Kind.ABOUT, Kind.PROGRAM) and keep(block, entries)
        entries += block.kind is Kind.ENTRY
        if not wanted:
            continue
        made.file.place = made.file.place.after(block)
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
