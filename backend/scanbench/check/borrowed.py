"""Read-only memory that is passed to an in-out: allowed where nothing writes to that in-out, which is known when all bodies are."""

from collections.abc import Collection

from scanbench.check.context import Report
from scanbench.check.uses import Symbol
from scanbench.problems import Span
from scanbench.program.program import Pou
from scanbench.syntax.source import Source, Stretch

_End = tuple[Source, int] | tuple[str, int, int]


def check_borrowed(report: Report, dispatchers: Collection[Pou]) -> None:
    """Refuses what is passed to in-outs that are written; and to those of `dispatchers`, as what these run is known only then."""
    parts = list(report.parts.items())
    borrowed = [each for _, part in parts for each in part.borrowed]
    if not borrowed:
        return
    known = {pou.name.upper().partition("<")[0] for pou, _ in parts if pou not in dispatchers}
    readers = {each.reader for each in borrowed}
    written = {reader for reader in readers if reader.owner not in known} | _written(report, readers)
    for each in borrowed:
        if each.reader in written:
            report.error(each.problem.code, each.problem.message, each.problem.span)


def _written(report: Report, wanted: set[Symbol]) -> set[Symbol]:
    """Of these, those that anything assigns, or passes to what may write them."""
    found: set[Symbol] = set()
    for part in report.parts.values():
        named = [use for use in part.uses if use.symbol in wanted]
        if named:
            ends = set(map(_end, part.written))
            found.update(use.symbol for use in named if _end(use.span) in ends)
    return found


def _end(span: Span) -> _End:
    """Where it ends: spans of kept texts are told by their source, as they move."""
    if isinstance(span, Stretch):
        return span.source, span.end
    return span.file, span.end_line, span.end_column
