"""The call that a position is in: its parameters, and which one comes next."""

import re
from dataclasses import dataclass

from scanbench.check.uses import Symbol
from scanbench.language.complete import call_around, formals
from scanbench.language.describe import describe
from scanbench.language.reading import Reading
from scanbench.language.standard import row_of
from scanbench.program.types import Section


@dataclass(frozen=True, slots=True)
class Signature:
    name: str
    parameters: tuple[str, ...]
    """`name : TYPE`, of an output `name => TYPE`."""
    active: int
    """Which parameter the position is at."""
    comment: str = ""

    @property
    def label(self) -> str:
        return f"{self.name}({', '.join(self.parameters)})"


def signature_at(reading: Reading, file: str, position: int) -> Signature | None:
    """None outside of calls, and where what is called has no parameters."""
    text, around = reading.text(file), reading.around(file, position)
    call = call_around(text, position)
    if call is None or around is None:
        return None
    callee, opened = call
    row = row_of(callee.upper())
    parameters: list[tuple[str, str, Section]] = []
    comment = ""
    if row is not None:
        parameters = [(name, name, Section.INPUT) for name in row.formals]
        told = describe(reading, Symbol("function", "", callee.upper()))
        comment = "" if told is None else told.comment
    elif (body := reading.body(around)) is not None:
        parameters = [
            (each.name, f"{each.name} {'=>' if each.section is Section.OUTPUT else ':'} {each.type}", each.section)
            for each, _ in formals(reading, body, around, callee)
        ]
    if not parameters:
        return None
    return Signature(
        callee, tuple(shown for _, shown, _ in parameters), _active(text[opened:position], parameters), comment
    )


def _active(given: str, parameters: list[tuple[str, str, Section]]) -> int:
    """The parameter whose name is written last, else the one that the number of commas comes to."""
    parts = _split(given)
    named = re.match(r"\s*(?:NOT\s+)?([^\W\d]\w*)\s*(?::=|=>)", parts[-1], re.IGNORECASE)
    if named is not None:
        name = named.group(1).upper()
        return next((at for at, each in enumerate(parameters) if each[0].upper() == name), 0)
    by_position = [at for at, each in enumerate(parameters) if each[2] is not Section.OUTPUT]
    at = min(len(parts), len(by_position)) - 1
    return by_position[at] if by_position else 0


def _split(text: str) -> list[str]:
    """The arguments so far: commas inside of parentheses and strings separate nothing."""
    parts, depth = [""], 0
    for char in re.sub(r"'(?:\$.|[^$'])*'", lambda match: "_" * len(match.group()), text):
        if char in "([":
            depth += 1
        elif char in ")]":
            depth -= 1
        if char == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += char
    return parts
