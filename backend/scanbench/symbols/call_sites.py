"""Who passes what to an in-out: the calls of a block instance in the statements of a program.

The image tells which of the calls ran last (`program/copies.py`); what the other calls would pass is computed from the values that
are in the image now. A call that reaches its instance through a reference counts if the reference refers to it at the moment.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from scanbench.problems import Span
from scanbench.program.bodies import bodies, every
from scanbench.program.copies import BIT_SHIFT, Image, referred
from scanbench.program.program import (
    Base,
    Binary,
    CallBlock,
    Const,
    Convert,
    Expr,
    Halt,
    If,
    Index,
    Jump,
    Limit,
    Load,
    Place,
    Pou,
    Program,
    Return,
    Stmt,
)
from scanbench.program.types import Elementary, Kind, Member, Record, Section, actual_of, is_derived
from scanbench.symbols.instances import instances_of
from scanbench.symbols.names import names_of
from scanbench.symbols.symbols import PART, Symbol, UnknownPath, resolve

WHOLE = (Kind.INT, Kind.UINT, Kind.BITS)


@dataclass(frozen=True, slots=True)
class Formal:
    """The last in-out on a path."""

    path: str
    """`Main.fb1.zone` of `Main.fb1.zone.parts`."""
    rest: str
    """What the path says after it: `.parts`."""
    instance: Symbol
    member: Member

    @property
    def slot(self) -> int:
        """Where in the instance the slot is that refers to what was passed."""
        record = self.instance.type
        assert isinstance(record, Record)
        return (actual_of(record, self.member) if self.member.copied else self.member).offset


@dataclass(frozen=True, slots=True)
class CallSite:
    """One call of the instance."""

    span: Span
    caller: Pou
    call: CallBlock
    path: str
    """Of the calling instance; empty in a FUNCTION."""
    offset: int
    """Where that begins."""

    def passes(self, formal: Formal) -> Place | None:
        """What it passes for an in-out, as the caller sees it; None where it leaves that as it is, as SUPER can."""
        actual = next((each for slot, each in self.call.in_outs if slot.offset == formal.slot), None)
        same = (
            self.call.instance.base is Base.SELF and self.call.instance.slot is None and self.call.instance.offset == 0
        )
        return None if actual is None or (same and _is_itself(actual, formal.slot)) else actual


def formal_of(program: Program, path: str) -> Formal | None:
    """The in-out that a path leads through; None where it leads through none. Raises `UnknownPath`."""
    whole = resolve(program, path).path
    found, before, at = None, "", 0
    while (part := PART.match(whole, at)) is not None and part.end() > at:
        at = part.end()
        try:
            symbol = resolve(program, whole[:at])
        except UnknownPath:  # the name of a resource, or half of an address
            continue
        if symbol.section == Section.IN_OUT and part.group(1):
            instance = resolve(program, before)
            record = instance.type
            if isinstance(record, Record) and symbol.name.upper() in record.members:
                found = Formal(symbol.path, whole[at:], instance, record.members[symbol.name.upper()])
        before = whole[:at]
    return found


class Calls:
    """The calls of blocks in the statements of one program; made once for many questions."""

    def __init__(self, program: Program) -> None:
        self._program = program
        self._by_block: dict[str, list[tuple[Pou, CallBlock]]] = {}
        for pou in program.pous:
            for call in _calls(pou.body):
                self._by_block.setdefault(call.pou.instance.name, []).append((pou, call))

    def sites(self, formal: Formal, memory: Image) -> list[CallSite]:
        """Those that pass something to this in-out, in the order of the text."""
        return [each for each in self.of(formal.instance, memory) if each.passes(formal) is not None]

    def of(self, instance: Symbol, memory: Image) -> list[CallSite]:
        """All calls of an instance, in the order of the text."""
        located, record = instance.locate(memory), instance.type
        if located is None or not isinstance(record, Record):
            return []
        found = [
            CallSite(call.span.plain(), pou, call, path, offset)
            for pou, call in self._of(record)
            for path, offset in self._callers(pou, call.instance, located[0], memory)
        ]
        return sorted(found, key=lambda each: (each.span.file, each.span.line, each.span.column))

    def passing(self, record: Record, slot: int) -> Iterator[tuple[Pou, Place, Place]]:
        """All calls of a block that bind this slot: caller, instance and what is passed, as the caller sees them."""
        for pou, call in self._of(record):
            yield from ((pou, call.instance, actual) for formal, actual in call.in_outs if formal.offset == slot)

    def callers(self, pou: Pou, instance: Place, at: int) -> list[int]:
        """Where the instances of `pou` begin for which `instance` may be what lives at a byte of the image, at some time."""
        return [offset for _, offset in self._callers(pou, instance, at, None)]

    def _of(self, record: Record) -> Iterator[tuple[Pou, CallBlock]]:
        known: Record | None = record
        while known is not None:
            yield from self._by_block.get(known.name, ())
            known = known.base

    def _callers(self, pou: Pou, instance: Place, at: int, memory: Image | None) -> Iterator[tuple[str, int]]:
        """The instances of `pou` for which `instance` is what lives at a byte of the image: path, and where they begin.
        Without an image: for which it may be."""
        this = pou.frame.members.get("THIS") if pou.kind == "function" else None
        own = this.type if this is not None else pou.instance
        through_this = this is not None and instance.slot is not None and instance.slot.offset == this.offset
        if instance.reference is None and (through_this or (instance.base is Base.SELF and instance.slot is None)):
            for around in names_of(self._program).holding(at):
                if isinstance(around.type, Record) and isinstance(own, Record) and is_derived(around.type, own):
                    if _reaches(instance, at - around.offset - instance.offset):
                        yield around.name, around.offset
            return
        if instance.reference is None and instance.slot is None and not _reaches(instance, at - instance.offset):
            return
        if pou.kind == "function" and this is None:
            callers = [("", 0)]
        else:
            name = own.name if isinstance(own, Record) else pou.name
            callers = [(each.path, each.offset) for each in instances_of(self._program, name)]
        through = instance.reference is not None or instance.slot is not None
        for path, offset in callers:
            found = address(pou, instance, offset, memory) if through and memory is not None else (at, 0)
            if found is not None and found[0] == at:
                yield path, offset


def address(pou: Pou, place: Place, instance: int, memory: Image) -> tuple[int, int] | None:
    """Byte offset and bit of a place of a body, by the values in the image; None if these lead to no place."""
    bit = place.bit or 0
    if place.reference is not None or place.slot is not None:
        slot = _value(
            pou, place.reference if place.reference is not None else Load(place.slot or place), instance, memory
        )
        target = None if slot is None else referred(slot)
        if target is None:
            return None
        offset, bit = target[0], target[1] if place.bit is None else bit
    else:
        offset = {Base.IMAGE: 0, Base.SELF: instance, Base.FRAME: pou.frame_offset}[place.base]
    offset += place.offset
    for index in place.indices:
        by = _distance(pou, index, instance, memory)
        if by is None:
            return None
        offset += by
    return offset, bit


def _distance(pou: Pou, index: Index, instance: int, memory: Image) -> int | None:
    numbers = [
        each if isinstance(each, int) else _value(pou, each, instance, memory)
        for each in (index.value, index.low, index.high, index.stride)
    ]
    value, low, high, stride = numbers
    if value is None or low is None or high is None or stride is None or not low <= value <= high:
        return None
    return (value - low) * stride


def _value(pou: Pou, expr: Expr, instance: int, memory: Image) -> int | None:
    """A whole number; None where finding it would mean to run something, or it is none."""
    match expr:
        case Const(value=int(value)):
            return value
        case Load(place) if isinstance(place.type, Elementary) and place.type.kind in (*WHOLE, Kind.REF):
            found = address(pou, place, instance, memory)
            if found is None or place.bit is not None or found[0] + place.type.size > len(memory):
                return None
            return int.from_bytes(memory[found[0] : found[0] + place.type.size], "little", signed=place.type.signed)
        case Convert(type, operand) if isinstance(type, Elementary) and type.kind in (*WHOLE, Kind.REF):
            return _wrapped(type, _value(pou, operand, instance, memory))
        case Limit(_, operand, low, high):
            inner = _value(pou, operand, instance, memory)
            return None if inner is None else min(max(inner, low), high)
        case Binary(op, type, left, right) if type.kind in WHOLE:
            one, other = _value(pou, left, instance, memory), _value(pou, right, instance, memory)
            return None if one is None or other is None else _wrapped(type, _computed(op, one, other))
    return None


def _computed(op: str, one: int, other: int) -> int | None:
    match op:
        case "add":
            return one + other
        case "sub":
            return one - other
        case "mul":
            return one * other
        case "mod" if other:
            return abs(one) % abs(other) * (-1 if one < 0 else 1)
        case "div" if other:
            return abs(one) // abs(other) * (-1 if (one < 0) != (other < 0) else 1)
    return None


def _wrapped(type: Elementary, value: int | None) -> int | None:
    if value is None:
        return None
    value &= (1 << 8 * type.size) - 1
    return value - (1 << 8 * type.size) if type.signed and value >> (8 * type.size - 1) else value


# ---- statements -----------------------------------------------------------------------------------------------------


def _calls(statements: Iterable[Stmt]) -> Iterator[CallBlock]:
    return (each for each in every(statements) if isinstance(each, CallBlock))


def in_every_run(pou: Pou, call: CallBlock) -> bool:
    """Whether the body of `pou` never ends without this call of this instance: it is in no branch or loop, nothing
    leaves before, and neither an index nor a reference picks the instance again each time."""
    if not _is_one(call.instance):
        return False
    for stmt in pou.body:
        if stmt is call or (_is_always(stmt) and any(each is call for each in bodies(stmt)[0])):
            return True
        if _leaves(stmt):
            return False
    return False


def _is_one(place: Place) -> bool:
    return not place.indices and place.reference is None and (place.slot is None or _is_one(place.slot))


def _is_always(stmt: Stmt) -> bool:
    """Several statements as one; see `arguments.together`."""
    return isinstance(stmt, If) and stmt.branches[0][0] == Const(stmt.branches[0][0].type, 1)  # type: ignore[arg-type]


def _leaves(stmt: Stmt) -> bool:
    return isinstance(stmt, Return | Jump | Halt) or any(_leaves(each) for body in bodies(stmt) for each in body)


# ---- instances ------------------------------------------------------------------------------------------------------


def _reaches(place: Place, distance: int) -> bool:
    """Whether the indices of a place can lead this far from its first element."""
    for index in place.indices:
        low, high, stride = index.low, index.high, index.stride
        if not (isinstance(low, int) and isinstance(high, int) and isinstance(stride, int)):
            return True
        steps = min(distance // stride, high - low) if stride else 0
        if steps < 0:
            return False
        distance -= steps * stride
    return distance == 0


def can_reach(place: Place, pou: Pou, instance: int, offset: int) -> bool:
    """Whether a place of a body may be what begins at a byte of the image, whatever its indices are."""
    if place.slot is not None or place.reference is not None:
        return True
    begin = {Base.IMAGE: 0, Base.SELF: instance, Base.FRAME: pou.frame_offset}[place.base]
    return _reaches(place, offset - begin - place.offset)


def _is_itself(actual: Place, slot: int) -> bool:
    """SUPER gets the in-out as it is: what was passed there, was passed to the call that runs."""
    return (
        actual.slot is not None and actual.slot.base is Base.SELF and actual.slot.offset == slot
        and actual.offset == 0 and not actual.indices
    )  # fmt: skip


def slot_value(formal: Formal, memory: Image) -> int | None:
    """What the slot of the in-out holds: the reference that the last call passed."""
    located = formal.instance.locate(memory)
    if located is None:
        return None
    at = located[0] + formal.slot
    return int.from_bytes(memory[at : at + 8], "little")


def as_reference(offset: int, bit: int) -> int:
    """The value of a slot that refers to this."""
    return offset | bit << BIT_SHIFT
