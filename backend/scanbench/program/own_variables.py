"""The variables that every program has by itself."""

from scanbench.problems import Span
from scanbench.program.layout import Layout
from scanbench.program.types import BOOL, UDINT, Kind, Member, Record, Section

_NOWHERE = Span("", 1, 1, 1, 1)
SYSTEM = Record("$SYSTEM", Kind.STRUCT)
"""Variables that every program has: those of the subrange checks. The engine writes the variables of a record of this
name too, not only the program."""
SYSTEM.place_at(Member("_SubrangeError", BOOL, Section.GLOBAL, _NOWHERE), Layout.SUBRANGE_ERROR)
SYSTEM.place_at(Member("_SubrangeErrorCount", UDINT, Section.GLOBAL, _NOWHERE, constant=True), Layout.SUBRANGE_COUNT)
