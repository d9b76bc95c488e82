"""Texts that people type about a statement of a program, in the scope of its POU: values, conditions, assignments, places.

Names mean what they mean in the POU's statements (its variables, temporaries, in-outs, THIS, globals), and what they mean
in a condition besides: instance paths and addresses. FUNCTIONs of the program can be called; function blocks and methods
cannot. Nothing embeds a check here: whoever stores a value looks at its type.
"""

from dataclasses import dataclass, replace

from scanbench.check.body.arguments import as_value, invoke
from scanbench.check.body.assignments import assign, latch
from scanbench.check.body.callees import hides
from scanbench.check.body.context import Body, Found
from scanbench.check.body.objects import dotted, named_itself, own
from scanbench.check.body.places import inside
from scanbench.check.body.standard_calls import standard_call
from scanbench.check.body.subrange_checks import plain
from scanbench.check.context import Rejected, Report, did_you_mean
from scanbench.check.declare.names import Space
from scanbench.check.declare.scopes import Scope, place_of
from scanbench.check.standard.functions import FUNCTIONS
from scanbench.check.typed.condition import (
    BadCondition,
    ProgramLookup,
    Visible,
    bad_condition,
    condition_of,
    joined,
    near_names,
    parsed,
    program_body,
    unreadable,
)
from scanbench.check.typed.looking import NOWHERE
from scanbench.check.typed.passed_on import Unclear
from scanbench.problems import Span
from scanbench.program.origin import in_library, is_system
from scanbench.program.program import Assign, Base, Const, Expr, If, Load, Place, Pou, Program
from scanbench.program.shown import shown
from scanbench.program.sites import TrapKind, TrapSite
from scanbench.program.types import BOOL, Member, Record, Type
from scanbench.program.untyped import settle
from scanbench.syntax import tree
from scanbench.syntax.cursor import Cursor, Unexpected
from scanbench.syntax.parse_statement import statements
from scanbench.syntax.source import Source

Bad = BadCondition


@dataclass(frozen=True, slots=True)
class Local:
    """A value, of any type, in the scope of `pou` (None: of the whole program)."""

    text: str
    pou: Pou | None
    expr: Expr
    traps: tuple[TrapSite, ...]
    """What may go wrong; numbered after those of the program."""
    calls: bool
    """Runs code of the program, which leaves its traces in frames: so only on a copy of an image."""

    @property
    def type(self) -> Type:
        """Of the value."""
        type = self.expr.type
        assert type is not None
        return type


@dataclass(frozen=True, slots=True)
class LocalPlace:
    """A variable or a part of one, in the scope of `pou`."""

    text: str
    pou: Pou | None
    place: Place
    member: Member | None
    """The declared variable that it is, or is inside of, as far as that is known."""
    traps: tuple[TrapSite, ...]
    calls: bool


@dataclass(frozen=True, slots=True)
class LocalAssignment:
    """One `target := value`; with a condition (S=, R=) only where that holds."""

    target: Place
    member: Member | None
    value: Expr
    condition: Expr | None
    shown: str
    """The target as typed."""


@dataclass(frozen=True, slots=True)
class LocalAssignments:
    """What an execution point does, one after the other."""

    text: str
    pou: Pou | None
    assignments: tuple[LocalAssignment, ...]
    traps: tuple[TrapSite, ...]
    calls: bool


class Locals:
    """Understands texts about one program; made once for many of them. The program must not be checked on meanwhile."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self._visible = Visible(program)
        self._functions = {
            each.name.upper(): each
            for each in program.pous
            if each.kind == "function" and this_of(each) is None and not _ours(each)
        }
        self._scopes: dict[Pou, Scope] = {}

    def value(self, pou: Pou | None, text: str) -> Local | Bad:
        """A value of any type."""
        return self._value(pou, text, None)

    def condition(self, pou: Pou | None, text: str) -> Local | Bad:
        """A BOOL."""
        return self._value(pou, text, BOOL)

    def place(self, pou: Pou | None, text: str) -> LocalPlace | Bad:
        """A variable, an element, a member, a part: what a value can be stored in, if nothing else speaks against it."""
        node = self._parsed(text, "variable")
        if isinstance(node, Bad):
            return node
        typed = self._typed(pou)
        try:
            place, member = typed.body.place(node)
        except Rejected:
            return self._why(typed, text)
        return LocalPlace(text, pou, place, member, tuple(typed.report.traps), typed.calls)

    def assignments(self, pou: Pou | None, text: str) -> LocalAssignments | Bad:
        """`a := a + 1; b := TRUE;`, the last `;` may be left out."""
        nodes = self._parsed_statements(text)
        if isinstance(nodes, Bad):
            return nodes
        typed = self._typed(pou)
        try:
            made = tuple(typed.assignment(node) for node in nodes)
        except Rejected:
            return self._why(typed, text)
        return LocalAssignments(text, pou, made, tuple(typed.report.traps), typed.calls)

    def _value(self, pou: Pou | None, text: str, wanted: Type | None) -> Local | Bad:
        node = self._parsed(text, "condition" if wanted == BOOL else "expression")
        if isinstance(node, Bad):
            return node
        typed = self._typed(pou)
        try:
            expr = condition_of(typed.body, node) if wanted == BOOL else typed.value(node)
        except Rejected:
            return self._why(typed, text)
        return Local(text, pou, expr, tuple(typed.report.traps), typed.calls)

    # ---- parsing ----------------------------------------------------------------------------------------

    def _parsed(self, text: str, what: str) -> tree.Expression | Bad:
        return unreadable(text, what) or parsed(joined(self.program, text), what)

    def _parsed_statements(self, text: str) -> tuple[tree.Assignment, ...] | Bad:
        bad = unreadable(text, "assignment")
        if bad is not None:
            return bad
        text = joined(self.program, text).rstrip()
        parser = Cursor(Source(NOWHERE.file, text if text.endswith(";") else f"{text};"))
        try:
            found = statements(parser)
            if not parser.ended() and not parser.problems:
                raise parser.fail("an assignment expected, `a := 1;`")
        except Unexpected:
            return bad_condition(parser.problems[0])
        if parser.problems:
            return bad_condition(parser.problems[0])
        made = []
        for each in found:
            if not isinstance(each, tree.Assignment) or each.operator in ("REF=", "?=") or each.also:
                span = each.span
                return Bad("Only assignments are allowed here: `a := a + 1; b := TRUE;`.", (), span.column)
            made.append(each)
        return tuple(made)

    def _why(self, typed: "_Text", text: str) -> Bad:
        problem = typed.report.problems[0]
        if problem.code != "T001":
            return bad_condition(problem)
        local = tuple(each for each in dict.fromkeys(typed.body.scope.names()) if f"`{each}`" in problem.message)
        return bad_condition(problem, local or near_names(self.program, text, problem))

    # ---- scopes -----------------------------------------------------------------------------------------

    def _typed(self, pou: Pou | None) -> "_Text":
        scope = self._visible.scope if pou is None else self._scopes.get(pou)
        if scope is None:
            assert pou is not None
            scope = self._scopes[pou] = self._scope(pou)
        return _Text(self._visible, scope, self._functions)

    def _scope(self, pou: Pou) -> Scope:
        space = Space(pou.name.rpartition(".")[0])
        scope = replace(self._visible.scope, pou=pou.name, frame=pou.frame, space=space)
        if pou.kind != "function":
            return replace(scope, instance=pou.instance)
        this = this_of(pou)
        if this is None:
            return scope
        assert isinstance(this.type, Record)
        return replace(scope, instance=this.type, this=place_of(this, Base.FRAME, pou.frame, 0).slot)


_MADE: list[Locals] = []
_KEPT = 2


def locals_of(program: Program) -> Locals:
    """The same, again and again, as long as few other programs are asked about."""
    found = next((each for each in _MADE if each.program is program), None)
    if found is None:
        found = Locals(program)
        _MADE.append(found)
        del _MADE[:-_KEPT]
    return found


def this_of(pou: Pou) -> Member | None:
    """What refers to the instance of a method."""
    this = pou.frame.members.get("THIS") if pou.kind == "function" else None
    return this if this is not None and this.hidden else None


def _ours(pou: Pou) -> bool:
    return is_system(pou.span) or in_library(pou.span) or pou.name.startswith("__")


class LocalLookup:
    """What names mean in the scope of a POU, and of the whole program besides; `Lookup` says what each method does."""

    def __init__(self, program: ProgramLookup) -> None:
        self._program = program

    def variable(self, body: Body, name: str, span: Span) -> Found:
        return self._program.variable(body, name, span)

    def bit(self, body: Body, node: tree.PartialAccess) -> Place | None:
        return self._program.bit(body, node)

    def unknown(self, body: Body, name: str, span: Span) -> Rejected:
        hint = did_you_mean(name, body.scope.names())
        if not hint:
            return self._program.unknown(body, name, span)
        return body.report.reject("T001", f"There is no `{name}` here.{hint}", span)

    def inside(self, body: Body, place: Place, record: Record, member: Member, span: Span) -> Place:
        try:
            return self._program.followed(place, record, member)
        except Unclear:  # what its own call passed, as the statements of the POU see it
            return inside(place, record, member)

    def this(self, body: Body, word: str, span: Span) -> Place:
        record = body.scope.instance
        if record is None:
            raise body.report.reject("T010", f"{word} is the instance that runs; there is none here.", span)
        if word.upper() == "SUPER":
            if record.base is None:
                raise body.report.reject("T010", f"`{record.name}` extends nothing, so it has no SUPER.", span)
            record = record.base
        return own(body, Place(record, Base.SELF, 0))

    def this_trap(self, body: Body) -> int:
        return body.trap(TrapKind.NULL, NOWHERE, "THIS refers to no instance")

    def may_use(self, body: Body, record: Record, member: Member) -> bool:
        return self._program.may_use(body, record, member)

    def qualified_value(self, body: Body, node: tree.MemberOf) -> Const | None:
        return self._program.qualified_value(body, node)


class _Text:
    """One text under check."""

    def __init__(self, visible: Visible, scope: Scope, functions: dict[str, Pou]) -> None:
        self.report = Report()
        self.calls = False
        """Whether it runs code of the program."""
        lookup = LocalLookup(ProgramLookup(visible))
        self.body = program_body(visible, self.report, scope, lookup, self._call)
        self.body.pous.functions = functions
        self.body.declarations.names.space = scope.space

    def value(self, node: tree.Expression) -> Expr:
        """A whole expression."""
        if named_itself(node, "THIS"):
            return Load(self.body.lookup.this(self.body, "THIS", node.span))
        expr = settle(plain(self.body, self.body.expression(node), node.span))
        if expr.type is None:
            raise self.report.reject("T010", "This has no value.", node.span)
        return expr

    def assignment(self, node: tree.Assignment) -> LocalAssignment:
        """What one assignment does."""
        body, condition = self.body, None
        _, member = body.place(node.target)
        if node.operator in ("S=", "R="):
            made = latch(body, node, condition_of(body, node.value))
            assert isinstance(made, If), made
            condition, (made,) = made.branches[0]
        else:
            made = assign(body, node)
        assert isinstance(made, Assign), made
        return LocalAssignment(made.target, member, made.value, condition, shown(node.target))

    def _call(self, body: Body, node: tree.Call, wanted: Type | None) -> Expr:
        """FUNCTIONs of the program, and standard functions."""
        name = dotted(node.callee) or "this"
        callee = _function(body, name)
        if callee is not None:
            if any((each.name or "").upper() in ("EN", "ENO") for each in node.arguments):
                raise body.report.reject("X001", "EN and ENO are not allowed here.", node.span)
            self.calls = True
            return as_value(body, invoke(body, node, callee, callee.name, None, None), node.span)
        value = standard_call(body, node, name.upper(), wanted) if "." not in name else None
        if value is not None:
            return value
        hint = did_you_mean(name, [*FUNCTIONS, *(each.name for each in body.pous.functions.values())])
        raise body.report.reject(
            "X001", f"`{name}` is no FUNCTION that can be called here.{hint} Function blocks and methods are not run for an "
            "expression: name their variables instead.", node.span,
        )  # fmt: skip


def _function(body: Body, name: str) -> Pou | None:
    if hides(body, name):
        return None
    candidates = body.scope.space.candidates(name.upper())
    return next((body.pous.functions[each] for each in candidates if each in body.pous.functions), None)
