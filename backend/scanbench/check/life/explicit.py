"""The initial values that a declaration gives to a block: they are assigned when FB_init has run."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from scanbench.program.types import ArrayType, Kind, Member, Record, Reference, Section, Type, has_instance
from scanbench.syntax import tree


@dataclass(frozen=True, slots=True)
class Explicit:
    """A variable inside of what is declared that the declaration gives a value."""

    type: Type
    offset: int
    """From the beginning of what is declared."""
    retain: bool
    node: tree.Initial | None = None
    """The value, where the type is a reference."""


Count = Callable[[tree.Expression], int]
"""How often an item of a list is repeated."""


def explicit(
    initial: tree.Initial | None, type: Type, retain: bool, count_of: Count, offset: int = 0
) -> Iterator[Explicit]:
    """All of them; `retain`: whether the variable is declared as retained."""
    match initial, type:
        case tree.StructInit(members=members), Record(kind=Kind.BLOCK | Kind.STRUCT):
            for name, item, _ in members:
                member = type.members.get(name.upper())
                if member is not None and not _elsewhere(member):
                    said = member.retain or member.non_retain or has_instance(member.type)
                    kept = member.retain if said else retain
                    yield from explicit(item, member.type, kept, count_of, offset + member.offset)
        case tree.ArrayInit(items=items), ArrayType(element=element):
            at = offset
            for count, item in items:
                for _ in range(1 if count is None else count_of(count)):
                    yield from explicit(item, element, retain, count_of, at)
                    at += element.size
        case None, _:
            return
        case _:
            yield Explicit(type, offset, retain, initial if isinstance(type, Reference) else None)


def _elsewhere(member: Member) -> bool:
    return member.located or member.section in (Section.IN_OUT, Section.EXTERNAL) or member.bit is not None
