"""References to a variable: `REF(x)`, `ADR(x)`, and a variable where one is wanted."""

from scanbench.check.body.allowed import allowed
from scanbench.check.body.context import Body
from scanbench.check.body.places import VARIABLES
from scanbench.check.body.references import reference_type
from scanbench.check.body.targets import note_written, writable
from scanbench.check.dialect import Allowance
from scanbench.problems import Span
from scanbench.program.program import Base, RefOf
from scanbench.program.shown import shown
from scanbench.program.types import ArrayType, Member, OpenArray, Record, Section
from scanbench.syntax import tree


def _read(body: Body, member: Member, node: tree.Expression) -> bool:
    """Whether a pointer may lead to what is CONSTANT: a VAR_IN_OUT, which is a variable of whoever calls, or a whole structure or array."""
    used = f"`{member.name}` is CONSTANT, and could be written through this pointer"
    placed = member.section is Section.IN_OUT or isinstance(member.type, Record | ArrayType)
    return placed and allowed(body, Allowance.LOCAL_ADDRESSES, node.span, used)


def refer(body: Body, node: tree.Expression, pointer: bool = False, passing: bool = False) -> RefOf:
    """A reference to the variable; not to one that is gone after the call, unless it is only passed to what is called."""
    if not isinstance(node, VARIABLES):
        raise body.report.reject("T013", "Only a variable can be referred to.", node.span)
    place, member = body.place(node)
    if member is not None and member.constant and not (pointer and _read(body, member, node)):
        raise body.report.reject("T013", f"`{member.name}` is a CONSTANT and cannot be referred to.", node.span)
    if place.base is Base.FRAME and place.slot is None and place.reference is None:
        if not passing and not allowed(body, Allowance.LOCAL_ADDRESSES, node.span, f"`{shown(node)}` is temporary"):
            raise body.report.reject(
                "T013",
                f"`{shown(node)}` is temporary, gone when this call ends; declare it in VAR of a block.",
                node.span,
            )
        assert body.pou is not None
        body.pou.addressed = True
    if isinstance(place.type, OpenArray):
        raise body.report.reject("T013", "An ARRAY[*] cannot be referred to; refer to an element.", node.span)
    note_written(body, node, may_read=True)
    how = " What is referred to could be written: pass its value, or pass it to a VAR_IN_OUT CONSTANT."
    writable(body, place, node.span, how)
    return RefOf(place, reference_type(place.type, pointer))


def addressed(body: Body, node: tree.Expression, span: Span) -> tree.Expression:
    """What comes after `&`, where the dialect has that."""
    if not allowed(body, Allowance.ADDRESS_OPERATOR, span, f"`&{shown(node)}` is an address", f"`REF({shown(node)})`"):
        raise body.report.reject(
            "S003", f"`&` joins two operands; the address of a variable is `REF({shown(node)})`.", span
        )
    return node
