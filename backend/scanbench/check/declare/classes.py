"""Blocks, classes and interfaces as objects: who extends and implements whom, and which method a call reaches."""

from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass, field, replace

from scanbench.check.context import Rejected
from scanbench.check.declare.declarations import Declarations
from scanbench.check.declare.frames import frame
from scanbench.check.declare.names import Space, qualified, written
from scanbench.check.dialect import Allowance
from scanbench.check.uses import Symbol
from scanbench.program.program import Pou
from scanbench.program.types import UDINT, Kind, Member, Record, Reference, Section
from scanbench.syntax import tree
from scanbench.syntax.parse_pou import ACTION

TYPE_NUMBER = "$type"
"""Hidden first member of everything that takes part in inheritance: the number of the instance's class."""


@dataclass(eq=False, slots=True)
class Method:
    """A method, or one half of a property."""

    owner: "Class"
    declaration: tree.PouDeclaration
    pou: Pou | None = None
    """None when its declaration is wrong. That of an abstract one has no body and never runs."""

    @property
    def key(self) -> str:
        return key_of(self.declaration)

    @property
    def name(self) -> str:
        return f"{self.owner.name}.{self.declaration.name}{self.declaration.overload}"

    @property
    def symbol(self) -> Symbol:
        return Symbol("method", self.owner.name.upper(), self.declaration.name.upper())

    @property
    def abstract(self) -> bool:
        return self.owner.kind == "interface" or "ABSTRACT" in self.declaration.modifiers


@dataclass(eq=False, slots=True)
class Class:
    """A FUNCTION_BLOCK, CLASS, INTERFACE or PROGRAM."""

    name: str
    declaration: tree.PouDeclaration
    number: int
    record: Record | None = None
    base: "Class | None" = None
    interfaces: list["Class"] = field(default_factory=list)
    """Implemented; of an interface, those that it extends."""
    heirs: list["Class"] = field(default_factory=list)
    """Those that extend or implement it directly."""
    methods: dict[str, Method] = field(default_factory=dict)
    """Its own, by key."""
    refused: bool = False
    """Something that it extends or implements was refused."""
    _above: tuple["Class", ...] | None = None

    @property
    def kind(self) -> str:
        return self.declaration.kind

    @property
    def abstract(self) -> bool:
        return self.kind == "interface" or "ABSTRACT" in self.declaration.modifiers

    @property
    def polymorphic(self) -> bool:
        """Whether a reference to it may refer to an instance of something else."""
        return self.kind == "interface" or bool(self.base or self.heirs or self.interfaces)

    @property
    def open(self) -> bool:
        """As `Record.open`."""
        return self.refused or any(each.refused for each in self.ancestors())

    def ancestors(self) -> Sequence["Class"]:
        """What it extends and implements, each once, the nearest first; not itself."""
        return self._above if self._above is not None else list(self.walk())

    def walk(self, fine: Collection["Class"] = ()) -> Iterator["Class"]:
        """The same while links may still change; nothing that is above one of these."""
        open_, found = self._parents(), set(fine)
        while open_:
            each = open_.pop()
            if each not in found:
                found.add(each)
                yield each
                open_ += each._parents()

    def settle(self) -> None:
        """Keeps its ancestors: links do not change any more. A chain of bases may be long."""
        chain: list[Class] = []
        each: Class | None = self
        while each is not None and each._above is None:
            chain.append(each)
            each = each.base
        for each in reversed(chain):
            base = each.base
            if base is not None and base._above is not None and not each.interfaces:
                each._above = (base, *base._above)
            else:
                each._above = tuple(each.walk())

    def _parents(self) -> list["Class"]:
        """What it extends comes last, so that it is the next to be looked at."""
        return [*reversed(self.interfaces), self.base] if self.base else self.interfaces[::-1]

    def find(self, key: str) -> Method | None:
        """The method that a call on an instance of exactly this reaches; an abstract one only where no other is."""
        if key in self.methods:
            return self.methods[key]
        return next((each.methods[key] for each in self.ancestors() if key in each.methods), None)

    def overloads(self, name: str) -> list[Method]:
        """The methods of this name, in upper case, that differ in their inputs, its own first."""
        found: dict[str, Method] = {}
        for each in (self, *self.ancestors()):
            for key, method in each.methods.items():
                if method.declaration.overload and method.declaration.name.upper() == name:
                    found.setdefault(key, method)
        return list(found.values())

    def method_names(self) -> list[str]:
        """Of its methods and of those that it inherits."""
        return [*(each.declaration.name for each in self.methods.values()), *self.inherited_names()]

    def inherited_names(self) -> list[str]:
        """Of the methods of what it extends and implements."""
        return [each.declaration.name for above in self.ancestors() for each in above.methods.values()]

    def family(self) -> list["Class"]:
        """Itself and all that extend or implement it, each once, in order of declaration."""
        found = {self: None}
        open_ = [self]
        while open_:
            for heir in open_.pop().heirs:
                if heir not in found:
                    found[heir] = None
                    open_.append(heir)
        return sorted(found, key=lambda each: each.number)


def key_of(declaration: tree.PouDeclaration) -> str:
    """Under which a class keeps a method: `RUN`, and `SPEED.GET` for half of a property."""
    half = f".{declaration.kind.upper()}" if declaration.kind in ("get", "set") else ""
    return f"{declaration.name.upper()}{declaration.overload}{half}"


@dataclass(slots=True)
class Classes:
    """All classes of a program, by the keys of `Declarations.block_trees`."""

    by_key: dict[str, Class] = field(default_factory=dict)
    properties: set[str] = field(default_factory=set)
    """Names of all properties: what is none of them needs no look into the classes."""
    actions: set[str] = field(default_factory=set)
    """Names of all actions, in upper case."""

    def of(self, record: object) -> Class | None:
        """The class whose instances have this record."""
        return self.by_key.get(record.name.upper()) if isinstance(record, Record) else None

    def implementations(self, owner: Class, find: Callable[[Class], Pou | None]) -> dict[Pou, list[int]]:
        """What a call on an instance of `owner` or of something derived from it can reach, with the class numbers."""
        made: dict[Pou, list[int]] = {}
        for each in owner.family():
            pou = None if each.abstract else find(each)
            if pou is not None:
                made.setdefault(pou, []).append(each.number)
        return made

    def methods(self) -> Iterator[Method]:
        """All methods that were declared."""
        for each in self.by_key.values():
            yield from each.methods.values()


def reachable_pou(owner: Class, key: str) -> Pou | None:
    """The method that a call on an instance of exactly `owner` runs."""
    method = owner.find(key)
    return None if method is None or method.abstract else method.pou


# ---- making them ------------------------------------------------------------------------------------------------


def collect(declarations: Declarations) -> Classes:
    """Makes the classes, and links those that extend and implement each other."""
    made = Classes()
    for number, (key, declaration) in enumerate(declarations.block_trees.items(), 1):
        made.by_key[key] = Class(qualified(declaration.namespace, declaration.name), declaration, number)
    for each in made.by_key.values():
        if each.declaration.extends or each.declaration.implements:
            _link(each, made, declarations)
    fine: set[Class] = set()
    for each in made.by_key.values():
        _cut_circle(each, declarations, fine)
        fine.add(each)
    for each in made.by_key.values():
        each.settle()
    declarations.inherit = _Inherit(made, declarations)
    return made


def _link(owner: Class, classes: Classes, declarations: Declarations) -> None:
    declaration = owner.declaration
    extends = [(parent, "EXTENDS") for parent in declaration.extends]
    if (
        Allowance.VENDOR_OPERATORS in declarations.dialect.allows
    ):  # what asks for an interface needs no base for it here
        extends = [(parent, word) for parent, word in extends if parent.name.upper() != "__SYSTEM.IQUERYINTERFACE"]
    for named, keyword in [*extends, *((parent, "IMPLEMENTS") for parent in declaration.implements)]:
        try:
            parent = _parent(named, keyword, owner, classes, declarations)
        except Rejected:
            owner.refused = True
            continue
        if parent.kind == "interface":
            owner.interfaces.append(parent)
        else:
            owner.base = parent
        parent.heirs.append(owner)


def _parent(named: tree.NamedType, keyword: str, owner: Class, classes: Classes, declarations: Declarations) -> Class:
    declaration, report, name = owner.declaration, declarations.report, named.name
    with declarations.names.within(Space(declaration.namespace, declaration.using)):
        key = declarations.names.find(name, declaration.span, declarations.block_trees)
    if key is None:
        interface = keyword == "IMPLEMENTS" or owner.kind == "interface"
        every = classes.by_key.values()
        hint = report.near(
            name, lambda: [each.name for each in every if (each.kind == "interface") == interface], keyword
        )
        raise report.reject("D002", f"There is no {_wanted(owner, keyword)} `{name}`.{hint}", declaration.span)
    parent = classes.by_key[key]
    report.use(named.span, written(name), Symbol("pou", "", written(key)))
    fits = {
        "IMPLEMENTS": ("interface",), "interface": ("interface",), "class": ("class",),
        "function_block": ("function_block", "class"),
    }.get(keyword if keyword == "IMPLEMENTS" else owner.kind, ())  # fmt: skip
    if parent.kind not in fits:
        raise report.reject(
            "D014", f"`{owner.name}` {keyword} `{parent.name}`, but that is a {shown(parent.kind)}, "
            f"not {_wanted(owner, keyword)}.", declaration.span,
        )  # fmt: skip
    if "FINAL" in parent.declaration.modifiers:
        raise report.reject("D014", f"`{parent.name}` is FINAL and cannot be extended.", declaration.span)
    if owner.base is not None and parent.kind != "interface":
        raise report.reject("D014", f"`{owner.name}` extends `{owner.base.name}` already.", declaration.span)
    return parent


def _wanted(owner: Class, keyword: str) -> str:
    if keyword == "IMPLEMENTS" or owner.kind == "interface":
        return "INTERFACE"
    return "CLASS" if owner.kind == "class" else "FUNCTION_BLOCK or CLASS"


def shown(kind: str) -> str:
    """The keyword of a kind of POU."""
    return {"get": "GET of a property", "set": "SET of a property"}.get(kind, kind.upper())


def _cut_circle(owner: Class, declarations: Declarations, fine: set[Class]) -> None:
    """`fine`: those that were looked at; nothing above them is in a circle with something else."""
    if owner not in owner.walk(fine):
        return
    declarations.report.error("D003", f"`{owner.name}` extends itself.", owner.declaration.span)
    for parent in (owner.base, *owner.interfaces):
        if parent is not None:
            parent.heirs.remove(owner)
    owner.base, owner.interfaces, owner.refused = None, [], True


@dataclass(slots=True)
class _Inherit:
    """Begins the record of a block with the members of its base, and with the number of its class."""

    classes: Classes
    declarations: Declarations

    def __call__(self, record: Record, declaration: tree.PouDeclaration) -> None:
        owner = self.classes.by_key[record.name.upper()]
        owner.record, record.open = record, owner.open
        if not owner.polymorphic:
            return
        record.interfaces = tuple(each for parent in owner.interfaces if (each := self._record(parent)) is not None)
        record.base = self._record(owner.base) if owner.base else None
        if record.base is None:
            record.place(Member(TYPE_NUMBER, UDINT, Section.VAR, declaration.span, hidden=True))
        else:
            record.members = {key: member.copy() for key, member in record.base.members.items()}
            record.size, record.align = record.base.size, record.base.align
        record.members[TYPE_NUMBER.upper()].initial = owner.number.to_bytes(4, "little")

    def _record(self, parent: Class) -> Record | None:
        declaration = parent.declaration  # looked up from its own namespace, in which it may be INTERNAL
        with self.declarations.names.within(Space(declaration.namespace)):
            made = self.declarations.named(declaration.name, declaration.span)
        target = made.target if isinstance(made, Reference) else made
        return target if isinstance(target, Record) else None


def declare_methods(classes: Classes, declarations: Declarations) -> None:
    """Makes the frame of every method; their bodies are checked later."""
    for owner in classes.by_key.values():
        if owner.record is None:
            continue
        for declaration in owner.declaration.methods:
            with declarations.names.within(Space(owner.declaration.namespace, owner.declaration.using)):
                _declare_method(owner, owner.record, declaration, classes, declarations)


def _declare_method(
    owner: Class, record: Record, declaration: tree.PouDeclaration, classes: Classes, declarations: Declarations
) -> None:
    method, report = Method(owner, declaration), declarations.report
    inherited = record.members.get(declaration.name.upper())
    own = {each.declaration.kind for each in owner.methods.values() if _same_name(each.declaration, declaration)}
    if ACTION in declaration.modifiers and Allowance.ACTION_ARGUMENTS in declarations.dialect.allows:
        inherited = None  # a call means the action, and what is no call the variable
    taken = method.key in owner.methods or ("method" in {*own, declaration.kind} and own)
    if taken or inherited is not None:
        report.error("D001", f"`{method.name}` is declared already; rename one.", declaration.span)
        return
    owner.methods[method.key] = method
    if declaration.kind in ("get", "set"):
        classes.properties.add(declaration.name.upper())
    if ACTION in declaration.modifiers:
        classes.actions.add(declaration.name.upper())
    if declaration.kind == "set" and declaration.result is not None:
        given = tree.Variable(declaration.name, declaration.result, None, None, declaration.span)
        section = tree.VariableSection("VAR_INPUT", (), (given,), declaration.span)
        declaration = replace(declaration, sections=(section, *declaration.sections))
    try:
        made = frame(declarations, declaration, Record(method.name, Kind.BLOCK), this=record)
    except Rejected:
        return
    method.pou = called_pou(method.name, declaration, made)


def _same_name(first: tree.PouDeclaration, second: tree.PouDeclaration) -> bool:
    return first.name.upper() == second.name.upper() and first.overload == second.overload


def called_pou(name: str, declaration: tree.PouDeclaration, frame: Record) -> Pou:
    """The POU of a FUNCTION, method or half of a property with this frame."""
    sections = (Section.INPUT, Section.IN_OUT, Section.OUTPUT)
    parameters = tuple(key for key, member in frame.members.items() if member.section in sections)
    result = next((each.type for each in frame.members.values() if each.section is Section.RESULT), None)
    half = f".{declaration.kind}" if declaration.kind in ("get", "set") else ""
    return Pou(f"{name}{half}", "function", Record(name, Kind.BLOCK), frame, parameters, result, declaration.span)
