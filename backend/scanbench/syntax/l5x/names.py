"""Names of Logix as names of the standard."""

import re

from scanbench.syntax.lexer import KEYWORDS

LIBRARY = "Logix"
"""The library whose texts are the types and instructions of Logix."""
INSTRUCTIONS = frozenset(
    "CONCAT CTUD DEG DELETE DTOS FIND INSERT LOWER MID OSFI OSRI RAD RESD RTOR SETD STOD TOFR TONR UPPER".split()
)
"""What it has for statements, in upper case."""
TYPES = frozenset("CONTROL COUNTER DOMINANT_RESET DOMINANT_SET FBD_COUNTER FBD_ONESHOT FBD_TIMER TIMER".split())
"""And the types."""
TEXT = f"{LIBRARY}.STRING82"
"""The type STRING of Logix: a length and characters."""
ELEMENTARY = frozenset("BOOL SINT INT DINT LINT USINT UINT UDINT ULINT REAL LREAL".split())
_TAKEN = (
    KEYWORDS
    | ELEMENTARY
    | frozenset("BYTE WORD DWORD LWORD TIME LTIME DATE LDATE TOD LTOD DT LDT CHAR WCHAR STRING WSTRING".split())
)
_SPECIAL = re.compile(r"\W")


def name_of(logix: str) -> str:
    """The name here: `Local:1:I` is Local_1_I, and what is a word of the standard gets a `_`."""
    plain = _SPECIAL.sub("_", logix)
    return f"{plain}_" if plain.upper() in _TAKEN else plain


def type_name(logix: str) -> str:
    """The type here."""
    upper = logix.upper()
    if upper in ELEMENTARY:
        return upper
    if upper in ("BIT", "BOOLEAN"):
        return "BOOL"
    if upper == "STRING":
        return TEXT
    return f"{LIBRARY}.{upper}" if upper in TYPES else name_of(logix)
