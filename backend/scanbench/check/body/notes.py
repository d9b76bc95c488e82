"""Notes: what a program wrote to a subrange variable, before the check brought it to the bounds.

SUBRANGE_ERROR, and a call with EN or ENO, see the value as it was written. So a variable that is named in one of these anywhere
has a hidden note next to it, to which assignments and calls write the value as well. The note is valid as long as its value,
brought to the bounds, equals the variable; a write by anything else makes it void.
"""

import re
from collections.abc import Iterable, Iterator
from dataclasses import fields, is_dataclass, replace

from scanbench.problems import Span
from scanbench.program.program import Base, Place
from scanbench.program.types import (
    ArrayType,
    Elementary,
    Kind,
    Member,
    Record,
    Section,
    Subrange,
    Type,
    base_of,
    has_instance,
)
from scanbench.syntax import tree
from scanbench.syntax.chunks import Chunk

SUFFIX = "$note"
"""Of the name of a note, after that of its variable."""
LOOKS = re.compile(r"\b(?:SUBRANGE_ERROR|ENO?)\b", re.IGNORECASE)


class Looks:
    """Names of variables that something looks at explicitly, in upper case; found once for each text of a chunk."""

    def __init__(self) -> None:
        self._known: dict[int, tuple[tree.File, frozenset[str]]] = {}

    def at(self, chunks: Iterable[Chunk]) -> frozenset[str]:
        """Those of all these chunks."""
        return frozenset[str]().union(*map(self._of, chunks))

    def _of(self, chunk: Chunk) -> frozenset[str]:
        known = self._known.get(id(chunk))
        if known is None or known[0] is not chunk.file:
            looks = LOOKS.search(chunk.source.text) is not None
            found = frozenset(_looked_at(chunk.file.pous)) if looks else frozenset[str]()
            known = self._known[id(chunk)] = chunk.file, found
        return known[1]


def _looked_at(node: object) -> Iterator[str]:
    match node:
        case tree.Call(tree.Name(name), arguments) if _is_explicit(name.upper(), arguments):
            yield from _names(arguments)
        case tree.Call(_, arguments) if _is_explicit("", arguments):
            yield from _names(arguments)
        case tree.IlInstruction(operator=name, operand=operand, arguments=arguments) if _is_explicit(name, arguments):
            yield from _names((operand, *arguments))
    if isinstance(node, tuple | list):
        for each in node:
            yield from _looked_at(each)
    elif is_dataclass(node) and not isinstance(node, Span | tree.Literal):
        for each in fields(node):
            yield from _looked_at(getattr(node, each.name))


def _is_explicit(name: str, arguments: tuple[tree.Argument, ...]) -> bool:
    return name == "SUBRANGE_ERROR" or any((each.name or "").upper() in ("EN", "ENO") for each in arguments)


def _names(node: object) -> Iterator[str]:
    """The names in paths of variables."""
    match node:
        case tuple():
            for each in node:
                yield from _names(each)
        case tree.Argument(value=value, output=False):
            yield from _names(value)
        case tree.Name(name):
            yield name.upper()
        case tree.MemberOf(owner, name):
            yield name.upper()
            yield from _names(owner)
        case tree.IndexOf(array):
            yield from _names(array)


def make_note(owner: Record, member: Member, initial: bytes) -> None:
    """Places the note next to the variable. That of a function's input comes with the call."""
    scalar = isinstance(member.type, Subrange)
    given = scalar and member.section is Section.INPUT and owner.kind is Kind.STRUCT
    section = Section.INPUT if given else Section.VAR
    type = base_of(member.type) if isinstance(member.type, Subrange) else member.type
    member.note = Member(f"{member.name}{SUFFIX}", type, section, member.span, initial=initial, hidden=True)
    owner.place(member.note)


def may_have_note(member: Member) -> bool:
    """Whether there is anything in it that a check limits."""
    return member.section is not Section.MEMBER and not member.constant and not member.hidden and _limited(member.type)


def _limited(type: Type) -> bool:
    if isinstance(type, ArrayType):
        return _limited(type.element)
    if isinstance(type, Record):
        inner = type.members.values()
        plain = type.kind is Kind.STRUCT and not type.overlaps and not has_instance(type)
        return plain and any(_limited(each.type) for each in inner)
    return isinstance(type, Subrange)


def note_of(place: Place, member: Member | None, base: Base | None) -> Place | None:
    """The note for a variable that lives at `place` or around it. `base`: what a located one's own memory counts from."""
    note = None if member is None else member.note
    if note is None or member is None:
        return None
    type = base_of(place.type) if isinstance(place.type, Elementary) else place.type
    if member.located:
        if base is None:
            return None
        offset = note.offset + place.offset - member.offset
        return Place(type, base, offset, indices=place.indices, variable=f"{note.home}.{note.name}".upper())
    if member.bound:
        slot = place.slot
        if slot is None:
            return None
        offset, indices = slot.offset + note.offset - member.offset + place.offset, (*slot.indices, *place.indices)
        return replace(slot, type=type, offset=offset, indices=indices, variable=_beside(slot))
    return replace(place, type=type, offset=place.offset + note.offset - member.offset, variable=_beside(place))


def _beside(place: Place) -> str:
    return f"{place.variable}$NOTE" if place.variable else ""
