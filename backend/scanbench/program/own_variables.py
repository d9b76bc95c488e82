"""The variables that every program has by itself."""

from scanbench.problems import Span
from scanbench.program.layout import Layout
from scanbench.program.types import BOOL, UDINT, Kind, Member, Record, Section

_NOWHERE = Span("", 1, 1, 1, 1)
SYSTEM = Record("$SYSTEM", Kind.STRUCT)
"""Variables that every program has: of the subrange checks. An engine writes beside the program what a record of this name
holds."""
SYSTEM.place_at(Member("_SubrangeError", BOOL, Section.GLOBAL, _NOWHERE), Layout.SUBRANGE_ERROR)
SYSTEM.place_at(Member("_SubrangeErrorCount", UDINT, Section.GLOBAL, _NOWHERE, constant=True), Layout.SUBRANGE_COUNT)
