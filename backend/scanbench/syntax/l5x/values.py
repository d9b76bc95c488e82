"""Values of tags and types, as L5X writes them (`Decorated`, and `String` of texts) -> start values."""

import re
from collections.abc import Iterable, Iterator
from itertools import groupby

from scanbench.syntax.l5x.names import name_of
from scanbench.syntax.xml_tree import Element, attribute, child, children, kind, text_of

BITS = {"SINT": 8, "INT": 16, "DINT": 32, "LINT": 64}
"""Of the signed integers, which L5X may write by their bits: `16#ffff_fffe` is -2."""
REALS = ("REAL", "LREAL")
_BASED = re.compile(r"(2|8|10|16)#([0-9A-Fa-f_]{1,80})")
_NUMBER = re.compile(r"[-+]?[0-9]{1,30}")
_REAL = re.compile(r"[-+]?[0-9]{1,400}(?:\.[0-9]{1,400})?(?:[eE][-+]?[0-9]{1,3})?")
_PLAIN = re.compile(r"'(?:[^'$]|\$.)*'", re.DOTALL)
_SIZE = re.compile(r"[0-9]{1,9}")


def sizes_of(written: str) -> list[int]:
    """The dimensions of an array: `2 3`, `2,3`; none where it is no array."""
    sizes = [int(each) for each in written.replace(",", " ").split() if _SIZE.fullmatch(each)]
    return [each for each in sizes if each > 0]


def start_value(node: Element, lost: list[str]) -> str:
    """Of a tag or parameter, from its data; empty where it has none that says more than zero.

    What is not understood is added to `lost`, as it is written.
    """
    texts = [each for each in children(node, "Data", "DefaultData") if attribute(each, "Format") == "String"]
    if texts:
        return _text(text_of(texts[0]), lost)
    data = _decorated(node)
    inner = next(children(data), None)
    if inner is None:
        for each in children(node, "Data", "DefaultData"):
            format = attribute(each, "Format")
            if format not in ("", "L5K") or re.search(r"[1-9]", text_of(each)):
                lost.append(format or "L5K")
        return ""
    return _Reader(lost).value(inner)


def _decorated(node: Element | None) -> Element | None:
    data = children(node, "Data", "DefaultData")
    return next((each for each in data if attribute(each, "Format") == "Decorated"), None)


class _Reader:
    """Reads one value, however deep."""

    def __init__(self, lost: list[str]) -> None:
        self._lost = lost

    def value(self, node: Element) -> str:
        """A value, an array or a structure; empty where all of it is zero."""
        match kind(node):
            case "DataValue" | "DataValueMember":
                return self._simple(attribute(node, "DataType"), attribute(node, "Value") or text_of(node))
            case "Array" | "ArrayMember":
                return self._array(node)
            case "Structure" | "StructureMember":
                characters = _characters(node)
                if attribute(characters, "Radix") == "ASCII":
                    return _text(text_of(characters), self._lost)
                return self._structure(node)
        return ""

    def _simple(self, type: str, written: str) -> str:
        written, upper = written.strip(), type.upper()
        number = integer(written)
        if number is None and upper in BITS and _PLAIN.fullmatch(written):
            # characters, the most significant byte first
            number = int.from_bytes(bytes(code & 0xFF for code in _codes(written[1:-1]))[-8:], "big")
        if number is not None:
            bits = BITS.get(upper, 0)
            if bits and number >= 1 << bits - 1:
                number -= 1 << bits
            if upper in REALS:
                return f"{number}.0" if number else ""
            return str(number) if number else ""
        if _REAL.fullmatch(written) and upper in REALS:
            return _real(written)
        if written:
            self._lost.append(written[:40])
        return ""

    def _array(self, node: Element) -> str:
        type = attribute(node, "DataType")
        values = [
            self.value(inner)
            if (inner := next(children(each), None)) is not None
            else self._simple(type, attribute(each, "Value"))
            for each in children(node, "Element")
        ]
        while values and not values[-1]:
            values.pop()  # the rest is zero
        if not values:
            return ""
        zero = _zero(next(children(node, "Element"), None), type)
        return f"[{', '.join(_repeated(each or zero for each in values))}]"

    def _structure(self, node: Element) -> str:
        members = (
            (attribute(each, "Name"), self.value(each))
            for each in children(node, "DataValueMember", "ArrayMember", "StructureMember")
        )
        said = ", ".join(f"{name_of(name)} := {value}" for name, value in members if value)
        return f"({said})" if said else ""


def integer(written: str) -> int | None:
    """The number that is written, `-5` or `16#00FF`; None for what is none."""
    based = _BASED.fullmatch(written)
    if based is None:
        return int(written) if _NUMBER.fullmatch(written) else None
    try:
        return int(based[2].replace("_", "") or "0", int(based[1]))
    except ValueError:  # digits of a larger base
        return None


def _real(written: str) -> str:
    """A literal of the standard, which has a point."""
    if not float(written):
        return ""
    mantissa, e, exponent = written.lower().partition("e")
    mantissa += "" if "." in mantissa else ".0"
    return f"{mantissa}{e}{exponent}"


def _zero(node: Element | None, type: str) -> str:
    """The zero of an element of an array, or of a member: of a structure it is enough to name one."""
    structure = child(node, "Structure") if child(node, "Structure") is not None else node
    first = next(children(structure, "DataValueMember", "ArrayMember", "StructureMember"), None)
    if first is None:
        return "0.0" if type.upper() in REALS else "0"
    if attribute(_characters(structure), "Radix") == "ASCII":
        return "(LEN := 0)"
    inner = _zero(first, attribute(first, "DataType"))
    return f"({name_of(attribute(first, 'Name'))} := {f'[{inner}]' if kind(first) == 'ArrayMember' else inner})"


def _repeated(values: Iterable[str]) -> Iterator[str]:
    for value, same in groupby(values):
        times = sum(1 for _ in same)
        yield value if times == 1 else f"{times}({value})"


def _characters(node: Element | None) -> Element | None:
    return next((each for each in children(node, "DataValueMember") if attribute(each, "Name") == "DATA"), None)


def _text(written: str, lost: list[str]) -> str:
    """A string, whose characters are numbers: its length, and what it has."""
    written = written.strip()
    if not written:
        return ""
    if not _PLAIN.fullmatch(written):
        lost.append(written[:40])
        return ""
    codes = list(_codes(written[1:-1].replace("\r", "").replace("\n", "")))
    return f"(LEN := {len(codes)}, DATA := [{', '.join(map(str, codes))}])" if codes else ""


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
        yield (code & 0xFF) - 256 if code & 0xFF > 127 else code & 0xFF


def members_of(structure: Element) -> Iterator[tuple[str, str, str, Element]]:
    """Name, type, dimensions of the members that the data of a structure names, and their element."""
    for each in children(structure, "DataValueMember", "ArrayMember", "StructureMember"):
        yield attribute(each, "Name"), attribute(each, "DataType"), attribute(each, "Dimensions"), each


def structure_in(node: Element | None) -> Element | None:
    """The structure that the data of a tag is, also of an array of them."""
    data = _decorated(node)
    return child(data, "Structure") if child(data, "Array") is None else child(data, "Array", "Element", "Structure")
