"""What a random program is drawn from: chance, the names in sight, and what each ingredient adds."""

from collections.abc import Callable
from dataclasses import dataclass, field
from random import Random
from typing import TypeVar

T = TypeVar("T")

INTEGERS = ("SINT", "INT", "DINT", "LINT", "USINT", "UINT", "UDINT", "ULINT")
BITS = ("BYTE", "WORD", "DWORD", "LWORD")
REALS = ("REAL", "LREAL")
TEXT = "STRING[12]"
TYPES = (TEXT, *INTEGERS, *BITS, *REALS, "BOOL", "TIME")
"""Strings come first, as they do in the block `Inner`: so are they at the same offsets of two instances."""
WIDTH = {"SINT": 8, "INT": 16, "DINT": 32, "LINT": 64, "USINT": 8, "UINT": 16, "UDINT": 32, "ULINT": 64,
         "BYTE": 8, "WORD": 16, "DWORD": 32, "LWORD": 64}  # fmt: skip


class Draw(Random):
    """Chance, from a seed."""

    def one(self, *choices: T) -> T:
        return self.choice(choices)

    def of(self, choices: list[T]) -> T:
        return self.choice(choices)

    def likely(self, percent: int) -> bool:
        return self.randrange(100) < percent

    def subset(self, choices: dict[str, str], percent: int = 50) -> dict[str, str]:
        return {key: value for key, value in choices.items() if self.likely(percent)}


ExpressionMaker = Callable[["Draw", "Scope", int], str]
"""Takes the depth that is left."""
StatementMaker = Callable[["Draw", "Scope", int], str]


@dataclass(slots=True)
class Scope:
    """The names that a body may use, and what it may do with them beyond the common."""

    readable: dict[str, list[str]] = field(default_factory=dict)
    writable: dict[str, list[str]] = field(default_factory=dict)
    expressions: dict[str, list[ExpressionMaker]] = field(default_factory=dict)
    statements: list[StatementMaker] = field(default_factory=list)
    loops: bool = True
    """Whether the counters of `COUNTERS` are declared."""

    def add(self, type: str, *names: str, writable: bool = True) -> None:
        """Makes variables known."""
        self.readable.setdefault(type, []).extend(names)
        if writable:
            self.writable.setdefault(type, []).extend(names)

    def known(self, draw: Draw, *types: str) -> str:
        """One of the types, hardly ever one without a variable: constants alone are folded away."""
        named = [type for type in types if type in self.readable]
        return draw.of(named) if named and draw.likely(90) else draw.one(*types)

    def add_expression(self, type: str, *makers: ExpressionMaker) -> None:
        self.expressions.setdefault(type, []).extend(makers)


COUNTERS = "k0, k1, k2, w0, w1, w2 : INT; ku0, ku1, ku2 : USINT; ks0, ks1, ks2 : SINT;"
"""Of loops, by depth: FOR (k), and WHILE or REPEAT (w)."""


@dataclass(slots=True)
class Parts:
    """A program in the making."""

    draw: Draw
    main: Scope
    declarations: list[str] = field(default_factory=list)
    """Types, globals and POUs, before the program."""
    variables: list[str] = field(default_factory=list)
    """Of the program."""
    start: list[str] = field(default_factory=list)
    """Statements at the beginning of the program."""
    end: list[str] = field(default_factory=list)
    after: list[str] = field(default_factory=list)
    """Declarations after the program."""


Ingredient = Callable[[Parts], None]
"""Adds a feature of the language to a program: declarations, names, and what is done with them."""
