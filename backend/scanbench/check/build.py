"""Sources and a model -> a checked program, or the problems that prevent it.

The passes, in order: parse every file; collect names; declare globals, blocks, methods and functions; check bodies;
refuse recursion; lay out the image. Each pass goes on as far as it can, so that one check shows every problem.
"""

import re
import sys
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace

from scanbench.check.assemble import Around, assemble, place_areas, place_globals
from scanbench.check.body.bodies import body_of
from scanbench.check.body.coercion import constant
from scanbench.check.body.context import Body, Effects
from scanbench.check.body.direct import as_argument
from scanbench.check.body.generic import is_generic
from scanbench.check.body.notes import Looks
from scanbench.check.body.pou_body import pou_body
from scanbench.check.borrowed import check_borrowed
from scanbench.check.context import Mark, Rejected, Report
from scanbench.check.declare.class_rules import check_classes, check_instances
from scanbench.check.declare.classes import Method, called_pou, collect, declare_methods, key_of
from scanbench.check.declare.collect import Collector, declare_globals
from scanbench.check.declare.declarations import Declarations
from scanbench.check.declare.declare import declarations_of
from scanbench.check.declare.externals import externals_of
from scanbench.check.declare.frames import frame
from scanbench.check.declare.generic_blocks import specialised
from scanbench.check.declare.kept import declare_static, kept_of
from scanbench.check.declare.names import Space, full_name
from scanbench.check.declare.policies import check_policies, pou_policy
from scanbench.check.declare.programs import placed_programs
from scanbench.check.declare.scopes import Pous, Scope, place_of
from scanbench.check.declare.start_references import is_this, own_instance
from scanbench.check.dialect import Allowance, Dialect
from scanbench.check.dialect_table import IEC, dialect_in
from scanbench.check.folding import folded
from scanbench.check.life.make import Life
from scanbench.check.life.whole import Whole, whole_of
from scanbench.check.order import Order
from scanbench.check.pou_infos import PouInfo, pou_infos
from scanbench.check.recursion import allow
from scanbench.check.stubs import tell_stubs
from scanbench.check.system.plant import Plant, plant_files
from scanbench.check.system.stimuli import Stimuli
from scanbench.check.system.system import System, system_of
from scanbench.check.system.system_text import COMMON
from scanbench.check.task_infos import TaskInfo, task_infos
from scanbench.garbage import without_collection
from scanbench.plcmodel.as_used import as_used
from scanbench.plcmodel.model import Model, Who
from scanbench.plcmodel.user_errors import extended, is_of_catalogue
from scanbench.problems import Problem, Severity, Span
from scanbench.program.origin import in_library, is_system
from scanbench.program.program import Assign, Base, Const, Expr, Place, Pou, Program
from scanbench.program.sites import CheckSite, plain_sites
from scanbench.program.types import BOOL, Kind, Member, Record, Reference, Type
from scanbench.syntax import tree
from scanbench.syntax.chunks import Chunked, read
from scanbench.syntax.language_file import dialect_of, is_language_file
from scanbench.syntax.objects import joined
from scanbench.syntax.parse_generic import VARIADIC
from scanbench.syntax.requirements import is_requirements

RECURSION_LIMIT = 20_000
"""Python frames for a deep expression: the parser bounds depth, the checks walk it with a few frames a level."""
sys.setrecursionlimit(max(sys.getrecursionlimit(), RECURSION_LIMIT))
ENABLING = re.compile(r"\bENO?\b", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class Checked:
    """`program` is None when there are errors."""

    program: Program | None
    problems: tuple[Problem, ...]
    pous: tuple[PouInfo, ...]
    checks: tuple[CheckSite, ...] = ()
    """Subrange checks; none while there are errors."""
    tasks: tuple[TaskInfo, ...] = ()
    """None while there are errors."""


def check_sources(sources: Mapping[str, str], model: Model, interval_ns: int = 10_000_000) -> Checked:
    """Checks all files of a project together. `interval_ns` is the interval of the task, unless a CONFIGURATION has one."""
    with without_collection():
        dialect = dialect_in(sources)
        files = [read(name, text, dialect.defines) for name, text in program_files(sources).items()]
        checker = checker_of(files, model, dialect=dialect)
        return with_user_errors(concluded(files, checker.report, checker.run(interval_ns)), sources, model)


def program_files(sources: Mapping[str, str]) -> dict[str, str]:
    """The sources without the errors that the project defines, what is fitted, what it requires, and its dialect: these are no
    part of the program."""
    others = (is_of_catalogue, is_requirements, is_language_file)
    return {name: text for name, text in sources.items() if not any(each(name) for each in others)}


def with_user_errors(checked: Checked, sources: Mapping[str, str], model: Model) -> Checked:
    """A program that was checked for the device, with the errors that the project defines, and what is wrong with these.

    They change only the catalogue to which the layout refers, so no body is checked again for them.
    """
    if len(program_files(sources)) == len(sources):
        return checked
    found = [*extended(model, sources)[1], *dialect_of(sources)[1]]
    problems = sorted((*checked.problems, *found), key=lambda each: (each.span.file, each.span.line, each.span.column))
    if any(problem.severity is Severity.ERROR for problem in found):
        return Checked(None, tuple(problems), checked.pous)
    program = checked.program
    if program is not None:
        used = extended(program.layout.model, sources)[0]
        program = replace(program, layout=replace(program.layout, model=used))
    return replace(checked, program=program, problems=tuple(problems))


def checker_of(files: Sequence[Chunked], model: Model, looks: Looks | None = None, dialect: Dialect = IEC) -> "Checker":
    """What checks these files together."""
    enabling = frozenset(file.name for file in files if ENABLING.search(file.text))
    looked_at = (looks or Looks()).at(chunk for file in files for chunk in file.chunks)
    used = as_used(model, (file.text for file in files))
    return Checker(Report(), used, joined([file.file for file in files])[0], enabling, looked_at, dialect)


def concluded(files: Sequence[Chunked], report: Report, program: Program | None, whole: bool = True) -> Checked:
    """What came out, in spans that do not move any more. A program that is not `whole` tells what it consists of, and is left out."""
    trees, apart = joined([file.file for file in files])
    written = [*(problem for file in files for problem in file.problems), *apart]
    found = [*written, *report.problems]
    if any(each.severity is Severity.ERROR for each in written):  # what could not be read may be the program
        found = [each for each in found if each.code != "D011"]
    problems = list(dict.fromkeys(replace(problem, span=problem.span.plain()) for problem in found))
    problems.sort(key=lambda each: (each.span.file, each.span.line, each.span.column))
    problems = folded(problems)
    infos = tuple(pou_infos(trees))
    if any(problem.severity is Severity.ERROR for problem in problems):
        return Checked(None, tuple(problems), infos)
    checks = plain_sites(report.checks)
    tasks = () if program is None else task_infos(program, trees)
    if program is not None:
        traps, calls = plain_sites(program.traps), plain_sites(program.calls)
        program = replace(program, traps=traps, checks=checks, calls=calls) if whole else None
    return Checked(program, tuple(problems), infos, checks, tasks)


@dataclass(slots=True)
class Checker:
    report: Report
    model: Model
    parsed: list[tree.File]
    enabling: frozenset[str] = frozenset()
    """Files in whose text EN or ENO occurs."""
    looked_at: frozenset[str] = frozenset()
    """As in `Declarations`."""
    dialect: Dialect = IEC
    generic_blocks: bool = False
    """Whether blocks are made of generic ones, see `generic_blocks.py`."""
    globals: Record = field(default_factory=lambda: Record("GLOBAL", Kind.STRUCT))
    pous: Pous = field(default_factory=Pous)
    declarations: Declarations = field(init=False)
    names: Collector = field(init=False)
    system: System = field(init=False)
    plant: Plant = field(init=False)
    programs: Record = field(init=False)
    """See `placed_programs`."""
    stimuli: Stimuli = field(default_factory=Stimuli)
    life: Life | None = None
    """What initialises instances, where the dialect has that."""
    declared: Mark = (0, 0, 0, 0, 0, 0, 0, 0)
    """What was reported of the declarations."""
    frames: dict[Pou, tuple[dict[str, Member], int, int]] = field(default_factory=dict)
    """Members, size and alignment of the frame of each POU, before its body adds temporaries."""

    def run(self, interval_ns: int) -> Program | None:
        """All passes."""
        self.declare()
        for declaration in self.names.user:
            self.check_body(declaration)
        for method in self.pous.classes.methods():
            if method.pou is not None and not method.abstract:
                self._check_method(method, method.pou)
        return self.finish(interval_ns)

    def declare(self) -> None:
        """Everything but bodies."""
        areas = place_areas(self.model)
        self.declarations = declarations_of(self.report, self.model, areas, self._constant)
        self.declarations.reference_of = self._reference
        self.declarations.looked_at = self.looked_at
        self.declarations.dialect = self.dialect
        self.declarations.names.prefixes = self.dialect.prefixes
        self.system = system_of(self.model, areas)
        self.declarations.symbols = self.system.symbols
        self.names = Collector(self.report, self.declarations, self.system.file, self.enabling)
        self.plant = Plant(self.report, self.pous, plant_files(file.name for file in self.parsed))
        parsed = specialised(self.parsed, self.report, self.dialect)
        self.generic_blocks, self.parsed = parsed is not self.parsed, parsed
        self.names.collect(self.parsed)
        self.pous.overloads = self.names.overloads
        self.pous.classes = collect(self.declarations)
        declare_globals(self.parsed, self.globals, self.declarations, self.pous)
        declare_static(self.declarations, self.globals, self.names.user)
        place_globals(self.model, areas, self.globals)
        self.programs = placed_programs(self.declarations, self.globals, self.plant.holds)
        self._declare_pous()
        self.declarations.declare_types()
        self.declarations.later.tell()
        if Allowance.LIFE in self.dialect.allows:
            self.life = Life(self.report, self.declarations, self.pous, self.globals, self._scope)
            self.pous.life = self.life.declare()
        self.declared = self.report.mark()

    @property
    def is_generic(self) -> bool:
        """Whether POUs are made, or chosen, for those who use them."""
        return bool(self.pous.generic or self.pous.overloads or self.generic_blocks)

    def reuse(self, pou: Pou, part: Report, uses: dict[Pou, int]) -> None:
        """Takes what was found in the body before, instead of checking it; it has no body then, and cannot run."""
        self.frames[pou] = dict(pou.frame.members), pou.frame.size, pou.frame.align
        self.report.parts[pou] = part
        if uses:
            self.pous.uses[pou] = uses

    def recheck(self, pou: Pou, declaration: tree.PouDeclaration) -> None:
        """Checks a new body of a POU whose declarations are unchanged; the caller then calls `finish`."""
        self.report.undo(self.declared)
        self.report.compared = 0
        members, size, align = self.frames[pou]
        pou.frame.members.clear()
        pou.frame.members.update(members)
        pou.frame.size, pou.frame.align = size, align
        self.pous.uses.pop(pou, None)
        self.pous.this_traps.pop(pou.name, None)
        self.check_body(declaration)

    def finish(self, interval_ns: int) -> Program | None:
        """What all bodies together make."""
        self.report.undo(self.declared)
        whole = self._whole()
        self._check_instances()
        self.stimuli.check(self.report, self.declarations, self.pous, self.globals, self.parsed)
        common = self._common()
        self._check_library(common)
        check_borrowed(self.report, self.pous.dispatchers.values())
        self.plant.check(self.parsed)
        check_policies(self.report, self.declarations, self.parsed)
        tell_stubs(self.report, self.names.user, self.parsed)
        order = self._order([*common, *([] if whole is None else [whole.pou])])
        self.report.join(order)
        configurations = [each for file in self.parsed for each in file.configurations]
        settings = [each for file in self.parsed for each in file.settings]
        around = Around(common, self.plant.programs(), whole, self.programs, settings)
        return assemble(
            self.report, self.declarations, self.pous, self.globals, order, configurations, interval_ns, self._end(),
            around,
        )  # fmt: skip

    def _end(self) -> Span:
        """Where a problem of the whole program is shown: at the beginning of its first file."""
        name = self.parsed[0].name if self.parsed else "project"
        return Span(name, 1, 1, 1, 2)

    # ---- declarations -----------------------------------------------------------------------------------

    def _reference(self, owner: Record, node: tree.Expression, type: Reference) -> Expr:
        """What a reference starts with."""
        if is_this(node):
            return own_instance(self.declarations, owner, node, type)
        space = self.declarations.names.space
        scope = Scope(owner.name, self.globals, constants=(owner,), space=space, system=(self.programs,))
        body = body_of(self.report, self.declarations, self.pous, scope, None)
        return as_argument(body, node, type, "The start value")

    def _constant(self, node: tree.Expression, type: Type | None) -> Const:
        """A constant expression among the declarations."""
        owners = tuple(reversed(self.declarations.owners))
        space, later = self.declarations.names.space, self.declarations.later
        scope = Scope("", self.globals, constants=owners, later=later, space=space)
        return constant(body_of(self.report, self.declarations, self.pous, scope, None), node, type)

    def _declare_pous(self) -> None:
        blocks_of_library = []
        for key, declaration in (*self.declarations.block_trees.items(), *self.names.functions.items()):
            if declaration.kind == "function_block" and in_library(declaration.span):
                blocks_of_library.append((key, declaration))
                continue
            with self.declarations.names.within(Space(declaration.namespace, declaration.using)):
                self._declare_pou(key, declaration)
        declare_methods(self.pous.classes, self.declarations)
        self._class_externals()
        for key, declaration in blocks_of_library:
            if key in self.declarations.types:  # somebody declared an instance
                with self.declarations.names.within(Space(declaration.namespace, declaration.using)):
                    self._declare_pou(key, declaration)
        check_classes(self.pous.classes, self.report, self.dialect)
        methods = [each.pou.frame for each in self.pous.classes.methods() if each.pou is not None]
        blocks = [each for each in self.declarations.types.values() if isinstance(each, Record)]
        check_instances(self.pous.classes, [self.globals, *blocks, *methods], self.report)

    def _class_externals(self) -> None:
        """VAR_EXTERNAL of classes, which have no body that would look at them."""
        for owner in self.pous.classes.by_key.values():
            declaration = owner.declaration
            if declaration.kind == "class" and owner.record is not None:
                space = Space(declaration.namespace, declaration.using)
                with self.declarations.names.within(space):
                    externals_of(self.declarations, self.globals, declaration, (owner.record, owner.record), space)

    def _declare_pou(self, key: str, declaration: tree.PouDeclaration) -> None:
        name = full_name(declaration)
        inline = in_library(declaration.span)
        if is_generic(declaration, inline or "ANY" not in self.declarations.type_trees):
            self.pous.generic[key] = declaration
            return
        if declaration.kind == "function":
            try:
                made = frame(self.declarations, declaration, Record(name, Kind.BLOCK))
            except Rejected:
                self.pous.broken.add(key)
                return
            pou = self.pous.functions[key] = called_pou(name, declaration, made)
            self.pous.variadic |= {key} if VARIADIC in declaration.modifiers else set()
            pou.inline = inline
            return
        with suppress(Rejected):
            instance = self.declarations.named(declaration.name, declaration.span)
            if declaration.kind in ("program", "function_block") and isinstance(instance, Record):
                made = frame(self.declarations, declaration, instance)
                pou = Pou(name, declaration.kind, instance, made, (), None, declaration.span, inline=inline)
                self.pous.blocks[key] = pou

    # ---- bodies -----------------------------------------------------------------------------------------

    def check_body(self, declaration: tree.PouDeclaration) -> None:
        """Checks the body of a program, block or function."""
        key = full_name(declaration).upper()
        pou = self._pou(declaration)
        if pou is None:
            return
        self._check(pou, declaration, pou.instance, Space(declaration.namespace, declaration.using), None)
        if key in self.names.tells and key in self.pous.blocks:
            eno = place_of(pou.instance.members["ENO"], Base.SELF, pou.instance, 0)
            pou.body = (Assign(eno, Const(BOOL, 1), pou.span), *pou.body)

    def _pou(self, declaration: tree.PouDeclaration) -> Pou | None:
        key = full_name(declaration).upper()
        return (self.pous.functions if declaration.kind == "function" else self.pous.blocks).get(key)

    def body_at(
        self, declaration: tree.PouDeclaration, method: tree.PouDeclaration | None, effects: Effects
    ) -> Body | None:
        """A body of a program, block, function or one of its methods in which more can be checked; None where its
        declarations are wrong. What is reported there, the check of the program does not see."""
        space = Space(declaration.namespace, declaration.using)
        owner = self.pous.classes.by_key.get(full_name(declaration).upper())
        if method is None:
            pou, instance, this = self._pou(declaration), None, None
        else:
            known = owner.methods.get(key_of(method)) if owner is not None else None
            pou, instance = (None, None) if known is None or owner is None else (known.pou, owner.record)
            this = None if pou is None else place_of(pou.frame.members["THIS"], Base.FRAME, pou.frame, 0).slot
        if pou is None:
            return None
        with self.declarations.names.within(space), self.report.apart():
            scope = self._scope(pou, method or declaration, instance or pou.instance, space, this)
        return body_of(Report(), self.declarations, self.pous, scope, pou, effects=effects)

    def _check_method(self, method: Method, pou: Pou) -> None:
        around = method.owner.declaration
        assert method.owner.record is not None
        this = place_of(pou.frame.members["THIS"], Base.FRAME, pou.frame, 0).slot
        self._check(pou, method.declaration, method.owner.record, Space(around.namespace, around.using), this)

    def _check(
        self, pou: Pou, declaration: tree.PouDeclaration, instance: Record, space: Space, this: Place | None
    ) -> None:
        self.frames[pou] = dict(pou.frame.members), pou.frame.size, pou.frame.align
        with self.declarations.names.within(space), self.report.apart() as self.report.parts[pou]:
            scope = self._scope(pou, declaration, instance, space, this)
            pou.body = pou_body(body_of(self.report, self.declarations, self.pous, scope, pou), declaration)

    def _scope(
        self, pou: Pou, declaration: tree.PouDeclaration, instance: Record, space: Space, this: Place | None
    ) -> Scope:
        """What the body sees."""
        externals = externals_of(self.declarations, self.globals, declaration, (instance, pou.frame), space)
        visible = Record("GLOBAL", Kind.STRUCT) if pou.inline else self.globals  # the library sees none of them
        scope = Scope(pou.name, visible, instance, pou.frame, externals, this=this, space=space)
        scope.system, scope.who = self._rights(declaration.span)
        around = self.pous.classes.of(instance)
        scope.policy = pou_policy(self.dialect, declaration, None if around is None else around.declaration)
        scope.kept = kept_of(declaration, None if around is None else around.declaration, instance, self.globals)
        return scope

    def _rights(self, span: Span) -> tuple[tuple[Record, ...], Who]:
        """The records that every program at this span can use, and with whose rights it writes."""
        if is_system(span):
            return (self.system.words,), "engine"
        if in_library(span):
            return (), "program"
        return (self.system.symbols, self.programs), "engine" if self.plant.holds(span) else "program"

    def _check_instances(self) -> None:
        """Bodies of generic functions, for the types that they are called with; they may call others."""
        while fresh := [each for each in self.pous.instances.values() if each.pou not in self.frames]:
            for pou, declaration in [(each.pou, each.declaration) for each in fresh]:
                self._check(pou, declaration, pou.instance, Space(declaration.namespace, declaration.using), None)

    def _whole(self) -> Whole | None:
        """What initialises the instances of the program, where the dialect has that."""
        if self.life is None:
            return None
        if not self.life.made:
            self.life.make()
        return whole_of(self.life.code, self.pous, self.globals)

    def _common(self) -> list[Pou]:
        """The program of common processing."""
        key = next((key for key, each in self.names.library.items() if each.name == COMMON), "")
        return [self.pous.blocks[key]] if key else []

    def _check_library(self, common: list[Pou]) -> None:
        """Bodies of the library POUs that are used, and of those that they use."""
        done: set[Pou] = set()
        while True:
            used = [*common, *(callee for called in list(self.pous.uses.values()) for callee in called)]
            fresh = [pou for pou in used if pou.inline and pou not in done]
            if not fresh:
                return
            for pou in fresh:
                done.add(pou)
                if not pou.body:
                    self.check_body(self.names.library[pou.name.upper()])
                    assert not self.report.parts[pou].problems, pou.name  # the library is ours

    def _order(self, common: list[Pou]) -> list[Pou]:
        methods = [each.pou for each in self.pous.classes.methods() if each.pou is not None]
        allow(self.report, self.pous, self.declarations.dialect)
        methods += [] if self.life is None else self.life.pou_list()
        roots = (*self.pous.functions.values(), *self.pous.blocks.values(), *methods)
        return Order(self.report, self.pous).of([*common, *(pou for pou in roots if not pou.inline)])
