"""What the emitters of places, expressions and statements share while they emit the body of one POU."""

from collections.abc import Callable
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, TypeAlias

from scanbench.check.program import Base, Expr, Place, Pou
from scanbench.engines.native.effects import Effects
from scanbench.engines.native.emit_function import FunctionText, Value
from scanbench.engines.native.emit_module import ModuleText
from scanbench.engines.native.registers import Signature, signature

if TYPE_CHECKING:
    from collections.abc import Iterator

    from scanbench.engines.native.emit_strings import Piece

SCRATCH_LIMIT = 64 << 20
"""Bytes that the temporaries of all POUs of a program may take."""


class TooLarge(ValueError):
    """The temporaries of the program take more memory than they may."""


Evaluate: TypeAlias = "Callable[[Body, Expr], Value]"
Pieces: TypeAlias = "Callable[[Body, Expr], list[Piece]]"


@dataclass(slots=True)
class Unit:
    """One module under way, and what is known of all POUs."""

    module: ModuleText = field(default_factory=ModuleText)
    effects: Effects = field(default_factory=Effects)
    numbers: dict[Pou, int] = field(default_factory=dict)
    scratch: int = 0
    """Bytes of temporaries, up to now."""
    _signatures: dict[Pou, Signature] = field(default_factory=dict)

    def reserve(self, pou: Pou, name: str, size: int) -> None:
        """Memory for the temporaries of the POU's statements."""
        self.scratch += size
        if self.scratch > SCRATCH_LIMIT:
            raise TooLarge(
                f"{pou.name} needs {size} bytes for strings, arrays and structures inside of its largest statement; "
                f"all POUs together may use {SCRATCH_LIMIT}: use smaller types, or make several statements of it"
            )
        self.module.reserve(name, size)

    def symbol(self, pou: Pou) -> str:
        """The LLVM name of the POU's code."""
        number = self.numbers.setdefault(pou, len(self.numbers))
        name = "".join(c if c.isascii() and (c.isalnum() or c == "_") else "." for c in pou.name)
        return f'@"p.{name}.{number}"'

    def signature(self, pou: Pou) -> Signature:
        """How the FUNCTION is called."""
        known = self._signatures.get(pou)
        if known is None:
            known = self._signatures[pou] = signature(pou)
        return known


@dataclass(frozen=True, slots=True)
class Self:
    """The instance that Base.SELF counts from."""

    pointer: str
    offset: str


class Body:
    """Context of one POU's body: the function under way and what names mean in it."""

    image = "%img"

    def __init__(self, unit: Unit, pou: Pou, text: FunctionText, scalar: Evaluate, pieces: Pieces) -> None:
        self.unit = unit
        self.module = unit.module
        self.pou = pou
        self.text = text
        self.self = Self("%me", "%self")
        self.registers: dict[int, str] = {}
        """Stack variables of frame offsets."""
        self.counters: dict[tuple[Base, int], Value] = {}
        """Loop variables that hold a known value here."""
        self.exits: list[str] = []
        """Blocks that EXIT goes to, innermost last."""
        self.leave = "leave"
        """Block that RETURN goes to."""
        self._scalar = scalar
        self._pieces = pieces

    def scalar(self, expr: Expr) -> Value:
        """The value of an elementary expression."""
        return self._scalar(self, expr)

    def pieces(self, expr: Expr) -> "list[Piece]":
        """The value of a STRING expression, as pieces to be joined."""
        return self._pieces(self, expr)

    def counter(self, place: Place) -> Value | None:
        """The value of the place, when it is a loop variable that only its loop writes."""
        if not self.counters or place.slot is not None or place.indices or place.bit is not None:
            return None
        return self.counters.get((place.base, place.offset))

    @contextmanager
    def instance(self, inner: Self) -> "Iterator[None]":
        """Base.SELF counts from another instance meanwhile."""
        outer, counters = self.self, self.counters
        self.self, self.counters = inner, {}
        try:
            yield
        finally:
            self.self, self.counters = outer, counters
