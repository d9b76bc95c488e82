"""What flows where in a program: for each statement the places that its value and its being reached depend on, and those it writes.

Places have the same base as in the code (`Ref.base`); `deciding.py` follows them through instances. A block of the library is
one place as a whole. The target of an in-out is represented by the in-out's slot. The targets of all references to one type are one
place, those of pointers and of references to blocks, structures and arrays are `ANYWHERE`. So the result may have flows that never
happen, and misses none. What is sure from the text is left out: branches whose condition is FALSE, what `AND FALSE` or `* 0` hides,
an assignment of a variable to itself. Where all branches write the same value, no condition decides about it (`alike.py`).
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import NamedTuple

from scanbench.faults.reaction.alike import alike
from scanbench.faults.reaction.places import Ref, heads, inside, parts, ref_of, through
from scanbench.program.bodies import bodies
from scanbench.program.limits import folded
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
    Jump,
    Load,
    Place,
    Pou,
    RefOf,
    Repeat,
    Return,
    SetBytes,
    Stmt,
    Try,
    While,
)
from scanbench.program.types import Reference, Type


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
                value = folded(stmt.value)
                if isinstance(value, Load) and value.place == stmt.target:
                    return
                source = _copied(value)
                reads = self._reads(value) | self._to(stmt.target)
                written = (ref_of(stmt.target), *self._written(stmt.value))
                constant = isinstance(_plain(value), Const)
                yield Flow(reads, controls, written, source=source, constant=constant)
                yield from self._bound(stmt.value, controls)
                yield from _converted(stmt.value, stmt.target.type, controls)
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
                deciding = self._reads(_conditions(stmt))
                if isinstance(stmt, For):
                    yield Flow(deciding, controls, (ref_of(stmt.variable),))
                    deciding |= {ref_of(stmt.variable)}
                written = tuple(self._written(heads(stmt)))
                if written:
                    yield Flow(deciding, controls, written)
                yield from self._inside(stmt, controls, controls | deciding, leaves)
            case Try():
                deciding = self._trapping(stmt.body)
                yield Flow(deciding, controls, (ref_of(stmt.code),))
                yield from self._inside(stmt, controls, controls | deciding, leaves)

    def _trapping(self, body: Iterable[Stmt]) -> frozenset[Ref]:
        """All that may decide whether one of these statements traps: what they read, and what the blocks read that they call."""
        found: set[Ref] = set()
        for flow in self.of_statements(body):
            found |= flow.reads | flow.controls
            if flow.call is not None:
                inner = self._trapping(flow.call.pou.body)
                found |= {flow.call.instance, *(each for each in inner if each.base in (Base.IMAGE, None))}
        return frozenset(found)

    def _inside(
        self, stmt: Stmt, controls: frozenset[Ref], inner: frozenset[Ref], leaves: set[Ref]
    ) -> Iterator[Flow]:  # fmt: skip
        """The bodies of a statement, without those that never run."""
        same = {id(each) for group in alike(stmt) for each in group}
        for body in _living(stmt):
            for each in body:
                yield from self._walk((each,), controls if id(each) in same else inner, leaves)

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
            yield from _converted(value, place.type, controls)
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
                    found |= {through(each.type), ref_of(each.place)}
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
        """What a reference is made of may be read and written wherever one to this type is used."""
        for each in parts(node):
            if isinstance(each, RefOf):
                both = (ref_of(each.place), through(each.type))
                yield Flow(frozenset(both), controls, both)
            elif isinstance(each, CallFunction):
                for name, given in zip(each.pou.parameters, each.args, strict=False):
                    if given is not None:
                        yield from _converted(given, each.pou.frame.members[name].type, controls)

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


def _converted(value: Expr | Place, to: Type, controls: frozenset[Ref]) -> Iterator[Flow]:
    """A pointer takes references to any type: then what both refer to is one place."""
    type = value.type
    if isinstance(type, Reference) and isinstance(to, Reference) and type.target is not None:
        both = (through(type), through(to))
        if both[0] != both[1]:
            yield Flow(frozenset(both), controls, both)


def _conditions(stmt: Stmt) -> tuple[object, ...]:
    """What decides about the statements inside of one."""
    match stmt:
        case If():
            return tuple(folded(condition) for condition, _ in stmt.branches)
        case Case():
            return (folded(stmt.selector),)
        case While():
            return (folded(stmt.condition),)
        case _:
            return heads(stmt)


def _living(stmt: Stmt) -> Iterator[tuple[Stmt, ...]]:
    """The bodies of a statement that may run, by the text of the conditions."""
    if isinstance(stmt, While) and _always(stmt.condition) is False:
        return
    if not isinstance(stmt, If):
        yield from bodies(stmt)
        return
    for condition, body in stmt.branches:
        always = _always(condition)
        if always is not False:
            yield body
        if always:
            return
    yield stmt.orelse


def _always(condition: Expr) -> bool | None:
    """Whether a condition is always TRUE or always FALSE; None: neither is sure."""
    value = folded(condition)
    return bool(value.value) if isinstance(value, Const) else None


def _plain(value: Expr) -> Expr:
    while isinstance(value, Convert):
        value = value.operand
    return value


def _copied(value: Expr) -> Ref | None:
    plain = _plain(value)
    return ref_of(plain.place) if isinstance(plain, Load) else None
