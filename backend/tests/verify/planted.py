"""A native emitter with a fault: one operation of one statement is emitted as another one. For tests only.

The emitters find their operators, and the statements that they emit, by the names of their modules: a copy of those names is put
in place while a program is emitted, and taken away afterwards.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass, field
from unittest.mock import patch

from scanbench.engines.native import emit_expressions, emit_operators, emit_statements
from scanbench.engines.native.debugged import DebugBuilds
from scanbench.engines.native.emit_body import Body
from scanbench.engines.native.emit_function import Value
from scanbench.engines.native.engine import NativeEngine
from scanbench.program.program import Assign, Place, Program, Stmt
from scanbench.program.types import Elementary
from scanbench.runtime.programs import Loaded

Make = Callable[[int, Program], Loaded]


@dataclass
class Fault:
    """In the statement that begins in this line `wrong` is emitted instead of `right`."""

    file: str
    line: int
    right: str
    wrong: str
    planted: int = 0
    """How often it was."""
    _running: list[Stmt] = field(default_factory=list)

    def here(self, op: str) -> str:
        """The operation that is emitted."""
        span = getattr(self._running[-1], "span", None) if self._running else None
        if span is None or (span.file, span.line) != (self.file, self.line) or op != self.right:
            return op
        self.planted += 1
        return self.wrong

    @contextmanager
    def in_place(self) -> Iterator[None]:
        """What is emitted meanwhile has the fault."""
        one, store_if = emit_statements.one, emit_statements._store_if
        binary, compare = emit_operators.binary, emit_operators.compare

        def statement(body: Body, statement: Stmt) -> None:
            with self._in(statement):
                one(body, statement)

        def selected(body: Body, guard: str, target: Place, statement: Assign) -> None:
            with self._in(statement):
                store_if(body, guard, target, statement)

        def operation(body: Body, op: str, type: Elementary, left: Value, right: Value, trap: int) -> Value:
            return binary(body, self.here(op), type, left, right, trap)

        def comparison(body: Body, op: str, type: Elementary, left: Value, right: Value) -> Value:
            return compare(body, self.here(op), type, left, right)

        with (
            patch.object(emit_statements, "one", statement),
            patch.object(emit_statements, "_store_if", selected),
            patch.object(emit_expressions, "binary", operation),
            patch.object(emit_expressions, "compare", comparison),
        ):
            yield

    @contextmanager
    def _in(self, statement: Stmt) -> Iterator[None]:
        self._running.append(statement)
        try:
            yield
        finally:
            self._running.pop()


def planted(fault: Fault, *, debug: bool) -> Make:
    """Engines whose run flavour has the fault, and whose debug flavour may have it, too."""

    def make(version: int, program: Program) -> Loaded:
        memory = bytearray(program.layout.size)
        before = fault.planted
        with fault.in_place():
            engine = NativeEngine(program, memory)
        assert fault.planted > before, f"nothing was planted at {fault.file}:{fault.line}: no {fault.right} there"
        with fault.in_place() if debug else nullcontext():
            loaded = Loaded(version, program, memory, engine)
            loaded.debug = DebugBuilds().engine(program, memory)
        return loaded

    return make
