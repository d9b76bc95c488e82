"""Variables -> members with offsets and initial values."""

from contextlib import suppress
from dataclasses import replace

from scanbench.check.body.notes import make_note, may_have_note
from scanbench.check.context import Rejected
from scanbench.check.declare.addresses import is_relative, locate, place_relative
from scanbench.check.declare.creations import FB_INIT
from scanbench.check.declare.declarations import Declarations
from scanbench.check.declare.initial_values import initial_image, with_references
from scanbench.check.declare.policies import project_policy
from scanbench.check.declare.start_references import start_with
from scanbench.check.declare.vendor_types import BIT, place_bit
from scanbench.check.dialect import Allowance
from scanbench.check.dialect_rules import said
from scanbench.program.types import (
    ELEMENTARY,
    SLOT_BYTES,
    ArrayType,
    Kind,
    Member,
    OpenArray,
    Record,
    Reference,
    Section,
    Subrange,
    Type,
    actual_name,
    has_instance,
    initial_of,
)
from scanbench.syntax import tree

MAX_BYTES = 64 * 1024 * 1024


def declare(
    declared: Declarations,
    owner: Record,
    variable: tree.Variable,
    section: Section,
    constant: bool,
    copied: bool = False,
) -> Member | None:
    """Adds the variable to its owner, unless its declaration is wrong; `copied` as in `Member`."""
    if variable.arguments and variable.initial is None and not _initialises(declared, variable.type):
        variable = _with_arguments(variable)
    declared.owners.append(owner)
    try:
        return _declare(declared, owner, variable, section, constant, copied)
    finally:
        declared.owners.pop()


def _declare(
    declared: Declarations, owner: Record, variable: tree.Variable, section: Section, constant: bool, copied: bool
) -> Member | None:
    key = variable.name.upper()
    if key in owner.members:
        first = owner.members[key].span
        declared.report.error(
            "D001", f"`{variable.name}` is declared already in line {first.line}; rename one.", variable.span
        )
        return None
    try:
        bound = section is Section.IN_OUT and not copied
        made = declared.referred(variable.type) if bound else declared.type_of(variable.type)
        path = variable.name if owner.name == "GLOBAL" else f"{owner.name}.{variable.name}"
        made = with_policy(made, variable.policy or project_policy(declared, path, variable.span))
        if isinstance(made, OpenArray) and section is not Section.IN_OUT:
            raise declared.report.reject(
                "D008",
                "ARRAY[*] is for VAR_IN_OUT, and for VAR_INPUT and VAR_OUTPUT of a FUNCTION or METHOD; state the bounds here.",
                variable.span,
            )
    except Rejected:
        declared.broken.add((owner.name.upper(), key))
        return None
    if section is not Section.IN_OUT and isinstance(made, Record) and _is(owner, made):
        declared.report.error("D003", f"`{owner.name}` contains itself, so it has no size.", variable.span)
        return None
    if isinstance(made, Record) and _is_program(declared, made):
        declared.report.error(
            "D002", f"`{made.name}` is a PROGRAM; only FUNCTION_BLOCKs have instances.", variable.span
        )
        return None
    if variable.address is not None and variable.address.endswith("*"):
        return _incomplete(declared, owner, variable, section, made)
    member = Member(variable.name, made, section, variable.span, constant=constant, copied=copied)
    member.hidden = variable.name[0] in "$#"  # made for a body, see `networks.memories`
    with suppress(Rejected):
        _start(declared, owner, member, variable)
        if variable.address is not None and not (section is Section.MEMBER and is_relative(variable.address)):
            locate(declared, member, variable)
    _place(declared, owner, member, variable)
    _created(declared, owner, member, variable)
    if owner.size > MAX_BYTES:
        declared.report.error("D012", f"`{owner.name}` takes more than {MAX_BYTES} bytes.", variable.span)
        owner.members.pop(key)
    return member


def _initialises(declared: Declarations, spec: tree.TypeSpec) -> bool:
    """Whether this is a block with FB_init, its own or that of a base: then that gets the arguments of a declaration."""
    seen: set[str] = set()
    while Allowance.LIFE in declared.dialect.allows and isinstance(spec, tree.NamedType):
        key = declared.find_type(spec.name, spec.span)
        block = declared.block_trees.get(key or "")
        if key is None or block is None or key in seen:
            return False
        if any(each.name.upper() == FB_INIT for each in block.methods):
            return True
        seen.add(key)
        if not block.extends:
            return False
        spec = block.extends[0]
    return False


def _created(declared: Declarations, owner: Record, member: Member, variable: tree.Variable) -> None:
    """Keeps what the declaration says of the blocks in the variable."""
    if Allowance.LIFE in declared.dialect.allows:
        if has_instance(member.type) and member.section is not Section.IN_OUT:
            given = variable.arguments if _initialises(declared, variable.type) else ()
            declared.creations.note(owner, member, replace(variable, arguments=given))
    elif variable.elements:
        declared.report.error(
            "D004", "The elements of an array have initial values, but no arguments: `:= [(member := value), ...]`.",
            variable.span,
        )  # fmt: skip


def _start(declared: Declarations, owner: Record, member: Member, variable: tree.Variable) -> None:
    """Gives the member what it starts with."""
    if member.section is Section.IN_OUT:
        member.initial = default_of(declared, variable.type, member.type) if member.copied else b""
        if variable.initial is not None:
            declared.report.error("D004", "An in-out has no initial value; it is bound at each call.", member.span)
    elif variable.initial is not None:
        declared.computed.pop((owner.name.upper(), member.name.upper()), None)
        member.initial, given = with_references(declared, variable.initial, member.type)
        start_with(declared, owner, member, given)
    else:
        member.initial = default_of(declared, variable.type, member.type)


def _incomplete(
    declared: Declarations, owner: Record, variable: tree.Variable, section: Section, made: Type
) -> Member | None:
    """`AT %I*`: a reference that VAR_CONFIG fills for each instance, and memory for when it does not."""
    span = variable.address_span or variable.span
    if section not in (Section.VAR, Section.GLOBAL) or has_instance(made) or isinstance(made, OpenArray):
        inside = section in (Section.MEMBER, Section.INPUT, Section.OUTPUT, Section.VAR, Section.GLOBAL)
        if inside and Allowance.UNLINKED_ADDRESSES in declared.dialect.allows:
            used = f"`{variable.name}` waits for an address, and is a variable like others until then"
            declared.report.warn("W006", said(declared.dialect, Allowance.UNLINKED_ADDRESSES, used), span)
            return _declare(declared, owner, replace(variable, address=None), section, False, False)
        declared.report.error("D005", "`AT %I*` is for elementary data in VAR and VAR_GLOBAL.", span)
        return None
    starts = initial_of(made)
    if variable.initial is not None and Allowance.UNLINKED_ADDRESSES in declared.dialect.allows:
        used = f"`{variable.name}` waits for an address, and has a value until then"
        declared.report.warn("W006", said(declared.dialect, Allowance.UNLINKED_ADDRESSES, used), span)
        starts = initial_image(declared, variable.initial, made)
    elif variable.initial is not None:
        declared.report.error("D004", "Give this its initial value in VAR_CONFIG, with its address.", span)
    type = Reference(f"REFERENCE TO {made.name}", Kind.REF, SLOT_BYTES, made, automatic=True)
    member = Member(variable.name, type, section, variable.span, incomplete=(variable.address or "").upper())
    declared.incomplete = True
    owner.place(member)
    owner.place(Member(own_memory(variable.name), made, Section.VAR, variable.span, initial=starts, hidden=True))
    return member


def _is_bit(declared: Declarations, spec: tree.TypeSpec) -> bool:
    named = isinstance(spec, tree.NamedType) and spec.name.upper() == BIT
    return named and Allowance.VENDOR_TYPES in declared.dialect.allows and BIT not in declared.type_trees


def _place(declared: Declarations, owner: Record, member: Member, variable: tree.Variable) -> None:
    if variable.address is not None and member.section is Section.MEMBER and is_relative(variable.address):
        try:
            place_relative(declared, owner, member, variable.address, variable.address_span or variable.span)
        except Rejected:
            owner.place(member)
        return
    if member.section is Section.MEMBER and _is_bit(declared, variable.type):
        place_bit(owner, member)
        return
    owner.place(member)
    if member.copied:
        owner.place(Member(actual_name(member.name), member.type, Section.IN_OUT, member.span, hidden=True))
    if isinstance(member.type, OpenArray):
        place_bounds(owner, member)
    if member.name.upper().rpartition(".")[2] in declared.looked_at and may_have_note(member):
        make_note(owner, member, initial_of(member.type) if member.bound else member.initial)
    if variable.edge:
        if member.section is not Section.INPUT or member.type != ELEMENTARY["BOOL"]:
            declared.report.error("D008", f"{variable.edge}_EDGE is for BOOL in VAR_INPUT.", variable.span)
        else:
            place_edge(owner, member, variable.edge)


def _is(owner: Record, made: Record) -> bool:
    """Whether they are one type; those that are written out have the same name where they begin in the same line."""
    return made.name.upper() == owner.name.upper() and not made.written_out


def _is_program(declared: Declarations, record: Record) -> bool:
    declaration = declared.block_trees.get(record.name.upper())
    return record.kind is Kind.BLOCK and declaration is not None and declaration.kind == "program"


def default_of(declared: Declarations, spec: tree.TypeSpec, made: Type) -> bytes:
    """What a variable of this type starts with when its declaration says nothing."""
    if isinstance(spec, tree.NamedType) and declared.defaults:
        key = declared.find_type(spec.name, spec.span)
        if key in declared.defaults:
            return declared.defaults[key]
    if isinstance(spec, tree.ArraySpec) and isinstance(made, ArrayType) and declared.defaults:
        return default_of(declared, spec.element, made.element) * made.count
    return initial_of(made)


def place_bounds(owner: Record, member: Member) -> None:
    """The hidden bounds of an ARRAY[*] in-out, right after its slot: low1, high1, low2, high2, ..."""
    assert isinstance(member.type, OpenArray)
    for dimension in range(1, member.type.dimensions + 1):
        for end in ("low", "high"):
            name = f"{member.name}${end}{dimension}"
            owner.place(Member(name, ELEMENTARY["LINT"], Section.INPUT, member.span, hidden=True))


def place_edge(owner: Record, member: Member, edge: str) -> None:
    """What an input with R_EDGE or F_EDGE needs: its value at the last call, and whether the edge is there now."""
    for name in ("previous", f"{edge.lower()}_edge"):
        owner.place(Member(f"{member.name}${name}", ELEMENTARY["BOOL"], Section.VAR, member.span, hidden=True))


def _with_arguments(variable: tree.Variable) -> tree.Variable:
    """`inst : FB(a := 1)` means `inst : FB := (a := 1)`."""
    members = tuple((each.name or "", each.value, each.span) for each in variable.arguments if each.value is not None)
    return replace(variable, initial=tree.StructInit(members, variable.span))


def own_memory(name: str) -> str:
    """The hidden variable of an `AT %I*` that is used as long as no address is given."""
    return f"{name}$memory"


def with_policy(type: Type, policy: str) -> Type:
    """The type whose subranges (its own, or those of its elements) say what becomes of a value outside."""
    match type:
        case Subrange() if policy:
            return replace(type, policy=policy)
        case ArrayType(bounds=found, element=element) if policy:
            return ArrayType(found, with_policy(element, policy))
    return type
