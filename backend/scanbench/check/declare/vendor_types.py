"""Base types of vendors, as they are on a controller of 64 bits."""

from scanbench.check.context import Report
from scanbench.check.dialect import Allowance, Dialect, said
from scanbench.problems import Span
from scanbench.program.types import BYTE, LINT, LWORD, SLOT_BYTES, ULINT, Elementary, Kind, Reference

VENDOR_TYPES: dict[str, Elementary] = {
    "XINT": LINT,
    "__XINT": LINT,
    "UXINT": ULINT,
    "__UXINT": ULINT,
    "XWORD": LWORD,
    "__XWORD": LWORD,
    "PVOID": Reference("POINTER TO BYTE", Kind.REF, SLOT_BYTES, BYTE, pointer=True),
}


def vendor_type(report: Report, dialect: Dialect, name: str, span: Span) -> Elementary | None:
    """The type of this name, where the dialect has it."""
    made = VENDOR_TYPES.get(name.upper())
    if made is None or Allowance.VENDOR_TYPES not in dialect.allows:
        return None
    used = f"`{name}` is {made.name} on a controller of 64 bits"
    report.warn("W006", said(dialect, Allowance.VENDOR_TYPES, used, f"`{made.name}`"), span)
    return made
