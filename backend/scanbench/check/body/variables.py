"""Names -> variables, as they are declared."""

import re

from scanbench.check.body.allowed import used
from scanbench.check.body.context import Body, Found
from scanbench.check.context import Rejected
from scanbench.check.declare.programs import PROGRAMS
from scanbench.check.declare.scopes import place_of
from scanbench.check.dialect import Allowance
from scanbench.check.uses import Symbol, variable_symbol
from scanbench.problems import Span
from scanbench.program.program import Base, Place
from scanbench.program.sites import TrapKind
from scanbench.program.types import Member, Record, Section
from scanbench.syntax import tree
from scanbench.syntax.lexer import GLOBAL_MARK, NOTHING
from scanbench.syntax.networks import WIRE
from scanbench.syntax.scl import is_scl

INSTANCE = ("THIS", "SUPER")
_NUMBERED = re.compile(r"DB\d{1,5}", re.IGNORECASE)


def declared(body: Body, name: str, span: Span) -> Found:
    """The variable that is declared under this name; of an input with an edge, the edge."""
    found = body.scope.find(name)
    name = name.removeprefix(GLOBAL_MARK)
    if name.upper() in INSTANCE and (found is None or found[0].hidden):
        return body.lookup.this(body, name, span), None
    if found is None:
        raise body.lookup.unknown(body, name, span)
    member, base, owner = found
    if owner.name == PROGRAMS:
        used(body, Allowance.PROGRAM_CALLS, span, f"`{name}` is a PROGRAM")
        body.report.use(span, name, Symbol("pou", "", name.upper()))
    elif not member.hidden:
        body.report.use(span, name, variable_symbol(member, owner))
    null = 0
    if member.bound:
        null = body.trap(TrapKind.NULL, span, f"the in-out {member.name} is not connected")
    return _edge(member, base, owner) or place_of(member, base, owner, null), member


def _edge(member: Member, base: Base, owner: Record) -> Place | None:
    """Of an input with R_EDGE or F_EDGE, inside its block: whether the edge is there."""
    if member.section is not Section.INPUT or base is Base.IMAGE:
        return None
    for edge in ("R", "F"):
        hidden = owner.members.get(f"{member.name}${edge}_EDGE".upper())
        if hidden is not None:
            return place_of(hidden, base, owner, 0)
    return None


def undeclared(body: Body, name: str, span: Span) -> Rejected:
    """Reports a name that means nothing here."""
    upper = name.upper()
    if name == NOTHING or upper in body.unmade:  # reported
        return Rejected()
    constants = body.scope.constants
    if name.startswith(WIRE):
        hint = body.report.near(name, lambda: list(body.scope.wires), "wire")
        return body.report.reject(
            "T001", f"Nothing sets `{name}` in this network, to which a wire belongs.{hint}", span
        )
    owners = (body.scope.pou.upper(), "GLOBAL", *(each.name.upper() for each in constants))
    if {(owner, upper) for owner in owners} & body.declarations.broken:
        return Rejected()
    if body.scope.later is not None:
        keys = (upper, *body.scope.space.candidates(upper))
        why = body.scope.later.why((*constants, body.scope.globals), keys, name, span)
        if why is not None:
            return why
    if upper in body.pous.functions:
        return body.report.reject("T010", f"`{name}` is a FUNCTION; call it with `{name}(...)`.", span)
    block = body.declarations.block_trees.get(upper)
    if block is not None and block.kind == "program":
        return body.report.reject(
            "T010", f"`{name}` is a PROGRAM; declare in VAR_GLOBAL what others share with it.", span
        )
    if block is not None:
        return body.report.reject("T010", f"`{name}` is a type; declare an instance of it in VAR.", span)
    hint = body.report.near(name, lambda: _known(body), "variable")
    if body.declarations.model.locate(name) is not None:  # after AT it needs no percent sign
        hint += f" The address of the PLC is written `%{name}` in statements; or declare a variable AT it."
    if not hint and _NUMBERED.fullmatch(name) and is_scl(span.file):
        hint = f" Sources name data blocks, and say no numbers: declare `DATA_BLOCK {name}`, or write the name of the block."
    return body.report.reject("T001", f"`{name}` is not declared.{hint}", span)


def _known(body: Body) -> list[str]:
    functions = (pou.name for pou in body.pous.functions.values())
    return [*body.scope.names(), *functions, *body.declarations.values.names()]


def _shown(record: Record) -> list[str]:
    return [each.name for each in record.members.values() if not each.hidden]


def no_member(body: Body, record: Record, node: tree.MemberOf) -> Rejected:
    """Reports a member that is not there, unless its declaration was reported."""
    if record.open or is_broken(body, record, node.name):
        return Rejected()
    owner = body.pous.classes.of(record)
    if owner is not None and owner.find(node.name.upper()) is not None:
        said = f"`{node.name}` is a method of `{record.name}`; call it with `{node.name}(...)`."
        return body.report.reject("T010", said, node.span)
    hint = body.report.near(node.name, lambda: _shown(record), f"member:{record.name}")
    return body.report.reject("T001", f"`{record.name}` has no member `{node.name}`.{hint}", node.span)


def is_broken(body: Body, record: Record, name: str) -> bool:
    """Whether it, or what it extends, declares this, and was refused there."""
    known: Record | None = record
    while known is not None:
        if (known.name.upper(), name.upper()) in body.declarations.broken:
            return True
        known = known.base
    return False
