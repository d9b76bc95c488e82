"""What a typed text may do: look at the program, and nothing else."""

from scanbench.check.body.context import Body
from scanbench.check.uses import Symbol
from scanbench.problems import Span
from scanbench.program.program import Convert, Expr, Load, Place
from scanbench.program.types import Member, Type

NOWHERE = Span("condition", 1, 1, 1, 1)


class Looking:
    """No temporaries, no code of the library, no records, no checks; `Effects` says what each method does."""

    checks = False

    def temporary(self, body: Body, type: Type, span: Span, name: str) -> Place:
        raise body.report.reject(
            "X001", "This would have to keep a value meanwhile, which a condition cannot: write AND and OR instead of "
            "AND_THEN and OR_ELSE (a trap counts as FALSE), and let the program compute the rest into a variable.", span,
        )  # fmt: skip

    def repeats(self, value: Expr) -> bool:
        return isinstance(value.operand if isinstance(value, Convert) else value, Load)

    def assignable(
        self, body: Body, place: Place, member: Member | None, span: Span, how: str = "", reader: Symbol | None = None
    ) -> None:
        # what a tool may write, whoever stores the value looks at
        if member is not None and member.constant:
            raise body.report.reject("T003", f"`{member.name}` is a CONSTANT and cannot be assigned.", span)

    def library(self, body: Body, name: str, args: tuple[Expr, ...]) -> Expr | None:
        raise body.report.reject(
            "X001", f"`{name}` is written in ST, and a condition runs no such code: store the result in a variable, and "
            "name that.", NOWHERE,
        )  # fmt: skip

    def record(self, body: Body, span: Span) -> None:
        raise body.report.reject("X001", "`EN_CHECK` records what it finds, and a condition only looks.", span)
