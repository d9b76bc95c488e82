"""Type specifications -> types: enumerations, subranges, references, structures and unions."""

import re
from typing import TYPE_CHECKING

from scanbench.check.context import Rejected
from scanbench.problems import Span
from scanbench.program.types import (
    ELEMENTARY,
    SLOT_BYTES,
    Elementary,
    Enumeration,
    Kind,
    Member,
    OpenArray,
    Record,
    Reference,
    Section,
    Subrange,
    has_instance,
)
from scanbench.program.untyped import bounds
from scanbench.syntax import tree

if TYPE_CHECKING:
    from scanbench.check.declare.declare import Declarations

RELATIVE = re.compile(r"%([XBWDL])(\d+)(?:\.([0-7]))?", re.IGNORECASE)
UNIT_BYTES = {"X": 1, "B": 1, "W": 2, "D": 4, "L": 8}
COUNTED = (Kind.INT, Kind.UINT)


def enumeration(declared: "Declarations", spec: tree.EnumSpec, name: str) -> Enumeration:
    """An enumeration; one that stands inline is named after its values."""
    base = declared.named(spec.base.name, spec.base.span) if spec.base else ELEMENTARY["INT"]
    if not isinstance(base, Elementary) or base.kind not in (*COUNTED, Kind.BITS) or base.name not in ELEMENTARY:
        span = spec.base.span if spec.base else spec.span
        raise declared.report.reject("D002", f"The base of an enumeration is an integer type, not {base}.", span)
    values: dict[str, int] = {}
    shown: list[tuple[str, int]] = []
    number = -1
    low, high = bounds(base)
    for value_name, stated, span in spec.values:
        if value_name.upper() in values:
            declared.report.error("D001", f"`{value_name}` stands twice in this enumeration; rename one.", span)
            continue
        number = number + 1 if stated is None else int(declared.constant_of(stated, base).value)
        if not low <= number <= high:
            raise declared.report.reject("S004", f"`{value_name}` is number {number}, which does not fit {base}.", span)
        values[value_name.upper()] = number
        shown.append((value_name, number))
    made = name or f"({', '.join(each for each, _ in shown)})"
    return Enumeration(made, base.kind, base.size, tuple(shown), base.name)


def subrange(declared: "Declarations", spec: tree.SubrangeSpec, name: str) -> Subrange:
    """An integer with bounds; a subrange of a subrange stays inside of that."""
    base = declared.named(spec.base.name, spec.base.span)
    if not isinstance(base, Elementary) or base.kind not in COUNTED or isinstance(base, Enumeration):
        raise declared.report.reject("D002", f"A subrange is of an integer type, not of {base}.", spec.base.span)
    low = int(declared.constant_of(spec.low, base).value)
    high = int(declared.constant_of(spec.high, base).value)
    if low > high:
        raise declared.report.reject("D006", f"The lower bound {low} is above the upper bound {high}.", spec.low.span)
    base_name = base.base_name if isinstance(base, Subrange) else base.name
    return Subrange(name or f"{base_name} ({low}..{high})", base.kind, base.size, low, high, base_name)


def reference(declared: "Declarations", spec: tree.ReferenceSpec) -> Reference:
    target = declared.referred(spec.target)
    if isinstance(target, OpenArray):
        raise declared.report.reject("D002", "A reference needs an array with bounds, not ARRAY[*].", spec.span)
    word = "POINTER TO" if spec.pointer else "REFERENCE TO" if spec.automatic else "REF_TO"
    return Reference(f"{word} {target.name}", Kind.REF, SLOT_BYTES, target, spec.pointer, spec.automatic)


def structure(declared: "Declarations", name: str, spec: tree.StructSpec) -> Record:
    """A STRUCT or UNION with its members, those of its base first."""
    record = declared.record(name, Kind.UNION if spec.union else Kind.STRUCT)
    record.overlaps = spec.union or spec.overlap
    if spec.extends is not None:
        base = declared.named(spec.extends, spec.span)
        if not isinstance(base, Record) or base.kind is not Kind.STRUCT or spec.union:
            raise declared.report.reject("D002", f"A STRUCT can only extend a STRUCT, not {base}.", spec.span)
        record.inherit(base)
    for variable in spec.members:
        declared.declare(record, variable, Section.MEMBER, constant=False)
    if record.overlaps:
        for member in record.members.values():
            if has_instance(member.type):
                declared.report.error("D008", "An instance of a block cannot share its bytes with others.", member.span)
    record.close()
    return record


def is_relative(address: str) -> bool:
    """Whether it counts from the start of a structure: `%B4`, `%X3.0`."""
    return RELATIVE.fullmatch(address) is not None


def place_relative(declared: "Declarations", owner: Record, member: Member, address: str, span: Span) -> None:
    """Gives the member of a structure the place that it asks for."""
    match = RELATIVE.fullmatch(address)
    assert match is not None
    letter, unit, bit = match.group(1).upper(), int(match.group(2)), match.group(3)
    offset = unit * UNIT_BYTES[letter]
    is_bit = isinstance(member.type, Elementary) and member.type.kind is Kind.BOOL
    if (letter == "X") != is_bit:
        need = "a bit, `%X3.0`" if is_bit else "a byte or larger, `%B4`"
        raise declared.report.reject("D005", f"`{address}` does not fit {member.type}: it needs {need}.", span)
    if letter == "X":
        offset, member.bit = (unit, int(bit)) if bit is not None else divmod(unit, 8)
    elif bit is not None:
        raise declared.report.reject("D005", f"`{address}` has a bit number; only `%X` has one.", span)
    first, last = _bits(member, offset)
    for other in owner.members.values():
        low, high = _bits(other, other.offset)
        if not owner.overlaps and first < high and low < last:
            raise declared.report.reject(
                "D005",
                f"`{member.name}` shares bytes with `{other.name}`; write STRUCT OVERLAP if that is meant.",
                span,
            )
    owner.place_at(member, offset)


def _bits(member: Member, offset: int) -> tuple[int, int]:
    if member.bit is not None:
        return 8 * offset + member.bit, 8 * offset + member.bit + 1
    return 8 * offset, 8 * (offset + member.storage)


def place_bounds(owner: Record, member: Member) -> None:
    """The hidden bounds of an ARRAY[*] in-out, right behind its slot: low1, high1, low2, high2, ..."""
    assert isinstance(member.type, OpenArray)
    for dimension in range(1, member.type.dimensions + 1):
        for end in ("low", "high"):
            name = f"{member.name}${end}{dimension}"
            owner.place(Member(name, ELEMENTARY["LINT"], Section.INPUT, member.span, hidden=True))


def place_edge(owner: Record, member: Member, edge: str) -> None:
    """What an input with R_EDGE or F_EDGE needs: its value at the last call, and whether the edge is there now."""
    for name in ("previous", f"{edge.lower()}_edge"):
        owner.place(Member(f"{member.name}${name}", ELEMENTARY["BOOL"], Section.VAR, member.span, hidden=True))


class EnumerationValues:
    """Which enumerations have a value of some name."""

    def __init__(self, declared: "Declarations") -> None:
        self._declared = declared
        self._known = -1
        self._by_value: dict[str, list[str]] = {}
        self._inline: dict[str, list[tuple[str, Enumeration]]] = {}

    def add_inline(self, owner: str, type: Enumeration) -> None:
        """An enumeration that stands in a variable's declaration: known inside of that owner."""
        for name, _ in type.values:
            found = self._inline.setdefault(name.upper(), [])
            if (owner.upper(), type) not in found:
                found.append((owner.upper(), type))

    def find(self, name: str, owners: set[str]) -> list[Enumeration]:
        """All enumerations that have this value and are visible for one of `owners` (upper-case names)."""
        found: list[Enumeration] = []
        for key in self._named().get(name.upper(), []):
            try:
                made = self._declared.types.get(key) or self._declared.named(key, self._declared.type_trees[key].span)
            except Rejected:
                continue
            if isinstance(made, Enumeration) and made not in found:
                found.append(made)
        trees = self._declared.type_trees
        for owner, type in self._inline.get(name.upper(), []):
            visible = owner in owners or owner in trees or owner == "GLOBAL" or owner.startswith("STRUCT OF ")
            if visible and type not in found:
                found.append(type)
        return found

    def names(self) -> list[str]:
        """All values that are visible everywhere, for near matches."""
        return [
            name
            for declaration in self._declared.type_trees.values()
            if isinstance(declaration.type, tree.EnumSpec) and not declaration.qualified_only
            for name, _, _ in declaration.type.values
        ]

    def _named(self) -> dict[str, list[str]]:
        trees = self._declared.type_trees
        if self._known != len(trees):
            self._known = len(trees)
            self._by_value = {}
            for key, declaration in trees.items():
                if isinstance(declaration.type, tree.EnumSpec) and not declaration.qualified_only:
                    for name, _, _ in declaration.type.values:
                        self._by_value.setdefault(name.upper(), []).append(key)
        return self._by_value
