"""Sources and a model -> a checked program, or the problems that stand in its way.

The passes, in order: parse every file; collect names; declare globals, blocks and functions; check bodies; refuse
recursion; lay out the image. Each pass goes on as far as it can, so that one check shows every problem.
"""

import sys
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from importlib.resources import files

from scanbench.check.assemble import assemble, place_areas, place_globals
from scanbench.check.calls import CallChecker
from scanbench.check.context import Rejected, Report, did_you_mean
from scanbench.check.declare import Declarations
from scanbench.check.program import Const, Pou, Program
from scanbench.check.scopes import Pous, Scope
from scanbench.check.statements import StatementChecker
from scanbench.check.types import ELEMENTARY, Kind, Member, Record, Section, Type
from scanbench.plcmodel.model import Model
from scanbench.problems import Problem, Severity, Span
from scanbench.syntax import tree
from scanbench.syntax.parse_st import parse_st
from scanbench.syntax.source import Source

LIBRARY = ("timers", "counters", "bistable", "strings")
MAX_CALLS = 1_000_000
"""Calls that one call may lead to, loops not counted: those have a budget at run time, plain calls have none."""
RECURSION_LIMIT = 20_000
"""Python frames for a deep expression: the parser bounds depth, the checks walk it with a few frames a level."""
sys.setrecursionlimit(max(sys.getrecursionlimit(), RECURSION_LIMIT))


@dataclass(frozen=True, slots=True)
class PouInfo:
    """What a file declares, for the explorer."""

    name: str
    kind: str
    """program, function_block, function, type or global."""
    file: str
    line: int


@dataclass(frozen=True, slots=True)
class Checked:
    """`program` is None when there are errors."""

    program: Program | None
    problems: tuple[Problem, ...]
    pous: tuple[PouInfo, ...]


def check_sources(sources: Mapping[str, str], model: Model, interval_ns: int = 10_000_000) -> Checked:
    """Checks all files of a project together. `interval_ns` is the task's, where no CONFIGURATION says another."""
    report = Report()
    parsed = []
    for name, text in sources.items():
        file, problems = parse_st(Source(name, text))
        report.problems += problems
        parsed.append(file)
    program = Checker(report, model, parsed).run(interval_ns)
    problems = sorted(report.problems, key=lambda each: (each.span.file, each.span.line, each.span.column))
    failed = any(problem.severity is Severity.ERROR for problem in problems)
    return Checked(None if failed else program, tuple(problems), tuple(_infos(parsed)))


@cache
def library() -> tuple[tree.File, ...]:
    """The standard library's ST files, parsed."""
    made = []
    for name in LIBRARY:
        path = f"standard/{name}.st"
        text = files("scanbench.check").joinpath(path).read_text("utf-8")
        file, problems = parse_st(Source(path, text))
        assert not problems, problems
        made.append(file)
    return tuple(made)


def _infos(parsed: list[tree.File]) -> list[PouInfo]:
    made = []
    for file in parsed:
        made += [PouInfo(pou.name, pou.kind, file.name, pou.span.line) for pou in file.pous]
        made += [PouInfo(each.name, "type", file.name, each.span.line) for each in file.types]
        for section in (*file.globals, *(each for conf in file.configurations for each in conf.globals)):
            made += [PouInfo(each.name, "global", file.name, each.span.line) for each in section.variables]
    return made


@dataclass(slots=True)
class Checker:
    report: Report
    model: Model
    parsed: list[tree.File]
    globals: Record = field(default_factory=lambda: Record("GLOBAL", Kind.STRUCT))
    pous: Pous = field(default_factory=Pous)
    functions: dict[str, tree.PouDeclaration] = field(default_factory=dict)
    declarations: Declarations = field(init=False)

    def run(self, interval_ns: int) -> Program | None:
        areas = place_areas(self.model)
        self.declarations = Declarations(self.report, self.model, areas, self._constant)
        user = self._collect()
        self._declare_globals()
        place_globals(self.model, areas, self.globals)
        for declaration in (*self.declarations.block_trees.values(), *self.functions.values()):
            self._declare_pou(declaration)
        for declaration in user:
            self._check_body(declaration)
        self._check_library()
        order = self._order()
        configurations = [each for file in self.parsed for each in file.configurations]
        return assemble(
            self.report, self.declarations, self.pous, self.globals, order, configurations, interval_ns, self._end()
        )

    def _end(self) -> Span:
        """Where a problem of the whole program is shown: at the beginning of its first file."""
        name = self.parsed[0].name if self.parsed else "project"
        return Span(name, 1, 1, 1, 2)

    # ---- names ------------------------------------------------------------------------------------------

    def _collect(self) -> list[tree.PouDeclaration]:
        """Registers what the files declare; the library steps back where the user declares the same name."""
        seen: dict[str, Span] = {}
        user = []
        for file in self.parsed:
            for declaration in file.types:
                if isinstance(declaration.type, tree.UnsupportedSpec):
                    self.declarations.broken |= {("GLOBAL", name.upper()) for name in declaration.type.values}
                if self._first(declaration.name, declaration.span, seen):
                    self.declarations.type_trees[declaration.name.upper()] = declaration
            for pou in file.pous:
                if self._first(pou.name, pou.span, seen):
                    self._register(pou)
                    user.append(pou)
        for file in library():
            for pou in file.pous:
                if pou.name.upper() not in seen:
                    self._register(pou)
        return user

    def _register(self, pou: tree.PouDeclaration) -> None:
        table = self.functions if pou.kind == "function" else self.declarations.block_trees
        table[pou.name.upper()] = pou

    def _first(self, name: str, span: Span, seen: dict[str, Span]) -> bool:
        if name.upper() in ELEMENTARY:
            self.report.error("D001", f"`{name}` is a standard type; choose another name.", span)
            return False
        first = seen.setdefault(name.upper(), span)
        if first is not span:
            self.report.error("D001", f"`{name}` is declared already in {first}; rename one.", span)
        return first is span

    # ---- declarations -----------------------------------------------------------------------------------

    def _constant(self, node: tree.Expression, type: Type | None) -> Const:
        """A constant expression among the declarations."""
        owners = tuple(reversed(self.declarations.owners))
        scope = Scope("", self.globals, constants=owners)
        return CallChecker(self.report, self.declarations, self.pous, scope, None).constant(node, type)

    def _declare_globals(self) -> None:
        """Constants first, as they may stand in the bounds of the others."""
        sections = [section for file in self.parsed for section in file.globals]
        sections += [section for file in self.parsed for each in file.configurations for section in each.globals]
        for constant in (True, False):
            for section in sections:
                if ("CONSTANT" in section.qualifiers) == constant:
                    for variable in section.variables:
                        self.declarations.declare(self.globals, variable, Section.GLOBAL, constant)

    def _declare_pou(self, declaration: tree.PouDeclaration) -> None:
        key = declaration.name.upper()
        function = declaration.kind == "function"
        try:
            instance = Record(declaration.name, Kind.BLOCK)
            if not function:
                made = self.declarations.named(declaration.name, declaration.span)
                assert isinstance(made, Record)
                instance = made
            frame = self.declarations.frame(declaration, instance)
        except Rejected:
            return
        parameters = tuple(
            name
            for name, member in frame.members.items()
            if member.section in (Section.INPUT, Section.IN_OUT, Section.OUTPUT)
        )
        result = frame.members.get(key) if function else None
        pou = Pou(
            declaration.name, declaration.kind, instance, frame, parameters if function else (),
            result.type if result else None, declaration.span,
        )  # fmt: skip
        pou.inline = declaration.span.file.startswith("standard/")
        (self.pous.functions if function else self.pous.blocks)[key] = pou

    # ---- bodies -----------------------------------------------------------------------------------------

    def _check_body(self, declaration: tree.PouDeclaration) -> None:
        table = self.pous.functions if declaration.kind == "function" else self.pous.blocks
        pou = table.get(declaration.name.upper())
        if pou is None:
            return
        scope = Scope(pou.name, self.globals, pou.instance, pou.frame, self._externals(declaration))
        checker = StatementChecker(self.report, self.declarations, self.pous, scope, pou)
        pou.body = checker.body(declaration.body)

    def _externals(self, declaration: tree.PouDeclaration) -> dict[str, Member]:
        found: dict[str, Member] = {}
        for section in declaration.sections:
            if section.keyword != Section.EXTERNAL:
                continue
            for variable in section.variables:
                member = self.globals.members.get(variable.name.upper())
                taken = [self.pous.blocks, self.pous.functions]
                own = next(
                    (table[declaration.name.upper()] for table in taken if declaration.name.upper() in table), None
                )
                if own is not None and variable.name.upper() in {*own.instance.members, *own.frame.members}:
                    self.report.error("D001", f"`{variable.name}` is declared already; rename one.", variable.span)
                if member is None:
                    hint = did_you_mean(variable.name, [each.name for each in self.globals.members.values()])
                    self.report.error("D007", f"There is no VAR_GLOBAL `{variable.name}`.{hint}", variable.span)
                    continue
                try:
                    declared = self.declarations.type_of(variable.type)
                except Rejected:
                    continue
                if declared != member.type:
                    self.report.error(
                        "D007", f"The VAR_GLOBAL `{member.name}` is {member.type}, not {declared}.", variable.span
                    )
                found[variable.name.upper()] = member
        return found

    def _check_library(self) -> None:
        """Bodies of the library POUs that are used, and of those that they use."""
        trees = {pou.name.upper(): pou for file in library() for pou in file.pous}
        done: set[Pou] = set()
        while True:
            used = [callee for called in list(self.pous.uses.values()) for callee in called]
            fresh = [pou for pou in used if pou.inline and pou not in done]
            if not fresh:
                return
            for pou in fresh:
                done.add(pou)
                if not pou.body:
                    self._check_body(trees[pou.name.upper()])

    def _order(self) -> list[Pou]:
        """Callees before callers; a POU that calls itself, by whatever way, is refused."""
        order: list[Pou] = []
        state: dict[Pou, int] = {}
        calls: dict[Pou, int] = {}

        def visit(pou: Pou, path: list[Pou]) -> None:
            if state.get(pou) == 2:
                return
            if state.get(pou) == 1:
                names = " -> ".join(each.name for each in [*path[path.index(pou) :], pou])
                self.report.error("D009", f"Recursion is not allowed: {names}.", pou.span)
                return
            state[pou] = 1
            for callee in self.pous.uses.get(pou, {}):
                visit(callee, [*path, pou])
            state[pou] = 2
            order.append(pou)
            called = self.pous.uses.get(pou, {}).items()
            calls[pou] = 1 + sum(calls.get(callee, 0) * places for callee, places in called)
            if calls[pou] > MAX_CALLS:
                self.report.error(
                    "D013", f"One call of `{pou.name}` leads to {calls[pou]} calls; at most {MAX_CALLS}.", pou.span
                )
                calls[pou] = 0

        for pou in (*self.pous.functions.values(), *self.pous.blocks.values()):
            if not pou.inline:
                visit(pou, [])
        return order
