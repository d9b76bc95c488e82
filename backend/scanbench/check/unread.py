"""What the statements of a program read, by bytes: what nothing reads has no effect on anything, whatever is stored there.

Reads are known relative to what they count from: the image, the block that runs (by its type), or what an in-out or a
reference refers to (by its type, as of which instance nobody knows). Who reads through a computed index may read every element.
"""

from bisect import bisect_right
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, fields, is_dataclass, replace

from scanbench.check.program import (
    Assign,
    Base,
    CallBlock,
    CallFunction,
    Const,
    Expr,
    For,
    Index,
    Load,
    Place,
    Pou,
    Program,
    RefOf,
    SetBytes,
)
from scanbench.check.standard.library import in_library
from scanbench.check.symbols import resolve
from scanbench.check.types import ArrayType, OpenArray, Record, Reference, Section, Type, has_instance

Owner = tuple[Record, int]
"""A block or structure, and where in the image it begins."""


@dataclass(slots=True)
class Ranges:
    """Bytes from and to."""

    _known: list[tuple[int, int]]
    _merged: bool = True

    def add(self, begin: int, end: int) -> None:
        """These too."""
        self._known.append((begin, end))
        self._merged = False

    def overlap(self, begin: int, end: int) -> bool:
        """Whether any of these bytes is among them."""
        if not self._merged:
            self._merge()
        index = bisect_right(self._known, (begin, end)) - 1
        return any(first < end and begin < last for first, last in self._known[max(0, index) : index + 2])

    def _merge(self) -> None:
        merged: list[tuple[int, int]] = []
        for first, last in sorted(self._known):
            if merged and first <= merged[-1][1]:
                merged[-1] = merged[-1][0], max(last, merged[-1][1])
            else:
                merged.append((first, last))
        self._known, self._merged = merged, True


class Reads:
    """What the statements of a program, its plant and its configuration read. A variable that is read only to be stored in itself
    again (`n := n + 1`) is not read."""

    def __init__(self, program: Program) -> None:
        self._image = Ranges([])
        self._own: dict[str, Ranges] = {}
        """Of the block that runs, by the name of its type."""
        self._behind: dict[str, Ranges] = {}
        """Of what an in-out or reference refers to, by the name of its type."""
        self._types: set[str] = set()
        """References to single values of these types are read."""
        self._anywhere = False
        """A pointer is read, or what nobody can tell the type of."""
        self._in_outs, self._bound = _slots(program)
        for pou in program.pous:
            if not in_library(pou.span):
                self._of(pou.body, pou.instance.name)
        for each in (*program.plant, *(instance for task in program.tasks for instance in task.programs)):
            self._of((each.before, each.after), "")
        for task in program.tasks:
            self._of(task.single, "")
        for access in program.accesses:
            symbol = resolve(program, access.path)
            if not symbol.slots:
                self._image.add(symbol.offset, symbol.offset + max(1, symbol.type.size))

    def has(self, owners: Sequence[Owner], offset: int, type: Type) -> bool:
        """Whether somebody reads what is at this offset of the image, inside of these, the outermost first."""
        end = offset + max(1, type.size)
        if self._anywhere or type.name in self._types or self._image.overlap(offset, end):
            return True
        return any(
            known is not None and known.overlap(offset - start, end - start)
            for record, start in owners
            for each in _lineage(record)
            for known in (self._own.get(each.name), self._behind.get(each.name))
        )

    # ---- statements -----------------------------------------------------------------------------------------------

    def _of(self, node: object, pou: str, own: Place | None = None, callee: Place | None = None) -> None:
        """Takes in what a node reads in a body of `pou`; reading `own` does not count. With `callee` places of the block that
        runs are those of this instance."""
        match node:
            case Assign():
                self._of(node.value, pou, node.target)
                self._to(node.target, pou)
            case SetBytes():
                self._to(node.target, pou)
            case For():
                self._to(node.variable, pou)
                self._of((node.start, node.end, node.step, node.body), pou)
            case CallBlock():
                self._call_block(node, pou)
            case CallFunction():
                self._call_function(node, pou, own, callee)
            case RefOf():
                self._bind(node.place, pou)
            case Load():
                self._of(node.place, pou, own, callee)
            case Place():
                place = node if callee is None else _of_instance(callee, node)
                if own is None or not _same_variable(place, own):
                    self._read(place, pou)
                self._to(place, pou)
            case Pou():
                return
            case tuple():
                for each in node:
                    self._of(each, pou, own, callee)
            case _ if is_dataclass(node) and type(node).__module__ == Place.__module__:
                for field in fields(node):
                    self._of(getattr(node, field.name), pou, own, callee)

    def _call_block(self, call: CallBlock, pou: str) -> None:
        self._to(call.instance, pou)
        self._of(tuple(value for _, value in call.inputs), pou)
        for _, place in call.in_outs:
            self._bind(place, pou)
        for value, target in call.outputs:
            self._of(value, pou, None, call.instance)
            self._to(target, pou)

    def _call_function(self, call: CallFunction, pou: str, own: Place | None, callee: Place | None) -> None:
        for name, given in zip(call.pou.parameters, call.args, strict=False):
            if not isinstance(given, Place):
                self._of(given, pou, own, callee)
            elif call.pou.frame.members[name].section is Section.OUTPUT:
                self._to(given, pou)
            else:
                self._bind(given, pou)

    def _bind(self, place: Place, pou: str) -> None:
        """An in-out or reference gets this place. Of blocks it is known what is read behind it; anything else counts as read."""
        if not has_instance(place.type):
            self._read(place, pou)
        self._to(place, pou)

    def _to(self, place: Place, pou: str) -> None:
        """What is read to find out where a place is."""
        for index in place.indices:
            self._of((index.value, index.low, index.high, index.stride), pou)
        self._of(place.reference, pou)
        if place.slot is not None:
            self._to(place.slot, pou)

    # ---- places ---------------------------------------------------------------------------------------------------

    def _read(self, place: Place, pou: str) -> None:
        extent = _extent(place)
        if place.slot is not None:
            self._read_behind(self._in_outs.get(place.slot.variable), extent)
        elif place.reference is not None:
            self._read_reference(place.reference, extent)
        elif extent is None:
            self._anywhere = True
        elif place.base is Base.SELF:
            self._own.setdefault(pou, Ranges([])).add(*extent)
        elif place.base is Base.IMAGE:
            self._image.add(*extent)

    def _read_reference(self, reference: Expr, extent: tuple[int, int] | None) -> None:
        known = reference.type
        if isinstance(reference, Load) and reference.place.variable in self._bound:
            return  # to an address of the model
        if isinstance(reference, Const):
            return  # NULL
        if not isinstance(known, Reference) or known.pointer or known.target is None:
            self._anywhere = True
        elif isinstance(known.target, Record):
            self._read_behind(known.target, extent)
        else:
            self._types |= set(_single_types(known.target))

    def _read_behind(self, target: Type | None, extent: tuple[int, int] | None) -> None:
        if target is None:
            self._anywhere = True
        elif isinstance(target, Record):
            begin, end = (0, target.size) if extent is None else extent
            self._behind.setdefault(target.name, Ranges([])).add(begin, end)
        elif has_instance(target):
            for record in _records(target):
                self._behind.setdefault(record.name, Ranges([])).add(0, record.size)


def _slots(program: Program) -> tuple[dict[str, Type], frozenset[str]]:
    """In-outs by the names of their slots, with their types; and references that VAR_CONFIG gives an address."""
    in_outs: dict[str, Type] = {}
    bound: set[str] = set()
    for pou in program.pous:
        for record, prefix in ((pou.instance, ""), (pou.frame, "frame ")):
            for member in record.members.values():
                name = f"{prefix}{member.home or record.name}.{member.name}".upper()
                if member.bound:
                    in_outs[name] = member.type
                elif member.incomplete:
                    bound.add(name)
    return in_outs, frozenset(bound)


def _extent(place: Place) -> tuple[int, int] | None:
    """All bytes that it may be, from its base on; None where the bounds of an index are computed."""
    end = place.offset + max(1, place.type.size)
    for index in place.indices:
        reach = _reach(index)
        if reach is None:
            return None
        end += reach
    return place.offset, end


def _reach(index: Index) -> int | None:
    low, high, stride = index.low, index.high, index.stride
    if isinstance(low, int) and isinstance(high, int) and isinstance(stride, int):
        return (high - low) * stride
    return None


def _of_instance(instance: Place, place: Place) -> Place:
    """A place of the block that runs, seen by who calls it."""
    if place.base is not Base.SELF or place.slot is not None or place.reference is not None:
        return place
    indices = (*instance.indices, *place.indices)
    offset = instance.offset + place.offset
    return replace(instance, type=place.type, offset=offset, indices=indices, variable=place.variable)


def _same_variable(place: Place, own: Place) -> bool:
    if place.variable != own.variable or place.base is not own.base:
        return False
    if (place.slot, place.reference) != (own.slot, own.reference):
        return False
    one, other = _extent(place), _extent(own)
    return one is not None and other is not None and one[0] < other[1] and other[0] < one[1]


def _lineage(record: Record) -> Iterator[Record]:
    """It, and what it extends."""
    known: Record | None = record
    while known is not None:
        yield known
        known = known.base


def _records(type: Type) -> Iterator[Record]:
    """The blocks and structures in a value of this type."""
    if isinstance(type, ArrayType | OpenArray):
        yield from _records(type.element)
    elif isinstance(type, Record):
        yield type
        for member in type.members.values():
            yield from _records(member.type)


def _single_types(type: Type) -> Iterable[str]:
    if isinstance(type, ArrayType | OpenArray):
        return _single_types(type.element)
    if isinstance(type, Record):
        return [name for member in type.members.values() for name in _single_types(member.type)]
    return [type.name]
