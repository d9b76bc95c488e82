"""Initial values -> the bytes that a fresh variable has in the image."""

import math
import struct

from scanbench.check.context import Rejected
from scanbench.check.declare.declarations import Declarations
from scanbench.check.uses import variable_symbol
from scanbench.program.numbers import round_real
from scanbench.program.program import Const
from scanbench.program.types import ArrayType, Elementary, Kind, Record, Section, StringType, Type, initial_of
from scanbench.syntax import tree


def initial_image(declared: Declarations, value: tree.Initial, type: Type) -> bytes:
    """The bytes of a variable of this type that starts with the value."""
    match value:
        case tree.ArrayInit():
            return _array(declared, value, type)
        case tree.StructInit():
            return _record(declared, value, type)
    if not isinstance(type, Elementary | StringType):
        example = "[1, 2, 3(0)]" if isinstance(type, ArrayType) else "(member := value)"
        raise declared.report.reject("D004", f"An initial value of {type} is written like {example}.", value.span)
    return encode(type, declared.constant_of(value, type))


def _array(declared: Declarations, value: tree.ArrayInit, type: Type) -> bytes:
    if not isinstance(type, ArrayType):
        raise declared.report.reject("D004", f"A list of values initialises an array, not {type}.", value.span)
    element = type.element
    if len(type.bounds) > 1 and any(isinstance(item, tree.ArrayInit) for _, item in value.items):
        element = ArrayType(type.bounds[1:], type.element)
    total, given = type.count if element is type.element else type.bounds[0][1] - type.bounds[0][0] + 1, 0
    image = bytearray()
    for count_tree, item in value.items:
        count = 1 if count_tree is None else declared.constant_of(count_tree, None).value
        if not isinstance(count, int) or count < 0 or count > type.count:
            raise declared.report.reject("D004", f"{count!r} values do not fit {type}.", value.span)
        made = initial_image(declared, item, element)
        given += count
        if given <= total:  # what is beyond is counted, but never made
            image += made * count
    if given > total:
        raise declared.report.reject("D004", f"{given} values do not fit {type}; at most {total}.", value.span)
    return bytes(image + initial_of(element) * (total - given))


def _record(declared: Declarations, value: tree.StructInit, type: Type) -> bytes:
    if not isinstance(type, Record):
        raise declared.report.reject("D004", f"Values by member initialise a structure, not {type}.", value.span)
    image = bytearray(type.initial())
    for name, item, span in value.members:
        member = type.members.get(name.upper())
        if member is None or member.section in (Section.IN_OUT, Section.OUTPUT) or member.located:
            if type.open or (type.name.upper(), name.upper()) in declared.broken:
                raise Rejected
            hint = declared.report.near(
                name, lambda: [each.name for each in type.members.values()], f"member:{type.name}"
            )
            raise declared.report.reject("D004", f"`{type.name}` has no `{name}` to initialise.{hint}", span)
        declared.report.use(span, name, variable_symbol(member, type))
        declared.report.written.append(span)
        data = initial_image(declared, item, member.type)
        if member.bit is None:
            image[member.offset : member.offset + len(data)] = data
        else:
            image[member.offset] = image[member.offset] & ~(1 << member.bit) | data[0] << member.bit
    return bytes(image)


def encode(type: Elementary | StringType, constant: Const) -> bytes:
    """The bytes of a constant in the image."""
    value = constant.value
    if isinstance(type, StringType):
        assert isinstance(value, bytes)
        text = value[: type.capacity * type.width]
        return ((len(text) // type.width).to_bytes(2, "little") + text).ljust(type.size, b"\0")
    if type.kind is Kind.REAL:
        number = round_real(float(value), type)
        return struct.pack("<f" if type.size == 4 else "<d", math.nan if math.isnan(number) else number)
    return int(value).to_bytes(type.size, "little", signed=type.signed)
