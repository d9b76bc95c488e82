"""Statements -> closures that run them. A closure returns how it ended: GO_ON, EXIT or RETURN."""

from collections.abc import Callable, Sequence

from scanbench.check.layout import Layout
from scanbench.check.program import (
    Assign,
    CallBlock,
    Case,
    Evaluate,
    Exit,
    For,
    If,
    Repeat,
    Return,
    SetBytes,
    Stmt,
    While,
)
from scanbench.check.types import Elementary
from scanbench.engines.interpreter import arithmetic
from scanbench.engines.interpreter.expressions import Body, Expressions
from scanbench.engines.interpreter.places import Trapped

GO_ON, EXIT, RETURN = 0, 1, 2
LOWEST = -(1 << 63)


class Statements(Expressions):
    """Makes the closure of one POU's body."""

    def block(self, statements: Sequence[Stmt]) -> Body:
        steps = tuple(self._statement(statement) for statement in statements)
        if len(steps) == 1:
            return steps[0]

        def run(instance: int) -> int:
            for step in steps:
                if end := step(instance):
                    return end
            return GO_ON

        return run

    def _statement(self, node: Stmt) -> Body:
        match node:
            case Assign():
                return self._assign(node)
            case SetBytes():
                return self._set_bytes(node)
            case CallBlock():
                return self._call_block(node)
            case Evaluate():
                call = self.call(node.call)

                def evaluate(instance: int) -> int:
                    call(instance)
                    return GO_ON

                return evaluate
            case If():
                return self._if(node)
            case Case():
                return self._case(node)
            case For():
                return self._for(node)
            case While() | Repeat():
                return self._while(node)
            case Exit():
                return lambda instance: EXIT
            case Return():
                return lambda instance: RETURN

    def _assign(self, node: Assign) -> Body:
        value, write = self.evaluate(node.value), self.places.write(node.target)

        def assign(instance: int) -> int:
            write(instance, value(instance))
            return GO_ON

        return assign

    def _set_bytes(self, node: SetBytes) -> Body:
        memory, where, data = self.memory, self.places.address(node.target), node.data

        def set_bytes(instance: int) -> int:
            at = where(instance)
            memory[at : at + len(data)] = data
            return GO_ON

        return set_bytes

    def _call_block(self, node: CallBlock) -> Body:
        where, body = self.places.address(node.instance), self.bodies.body(node.pou)
        inner = Statements(self.bodies, node.pou)
        inputs = [(self.evaluate(value), inner.places.write(place)) for place, value in node.inputs]
        slots = [(self.places.reference(actual), self.slot_writer(slot.offset)) for slot, actual in node.in_outs]
        outputs = [(inner.evaluate(value), self.places.write(target)) for value, target in node.outputs]

        def call(instance: int) -> int:
            callee = where(instance)
            for read, write in inputs:
                write(callee, read(instance))
            for reference, bind in slots:
                bind(callee, reference(instance))
            body(callee)
            for read, write in outputs:
                write(instance, read(callee))
            return GO_ON

        return call

    def _if(self, node: If) -> Body:
        branches = [(self.evaluate(condition), self.block(body)) for condition, body in node.branches]
        orelse = self.block(node.orelse)

        def choose(instance: int) -> int:
            for condition, body in branches:
                if condition(instance):
                    return body(instance)
            return orelse(instance)

        return choose

    def _case(self, node: Case) -> Body:
        selector, orelse = self.evaluate(node.selector), self.block(node.orelse)
        branches = [(ranges, self.block(body)) for ranges, body in node.branches]

        def choose(instance: int) -> int:
            value = selector(instance)
            for ranges, body in branches:
                for low, high in ranges:
                    if low <= value <= high:  # type: ignore[operator]
                        return body(instance)
            return orelse(instance)

        return choose

    def spender(self, trap: int) -> Callable[[int], None]:
        """Takes rounds from the loop budget of the scan."""
        memory, at = self.memory, Layout.BUDGET

        def spend(rounds: int) -> None:
            left = int.from_bytes(memory[at : at + 8], "little", signed=True) - rounds
            memory[at : at + 8] = max(left, LOWEST).to_bytes(8, "little", signed=True)
            if left < 0:
                raise Trapped(trap)

        return spend

    def _while(self, node: While | Repeat) -> Body:
        body, spend = self.block(node.body), self.spender(node.trap)
        if isinstance(node, While):
            condition = self.evaluate(node.condition)

            def loop_while(instance: int) -> int:
                while condition(instance):
                    spend(1)
                    if end := body(instance):
                        return RETURN if end == RETURN else GO_ON
                return GO_ON

            return loop_while
        until = self.evaluate(node.until)

        def loop_until(instance: int) -> int:
            while True:
                spend(1)
                if end := body(instance):
                    return RETURN if end == RETURN else GO_ON
                if until(instance):
                    return GO_ON

        return loop_until

    def _for(self, node: For) -> Body:
        start, end, step = (self.evaluate(each) for each in (node.start, node.end, node.step))
        store, body, spend = self.places.write(node.variable), self.block(node.body), self.spender(node.trap)
        assert isinstance(node.variable.type, Elementary)
        wrap, each_round = arithmetic.wrapper(node.variable.type), node.exits

        def loop(instance: int) -> int:
            first, last, by = start(instance), end(instance), step(instance)
            assert isinstance(first, int)
            assert isinstance(last, int)
            assert isinstance(by, int)
            rounds = 0 if by == 0 else max((last - first) // by + 1, 0)
            if not each_round:
                spend(rounds)
            counter = first
            for _ in range(rounds):
                if each_round:
                    spend(1)
                store(instance, wrap(counter))
                if how := body(instance):
                    return RETURN if how == RETURN else GO_ON
                counter += by
            store(instance, wrap(counter))
            return GO_ON

        return loop
