"""Texts of an own type, a structure of LEN and DATA, where an instruction takes the STRING of Logix, which has 82 characters.

From *Logix 5000 Controllers General Instructions* (1756-RM003): the instructions take texts of all types, and leave out what is more than
the destination takes. A type of more than 82 characters stays as it is, and is refused.
"""

from scanbench.syntax.l5x.elements import Declared, Names, element, members_of
from scanbench.syntax.l5x.names import LIBRARY

RESULT = f"{LIBRARY}.TextResult"
MOST = 82
READ = {
    "CONCAT": (0, 1), "MID": (0,), "DELETE": (0,), "INSERT": (0, 1), "FIND": (0, 1), "STOD": (0,), "UPPER": (0,), "LOWER": (0,),
    "DTOS": (),
}  # fmt: skip
"""The instructions, and which of their arguments are texts that are read; the last of all but FIND and STOD is the text that is made."""
_NUMBERS = ("FIND", "STOD")


def instruction(name: str, given: list[str], known: Names) -> str:
    """The instruction, with those of the texts of own types that it can take."""
    made = list(given)
    for at in READ[name]:
        size = _own_size(given[at], known) if at < len(given) else None
        if size is not None and size <= MOST:
            made[at] = f"{LIBRARY}.TEXT_AT(ADR({given[at]}.DATA[0]), {given[at]}.LEN)"
    target = given[-1] if given and name not in _NUMBERS else ""
    size = _own_size(target, known)
    if size is not None and size <= MOST:
        made[-1] = RESULT
        return f"{LIBRARY}.{name}({', '.join(made)}); {put(RESULT, target, size)}"
    return f"{LIBRARY}.{name}({', '.join(made)})"


def assigned(target: str, literal: str, known: Names) -> str | None:
    """A text in quotes that a variable of an own type becomes; None of other variables."""
    size = _own_size(target, known)
    return None if size is None or len(literal) - 2 > MOST else put(f"{LIBRARY}.TEXT({literal})", target, size)


def put(value: str, target: str, size: int) -> str:
    """A text of Logix that one of an own type becomes."""
    return f"{LIBRARY}.PUT_TEXT({value}, ADR({target}.DATA[0]), {size}, {target}.LEN)"


def _own_size(written: str, known: Names) -> int | None:
    """How many characters the text takes; None of what is no text of an own type."""
    found = element(written, known)
    if found is None or found.type == "STRING" or found.text != written:
        return None
    members = members_of(found.type, known)
    data: Declared = members.get("DATA", ("", ()))
    if set(members) != {"LEN", "DATA"} or data[0] != "SINT" or len(data[1]) != 1:
        return None
    return data[1][0]
