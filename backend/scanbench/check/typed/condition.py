"""Conditions: BOOL expressions of ST about a program that is there, as people type them in tools.

`Main.belt.position > 10 AND motor`, `A402.12 OR D100 >= 5`, `Main.list[Main.at] = 7`. Names are instance paths, globals and
addresses of the model, as `symbols.resolve` knows them; types and operators are those of the program's own statements.
A condition looks, and changes nothing: no calls but of standard functions, no records of subrange violations.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TypeVar

from scanbench.check.body import objects, places
from scanbench.check.body.bodies import body_of
from scanbench.check.body.coercion import constant
from scanbench.check.body.context import Body, Call, Found, Lookup
from scanbench.check.body.enumerations import value_of_type
from scanbench.check.body.objects import dotted
from scanbench.check.body.standard_calls import standard_call
from scanbench.check.body.subrange_checks import plain
from scanbench.check.context import Rejected, Report, did_you_mean
from scanbench.check.declare.declare import declarations_of
from scanbench.check.declare.scopes import Pous, Scope
from scanbench.check.dialect_table import DIALECTS
from scanbench.check.standard.functions import FUNCTIONS
from scanbench.check.typed.looking import NOWHERE, Looking
from scanbench.check.typed.passed_on import Unclear, passed_on, through_copies
from scanbench.plcmodel.model import Location
from scanbench.problems import Problem, Span, perhaps
from scanbench.program.program import Base, Const, Expr, Place, Program
from scanbench.program.types import (
    BOOL,
    ArrayType,
    Elementary,
    Enumeration,
    Kind,
    Member,
    OpenArray,
    Record,
    Reference,
    Section,
    Type,
    has_instance,
)
from scanbench.program.untyped import settle
from scanbench.symbols.call_sites import Calls
from scanbench.symbols.symbols import RAW_TYPES, UnknownPath, resolve
from scanbench.syntax import tree
from scanbench.syntax.cursor import Cursor, Unexpected
from scanbench.syntax.parse_expression import expression
from scanbench.syntax.source import Source

MAX_LENGTH = 2000
"""Characters of a condition."""
EXAMPLES = {
    "condition": "Write one, e.g. `Main.count > 3`",
    "signal": "Name a variable, e.g. `Main.count`",
    "variable": "Name one, e.g. `level`",
    "expression": "Write one, e.g. `level + 1`",
    "assignment": "Write one, e.g. `a := 1;`",
}
"""What may be wanted of a text."""
LOOKING = Looking()
_SPACED = re.compile(r"'(?:\$.|[^$'])*'|\"(?:\$.|[^$\"])*\"|\b([A-Za-z]+) (\d{1,9}(?:\.\d{1,2})?)\b")
"""`CIO 0.00`, which has a space inside; texts in quotes are passed over."""


@dataclass(frozen=True, slots=True)
class Condition:
    """A BOOL expression on the image of one program: offsets count for that one only.

    Its places are of Base.IMAGE (reached through slots and references where a path has in-outs or references), it has no
    effects, and whoever evaluates it takes a trap inside (an index outside, a null reference, a division by zero) for
    `unknown`. It may be evaluated between any two scans, as often as one likes.
    """

    text: str
    expr: Expr
    unknown: bool = False
    """Whether it holds where it has no value."""


def without_value(condition: str, scan: int) -> str:
    """That it was `unknown` after a scan."""
    return f"after scan {scan} `{condition}` has no value (an index is outside, a divisor is 0 or a reference refers to nothing)"


@dataclass(frozen=True, slots=True)
class Signal:
    """Something with a value: an instance path, an address, `Main.a + Main.b`. As a `Condition` otherwise, but that a trap
    inside leaves it without a value."""

    text: str
    expr: Expr
    type: Elementary


Made = TypeVar("Made", Condition, Signal)


@dataclass(frozen=True, slots=True)
class BadCondition:
    """Why a text is no condition: one sentence for people, and names that were perhaps meant."""

    message: str
    near: tuple[str, ...] = ()
    column: int = 1
    """Where in the text, from 1."""


def compile_condition(program: Program, text: str) -> Condition | BadCondition:
    """The condition that the text says about this program, or what is wrong with it."""
    return _compiled(program, text, "condition", lambda body, node: Condition(text, condition_of(body, node)))


def compile_signal(program: Program, text: str) -> Signal | BadCondition:
    """The value that the text says about this program: a number, a BOOL, a time; or what is wrong with it."""
    return _compiled(program, text, "signal", lambda body, node: _signal_of(body, node, text))


def _compiled(
    program: Program, text: str, what: str, made: Callable[[Body, tree.Expression], Made]
) -> Made | BadCondition:
    node = unreadable(text, what) or parsed(joined(program, text), what)
    if isinstance(node, BadCondition):
        return node
    report = Report()
    try:
        visible = Visible(program)
        return made(program_body(visible, report, visible.scope, ProgramLookup(visible), _call), node)
    except Rejected:
        problem = report.problems[0]
        return bad_condition(problem, near_names(program, text, problem) if problem.code == "T001" else (), what)


def unreadable(text: str, what: str) -> BadCondition | None:
    """Why a text cannot be one of what is wanted, before it is looked into."""
    if not text.strip():
        return BadCondition(f"There is no {what}. {EXAMPLES[what]}.")
    if len(text) > MAX_LENGTH:
        return BadCondition(f"The {what} has {len(text)} characters; it may have {MAX_LENGTH}.")
    return None


def bad_condition(problem: Problem, near: tuple[str, ...] = (), what: str = "condition") -> BadCondition:
    """What was reported of a text."""
    return BadCondition(problem.message.replace("the file ends", f"the {what} ends"), near, problem.span.column)


def near_names(program: Program, text: str, problem: Problem) -> tuple[str, ...]:
    """Whole paths of what the message proposes."""
    try:
        resolve(program, text[problem.span.column - 1 : problem.span.end_column - 1])
    except UnknownPath as error:
        return tuple(each for each in error.near if f"{each.rpartition('.')[2]}`" in problem.message)
    return ()


def joined(program: Program, text: str) -> str:
    """Addresses with a space in them as one word, every other character where it was."""

    def one(match: re.Match[str]) -> str:
        prefix, number = match.groups()
        if prefix is None or program.layout.model.locate(f"{prefix}{number}") is None:
            return match.group()
        return f"{prefix}{number} "

    return _SPACED.sub(one, text.replace("\n", " "))


def parsed(text: str, what: str = "condition") -> tree.Expression | BadCondition:
    """The tree of an expression, and of nothing but that. `what` it is to be, for people."""
    parser = Cursor(Source(NOWHERE.file, text))
    try:
        node = expression(parser)
        if parser.is_(":="):
            column = parser.here().column
            article = "an" if what[0] in "aeiou" else "a"
            return BadCondition(f"`:=` assigns, and {article} {what} changes nothing. Compare with `=`.", (), column)
        if not parser.ended():
            raise parser.fail(f"an operator (AND, OR, =, >, ...) or the end of the {what} expected")
    except Unexpected:
        return bad_condition(parser.problems[0], (), what)
    return bad_condition(parser.problems[0], (), what) if parser.problems else node


class Visible:
    """What can be named of a whole program; made once for any number of texts."""

    def __init__(self, program: Program) -> None:
        self.program = program
        layout = program.layout
        given = () if layout.symbols is None else (layout.symbols,)
        self.scope = Scope("", _everything(program), system=given)
        types: dict[int, Type] = {}
        for member in self.scope.globals.members.values():
            _collect(member.type, types)
        for pou in program.pous:
            for member in (*pou.instance.members.values(), *pou.frame.members.values()):
                _collect(member.type, types)
        self.enumerations = tuple(type for type in types.values() if isinstance(type, Enumeration))

    @cached_property
    def calls(self) -> Calls:
        """Who calls what, for in-outs by value."""
        return Calls(self.program)


class ProgramLookup:
    """What names mean of a whole program: all of it can be seen; `Lookup` says what each method does."""

    def __init__(self, visible: Visible) -> None:
        self._visible = visible
        self._program = visible.program

    def variable(self, body: Body, name: str, span: Span) -> Found:
        if body.scope.find(name) is None:
            access = next((each for each in self._program.accesses if each.name.upper() == name.upper()), None)
            if access is not None:
                inner = parsed(access.path)
                assert not isinstance(inner, BadCondition), inner
                return body.place(inner)
            location = self._program.layout.model.locate(name)
            if location is not None:
                return self._at(location), None
        return objects.variable(body, name, span)

    def bit(self, body: Body, node: tree.PartialAccess) -> Place | None:
        if not isinstance(node.owner, tree.Name) or node.size != "X" or body.scope.find(node.owner.name) is not None:
            return None
        location = self._program.layout.model.locate(f"{node.owner.name}.{node.index}")
        return None if location is None else self._at(location)

    def _at(self, location: Location) -> Place:
        offset = self._program.layout.areas[location.area.name] + location.byte
        return Place(RAW_TYPES[location.bits], Base.IMAGE, offset, bit=location.bit, variable="@")

    def unknown(self, body: Body, name: str, span: Span) -> Rejected:
        try:
            resolve(self._program, name)
        except UnknownPath as error:
            return body.report.reject("T001", f"{error.message}{perhaps(error.near)}", span)
        return objects.unknown(body, name, span)

    def inside(self, body: Body, place: Place, record: Record, member: Member, span: Span) -> Place:
        try:
            return self.followed(place, record, member)
        except Unclear as error:
            raise body.report.reject(
                "X001", f"Which variable the in-out `{member.name}` is cannot be told here: {error}. Name the variable itself, or "
                "the instance with its path and numbers as indices.", span,
            ) from error  # fmt: skip

    def followed(self, place: Place, record: Record, member: Member) -> Place:
        """Of an in-out the variable itself, as everywhere in tools: also where blocks passed on their copies. Raises `Unclear`."""
        inner = places.inside(place, record, member)
        copies = self._program.layout.copies.all
        if member.section is not Section.IN_OUT or inner.slot is None or not copies or has_instance(member.type):
            return inner
        known = place.base is Base.IMAGE and place.slot is None and place.reference is None and not place.indices
        found = passed_on(self._program, self._visible.calls, place.offset if known else None, record, member)
        return through_copies(inner.slot, member, found) if found else inner

    def this(self, body: Body, word: str, span: Span) -> Place:
        return objects.this(body, word, span)

    def this_trap(self, body: Body) -> int:
        return objects.this_trap(body)

    def may_use(self, body: Body, record: Record, member: Member) -> bool:
        return not member.hidden

    def qualified_value(self, body: Body, node: tree.MemberOf) -> Const | None:
        owner = dotted(node.owner)
        if owner is None or body.scope.find(owner.split(".")[0]) is not None:
            return None
        type = body.declarations.types.get(owner.upper())
        return value_of_type(body, owner, node.name, node.span) if isinstance(type, Enumeration) else None


def program_body(visible: Visible, report: Report, scope: Scope, lookup: Lookup, call: Call) -> Body:
    """What checks an expression in a scope that is made of a whole program; nothing of it is changed."""
    layout = visible.program.layout
    declarations = declarations_of(report, layout.model, layout.areas, lambda node, type: constant(body, node, type))
    declarations.dialect = DIALECTS[visible.program.dialect]
    for each in visible.enumerations:
        declarations.types[each.name.upper()] = each
        declarations.values.add_inline("GLOBAL", each)
    body = body_of(report, declarations, Pous(aliases=layout.lists), scope, None, lookup, LOOKING, call)
    return body


def condition_of(body: Body, node: tree.Expression) -> Expr:
    """The whole condition."""
    value = settle(plain(body, body.expression(node, BOOL), node.span))
    if value.type != BOOL:
        raise body.report.reject("T006", f"The condition is {value.type}, and it must be BOOL{_how(value)}", node.span)
    return value


def _signal_of(body: Body, node: tree.Expression, text: str) -> Signal:
    value = settle(plain(body, body.expression(node), node.span))
    if not isinstance(value.type, Elementary) or isinstance(value.type, Reference):
        raise body.report.reject(
            "T006", f"`{text.strip()}` is {value.type}, and what is recorded over time must be a number, a BOOL or a "
            "time: name one of its parts.", node.span,
        )  # fmt: skip
    return Signal(text, value, value.type)


def _call(body: Body, node: tree.Call, wanted: Type | None) -> Expr:
    """Standard functions only."""
    name = dotted(node.callee) or "this"
    value = standard_call(body, node, name.upper(), wanted) if "." not in name else None
    if value is not None:
        return value
    hint = "" if "." in name else did_you_mean(name, FUNCTIONS)
    raise body.report.reject(
        "X001", f"`{name}` is none of the standard functions that a condition can call.{hint} Code of the program "
        "and its library is not run for it: store the result in a variable, and name that.", node.span,
    )  # fmt: skip


def _everything(program: Program) -> Record:
    """Globals and program instances as the members of one record, at their places in the image."""
    made = Record("GLOBAL", Kind.STRUCT)
    owner = program.layout.globals
    if owner is not None:
        made.members.update({key: each for key, each in owner.members.items() if not each.hidden})
    for instance in program.shown:
        member = Member(instance.name, instance.pou.instance, Section.GLOBAL, instance.pou.span)
        made.place_at(member, instance.offset)
    return made


def _collect(type: Type | None, found: dict[int, Type]) -> None:
    """All types that a value of this type has to do with."""
    if type is None or id(type) in found:
        return
    found[id(type)] = type
    match type:
        case Record():
            for member in type.members.values():
                _collect(member.type, found)
        case ArrayType() | OpenArray():
            _collect(type.element, found)
        case Reference():
            _collect(type.target, found)


def _how(value: Expr) -> str:
    kind = value.type.kind if value.type is not None else None
    numbers = (Kind.INT, Kind.UINT, Kind.BITS, Kind.REAL)
    return ": compare it, as in `... > 0`." if kind in numbers else "."
