"""Times and dates in CODESYS and TwinCAT: numbers of 32 bits without a sign, of milliseconds or seconds.

In memory they are what they are in every dialect, 64 bits with nanoseconds. A value is always one that 32 bits have, see
`body/short_times.py`; where a program sees the bytes, it is told.
Source: http://automationbuilder.webhelp.s3-website-eu-west-1.amazonaws.com/Automation_Builder_2.2/en/cd94cde49b6ce2ddc0a8640e00867156_6_en_US/be0bbde693f16b94c0a8640e00a54e5d.html
"""

from dataclasses import replace

from scanbench.check.context import Report
from scanbench.check.dialect import Allowance, Dialect
from scanbench.problems import Span
from scanbench.program.types import DATE, DATE_AND_TIME, TIME, TIME_OF_DAY, ArrayType, Elementary, Record, Type

UNITS = {TIME.name: 1_000_000, TIME_OF_DAY.name: 1_000_000, DATE.name: 1_000_000_000, DATE_AND_TIME.name: 1_000_000_000}
"""Nanoseconds that a number counts, in these tools and in conversions of every dialect."""
MARKED = {each.name: replace(each, unit=UNITS[each.name]) for each in (TIME, TIME_OF_DAY, DATE, DATE_AND_TIME)}


def short_type(dialect: Dialect, type: Elementary) -> Elementary:
    """A type of variables, which says what values a tool may write; it is equal to the one of every dialect."""
    return MARKED.get(type.name, type) if Allowance.SHORT_TIMES in dialect.allows else type


def unit_name(type: Elementary) -> str:
    """What a number of the type counts."""
    return "milliseconds" if UNITS[type.name] == UNITS[TIME.name] else "seconds"


def shorter_there(type: Type | None) -> Elementary | None:
    """A type in this one that has fewer bytes there, or none."""
    if isinstance(type, ArrayType):
        return shorter_there(type.element)
    if isinstance(type, Record):
        return next((found for each in type.members.values() if (found := shorter_there(each.type))), None)
    return type if isinstance(type, Elementary) and type.name in UNITS else None


def tell_bytes(report: Report, dialect: Dialect, type: Type | None, span: Span) -> None:
    """The warning, where the dialect is of such a tool."""
    if Allowance.SHORT_TIMES not in dialect.allows or (found := shorter_there(type)) is None:
        return
    name, unit = found.name, unit_name(found)
    report.warn(
        "W004",
        f"{name} has four bytes in {dialect.title}, {unit}; here it has eight, nanoseconds. What is seen of its bytes here is different: "
        f"convert it, as with {name}_TO_DWORD.",
        span,
    )
