"""Samples in files: packed pages one after the other, the oldest first, compressed. No more than a page is in memory."""

import tempfile
from collections.abc import Iterable, Iterator
from pathlib import Path

import zstandard

from scanbench.taps.trace_buffer import Samples, unpack_pages

_LEVEL = 3


def write_pages(path: Path, pages: Iterable[Samples]) -> None:
    """Writes pages that come in order."""
    with path.open("wb") as file:
        for page in pages:
            file.write(_packed(page))


def read_pages(path: Path, rows: int) -> Iterator[Samples]:
    """What was written, so many rows; `OSError`, `ValueError` where it cannot be read."""
    found = 0
    with path.open("rb") as file, zstandard.ZstdDecompressor().stream_reader(file, read_across_frames=True) as stream:
        try:
            for page in unpack_pages(stream.read):
                found += len(page)
                yield page
        except zstandard.ZstdError as error:
            raise ValueError(f"{path.name} is damaged: {error}") from error
    if found != rows:  # an end that is missing is no error of zstd's
        raise ValueError(f"{path.name} is damaged: it has {found:,} of {rows:,} samples")


class Spool:
    """Pages that come from the newest to the oldest, and are given out the other way round."""

    def __init__(self, directory: Path) -> None:
        self._file = tempfile.TemporaryFile(dir=directory)  # noqa: SIM115  closed in `close`
        self._sizes: list[int] = []
        self.rows = self.first = self.end = 0

    def add(self, page: Samples) -> None:
        """Takes a page with rows before all that are here."""
        if not len(page):
            return
        self._sizes.append(self._file.write(_packed(page)))
        self.rows += len(page)
        self.first = int(page.scans[0])
        self.end = self.end or int(page.scans[-1]) + 1

    def pages(self) -> Iterator[Samples]:
        """The oldest first."""
        for data in self._frames():
            yield Samples.unpack(zstandard.ZstdDecompressor().decompress(data))[0]

    def save(self, path: Path) -> None:
        """Writes them as `write_pages` does."""
        part = path.with_suffix(".part")
        with part.open("wb") as file:
            for data in self._frames():
                file.write(data)
        part.replace(path)

    def close(self) -> None:
        """Forgets all."""
        self._file.close()

    def _frames(self) -> Iterator[bytes]:
        at = sum(self._sizes)
        for size in reversed(self._sizes):
            at -= size
            self._file.seek(at)
            yield self._file.read(size)


def _packed(page: Samples) -> bytes:
    scans = page.scans
    first, end = (int(scans[0]), int(scans[-1]) + 1) if len(scans) else (0, 0)
    return zstandard.ZstdCompressor(level=_LEVEL).compress(page.pack(first, end, 1))
