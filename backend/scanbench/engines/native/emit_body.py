"""What the emitters of places, expressions and statements share while they emit the body of one POU."""

from collections.abc import Callable
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, TypeAlias

from scanbench.engines.native import inlining
from scanbench.engines.native.effects import Effects, plain
from scanbench.engines.native.emit_function import FunctionText, Value
from scanbench.engines.native.emit_module import ModuleText
from scanbench.engines.native.flavour import RUN, Flavour
from scanbench.engines.native.registers import Signature, registers, signature
from scanbench.program.program import Base, Expr, Place, Pou, Stmt
from scanbench.program.types import Elementary, Kind

if TYPE_CHECKING:
    from collections.abc import Iterator

    from scanbench.engines.native.emit_strings import Piece

SCRATCH_LIMIT = 64 << 20
"""Bytes that the temporaries of all POUs of a program may take."""


class TooLarge(ValueError):
    """The temporaries of the program take more memory than they may."""


Evaluate: TypeAlias = "Callable[[Body, Expr], Value]"
Pieces: TypeAlias = "Callable[[Body, Expr], list[Piece]]"
Run: TypeAlias = "Callable[[Body, tuple[Stmt, ...]], None]"
CounterKey: TypeAlias = tuple[Base, int, Kind, int]


@dataclass(slots=True)
class Unit:
    """One module under way, and what is known of all POUs."""

    module: ModuleText = field(default_factory=ModuleText)
    effects: Effects = field(default_factory=Effects)
    names: dict[Pou, str] = field(default_factory=dict)
    """A name of its own for every POU of the program."""
    mentioned: dict[Pou, None] = field(default_factory=dict)
    """The POUs whose code is in the module or called by it."""
    image_size: int = 0
    """What lies in the image, an in-out may refer to."""
    state_size: int = 0
    """What lies in the state, a reference may refer to."""
    scratch: int = 0
    """Bytes of temporaries, up to now."""
    signatures: dict[Pou, Signature] = field(default_factory=dict)
    flavour: Flavour = RUN
    pieces: int = 0
    """Pieces of divided bodies, up to now."""

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
        self.mentioned[pou] = None
        return f'@"p.{self.names[pou]}"'

    def has(self, pou: Pou) -> bool:
        """Whether it is a POU of the program, with numbers of sites of its own."""
        return pou in self.names

    def registers(self, pou: Pou) -> dict[int, str]:
        """The frame variables of the POU that may be registers."""
        return {} if self.flavour.whole_image else registers(pou, self.flavour.looks(pou))

    def signature(self, pou: Pou) -> Signature:
        """How the FUNCTION is called."""
        known = self.signatures.get(pou)
        if known is None:
            known = self.signatures[pou] = signature(pou, self.registers(pou))
        return known


@dataclass(frozen=True, slots=True)
class Self:
    """The instance that Base.SELF counts from."""

    pointer: str
    offset: str


@dataclass(frozen=True, slots=True)
class Farthest:
    """How far above its lower bound the value of a check was at most in the rounds of a loop: a variable of the stack."""

    pointer: str
    type: str
    most: str
    """It may be so far."""


def counter_key(place: Place) -> CounterKey:
    """Names the bytes and how they are read: other places may see the same bytes as something else."""
    size = place.type.size if isinstance(place.type, Elementary) else 0
    return place.base, place.offset, place.type.kind, size


class Body:
    """Context of one POU's body: the function under way and what names mean in it."""

    image = "%img"

    def __init__(
        self,
        unit: Unit,
        pou: Pou,
        text: FunctionText,
        scalar: Evaluate,
        pieces: Pieces,
        run: Run,
        divided: bool | None = None,
    ) -> None:
        self.unit = unit
        self.module = unit.module
        self.pou = pou
        self.text = text
        self.self = Self("%me", "%self")
        self.registers: dict[int, str] = {}
        """Stack variables of frame offsets."""
        self.bound: set[int] = set()
        """Frame offsets of slots whose reference the caller has checked, and that nothing changes."""
        self.instance_offset = "0" if pou.kind == "function" else "%self"
        """Of the instance whose body this is, 0 in a FUNCTION."""
        self.counters: dict[CounterKey, Value] = {}
        """Loop variables that hold a known value here."""
        self.exits: list[str] = []
        """Blocks that EXIT goes to, innermost last."""
        self.rounds: list[str] = []
        """Blocks that CONTINUE goes to, innermost last."""
        self.labels: list[str] = []
        """Blocks that a `Jump` goes to, by number."""
        self.leave = "leave"
        """Block that RETURN goes to."""
        self.site: int | None = None
        """Observed code: the site of the statement that is being emitted, or of the statement around it, if there is one."""
        self.frame = "%frame"
        """Debugged code: what is known of the run of this body."""
        self.idle = ""
        """Debugged code: whether the loop around has not run a round yet."""
        self.farthest: list[Farthest] | None = None
        """In a loop whose checks are recorded later: what they note."""
        self.optimistic = False
        """Whether that loop runs as if nothing were outside, and once more if something was."""
        self.divided = inlining.divided(pou) and unit.flavour is RUN if divided is None else divided
        """Whether lists of statements are emitted in pieces."""
        self._swallowed = 0
        self._scalar = scalar
        self._pieces = pieces
        self._run = run

    def inside(self, text: FunctionText) -> "Body":
        """What a piece of this body is emitted in."""
        return Body(self.unit, self.pou, text, self._scalar, self._pieces, self._run, divided=False)

    def swallow(self, callee: Pou) -> str:
        """The attribute of a call: a body takes up so much of the standard library, and no more."""
        if not callee.inline:
            return ""
        self._swallowed += inlining.size(callee.body)
        return " noinline" if self._swallowed > inlining.MOST_SWALLOWED else ""

    def scalar(self, expr: Expr) -> Value:
        """The value of an elementary expression."""
        return self._scalar(self, expr)

    def pieces(self, expr: Expr) -> "list[Piece]":
        """The value of a STRING expression, as pieces to be joined."""
        return self._pieces(self, expr)

    def run(self, statements: tuple[Stmt, ...]) -> None:
        """Emits statements."""
        self._run(self, statements)

    def counter(self, place: Place) -> Value | None:
        """The value of the place, when it is a loop variable that only its loop writes."""
        if not self.counters or not plain(place):
            return None
        return self.counters.get(counter_key(place))

    @contextmanager
    def instance(self, inner: Self) -> "Iterator[None]":
        """Meanwhile Base.SELF counts from the instance `inner`."""
        outer, counters = self.self, self.counters
        self.self, self.counters = inner, {}
        try:
            yield
        finally:
            self.self, self.counters = outer, counters
