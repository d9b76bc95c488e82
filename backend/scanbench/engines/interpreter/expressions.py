"""Expressions -> closures that give their value."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from typing import Protocol, cast

from scanbench.engines.interpreter import arithmetic
from scanbench.engines.interpreter.arithmetic import Operand
from scanbench.engines.interpreter.intrinsics import intrinsic
from scanbench.engines.interpreter.memory import Put, Value, decode, putter
from scanbench.engines.interpreter.observer import ReferenceObserver
from scanbench.engines.interpreter.places import Places, Read, Trapped, Write
from scanbench.engines.interpreter.violations import Record, in_65_bits
from scanbench.program.layout import Layout
from scanbench.program.origin import is_system
from scanbench.program.program import (
    Base,
    Binary,
    CallFunction,
    Compare,
    Const,
    Convert,
    Expr,
    Intrinsic,
    Limit,
    Load,
    Place,
    Pou,
    Program,
    RefOf,
    Stmt,
    Unary,
    Violates,
)
from scanbench.program.program import Sequence as SequenceNode
from scanbench.program.types import Elementary, Kind, Section, StringType
from scanbench.program.wide_types import WIDE

Body = Callable[[int], int]
"""Runs statements on an instance; the result says how they ended, see `statements`."""


class Bodies(Protocol):
    """Where bodies that are called can be found."""

    memory: bytearray
    state_size: int
    program: Program
    record: Record
    observer: ReferenceObserver | None
    """Of observed code."""

    def body(self, pou: Pou) -> Body: ...


class Expressions(ABC):
    """Makes closures for the expressions of one POU.

    `caller`, when given, holds the offset of the instance that subrange violations are recorded for, instead of the
    one that the closures are called with.
    """

    def __init__(self, bodies: Bodies, pou: Pou, caller: list[int] | None = None) -> None:
        self.bodies = bodies
        self.pou = pou
        self.caller = caller
        self.memory = bodies.memory
        found = bodies.memory, bodies.state_size, pou.frame_offset, self.evaluate, pou.first_trap
        observer = None if is_system(pou.span) else bodies.observer
        self._unseen = Places(*found)
        self.places = self._unseen if observer is None else observer.places(*found)

    @abstractmethod
    def block(self, statements: Sequence[Stmt]) -> Body:
        """The closure of statements."""

    def evaluate(self, node: Expr) -> Read:
        """The closure of an expression."""
        match node:
            case Const():
                return self._const(node)
            case Load(place):
                return self.places.read(place)
            case Unary():
                return self._unary(node)
            case Binary():
                return self._binary(node)
            case Compare():
                return cast(Read, arithmetic.compare(node.op, self._number(node.left), self._number(node.right)))
            case Convert():
                return self._convert(node)
            case Intrinsic():
                return self._intrinsic(node)
            case CallFunction():
                return self.call(node)
            case RefOf(place):
                return self.places.reference(place)
            case Limit():
                return self._limit(node)
            case Violates():
                return self._violates(node)
            case SequenceNode():
                return self._sequence(node)

    def _number(self, node: Expr) -> Operand:
        return cast(Operand, self.evaluate(node))

    def _const(self, node: Const) -> Read:
        value = node.value
        if isinstance(node.type, StringType):
            assert isinstance(value, bytes)
            text = decode(value, node.type.width)
            return lambda instance: text
        return lambda instance: value

    def _unary(self, node: Unary) -> Read:
        operand, type = self._number(node.operand), node.type
        if node.op == "not":
            mask = (1 << type.bits) - 1
            return lambda instance: operand(instance) ^ mask  # type: ignore[operator]
        if type.kind is Kind.REAL:
            return lambda instance: -operand(instance)
        wrap = arithmetic.wrapper(type)
        return lambda instance: wrap(-operand(instance))  # type: ignore[arg-type]

    def _binary(self, node: Binary) -> Read:
        left, right, type = self._number(node.left), self._number(node.right), node.type
        if node.short:
            return arithmetic.short(node.op, left, right)
        if type.kind is Kind.REAL:
            return arithmetic.real(node.op, type, left, right)
        if node.op != "div":
            return arithmetic.integer(node.op, type, left, right)
        wrap, trap = arithmetic.wrapper(type), self.pou.first_trap + node.trap

        def divide(instance: int) -> Value:
            a, b = left(instance), right(instance)
            if b == 0:
                raise Trapped(trap)
            return wrap(arithmetic.divide_integer(a, b))  # type: ignore[arg-type]

        return divide

    def _convert(self, node: Convert) -> Read:
        operand, source, target = self.evaluate(node.operand), node.operand.type, node.type
        if isinstance(target, StringType):
            capacity = target.capacity
            return lambda instance: operand(instance)[:capacity]  # type: ignore[index]
        assert isinstance(source, Elementary)
        convert = arithmetic.converter(source, target)
        return lambda instance: convert(operand(instance))  # type: ignore[arg-type]

    def _intrinsic(self, node: Intrinsic) -> Read:
        if node.name == "CLOCK":
            memory, at = self.memory, Layout.CLOCK
            return lambda instance: int.from_bytes(memory[at : at + 8], "little", signed=True)
        function, args = intrinsic(node), [self.evaluate(arg) for arg in node.args]
        if len(args) == 1:
            only = args[0]
            return lambda instance: function(only(instance))
        return lambda instance: function(*[arg(instance) for arg in args])

    # ---- subrange checks --------------------------------------------------------------------------------------

    def _limit(self, node: Limit) -> Read:
        if node.site == 0:
            return self.evaluate(node.value)
        value, low, high, record = self._number(node.value), node.low, node.high, self._recorder(node)

        def limit(instance: int) -> Value:
            number = value(instance)
            if low <= number <= high:
                return number
            record(instance, number)  # type: ignore[arg-type]
            return low if number < low else high

        return limit

    def _violates(self, node: Violates) -> Read:
        value, low, high = self._number(node.value), node.low, node.high
        if node.site == 0:
            return lambda instance: not low <= value(instance) <= high
        record = self._recorder(node)

        def violates(instance: int) -> Value:
            number = value(instance)
            if low <= number <= high:
                return False
            record(instance, number)  # type: ignore[arg-type]
            return True

        return violates

    def _recorder(self, node: Limit | Violates) -> Callable[[int, int], None]:
        record, site, called = self.bodies.record, self.pou.first_check + node.site, self.pou.called_at
        running, type = self._running(), node.value.type
        wide, signed = type.size == WIDE.size, type.kind is Kind.INT  # type: ignore[union-attr]
        bound = None if node.bound is None else self._unseen.reference(node.bound)
        copies = self.bodies.program.layout.copies
        memory = self.memory

        def record_it(instance: int, value: int) -> None:
            value, more = in_65_bits(value, signed) if wide else (value, 0)
            if bound is not None:
                more |= copies.source(memory, bound(instance) & Layout.VIOLATION_BOUND)
            record(site, running(instance), value, more, called)

        return record_it

    def _running(self) -> Callable[[int], int]:
        """Where the instance begins that runs, from the one that a closure is called with; 0 in a FUNCTION."""
        memory, this, caller = self.memory, self.pou.this, self.caller
        if this is not None:  # its slot holds the instance of the method
            at = self.pou.frame_offset + this.offset
            return lambda instance: int.from_bytes(memory[at : at + 4], "little")
        return (lambda instance: instance) if caller is None else (lambda instance: caller[0])

    def noting(self, callee: Pou, site: int) -> Callable[[int], None] | None:
        """Writes down who calls, where that is wanted."""
        memory, at, running = self.memory, callee.called_at, self._running()
        number = self.pou.first_call + site if site else 0
        if not at:
            return None

        def note(instance: int) -> None:
            memory[at : at + 8] = (number | running(instance) << 32 if number else 0).to_bytes(8, "little")

        return note

    # ---- running code ------------------------------------------------------------------------------------------

    def _sequence(self, node: SequenceNode) -> Read:
        body, value = self.block(node.body), self.evaluate(node.value)

        def sequence(instance: int) -> Value:
            body(instance)
            return value(instance)

        return sequence

    def call(self, node: CallFunction) -> Read:
        """Runs a FUNCTION: arguments first, then its frame is filled, then its body."""
        callee = node.pou
        frame = Places(self.memory, self.bodies.state_size, callee.frame_offset, self.evaluate)
        body, result = self.bodies.body(callee), self._result(callee, frame)
        given: list[Read] = []
        fill: list[tuple[Put, int]] = []
        outputs: list[tuple[Read, Write]] = []
        for key, arg in zip(callee.parameters, node.args, strict=True):
            member = callee.frame.members[key]
            own = Place(member.type, Base.FRAME, member.offset)
            at = callee.frame_offset + member.offset
            if member.section is Section.OUTPUT:
                if isinstance(arg, Place):
                    outputs.append((frame.read(own), self.places.write(arg)))
            elif isinstance(arg, Place):
                given.append(self.places.reference(arg, member.type.size))
                fill.append((putter(self.memory, SLOT), at))
            elif arg is not None:
                given.append(self.evaluate(arg))
                fill.append((putter(self.memory, member.type), at))

        keep, note = self._keeper(callee), self.noting(callee, node.site)

        def run(instance: int) -> Value:
            arguments = [value(instance) for value in given]
            restore = keep()
            if note is not None:
                note(instance)
            for (put, at), argument in zip(fill, arguments, strict=True):
                put(at, argument)
            try:
                body(0)
            except Trapped:  # what is in the frame may be in use by who catches that
                restore()
                raise
            answer = result(0)
            returned = [read(0) for read, _ in outputs]
            restore()
            for (_, write), value in zip(outputs, returned, strict=True):
                write(instance, value)
            return answer

        return run

    def _keeper(self, callee: Pou) -> Callable[[], Callable[[], None]]:
        """Keeps what a POU has that may run already, and gives what restores it."""
        if not callee.recursive:
            return lambda: _nothing
        memory, begin, end = self.memory, callee.frame_offset, callee.frame_offset + callee.frame.size
        called, after = callee.called_at, callee.called_at + 8

        def keep() -> Callable[[], None]:
            frame, caller = bytes(memory[begin:end]), bytes(memory[called:after])

            def restore() -> None:
                memory[begin:end] = frame
                if called:
                    memory[called:after] = caller

            return restore

        return keep

    def _result(self, callee: Pou, frame: Places) -> Read:
        member = callee.returned
        if member is None:
            return lambda instance: 0
        return frame.read(Place(member.type, Base.FRAME, member.offset))


def _nothing() -> None:
    """Nothing was kept."""


SLOT = Elementary("slot", Kind.REF, 8)
"""What an in-out slot holds."""
