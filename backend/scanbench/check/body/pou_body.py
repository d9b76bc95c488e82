"""The body of a POU, in ST, IL, LD, FBD or SFC -> checked statements."""

from dataclasses import replace
from functools import partial

from scanbench.check.body.by_value import around
from scanbench.check.body.chart import chart_statements
from scanbench.check.body.context import Body
from scanbench.check.body.edges import edges
from scanbench.check.body.il import InstructionList
from scanbench.check.body.jumps import parted
from scanbench.check.body.network_body import network_statements
from scanbench.check.body.notes import SUFFIX as NOTE
from scanbench.check.body.overlays import overlaid
from scanbench.check.body.redundant_checks import without_needless
from scanbench.check.body.statements import block
from scanbench.check.context import Rejected
from scanbench.check.declare.scopes import decode, place_of
from scanbench.check.life.start import Writer
from scanbench.program.program import Assign, Base, Blocks, SetBytes, Stmt
from scanbench.program.sites import TrapKind
from scanbench.program.types import Member, Section, StringType, has_instance
from scanbench.syntax import tree
from scanbench.syntax.chart import Chart
from scanbench.syntax.networks import NetworkBody


def pou_body(body: Body, declaration: tree.PouDeclaration) -> tuple[Stmt, ...]:
    """The body of a POU, in the language in which it is written."""
    written = declaration.body
    body.counters, body.followed, body.loops, body.final = [], [], 0, None
    prologue, checks = _prologue(body), len(body.report.checks)
    if body.pou is not None and body.pou.kind != "function":
        prologue += edges(body.pou.instance)
    match written:
        case tree.IlBody():
            made = InstructionList(body, written).statements()
        case NetworkBody():
            made = network_statements(body, written)
        case Chart():
            made = chart_statements(body, written)
        case _:
            made = _text(body, _overlaid(body, declaration, written))
    if len(body.report.checks) > checks:
        made = without_needless(body.report, tuple(made))
    if body.pou is not None and body.pou.kind == "function_block":
        made = around(body.pou.instance, tuple(made), partial(_not_connected, body))
    return (*prologue, *made)


def _overlaid(
    body: Body, declaration: tree.PouDeclaration, written: tuple[tree.Statement, ...]
) -> tuple[tree.Statement, ...]:
    """With what keeps the variables that are AT others."""
    try:
        return overlaid(body, declaration.overlays, written) if declaration.overlays else written
    except Rejected:
        return written


def _text(body: Body, written: tuple[tree.Statement, ...]) -> tuple[Stmt, ...]:
    """Structured Text; with labels, one `Blocks`."""
    parts = parted(body, written)
    made = []
    for number, part in enumerate(parts):
        body.block = number
        made.append(block(body, part))
    return made[0] if len(made) == 1 else (Blocks(tuple(made), written[0].span),)


def _not_connected(body: Body, member: Member) -> int:
    return body.trap(TrapKind.NULL, member.span, f"the in-out {member.name} is not connected")


def _prologue(body: Body) -> list[Stmt]:
    """Temporaries start afresh at every call."""
    frame = body.scope.frame
    made: list[Stmt] = []
    for member in frame.members.values() if frame else ():
        made_up = member.hidden and not member.name.endswith(NOTE)
        if member.section in (Section.INPUT, Section.IN_OUT) or frame is None or made_up:
            continue
        place = place_of(member, Base.FRAME, frame, 0)
        if has_instance(member.type):
            place = replace(place, variable="")  # its variables are known by their own names
        data = member.initial or bytes(member.type.size)
        constant = decode(member.type, data)
        if constant is not None and not isinstance(member.type, StringType):
            made.append(Assign(place, constant, member.span))
        else:
            made.append(SetBytes(place, data, member.span))
    made += _initialised(body)
    instance = body.scope.instance
    if body.pou is not None and body.pou.kind == "function_block" and instance is not None:
        # what this block wrote to an in-out at an earlier call says nothing of what is bound to it now
        for each in instance.members.values():
            if each.section is Section.IN_OUT and each.note is not None:
                made.append(SetBytes(place_of(each.note, Base.SELF, instance, 0), each.note.initial, each.span))
    return made


def _initialised(body: Body) -> list[Stmt]:
    """FB_init and what belongs to it, of the blocks among the temporaries."""
    frame, code = body.scope.frame, body.pous.life
    if frame is None or code is None:
        return []
    temporary = (Section.TEMP, Section.VAR, Section.OUTPUT)
    found = [each for each in code.needs.members(frame) if each.section in temporary]
    if not found:
        return []
    return Writer(body, code, lambda member: place_of(member, Base.FRAME, frame, 0), passed_on=False).members(
        frame, found, True
    )
