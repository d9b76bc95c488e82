"""Temporaries of blocks, variables of FUNCTIONs and methods -> frames."""

from collections.abc import Iterator
from functools import partial

from scanbench.check.context import Rejected
from scanbench.check.declare.declarations import Declarations
from scanbench.check.declare.kept import is_kept
from scanbench.check.declare.later import ToDeclare
from scanbench.check.declare.members import declare, default_of
from scanbench.check.declare.names import qualified
from scanbench.check.dialect import Allowance
from scanbench.check.dialect_rules import said
from scanbench.program.types import ArrayType, Kind, Member, Record, Section, Type, has_instance
from scanbench.syntax import tree

CALLED = ("function", "method", "get", "set")
"""POUs whose variables all live in a frame."""
HOLDERS = {"function": "FUNCTION", "method": "METHOD", "get": "PROPERTY", "set": "PROPERTY"}


def frame(
    declared: Declarations, declaration: tree.PouDeclaration, instance: Record, this: Record | None = None
) -> Record:
    """Temporaries of a block; all variables of a FUNCTION, with the result under the function's name.

    A method begins with the in-out THIS; its variables may hide those of the instance.
    """
    declared.owners.append(this or instance)
    try:
        return _frame(declared, declaration, instance, this)
    finally:
        declared.owners.pop()


def _frame(declared: Declarations, declaration: tree.PouDeclaration, instance: Record, this: Record | None) -> Record:
    function = declaration.kind in CALLED
    if this is None:
        record = Record(qualified(declaration.namespace, declaration.name), Kind.STRUCT)
    else:
        part = f".{declaration.kind}" if declaration.kind in ("get", "set") else ""
        record = Record(f"{this.name}.{declaration.name}{part}", Kind.STRUCT)
        record.place(Member("THIS", this, Section.IN_OUT, declaration.span, hidden=True))
    coming: list[ToDeclare] = []
    for section in declaration.sections:
        kind = Section(section.keyword)
        if is_kept(declared, section) and (function or section.kept == "VAR_STAT"):
            continue
        if section.kept and declaration.kind in ("function", "method") and "CONSTANT" not in section.qualifiers:
            message = f"A {HOLDERS[declaration.kind]} keeps no variables; move them into the block or VAR_GLOBAL."
            declared.report.error("X001", message, section.span)
        if kind is Section.EXTERNAL or (not function and kind is not Section.TEMP):
            continue
        if kind is Section.GLOBAL:
            declared.report.error("D008", "VAR_GLOBAL belongs outside of POUs.", section.span)
            continue
        constant = "CONSTANT" in section.qualifiers
        for variable in section.variables:
            if variable.address is not None:
                declared.report.error("D008", "A temporary variable has no address.", variable.span)
                continue
            if variable.name.upper() in instance.members or (
                function and declaration.kind != "set" and variable.name.upper() == declaration.name.upper()
            ):
                declared.report.error("D001", f"`{variable.name}` is declared already; rename one.", variable.span)
                continue
            do = partial(_variable, declared, record, declaration, section, variable)
            coming.append((variable.name, constant, do, None))
    declared.later.declare(record, coming)
    if function and declaration.kind != "set" and declaration.result is not None:
        try:
            result = Member(declaration.name, declared.type_of(declaration.result), Section.RESULT, declaration.span)
            result.initial = default_of(declared, declaration.result, result.type)
            record.place(result)
        except Rejected:
            record.open = True
            declared.broken.add((record.name.upper(), declaration.name.upper()))
    record.close()
    return record


def _variable(
    declared: Declarations,
    record: Record,
    declaration: tree.PouDeclaration,
    section: tree.VariableSection,
    variable: tree.Variable,
) -> None:
    kind, called = Section(section.keyword), declaration.kind in CALLED
    if called and kind in (Section.INPUT, Section.OUTPUT) and isinstance(variable.type, tree.OpenArraySpec):
        _open_array(declared, record, variable, output=kind is Section.OUTPUT)
        return
    member = declare(declared, record, variable, kind, "CONSTANT" in section.qualifiers)
    if member and kind is not Section.IN_OUT and has_instance(member.type):
        _temporary_block(declared, member, HOLDERS.get(declaration.kind, "VAR_TEMP"))


def _temporary_block(declared: Declarations, member: Member, where: str) -> None:
    """An instance that lasts for one call, where the dialect has that; not where something in it is to have a reference of its
    own from the start."""
    parts = [*_parts(member.type)]
    bound = any(start.owner is part for start in declared.start_references for part in parts)
    waits = declared.incomplete and any(each.incomplete for part in parts for each in part.members.values())
    if Allowance.BLOCK_TEMPORARIES not in declared.dialect.allows or bound or waits:
        declared.report.error(
            "D008", f"An instance of {member.type.name} must keep its state; not in a {where}.", member.span
        )
        return
    used = f"`{member.name}` is initialised at each call of this {where}"
    declared.report.warn("W006", said(declared.dialect, Allowance.BLOCK_TEMPORARIES, used), member.span)


def _parts(type: Type) -> Iterator[Record]:
    """The records that are in a value of this type."""
    if isinstance(type, ArrayType):
        yield from _parts(type.element)
    elif isinstance(type, Record):
        yield type
        if type.base is not None:
            yield from _parts(type.base)
        for member in type.members.values():
            if not member.bound:
                yield from _parts(member.type)


def _open_array(declared: Declarations, record: Record, variable: tree.Variable, output: bool) -> None:
    """An input or output whose size comes with each call is referred to; an input is only read."""
    member = declare(declared, record, variable, Section.IN_OUT, constant=not output)
    if member is not None:
        member.output, member.open_input = output, not output
