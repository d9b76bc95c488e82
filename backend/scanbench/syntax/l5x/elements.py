"""What an operand of an instruction is: a tag, an element or a member, its type, and how many elements there are from it on."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

Declared = tuple[str, Sequence[int]]
"""A type, in upper case, and its dimensions."""
NUMBERS = ("SINT", "INT", "DINT", "LINT", "USINT", "UINT", "UDINT", "ULINT", "REAL", "LREAL")
"""Types whose bytes are the same here as there."""
FILLED = ("SINT", "INT", "DINT", "LINT", "REAL")
"""Types that FLL has a function for."""
OPEN = 0
"""The size of a dimension that comes with each call."""
PACKED = ("BOOL", "BIT")
"""Types whose values share bytes there."""
_WORDS = ("DINT", "REAL", "UDINT")
"""Types that a structure has one after the other, without room between."""
_STEP = re.compile(r"\s*(\.)?\s*(\w+)\s*(?:\[([^\[\],]+)\])?")
_TEXT = {"LEN": ("DINT", ()), "DATA": ("SINT", (82,))}


def _declared(bits: str, *others: tuple[str, str]) -> dict[str, Declared]:
    """Members that are BOOL, after others."""
    made: dict[str, Declared] = {name: (type, ()) for name, type in others}
    return made | dict.fromkeys(bits.split(), ("BOOL", ()))


_BUILT_IN: Mapping[str, Mapping[str, Declared]] = {
    "STRING": _TEXT,
    "TIMER": _declared("EN TT DN", ("PRE", "DINT"), ("ACC", "DINT")),
    "COUNTER": _declared("CU CD DN OV UN", ("PRE", "DINT"), ("ACC", "DINT")),
    "FBD_TIMER": _declared("TIMERENABLE RESET", ("PRE", "DINT")) | _declared("EN TT DN", ("ACC", "DINT")),
    "FBD_COUNTER": _declared("CUENABLE CDENABLE RESET", ("PRE", "DINT")) | _declared("CU CD DN OV UN", ("ACC", "DINT")),
}
"""The members of types of Logix that aliases are written for."""


class Names(Protocol):
    """What names mean."""

    @property
    def types(self) -> Mapping[str, Declared]: ...
    @property
    def members(self) -> Mapping[str, Mapping[str, Declared]]: ...


@dataclass(frozen=True, slots=True)
class Element:
    """One of them."""

    type: str
    text: str
    """As it is written here."""
    left: str
    """How many there are, from it on."""


def element(written: str, known: Names) -> Element | None:
    """None for what is no tag, or of a type that the file does not show."""
    at, type, text, left = 0, "", "", "1"
    while at < len(written):
        step = _STEP.match(written, at)
        if step is None or (step[1] is None) is not (at == 0):
            return None
        place: Mapping[str, Declared] = known.types if at == 0 else members_of(type, known)
        found = place.get(step[2].upper())
        if found is None or len(found[1]) > 1 or (left != "1" and not text.endswith("]")):
            return None
        type, sizes = found
        text += f"{'.' if at else ''}{step[2]}"
        index, left = step[3], "1"
        if sizes:
            index = (index or "0").strip()
            text += f"[{index}]"
            size = f"UPPER_BOUND({step[2]}, 1) + 1" if sizes[0] == OPEN else str(sizes[0])
            left = size if index == "0" else f"{size} - ({index})"
        elif index is not None:
            return None
        at = step.end()
    return Element(type, text, left) if type else None


def following(written: str, known: Names) -> int:
    """How many members of one type of number follow each other from this one on, it included: their bytes have no room between."""
    owner, _, name = written.rpartition(".")
    found = element(owner, known)
    members = list(members_of(found.type, known).items()) if found is not None else []
    names = [each for each, _ in members]
    if name.upper() not in names:
        return 0
    first = names.index(name.upper())
    type, sizes = members[first][1]
    count = 0
    for _, declared in members[first:]:
        if sizes or declared != (type, sizes) or type not in NUMBERS:
            break
        count += 1
    return count


def members_of(type: str, known: Names) -> Mapping[str, Declared]:
    """The members of a structure, by name."""
    return _BUILT_IN.get(type) or known.members.get(type, {})


def same_bytes(one: str, other: str, known: Names) -> bool:
    """Whether a copy byte for byte from one type to the other is the same here as there."""
    if one == other:
        return one not in PACKED
    return _plain(one, known) and _plain(other, known)


def _plain(type: str, known: Names) -> bool:
    members = members_of(type, known)
    return type in NUMBERS or (bool(members) and all(each in _WORDS for each, _ in members.values()))
