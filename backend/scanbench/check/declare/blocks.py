"""PROGRAM, FUNCTION_BLOCK, CLASS and INTERFACE -> the variables of an instance."""

from functools import partial

from scanbench.check.declare.creations import MADE, lives
from scanbench.check.declare.declarations import TYPE_NAMES, Declarations
from scanbench.check.declare.kept import declare_kept, is_kept
from scanbench.check.declare.later import ToDeclare
from scanbench.check.declare.members import declare
from scanbench.check.declare.names import qualified
from scanbench.check.dialect import Allowance
from scanbench.program.origin import in_library
from scanbench.program.types import ULINT, Kind, Member, Record, Section
from scanbench.syntax import tree


def block(declared: Declarations, declaration: tree.PouDeclaration) -> Record:
    """The variables of an instance of a FUNCTION_BLOCK or PROGRAM; temporaries are in its frame."""
    role = Kind.INTERFACE if declaration.kind == "interface" else Kind.BLOCK
    record = declared.record(qualified(declaration.namespace, declaration.name), role)
    declared.inherit(record, declaration)
    if Allowance.LIFE in declared.dialect.allows and lives(declaration):
        _remembers(record, declaration)
    copied, coming = _copies(declared, declaration), list[ToDeclare]()
    for section in declaration.sections:
        kind = Section(section.keyword)
        if kind in (Section.TEMP, Section.EXTERNAL) or (section.kept == "VAR_STAT" and is_kept(declared, section)):
            continue
        if kind is Section.GLOBAL:
            declared.report.error("D008", "VAR_GLOBAL belongs outside of POUs.", section.span)
            continue
        called = Allowance.PROGRAM_CALLS in declared.dialect.allows
        if declaration.kind == "program" and kind is Section.IN_OUT and not called:
            declared.report.error("D008", "A PROGRAM has no VAR_IN_OUT here; use VAR_EXTERNAL.", section.span)
            continue
        constant = "CONSTANT" in section.qualifiers
        for variable in section.variables:
            do = partial(_variable, declared, record, section, variable, copied)
            coming.append((variable.name, constant, do, None))
    declared.later.declare(record, coming)
    for method in declaration.methods:
        declare_kept(declared, record, method)
    if any((record.name.upper(), key) in declared.computed for key in record.members if declared.computed):
        _remembers(record, declaration)
    record.close()
    return record


def _remembers(record: Record, declaration: tree.PouDeclaration) -> None:
    """An instance knows whether it was initialised."""
    if MADE.upper() not in record.members:
        record.place(Member(MADE, ULINT, Section.VAR, declaration.span, hidden=True, non_retain=True))


def _variable(
    declared: Declarations, record: Record, section: tree.VariableSection, variable: tree.Variable, copied: bool
) -> None:
    kind = Section(section.keyword)
    by_value = copied and kind is Section.IN_OUT and not _keeps_state(declared, variable.type)
    member = declare(declared, record, variable, kind, "CONSTANT" in section.qualifiers, by_value)
    if member is not None:
        member.access = section.access if kind is Section.VAR else "PUBLIC"
        member.retain = bool({"RETAIN", "PERSISTENT"} & set(section.qualifiers))
        member.persistent = "PERSISTENT" in section.qualifiers
        member.non_retain = "NON_RETAIN" in section.qualifiers


def _copies(declared: Declarations, declaration: tree.PouDeclaration) -> bool:
    """Whether a block takes its in-outs by value."""
    if declaration.kind != "function_block" or in_library(declaration.span):
        return False
    return (declaration.in_out or declared.model.in_out) == "value"


def _keeps_state(declared: Declarations, spec: tree.TypeSpec, around: tuple[str, ...] = ()) -> bool:
    """Whether instances of blocks are in it, or its size comes with each call: such an in-out is always a reference."""
    match spec:
        case tree.OpenArraySpec():
            return True
        case tree.ArraySpec(element=element):
            return _keeps_state(declared, element, around)
        case tree.StructSpec():
            return bool(spec.extends) or any(_keeps_state(declared, each.type, around) for each in spec.members)
        case tree.NamedType(name, span):
            key = name.upper() if name.upper() in TYPE_NAMES else declared.find_type(name, span) or name.upper()
            if key in declared.block_trees or key in around:
                return True
            found = declared.type_trees.get(key)
            return found is not None and _keeps_state(declared, found.type, (*around, key))
        case _:
            return False
