"""Statements -> closures that run them.

A closure returns how it ended: GO_ON, EXIT, CONTINUE, RETURN, or JUMP plus the number of a block.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace

from scanbench.engines.interpreter import arithmetic
from scanbench.engines.interpreter.expressions import SLOT, Body, Expressions
from scanbench.engines.interpreter.memory import putter
from scanbench.engines.interpreter.places import Places, Trapped
from scanbench.program.bodies import keeps_bits
from scanbench.program.layout import Layout
from scanbench.program.program import (
    Assign,
    Blocks,
    CallBlock,
    Case,
    Continue,
    Evaluate,
    Exit,
    For,
    Halt,
    If,
    Jump,
    Load,
    Repeat,
    Return,
    SetBytes,
    Stmt,
    Try,
    While,
)
from scanbench.program.sites import EXCEPTIONS
from scanbench.program.types import DWORD, LWORD, Elementary
from scanbench.program.untyped import bounds

BITS = {DWORD.size: DWORD, LWORD.size: LWORD}
GO_ON, EXIT, CONTINUE, RETURN, JUMP = range(5)
LOWEST = -(1 << 63)


class Statements(Expressions):
    """Makes the closure of one POU's body."""

    def block(self, statements: Sequence[Stmt]) -> Body:
        steps = tuple(self._step(statement) for statement in statements)
        if len(steps) == 1:
            return steps[0]

        def run(instance: int) -> int:
            for step in steps:
                if end := step(instance):
                    return end
            return GO_ON

        return run

    def _step(self, node: Stmt) -> Body:
        run, observer = self._statement(node), self.bodies.observer
        return run if observer is None else observer.statement(node, run)

    def _way(self, node: Stmt, way: int, run: Body) -> Body:
        observer = self.bodies.observer
        return run if observer is None else observer.way(node, way, run)

    def _statement(self, node: Stmt) -> Body:
        match node:
            case Assign():
                return self._assign(node)
            case SetBytes():
                return self._set_bytes(node)
            case CallBlock():
                return self._call_block(node)
            case Evaluate():
                return self._evaluate(node)
            case If():
                return self._if(node)
            case Case():
                return self._case(node)
            case For():
                return self._for(node)
            case While():
                return self._while(node)
            case Repeat():
                return self._repeat(node)
            case Blocks():
                return self._blocks(node)
            case Exit() | Continue() | Return() | Jump() | Halt():
                return self._leave(node)
            case Try():
                return self._try(node)

    def _assign(self, node: Assign) -> Body:
        if keeps_bits(node) and isinstance(node.value, Load):
            bits = BITS[node.target.type.size]
            source, copied = replace(node.value.place, type=bits), replace(node.target, type=bits)
            return self._assign(replace(node, target=copied, value=Load(source)))
        value, target = self.evaluate(node.value), node.target
        fixed = None if target.bit is not None else self.places.fixed(target)
        if fixed is not None:
            put = putter(self.memory, target.type)

            def store(instance: int) -> int:
                put(fixed, value(instance))
                return GO_ON

            return store
        write = self.places.write(target)

        def assign(instance: int) -> int:
            write(instance, value(instance))
            return GO_ON

        return assign

    def _set_bytes(self, node: SetBytes) -> Body:
        store = self.places.set_bytes(node.target, node.data)

        def set_bytes(instance: int) -> int:
            store(instance)
            return GO_ON

        return set_bytes

    def _leave(self, node: Exit | Continue | Return | Jump | Halt) -> Body:
        match node:
            case Exit():
                return lambda instance: EXIT
            case Continue():
                return lambda instance: CONTINUE
            case Return():
                return lambda instance: RETURN
            case Jump():
                return self._jump(node)
            case Halt():
                return self._halt(node)

    def _halt(self, node: Halt) -> Body:
        trap = self.pou.first_trap + node.trap

        def halt(instance: int) -> int:
            raise Trapped(trap)

        return halt

    def _try(self, node: Try) -> Body:
        body, handler, final = self.block(node.body), self.block(node.handler), self.block(node.final)
        store, memory, observer = Places.write(self.places, node.code), self.memory, self.bodies.observer
        traps, depth = self.bodies.program.traps, slice(Layout.DEPTH, Layout.DEPTH + 4)

        def attempt(instance: int) -> int:
            before, known = memory[depth], None if observer is None else observer.tries()

            def caught(trapped: Trapped) -> int:
                """Its code; raises it again if it has none."""
                code = EXCEPTIONS.get(traps[trapped.trap - 1].kind, 0) if trapped.trap <= len(traps) else 0
                if code == 0:
                    raise trapped
                memory[depth] = before
                if observer is not None:
                    observer.caught(known)
                return code

            again: Trapped | None = None
            try:
                end = body(instance)
            except Trapped as trapped:
                store(instance, caught(trapped))
                try:
                    end = handler(instance)
                except Trapped as other:
                    caught(other)
                    end, again = GO_ON, other
            final(instance)
            if again is not None:
                raise again
            return end

        return attempt

    # ---- calls --------------------------------------------------------------------------------------------------

    def _evaluate(self, node: Evaluate) -> Body:
        call = self.call(node.call)

        def evaluate(instance: int) -> int:
            call(instance)
            return GO_ON

        return evaluate

    def _call_block(self, node: CallBlock) -> Body:
        where, body = self.places.address(node.instance, node.pou.instance.size), self.bodies.body(node.pou)
        note, caller = self.noting(node.pou, node.site), [0]
        inner = Statements(self.bodies, self.pou, caller)
        bind = putter(self.memory, SLOT)
        inputs = [(self.evaluate(value), inner.places.write(place)) for place, value in node.inputs]
        slots = [(inner.places.address(slot), self.places.reference(actual)) for slot, actual in node.in_outs]
        outputs = [(inner.evaluate(value), self.places.write(target)) for value, target in node.outputs]

        def call(instance: int) -> int:
            callee = where(instance)
            for read, write in inputs:
                write(callee, read(instance))
            for slot, reference in slots:
                found = reference(instance)
                bind(slot(callee), found)
            if note is not None:
                note(instance)
            body(callee)
            caller[0] = instance
            for read, write in outputs:
                write(instance, read(callee))
            return GO_ON

        return call

    # ---- choices ------------------------------------------------------------------------------------------------

    def _if(self, node: If) -> Body:
        bodies = [self._way(node, way, self.block(body)) for way, (_, body) in enumerate(node.branches)]
        branches = [(self.evaluate(each), body) for (each, _), body in zip(node.branches, bodies, strict=True)]
        orelse = self._way(node, len(branches), self.block(node.orelse))
        if len(branches) == 1:
            condition, then = branches[0]
            return lambda instance: then(instance) if condition(instance) else orelse(instance)

        def choose(instance: int) -> int:
            for condition, body in branches:
                if condition(instance):
                    return body(instance)
            return orelse(instance)

        return choose

    def _case(self, node: Case) -> Body:
        selector, orelse = self.evaluate(node.selector), self._way(node, len(node.branches), self.block(node.orelse))
        bodies = [self._way(node, way, self.block(body)) for way, (_, body) in enumerate(node.branches)]
        branches = [(ranges, body) for (ranges, _), body in zip(node.branches, bodies, strict=True)]

        def choose(instance: int) -> int:
            value = selector(instance)
            for ranges, body in branches:
                for low, high in ranges:
                    if low <= value <= high:  # type: ignore[operator]
                        return body(instance)
            return orelse(instance)

        return choose

    # ---- loops and jumps ----------------------------------------------------------------------------------------

    def _spender(self, number: int) -> Callable[[int], None]:
        """Takes rounds from the loop budget of the scan."""
        memory, at, trap = self.memory, Layout.BUDGET, self.pou.first_trap + number

        def spend(rounds: int) -> None:
            left = int.from_bytes(memory[at : at + 8], "little", signed=True) - rounds
            memory[at : at + 8] = max(left, LOWEST).to_bytes(8, "little", signed=True)
            if left < 0:
                raise Trapped(trap)

        return spend

    def _while(self, node: While) -> Body:
        condition, spend = self.evaluate(node.condition), self._spender(node.trap)
        body, none = self._way(node, 0, self.block(node.body)), self._way(node, 1, self.block(()))

        def loop(instance: int) -> int:
            if not condition(instance):
                return none(instance)
            while True:
                spend(1)
                end = body(instance)
                if end == EXIT:
                    return GO_ON
                if end >= RETURN:
                    return end
                if not condition(instance):
                    return GO_ON

        return loop

    def _repeat(self, node: Repeat) -> Body:
        until, body, spend = self.evaluate(node.until), self.block(node.body), self._spender(node.trap)

        def loop(instance: int) -> int:
            while True:
                spend(1)
                end = body(instance)
                if end == EXIT:
                    return GO_ON
                if end >= RETURN:
                    return end
                if until(instance):
                    return GO_ON

        return loop

    def _for(self, node: For) -> Body:
        if node.again:
            return self._compared(node)
        start, end, step = (self.evaluate(each) for each in (node.start, node.end, node.step))
        store, spend = self.places.write(node.variable), self._spender(node.trap)
        body, none = self._way(node, 0, self.block(node.body)), self._way(node, 1, self.block(()))
        left = self.places.read(node.variable) if node.follows else None
        type = node.variable.type
        assert isinstance(type, Elementary)
        wrap, each_round, (low, high) = arithmetic.wrapper(type), node.exits, node.bounds or bounds(type)

        def loop(instance: int) -> int:
            counter, last, by = start(instance), end(instance), step(instance)
            assert isinstance(counter, int)
            assert isinstance(last, int)
            assert isinstance(by, int)
            rounds = 0 if by == 0 else max((last - counter) // by + 1, 0)
            if not each_round:
                spend(rounds)
            if rounds == 0:
                none(instance)
            while by != 0 and (counter <= last if by > 0 else counter >= last):
                if each_round:
                    spend(1)
                store(instance, wrap(counter))
                how = body(instance)
                if how == EXIT:
                    return GO_ON
                if how >= RETURN:
                    return how
                now = counter if left is None else left(instance)
                assert isinstance(now, int)
                counter = now + by
            store(instance, min(max(wrap(counter), low), high))
            return GO_ON

        return loop

    def _compared(self, node: For) -> Body:
        """A FOR that computes its end and step for each round."""
        start, end, step = (self.evaluate(each) for each in (node.start, node.end, node.step))
        store, read, spend = self.places.write(node.variable), self.places.read(node.variable), self._spender(node.trap)
        body, none = self._way(node, 0, self.block(node.body)), self._way(node, 1, self.block(()))
        type = node.variable.type
        assert isinstance(type, Elementary)
        wrap, (low, high) = arithmetic.wrapper(type), node.bounds or bounds(type)

        def loop(instance: int) -> int:
            counter, rounds = start(instance), 0
            while True:
                assert isinstance(counter, int)
                store(instance, wrap(counter))
                last, by = end(instance), step(instance)
                assert isinstance(last, int)
                assert isinstance(by, int)
                if by == 0 or (counter > last if by > 0 else counter < last):
                    break
                rounds += 1
                spend(1)
                how = body(instance)
                if how == EXIT:
                    return GO_ON
                if how >= RETURN:
                    return how
                more, now = step(instance), read(instance) if node.follows else counter
                assert isinstance(more, int)
                assert isinstance(now, int)
                counter = now + more
            if rounds == 0:
                none(instance)
            store(instance, min(max(wrap(counter), low), high))
            return GO_ON

        return loop

    def _blocks(self, node: Blocks) -> Body:
        blocks = [self.block(block) for block in node.blocks]

        def run(instance: int) -> int:
            number = 0
            while number < len(blocks):
                end = blocks[number](instance)
                if end == RETURN:
                    return RETURN
                number = end - JUMP if end >= JUMP else number + 1
            return GO_ON

        return run

    def _jump(self, node: Jump) -> Body:
        end, spend = JUMP + node.target, self._spender(node.trap)
        if not node.back:
            return lambda instance: end

        def jump_back(instance: int) -> int:
            spend(1)
            return end

        return jump_back
