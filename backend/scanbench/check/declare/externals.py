"""VAR_EXTERNAL of a POU -> the global variables that it means."""

from contextlib import suppress

from scanbench.check.context import Rejected
from scanbench.check.declare.declarations import Declarations
from scanbench.check.declare.names import Space
from scanbench.check.declare.scopes import Scope
from scanbench.check.uses import variable_symbol
from scanbench.program.types import Member, Record, Section
from scanbench.syntax import tree


def externals_of(
    declared: Declarations,
    variables: Record,
    declaration: tree.PouDeclaration,
    own: tuple[Record, Record],
    space: Space,
) -> dict[str, Member]:
    """By upper-case name. `variables`: all globals; `own`: the records of the POU, whose names are taken."""
    report = declared.report
    found: dict[str, Member] = {}
    visible = Scope("", variables, space=space)
    for section in declaration.sections:
        if section.keyword != Section.EXTERNAL:
            continue
        for variable in section.variables:
            key = variable.name.upper()
            if any(key in record.members for record in own):
                report.error("D001", f"`{variable.name}` is declared already; rename one.", variable.span)
            known = visible.find(variable.name)
            if known is None:
                hint = report.near(variable.name, lambda: [each.name for each in variables.members.values()], "global")
                report.error("D007", f"There is no VAR_GLOBAL `{variable.name}`.{hint}", variable.span)
                continue
            report.use(variable.span, variable.name, variable_symbol(known[0], known[2]))
            with suppress(Rejected):
                _same_type(declared, known[0], variable)
                found[key] = known[0]
    return found


def _same_type(declared: Declarations, member: Member, variable: tree.Variable) -> None:
    said = declared.type_of(variable.type)
    if said != member.type:
        declared.report.error("D007", f"The VAR_GLOBAL `{member.name}` is {member.type}, not {said}.", variable.span)
