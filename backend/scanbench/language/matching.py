"""The keywords of one block: `IF`, its `ELSIF` and `ELSE`, and the `END_IF` that belongs to them. By tokens alone, so they are
there while the text is broken, too."""

from bisect import bisect_right
from collections.abc import Iterator

from scanbench.language.index import chunk_at
from scanbench.language.outline import Block
from scanbench.language.reading import Reading
from scanbench.syntax.lexer import Tokens

_BETWEEN = {"IF": ("ELSIF", "ELSE"), "CASE": ("ELSE",), "REPEAT": ("UNTIL",), "__TRY": ("__CATCH", "__FINALLY")}
"""Keywords of a block beside the first and the last."""


def keywords_at(reading: Reading, file: str, position: int) -> list[tuple[int, int]]:
    """From where to where those are that belong to the one at a position; none where there is no such keyword."""
    chunk = chunk_at(reading.files[file], position)
    part, within = reading.part(chunk), position - chunk.start
    holding = (each for outer in part.blocks for each in outer.walk() if each.start <= within <= each.end)
    # The innermost is the last; where two meet, as after `END_IF`, the one whose keyword is there.
    for block in reversed(list(holding)):
        found = list(_keywords(part.tokens, block))
        if any(start <= within <= end for start, end in found):
            return [(chunk.start + start, chunk.start + end) for start, end in found]
    return []


def _keywords(tokens: Tokens, block: Block) -> Iterator[tuple[int, int]]:
    between = _BETWEEN.get(block.keyword, ())
    at = bisect_right(tokens.starts, block.start)
    yield block.start, block.start + len(block.keyword)
    while at < len(tokens.starts) and tokens.starts[at] < block.end:
        start, text = tokens.starts[at], tokens.texts[at]
        inner = next((each for each in block.inner if each.start <= start < each.end), None)
        if inner is not None:
            at = bisect_right(tokens.starts, inner.end - 1)
            continue
        end = start + len(text)
        if text.upper() in between or (block.closed and end == block.end):
            yield start, end
        at += 1
