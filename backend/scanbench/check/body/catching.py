"""`__TRY .. __CATCH(exc) .. __FINALLY .. __ENDTRY` of vendors: what would stop the program goes on in the __CATCH."""

from collections.abc import Callable

from scanbench.check.body import targets
from scanbench.check.body.allowed import may, used
from scanbench.check.body.context import Body
from scanbench.check.dialect import Allowance
from scanbench.problems import Span
from scanbench.program.program import Assign, Load, Place, Stmt, Try
from scanbench.program.types import UDINT, Enumeration
from scanbench.syntax import tree

CODE = "__SYSTEM.EXCEPTIONCODE"
"""The type of what __CATCH has in parentheses."""
Block = Callable[[Body, tuple[tree.Statement, ...]], tuple[Stmt, ...]]


def try_statement(body: Body, node: tree.TryStatement, block: Block) -> Try:
    """The statement; `block` checks the statements inside of it."""
    if not may(body, Allowance.TRY):
        raise body.report.reject(
            "X001", "__TRY is not supported; check before you compute; a trap stops the PLC.", node.span
        )
    used(body, Allowance.TRY, node.span, "__TRY catches what would stop the program")
    inner = block(body, node.body)
    code = body.temporary(UDINT, node.span)
    caught: tuple[Stmt, ...] = ()
    if node.caught is not None:
        caught = (Assign(_variable(body, node.caught), Load(code), node.catch),)
    handler = (*caught, *block(body, node.handler))
    outer, body.final = body.final, body.loops
    final = block(body, node.final)
    body.final = outer
    return Try(inner, code, handler, final, node.span)


def _variable(body: Body, node: tree.Expression) -> Place:
    place = targets.target(body, node)
    type = place.type
    if not isinstance(type, Enumeration) or type.name.upper() != CODE:
        raise body.report.reject(
            "T002", f"__CATCH needs a variable of the type `__SYSTEM.ExceptionCode`, not {type}.", node.span
        )
    return place


def leaves(body: Body, word: str, span: Span, loops: int = 0) -> None:
    """Refuses what would leave a __FINALLY: what happens then is not documented. `loops` are those inside of which it may be."""
    if body.final is not None and loops <= body.final:
        raise body.report.reject("T009", f"{word} cannot leave a __FINALLY. Put it after the __ENDTRY.", span)
