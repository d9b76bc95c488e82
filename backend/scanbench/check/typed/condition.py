"""Conditions: BOOL expressions of ST about a program that is there, as people type them in tools.

`Main.belt.position > 10 AND motor`, `A402.12 OR D100 >= 5`, `Main.list[Main.at] = 7`. Names are instance paths, globals and
addresses of the model, as `symbols.resolve` knows them; types and operators are those of the program's own statements.
A condition looks, and changes nothing: no calls but of standard functions, no records of subrange violations.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TypeVar

from scanbench.check.body.calls import CallChecker
from scanbench.check.body.objects import dotted
from scanbench.check.body.places import Found
from scanbench.check.context import Rejected, Report, did_you_mean
from scanbench.check.declare.declare import Declarations
from scanbench.check.declare.scopes import Pous, Scope
from scanbench.check.standard.functions import FUNCTIONS
from scanbench.check.typed.passed_on import Unclear, behind_copies, passed_on
from scanbench.plcmodel.model import Location
from scanbench.problems import Problem, Span, perhaps
from scanbench.program.program import Base, Const, Convert, Expr, Load, Place, Program, Stmt
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
    Subrange,
    Type,
    base_of,
    has_instance,
)
from scanbench.program.untyped import settle
from scanbench.symbols.call_sites import Calls
from scanbench.symbols.symbols import RAW_TYPES, UnknownPath, resolve
from scanbench.syntax import tree
from scanbench.syntax.cursor import Unexpected
from scanbench.syntax.parse_st import StParser
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
NOWHERE = Span("condition", 1, 1, 1, 1)
_SPACED = re.compile(r"'(?:\$.|[^$'])*'|\"(?:\$.|[^$\"])*\"|\b([A-Za-z]+) (\d{1,9}(?:\.\d{1,2})?)\b")
"""`CIO 0.00`, which has a space inside; texts in quotes are passed over."""


@dataclass(frozen=True, slots=True)
class Condition:
    """A BOOL expression on the image of one program: offsets count for that one only.

    Its places are of Base.IMAGE (behind slots and references where in-outs and references are on the way), it has no
    effects, and whoever evaluates it takes a trap inside (an index outside, a null reference, a division by zero) for
    FALSE. It may be evaluated between any two scans, as often as one likes.
    """

    text: str
    expr: Expr


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
    return _compiled(program, text, "condition", lambda checker, node: Condition(text, checker.condition(node)))


def compile_signal(program: Program, text: str) -> Signal | BadCondition:
    """The value that the text says about this program: a number, a BOOL, a time; or what is wrong with it."""
    return _compiled(program, text, "signal", lambda checker, node: checker.signal(node, text))


def _compiled(
    program: Program, text: str, what: str, made: Callable[["ProgramChecker", tree.Expression], Made]
) -> Made | BadCondition:
    node = unreadable(text, what) or parsed(joined(program, text), what)
    if isinstance(node, BadCondition):
        return node
    report = Report()
    try:
        return made(ProgramChecker(Visible(program), report), node)
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
    parser = StParser(Source(NOWHERE.file, text))
    try:
        node = parser.expression()
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


class ProgramChecker(CallChecker):
    """The checker of expressions, in a scope that is made of a whole program: all of it can be seen, nothing changed."""

    def __init__(self, visible: Visible, report: Report, scope: Scope | None = None) -> None:
        layout = visible.program.layout
        declarations = Declarations(report, layout.model, layout.areas, self._constant)
        for type in visible.enumerations:
            declarations.types[type.name.upper()] = type
            declarations.values.add_inline("GLOBAL", type)
        super().__init__(report, declarations, Pous(), scope or visible.scope, None)
        self.program = visible.program
        self.visible = visible

    def condition(self, node: tree.Expression) -> Expr:
        """The whole condition."""
        value = settle(self.plain(self.expr(node, BOOL), node.span))
        if value.type != BOOL:
            raise self.report.reject(
                "T006", f"The condition is {value.type}, and it must be BOOL{_how(value)}", node.span
            )
        return value

    def signal(self, node: tree.Expression, text: str) -> Signal:
        """A whole signal."""
        value = settle(self.plain(self.expr(node, None), node.span))
        if not isinstance(value.type, Elementary) or isinstance(value.type, Reference):
            raise self.report.reject(
                "T006", f"`{text.strip()}` is {value.type}, and what is recorded over time must be a number, a BOOL or a "
                "time: name one of its parts.", node.span,
            )  # fmt: skip
        return Signal(text, value, value.type)

    def _constant(self, node: tree.Expression, type: Type | None) -> Const:
        return self.constant(node, type)

    # ---- names ------------------------------------------------------------------------------------------

    def _named(self, name: str, span: Span) -> Found:
        if self.scope.find(name) is None:
            access = next((each for each in self.program.accesses if each.name.upper() == name.upper()), None)
            if access is not None:
                inner = parsed(access.path)
                assert not isinstance(inner, BadCondition), inner
                return self.place(inner)
            location = self.program.layout.model.locate(name)
            if location is not None:
                return self._at(location), None
        return super()._named(name, span)

    def raw_place(self, node: tree.Expression) -> Found:
        if isinstance(node, tree.PartialAccess) and isinstance(node.owner, tree.Name) and node.size == "X":
            name = node.owner.name
            located = self.program.layout.model.locate(f"{name}.{node.index}")
            if located is not None and self.scope.find(name) is None:
                return self._at(located), None
        return super().raw_place(node)

    def inside(self, place: Place, record: Record, member: Member, span: Span) -> Place:
        """Of an in-out the variable itself, as everywhere in tools: also where blocks passed on their copies."""
        inner = super().inside(place, record, member, span)
        copies = self.program.layout.copies.all
        if member.section is not Section.IN_OUT or inner.slot is None or not copies or has_instance(member.type):
            return inner
        known = place.base is Base.IMAGE and place.slot is None and place.reference is None and not place.indices
        try:
            found = passed_on(self.program, self.visible.calls, place.offset if known else None, record, member)
        except Unclear as error:
            return self.unclear(inner, member, str(error), span)
        return behind_copies(inner.slot, member, found) if found else inner

    def unclear(self, inner: Place, member: Member, reason: str, span: Span) -> Place:
        """Where an in-out may have been passed on, and nobody knows by whom; `inner` is what its own call passed."""
        raise self.report.reject(
            "X001", f"Which variable the in-out `{member.name}` is cannot be told here: {reason}. Name the variable itself, or "
            "the instance with its path and numbers as indices.", span,
        )  # fmt: skip

    def part(self, place: Place, size: str, index: int, span: Span) -> Place:
        return super().part(place, size.upper(), index, span)

    def _part_value(self, node: tree.PartialAccess) -> Expr:
        if isinstance(node.owner, tree.Name) and self.scope.find(node.owner.name) is None:
            return Load(self.place(node)[0])
        return super()._part_value(node)

    def _at(self, location: Location) -> Place:
        offset = self.program.layout.areas[location.area.name] + location.byte
        return Place(RAW_TYPES[location.bits], Base.IMAGE, offset, bit=location.bit, variable="@")

    def unknown(self, name: str, span: Span) -> Rejected:
        try:
            resolve(self.program, name)
        except UnknownPath as error:
            return self.report.reject("T001", f"{error.message}{perhaps(error.near)}", span)
        return super().unknown(name, span)

    def may_use(self, record: Record, member: Member) -> bool:
        return not member.hidden

    def qualified_value(self, node: tree.MemberOf) -> Const | None:
        """`Color.RED`."""
        owner = dotted(node.owner)
        if owner is None or self.scope.find(owner.split(".")[0]) is not None:
            return None
        type = self.declarations.types.get(owner.upper())
        return self.value_of_type(owner, node.name, node.span) if isinstance(type, Enumeration) else None

    # ---- nothing is changed -----------------------------------------------------------------------------

    def read(self, place: Place, span: Span, variable: str) -> Expr:
        """What is there, unchecked: a check would record a violation."""
        return Load(replace(place, type=base_of(place.type)) if isinstance(place.type, Subrange) else place)

    def temporary(self, type: Type, span: Span, name: str = "t") -> Place:
        raise self.report.reject(
            "X001", "This would have to keep a value meanwhile, which a condition cannot: write AND and OR instead of "
            "AND_THEN and OR_ELSE (a trap counts as FALSE), and let the program compute the rest into a variable.", span,
        )  # fmt: skip

    def held(self, value: Expr, span: Span) -> tuple[tuple[Stmt, ...], Expr]:
        """A variable may be read twice instead, as nothing changes it meanwhile."""
        plain = value.operand if isinstance(value, Convert) else value
        return ((), value) if isinstance(plain, Load) else super().held(value, span)

    def call(self, node: tree.Call, wanted: Type | None = None) -> Expr:
        name = dotted(node.callee) or "this"
        value = self.standard(node, name.upper(), wanted) if "." not in name else None
        if value is not None:
            return value
        hint = "" if "." in name else did_you_mean(name, FUNCTIONS)
        raise self.report.reject(
            "X001", f"`{name}` is none of the standard functions that a condition can call.{hint} Code of the program "
            "and its library is not run for it: store the result in a variable, and name that.", node.span,
        )  # fmt: skip

    def explicit_check(self, node: tree.Call, name: str) -> Expr:
        if name == "EN_CHECK":
            raise self.report.reject("X001", "`EN_CHECK` records what it finds, and a condition only looks.", node.span)
        return super().explicit_check(node, name)

    def library(self, name: str, *args: Expr) -> Expr | None:
        raise self.report.reject(
            "X001", f"`{name}` is written in ST, and a condition runs no such code: store the result in a variable, and "
            "name that.", NOWHERE,
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
