"""What a declaration gives to the initialisation of its instance: arguments of FB_init, initial values from outside."""

from collections.abc import Iterator
from dataclasses import dataclass, field

from scanbench.problems import Span
from scanbench.program.types import Member, Record, Section
from scanbench.syntax import tree
from scanbench.syntax.pragmas import CALL_AFTER_INIT

FB_INIT, FB_REINIT, FB_EXIT = "FB_INIT", "FB_REINIT", "FB_EXIT"
LIFE_CYCLE = (FB_INIT, FB_REINIT, FB_EXIT)
MADE = "life$made"
"""Hidden variable of a block with such methods: 0 until it is initialised, then the number of its declaration."""

Arguments = tuple[tree.Argument, ...]


@dataclass(frozen=True, slots=True)
class Creation:
    """The declaration of a variable that is, or holds, blocks."""

    span: Span
    arguments: Arguments = ()
    elements: tuple[Arguments, ...] = ()
    """Of an array, the arguments of each element."""
    initial: tree.Initial | None = None


@dataclass(slots=True)
class Creations:
    """Those of a program, by the names of the record and the variable in upper case."""

    found: dict[tuple[str, str], Creation] = field(default_factory=dict)

    def of(self, owner: Record, member: Member) -> Creation:
        """What the declaration of this member says."""
        key = (member.home or owner.name).upper(), member.name.upper()
        return self.found.get(key) or Creation(member.span)

    def note(self, owner: Record, member: Member, variable: tree.Variable) -> None:
        """Keeps what the declaration says."""
        made = Creation(variable.span, variable.arguments, variable.elements, variable.initial)
        self.found[owner.name.upper(), member.name.upper()] = made


def lives(declaration: tree.PouDeclaration) -> bool:
    """Whether methods of this block run by themselves when an instance is initialised or changed."""
    return any(is_called(each) for each in declaration.methods)


def is_called(method: tree.PouDeclaration) -> bool:
    """Whether it runs by itself."""
    return method.name.upper() in (FB_INIT, FB_REINIT) or CALL_AFTER_INIT in method.modifiers


def inputs_of(method: tree.PouDeclaration) -> Iterator[tuple[tree.VariableSection, tree.Variable]]:
    """What a call of FB_init gives to it, in order."""
    for section in method.sections:
        if section.keyword in (Section.INPUT, Section.IN_OUT):
            for variable in section.variables:
                yield section, variable
