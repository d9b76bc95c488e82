"""What the checks of one body share: where problems go, what names mean, what it may keep.

A `Body` is the text of one POU, a constant expression of a declaration, or a text that people type. The checks are functions over
it. Those that call each other in a circle do so through the callables that a Body is made with; `bodies.body_of` has them.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Protocol, TypeAlias

from scanbench.check.context import Rejected, Report
from scanbench.check.declare.declarations import Declarations
from scanbench.check.declare.scopes import Pous, Scope
from scanbench.check.dialect import Dialect
from scanbench.check.dialect_table import IEC
from scanbench.check.uses import Symbol
from scanbench.problems import Span
from scanbench.program.program import Const, Expr, Place, Pou
from scanbench.program.sites import CallSite, TrapKind
from scanbench.program.types import Member, Record, Type
from scanbench.syntax import tree

Found = tuple[Place, Member | None]
"""Where a variable lives, and the declared member it is (or is inside of)."""
Expression: TypeAlias = "Callable[[Body, tree.Expression, Type | None], Expr]"
Variable: TypeAlias = "Callable[[Body, tree.Expression], Found]"
Call: TypeAlias = "Callable[[Body, tree.Call, Type | None], Expr]"
Property: TypeAlias = "Callable[[Body, tree.Expression], Expr | None]"


@dataclass(frozen=True, slots=True)
class Truth:
    """The number that a value was before it wrapped into the variable that holds it, and the bounds of that number."""

    place: Place
    reach: tuple[int, int]


class Lookup(Protocol):
    """How names are understood. Every method but those that return None reports and raises `Rejected` where it finds nothing."""

    def variable(self, body: "Body", name: str, span: Span) -> Found:
        """The variable of this name."""

    def bit(self, body: "Body", node: tree.PartialAccess) -> Place | None:
        """`CIO0.00`, which reads like a bit of a variable, where it is an address."""

    def unknown(self, body: "Body", name: str, span: Span) -> Rejected:
        """Reports a name that means nothing here."""

    def inside(self, body: "Body", place: Place, record: Record, member: Member, span: Span) -> Place:
        """The place of a member of what lives at `place`."""

    def this(self, body: "Body", word: str, span: Span) -> Place:
        """Where the instance that THIS or SUPER means lives."""

    def this_trap(self, body: "Body") -> int:
        """The site of the trap where THIS refers to nothing."""

    def may_use(self, body: "Body", record: Record, member: Member) -> bool:
        """Whether the member of a block, which is not an input or output, may be used here."""

    def qualified_value(self, body: "Body", node: tree.MemberOf) -> Const | None:
        """`Color.RED`, when there is no variable of that name."""


class Effects(Protocol):
    """What the code that is made may do besides computing a value."""

    checks: bool
    """Whether checks of subranges are embedded, and notes; what people type only looks."""

    def temporary(self, body: "Body", type: Type, span: Span, name: str) -> Place:
        """A new hidden variable of the frame, for what must be kept inside a statement; it starts with anything."""

    def repeats(self, value: Expr) -> bool:
        """Whether a value may be read several times as it is, because nothing changes it meanwhile."""

    def assignable(
        self, body: "Body", place: Place, member: Member | None, span: Span, how: str = "", reader: Symbol | None = None
    ) -> None:
        """Refuses what cannot be assigned; `reader` is the in-out that it is passed to, which perhaps only reads it."""

    def library(self, body: "Body", name: str, args: tuple[Expr, ...]) -> Expr | None:
        """A call of a FUNCTION of the ST library, if there is one of that name."""

    def record(self, body: "Body", span: Span) -> None:
        """Refuses EN_CHECK where nothing may be recorded."""


@dataclass(slots=True)
class Body:
    """One body under check. Every function over it reports and raises `Rejected` where it cannot go on."""

    report: Report
    declarations: Declarations
    pous: Pous
    scope: Scope
    pou: Pou | None
    """None among declarations and for typed texts: there no subrange is checked."""
    lookup: Lookup
    effects: Effects
    _expression: Expression
    _place: Variable
    _call: Call
    _property: Property
    explicit: tuple[tree.Expression, ...] = ()
    """Arguments of calls with EN or ENO that are being checked."""
    counters: list[Place] = field(default_factory=list)
    followed: list[Place] = field(default_factory=list)
    """Those of `counters` that the body of their loop writes, too."""
    """Control variables of the FOR loops around."""
    loops: int = 0
    """Loops around."""
    final: int | None = None
    """Loops around where the innermost __FINALLY began; None outside of one."""
    labels: dict[str, int] = field(default_factory=dict)
    """Blocks of statements that begin with a label, by its name in upper case."""
    block: int = 0
    """The number of the block that is being checked."""
    unmade: set[str] = field(default_factory=set)
    """Wires, in upper case, whose lines were refused: what reads them is not wrong by itself."""
    peeked: list[Span] = field(default_factory=list)
    """Variables of blocks that can be read from outside by the dialect only; nobody writes them there."""
    chart: bool = False
    """Whether what is called is an action that a step of a chart names."""
    wide: dict[int, tuple[Expr, Expr]] = field(default_factory=dict)
    """By identity, values that were cut to their type, and what they were cut from; see `wide.py`."""
    bitwise: dict[int, tuple[Expr, int]] = field(default_factory=dict)
    """By identity, results of AND, OR, XOR and NOT in 32 or 64 bits, and the bytes of their operands; see `bitwise.py`."""
    truths: dict[int, Truth] = field(default_factory=dict)
    """By offset in the frame, what the current results of IL were before they wrapped; see `true_values.py`."""

    @property
    def dialect(self) -> Dialect:
        """What this text may do: the library is written in the strict language."""
        return IEC if self.pou is not None and self.pou.inline else self.declarations.dialect

    def calls_at(self, span: Span) -> int:
        """The number of a new call site."""
        return self.report.call(CallSite(span, self.scope.pou))

    def trap(self, kind: TrapKind, span: Span, message: str) -> int:
        """The number of a new trap site."""
        return self.report.trap(kind, span, self.scope.pou, message)

    def temporary(self, type: Type, span: Span, name: str = "t") -> Place:
        """A new hidden variable, for what must be kept inside a statement."""
        return self.effects.temporary(self, type, span, name)

    def expression(self, node: tree.Expression, wanted: Type | None = None) -> Expr:
        """The expression; literals may still be untyped. `wanted` helps a literal find its type."""
        return self._expression(self, node, wanted)

    def place(self, node: tree.Expression) -> Found:
        """The variable; of a REFERENCE TO, what it refers to."""
        return self._place(self, node)

    def call(self, node: tree.Call, wanted: Type | None = None) -> Expr:
        """A call for its value."""
        return self._call(self, node, wanted)

    def property_value(self, node: tree.Expression) -> Expr | None:
        """What reading the property gives; None when this is no property."""
        return self._property(self, node) if self.pous.classes.properties else None
