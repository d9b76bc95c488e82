"""Values of tags and types, as L5X writes them (`Decorated`) -> start values."""

import re
from collections.abc import Iterable, Iterator
from itertools import groupby

from scanbench.syntax.l5x.names import name_of
from scanbench.syntax.xml_tree import Element, attribute, child, children, kind, text_of

BITS = {"SINT": 8, "INT": 16, "DINT": 32, "LINT": 64}
"""Of the signed integers, which L5X may write by their bits: `16#ffff_fffe` is -2."""
_BASED = re.compile(r"(\d+)#([0-9A-Fa-f_]+)$")
_NUMBER = re.compile(r"[-+]?\d+$")
_REAL = re.compile(r"[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?$")
_PLAIN = re.compile(r"'(?:[^'$]|\$.)*'$")


def start_value(node: Element | None) -> str:
    """Of a tag or parameter, from its data; empty where it has none that says more than zero."""
    data = next(
        (each for each in children(node, "Data", "DefaultData") if attribute(each, "Format") == "Decorated"), None
    )
    inner = next(children(data), None)
    return "" if inner is None else _value(inner)


def _value(node: Element) -> str:
    """A value, an array or a structure; empty where all of it is zero."""
    match kind(node):
        case "DataValue" | "DataValueMember":
            return _simple(attribute(node, "DataType"), attribute(node, "Value") or text_of(node))
        case "Array" | "ArrayMember":
            return _array(node)
        case "Structure" | "StructureMember":
            return _text(node) if _is_text(node) else _structure(node)
    return ""


def _simple(type: str, written: str) -> str:
    written = written.strip()
    based = _BASED.match(written)
    if based is not None or _NUMBER.match(written):
        number = _integer(based[2], int(based[1])) if based is not None else int(written)
        bits = BITS.get(type.upper(), 0)
        if bits and number >= 1 << bits - 1:
            number -= 1 << bits
        if type.upper() in ("REAL", "LREAL"):
            return f"{number}.0" if number else ""
        return str(number) if number else ""
    if _REAL.match(written) and type.upper() in ("REAL", "LREAL"):
        return _real(written)
    return ""


def _integer(digits: str, base: int) -> int:
    try:
        return int(digits.replace("_", ""), base)
    except ValueError:  # of no number of that base
        return 0


def _real(written: str) -> str:
    """A literal of the standard, which has a point."""
    number = float(written)
    if not number:
        return ""
    mantissa, e, exponent = written.lower().partition("e")
    mantissa += "" if "." in mantissa else ".0"
    return f"{mantissa}{e}{exponent}"


def _array(node: Element) -> str:
    type = attribute(node, "DataType")
    values = [
        _value(inner) if (inner := next(children(each), None)) is not None else _simple(type, attribute(each, "Value"))
        for each in children(node, "Element")
    ]
    while values and not values[-1]:
        values.pop()  # the rest is zero
    if not values:
        return ""
    zero = _zero(next(children(node, "Element"), None), type)
    return f"[{', '.join(_repeated(each or zero for each in values))}]"


def _zero(node: Element | None, type: str) -> str:
    """The zero of an element of an array, or of a member: of a structure it is enough to name one."""
    structure = child(node, "Structure") if child(node, "Structure") is not None else node
    first = next(children(structure, "DataValueMember", "ArrayMember", "StructureMember"), None)
    if first is None:
        return "0.0" if type.upper() in ("REAL", "LREAL") else "0"
    inner = _zero(first, attribute(first, "DataType"))
    return f"({name_of(attribute(first, 'Name'))} := {f'[{inner}]' if kind(first) == 'ArrayMember' else inner})"


def _repeated(values: Iterable[str]) -> Iterator[str]:
    for value, same in groupby(values):
        times = sum(1 for _ in same)
        yield value if times == 1 else f"{times}({value})"


def _structure(node: Element) -> str:
    members = (
        (attribute(each, "Name"), _value(each))
        for each in children(node, "DataValueMember", "ArrayMember", "StructureMember")
    )
    said = ", ".join(f"{name_of(name)} := {value}" for name, value in members if value)
    return f"({said})" if said else ""


def _characters(node: Element) -> Element | None:
    return next((each for each in children(node, "DataValueMember") if attribute(each, "Name") == "DATA"), None)


def _is_text(node: Element) -> bool:
    return attribute(_characters(node), "Radix") == "ASCII"


def _text(node: Element) -> str:
    """A string, whose characters are numbers: its length, and what it has."""
    written = text_of(_characters(node)).strip()
    if not _PLAIN.match(written) or written == "''":
        return ""
    codes = list(_codes(written[1:-1]))
    return f"(LEN := {len(codes)}, DATA := [{', '.join(map(str, codes))}])"


_ESCAPES = {"$": 36, "'": 39, "L": 10, "N": 13, "P": 12, "R": 13, "T": 9}


def _codes(text: str) -> Iterator[int]:
    """The characters as SINT: `$0D` is 13, and above 127 they are negative."""
    at = 0
    while at < len(text):
        code = ord(text[at])
        if text[at] == "$" and re.match(r"[0-9A-Fa-f]{2}", text[at + 1 : at + 3]):
            code = int(text[at + 1 : at + 3], 16)
            at += 2
        elif text[at] == "$" and at + 1 < len(text):
            code = _ESCAPES.get(text[at + 1].upper(), ord(text[at + 1]))
            at += 1
        at += 1
        yield code - 256 if code > 127 else code


def members_of(structure: Element) -> Iterator[tuple[str, str, str, Element]]:
    """Name, type, dimensions of the members that the data of a structure names, and their element."""
    for each in children(structure, "DataValueMember", "ArrayMember", "StructureMember"):
        yield attribute(each, "Name"), attribute(each, "DataType"), attribute(each, "Dimensions"), each


def structure_in(node: Element | None) -> Element | None:
    """The structure that the data of a tag is, also of an array of them."""
    data = next(
        (each for each in children(node, "Data", "DefaultData") if attribute(each, "Format") == "Decorated"), None
    )
    return child(data, "Structure") if child(data, "Array") is None else child(data, "Array", "Element", "Structure")
