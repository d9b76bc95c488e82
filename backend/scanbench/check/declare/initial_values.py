"""Initial values -> the bytes that a fresh variable has in the image."""

import math
import struct
from contextlib import suppress
from dataclasses import replace

from scanbench.check.context import Rejected
from scanbench.check.declare.declarations import Afresh, Declarations, Given, StartExpression, StartReference
from scanbench.check.declare.start_references import Held, refers
from scanbench.check.dialect import Allowance
from scanbench.check.uses import variable_symbol
from scanbench.problems import Span
from scanbench.program.numbers import round_real
from scanbench.program.program import Const
from scanbench.program.shown import shown
from scanbench.program.strings import stored
from scanbench.program.types import (
    ArrayType,
    Elementary,
    Kind,
    Member,
    Record,
    Reference,
    Section,
    StringType,
    Type,
    initial_of,
)
from scanbench.syntax import tree
from scanbench.syntax.parse_initial import BY_ORDER


def with_references(declared: Declarations, value: tree.Initial, type: Type) -> tuple[bytes, list[Given]]:
    """The bytes of a variable of this type that starts with the value, what in it is bound or computed later, and the references that
    it gives up of what the type has."""
    around, declared.given = declared.given, []
    try:
        made = _image(declared, value, type)
        return made, Held(declared.start_references).changed(type, declared.given)
    finally:
        declared.given = around


def initial_image(declared: Declarations, value: tree.Initial, type: Type) -> bytes:
    """The same of what starts with no references."""
    made, given = with_references(declared, value, type)
    for each in given:
        if isinstance(each, StartExpression):
            declared.constant_of(each.node, each.type)  # tells what is wrong
        if not isinstance(each, Afresh):
            raise declared.report.reject(
                "D004", "This starts with NULL; assign the reference in the body.", each.node.span
            )
    if given:
        raise declared.report.reject(
            "D004", f"References in {type} have start values of their own; only a variable says others.", value.span
        )
    return made


def _image(declared: Declarations, value: tree.Initial, type: Type) -> bytes:
    match value:
        case tree.ArrayInit():
            return _array(declared, value, type)
        case tree.StructInit(parts=parts) if parts:
            return _parts(declared, value, type)
        case tree.StructInit():
            return _record(declared, value, type)
    if declared.in_body and isinstance(type, Reference):
        declared.given.append(StartExpression(0, type, value))
        return initial_of(type)
    if isinstance(type, Reference) and refers(declared, type, value):
        declared.given.append(StartReference(0, type, value))
        return initial_of(type)
    if _is_copied(declared, value, type):
        declared.given.append(StartExpression(0, type, value))
        return initial_of(type)
    if not isinstance(type, Elementary | StringType):
        example = "[1, 2, 3(0)]" if isinstance(type, ArrayType) else "(member := value)"
        raise declared.report.reject("D004", f"An initial value of {type} is written like {example}.", value.span)
    return _bytes(declared, value, type)


def _is_copied(declared: Declarations, value: tree.Initial, type: Type) -> bool:
    """Whether a structure or array starts as another one is, which is named."""
    whole = isinstance(type, ArrayType) or (isinstance(type, Record) and type.kind is Kind.STRUCT)
    allowed = Allowance.START_EXPRESSIONS in declared.dialect.allows or declared.in_body
    return whole and allowed and isinstance(value, tree.Name | tree.MemberOf | tree.IndexOf | tree.Call)


def _bytes(declared: Declarations, value: tree.Expression, type: Elementary | StringType) -> bytes:
    """Those of a constant; what is none is computed later, where the dialect has that."""
    if declared.in_body and not isinstance(value, tree.Literal):
        declared.given.append(StartExpression(0, type, value))
        return initial_of(type)
    if Allowance.START_EXPRESSIONS not in declared.dialect.allows or isinstance(value, tree.Literal):
        return encode(type, declared.constant_of(value, type))
    mark = declared.report.mark()
    try:
        return encode(type, declared.constant_of(value, type))
    except Rejected:
        declared.report.undo(mark)
        declared.given.append(StartExpression(0, type, value))
        return initial_of(type)


def _array(declared: Declarations, value: tree.ArrayInit, type: Type) -> bytes:
    if not isinstance(type, ArrayType):
        raise declared.report.reject("D004", f"A list of values initialises an array, not {type}.", value.span)
    element = type.element
    if len(type.bounds) > 1 and any(isinstance(item, tree.ArrayInit) for _, item in value.items):
        element = ArrayType(type.bounds[1:], type.element)
    total, given = type.count if element is type.element else type.bounds[0][1] - type.bounds[0][0] + 1, 0
    image = bytearray()
    for count_tree, item in (_counted(declared, *each) for each in value.items):
        count = 1 if count_tree is None else declared.constant_of(count_tree, None).value
        if not isinstance(count, int) or count < 0 or count > type.count:
            raise declared.report.reject("D004", f"{count!r} values do not fit {type}.", value.span)
        first = len(declared.given)
        made = _image(declared, item, element)
        inside = declared.given[first:]
        if any(isinstance(each, StartExpression) and each.property for each in inside):
            raise declared.report.reject(
                "D004", "A property of an element of an array is assigned in the body.", value.span
            )
        del declared.given[first:]
        for number in range(given, min(given + count, total) if inside else given):
            declared.given += [replace(each, offset=each.offset + number * element.size) for each in inside]
        given += count
        if given <= total:  # what is beyond is counted, but never made
            image += made * count
    if given > total:
        raise declared.report.reject("D004", f"{given} values do not fit {type}; at most {total}.", value.span)
    return bytes(image + initial_of(element) * (total - given))


def _counted(
    declared: Declarations, count: tree.Expression | None, item: tree.Initial
) -> tuple[tree.Expression | None, tree.Initial]:
    """`SIZE(0)` and `LIST.SIZE(0)` look like calls, and repeat a value where their name is a constant."""
    given = item.arguments[0] if count is None and isinstance(item, tree.Call) and len(item.arguments) == 1 else None
    if given is None or given.name is not None or given.value is None or not isinstance(item, tree.Call):
        return count, item
    mark = declared.report.mark()
    try:
        repeats = isinstance(declared.constant_of(item.callee, None).value, int)
    except Rejected:
        repeats = False
    declared.report.undo(mark)
    return (item.callee, given.value) if repeats else (count, item)


def _record(declared: Declarations, value: tree.StructInit, type: Type) -> bytes:
    if not isinstance(type, Record):
        raise declared.report.reject("D004", f"Values by member initialise a structure, not {type}.", value.span)
    image, named = bytearray(type.initial()), set[str]()
    for given, item, span in value.members:
        name = _by_order(declared, type, given, span) if given.startswith(BY_ORDER) else given
        if name.upper() in named:
            raise declared.report.reject("D004", f"`{name}` is given twice.", span)
        named.add(name.upper())
        if _is_property(declared, type, name) and isinstance(item, tree.Expression):
            declared.given.append(StartExpression(0, type, item, name))
            continue
        member = _member(declared, type, name, span, (Section.IN_OUT,))
        before = len(declared.given)
        _put(image, member.offset, member.bit, _inside(declared, item, member.type, member.offset, name))
        if member.bit is not None and any(isinstance(each, StartExpression) for each in declared.given[before:]):
            raise declared.report.reject(
                "D004", f"`{name}` shares its byte with others: its value is a constant here.", span
            )
    return bytes(image)


def _is_property(declared: Declarations, type: Record, name: str) -> bool:
    """Whether a block, or one that it extends, declares a property of this name, which the dialect starts with a value."""
    if Allowance.START_EXPRESSIONS not in declared.dialect.allows or name.upper() in type.members:
        return False
    above: Record | None = type
    while above is not None:
        pou = declared.block_trees.get(above.name.upper())
        if pou is not None and any(
            each.kind in ("get", "set") and each.name.upper() == name.upper() for each in pou.methods
        ):
            return True
        above = above.base
    return False


def _by_order(declared: Declarations, type: Record, given: str, span: Span) -> str:
    """The name of the member that is given by its place."""
    at = int(given[len(BY_ORDER) :])
    names = [each.name for each in type.members.values() if not each.hidden]
    if type.kind is not Kind.STRUCT or at >= len(names):
        raise declared.report.reject(
            "D004", f"`{type.name}` has {len(names)} members, and this is value {at + 1}.", span
        )
    return names[at]


def _inside(declared: Declarations, item: tree.Initial, type: Type, offset: int, name: str) -> bytes:
    """What is there in something larger, from this offset on."""
    first = len(declared.given)
    made = _image(declared, item, type)
    afresh: list[Given] = []
    if declared.start_references and isinstance(type, Reference | ArrayType | Record):
        afresh = [Afresh(offset, type)]
    moved = [
        replace(each, offset=each.offset + offset, name=each.name or name)
        if isinstance(each, StartReference)
        else replace(each, offset=each.offset + offset, property=f"{name}.{each.property}")
        if isinstance(each, StartExpression) and each.property
        else replace(each, offset=each.offset + offset)
        for each in declared.given[first:]
    ]
    declared.given[first:] = [*afresh, *moved]
    return made


def _member(declared: Declarations, type: Record, name: str, span: Span, without: tuple[Section, ...]) -> Member:
    """The member of this name, which has none of these sections."""
    member = type.members.get(name.upper())
    if member is None or member.section in without or member.located:
        if type.open or (type.name.upper(), name.upper()) in declared.broken:
            raise Rejected
        hint = declared.report.near(name, lambda: [each.name for each in type.members.values()], f"member:{type.name}")
        raise declared.report.reject("D004", f"`{type.name}` has no `{name}` to initialise.{hint}", span)
    declared.report.use(span, name, variable_symbol(member, type))
    declared.report.written.append(span)
    return member


def _put(image: bytearray, offset: int, bit: int | None, data: bytes) -> None:
    if bit is None:
        image[offset : offset + len(data)] = data
    else:
        image[offset] = image[offset] & ~(1 << bit) | data[0] << bit


def _parts(declared: Declarations, value: tree.StructInit, type: Type) -> bytes:
    image = bytearray(initial_of(type))
    for target, item in value.parts:
        with suppress(Rejected):  # it is told; so are the others
            offset, bit, part = _part(declared, target, type)
            _put(image, offset, bit, _inside(declared, item, part, offset, shown(target)))
    return bytes(image)


def _part(declared: Declarations, node: tree.Expression, type: Type) -> tuple[int, int | None, Type]:
    """Where in a variable of this type a part is, the bit if it is one, and the type of the part."""
    match node:
        case tree.Name(name=name, span=span):
            offset, owner = 0, type
        case tree.MemberOf(owner=of, name=name, span=span):
            offset, _, owner = _part(declared, of, type)
        case tree.IndexOf(array, indices, span):
            offset, _, owner = _part(declared, array, type)
            return _element(declared, owner, offset, indices, span)
        case _:
            raise declared.report.reject("D004", "This is no part that has a start value.", node.span)
    if not isinstance(owner, Record):
        raise declared.report.reject("D004", f"{owner} has no members; `{name}` is not among them.", span)
    member = _member(declared, owner, name, span, (Section.IN_OUT,))
    return offset + member.offset, member.bit, member.type


def _element(
    declared: Declarations, array: Type, offset: int, indices: tuple[tree.Expression, ...], span: Span
) -> tuple[int, None, Type]:
    if not isinstance(array, ArrayType) or len(indices) != len(array.bounds):
        raise declared.report.reject("D004", f"{array} has no element of {len(indices)} indices.", span)
    for dimension, (index, (low, high)) in enumerate(zip(indices, array.bounds, strict=True)):
        number = declared.constant_of(index, None).value
        if not isinstance(number, int) or not low <= number <= high:
            raise declared.report.reject("D004", f"The index {number!r} is outside of {low}..{high}.", index.span)
        offset += (number - low) * array.stride(dimension)
    return offset, None, array.element


def encode(type: Elementary | StringType, constant: Const) -> bytes:
    """The bytes of a constant in the image."""
    value = constant.value
    if isinstance(type, StringType):
        assert isinstance(value, bytes)
        return stored(type, value[: type.capacity * type.width]).ljust(type.size, b"\0")
    if type.kind is Kind.REAL:
        number = round_real(float(value), type)
        return struct.pack("<f" if type.size == 4 else "<d", math.nan if math.isnan(number) else number)
    return int(value).to_bytes(type.size, "little", signed=type.signed)
