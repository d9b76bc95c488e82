"""Base types of vendors, as they are on a controller of 64 bits, and bits."""

from scanbench.check.context import Report
from scanbench.check.dialect import Allowance, Dialect
from scanbench.check.dialect_rules import said
from scanbench.problems import Span
from scanbench.program.types import (
    BOOL,
    BYTE,
    LINT,
    LWORD,
    SLOT_BYTES,
    ULINT,
    Elementary,
    Kind,
    Member,
    Record,
    Reference,
)

BIT = "BIT"
VENDOR_TYPES: dict[str, Elementary] = {
    "XINT": LINT,
    "__XINT": LINT,
    "UXINT": ULINT,
    "__UXINT": ULINT,
    "XWORD": LWORD,
    "__XWORD": LWORD,
    BIT: BOOL,
    "PVOID": Reference("POINTER TO BYTE", Kind.REF, SLOT_BYTES, BYTE, pointer=True),
}

NOT_HERE = {
    "S5TIME": "Declare it as TIME, and use a TON, TOF or TP.",
    "TIMER": "Declare an IEC_TIMER, and call it as TON, TOF or TP.",
    "COUNTER": "Declare an IEC_COUNTER, and call it as CTU, CTD or CTUD.",
}
"""Types of Siemens that are known and not supported, and what to do instead."""


def instead_of(dialect: Dialect, name: str) -> str:
    """What to declare instead of a type that the dialect has, and Scanbench has not; or nothing."""
    siemens = Allowance.INSTRUCTION_TYPES in dialect.allows
    return f" {NOT_HERE[name.upper()]}" if siemens and name.upper() in NOT_HERE else ""


def vendor_type(report: Report, dialect: Dialect, name: str, span: Span) -> Elementary | None:
    """The type of this name, where the dialect has it."""
    made = VENDOR_TYPES.get(name.upper())
    if made is None or Allowance.VENDOR_TYPES not in dialect.allows:
        return None
    used = f"`{name}` is {made.name} on a controller of 64 bits"
    if name.upper() == BIT:
        used = "`BIT` is BOOL; in a structure eight of them in a row share a byte"
    report.warn("W006", said(dialect, Allowance.VENDOR_TYPES, used, f"`{made.name}`"), span)
    return made


def place_bit(owner: Record, member: Member) -> None:
    """Gives a BIT of a structure the next bit of the byte that the BIT before it is in, else the first of the next byte."""
    before = next(reversed(owner.members.values()), None)
    if before is not None and before.bit is not None and before.bit < 7 and before.offset == owner.size - 1:
        member.bit = before.bit + 1
        owner.place_at(member, before.offset)
    else:
        member.bit = 0
        owner.place_at(member, 0 if owner.overlaps else owner.size)
