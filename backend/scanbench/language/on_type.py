"""The layout of what was just typed: of the line that Enter or a `;` finished, of a line that became the end of a block, and when
Enter ends such a line, of the block.

While somebody types, a text is hardly ever whole: so this asks the tokens and blocks alone. It changes blanks and the case of keywords in
lines that are finished, and nothing else: no line comes or goes, and the line to which Enter led stays as it is.
"""

import re
from collections import Counter
from dataclasses import dataclass

from scanbench.language.format import STEP, Line, edits, joined, keeps, leveled
from scanbench.language.index import chunk_at
from scanbench.language.outline import ENDS, Block
from scanbench.language.reading import Reading

TRIGGERS = ("\n", ";", *sorted({letter for end in ENDS for letter in (end[-1], end[-1].lower())}))
"""What may finish a line or a block, the most important first."""
_END = re.compile(r"[ \t]*END_\w+[ \t]*$", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class Change:
    """Positions in the file."""

    start: int
    end: int
    text: str


def may_finish(line: str, ch: str) -> bool:
    """Whether it is worth asking, by the text of the line up to the caret."""
    return ch in ("\n", ";") or _END.match(line) is not None


def typed(reading: Reading, file: str, position: int, ch: str) -> list[Change]:
    """What to change after this was typed before the position, in the order of the text."""
    text = reading.text(file)
    where = text.rfind("\n", 0, position) if ch == "\n" else position
    if where < 0:
        return []
    chunk = chunk_at(reading.files[file], where)
    stretch = chunk.source.text
    part, at = reading.part(chunk), where - chunk.start
    begin, end = _line_around(stretch, at)
    closed = _closed(part.blocks, begin, at)
    if (ch == ";" and not _ends_line(text, position)) or (
        ch not in "\n;" and not (closed and _END.match(stretch[begin:end]))
    ):
        return []
    lines = leveled(stretch, part.tokens, part.blocks, chunk.file.pous)
    made = joined(lines, stretch, _step(lines))
    if (
        "\r" in stretch
        or not keeps(stretch, lines, made, file)
        or not any(each.number == _row(stretch, at) for each in lines)
    ):
        return []
    last = _row(stretch, at)
    first = last if ch not in "\n;" else _first_of_group(lines, last)
    if ch == "\n" and closed is not None:
        first = min(first, _row(stretch, closed.start))
    if first == 0 and text[: chunk.start].rpartition("\n")[2]:
        first = 1  # a line that begins before it
    return _changes(stretch, made, first, last, chunk.start, whole=ch in "\n;")


def _changes(before: str, made: str, first: int, last: int, start: int, whole: bool) -> list[Change]:
    """The lines that are different, without what they have in common; if not `whole` their indentation alone."""
    old, found = before.split("\n"), []
    positions = [0]
    for line in old:
        positions.append(positions[-1] + len(line) + 1)
    for each in edits(before, made, first, last):
        if not each.lines:
            continue
        was, now = old[each.first], each.lines[0]
        if not whole:
            now = now[: len(now) - len(now.lstrip())] + was.lstrip()
        head = _common(was, now)
        tail = _common(was[head:][::-1], now[head:][::-1])
        at = start + positions[each.first]
        if was != now:
            found.append(Change(at + head, at + len(was) - tail, now[head : len(now) - tail]))
    return found


def _common(one: str, other: str) -> int:
    """How many characters both begin with."""
    return next((at for at, (a, b) in enumerate(zip(one, other, strict=False)) if a != b), min(len(one), len(other)))


def _row(text: str, at: int) -> int:
    return text.count("\n", 0, at)


def _line_around(text: str, at: int) -> tuple[int, int]:
    end = text.find("\n", at)
    return text.rfind("\n", 0, at) + 1, len(text) if end < 0 else end


def _ends_line(text: str, position: int) -> bool:
    """Whether nothing follows in the line."""
    return not text[position : _line_around(text, position)[1]].strip()


def _closed(top: list[Block], begin: int, end: int) -> Block | None:
    """The block whose end is in this stretch of a line: the outermost, if the line ends several."""
    for block in top:
        if block.closed and begin < block.end <= end and block.start < begin:
            return block
        if block.start < end and (found := _closed(block.inner, begin, end)) is not None:
            return found
    return None


def _first_of_group(lines: list[Line], number: int) -> int:
    """Where the declarations begin whose types share a column with those of this line."""
    found = {each.number: each for each in lines}
    first = found[number]
    while len(first.body) > 1:
        above = found.get(first.number - 1)
        if above is None or len(above.body) < 2 or above.indent != first.indent:
            break
        first = above
    return first.number


def _step(lines: list[Line]) -> int:
    """How many blanks a level the text has already, by most of its lines that are indented at all."""
    found = Counter(
        line.indent // line.level
        for line in lines
        if line.level
        and line.indent >= line.level
        and line.indent % line.level == 0
        and not (line.continued or line.fixed)
    )
    return found.most_common(1)[0][0] if found else STEP
