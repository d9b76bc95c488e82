"""Inputs of the type ANY, as CODESYS has them: the address, the size and the class of the type of the variable that is passed."""

from scanbench.check.body.allowed import used
from scanbench.check.body.coercion import as_type, coerce
from scanbench.check.body.context import Body
from scanbench.check.body.places import VARIABLES, inside
from scanbench.check.body.referring import refer
from scanbench.check.dialect import Allowance
from scanbench.program.program import Assign, Const, Expr, Load, Sequence
from scanbench.program.shown import shown
from scanbench.program.types import (
    DINT,
    ArrayType,
    Elementary,
    Enumeration,
    Record,
    Reference,
    StringType,
    Subrange,
    Type,
)
from scanbench.syntax import tree

ANY = "__SYSTEM.ANYTYPE"
"""The structure that such an input is."""
CLASSES = {"DATE_AND_TIME": "DATEANDTIME", "TIME_OF_DAY": "TIMEOFDAY"}
"""Of elementary types with a different name there."""


def is_any(type: Type) -> bool:
    """Whether an input has this type."""
    return isinstance(type, Record) and type.name.upper() == ANY


def any_of(body: Body, node: tree.Expression, type: Record, what: str) -> Expr:
    """What the input `what` is given for this variable; one that is such an input itself is passed on."""
    if not isinstance(node, VARIABLES):
        raise body.report.reject("T005", f"{what} is ANY and needs a variable.", node.span)
    mark = body.report.mark()
    given = body.place(node)[0].type
    body.report.undo(mark)
    if given == type:
        return as_type(body, node, type, what)
    used(
        body,
        Allowance.ANY_INPUTS,
        node.span,
        f"{what} is ANY, and is given the address of `{shown(node)}`",
        "a VAR_IN_OUT",
    )
    place = body.temporary(type, node.span)
    members = type.members
    class_, pointer, size = (members[name] for name in ("TYPECLASS", "PVALUE", "DISIZE"))
    assert isinstance(class_.type, Enumeration)
    number = class_.type.number(f"TYPE_{_class_of(given)}")
    if isinstance(given, StringType):
        raise body.report.reject(
            "T002",
            f"{what} is ANY; a {given} cannot be passed, as its bytes are not those of {body.dialect.title}.",
            node.span,
        )
    if number is None:
        why = f"{what} is ANY; which class {given} has in {body.dialect.title} is not documented."
        raise body.report.reject("T002", why, node.span)
    address = coerce(body, refer(body, node, pointer=True), pointer.type, node.span, what)
    values = ((class_, Const(class_.type, number)), (pointer, address), (size, Const(DINT, given.size)))
    stores = tuple(Assign(inside(place, type, member), value, node.span) for member, value in values)
    return Sequence(stores, Load(place))


def _class_of(type: Type) -> str:
    match type:
        case Enumeration():
            return "ENUM"
        case Subrange():
            return "SUBRANGE"
        case Reference():
            return "POINTER"
        case ArrayType():
            return "ARRAY"
        case Record():
            return "USERDEF"
        case Elementary():
            return CLASSES.get(type.name, type.name)
    return ""
