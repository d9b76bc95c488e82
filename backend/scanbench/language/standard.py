"""The standard functions in words."""

import re

from scanbench.check.body.conversions import FROM_BCD, TO_BCD, TRUNC
from scanbench.check.standard.functions import FUNCTIONS, Chain, Operator, Row, Same, Shift, Special, StringFunction
from scanbench.language.standard_texts import TEXTS
from scanbench.program.types import ELEMENTARY, Kind

KINDS = {
    Kind.INT: "integer", Kind.UINT: "", Kind.REAL: "real", Kind.BITS: "bit string", Kind.BOOL: "BOOL",
    Kind.TIME: "duration", Kind.DATE: "date or time of day", Kind.CHAR: "character", Kind.STRING: "string",
}  # fmt: skip
CONVERSION = re.compile(r"(?:(\w+?)_)?TO_(\w+)")
PARAMETER = re.compile(r"- ([A-Z]\w*(?:, [A-Z]\w*)*): (.*)")
"""A line of a text that tells what one parameter is, perhaps by several names."""
LETTERS = {"s": "string", "n": "integer"}
REALS = ("REAL", "LREAL")
WHOLE = frozenset(name for name, type in ELEMENTARY.items() if type.kind in (Kind.INT, Kind.UINT))
ROUNDED = "It is rounded, a half to the even number; what is too large becomes the largest number of the type."


def row_of(name: str) -> Row | None:
    """The row of a standard function, whose name may end in a type: `MAX_INT`. None for conversions."""
    base, _, type = name.partition("_")
    return FUNCTIONS.get(name) or (FUNCTIONS.get(base) if type in ELEMENTARY else None)


def says(row: Row) -> str:
    """The parameters and the result of a function, in words."""
    match row:
        case Special(says=text):
            return text
        case Same(kinds=kinds):
            return f"{', '.join(filter(None, (KINDS[kind] for kind in kinds)))} -> the same"
        case Shift():
            return "bit string, integer -> that bit string"
        case StringFunction(kinds=kinds, result=result):
            return f"{', '.join(LETTERS[kind] for kind in kinds)} -> {'INT' if result == 'INT' else 'string'}"
        case Chain():
            return "any elementary type or string -> BOOL"
        case Operator(op=op, types=types):
            if types is not None:
                difference = types[0] == types[1] and types[0].kind is Kind.DATE
                return f"{types[0]}, {types[1]} -> {('LTIME' if types[0].name[0] == 'L' else 'TIME') if difference else types[0]}"
            if op in ("add", "sub", "mul", "div"):
                return "number -> the same; times where the names below allow it"
            return "BOOL or bit string -> the same" if op in ("and", "or", "xor") else "number -> the same"


def text_of(name: str) -> str:
    """What a standard function does; its name may end in a type, or be that of a conversion."""
    base = name.partition("_")[0]
    for key in (name, base, base.removesuffix("TIME")):
        if key in TEXTS and (key == name or row_of(name) is not None):
            return TEXTS[key]
    if FROM_BCD.fullmatch(name):
        return "The number that the digits of IN in BCD are."
    if TO_BCD.fullmatch(name):
        return "The digits of the number IN in BCD."
    if TRUNC.fullmatch(name):
        return (
            "The number IN without the part after its point; what is too large becomes the largest number of the type."
        )
    if (match := CONVERSION.fullmatch(name)) is None:
        return ""
    source, target = match.groups()
    of = f" from {source}" if source else ""
    return f"Converts IN{of} to {target}." + (f" {ROUNDED}" if source in REALS and target in WHOLE else "")


def summary(text: str) -> str:
    """The sentences of a text without its parameters, on one line."""
    return " ".join(line for line in text.splitlines() if not PARAMETER.match(line))


def parameter(text: str, name: str) -> str:
    """What a text says of one parameter, by its name in upper case."""
    found = (PARAMETER.fullmatch(line) for line in text.splitlines())
    return next((each[2] for each in found if each is not None and name in each[1].upper().split(", ")), "")
