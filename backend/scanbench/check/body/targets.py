"""Places that may be written."""

from scanbench.check.body.allowed import allowed
from scanbench.check.body.context import Body, Found
from scanbench.check.context import Borrowed
from scanbench.check.declare.programs import PROGRAMS
from scanbench.check.dialect import Allowance
from scanbench.check.uses import Symbol
from scanbench.problems import Problem, Span
from scanbench.program.own_variables import SYSTEM
from scanbench.program.program import Place
from scanbench.program.shown import shown
from scanbench.program.types import Member, OpenArray, Section
from scanbench.syntax import tree


def target(body: Body, node: tree.Expression, how: str = "", reader: Symbol | None = None) -> Place:
    """A place that may be written; `how` is told of one that may only be read: how to read it. `reader` is the in-out that
    it is passed to: then it may only be read as well, unless anything writes to the in-out."""
    return declared_target(body, node, how, reader)[0]


def declared_target(body: Body, node: tree.Expression, how: str = "", reader: Symbol | None = None) -> Found:
    """The same, and the declared variable that it is, or is inside of."""
    place, member = body.place(node)
    _not_peeked(body, node)
    note_written(body, node)
    if _within_output(body, member, node):
        body.effects.assignable(body, place, None, node.span, how, reader)
    else:
        body.effects.assignable(body, place, member, node.span, how, reader)
    return place, member


def _within_output(body: Body, member: Member | None, node: tree.Expression) -> bool:
    """Whether it is a member of a structure that is an output of another block, and the dialect lets that be written."""
    inner = variable(node)
    if member is None or member.section is not Section.OUTPUT or member.constant or _is_own(body, member):
        return False
    if not isinstance(inner, tree.MemberOf) or inner.name.upper() == member.name.upper():
        return False
    what = f"`{shown(inner)}` is a part of the output `{member.name}` and is written here"
    return allowed(body, Allowance.OUTSIDE_PARTS, node.span, what)


def _not_peeked(body: Body, node: tree.Expression) -> None:
    """Refuses to write what the dialect lets be read only."""
    inner, written = node, variable(node)
    while body.peeked and isinstance(inner, tree.IndexOf | tree.PartialAccess | tree.MemberOf):
        if inner.span in body.peeked:
            what = f"`{shown(inner)}` is internal of its block and is written here"
            if allowed(body, Allowance.BLOCK_WRITES, inner.span, what):
                return
            deeper = isinstance(written, tree.MemberOf) and written.span != inner.span
            if (deeper or _of_program(body, inner)) and allowed(body, Allowance.OUTSIDE_PARTS, inner.span, what):
                return
            raise body.report.reject(
                "T003", "A variable of a block can be read from outside, but only its block writes it.", inner.span
            )
        inner = inner.array if isinstance(inner, tree.IndexOf) else inner.owner


def _of_program(body: Body, node: tree.Expression) -> bool:
    """Whether it is `Program.variable`."""
    owner = node.owner if isinstance(node, tree.MemberOf) else None
    found = body.scope.find(owner.name) if isinstance(owner, tree.Name) else None
    return found is not None and found[2].name == PROGRAMS


def note_written(body: Body, node: tree.Expression, may_read: bool = False) -> None:
    """Notes that a variable is written there, and read, too, where it `may_read`."""
    changed = variable(node)
    body.report.written.append(changed.span)
    if may_read:
        body.report.lent.append(changed.span)
    while isinstance(changed, tree.MemberOf):  # a part of it is written
        changed = variable(changed.owner)
        body.report.written.append(changed.span)


def variable(node: tree.Expression) -> tree.Expression:
    """The variable that is written where an element or a part of it is."""
    while isinstance(node, tree.IndexOf | tree.PartialAccess):
        node = node.array if isinstance(node, tree.IndexOf) else node.owner
    return node


def assignable(
    body: Body, place: Place, member: Member | None, span: Span, how: str = "", reader: Symbol | None = None
) -> None:
    """Refuses what cannot be assigned: constants, outputs of others, memory that the model protects."""
    if member is not None:
        if member.constant and member.section is Section.IN_OUT and isinstance(member.type, OpenArray):
            used = f"`{member.name}` is an input, and is the array that was passed to it"
            if member.open_input and allowed(body, Allowance.OPEN_INPUTS, span, used):
                return
            raise body.report.reject("T003", f"`{member.name}` can only be read here.", span)
        if member.constant:
            what = "is a CONSTANT and cannot" if member.home != SYSTEM.name else "counts by itself and cannot"
            raise body.report.reject("T003", f"`{member.name}` {what} be assigned.", span)
        owner = body.scope.find(member.name)
        own = owner is not None and owner[0] is member
        if member.section is Section.INPUT and own and body.scope.instance is not None and place.slot is None:
            body.report.warn("W001", f"`{member.name}` is an input; the next call overwrites this.", span)
        if member.section is Section.OUTPUT and not own and not _own(body, member):
            if allowed(
                body, Allowance.BLOCK_WRITES, span, f"`{member.name}` is an output of its block and is written here"
            ):
                writable(body, place, span, how, reader)
                return
            raise body.report.reject("T003", f"`{member.name}` is an output; only its block writes it.", span)
    writable(body, place, span, how, reader)


def _is_own(body: Body, member: Member) -> bool:
    """Whether it is a variable of what is checked itself."""
    owner = body.scope.find(member.name)
    return (owner is not None and owner[0] is member) or _own(body, member)


def _own(body: Body, member: Member) -> bool:
    """Whether it is a member of the instance that runs, as in THIS.member."""
    instance = body.scope.instance
    return instance is not None and instance.members.get(member.name.upper()) is member


def writable(body: Body, place: Place, span: Span, how: str = "", reader: Symbol | None = None) -> None:
    """Refuses memory that the model protects from the program; `how` says how to read it there. What is passed to an in-out,
    the `reader`, is looked at when all bodies are known."""
    if place.variable != "@":
        return
    model = body.declarations.model
    for area in model.areas:
        start = body.declarations.areas[area.name]
        if start <= place.offset < start + area.size:
            byte, bit = place.offset - start, place.bit
            word = area.protected(byte, 1 if bit is not None else place.type.size, body.scope.who)
            if word is not None:
                bits, byte = (16, 2 * word) if bit is None else (1, byte)
                where = model.format(area, byte, bit, bits)
                message = f"{where} is read-only for the program on a {model.name}; it can only be read.{how}"
                if reader is None:
                    raise body.report.reject("T011", message, span)
                body.report.borrowed.append(Borrowed(reader, Problem("T011", message, span)))
                return
