"""What every part of the checker of one POU has: where problems go, what names mean, room for what must be kept."""

from abc import ABC, abstractmethod

from scanbench.check.context import Report
from scanbench.check.declare.declare import Declarations
from scanbench.check.declare.scopes import Pous, Scope, place_of
from scanbench.problems import Span
from scanbench.program.program import Base, Expr, Place, Pou, TrapKind
from scanbench.program.types import Member, Record, Reference, Section, Type
from scanbench.syntax import tree


class PouChecker(ABC):
    """Checks one POU. Every method reports and raises `Rejected` where it cannot go on."""

    def __init__(self, report: Report, declarations: Declarations, pous: Pous, scope: Scope, pou: Pou | None) -> None:
        self.report = report
        self.declarations = declarations
        self.pous = pous
        self.scope = scope
        self.pou = pou

    def trap(self, kind: TrapKind, span: Span, message: str) -> int:
        return self.report.trap(kind, span, self.scope.pou, message)

    def temporary(self, type: Type, span: Span, name: str = "t") -> Place:
        """A new hidden variable of the frame, for what must be kept inside a statement; it starts with anything."""
        frame = self.scope.frame
        if frame is None:
            raise self.report.reject("D004", "A constant is needed here: a literal or a CONSTANT.", span)
        member = Member(f"${name}{len(frame.members)}", type, Section.TEMP, span, hidden=True)
        frame.place(member)
        frame.close()
        return place_of(member, Base.FRAME, frame, 0)

    @abstractmethod
    def expr(self, node: tree.Expression, wanted: Type | None = None) -> Expr:
        """The expression; literals may still be untyped. `wanted` helps a literal find its type."""

    @abstractmethod
    def coerce(self, expr: Expr, type: Type, span: Span, what: str) -> Expr:
        """The value as one of `type`, widened where that loses nothing."""

    @abstractmethod
    def call(self, node: tree.Call, wanted: Type | None = None) -> Expr:
        """A call for its value; see `CallChecker`."""

    # ---- what later layers add, and earlier ones ask for ---------------------------------------------------

    @abstractmethod
    def self_place(self, name: str, span: Span) -> Place:
        """Where the instance that THIS or SUPER means lives; see `ObjectChecker`."""

    @abstractmethod
    def qualified_place(self, node: tree.MemberOf) -> tuple[Place, Member | None] | None:
        """A variable behind THIS, SUPER, or the name of a namespace or of a list of globals, if it is one."""

    @abstractmethod
    def accessor(self, node: tree.Expression) -> Expr | None:
        """The value of a property, if it is one; see `MethodChecker`."""

    @abstractmethod
    def as_interface(self, expr: Expr, type: Reference, span: Span) -> Expr | None:
        """A reference to an instance, where a variable of an interface that it implements wants one."""

    @abstractmethod
    def may_use(self, record: Record, member: Member) -> bool:
        """Whether this POU may use the member of a block, which is not an input or output."""
