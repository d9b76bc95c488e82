"""In-outs by value that are passed on: finds the variable to which a chain of copies leads, for expressions.

A slot refers to what its call passed. If the caller passed its own in-out by value, that is the caller's copy, and the slot of
this copy leads on. `copies.Copies` follows such slots in an image. An expression can follow only the copies that are known when
it is compiled, so they are looked for in the calls of the program, and the expression tests for each whether the slot refers to it.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from scanbench.check.body import fold
from scanbench.program.copies import BYTE_OFFSET, Copy
from scanbench.program.program import Base, Const, Expr, Load, Place, Pou, Program
from scanbench.program.types import BOOL, SLOT_BYTES, ULINT, Kind, Member, Record, Reference, Section, actual_of
from scanbench.symbols.call_sites import Calls

MOST = 16
"""Copies that one slot may refer to; each is a test whenever the expression is evaluated."""


@dataclass(frozen=True, slots=True)
class Passed:
    """A copy that a slot may refer to, and those that its own slot may refer to."""

    copy: Copy
    by: tuple["Passed", ...]


class Unclear(Exception):
    """What a slot refers to cannot be told by an expression."""


def passed_on(program: Program, calls: Calls, at: int | None, record: Record, member: Member) -> tuple[Passed, ...]:
    """The copies that may be passed for an in-out by value of the instance that begins at this byte of the image; None: of
    an instance that is not known before. Raises `Unclear`."""
    found = _Search(program, calls).passed(at, record, member, ())
    if _count(found) > MOST:
        raise Unclear("so many calls pass on an in-out there")
    return found


def through_copies(slot: Place, member: Member, passed: tuple[Passed, ...]) -> Place:
    """The variable to which a slot refers after all copies have been followed."""
    type = Reference(f"REF_TO {member.type.name}", Kind.REF, SLOT_BYTES, member.type)
    return Place(member.type, Base.IMAGE, 0, reference=fold.convert(type, _followed(slot, passed)))


def _followed(slot: Place, passed: tuple[Passed, ...]) -> Expr:
    """Moves a reference from a copy to the original of that copy; its distance from the beginning stays the same."""
    value: Expr = Load(slot)
    for each in passed:
        offset = fold.binary("and", ULINT, Load(slot), Const(ULINT, BYTE_OFFSET))
        inside = fold.binary(
            "and",
            BOOL,
            fold.compare("ge", BOOL, offset, Const(ULINT, each.copy.start)),
            fold.compare("lt", BOOL, offset, Const(ULINT, each.copy.end)),
        )
        outer = _followed(Place(ULINT, Base.IMAGE, each.copy.slot), each.by)
        distance = fold.binary("sub", ULINT, outer, Const(ULINT, each.copy.start))
        value = fold.binary("add", ULINT, value, fold.binary("mul", ULINT, fold.convert(ULINT, inside), distance))
    return value


def _count(passed: tuple[Passed, ...]) -> int:
    return sum(1 + _count(each.by) for each in passed)


@dataclass(frozen=True, slots=True)
class _Search:
    program: Program
    calls: Calls

    def passed(
        self, at: int | None, record: Record, member: Member, above: tuple[tuple[int, str], ...]
    ) -> tuple[Passed, ...]:
        """`above`: instances and in-outs on the way here; blocks may go in a circle."""
        found: dict[int, Passed] = {}
        if at is not None and (at, member.name) in above:
            return ()
        if at is not None:
            above = (*above, (at, member.name))
        slot = (actual_of(record, member) if member.copied else member).offset
        for pou, instance, actual in self.calls.passing(record, slot):
            own, source = _source(pou, actual)
            if source is None:
                continue
            if at is None:
                raise Unclear("its block passes on what it was given, and which instance is meant is not known before")
            for offset in self.calls.callers(pou, instance, at):
                for each in self._from(offset, own, source, above):
                    found[each.copy.start] = each
        return tuple(found.values())

    def _from(self, offset: int, own: Record, source: Member, above: tuple[tuple[int, str], ...]) -> Iterator[Passed]:
        further = self.passed(offset, own, source, above)
        if not source.copied:
            yield from further
            return
        copy = self.program.layout.copies.at(offset + source.offset)
        if copy is not None:
            yield Passed(copy, further)


def _source(pou: Pou, actual: Place) -> tuple[Record, Member | None]:
    """The own in-out of a caller that it passes, or a part of; None where it passes anything else."""
    this = pou.frame.members.get("THIS") if pou.kind == "function" else None
    own = this.type if this is not None else pou.instance
    assert isinstance(own, Record)
    within = _own_offset(actual, this)
    if within is not None:
        members = own.members.values()
        return own, next((each for each in members if each.copied and 0 <= within - each.offset < each.type.size), None)
    slot = None if actual.slot is None else _own_offset(actual.slot, this)
    if slot is None:
        return own, None
    bound = (each for each in own.members.values() if each.section is Section.IN_OUT and each.bound)
    found = next((each for each in bound if each.offset == slot), None)
    return own, found


def _own_offset(place: Place, this: Member | None) -> int | None:
    """Bytes from the beginning of the running instance to `place`; None if `place` is not in this instance."""
    if place.reference is not None:
        return None
    if place.slot is None:
        return place.offset if place.base is Base.SELF else None
    through_this = this is not None and place.slot.base is Base.FRAME and place.slot.offset == this.offset
    return place.offset if through_this else None
