"""REF_TO ARRAY[*] of SIMATIC AX: a reference to an array of any size, which has the bounds of the array with it.

It is a structure of the reference and the bounds, laid out as an in-out of ARRAY[*] is in its owner, so that both are read in the
same way (`check.body.elements.array_bounds`).
"""

from scanbench.check.declare.declarations import Declarations
from scanbench.check.dialect import Allowance
from scanbench.check.dialect_rules import said
from scanbench.problems import Span
from scanbench.program.types import LINT, SLOT_BYTES, Kind, Member, OpenArray, Record, Reference, Section, Type

SLOT = "$SLOT"
BOUNDS = ("$LOW", "$HIGH")
"""Names of the members with the bounds; the number of the dimension follows."""


def open_reference(declared: Declarations, target: OpenArray, span: Span) -> Record:
    """The type of references to such arrays; D002 where the dialect has none."""
    if Allowance.OPEN_REFERENCES not in declared.dialect.allows:
        raise declared.report.reject("D002", "A reference needs an array with bounds, not ARRAY[*].", span)
    name = f"REF_TO {target.name}"
    told = f"`{name}` has the bounds of the array with it"
    declared.report.warn("W006", said(declared.dialect, Allowance.OPEN_REFERENCES, told), span)
    made = declared.shells.get(name.upper())
    if made is None:
        made = declared.shells[name.upper()] = Record(name, Kind.STRUCT)
        slot = Reference(name, Kind.REF, SLOT_BYTES, target)
        made.place(Member(SLOT, slot, Section.MEMBER, span, hidden=True))
        for dimension in range(1, target.dimensions + 1):
            for bound in BOUNDS:
                made.place(Member(f"{bound}{dimension}", LINT, Section.MEMBER, span, hidden=True))
        made.close()
    return made


def array_of(type: Type | None) -> OpenArray | None:
    """What such a reference refers to; None of any other type."""
    slot = type.members.get(SLOT) if isinstance(type, Record) else None
    reference = None if slot is None else slot.type
    return reference.target if isinstance(reference, Reference) and isinstance(reference.target, OpenArray) else None
