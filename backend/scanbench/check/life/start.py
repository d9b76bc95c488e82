"""The code that initialises the blocks in a variable, or looks which of them are new or changed after a program change."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, fields, is_dataclass, replace

from scanbench.check.body.arguments import invoke
from scanbench.check.body.context import Body
from scanbench.check.body.direct import as_argument
from scanbench.check.body.methods import assign_property
from scanbench.check.context import Rejected
from scanbench.check.declare.classes import Class
from scanbench.check.declare.creations import FB_REINIT, MADE, Arguments, Creation, is_called
from scanbench.check.declare.declarations import StartExpression
from scanbench.check.declare.life_rules import extra_inputs, init_of, is_whole
from scanbench.check.declare.scopes import decode
from scanbench.check.declare.start_references import own_references, refers
from scanbench.check.life.code import Code
from scanbench.check.life.explicit import Explicit, explicit
from scanbench.check.life.needs import has_made
from scanbench.problems import Span
from scanbench.program.program import (
    Assign,
    Base,
    Compare,
    Const,
    Expr,
    For,
    If,
    Index,
    Load,
    Place,
    Pou,
    RefOf,
    SetBytes,
    Stmt,
)
from scanbench.program.sites import TrapKind
from scanbench.program.types import (
    BOOL,
    DINT,
    ULINT,
    ArrayType,
    Elementary,
    Member,
    Record,
    Reference,
    Type,
    initial_of,
)
from scanbench.syntax import tree

RETAINS, COPY = "bInitRetains$", "bInCopyCode$"
"""Inputs of the code that initialises an instance."""
SYSTEM_INPUTS = (RETAINS, COPY)


def hidden(name: str) -> str:
    """The input of that code which goes to this input of FB_init: no variable of the program has such a name."""
    return f"{name}$"


@dataclass(slots=True)
class Writer:
    """Writes the code for what is in one record."""

    body: Body
    code: Code
    place_of: Callable[[Member], Place]
    passed_on: bool = True
    """Whether the code around has the inputs that are passed on; else it initialises what lasts for one call."""

    def members(self, record: Record, members: Sequence[Member], fresh: bool) -> list[Stmt]:
        """For these variables of the record. `fresh`: all of them are new; else each is looked at."""
        made: list[Stmt] = []
        for member in members:
            creation = self.body.declarations.creations.of(record, member)
            try:
                made += self._member(record, member, creation, fresh)
            except Rejected:
                continue
        return made

    def computed(self, record: Record, member: Member) -> list[Stmt]:
        """What the variable, or a part of it, starts with that has to be computed."""
        key = (member.home or record.name).upper(), member.name.upper()
        place, made = self.place_of(member), list[Stmt]()
        for each in self.body.declarations.computed.get(key, ()):
            span, type = member.span, each.type  # as all that initialises a variable: no statement of its own
            self._only_above(record, member, each.node)
            if each.property:
                one = self._property(member, each)
            else:
                value = as_argument(self.body, each.node, type, f"`{member.name}`")
                one = Assign(replace(place, type=type, offset=place.offset + each.offset), value, span)
            kept = self.passed_on and member.retain
            made.append(If(((self.body.expression(self._input(RETAINS, span)), (one,)),), (), span) if kept else one)
        return made

    def _property(self, member: Member, given: StartExpression) -> Stmt:
        """SET of a property of what the variable holds: it may write anything, so it runs when that is initialised."""
        node: tree.Expression = tree.Name(member.name, given.node.span)
        for name in given.property.split("."):
            node = tree.MemberOf(node, name, given.node.span)
        made = assign_property(self.body, node, given.node, given.node.span)
        if made is None:  # it has GET alone
            raise self.body.report.reject(
                "D004",
                f"`{given.property}` is a property without SET, so nothing starts it with a value.",
                given.node.span,
            )
        return made

    def _only_above(self, record: Record, member: Member, node: tree.Expression) -> None:
        """What is declared further down has no value yet in the vendors' tools, or has it already: their documentation does not say."""
        order = [*record.members]
        below = set(order[order.index(member.name.upper()) + 1 :])
        for name in _named_variables(node):
            if name.upper() in below and not record.members[name.upper()].constant:
                self.body.report.error(
                    "D004",
                    f"`{name}` is declared below `{member.name}`, whose start value needs it; declare it above.",
                    node.span,
                )

    def _member(self, record: Record, member: Member, creation: Creation, fresh: bool) -> list[Stmt]:
        place = self.place_of(member)
        values = list(explicit(creation.initial, member.type, member.retain, self._count))
        # what is given from outside is not there yet when FB_init runs
        own = own_references(self.body.declarations, member.type) if values else {}
        before = self._values(place, values, initial_of(member.type), creation.span, own)
        after = self._values(place, values, member.initial or initial_of(member.type), creation.span, None)
        if not fresh:
            before, after = [], []
        elements = list(creation.elements)
        if elements and isinstance(member.type, ArrayType) and len(elements) != member.type.count:
            self.body.report.error(
                "D004",
                f"`{member.name}` has {member.type.count} elements, but arguments for {len(elements)}.",
                creation.span,
            )
            raise Rejected
        last = self._after(place, member.type, creation.span) if fresh else []
        after += self.computed(record, member) if fresh else []
        return [
            *before,
            *self.walk(place, member.type, creation.arguments, elements, creation.span, fresh),
            *after,
            *last,
        ]

    def _count(self, node: tree.Expression) -> int:
        value = self.body.declarations.constant_of(node, None).value
        return value if isinstance(value, int) else 1

    def _values(
        self, place: Place, values: list[Explicit], data: bytes, span: Span, own: dict[int, tuple[RefOf, int]] | None
    ) -> list[Stmt]:
        """Assigns them: what the declaration says, or with `own` what a fresh variable has."""
        made: list[Stmt] = []
        for each in values:
            target = replace(place, type=each.type, offset=place.offset + each.offset, variable="")
            part = data[each.offset : each.offset + each.type.size]
            value: Expr | None = decode(each.type, part) if isinstance(each.type, Elementary) else None
            if own is None:
                bound = self._bound(each)
            else:
                bound = referring(place, *own[each.offset]) if each.offset in own else None
            value = bound or value
            one: Stmt = SetBytes(target, part, span) if value is None else Assign(target, value, span)
            made.append(
                If(((self.body.expression(self._input(RETAINS, span)), (one,)),), (), span) if each.retain else one
            )
        return made

    def _bound(self, each: Explicit) -> Expr | None:
        """The reference that starts with a variable; None for other values."""
        node, type = each.node, each.type
        if node is None or isinstance(node, tree.ArrayInit | tree.StructInit) or not isinstance(type, Reference):
            return None
        if not refers(self.body.declarations, type, node):
            return None
        return as_argument(self.body, node, type, "The start value")

    def _input(self, name: str, span: Span) -> tree.Expression:
        return tree.Name(name, span) if self.passed_on else tree.Literal("bool", int(name == RETAINS), None, span)

    def whole(self, place: Place, type: Type, span: Span, arguments: Arguments = ()) -> list[Stmt]:
        """For something new that no declaration gives values to."""
        return [*self.walk(place, type, arguments, [], span, True), *self._after(place, type, span)]

    # ---- what is in a variable --------------------------------------------------------------------------

    def walk(
        self, place: Place, type: object, arguments: Arguments, elements: list[Arguments], span: Span, fresh: bool
    ) -> list[Stmt]:
        """All blocks in what lives at the place."""
        if isinstance(type, ArrayType):
            return self._array(place, type, arguments, elements, span, fresh)
        if not isinstance(type, Record) or not self.code.needs.of(type):
            return []
        owner = self.body.pous.classes.of(type)
        if owner is not None:
            return self._instance(place, type, owner, arguments, span, fresh)
        made: list[Stmt] = []
        for member in self.code.needs.members(type):
            inner = self.body.lookup.inside(self.body, place, type, member, span)
            creation = self.body.declarations.creations.of(type, member)
            made += self.walk(inner, member.type, creation.arguments, list(creation.elements), span, fresh)
        return made

    def _array(
        self, place: Place, type: ArrayType, arguments: Arguments, elements: list[Arguments], span: Span, fresh: bool
    ) -> list[Stmt]:
        if elements:
            made: list[Stmt] = []
            for number, each in enumerate(elements):
                at = replace(place, type=type.element, offset=place.offset + number * type.element.size)
                made += self.walk(at, type.element, each, [], span, fresh)
            return made
        return self.each_element(place, type, span, lambda at: self.walk(at, type.element, arguments, [], span, fresh))

    def each_element(
        self, place: Place, type: ArrayType, span: Span, code: Callable[[Place], list[Stmt]]
    ) -> list[Stmt]:
        """A loop over an array, in the order of memory."""
        body, last = self.body, type.count - 1
        counter = body.temporary(DINT, span, "element")
        trap = body.trap(TrapKind.BOUNDS, span, "the elements are initialised one after the other")
        index = Index(Load(counter), 0, last, type.element.size, trap)
        inner = tuple(code(replace(place, type=type.element, indices=(*place.indices, index))))
        if not inner:
            return []
        budget = body.trap(TrapKind.LOOP, span, "the array has more elements than a scan may initialise")
        return [For(counter, Const(DINT, 0), Const(DINT, last), Const(DINT, 1), inner, False, budget, span)]

    # ---- one instance -----------------------------------------------------------------------------------

    def _instance(
        self, place: Place, type: Record, owner: Class, arguments: Arguments, span: Span, fresh: bool
    ) -> list[Stmt]:
        if fresh:
            return self.start(place, type, owner, arguments, span)
        change = self.code.changes.get(type.name.upper())
        looks = [] if change is None else self._call(change, place, self._passed_on(SYSTEM_INPUTS, span), span)
        if not has_made(type):
            return looks
        made = self._made(place, type, span)
        reinit = owner.find(FB_REINIT)
        again = (
            [] if reinit is None or reinit.pou is None or reinit.abstract else self._call(reinit.pou, place, (), span)
        )
        changed = [*again, Assign(made, Const(ULINT, self.code.numbers.of(type)), span)]
        differs = Compare("ne", BOOL, Load(made), Const(ULINT, self.code.numbers.of(type)))
        known: list[Stmt] = [*looks, If(((differs, tuple(changed)),), (), span)]
        is_new = Compare("eq", BOOL, Load(made), Const(ULINT, 0))
        new = [*self.start(place, type, owner, arguments, span), *self._after(place, type, span)]
        return [If(((is_new, tuple(new)),), tuple(known), span)]

    def start(self, place: Place, type: Record, owner: Class, arguments: Arguments, span: Span) -> list[Stmt]:
        """The initialisation of an instance that is new."""
        callee = self.code.starts.get(type.name.upper())
        if callee is None:
            raise Rejected  # its declaration is wrong
        given = [*self._passed_on(SYSTEM_INPUTS, span), *self._given(owner, arguments, span)]
        made = self._call(callee, place, given, span)
        if has_made(type):
            made.append(Assign(self._made(place, type, span), Const(ULINT, self.code.numbers.of(type)), span))
        return made

    def _made(self, place: Place, type: Record, span: Span) -> Place:
        return self.body.lookup.inside(self.body, place, type, type.members[MADE.upper()], span)

    def _passed_on(self, names: Sequence[str], span: Span) -> list[tree.Argument]:
        return [tree.Argument(each, False, self._input(each, span), span) for each in names]

    def _given(self, owner: Class, arguments: Arguments, span: Span) -> list[tree.Argument]:
        """What a declaration gives to FB_init, by the names of the inputs."""
        init = init_of(owner)
        if init is None:
            return []
        if not is_whole(init):
            raise Rejected
        inputs = [each for _, each in extra_inputs(owner)]
        report, made = self.body.report, {}
        for number, argument in enumerate(arguments):
            if argument.name is None and number >= len(inputs):
                raise report.reject(
                    "T004", f"`{owner.name}.FB_init` takes {len(inputs)} further arguments, not {len(arguments)}.", span
                )
            name = inputs[number].name if argument.name is None else argument.name
            known = next((each for each in inputs if each.name.upper() == name.upper()), None)
            if known is None or argument.output or argument.value is None:
                hint = report.near(name, lambda: [each.name for each in inputs], f"argument:{owner.name}.FB_init")
                raise report.reject("T004", f"`{owner.name}.FB_init` has no input `{name}`.{hint}", argument.span)
            made[known.name.upper()] = replace(argument, name=hidden(known.name), place=None)
        for each in inputs:
            if each.name.upper() not in made and each.initial is None:
                raise report.reject(
                    "T004", f"`{owner.name}.FB_init` needs `{each.name}`: `{owner.name}({each.name} := ...)`.", span
                )
        return list(made.values())

    def _call(self, callee: Pou, place: Place, arguments: Sequence[tree.Argument], span: Span) -> list[Stmt]:
        this = callee.frame.members["THIS"].type
        node = tree.Call(tree.Name(callee.name, span), tuple(arguments), span)
        return invoke(self.body, node, callee, callee.name, replace(place, type=this), None).statements(span)

    # ---- what follows -----------------------------------------------------------------------------------

    def _after(self, place: Place, type: object, span: Span) -> list[Stmt]:
        """Methods that are called when all of a declaration is done."""
        if isinstance(type, ArrayType):
            return self.each_element(place, type, span, lambda at: self._after(at, type.element, span))
        made: list[Stmt] = []
        for pou in after_init(self.body, type):
            made += self._call(pou, place, (), span)
        if isinstance(type, Record) and self.body.pous.classes.of(type) is None:
            for member in self.code.needs.members(type):
                inner = self.body.lookup.inside(self.body, place, type, member, span)
                made += self._after(inner, member.type, span)
        return made


def referring(place: Place, value: RefOf, base: int) -> RefOf:
    """A reference that `own_references` found, for the variable at this place."""
    if value.place.base is not Base.SELF:
        return value
    to = replace(place, type=value.place.type, offset=place.offset + base + value.place.offset, variable="")
    return RefOf(to, value.type)


def after_init(body: Body, type: object) -> list[Pou]:
    """The methods of a block that are called after its initialisation, those of its bases first."""
    owner = body.pous.classes.of(type)
    found: dict[str, Pou] = {}
    for each in chain(owner):
        for key, method in each.methods.items():
            reached = owner.find(key) if owner is not None else None
            called = is_called(method.declaration) and key not in ("FB_INIT", "FB_REINIT")
            if called and reached is not None and reached.pou is not None and not reached.abstract:
                found[key] = reached.pou
    return list(found.values())


def chain(owner: Class | None) -> list[Class]:
    """The class and its bases, the farthest first."""
    found: list[Class] = []
    while owner is not None:
        found.append(owner)
        owner = owner.base
    return found[::-1]


def _named_variables(node: object) -> Iterator[str]:
    """The names of variables in an expression, without those of their members."""
    if isinstance(node, tree.Name):
        yield node.name
    elif isinstance(node, tree.MemberOf):
        yield from _named_variables(node.owner)
    elif isinstance(node, tuple):
        for each in node:
            yield from _named_variables(each)
    elif is_dataclass(node) and not isinstance(node, Span | type):
        for each in fields(node):
            yield from _named_variables(getattr(node, each.name))
