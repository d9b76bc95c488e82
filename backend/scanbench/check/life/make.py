"""The code that initialises instances: for each block, for the global variables, and for the whole program.

For a block `B` there is a method without a name that a text could use: first that of its base, then of each of its variables
in order of declaration, then its own FB_init. A second one looks after a program change which instances are new, or were changed.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

from scanbench.check.body.arguments import invoke
from scanbench.check.body.bodies import body_of
from scanbench.check.body.context import Body
from scanbench.check.body.objects import own
from scanbench.check.context import Rejected, Report
from scanbench.check.declare.classes import Class, called_pou
from scanbench.check.declare.creations import FB_INIT, inputs_of
from scanbench.check.declare.declarations import Declarations
from scanbench.check.declare.frames import frame
from scanbench.check.declare.life_rules import COPY as COPY_INPUT
from scanbench.check.declare.life_rules import RETAINS as RETAINS_INPUT
from scanbench.check.declare.life_rules import extra_inputs, inherited_init, is_whole
from scanbench.check.declare.names import Space
from scanbench.check.declare.scopes import Pous, Scope, place_of
from scanbench.check.life.code import Code
from scanbench.check.life.needs import Needs
from scanbench.check.life.start import COPY, RETAINS, SYSTEM_INPUTS, Writer, hidden
from scanbench.problems import Span
from scanbench.program.origin import SYSTEM_FILE
from scanbench.program.program import Base, Place, Pou, Stmt
from scanbench.program.types import Kind, Member, Record
from scanbench.syntax import tree

NOWHERE = Span(SYSTEM_FILE, 1, 1, 1, 1)
GLOBALS = "$globals"

ScopeOf = Callable[[Pou, tree.PouDeclaration, Record, Space, Place | None], Scope]


@dataclass(slots=True)
class Life:
    """Makes the code of one program."""

    report: Report
    declarations: Declarations
    pous: Pous
    globals: Record
    scope_of: ScopeOf
    code: Code = field(init=False)
    made: bool = False
    """Whether the bodies are there."""

    def __post_init__(self) -> None:
        self.code = Code(Needs(self.declarations.computed))

    def declare(self) -> Code:
        """What each block needs that has something to initialise; the bodies of all POUs may call it."""
        for owner in self._needing():
            self._declare(owner, "start", self.code.starts, extra_inputs(owner))
            if owner.record is not None and self.code.needs.members(owner.record):
                self._declare(owner, "change", self.code.changes, [])
        return self.code

    def make(self) -> None:
        """The bodies of all that was declared."""
        for owner in self._needing():
            self._method(owner, self.code.starts, fresh=True)
            self._method(owner, self.code.changes, fresh=False)
        if self.code.needs.members(self.globals):
            self._globals("start", self.code.starts, fresh=True)
            self._globals("change", self.code.changes, fresh=False)
        self.made = True

    def pou_list(self) -> list[Pou]:
        """Of all that was made."""
        return [*self.code.starts.values(), *self.code.changes.values()]

    def _needing(self) -> list[Class]:
        return [each for each in self.pous.classes.by_key.values() if self._needed(each)]

    def _needed(self, owner: Class) -> bool:
        return (
            owner.record is not None
            and owner.kind in ("function_block", "program")
            and self.code.needs.of(owner.record)
        )

    def _space(self, owner: Class) -> Space:
        return Space(owner.declaration.namespace, owner.declaration.using)

    def _declare(
        self,
        owner: Class,
        name: str,
        made: dict[str, Pou],
        inputs: Sequence[tuple[tree.VariableSection, tree.Variable]],
    ) -> None:
        assert owner.record is not None
        flags = tuple(
            tree.Variable(each, tree.NamedType("BOOL", NOWHERE), None, None, NOWHERE) for each in SYSTEM_INPUTS
        )
        sections = [tree.VariableSection("VAR_INPUT", (), flags, NOWHERE)]
        for section, variable in inputs:
            sections.append(replace(section, variables=(replace(variable, name=hidden(variable.name)),)))
        declaration = tree.PouDeclaration("method", f"{name}$$", None, tuple(sections), (), NOWHERE)
        full = f"{owner.name}.{name}$$"
        try:
            with self.declarations.names.within(self._space(owner)), self.report.apart():
                part = frame(self.declarations, declaration, Record(full, Kind.BLOCK), this=owner.record)
        except Rejected:
            return
        made[owner.name.upper()] = called_pou(full, declaration, part)

    # ---- blocks and programs ----------------------------------------------------------------------------

    def _method(self, owner: Class, pous: dict[str, Pou], fresh: bool) -> None:
        pou, record = pous.get(owner.name.upper()), owner.record
        if pou is None or record is None:
            return
        space = self._space(owner)
        this = place_of(pou.frame.members["THIS"], Base.FRAME, pou.frame, 0).slot
        with self.declarations.names.within(space), self.report.apart() as self.report.parts[pou]:
            scope = self.scope_of(pou, owner.declaration, record, space, this)
            body = body_of(self.report, self.declarations, self.pous, scope, pou)
            writer = Writer(body, self.code, lambda member: own(body, place_of(member, Base.SELF, record, 0)))
            pou.body = tuple(self._steps(owner, record, writer, pous, fresh))

    def _steps(self, owner: Class, record: Record, writer: Writer, pous: dict[str, Pou], fresh: bool) -> list[Stmt]:
        body, made = writer.body, list[Stmt]()
        above = None if owner.base is None else pous.get(owner.base.name.upper())
        init = owner.methods.get(FB_INIT)
        if init is not None and not is_whole(init):
            return []
        if above is not None and owner.base is not None:
            names = [RETAINS, COPY]
            if fresh and inherited_init(owner) is not None:
                names += [hidden(each.name) for _, each in extra_inputs(owner.base)]
            made += _passing(body, above, names, {each: each for each in names})
        mine = [
            each for each in self.code.needs.members(record) if (each.home or record.name).upper() == owner.name.upper()
        ]
        made += writer.members(record, mine, fresh)
        if fresh and init is not None and init.pou is not None:
            has = {each.name.upper() for _, each in inputs_of(init.declaration)}
            system = ((RETAINS_INPUT, RETAINS), (COPY_INPUT, COPY))
            given = {name: input for name, input in system if name in has}
            given |= {each.name.upper(): hidden(each.name) for _, each in extra_inputs(owner)}
            made += _passing(body, init.pou, given, given)
        return made

    # ---- global variables -------------------------------------------------------------------------------

    def _globals(self, name: str, pous: dict[str, Pou], fresh: bool) -> None:
        flags = tuple(
            tree.Variable(each, tree.NamedType("BOOL", NOWHERE), None, None, NOWHERE) for each in SYSTEM_INPUTS
        )
        sections = (tree.VariableSection("VAR_INPUT", (), flags, NOWHERE),)
        declaration = tree.PouDeclaration("function", f"{GLOBALS}.{name}", None, sections, (), NOWHERE)
        made = frame(self.declarations, declaration, Record(declaration.name, Kind.BLOCK))
        pou = pous[GLOBALS.upper()] = called_pou(declaration.name, declaration, made)
        with self.report.apart() as self.report.parts[pou]:
            scope = Scope(pou.name, self.globals, None, pou.frame)
            body = body_of(self.report, self.declarations, self.pous, scope, pou)
            writer = Writer(body, self.code, self._global_place)
            pou.body = tuple(writer.members(self.globals, self.code.needs.members(self.globals), fresh))

    def _global_place(self, member: Member) -> Place:
        return place_of(member, Base.IMAGE, self.globals, 0)


def _passing(body: Body, callee: Pou, formals: "Sequence[str] | dict[str, str]", given: dict[str, str]) -> list[Stmt]:
    """A call on the same instance that passes on inputs of the caller: the name of a formal one, and that of the input."""
    arguments = tuple(tree.Argument(each, False, tree.Name(given[each], NOWHERE), NOWHERE) for each in formals)
    this = replace(body.lookup.this(body, "THIS", NOWHERE), type=callee.frame.members["THIS"].type)
    node = tree.Call(tree.Name(callee.name, NOWHERE), arguments, NOWHERE)
    try:
        return invoke(body, node, callee, callee.name, this, None).statements(NOWHERE)
    except Rejected:
        return []
