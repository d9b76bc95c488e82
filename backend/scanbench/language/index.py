"""Where in the text which name is, and what it means: looked up by position and by symbol."""

from bisect import bisect_left, bisect_right
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

from scanbench.check.build import Checker
from scanbench.check.uses import Symbol, Use
from scanbench.problems import Span
from scanbench.syntax.chunks import Chunk, Chunked
from scanbench.syntax.source import Source, Stretch


@dataclass(frozen=True, slots=True)
class Occurrence:
    """A name in a text. Its file, line and columns are those of the text as it is now."""

    span: Span
    symbol: Symbol
    written: bool = False
    """Whether the variable is assigned there, or passed to something that may write it."""
    lent: bool = False
    """It may be read there, too: it is passed to an in-out, bound to a reference, or counted by a FOR."""


class Index:
    """The names of one state of a project; made again after each change, which takes some milliseconds for 10,000 lines."""

    def __init__(self, files: Mapping[str, Chunked], checker: Checker) -> None:
        self._files = files
        chunks = (chunk for file in files.values() for chunk in file.chunks)
        self._of: dict[Source, list[Use]] = {chunk.source: [] for chunk in chunks}
        self._written: defaultdict[Source, set[int]] = defaultdict(set)
        self._lent: defaultdict[Source, set[int]] = defaultdict(set)
        self._sorted: dict[Source, tuple[list[int], list[Use]]] = {}
        for report in (checker.report, *checker.report.parts.values()):
            for use in report.uses:
                span = use.span
                if isinstance(span, Stretch) and span.source in self._of:
                    self._of[span.source].append(use)
            for spans, ends in ((report.written, self._written), (report.lent, self._lent)):
                for span in spans:
                    if isinstance(span, Stretch):
                        ends[span.source].add(span.end)

    def at(self, file: str, position: int) -> Occurrence | None:
        """The name that this position of a file is in or after."""
        chunk = chunk_at(self._files[file], position)
        within = position - chunk.start
        near = (use for use in self._of[chunk.source] if _end(use) - use.length <= within <= _end(use))
        return next(self._occurrences(near), None)

    def of(self, symbols: Iterable[Symbol]) -> list[Occurrence]:
        """Everywhere that these are named but where they are declared, in order of files and lines."""
        wanted = frozenset(symbols)
        uses = (use for uses in self._of.values() for use in uses if use.symbol in wanted)
        return sorted(self._occurrences(uses), key=lambda each: (each.span.file, each.span.line, each.span.column))

    def between(self, file: str, start: int, end: int) -> Iterator[tuple[int, int, Symbol]]:
        """The names of a stretch of a file in order: from which position to which, and what each means."""
        for chunk in self._files[file].chunks:
            if chunk.start >= end or start >= chunk.end:
                continue
            ends, uses = self._by_end(chunk.source)
            last = -1
            for use in uses[bisect_right(ends, start - chunk.start) :]:
                after = chunk.start + _end(use)
                if after - use.length >= end:
                    break
                if after != last and _is_written(use):
                    last = after
                    yield after - use.length, after, use.symbol

    def ending(self, source: Source, end: int) -> Symbol | None:
        """What the name means that ends at a position of a chunk's text."""
        if source not in self._of:
            return None
        ends, uses = self._by_end(source)
        first, after = bisect_left(ends, end), bisect_right(ends, end)
        return next((use.symbol for use in uses[first:after] if _is_written(use)), None)

    def _by_end(self, source: Source) -> tuple[list[int], list[Use]]:
        """The uses of a chunk in order, and where each ends; of those that end together the first that was noted comes first."""
        known = self._sorted.get(source)
        if known is None:
            uses = sorted(self._of[source], key=_end)
            known = self._sorted[source] = [_end(use) for use in uses], uses
        return known

    def meanings(self, file: str) -> list[tuple[int, frozenset[Symbol]]]:
        """The names of a file in order, by the position after each: what it means, in a generic FUNCTION perhaps several things."""
        found: defaultdict[int, set[Symbol]] = defaultdict(set)
        for chunk in self._files[file].chunks:
            for use in self._of[chunk.source]:
                if _is_written(use):
                    found[chunk.start + _end(use)].add(use.symbol)
        return [(end, frozenset(found[end])) for end in sorted(found)]

    def _occurrences(self, uses: Iterable[Use]) -> Iterator[Occurrence]:
        """Each place once; what the checks made of a text and is not in it, is no name there."""
        seen: set[tuple[Source, int]] = set()
        for use in uses:
            span = use.span
            assert isinstance(span, Stretch)
            key = span.source, span.end
            if key not in seen and _is_written(use):
                seen.add(key)
                written, lent = span.end in self._written[span.source], span.end in self._lent[span.source]
                yield Occurrence(use.place, use.symbol, written, lent)


def chunk_at(file: Chunked, position: int) -> Chunk:
    """The chunk of a file that a position is in: where two meet, the POU."""
    touching = [chunk for chunk in file.chunks if chunk.start <= position <= chunk.end]
    return next((chunk for chunk in touching if chunk.single), touching[0])


def _is_written(use: Use) -> bool:
    """Whether the name is in the text, and not only in what the checks made of it."""
    span = use.span
    assert isinstance(span, Stretch)
    written = span.source.text[span.end - use.length : span.end].upper()  # perhaps longer then: `ß`
    return written == use.symbol.name.rpartition(".")[2]


def _end(use: Use) -> int:
    assert isinstance(use.span, Stretch)
    return use.span.end
