"""What flows where in a program: for each statement the places that its value and its being reached depend on, and those it writes.

Places have the same base as in the code (`Ref.base`); `deciding.py` follows them through instances. A block of the library is
one place as a whole. The target of an in-out is represented by the in-out's slot, and the targets of all references are one place,
`Ref.ANYWHERE`: so the result may have flows that never happen, and misses none.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, fields, is_dataclass, replace
from typing import NamedTuple

from scanbench.program.bodies import bodies
from scanbench.program.origin import in_library
from scanbench.program.program import (
    Assign,
    Base,
    Blocks,
    CallBlock,
    CallFunction,
    Case,
    Const,
    Continue,
    Convert,
    Evaluate,
    Exit,
    Expr,
    For,
    Halt,
    If,
    Index,
    Jump,
    Load,
    Place,
    Pou,
    RefOf,
    Repeat,
    Return,
    SetBytes,
    Stmt,
    While,
)
from scanbench.program.types import Section


class Ref(NamedTuple):
    """Bytes that count from a base; of one byte perhaps only some bits."""

    base: Base | None
    """None: anywhere, through a reference."""
    begin: int
    end: int
    mask: int = 0xFF


ANYWHERE = Ref(None, 0, 1)


class Call(NamedTuple):
    """A block that a statement runs."""

    instance: Ref
    pou: Pou


@dataclass(frozen=True, slots=True)
class Flow:
    """What one statement does with data."""

    reads: frozenset[Ref]
    """What it stores depends on."""
    controls: frozenset[Ref]
    """What decides whether it is reached."""
    writes: tuple[Ref, ...] = ()
    call: Call | None = None
    source: Ref | None = None
    """The place of the value that it stores unchanged, if it is a copy."""
    constant: bool = False
    acts: bool = False
    """It stops the program."""
    stmt: Stmt | None = None
    """Whose flow it is."""


class Flows:
    """The flows of POUs, each worked out once."""

    def __init__(self) -> None:
        self._of: dict[Pou, tuple[Flow, ...]] = {}
        self._image: dict[Pou, tuple[frozenset[Ref], frozenset[Ref]]] = {}

    def of(self, pou: Pou) -> tuple[Flow, ...]:
        """Of the body of a program or block."""
        known = self._of.get(pou)
        if known is None:
            known = self._of[pou] = self.of_statements(pou.body)
        return known

    def of_statements(self, body: Iterable[Stmt]) -> tuple[Flow, ...]:
        """Of these statements."""
        leaves: set[Ref] = set()
        found = list(self._walk(body, frozenset(), leaves))
        if not leaves:
            return tuple(found)
        # what decides about a RETURN, EXIT or jump decides about what comes after it
        return tuple(replace(each, controls=each.controls | leaves) for each in found)

    def _walk(self, body: Iterable[Stmt], controls: frozenset[Ref], leaves: set[Ref]) -> Iterator[Flow]:
        for stmt in body:
            for flow in self._statement(stmt, controls, leaves):
                yield flow if flow.stmt is not None else replace(flow, stmt=stmt)

    def _statement(self, stmt: Stmt, controls: frozenset[Ref], leaves: set[Ref]) -> Iterator[Flow]:
        match stmt:
            case Assign():
                source = _copied(stmt.value)
                reads = self._reads(stmt.value) | self._to(stmt.target)
                written = (ref_of(stmt.target), *self._written(stmt.value))
                constant = isinstance(_plain(stmt.value), Const)
                yield Flow(reads, controls, written, source=source, constant=constant)
                yield from self._bound(stmt.value, controls)
            case SetBytes():
                yield Flow(self._to(stmt.target), controls, (ref_of(stmt.target),), constant=True)
            case CallBlock():
                yield from self._block(stmt, controls)
            case Evaluate():
                yield Flow(self._reads(stmt.call), controls, tuple(self._written(stmt.call)))
                yield from self._bound(stmt.call, controls)
            case Exit() | Continue() | Return() | Jump():
                leaves |= controls
            case Halt():
                yield Flow(frozenset(), controls, acts=True)
            case If() | Case() | For() | While() | Repeat() | Blocks():
                deciding = self._reads(heads(stmt))
                if isinstance(stmt, For):
                    yield Flow(deciding, controls, (ref_of(stmt.variable),))
                    deciding |= {ref_of(stmt.variable)}
                written = tuple(self._written(heads(stmt)))
                if written:
                    yield Flow(deciding, controls, written)
                inner = controls | deciding
                for body in bodies(stmt):
                    yield from self._walk(body, inner, leaves)

    def _block(self, call: CallBlock, controls: frozenset[Ref]) -> Iterator[Flow]:
        instance, to = ref_of(call.instance), self._to(call.instance)
        whole = in_library(call.pou.span)

        def within(ref: Ref) -> Ref:
            return instance if whole else inside(call.instance, ref)

        for place, value in call.inputs:
            written = (within(ref_of(place)), *self._written(value))
            source, constant = (None, False) if whole else (_copied(value), isinstance(_plain(value), Const))
            yield Flow(self._reads(value) | to, controls, written, source=source, constant=constant)
            yield from self._bound(value, controls)
        for slot, actual in call.in_outs:
            here, outside = within(ref_of(slot)), ref_of(actual)
            yield Flow(frozenset((outside,)) | to | self._to(actual), controls, (here,))
            if whole or self._writes(call.pou, ref_of(slot)):
                yield Flow(frozenset((here,)) | to, controls, (outside,))
        if whole:
            yield Flow(frozenset((instance,)), controls, (instance,))
        else:
            yield Flow(to, controls, call=Call(instance, call.pou))
        for value, target in call.outputs:
            source = None if whole else _copied(value)
            reads = frozenset(map(within, self._reads(value))) | to | self._to(target)
            yield Flow(reads, controls, (ref_of(target),), source=None if source is None else within(source))

    def _writes(self, pou: Pou, slot: Ref) -> bool:
        """Whether a block may write to what it is given for this in-out."""
        return any(
            (flow.call is not None and flow.call.instance.begin == 0) or slot in flow.writes for flow in self.of(pou)
        )

    # ---- expressions ----------------------------------------------------------------------------------------------

    def _reads(self, node: object) -> frozenset[Ref]:
        """All that the value of an expression depends on."""
        found: set[Ref] = set()
        for each in parts(node):
            match each:
                case Place():
                    found.add(ref_of(each))
                case RefOf():
                    found |= {ANYWHERE, ref_of(each.place)}
                case CallFunction():
                    found |= self._of_function(each.pou)[0]
        return frozenset(found)

    def _written(self, node: object) -> Iterator[Ref]:
        """What an expression writes: outputs and in-outs of functions, and what these write themselves."""
        for each in parts(node):
            if isinstance(each, CallFunction):
                yield from self._of_function(each.pou)[1]
                for name, given in zip(each.pou.parameters, each.args, strict=False):
                    if isinstance(given, Place) and not each.pou.frame.members[name].constant:
                        yield ref_of(given)

    def _bound(self, node: object, controls: frozenset[Ref]) -> Iterator[Flow]:
        """What a reference is made of may be read and written anywhere."""
        for each in parts(node):
            if isinstance(each, RefOf):
                both = (ref_of(each.place), ANYWHERE)
                yield Flow(frozenset(both), controls, both)

    def _to(self, place: Place) -> frozenset[Ref]:
        """What decides where a place is."""
        return self._reads((place.indices, place.reference))

    def _of_function(self, pou: Pou) -> tuple[frozenset[Ref], frozenset[Ref]]:
        """What a function reads and writes of the image and through references, itself and in functions that it calls."""
        known = self._image.get(pou)
        if known is None:
            self._image[pou] = frozenset(), frozenset()
            reads: set[Ref] = set()
            writes: set[Ref] = set()
            for flow in self.of(pou):
                reads |= {each for each in (*flow.reads, *flow.controls) if each.base in (Base.IMAGE, None)}
                writes |= {each for each in flow.writes if each.base in (Base.IMAGE, None)}
            known = self._image[pou] = frozenset(reads), frozenset(writes)
        return known


def parts(node: object) -> Iterator[object]:
    """The expressions and places in an expression, those that say where a place is included; not what only receives a value."""
    if isinstance(node, CallFunction):
        yield node
        for name, given in zip(node.pou.parameters, node.args, strict=False):
            if not isinstance(given, Place):
                yield from parts(given)
            elif node.pou.frame.members[name].section is Section.OUTPUT:
                yield from parts((given.indices, given.reference))
            else:
                yield from parts(given)
    elif isinstance(node, RefOf):
        yield node
        yield from parts((node.place.indices, node.place.reference))
    elif isinstance(node, Place):
        yield node
        yield from parts((node.indices, node.reference))
    elif isinstance(node, tuple):
        for each in node:
            yield from parts(each)
    elif isinstance(node, Load | Index) or (is_dataclass(node) and type(node).__module__ == Place.__module__):
        if not isinstance(node, Pou):
            yield node
            for field in fields(node):
                yield from parts(getattr(node, field.name))


def inside(instance: Place, ref: Ref) -> Ref:
    """A place of a block that is called, seen by who calls it."""
    whole = ref_of(instance)
    if ref.base is not Base.SELF:
        return ref
    if instance.slot is not None or instance.reference is not None:
        return whole
    reach = whole.end - whole.begin - max(1, instance.type.size)
    return Ref(whole.base, whole.begin + ref.begin, whole.begin + ref.end + reach, ref.mask)


def ref_of(place: Place) -> Ref:
    """The bytes that a place may be."""
    if place.slot is not None:
        return ref_of(place.slot)
    if place.reference is not None:
        return ANYWHERE
    end = place.offset + max(1, place.type.size)
    for index in place.indices:
        if isinstance(index.low, int) and isinstance(index.high, int) and isinstance(index.stride, int):
            end += (index.high - index.low) * index.stride
    one_bit = place.bit is not None and not place.indices
    return Ref(place.base, place.offset, end, 1 << (place.bit or 0) if one_bit else 0xFF)


def heads(stmt: Stmt) -> tuple[object, ...]:
    """What a statement evaluates itself, without the statements inside of it."""
    match stmt:
        case Assign():
            return stmt.value, stmt.target.indices, stmt.target.reference
        case CallBlock():
            bound = tuple((actual.indices, actual.reference) for _, actual in stmt.in_outs)
            return tuple(value for _, value in stmt.inputs), bound, stmt.instance.indices, stmt.instance.reference
        case Evaluate():
            return (stmt.call,)
        case If():
            return tuple(condition for condition, _ in stmt.branches)
        case Case():
            return (stmt.selector,)
        case For():
            return stmt.start, stmt.end, stmt.step
        case While():
            return (stmt.condition,)
        case Repeat():
            return (stmt.until,)
        case _:
            return ()


def _plain(value: Expr) -> Expr:
    while isinstance(value, Convert):
        value = value.operand
    return value


def _copied(value: Expr) -> Ref | None:
    plain = _plain(value)
    return ref_of(plain.place) if isinstance(plain, Load) else None
