"""The types and blocks of a program by name, made when they are first asked for, and what is known of its variables."""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from typing import TypeAlias

from scanbench.check.context import Rejected, Report
from scanbench.check.declare.creations import Creations
from scanbench.check.declare.enumeration_values import EnumerationValues
from scanbench.check.declare.later import Later
from scanbench.check.declare.names import Names, Space, qualified, written
from scanbench.check.declare.vendor_types import instead_of, vendor_type
from scanbench.check.dialect import Dialect
from scanbench.check.dialect_table import IEC
from scanbench.check.libraries.catalogue import where_declared
from scanbench.check.uses import Symbol
from scanbench.check.vendor_sizes import short_type
from scanbench.plcmodel.model import Model
from scanbench.problems import Span
from scanbench.program.program import Const, Expr
from scanbench.program.types import (
    ABBREVIATIONS,
    ELEMENTARY,
    NULL,
    Kind,
    Member,
    Record,
    Reference,
    Type,
)
from scanbench.syntax import tree

TYPE_NAMES = {**ELEMENTARY, **{name: ABBREVIATIONS[name] for name in ("TOD", "LTOD", "DT", "LDT")}}

MAX_TYPES = 1500
"""Types that contain each other, or blocks that extend each other, of which none is made yet."""

ConstantOf = Callable[[tree.Expression, Type | None], Const]
"""Evaluates a constant expression, or rejects."""
ReferenceOf = Callable[[Record, tree.Expression, Reference], Expr]
"""The reference that an expression gives among the variables of an owner, or rejects."""
Inherit = Callable[[Record, tree.PouDeclaration], None]
"""Gives the record of a block what it has from its base, before its own members."""
TypeOf: TypeAlias = "Callable[[Declarations, tree.TypeSpec], Type]"
MakeType: TypeAlias = "Callable[[Declarations, tree.TypeDeclaration | tree.PouDeclaration], Type]"


@dataclass(frozen=True, slots=True)
class StartReference:
    """A reference within a variable that a declaration gives a start value."""

    offset: int
    """In bytes, from the beginning of the variable."""
    type: Reference
    node: tree.Expression
    name: str = ""
    """Of the member that it is; empty for the variable itself."""


@dataclass(frozen=True, slots=True)
class Afresh:
    """What a start value writes as a whole: the references in it begin with NULL, or with what this type itself gives them."""

    offset: int
    """In bytes, from the beginning of the variable."""
    type: Type


@dataclass(frozen=True, slots=True)
class StartExpression:
    """What a variable, or a part of it, starts with that has to be computed."""

    offset: int
    """In bytes, from the beginning of the variable."""
    type: Type
    node: tree.Expression
    property: str = ""
    """What it is given to, where that is no variable: `name` or `member.name`, a property of the block in the variable."""


Given: TypeAlias = "StartReference | Afresh | StartExpression"


@dataclass(frozen=True, slots=True)
class Start:
    """One of both, and the variable of which record it is in."""

    owner: Record
    member: Member
    given: StartReference | Afresh


@dataclass(slots=True)
class Declarations:
    """All types, blocks and located memory of a program; types are made when first asked for."""

    report: Report
    model: Model
    areas: dict[str, int]
    """Offset of each area in the image."""
    constant_of: ConstantOf
    _made: MakeType
    """Makes a type or block of the user."""
    _type_of: TypeOf
    type_trees: dict[str, tree.TypeDeclaration] = field(default_factory=dict)
    block_trees: dict[str, tree.PouDeclaration] = field(default_factory=dict)
    """PROGRAM, FUNCTION_BLOCK, CLASS and INTERFACE declarations by upper-case name."""
    inherit: Inherit = field(default=lambda record, declaration: None)
    types: dict[str, Type] = field(default_factory=dict)
    defaults: dict[str, bytes] = field(default_factory=dict)
    """Start values of directly derived types that state one."""
    located: list[tuple[int, int, bytes]] = field(default_factory=list)
    """Start values of located variables in order of declaration: offset in the image, mask of each byte, bytes."""
    broken: set[tuple[str, str]] = field(default_factory=set)
    """(owner, name) in upper case of variables whose declaration is wrong: reported once, not at every use."""
    owners: list[Record] = field(default_factory=list)
    """The records under declaration: their bounds and initial values can use their constants."""
    looked_at: frozenset[str] = frozenset()
    """Names of variables that have a note, in upper case; see `notes`."""
    dialect: Dialect = IEC
    """What the programs may do beyond the standard."""
    policed: set[str] = field(default_factory=set)
    """Names of variables and types for which the project's word on subranges was asked, in upper case."""
    incomplete: bool = False
    """Whether any variable waits for its address."""
    start_references: list[Start] = field(default_factory=list)
    """References that start with REF(variable), and what starts without them, in the order in which they apply."""
    computed: dict[tuple[str, str], list[StartExpression]] = field(default_factory=dict)
    """By the names of the record and the variable, in upper case."""
    in_body: bool = False
    """Whether the values that are read are among the statements, so that all but literals are computed there."""
    given: list[Given] = field(default_factory=list)
    """What is apart from the bytes in the initial value that is being read, counted from its beginning."""
    reference_of: ReferenceOf = field(default=lambda owner, node, type: Const(NULL, 0))
    symbols: Record = field(default_factory=lambda: Record("", Kind.STRUCT))
    """Variables that the model gives to every program."""
    creations: Creations = field(default_factory=Creations)
    """What declarations give to the initialisation of blocks, where the dialect has that."""
    names: Names = field(init=False)
    values: EnumerationValues = field(init=False)
    later: Later = field(init=False)
    shells: dict[str, Record] = field(default_factory=dict)
    """Structures and blocks that were asked for, complete or not: a reference may refer to what is still open."""
    _pending: list[str] = field(default_factory=list)
    """Keys of shells that wait to be completed."""
    _open: list[str] = field(default_factory=list)
    _deep: set[str] = field(default_factory=set)
    """Keys of those that were nested too deep."""

    def __post_init__(self) -> None:
        self.names = Names(self.report)
        self.later = Later(self.report, self.names, self.owners)
        self.values = EnumerationValues(self.type_trees, self._value_type)

    def _value_type(self, key: str) -> Type:
        return self.types.get(key) or self.named(key, self.type_trees[key].span)

    def type_of(self, spec: tree.TypeSpec) -> Type:
        """The type that a specification says."""
        return self._type_of(self, spec)

    def named(self, name: str, span: Span) -> Type:
        """The type, or the variables of the block, of this name; made where it is not yet."""
        key = name.upper()
        if key in TYPE_NAMES:
            return short_type(self.dialect, TYPE_NAMES[key])
        found = self.find_type(name, span)
        vendor = None if found is not None else vendor_type(self.report, self.dialect, name, span)
        if vendor is not None:
            return vendor
        key = found or key
        self._note(name, key, span)
        if key in self.types:
            return self.types[key]
        if key in self._open:
            path = " -> ".join([*self._open[self._open.index(key) :], key])
            raise self.report.reject("D003", f"`{name}` contains itself ({path}), so it has no size.", span)
        declaration, block = self.type_trees.get(key), self.block_trees.get(key)
        if declaration is None and block is None:
            hint = self.library_hint(name) or self.report.near(name, self._declared, "declared")
            hint = instead_of(self.dialect, name) or hint
            raise self.report.reject("D002", f"There is no type `{name}`.{hint}", span)
        origin = declaration or block
        assert origin is not None
        if key in self._deep:
            raise Rejected
        if len(self._open) >= MAX_TYPES:
            told = bool(self._deep)
            self._deep.update(self._open)
            if told:
                raise Rejected
            raise self.report.reject(
                "S003", f"`{name}` is nested more than {MAX_TYPES} types deep; split this up.", span
            )
        self._open.append(key)
        try:
            # what it names is looked up where it is declared, not from the variable that needs it
            with self.later.under(()), self.names.within(Space(origin.namespace, origin.using)):
                made = self._made(self, origin)
        finally:
            self._open.pop()
        self.types[key] = made
        self._complete()
        return made

    def _declared(self) -> list[str]:
        """The full names of all types and blocks, with the capitals that they are declared with."""
        types = [qualified(each.namespace, each.name) for each in self.type_trees.values()]
        return [*TYPE_NAMES, *types, *(qualified(each.namespace, each.name) for each in self.block_trees.values())]

    def _note(self, name: str, key: str, span: Span) -> None:
        origin = self.type_trees.get(key) or self.block_trees.get(key)
        if origin is not None and origin.span is not span:  # where it is declared it is not used
            self.report.use(span, written(name), Symbol("type" if key in self.type_trees else "pou", "", written(key)))

    def _complete(self) -> None:
        """Makes what references referred to while it could not be made."""
        while self._pending and not self._open:
            key = self._pending.pop()
            origin = self.type_trees.get(key) or self.block_trees.get(key)
            if origin is not None and key not in self.types:
                with suppress(Rejected):
                    self.named(key, origin.span)

    def declare_types(self) -> None:
        """Makes the types that nothing used, for what is wrong in them."""
        for key, declaration in self.type_trees.items():
            if key not in self.types:
                with suppress(Rejected):
                    self.named(key, declaration.span)

    def referred(self, spec: tree.TypeSpec) -> Type:
        """A type that something refers to: while types are open, one that need not be complete."""
        if not isinstance(spec, tree.NamedType) or not self._open:
            return self.type_of(spec)
        key = self.find_type(spec.name, spec.span) or spec.name.upper()
        self._note(spec.name, key, spec.span)
        declaration, block = self.type_trees.get(key), self.block_trees.get(key)
        if key in self.types or (block is not None and block.kind == "interface"):
            return self.named(spec.name, spec.span)
        if declaration is not None and isinstance(declaration.type, tree.StructSpec):
            kind, name = Kind.UNION if declaration.type.union else Kind.STRUCT, declaration.name
        elif block is not None:
            kind, name = Kind.BLOCK, block.name
        else:
            return self.named(spec.name, spec.span)
        self._pending.append(key)
        origin = declaration or block
        assert origin is not None
        return self.shells.get(key) or self.record(qualified(origin.namespace, name), kind)

    def record(self, name: str, kind: Kind) -> Record:
        """The record of this name, which may be known to references before its members are."""
        made = self.shells.get(name.upper())
        if made is None or made.members or name.startswith("STRUCT of "):
            made = self.shells[name.upper()] = Record(name, kind)
        return made

    def library_hint(self, name: str) -> str:
        """` It is in the library ...`, or nothing: of a name that is not known."""
        library = where_declared(self.names.plain(name), self.dialect.name)
        return "" if library is None else f" It is in the library {library}, which is not in this project: add it."

    def find_type(self, name: str, span: Span) -> str | None:
        """The key of the type or block that this name means here."""
        return self.names.find(name, span, self.type_trees, self.block_trees)
