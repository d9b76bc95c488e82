"""What is known of a value by its use: the types that it is given to and taken from, and what is asked of its parts."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

from scanbench.program.types import ELEMENTARY, Kind
from scanbench.syntax import tree

ORDER = "BOOL BYTE USINT SINT WORD UINT INT DWORD UDINT DINT LWORD ULINT LINT REAL LREAL".split()
"""Later ones hold more: the last of those that a value is given to and taken from is its type."""
BY_LITERAL = {"int": "DINT", "real": "LREAL", "bool": "BOOL", "string": "STRING[255]", "time": "TIME"}
"""The type of what is only ever used with literals; those of a later kind count more, but for a string."""
BY_NAME = (
    ("[bx]", "BOOL"),
    ("s", "STRING[255]"),
    ("(?:f|r|lr)", "LREAL"),
    ("(?:n|i|di|ui|udi)", "DINT"),
    ("t", "TIME"),
)
"""Beginnings of names that say a type by the custom of these programs: what counts where use says nothing else."""


@dataclass(eq=False, slots=True)
class Shape:
    """Of one value. Those that are found to be alike become one, `root`."""

    specs: list[tree.TypeSpec] = field(default_factory=list)
    """Types that are written in the project, or in a library."""
    literals: set[str] = field(default_factory=set)
    names: set[str] = field(default_factory=set)
    """What it is called."""
    members: dict[str, "Member"] = field(default_factory=dict)
    """Parts that are asked for, by name in upper case."""
    element: "Shape | None" = None
    dimensions: int = 0
    top: int = 99
    """Of an array: the highest index that is written, and that of one whose indices nobody writes."""
    calls: "Signature | None" = None
    """How it is called as a function, or as an instance."""
    alike: "Shape | None" = None
    fixed: bool = False
    """Its type is written where it is declared."""

    @property
    def root(self) -> "Shape":
        """The one that all that are alike share."""
        found = self
        while found.alike is not None:
            found = found.alike
        return found

    @property
    def known(self) -> tree.TypeSpec | None:
        """The type; None where nothing is known but literals. Of several numbers the one that holds the most."""
        specs = self.root.specs
        ranked = [(ORDER.index(named), each) for each in specs if (named := elementary(each)) in ORDER]
        if ranked and len(ranked) == len(specs):
            return max(ranked, key=lambda each: each[0])[1]
        return specs[0] if specs else None

    @property
    def literal(self) -> str | None:
        """The type that the literals need which it is used with; of what is used with none, that which its name begins with."""
        found = self.root.literals
        if found <= {"int"}:  # or nothing
            letters = [name.rpartition("_")[2] for name in sorted(self.root.names)]
            called = next(
                (type for each in letters for begin, type in BY_NAME if re.match(f"{begin}[A-Z]", each)), None
            )
            if called is not None and (not found or called == "LREAL"):
                return called
        return next((BY_LITERAL[each] for each in ("string", "time", "real", "int", "bool") if each in found), None)


@dataclass(eq=False, slots=True)
class Member:
    """A part of a structure or block, or an input of something that is called."""

    name: str
    """As it was first written."""
    shape: Shape
    written: bool = False
    """It is an input, or written from outside."""
    output: bool = False
    """It is taken by `=>`."""
    open: bool = False
    """Others than its block may write it, or a part of it: an heir, or what it is given to as VAR_IN_OUT."""

    def __post_init__(self) -> None:
        self.shape.names.add(self.name)


@dataclass(eq=False, slots=True)
class Signature:
    """Of a function, a method, or the call of an instance."""

    inputs: dict[str, Member] = field(default_factory=dict)
    outputs: dict[str, Member] = field(default_factory=dict)
    result: Shape = field(default_factory=Shape)
    read: bool = False
    """Somebody uses the result."""
    declared: tree.PouDeclaration | None = None
    """A method of the project that has to be like it."""


@dataclass(eq=False, slots=True)
class Unknown:
    """A type without a declaration."""

    name: str
    shape: Shape = field(default_factory=Shape)
    """What values of it are used for, if it is no more than a name of a type that is known."""
    members: dict[str, Member] = field(default_factory=dict)
    methods: dict[str, tuple[str, Signature]] = field(default_factory=dict)
    """Each with its name as it was first written."""
    values: dict[str, str] = field(default_factory=dict)
    """Of an enumeration."""
    block: bool = False
    interface: bool = False
    arguments: dict[str, Member] = field(default_factory=dict)
    """Of FB_init."""
    gives: set[str] = field(default_factory=set)
    """Types, in upper case, that values of it are assigned to."""

    def member(self, name: str) -> Member:
        """The part of this name."""
        return self.members.setdefault(name.upper(), Member(name, Shape()))

    def method(self, name: str) -> Signature:
        """The method of this name."""
        return self.methods.setdefault(name.upper(), (name, Signature()))[1]


def elementary(spec: tree.TypeSpec | None) -> str:
    """The name of an elementary type in upper case, else nothing."""
    name = spec.name.upper() if isinstance(spec, tree.NamedType) else ""
    return name if name in ELEMENTARY and ELEMENTARY[name].kind is not Kind.STRING else ""


def named(name: str, at: tree.Expression | tree.Variable | tree.PouDeclaration) -> tree.NamedType:
    """The type of this name."""
    return tree.NamedType(name, at.span)


def of_type(spec: tree.TypeSpec | None) -> Shape:
    """A value of this type; of nothing known without one."""
    return Shape() if spec is None else Shape([spec], fixed=True)


def join(left: Shape, right: Shape) -> None:
    """Finds that a value goes from one to the other. What is known of one holds for the other, where that is not known."""
    left, right = left.root, right.root
    if left is right:
        return
    if left.fixed or right.fixed:
        open_, given = (right, left) if left.fixed else (left, right)
        known = given.known
        if known is not None and not open_.fixed:
            open_.specs.append(known)
        return
    right.alike = left
    left.specs += right.specs
    left.literals |= right.literals
    left.names |= right.names
    left.element = left.element or right.element
    left.top = max(left.top, right.top)
    left.dimensions = left.dimensions or right.dimensions
    left.calls = left.calls or right.calls
    for key, member in right.members.items():
        if key in left.members:
            join(left.members[key].shape, member.shape)
        else:
            left.members[key] = member


def variables(pou: tree.PouDeclaration) -> Iterator[tuple[tree.VariableSection, tree.Variable]]:
    """All of a POU, with their sections."""
    for section in pou.sections:
        for variable in section.variables:
            yield section, variable
