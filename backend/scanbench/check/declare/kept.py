"""VAR_INST and VAR_STAT of vendors: what methods and functions keep between calls.

VAR_INST of a method is a hidden variable of the block, so each instance has it. VAR_STAT is a hidden global variable.
"""

from collections.abc import Iterable, Iterator
from dataclasses import replace

from scanbench.check.declare.declarations import Declarations
from scanbench.check.declare.members import declare
from scanbench.check.declare.names import Space, qualified
from scanbench.check.dialect import Allowance
from scanbench.check.dialect_rules import said
from scanbench.program.program import Base
from scanbench.program.types import Member, Record, Section
from scanbench.syntax import tree


def is_kept(declared: Declarations, section: tree.VariableSection) -> bool:
    """Whether the variables of this section are kept by the dialect's rules."""
    return Allowance.KEPT_VARIABLES in declared.dialect.allows and _is_kept(section)


def _is_kept(section: tree.VariableSection) -> bool:
    return section.kept != "" and "CONSTANT" not in section.qualifiers


def declare_kept(declared: Declarations, record: Record, method: tree.PouDeclaration) -> None:
    """Adds the VAR_INST of a method to its block."""
    for section in method.sections:
        if section.kept == "VAR_INST" and is_kept(declared, section):
            _tell(declared, section)
            for variable in section.variables:
                member = declare(declared, record, replace(variable, name=_name(method, variable)), Section.VAR, False)
                if member is not None:
                    member.hidden, member.retain = True, bool({"RETAIN", "PERSISTENT"} & set(section.qualifiers))
                    member.persistent = "PERSISTENT" in section.qualifiers


def declare_static(declared: Declarations, variables: Record, pous: Iterable[tree.PouDeclaration]) -> None:
    """Adds every VAR_STAT to the global variables."""
    for pou in pous:
        with declared.names.within(Space(pou.namespace, pou.using)):
            for holder, key in _holders(pou):
                for section in holder.sections:
                    if section.kept == "VAR_STAT" and is_kept(declared, section):
                        _tell(declared, section)
                        for variable in section.variables:
                            named = replace(variable, name=f"{key}${variable.name}")
                            member = declare(declared, variables, named, Section.GLOBAL, False)
                            if member is not None:
                                member.hidden = True


def _holders(pou: tree.PouDeclaration) -> Iterator[tuple[tree.PouDeclaration, str]]:
    name = qualified(pou.namespace, pou.name)
    yield pou, name
    for method in pou.methods:
        yield method, f"{name}.{method.name}.{method.kind}"


def _name(method: tree.PouDeclaration, variable: tree.Variable) -> str:
    return f"{method.name}.{method.kind}${variable.name}"


def _tell(declared: Declarations, section: tree.VariableSection) -> None:
    used = f"{section.kept} keeps its variables between calls"
    declared.report.warn("W006", said(declared.dialect, Allowance.KEPT_VARIABLES, used), section.span)


def kept_of(
    declaration: tree.PouDeclaration, around: tree.PouDeclaration | None, instance: Record, variables: Record
) -> dict[str, tuple[Member, Base, Record]]:
    """What a body finds under the names of its VAR_INST and VAR_STAT; `around` is the block of a method."""
    found: dict[str, tuple[Member, Base, Record]] = {}
    for holder, key in _holders(declaration if around is None else around):
        if holder is not around and holder is not declaration:
            continue
        for section in holder.sections:
            for variable in section.variables if _is_kept(section) else ():
                own = instance.members.get(_name(holder, variable).upper())
                static = variables.members.get(f"{key}${variable.name}".upper())
                if section.kept == "VAR_INST" and own is not None:
                    found[variable.name.upper()] = own, Base.SELF, instance
                elif section.kept == "VAR_STAT" and static is not None:
                    found[variable.name.upper()] = static, Base.IMAGE, variables
    return found
