"""Inputs of the type ANY, as CODESYS has them: the address, the size and the class of the type of the variable that is passed."""

from scanbench.check.body.allowed import used
from scanbench.check.body.coercion import as_type, coerce
from scanbench.check.body.context import Body
from scanbench.check.body.generic import KINDS
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
    Kind,
    Member,
    Record,
    Reference,
    StringType,
    Subrange,
    Type,
)
from scanbench.syntax import tree

ANY = "__SYSTEM.ANYTYPE"
"""The structure that such an input is; those of ANY_NUM and the like extend it."""
CLASSES = {"DATE_AND_TIME": "DATEANDTIME", "TIME_OF_DAY": "TIMEOFDAY"}
"""Of elementary types with a different name there."""


def is_any(type: Type) -> bool:
    """Whether an input has this type."""
    return isinstance(type, Record) and (type.name.upper() == ANY or type.name.upper() in KINDS)


def any_of(body: Body, node: tree.Expression, type: Record, what: str) -> Expr:
    """What the input `what` is given for this variable; one that is such an input itself is passed on."""
    name = "ANY" if type.name.upper() == ANY else type.name.upper()
    if isinstance(node, tree.Call):  # what gives such an input itself
        mark = body.report.mark()
        result = body.call(node).type
        body.report.undo(mark)
        if result == type:
            return as_type(body, node, type, what)
    if not isinstance(node, VARIABLES):
        raise body.report.reject("T005", f"{what} is {name} and needs a variable.", node.span)
    mark = body.report.mark()
    given = body.place(node)[0].type
    body.report.undo(mark)
    if given == type:
        return as_type(body, node, type, what)
    place = body.temporary(type, node.span)
    passed: list[tuple[Member, Expr]]
    if isinstance(given, Record) and is_any(given) and name == "ANY":
        source = body.place(node)[0]
        passed = [(each, Load(inside(source, given, given.members[key]))) for key, each in type.members.items()]
    else:
        passed = _told(body, node, type, given, name, what)
    stores = tuple(Assign(inside(place, type, member), value, node.span) for member, value in passed)
    return Sequence(stores, Load(place))


def _told(
    body: Body, node: tree.Expression, type: Record, given: Type, name: str, what: str
) -> list[tuple[Member, Expr]]:
    """The members of such an input, for a variable of the type `given`."""
    class_, pointer, size = (type.members[key] for key in ("TYPECLASS", "PVALUE", "DISIZE"))
    assert isinstance(class_.type, Enumeration)
    number = class_.type.number(f"TYPE_{class_of(given)}")
    if given.kind not in KINDS[name]:
        raise body.report.reject("T002", f"{what} is {name}, and this is {given}.", node.span)
    if is_different(given):
        raise body.report.reject(
            "T002",
            f"{what} is {name}; {given} cannot be passed, as its bytes are not those of {body.dialect.title}.",
            node.span,
        )
    if number is None:
        why = f"{what} is {name}; which class {given} has in {body.dialect.title} is not documented."
        raise body.report.reject("T002", why, node.span)
    told = f"{what} is {name}, and is given the address of `{shown(node)}`"
    used(body, Allowance.ANY_INPUTS, node.span, told, "a VAR_IN_OUT")
    address = coerce(body, refer(body, node, pointer=True), pointer.type, node.span, what)
    return [(class_, Const(class_.type, number)), (pointer, address), (size, Const(DINT, given.size))]


def is_different(type: Type) -> bool:
    """Whether it is stored differently there: some strings begin with their length here, times and dates have 64 bits."""
    match type:
        case ArrayType():
            return is_different(type.element)
        case Record():
            return any(is_different(each.type) for each in type.members.values())
    return not type.zero if isinstance(type, StringType) else type.kind in (Kind.TIME, Kind.DATE)


def class_of(type: Type) -> str:
    """The name of a type's class there, after `TYPE_`; empty where it has none."""
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
        case StringType():
            return "STRING" if type.width == 1 else "WSTRING"
        case Elementary():
            return CLASSES.get(type.name, type.name)
    return ""
