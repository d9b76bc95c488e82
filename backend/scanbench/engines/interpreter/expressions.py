"""Expressions -> closures that give their value."""

from collections.abc import Callable
from operator import itemgetter
from typing import Protocol

from scanbench.check.layout import Layout
from scanbench.check.program import (
    Base,
    Binary,
    CallFunction,
    Compare,
    Const,
    Convert,
    Expr,
    Intrinsic,
    Load,
    Place,
    Pou,
    Unary,
)
from scanbench.check.types import Elementary, Kind, Section, StringType
from scanbench.engines.interpreter import arithmetic
from scanbench.engines.interpreter.intrinsics import intrinsic
from scanbench.engines.interpreter.places import REFERENCE, Places, Read, Trapped, Value

Body = Callable[[int], int]
"""Runs a body on an instance; the result says how it ended, see `statements`."""


class Bodies(Protocol):
    """Where bodies that are called can be found."""

    memory: bytearray

    def body(self, pou: Pou) -> Body: ...


class Expressions:
    """Makes closures for the expressions of one POU."""

    def __init__(self, bodies: Bodies, pou: Pou) -> None:
        self.bodies = bodies
        self.pou = pou
        self.memory = bodies.memory
        self.places = Places(bodies.memory, pou.frame_offset, self.evaluate)

    def evaluate(self, node: Expr) -> Read:
        match node:
            case Const(_, value):
                return lambda instance: value
            case Load(place):
                return self.places.read(place)
            case Unary():
                return self._unary(node)
            case Binary():
                return self._binary(node)
            case Compare():
                left, right = self.evaluate(node.left), self.evaluate(node.right)
                compare = arithmetic.COMPARE[node.op]
                return lambda instance: int(compare(left(instance), right(instance)))
            case Convert():
                return self._convert(node)
            case Intrinsic():
                return self._intrinsic(node)
            case CallFunction():
                return self.call(node)

    def _unary(self, node: Unary) -> Read:
        operand, type = self.evaluate(node.operand), node.type
        if node.op == "not":
            mask = (1 << type.bits) - 1
            return lambda instance: operand(instance) ^ mask  # type: ignore[operator]
        if type.kind is Kind.REAL:
            return lambda instance: -operand(instance)  # type: ignore[operator]
        wrap = arithmetic.wrapper(type)
        return lambda instance: wrap(-operand(instance))  # type: ignore[operator,arg-type]

    def _binary(self, node: Binary) -> Read:
        left, right, type = self.evaluate(node.left), self.evaluate(node.right), node.type
        if type.kind is Kind.REAL:
            compute, to_type = arithmetic.REAL_OPERATORS[node.op], arithmetic.rounder(type)
            return lambda instance: to_type(compute(left(instance), right(instance)))  # type: ignore[arg-type]
        wrap = arithmetic.wrapper(type)
        if node.op == "div":
            trap = node.trap

            def divide(instance: int) -> Value:
                a, b = left(instance), right(instance)
                if b == 0:
                    raise Trapped(trap)
                return wrap(arithmetic.divide_integer(a, b))  # type: ignore[arg-type]

            return divide
        operate = arithmetic.INTEGER_OPERATORS[node.op]
        return lambda instance: wrap(operate(left(instance), right(instance)))  # type: ignore[arg-type]

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

    def call(self, node: CallFunction) -> Read:
        """Runs a FUNCTION: arguments first, then its frame is filled, then its body."""
        callee = node.pou
        frame = Places(self.memory, callee.frame_offset, self.evaluate)
        body = self.bodies.body(callee)
        fill: list[tuple[Read, Callable[[int, Value], None]]] = []
        copy_out: list[tuple[Read, Callable[[int, Value], None]]] = []
        for key, arg in zip(callee.parameters, node.args, strict=True):
            member = callee.frame.members[key]
            own = Place(member.type, Base.FRAME, member.offset)
            if member.section is Section.OUTPUT:
                if isinstance(arg, Place):
                    copy_out.append((frame.read(own), self.places.write(arg)))
            elif isinstance(arg, Place):
                fill.append((self.places.reference(arg), self.slot_writer(callee.frame_offset + member.offset)))
            elif arg is not None:
                fill.append((self.evaluate(arg), frame.write(own)))
        result = self._result(callee, frame)
        values, writers = [read for read, _ in fill], list(map(itemgetter(1), fill))

        def run(instance: int) -> Value:
            given = [value(instance) for value in values]
            for write, value in zip(writers, given, strict=True):
                write(0, value)
            body(0)
            answer = result(0)
            returned = [read(0) for read, _ in copy_out]
            for (_, write), value in zip(copy_out, returned, strict=True):
                write(instance, value)
            return answer

        return run

    def slot_writer(self, offset: int) -> Callable[[int, Value], None]:
        """Writes a reference into the in-out slot at `offset` from the instance."""
        memory, pack = self.memory, REFERENCE.pack_into
        return lambda instance, value: pack(memory, instance + offset, value)

    def _result(self, callee: Pou, frame: Places) -> Read:
        if callee.result is None:
            return lambda instance: 0
        member = callee.frame.members[callee.name.upper()]
        return frame.read(Place(member.type, Base.FRAME, member.offset))
