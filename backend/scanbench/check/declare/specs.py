"""Type specifications -> types."""

from dataclasses import replace

from scanbench.check.declare.declarations import Declarations
from scanbench.check.declare.members import MAX_BYTES, declare
from scanbench.check.declare.open_references import open_reference
from scanbench.check.dialect import Allowance
from scanbench.check.vendor_sizes import tell_bytes
from scanbench.problems import Span
from scanbench.program.origin import in_library
from scanbench.program.types import (
    ELEMENTARY,
    LARGEST_STEP,
    MAX_STRING,
    SLOT_BYTES,
    ArrayType,
    Elementary,
    Enumeration,
    Kind,
    Member,
    OpenArray,
    Record,
    Reference,
    Section,
    StringType,
    Subrange,
    Type,
    has_instance,
)
from scanbench.program.untyped import bounds
from scanbench.syntax import tree

COUNTED = (Kind.INT, Kind.UINT)
DEFAULT_STRING = 80
"""Characters of a string of the standard library that is declared without a length."""


def type_of(declared: Declarations, spec: tree.TypeSpec) -> Type:
    """The type that the specification says."""
    match spec:
        case tree.NamedType(name, span):
            if spec.values:
                raise declared.report.reject(
                    "D002", f"`{name}` has no generic constants; write it without `<` and `>`.", span
                )
            return declared.named(name, span)
        case tree.StringSpec(length, span, wide):
            return _string(declared, length, span, 2 if wide else 1)
        case tree.ArraySpec():
            return _array(declared, spec)
        case tree.StructSpec():
            record = structure(declared, f"STRUCT of line {spec.span.line}", spec)
            record.written_out = True
            return record
        case tree.OpenArraySpec(dimensions, element):
            return OpenArray(dimensions, _element(declared, element))
        case tree.EnumSpec():
            made = enumeration(declared, spec, "")
            declared.values.add_inline(declared.owners[-1].name if declared.owners else "GLOBAL", made)
            return made
        case tree.SubrangeSpec():
            return subrange(declared, spec, "")
        case tree.ReferenceSpec():
            return reference(declared, spec)


def _string(declared: Declarations, length: tree.Expression | None, span: Span, width: int) -> Type:
    if length is None:
        most = DEFAULT_STRING if in_library(span) else declared.dialect.text_length
        return _of_dialect(declared, StringType(most, width), span)
    value = declared.constant_of(length, None).value
    if not isinstance(value, int) or not 1 <= value <= MAX_STRING:
        raise declared.report.reject("D006", f"A STRING holds 1 to {MAX_STRING} characters, not {value!r}.", span)
    return _of_dialect(declared, StringType(value, width), span)


def _of_dialect(declared: Declarations, type: StringType, span: Span) -> StringType:
    """A string as the dialect stores it, and as the standard library does."""
    zero = Allowance.STRING_BYTES in declared.dialect.allows and type.width == 1 and not in_library(span)
    return replace(type, zero=True) if zero else type


def _element(declared: Declarations, spec: tree.TypeSpec) -> Type:
    """The type of an array's elements."""
    made = declared.type_of(spec)
    if isinstance(made, OpenArray):
        raise declared.report.reject("D008", "ARRAY[*] cannot be the element of an array; add dimensions.", spec.span)
    return made


def _array(declared: Declarations, spec: tree.ArraySpec) -> Type:
    bounds = []
    for low_tree, high_tree in spec.ranges:
        low, high = declared.constant_of(low_tree, None).value, declared.constant_of(high_tree, None).value
        if not isinstance(low, int) or not isinstance(high, int):
            raise declared.report.reject("D006", "The bounds of an array are integers.", low_tree.span)
        if not -(1 << 63) <= low <= high < 1 << 63 and low <= high:
            raise declared.report.reject("D006", "The bounds of an array fit LINT.", low_tree.span)
        if low > high:
            raise declared.report.reject(
                "D006", f"The lower bound {low} is above the upper bound {high}.", low_tree.span
            )
        bounds.append((low, high))
    made = ArrayType(tuple(bounds), _element(declared, spec.element))
    if made.size > MAX_BYTES:
        raise declared.report.reject("D012", f"This array takes {made.size} bytes; at most {MAX_BYTES}.", spec.span)
    if made.count > MAX_BYTES:  # of what takes no room
        raise declared.report.reject("D012", f"This array has {made.count} elements; at most {MAX_BYTES}.", spec.span)
    return made


def enumeration(declared: Declarations, spec: tree.EnumSpec, name: str) -> Enumeration:
    """An enumeration; one without a name of its own (inline) is named after its values."""
    base = declared.named(spec.base.name, spec.base.span) if spec.base else ELEMENTARY["INT"]
    if not isinstance(base, Elementary) or base.kind not in (*COUNTED, Kind.BITS) or base.name not in ELEMENTARY:
        span = spec.base.span if spec.base else spec.span
        raise declared.report.reject("D002", f"The base of an enumeration is an integer type, not {base}.", span)
    values: dict[str, int] = {}
    shown: list[tuple[str, int]] = []
    number = -1
    low, high = bounds(base)
    known = Record(name or "enumeration", Kind.STRUCT)
    for value_name, stated, span in spec.values:
        if value_name.upper() in values:
            declared.report.error("D001", f"`{value_name}` is twice in this enumeration; rename one.", span)
            continue
        number = number + 1 if stated is None else _value(declared, stated, base, known, shown)
        if not low <= number <= high:
            raise declared.report.reject("S004", f"`{value_name}` is number {number}, which does not fit {base}.", span)
        values[value_name.upper()] = number
        shown.append((value_name, number))
    made = name or f"({', '.join(each for each, _ in shown)})"
    return Enumeration(made, base.kind, base.size, tuple(shown), base.name)


def _value(
    declared: Declarations, stated: tree.Expression, base: Elementary, known: Record, shown: list[tuple[str, int]]
) -> int:
    """The number of a value, which may be computed from those before it."""
    if isinstance(stated, tree.Literal):
        return int(declared.constant_of(stated, base).value)
    for name, number in shown[len(known.members) :]:
        data = number.to_bytes(base.size, "little", signed=base.signed)
        known.place(Member(name, base, Section.VAR, stated.span, initial=data, constant=True))
    declared.owners.append(known)
    try:
        return int(declared.constant_of(stated, base).value)
    finally:
        declared.owners.pop()


def subrange(declared: Declarations, spec: tree.SubrangeSpec, name: str) -> Subrange:
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


def reference(declared: Declarations, spec: tree.ReferenceSpec) -> Reference | Record:
    """REF_TO, REFERENCE TO and POINTER TO; of an array of any size a structure that has its bounds, too."""
    target = declared.referred(spec.target)
    if isinstance(target, OpenArray):
        if spec.pointer or spec.automatic:
            raise declared.report.reject("D002", "A reference needs an array with bounds, not ARRAY[*].", spec.span)
        return open_reference(declared, target, spec.span)
    word = "POINTER TO" if spec.pointer else "REFERENCE TO" if spec.automatic else "REF_TO"
    return Reference(f"{word} {target.name}", Kind.REF, SLOT_BYTES, target, spec.pointer, spec.automatic)


def structure(declared: Declarations, name: str, spec: tree.StructSpec, pack: int = LARGEST_STEP) -> Record:
    """A STRUCT or UNION with its members, those of its base first. `pack`: the largest step at which they are placed, in bytes."""
    record = declared.record(name, Kind.UNION if spec.union else Kind.STRUCT)
    record.pack = pack
    record.overlaps = spec.union or spec.overlap
    if spec.extends is not None:
        base = declared.named(spec.extends.name, spec.extends.span)
        if not isinstance(base, Record) or base.kind is not Kind.STRUCT or spec.union:
            raise declared.report.reject("D002", f"A STRUCT can only extend a STRUCT, not {base}.", spec.span)
        record.inherit(base)
    for variable in spec.members:
        declare(declared, record, variable, Section.MEMBER, constant=False)
    if record.overlaps:
        for member in record.members.values():
            if has_instance(member.type):
                declared.report.error("D008", "An instance of a block cannot share its bytes with others.", member.span)
        _tell_union(declared, record)
    record.close()
    return record


def _tell_union(declared: Declarations, record: Record) -> None:
    """A time or date that shares its bytes with something else."""
    members = list(record.members.values())
    if any(each.type != members[0].type for each in members):
        for each in members:
            tell_bytes(declared.report, declared.dialect, each.type, each.span)
