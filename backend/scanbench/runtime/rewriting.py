"""A run file written anew with some of its blocks: thinned, cut off at the front, or copied up to a scan."""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path

from scanbench.runtime.runfile import Block, Kind, RunFile

_CHUNK = 1 << 20


@dataclass(slots=True)
class Rewritten:
    """A new file beside the old one."""

    file: RunFile
    upto: int
    """Bytes of the source that it stands for; what was appended behind them is still to be copied."""
    blocks: dict[int, Block] = field(default_factory=dict)
    """Where keyframes and deltas are now, by their old offsets."""

    def abandon(self) -> None:
        """It is not wanted after all."""
        self.file.close()
        with suppress(OSError):
            self.file.path.unlink()


def rewrite(
    source: RunFile, path: Path, about: bytes, keep: Callable[[Block, int], bool], upto: int | None = None
) -> Rewritten:
    """Copies the blocks that `keep(block, entries in front of it)` wants, behind a new ABOUT. Any thread."""
    end = source.end if upto is None else upto
    made = Rewritten(RunFile.create(path), end)
    try:
        made.file.append(Kind.ABOUT, 0, about)
        _copy(source, made, keep)
    except OSError:
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
            copy_range(source, made.file, begin, end)
            begin = block.offset
        end = block.end
        if block.kind in (Kind.KEYFRAME, Kind.DELTA):
            made.blocks[block.offset] = replace(block, offset=made.file.end + block.offset - begin)
    copy_range(source, made.file, begin, end)


def copy_range(source: RunFile, target: RunFile, begin: int, end: int) -> None:
    """Appends the bytes of whole blocks."""
    if end > begin:
        target.append_raw(source.read(begin, end - begin))
