"""The names of the parameters before the arguments that are given by position."""

import re
from collections.abc import Iterator
from dataclasses import dataclass

from scanbench.language.called import calls, parameters, symbol_of
from scanbench.language.reading import Reading
from scanbench.syntax import tree
from scanbench.syntax.chunks import Chunk
from scanbench.syntax.source import Stretch

COUNTING = re.compile(r"IN\d+")
"""The name of a parameter that says no more than its place."""


@dataclass(frozen=True, slots=True)
class Hint:
    position: int
    """Of the argument, in its file."""
    name: str


def hints(reading: Reading, file: str, start: int, end: int) -> list[Hint]:
    """Those of a stretch of a file. None where there is one parameter only, or the names only count (`MAX(IN1, IN2)`), and none
    for an argument that has the name of its parameter."""
    found: list[Hint] = []
    for chunk in reading.files[file].chunks:
        if chunk.start < end and start < chunk.end:
            for call in calls(chunk, start - chunk.start, end - chunk.start):
                found += _of_call(reading, chunk, call)
    return sorted((each for each in found if start <= each.position < end), key=lambda each: each.position)


def _of_call(reading: Reading, chunk: Chunk, call: tree.Call) -> Iterator[Hint]:
    given = [each for each in call.arguments if each.name is None]
    symbol, callee = symbol_of(reading, call) if given else None, call.callee.span
    if symbol is None or not isinstance(callee, Stretch):
        return
    names = parameters(reading, symbol, len(given))
    if len(names) < 2 or all(COUNTING.fullmatch(each) for each in names):
        return
    for argument, name in zip(given, names, strict=False):
        if isinstance(argument.span, Stretch) and not _is_named(argument.value, name):
            yield Hint(chunk.start + _first(chunk.source.text, argument.span.start, callee.end), name)


def _is_named(value: tree.Expression | None, name: str) -> bool:
    """Whether the argument is a variable of this name."""
    return isinstance(value, tree.Name | tree.MemberOf) and value.name.upper() == name.upper()


def _first(text: str, start: int, callee: int) -> int:
    """Where an argument begins: with the parentheses around its first operand, but without the one of the call. The text is asked
    and not its tokens, which would have to be found again after each change."""
    opening, first = text.find("(", callee), start
    for at in range(start - 1, opening, -1):
        if text[at] == "(":
            first = at
        elif not text[at].isspace():
            break
    return first
