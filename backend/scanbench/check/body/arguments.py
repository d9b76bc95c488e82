"""Arguments of a call -> the actual parameter of each formal one."""

from dataclasses import dataclass, field, replace

from scanbench.check.body import fold, targets
from scanbench.check.body.allowed import allowed, may
from scanbench.check.body.coercion import as_type, coerce
from scanbench.check.body.context import Body
from scanbench.check.body.counting import lent_counter
from scanbench.check.body.direct import as_argument
from scanbench.check.body.elements import array_bounds
from scanbench.check.body.longer_texts import copied_texts
from scanbench.check.body.places import VARIABLES
from scanbench.check.body.receivers import is_variable
from scanbench.check.body.short_times import cut_here
from scanbench.check.body.subrange_checks import arriving, has_subranges, keeping, noting, with_note
from scanbench.check.body.targets import declared_target
from scanbench.check.body.variables import is_broken
from scanbench.check.context import Borrowed, Rejected
from scanbench.check.declare.scopes import decode
from scanbench.check.dialect import Allowance
from scanbench.check.system.system_text import STOP
from scanbench.check.uses import Symbol, variable_symbol
from scanbench.problems import Problem, Span
from scanbench.program.origin import in_library, is_system
from scanbench.program.program import (
    Assign,
    CallFunction,
    Const,
    Evaluate,
    Expr,
    Halt,
    If,
    Load,
    Place,
    Pou,
    Sequence,
    SetBytes,
    Stmt,
)
from scanbench.program.shown import shown
from scanbench.program.sites import TrapKind
from scanbench.program.types import (
    BOOL,
    INT,
    ArrayType,
    Elementary,
    Enumeration,
    Kind,
    Member,
    OpenArray,
    Record,
    Section,
    StringType,
    Subrange,
    Type,
    base_of,
    initial_of,
    is_derived,
)
from scanbench.syntax import tree


@dataclass(slots=True)
class Invocation:
    """A call of a FUNCTION or method, and what has to run around it."""

    call: CallFunction
    before: list[Stmt] = field(default_factory=list)
    after: list[Stmt] = field(default_factory=list)

    def statements(self, span: Span, result: Place | None = None) -> list[Stmt]:
        """All of it; the result goes to `result`, or is dropped."""
        call: Stmt = Evaluate(self.call, span) if result is None else Assign(result, self.call, span)
        return [*self.before, call, *self.after]


@dataclass(slots=True)
class Bindings:
    """What a call gives to its callee, by upper-case formal name."""

    inputs: dict[str, Expr] = field(default_factory=dict)
    places: dict[str, Place] = field(default_factory=dict)
    """In-outs, and outputs that are taken as they are."""
    before: list[Stmt] = field(default_factory=list)
    after: list[Stmt] = field(default_factory=list)


def by_formal(
    body: Body, node: tree.Call, formals: list[Member], owner: Record, callee: str
) -> dict[str, tree.Argument]:
    """Arguments by upper-case formal name. `owner` has the formals."""
    formals = [each for each in formals if not each.hidden]
    given: dict[str, tree.Argument] = {}
    positions = by_position(formals, sum(each.name is None for each in node.arguments))
    if _is_mixed(node):
        if not allowed(body, Allowance.MIXED_ARGUMENTS, node.span, "Arguments by position come after those by name"):
            raise body.report.reject("T004", "Arguments by position come before those by name.", node.span)
        taken = {each.name.upper() for each in node.arguments if each.name is not None}
        positions = [each for each in positions if each.name.upper() not in taken]
    index = -1
    for argument in node.arguments:
        if argument.name is None:
            index += 1
            if index >= len(positions):
                if owner.open or any(name == owner.name.upper() for name, _ in body.declarations.broken):
                    raise Rejected
                raise body.report.reject(
                    "T004", f"`{callee}` takes {_taken(formals)}, not {len(node.arguments)}.", argument.span
                )
            given[positions[index].name.upper()] = argument
            continue
        member = _formal(body, argument, argument.name, formals, owner, callee)
        if argument.place is not None:
            body.report.use(argument.place, argument.name, variable_symbol(member, owner))
            if member.section is Section.INPUT:
                body.report.written.append(argument.place)
        if member.name.upper() in given:
            raise body.report.reject("T004", f"`{argument.name}` is given twice.", argument.span)
        given[member.name.upper()] = argument
    return given


def _is_mixed(node: tree.Call) -> bool:
    """Whether an argument by position comes after one by name."""
    names = [each.name is not None for each in node.arguments]
    return True in names and False in names[names.index(True) :]


def by_position(formals: list[Member], count: int) -> list[Member]:
    """What so many arguments by position go to: inputs and in-outs in order; where there are more, outputs take their part, too."""
    shown = [each for each in formals if not each.hidden]
    inward = [each for each in shown if each.given in (Section.INPUT, Section.IN_OUT)]
    outward = (Section.INPUT, Section.IN_OUT, Section.OUTPUT)
    every = [each for each in shown if each.given in outward and each.name.upper() != "ENO" and not _of_system(each)]
    return every if count > len(inward) else inward


def _of_system(member: Member) -> bool:
    """Whether it is an output of a model's instruction, which has arguments of its own kind only."""
    return member.section is Section.OUTPUT and is_system(member.span)


def _formal(
    body: Body, argument: tree.Argument, name: str, formals: list[Member], owner: Record, callee: str
) -> Member:
    member = next((each for each in formals if each.name.upper() == name.upper()), None)
    if member is None and (owner.open or is_broken(body, owner, name)):
        raise Rejected
    if member is None:
        hint = body.report.near(name, lambda: [each.name for each in formals], f"argument:{callee}")
        raise body.report.reject("T004", f"`{callee}` has no argument `{name}`.{hint}", argument.span)
    if argument.output != (member.given is Section.OUTPUT):
        arrow = "=>" if member.given is Section.OUTPUT else ":="
        raise body.report.reject(
            "T004", f"`{member.name}` is {member.given.value}: write `{member.name} {arrow} ...`.", argument.span
        )
    return member


def invoke(body: Body, node: tree.Call, callee: Pou, name: str, this: Place | None, eno: Place | None) -> Invocation:
    """The call of a FUNCTION or method. `eno` receives its ENO, where it has one."""
    members = [callee.frame.members[key] for key in callee.parameters]
    given = by_formal(body, node, members, callee.frame, name)
    bound = Bindings()
    for member in members:
        if not member.hidden:
            _bind(body, member, callee.frame, given.get(member.name.upper()), bound, node.span, name)
    if eno is not None and "ENO" in callee.parameters:
        bound.places["ENO"] = eno
    if this is not None:
        bound.places["THIS"] = this
    for member in members:
        if member.hidden and "$" in member.name and member.name.upper() not in bound.inputs:
            bound.inputs[member.name.upper()] = open_bound(member, bound.places)
    args = tuple(bound.inputs.get(key, bound.places.get(key)) for key in callee.parameters)
    body.pous.use(body.pou, callee)
    call = CallFunction(callee, callee.result, args, body.calls_at(node.span))
    return Invocation(call, bound.before, bound.after)


def as_value(body: Body, made: Invocation, span: Span) -> Expr:
    """The call as an expression."""
    if made.call.type is None and made.call.pou.frame.open:
        raise Rejected  # the type of its result was refused
    if made.call.type is None:
        raise body.report.reject("T010", f"`{made.call.pou.name}` has no result; call it as a statement.", span)
    # the library computes in nanoseconds
    value = cut_here(body, made.call) if made.call.pou.inline else made.call
    if not made.before and not made.after:
        return value
    if not made.after:
        return Sequence(tuple(made.before), value)
    result = body.temporary(made.call.type, span)
    return Sequence(tuple(made.statements(span, result)), Load(result))


def _bind(
    body: Body, member: Member, owner: Record, argument: tree.Argument | None, bound: Bindings, span: Span, callee: str
) -> None:
    key = member.name.upper()
    value = argument.value if argument else None
    if member.section is Section.IN_OUT:
        bound.places[key] = in_out(body, member, owner, value, span, bound.before, once=True)
    elif member.section is Section.INPUT:
        # what may be left out has a default, or is a text
        needed = is_system(member.span) and not any(member.initial) and not isinstance(member.type, StringType)
        if value is None and needed:
            raise body.report.reject("T004", f"`{callee}` needs a number: `{callee}({member.name} := 1)`.", span)
        given = _input(body, member, value, span)
        if member.note is not None and isinstance(member.type, Subrange):
            given, bound.inputs[member.note.name.upper()] = with_note(body, given, member.type, span)
        bound.inputs[key] = given
    elif key == STOP and in_library(member.span):
        stop = bound.places[key] = body.temporary(BOOL, span)
        trap = body.trap(TrapKind.FATAL, span, f"{callee} stops the PLC")
        bound.after.append(If(((Load(stop), (Halt(trap, span),)),), (), span))
    elif argument is not None and value is not None:
        target, variable = declared_target(body, value)
        lent_counter(body, target, value)
        if not argument.negated and _takes(target.type, member.type):
            bound.places[key] = target
            return
        plain = base_of(member.type) if isinstance(member.type, Subrange) else member.type
        taken = body.temporary(plain, value.span)
        bound.places[key] = taken
        whole = _generic(member, Load(taken), target.type)
        given = arriving(body, output_value(body, whole, target.type, argument), target, argument.span)
        stored = keeping(body, given, noting(body, target, variable), argument.span)
        bound.after.append(Assign(target, stored, argument.span))


def output_value(body: Body, value: Expr, target: Type, argument: tree.Argument) -> Expr:
    """What is stored for `name => target` or `NOT name => target`."""
    if argument.negated:
        if not isinstance(value.type, Elementary) or value.type != BOOL:
            raise body.report.reject("T002", f"Only a BOOL can be negated, not {value.type}.", argument.span)
        value = fold.unary("not", BOOL, value)
    assert argument.value is not None
    return coerce(body, value, target, argument.span, f"`{shown(argument.value)}`")


def _input(body: Body, member: Member, value: tree.Expression | None, span: Span) -> Expr:
    if value is not None:
        name = member.name.removesuffix("$")  # of the code that initialises an instance: what goes to FB_init
        return as_argument(body, value, member.type, f"`{name}`")
    data = member.initial or initial_of(member.type)
    default = decode(member.type, data)
    if default is not None:
        return default
    place = body.temporary(member.type, span)
    return Sequence((SetBytes(place, data, span),), Load(place))


def in_out(
    body: Body,
    member: Member,
    owner: Record,
    value: tree.Expression | None,
    span: Span,
    before: list[Stmt],
    once: bool = False,
) -> Place:
    """What an in-out of `owner` is bound to: a variable, or for a constant one a value that `before` puts somewhere. With `once` it
    is bound for one call only, that of a FUNCTION or method."""
    if value is None:
        what = (
            "output"
            if member.output
            else "input"
            if member.constant and isinstance(member.type, OpenArray)
            else "in-out"
        )
        raise body.report.reject("T005", f"The {what} `{member.name}` must be connected at every call.", span)
    if member.constant:
        if member.open_input and may(body, Allowance.OPEN_INPUTS):
            _perhaps_written(body, variable_symbol(member, owner), value)
        longer = variable_symbol(member, owner) if once else None
        return _constant_in_out(body, member, longer, value, before)
    if not isinstance(value, VARIABLES):
        raise body.report.reject("T005", f"`{member.name}` is an in-out and needs a variable.", value.span)
    how = f" Something may write to `{member.name}`: to read through it, declare that in a VAR_IN_OUT CONSTANT."
    reader = None if member.copied else variable_symbol(member, owner)  # a copy is written back
    place = targets.target(body, value, how, reader)
    body.report.lent.append(targets.variable(value).span)
    lent_counter(body, place, value)
    if once and reader is not None and _is_shorter(place.type, member.type):
        return _read_as(body, member, reader, place, value, before)
    return _bindable(body, member, place, value)


def _perhaps_written(body: Body, reader: Symbol, value: tree.Expression) -> None:
    """An array for an input ARRAY[*], to which the dialect lets the POU write: refused if it does and this is no variable to write."""
    if not isinstance(value, VARIABLES) or not is_variable(body, value):
        return
    place, member = body.place(value)
    if member is not None and member.constant and member.section is not Section.IN_OUT:
        why = f"Something writes to `{reader.name}`, and `{shown(value)}` is a CONSTANT; give it a variable."
        body.report.borrowed.append(Borrowed(reader, Problem("T003", why, value.span)))
        return
    if member is not None and member.open_input:
        targets.note_written(body, value)
    targets.writable(body, place, value.span, "", reader)
    body.report.lent.append(targets.variable(value).span)


def _is_shorter(actual: Type, formal: Type) -> bool:
    """Whether a text, or each of those of an array for an ARRAY[*], has room for fewer characters."""
    if isinstance(actual, ArrayType) and isinstance(formal, OpenArray) and len(actual.bounds) == formal.dimensions:
        return _is_shorter(actual.element, formal.element)
    if not isinstance(actual, StringType) or not isinstance(formal, StringType):
        return False
    return replace(actual, capacity=0) == replace(formal, capacity=0) and actual.capacity < formal.capacity


def _read_as(
    body: Body, member: Member, reader: Symbol, place: Place, value: tree.Expression, before: list[Stmt]
) -> Place:
    """A copy of a string in a longer one, or of an array of them, where the dialect has that; refused if anything writes to the
    in-out."""
    told = f"The in-out `{member.name}` is {member.type}; {place.type} is passed to it, and only read"
    if not allowed(body, Allowance.SHORTER_STRINGS, value.span, told):
        return _bindable(body, member, place, value)
    why = f"The in-out `{member.name}` is {member.type} and something may write to it; {place.type} cannot be bound to it."
    body.report.borrowed.append(Borrowed(reader, Problem("T005", why, value.span)))
    if isinstance(place.type, ArrayType) and isinstance(member.type, OpenArray):
        return copied_texts(body, place, member.type.element, value.span, before)
    copy = body.temporary(member.type, value.span)
    before.append(Assign(copy, Load(place), value.span))
    return copy


def _constant_in_out(
    body: Body, member: Member, reader: Symbol | None, value: tree.Expression, before: list[Stmt]
) -> Place:
    if isinstance(value, VARIABLES) and is_variable(body, value):
        place, _ = body.place(value)
        if reader is not None and isinstance(member.type, OpenArray) and _is_shorter(place.type, member.type):
            return _read_as(body, member, reader, place, value, before)
        if place.type == member.type or not isinstance(member.type, Elementary | StringType):
            return _bindable(body, member, place, value)
    if isinstance(member.type, OpenArray):
        raise body.report.reject("T005", f"`{member.name}` is ARRAY[*] and needs a variable.", value.span)
    expr = as_type(body, value, member.type, f"`{member.name}`")
    place = body.temporary(member.type, value.span)
    before.append(Assign(place, expr, value.span))
    return place


def _bindable(body: Body, member: Member, place: Place, value: tree.Expression) -> Place:
    formal, actual = member.type, place.type
    if actual == formal:
        return place
    if isinstance(formal, Record) and isinstance(actual, Record) and is_derived(actual, formal):
        return replace(place, type=formal)
    if isinstance(formal, OpenArray) and isinstance(actual, ArrayType | OpenArray):
        count = actual.dimensions if isinstance(actual, OpenArray) else len(actual.bounds)
        if count == formal.dimensions and actual.element == formal.element:
            return place
    if isinstance(actual, Enumeration) and formal == base_of(actual) and not member.constant:
        told = f"The in-out `{member.name}` is {formal}, and may write any number to `{shown(value)}`"
        if allowed(body, Allowance.ENUM_NUMBERS, value.span, told, f"`{formal.name}_TO_{actual.name}(...)`"):
            return replace(place, type=formal)
    if _same_bits(actual, formal):
        told = f"The in-out `{member.name}` is {formal}, and `{shown(value)}` is {actual}"
        if may(body, Allowance.INTEGER_BITS) and allowed(body, Allowance.BIT_CONVERSION, value.span, told):
            return replace(place, type=formal)
    raise body.report.reject(
        "T005", f"The in-out `{member.name}` is {formal}; {actual} cannot be bound to it.", value.span
    )


def _same_bits(one: Type, other: Type) -> bool:
    """Whether both are integers or bit strings of one size, and not the same."""
    kinds = (Kind.INT, Kind.UINT, Kind.BITS)
    plain = all(type(each) is Elementary and each.kind in kinds for each in (one, other))
    return plain and one.size == other.size


def open_bound(member: Member, places: dict[str, Place]) -> Expr:
    """One bound of what an ARRAY[*] is bound to: for the hidden member `name$low1` and its like."""
    name, which = member.name.upper().rsplit("$", 1)
    low, number = which.startswith("LOW"), int(which.lstrip("LOWHIG"))
    return array_bounds(places[name])[number - 1][0 if low else 1]


def together(statements: list[Stmt], span: Span) -> Stmt:
    """Several statements as one."""
    if len(statements) == 1:
        return statements[0]
    return If(((Const(BOOL, 1), tuple(statements)),), (), span)


def _generic(output: Member, value: Expr, target: Type) -> Expr:
    """An integer output of a standard function (SPLIT_DATE) is of ANY_INT: it becomes what it is stored in."""
    whole = isinstance(target, Elementary) and target.kind in (Kind.INT, Kind.UINT)
    if whole and isinstance(target, Elementary) and output.type == INT and in_library(output.span):
        return fold.convert(target, value)
    return value


def _takes(target: Type, output: Type) -> bool:
    """Whether an output can be stored there as it is."""
    if has_subranges(target):  # what the callee makes of a value outside need not be what this variable does
        return False
    return target == output or (
        isinstance(target, StringType) and isinstance(output, StringType) and target.width == output.width
    )


def _taken(formals: list[Member]) -> str:
    """How many arguments there may be by position, for people."""
    inward, every = len(by_position(formals, 0)), len(by_position(formals, len(formals) + 1))
    least = "1 argument" if inward == 1 else f"{inward} arguments"
    return least if inward == every else f"{least}, or {every} with the outputs"
