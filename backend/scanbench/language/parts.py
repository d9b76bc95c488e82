"""The sections of variables and the statements of an outline: by the blocks alone, so that they are there while the text is broken, too."""

import re
from collections.abc import Sequence
from dataclasses import replace

from scanbench.language.entry import Entry, EntryKind
from scanbench.language.outline import STATEMENTS, Block
from scanbench.language.reading import Reading
from scanbench.problems import Span

LONGEST = 60
"""Of the head of a statement."""
_SECTION = re.compile(
    r"VAR\w*(?:\s+(?:CONSTANT|RETAIN|NON_RETAIN|PERSISTENT|PUBLIC|PROTECTED|PRIVATE|INTERNAL)\b)*", re.IGNORECASE
)
_HEAD = re.compile(r"\w+.*?(?=\s*(?:\b(?:THEN|DO|OF)\b|//|\(\*|/\*|;|\n|\r|$))", re.IGNORECASE)

Placed = tuple[int, Block]
"""A block, and the position that its own positions count from."""


def parted(
    reading: Reading, file: str, inner: Sequence[Entry], blocks: Sequence[Placed], statements: bool
) -> list[Entry]:
    """The entries of one level, with their variables in sections; with the statements that have others inside, if wanted."""
    made: list[Entry] = []
    rest = list(inner)
    for start, block in blocks:
        own = [each for each in rest if start + block.start <= each.start < start + block.end]
        nested = [(start, each) for each in block.inner]
        if block.keyword in STATEMENTS:
            if statements:
                inside = parted(reading, file, (), nested, statements)
                made.append(_part(reading, file, "statement", _HEAD, (start, block), inside))
            continue
        rest = [each for each in rest if each not in own]
        if block.keyword.startswith("VAR"):
            made.append(_part(reading, file, "section", _SECTION, (start, block), own))
            continue
        named = [each for each in own if _at(reading, each) == start + block.name_at]
        made += [replace(each, inner=tuple(parted(reading, file, each.inner, nested, statements))) for each in named]
        others = [each for each in own if each not in named]
        # a namespace or a resource: what is declared in it is an entry of this level
        made += others if named else parted(reading, file, others, nested, statements)
    return sorted([*made, *rest], key=lambda each: each.start)


def _at(reading: Reading, entry: Entry) -> int:
    return reading.position(entry.span.file, entry.span.line, entry.span.column)


def _part(
    reading: Reading, file: str, kind: EntryKind, head: re.Pattern[str], placed: Placed, inner: Sequence[Entry]
) -> Entry:
    """The entry of a block without a name: it is called by how it begins."""
    start, block = placed
    at = start + block.start
    found = head.match(reading.text(file), at)
    name = " ".join(found.group().split()) if found is not None else block.keyword
    short = name if len(name) <= LONGEST else f"{name[: LONGEST - 1]}\u2026"
    line, column = reading.place(file, at)
    span = Span(file, line, column, line, column + len(block.keyword))
    return Entry(short.upper() if kind == "section" else short, kind, "", span, at, start + block.end, tuple(inner))
