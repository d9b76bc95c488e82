"""Types that have other bytes in CODESYS and TwinCAT, told where a program can see that: times and dates have four bytes there."""

from scanbench.check.context import Report
from scanbench.check.dialect import Allowance, Dialect
from scanbench.problems import Span
from scanbench.program.types import ArrayType, Record, Type

SHORT = frozenset(("TIME", "TIME_OF_DAY", "DATE", "DATE_AND_TIME"))


def shorter_there(type: Type | None) -> str:
    """The name of a type in this one that has fewer bytes there; nothing without one."""
    if isinstance(type, ArrayType):
        return shorter_there(type.element)
    if isinstance(type, Record):
        return next((found for each in type.members.values() if (found := shorter_there(each.type))), "")
    return type.name if type is not None and type.name in SHORT else ""


def tell_bytes(report: Report, dialect: Dialect, type: Type | None, span: Span) -> None:
    """The warning, where the dialect is of such a tool."""
    if Allowance.WIDE_RESULTS not in dialect.allows or not (name := shorter_there(type)):
        return
    unit = "milliseconds" if name in ("TIME", "TIME_OF_DAY") else "seconds"
    report.warn(
        "W004",
        f"{name} has four bytes in {dialect.title}, {unit}; here it has eight, nanoseconds. What is seen of its bytes here is different: "
        f"convert it, as with {name}_TO_DWORD.",
        span,
    )
