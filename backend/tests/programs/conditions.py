"""Random conditions on random programs: both engines must come back after the same scans."""

from collections.abc import Sequence

from scanbench.check.typed.condition import Condition, compile_condition
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.engine import NativeEngine
from scanbench.program.program import Program
from scanbench.symbols.symbols import members
from tests.programs.compare import SCANS, limited
from tests.programs.expressions import expression
from tests.programs.scope import TYPES, Draw, Scope

DEPTH = 3


def text(seed: int, program: Program) -> str:
    """A condition on the variables of Main."""
    scope = Scope(loops=False)
    for symbol in members(program, "Main"):
        if symbol.type.name in TYPES:
            scope.add(symbol.type.name, symbol.path, writable=False)
    return expression(Draw(seed), scope, "BOOL", DEPTH)


def difference(program: Program, condition: Condition, objects: Sequence[bytes] | None = None) -> str:
    """The first scan after which only one engine finds that it holds, or ''. The machine code may be there already."""
    images = [limited(program) for _ in range(2)]
    engines = [ReferenceEngine(program, images[0]), NativeEngine(program, images[1], 0, objects)]
    for engine in engines:
        engine.stop_when(condition)
    for scan in range(SCANS):
        stops = [engine.run(1) for engine in engines]
        if stops[0] != stops[1]:
            return f"{condition.text}\nscan {scan}: reference {stops[0]}, native {stops[1]}"
    return ""


def compare(program: Program, words: str, objects: Sequence[bytes] | None = None) -> bool:
    """Whether the condition could be compared; a difference is an AssertionError."""
    condition = compile_condition(program, words)
    if not isinstance(condition, Condition):
        return False
    found = difference(program, condition, objects)
    assert not found, found
    return True
