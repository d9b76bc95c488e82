"""Instructions of Logix that are written otherwise here: copies, fills, what the controller tells.

From *Logix 5000 Controllers General Instructions* (1756-RM003).
"""

import re
from collections.abc import Callable

from scanbench.syntax.l5x import notes
from scanbench.syntax.l5x.elements import FILLED, OPEN, PACKED, element, following, same_bytes
from scanbench.syntax.l5x.known import Known
from scanbench.syntax.l5x.names import CONTROLLER, LIBRARY

Tell = Callable[[str], None]


def copied(known: Known, tell: Tell, given: list[str]) -> str:
    """COP, CPS: so many elements of the destination, byte for byte, up to its end, and to that of the source."""
    source, destination, length = (*given, "", "", "")[:3]
    one, other = element(source, known), element(destination, known)
    if one is None or other is None or not same_bytes(one.type, other.type, known):
        tell(notes.other_bytes(f"COP({', '.join(given)})"))
        return f"COP({', '.join(given)})"
    left = other.left
    if "." in other.text and length.isdigit() and left.isdigit() and int(length) > int(left):
        left = str(following(destination, known))  # there it goes on into the members that follow
        if int(length) > int(left):
            tell(notes.other_bytes(f"COP({', '.join(given)})"))
            return f"COP({', '.join(given)})"
    size = f"MIN({length}, {left}) * SIZEOF({other.text})"
    if one.type != other.type or one.left != other.left:
        size = f"MIN({size}, ({one.left}) * SIZEOF({one.text}))"
    return f"{LIBRARY}.COP(ADR({one.text}), ADR({other.text}), {size})"


def filled(known: Known, tell: Tell, given: list[str]) -> str:
    """FLL: so many elements of the destination with a value, up to its end; of structures only with 0."""
    source, destination, length = (*given, "", "", "")[:3]
    other = element(destination, known)
    if other is None or (other.type not in FILLED and (source != "0" or other.type in PACKED)):
        tell(notes.other_bytes(f"FLL({', '.join(given)})"))
        return f"FLL({', '.join(given)})"
    count = f"MIN({length}, {other.left})"
    if other.type in FILLED:
        return f"{LIBRARY}.FLL_{other.type}({source}, ADR({other.text}), {count})"
    return f"{LIBRARY}.FLL_SINT(0, ADR({other.text}), {count} * SIZEOF({other.text}))"


def sized(known: Known, tell: Tell, given: list[str]) -> str:
    """SIZE: the elements of a dimension of an array."""
    source, dimension, result = (*given, "", "", "")[:3]
    sizes = known.types.get(source.partition("[")[0].strip().upper(), ("", ()))[1]
    member = element(source, known) if "." in source and dimension == "0" else None
    if member is not None and member.left.isdigit() and member.text.endswith("[0]"):
        return f"{result} := {member.left}"
    if not dimension.isdigit() or int(dimension) >= len(sizes):
        tell(notes.no_size(f"SIZE({', '.join(given)})"))
        return f"SIZE({', '.join(given)})"
    if sizes[int(dimension)] == OPEN:
        return f"{result} := UPPER_BOUND({source.partition('[')[0].strip()}, {int(dimension) + 1}) + 1"
    return f"{result} := {sizes[int(dimension)]}"


def swapped(known: Known, tell: Tell, given: list[str]) -> str:
    """SWPB: the bytes of an integer in another order."""
    source, order, target = (*given, "", "", "")[:3]
    found = element(source, known)
    if found is not None and found.type == "INT":
        return f"{target} := {LIBRARY}.SWPB_INT({source})"
    made = {"REVERSE": "REVERSE", "WORD": "WORD", "HIGH_LOW": "HIGH_LOW", "HIGH/LOW": "HIGH_LOW"}.get(
        order.upper().rstrip("_")
    )
    if made is None or found is None or found.type != "DINT":
        tell(notes.other_bytes(f"SWPB({', '.join(given)})"))
        return f"SWPB({', '.join(given)})"
    return f"{target} := {LIBRARY}.SWPB_{made}({source})"


def read_system(known: Known, tell: Tell, given: list[str]) -> str:
    """GSV: what the controller tells; the clock is that of the virtual PLC, the rest is a stub."""
    kind, instance, attribute, target = (*given, "", "", "", "")[:4]
    clock = kind.upper() == "WALLCLOCKTIME"
    found = element(target, known)
    if (
        clock
        and attribute.upper() in ("LOCALDATETIME", "DATETIME")
        and found is not None
        and found.type == "DINT"
        and "[" in target
    ):
        return f"{LIBRARY}.WALLCLOCK({target.rpartition('[')[0]}, {target.rpartition('[')[2][:-1]})"
    if clock and attribute.upper() == "CURRENTVALUE" and found is not None and found.type == "LINT":
        return f"{target} := {LIBRARY}.MICROSECONDS()"
    if found is not None:
        target = found.text
    if (
        clock
        and attribute.upper() == "CURRENTVALUE"
        and found is not None
        and found.type == "DINT"
        and found.left != "1"
    ):
        array, _, index = target.rpartition("[")
        upper = f"LWORD_TO_DINT(SHR(LINT_TO_LWORD({LIBRARY}.MICROSECONDS()), 32))"
        return f"{target} := LINT_TO_DINT({LIBRARY}.MICROSECONDS()); {array}[{index[:-1]} + 1] := {upper}"
    type = found.type if found is not None and found.type in (*FILLED, "BOOL") else "DINT"
    name = _joined("GSV", kind, instance, attribute)
    known.stubs[name] = type
    return f"{target} := {CONTROLLER}.{name}()"


def write_system(known: Known, tell: Tell, given: list[str]) -> str:
    """SSV: what the controller is told, which changes nothing here."""
    name = _joined("SSV", *given[:3])
    known.stubs[name] = ""
    return f"{CONTROLLER}.{name}()"


def as_text(known: Known, tell: Tell, given: list[str]) -> str:
    """RTOS: a number as a text, whose form is not documented exactly."""
    known.stubs["RTOS"] = "STRING82"
    return f"{given[1] if len(given) > 1 else ''} := {CONTROLLER}.RTOS()"


def _joined(*parts: str) -> str:
    return "_".join(re.sub(r"\W", "_", each) for each in parts if each)


WRITTEN: dict[str, Callable[[Known, Tell, list[str]], str]] = {
    "COP": copied,
    "CPS": copied,
    "FLL": filled,
    "SIZE": sized,
    "SWPB": swapped,
    "GSV": read_system,
    "SSV": write_system,
    "RTOS": as_text,
}
"""By their names: what each is written as, from its arguments."""
