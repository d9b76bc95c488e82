"""Corrupted results: what statements wrote in one scan, and which bit of it turns over."""

from collections.abc import Sequence
from dataclasses import dataclass, field

from scanbench.faults.disturb.definition import chance
from scanbench.faults.disturb.disturb import Disturbed
from scanbench.faults.disturb.fire import Corrupt
from scanbench.program.program import Program
from scanbench.program.types import BOOL, ArrayType, Elementary, Record, StringType, Type
from scanbench.runtime.command import Command
from scanbench.symbols.names import names_of
from scanbench.symbols.symbols import UnknownPath, resolve

_WHOLE = 0xFF


@dataclass(slots=True)
class Wish:
    """A disturbance that is to come about in the scan that runs."""

    of: Disturbed
    sites: frozenset[int]
    """The statements."""
    written: list[tuple[int, int, int]] = field(default_factory=list)
    """Offset, size, bits: by the first of them that wrote anything, up to the next statement."""
    done: bool = False
    why: str = "the statement did not run"
    """Why it did not come about, where it did not."""


class Results:
    """An `Insider`: enters the corrupted results of one scan."""

    def __init__(self, program: Program, wishes: Sequence[Wish]) -> None:
        self._program, self.wishes = program, wishes

    def wrote(self, site: int, offset: int, size: int, bits: int) -> bool:
        """See `Insider`."""
        found = False
        for wish in self.wishes:
            if site in wish.sites and not wish.done:
                wish.written.append((offset, size, bits))
            found = found or (bool(wish.written) and not wish.done)
        return found

    def due(self) -> tuple[Command, ...]:
        """See `Insider`."""
        made = [self._corrupt(wish) for wish in self.wishes if wish.written and not wish.done]
        return tuple(each for each in made if each is not None)

    @property
    def over(self) -> bool:
        """See `Insider`."""
        return all(wish.done for wish in self.wishes)

    def _corrupt(self, wish: Wish) -> Corrupt | None:
        """Of the first value, unless chance says which; what the compiler keeps for itself is no result."""
        of, wanted = wish.of, wish.of.wanted
        drawn, written = chance(wanted, of.number, of.time, "bit"), wish.written
        begin = 0 if wanted.bit is not None else drawn % len(written)
        for each in (*written[begin:], *written[:begin]):
            spot = self._spot(each, wanted.bit, drawn // len(written))
            if spot is not None:
                wish.done = True
                at, bit, name = spot
                index = 8 * (at - each[0]) + bit if each[2] == _WHOLE else 0
                return Corrupt(of.by, of.number, of.time + 1, of.fired + 1, wanted.site, at, bit, index, name)
            if wanted.bit is not None and _value_at(self._program, each[0]) is not None:
                wish.done, wish.why = True, f"what it wrote has no bit {wanted.bit}"
                return None
        written.clear()  # what it writes next, perhaps
        return None

    def _spot(self, written: tuple[int, int, int], wanted: int | None, drawn: int) -> tuple[int, int, str] | None:
        """Byte and bit that turn over, and what that is called; no gap between the members of a structure."""
        offset, size, bits = written
        if bits != _WHOLE:
            name, _ = _value_at(self._program, offset) or ("", 0)
            return (offset, bits.bit_length() - 1, name) if name and not wanted else None
        if wanted is not None and wanted >= 8 * size:
            return None
        for step in range(size if wanted is None else 1):
            at = offset + (wanted // 8 if wanted is not None else (drawn + step) % size)
            name, mask = _value_at(self._program, at) or ("", 0)
            choice = [bit for bit in range(8) if mask >> bit & 1 and (wanted is None or bit == wanted % 8)]
            if choice:
                return at, choice[drawn // size % len(choice)], name
        return None


def _value_at(program: Program, offset: int) -> tuple[str, int] | None:
    """The value that a byte is a part of, for people, and which of its bits mean anything. None for what is no value: a gap,
    what an in-out or reference refers to, what the compiler keeps."""
    found = _temporary(program, offset) if offset >= program.layout.frames else _variable(program, offset)
    if found is None or not isinstance(found[1], Elementary | StringType):
        return None
    return found[0], 1 if found[1] == BOOL else 0xFF


def _variable(program: Program, offset: int) -> tuple[str, Type] | None:
    path = names_of(program).path(offset)
    try:
        symbol = resolve(program, path)
    except UnknownPath:
        return None
    return None if symbol.slots else (path, symbol.type)


def _temporary(program: Program, offset: int) -> tuple[str, Type] | None:
    found = names_of(program).temporary(offset)
    if found is None or not found[1]:
        return None
    pou, name = found
    member = pou.frame.members[name.upper()]
    type = None if member.bound else _part(member.type, offset - pou.frame_offset - member.offset)
    return None if type is None else (f"{pou.name}.{name}", type)


def _part(type: Type, offset: int) -> Type | None:
    """The type of the part at a byte offset from the beginning of a value."""
    if isinstance(type, ArrayType):
        return _part(type.element, offset % type.element.size)
    if not isinstance(type, Record):
        return type
    for member in type.members.values():
        if member.offset <= offset < member.offset + member.storage:
            return None if member.bound or member.hidden else _part(member.type, offset - member.offset)
    return None
