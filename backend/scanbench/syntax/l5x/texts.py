"""Texts of an own type, a structure of LEN and DATA, where an instruction takes the STRING of Logix, which has 82 characters.

From *Logix 5000 Controllers General Instructions* (1756-RM003): the instructions take texts of all types, and leave out what is more than
the destination takes. Where one of them takes more than 82, they are the instructions for long texts; a type of more than those take
stays as it is, and is refused.
"""

from scanbench.syntax.l5x.elements import Declared, Names, element, members_of
from scanbench.syntax.l5x.names import LIBRARY

RESULT = f"{LIBRARY}.TextResult"
LONG_RESULT = f"{LIBRARY}.LongResult"
MOST = 82
LONGEST = 4096
"""Characters that the instructions for long texts take."""
SHORT_LITERAL = f"{LIBRARY}.TEXT("
READ = {
    "CONCAT": (0, 1), "MID": (0,), "DELETE": (0,), "INSERT": (0, 1), "FIND": (0, 1), "STOD": (0,), "UPPER": (0,), "LOWER": (0,),
    "DTOS": (),
}  # fmt: skip
"""The instructions, and which of their arguments are texts that are read; the last of all but FIND and STOD is the text that is made."""
_NUMBERS = ("FIND", "STOD")


def instruction(name: str, given: list[str], known: Names) -> str:
    """The instruction, with those of the texts of own types that it can take."""
    made = list(given)
    target = given[-1] if given and name not in _NUMBERS else ""
    texts = [given[at] for at in READ[name] if at < len(given)] + [target] * bool(target)
    if any(MOST < (_size(each, known) or 0) <= LONGEST for each in texts):
        return _long(name, made, target, known)
    for at in READ[name]:
        size = _own_size(given[at], known) if at < len(given) else None
        if size is not None and size <= MOST:
            made[at] = f"{LIBRARY}.TEXT_AT(ADR({given[at]}.DATA[0]), {given[at]}.LEN)"
    size = _own_size(target, known)
    if size is not None and size <= MOST:
        made[-1] = RESULT
        return f"{LIBRARY}.{name}({', '.join(made)}); {put(RESULT, target, size)}"
    return f"{LIBRARY}.{name}({', '.join(made)})"


def _long(name: str, made: list[str], target: str, known: Names) -> str:
    """The instruction for long texts, of which some are those of Logix, or written in quotes."""
    for at in READ[name]:
        size = _size(made[at], known) if at < len(made) else None
        if size is not None and size <= LONGEST:
            made[at] = f"{LIBRARY}.LONG_AT(ADR({made[at]}.DATA[0]), {made[at]}.LEN)"
        elif at < len(made) and made[at].startswith(SHORT_LITERAL):
            made[at] = f"{LIBRARY}.LONG({made[at].removeprefix(SHORT_LITERAL)}"
    size = _size(target, known)
    if size is None or size > LONGEST:
        return f"{LIBRARY}.{name}_LONG({', '.join(made)})"
    made[-1] = LONG_RESULT
    put_back = f"{LIBRARY}.PUT_LONG({LONG_RESULT}, ADR({target}.DATA[0]), {size}, {target}.LEN)"
    return f"{LIBRARY}.{name}_LONG({', '.join(made)}); {put_back}"


def assigned(target: str, literal: str, known: Names) -> str | None:
    """A text in quotes that a variable of an own type becomes; None of other variables."""
    size = _own_size(target, known)
    return None if size is None or len(literal) - 2 > MOST else put(f"{LIBRARY}.TEXT({literal})", target, size)


def put(value: str, target: str, size: int) -> str:
    """A text of Logix that one of an own type becomes."""
    return f"{LIBRARY}.PUT_TEXT({value}, ADR({target}.DATA[0]), {size}, {target}.LEN)"


def _size(written: str, known: Names) -> int | None:
    """The same of an own type, and of the STRING of Logix."""
    found = element(written, known)
    return MOST if found is not None and (found.type, found.text) == ("STRING", written) else _own_size(written, known)


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
