"""What to do where an operator cannot join two types: a conversion after which it can."""

from collections.abc import Iterator

from scanbench.check.body.coercion import conversion_hint
from scanbench.program.types import ELEMENTARY, LINT, LREAL, Elementary, Kind
from scanbench.program.untyped import common

UNSIGNED = {1: ELEMENTARY["USINT"], 2: ELEMENTARY["UINT"], 4: ELEMENTARY["UDINT"], 8: ELEMENTARY["ULINT"]}
BITS = {1: ELEMENTARY["BYTE"], 2: ELEMENTARY["WORD"], 4: ELEMENTARY["DWORD"], 8: ELEMENTARY["LWORD"]}
LOGIC = ("and", "or", "xor")
ORDER = ("eq", "ne", "lt", "le", "gt", "ge")


def joining_hint(op: str, left: Elementary, right: Elementary) -> str:
    """` Convert it with WORD_TO_UINT.`, or nothing where no conversion of one side is enough."""
    if op in LOGIC and Kind.BOOL in (left.kind, right.kind):
        number = left if right.kind is Kind.BOOL else right
        return "" if number.kind is Kind.BOOL else f" Compare the {number} with 0, `x <> 0`, or convert the BOOL."
    for source, other in ((right, left), (left, right)):
        for target in _targets(op, source, other):
            joined = common(target, other)
            if target != source and joined is not None and _fits(op, joined):
                return conversion_hint(source, target)
    return ""


def _targets(op: str, source: Elementary, other: Elementary) -> Iterator[Elementary]:
    if op in LOGIC:
        if source.kind in (Kind.INT, Kind.UINT):
            yield BITS[source.size]
        return
    if source.kind is Kind.BITS:
        if other.kind in (Kind.INT, Kind.UINT) and other.size >= source.size:
            yield other
        yield UNSIGNED[source.size]  # to REAL, a tool may copy the bits
        yield LINT
    elif other.kind is not Kind.BITS:
        yield other
    elif source.kind is Kind.REAL and op in ORDER:
        return
    yield LREAL if Kind.REAL in (source.kind, other.kind) else LINT


def _fits(op: str, joined: Elementary) -> bool:
    if op in LOGIC:
        return joined.kind in (Kind.BOOL, Kind.BITS)
    if op in ORDER:
        return True
    return joined.kind in (Kind.INT, Kind.UINT) or (joined.kind is Kind.REAL and op != "mod")
