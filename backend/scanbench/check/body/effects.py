"""What the statements of a POU may do besides computing values."""

from scanbench.check.body import targets
from scanbench.check.body.context import Body
from scanbench.check.declare.names import LIBRARY
from scanbench.check.declare.scopes import place_of
from scanbench.check.uses import Symbol
from scanbench.problems import Span
from scanbench.program.program import Base, CallFunction, Expr, Place
from scanbench.program.types import Member, Section, Type


class PouEffects:
    """Temporaries in the frame, calls of the library, notes; `Effects` says what each method does."""

    checks = True

    def temporary(self, body: Body, type: Type, span: Span, name: str) -> Place:
        frame = body.scope.frame
        if frame is None:
            raise body.report.reject("D004", "A constant is needed here: a literal or a CONSTANT.", span)
        member = Member(f"${name}{len(frame.members)}", type, Section.TEMP, span, hidden=True)
        frame.place(member)
        frame.close()
        return place_of(member, Base.FRAME, frame, 0)

    def repeats(self, value: Expr) -> bool:
        return False

    def assignable(
        self, body: Body, place: Place, member: Member | None, span: Span, how: str = "", reader: Symbol | None = None
    ) -> None:
        targets.assignable(body, place, member, span, how, reader)

    def library(self, body: Body, name: str, args: tuple[Expr, ...]) -> Expr | None:
        functions = body.pous.functions
        callee = functions.get(f"{LIBRARY}.{name}") or functions.get(name)
        if callee is None or not callee.inline:
            return None
        body.pous.use(body.pou, callee)
        return CallFunction(callee, callee.result, args)

    def record(self, body: Body, span: Span) -> None:
        pass
