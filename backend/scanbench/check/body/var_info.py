"""`__VARINFO(x)` of vendors: the structure `__SYSTEM.VAR_INFO` with what is known of a variable."""

from scanbench.check.body import fold
from scanbench.check.body.allowed import used
from scanbench.check.body.any_inputs import class_of, is_different
from scanbench.check.body.context import Body
from scanbench.check.body.places import VARIABLES, inside
from scanbench.check.body.referring import refer
from scanbench.check.dialect import Allowance
from scanbench.program.program import Assign, Base, Const, Expr, Load, Place, Sequence
from scanbench.program.shown import shown
from scanbench.program.types import (
    ELEMENTARY,
    ULINT,
    ArrayType,
    Elementary,
    Enumeration,
    Record,
    StringType,
    Subrange,
    Type,
)
from scanbench.syntax import tree

INFO = "__SYSTEM.VAR_INFO"
DWORD = ELEMENTARY["DWORD"]
LOCAL = -1
"""`Area` of what belongs to an instance or a call; the memory of a PLC is one area here, 0."""


def var_info(body: Body, node: tree.Call) -> Expr:
    """The structure, filled in when the statement runs."""
    values = [each.value for each in node.arguments if each.name is None and each.value is not None]
    if len(values) != 1 or len(node.arguments) != 1 or not isinstance(values[0], VARIABLES):
        raise body.report.reject("T004", "`__VARINFO` takes one variable.", node.span)
    if body.pou is None:
        raise body.report.reject("X001", "`__VARINFO` is no constant; assign it in the body.", node.span)
    key = body.declarations.find_type(INFO, node.span)
    record = None if key is None else body.declarations.named(INFO, node.callee.span)
    if not isinstance(record, Record):
        raise body.report.reject(
            "X001", "`__VARINFO` needs the library `__SYSTEM`; add it to the project.", node.callee.span
        )
    used(body, Allowance.VENDOR_OPERATORS, node.callee.span, "`__VARINFO` tells of a variable", "its declaration")
    variable = values[0]
    place, _ = body.place(variable)
    if is_different(place.type) or place.indices:
        what = (
            "an element with a computed index"
            if place.indices
            else f"{place.type}, whose bytes are not those of {body.dialect.title}"
        )
        raise body.report.reject("T002", f"`__VARINFO` does not tell of {what}.", variable.span)
    told = _told(body, place, variable, record)
    made = body.temporary(record, node.span)
    stores = tuple(Assign(inside(made, record, record.members[name]), value, node.span) for name, value in told.items())
    return Sequence(stores, Load(made))


def _told(body: Body, place: Place, variable: tree.Expression, record: Record) -> dict[str, Expr]:
    """By member; what has no meaning for the variable is 0 or empty, as documented."""
    address = fold.convert(DWORD, fold.convert(ULINT, refer(body, variable, pointer=True)))
    local = _is_local(body, place)
    array = place.type if isinstance(place.type, ArrayType) else None
    element = array.element if array else None
    while isinstance(element, ArrayType):
        element = element.element
    bits = 1 if place.bit is not None else 8 * place.type.size
    return {
        "BYTEADDRESS": address,
        "BYTEOFFSET": Const(DWORD, place.offset) if local else address,
        "AREA": _number(record, "AREA", LOCAL if local else 0),
        "BITNR": _number(record, "BITNR", -1 if place.bit is None else place.bit),
        "BITSIZE": _number(record, "BITSIZE", bits),
        "BITADDRESS": _number(record, "BITADDRESS", _bit_address(body, place)),
        "TYPECLASS": _class(body, record, "TYPECLASS", place.type, variable),
        "TYPENAME": _text(record, "TYPENAME", _name(place.type)),
        "NUMELEMENTS": _number(record, "NUMELEMENTS", array.size // element.size if array and element else 0),
        "BASETYPECLASS": _class(body, record, "BASETYPECLASS", element, variable),
        "ELEMBITSIZE": _number(record, "ELEMBITSIZE", 8 * element.size if element else 0),
        "SYMBOL": _text(record, "SYMBOL", shown(variable)),
    }


def _is_local(body: Body, place: Place) -> bool:
    """Whether its place counts from an instance or a call, and not from the beginning of the memory."""
    of_block = body.pou is not None and body.pou.kind != "program"
    return of_block and place.reference is None and (place.base is not Base.IMAGE or place.slot is not None)


def _bit_address(body: Body, place: Place) -> int:
    """Of a variable of %I, %Q or %M its bit, from the beginning of that area."""
    areas = body.declarations.areas
    if place.variable != "@" or place.slot is not None:
        return 0
    start = max((each for each in areas.values() if each <= place.offset), default=0)
    return 8 * (place.offset - start) + (place.bit or 0)


def _class(body: Body, record: Record, member: str, type: Type | None, variable: tree.Expression) -> Expr:
    wanted = record.members[member].type
    assert isinstance(wanted, Enumeration)
    number = 0 if type is None else wanted.number(f"TYPE_{class_of(type)}")
    if number is None:
        why = f"which class {type} has in {body.dialect.title} is not documented"
        raise body.report.reject("T002", f"`__VARINFO` does not tell of this: {why}.", variable.span)
    return Const(wanted, number)


def _number(record: Record, member: str, value: int) -> Expr:
    type = record.members[member].type
    assert isinstance(type, Elementary)
    return Const(type, value)


def _text(record: Record, member: str, text: str) -> Expr:
    type = record.members[member].type
    assert isinstance(type, StringType)
    return Const(type, text.encode("latin-1", "replace")[: type.capacity])


def _name(type: Type) -> str:
    """The documentation tells it of elementary types and of those that have a name."""
    if isinstance(type, Record | Enumeration) and not type.name.startswith(("(", "STRUCT of ")):
        return type.name
    return (
        type.name
        if isinstance(type, Elementary) and not isinstance(type, Subrange | Enumeration) and type.name in ELEMENTARY
        else ""
    )
