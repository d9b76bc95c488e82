"""Variables of a program that are called like something in a file of another tool."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from difflib import SequenceMatcher, get_close_matches

from scanbench.program.program import Program
from scanbench.program.types import ArrayType, Elementary, Record, StringType
from scanbench.symbols.symbols import Symbol, UnknownPath, members

MOST = 50_000
"""Variables that are looked at."""
MOST_ELEMENTS = 1024
"""Of one array."""
_ALIKE = 0.75
_PARTS = re.compile(r"[./|:\\!>]+|(?=\[)")
_NOISE = re.compile(r"[\s_\"'$%#-]+")
_PREFIX = re.compile(
    r"^(?:g_|gv_|l_|_)?(?:fb|di|ui|udi|si|usi|li|lr|dw|st|ar|gx|gb|gi|gr|gn|[abcdefhilnprstuwxz])(?=[A-Z_])"
)
"""The letters for the type that many put before a name: `bMotor`, `x_Motor`, `fbBelt`, `rLevel`."""
_DIGITS = re.compile(r"\d+")


@dataclass(frozen=True, slots=True)
class Like:
    """A variable, and how alike its name is: up to 1."""

    symbol: Symbol
    score: float


class Variables:
    """Those of a program that have a single value."""

    def __init__(self, program: Program) -> None:
        self._program = program
        self._by_name: dict[str, list[tuple[tuple[str, ...], Symbol]]] | None = None

    def like(self, name: str) -> list[Like]:
        """Those that end like it, or are alike, the most alike first."""
        parts = _parts(name)
        if not parts:
            return []
        known = self._known()
        found: dict[str, Like] = {}
        for last, alike in self._last(parts[-1], known):
            for path, symbol in known[last]:
                score = _score(parts, path, alike)
                before = found.get(symbol.path)
                if before is None or before.score < score:
                    found[symbol.path] = Like(symbol, score)
        return sorted(found.values(), key=lambda each: (-each.score, each.symbol.path))[:10]

    def _known(self) -> dict[str, list[tuple[tuple[str, ...], Symbol]]]:
        if self._by_name is None:
            self._by_name = {}
            for symbol in single_values(self._program):
                parts = _parts(symbol.path)
                self._by_name.setdefault(parts[-1], []).append((parts, symbol))
        return self._by_name

    def _last(self, name: str, known: dict[str, list[tuple[tuple[str, ...], Symbol]]]) -> Iterator[tuple[str, float]]:
        """Last parts of names that are the same, or alike, and how alike."""
        if name in known:
            yield name, 1.0
            return
        if name.startswith("["):
            return
        for each in get_close_matches(name, known, 5, _ALIKE):
            if _DIGITS.findall(each) == _DIGITS.findall(name):  # the first valve is not the second one
                yield each, SequenceMatcher(None, name, each).ratio()


def _score(column: tuple[str, ...], path: tuple[str, ...], alike: float) -> float:
    """1: the same. Parts at the end that are the same count, as a part of the one and of the other name."""
    same = 0
    for one, other in zip(reversed(column[:-1]), reversed(path[:-1]), strict=False):
        if one != other:
            break
        same += 1
    share = 0.25 * (1 + same) / len(path) + 0.15 * (1 + same) / len(column)
    return alike**2 * (0.6 + share)


def _parts(name: str) -> tuple[str, ...]:
    """`Application.PLC_PRG.fbBelt[2].bRun` is application, plcprg, belt, [2], run."""
    found = []
    for each in _PARTS.split(name):
        text = each.strip().strip('"')
        if text.startswith("["):
            found += [f"[{index.strip()}]" for index in text.strip("[]").split("][")]
        elif text:
            bare = _PREFIX.sub("", text) or text
            found.append(_NOISE.sub("", bare).lower() or text.lower())
    return tuple(found)


def single_values(program: Program) -> Iterator[Symbol]:
    """Single values that a column can be: without what is reached through an in-out, or is a constant."""
    waiting = list(reversed(members(program, "")))
    count = 0
    while waiting and count < MOST:
        symbol = waiting.pop()
        if symbol.slots or symbol.constant:
            continue
        if isinstance(symbol.type, Elementary | StringType):
            count += 1
            yield symbol
        elif isinstance(symbol.type, ArrayType | Record):
            try:
                waiting.extend(reversed(members(program, symbol.path)[:MOST_ELEMENTS]))
            except UnknownPath:
                continue
