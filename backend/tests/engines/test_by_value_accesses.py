"""What a data breakpoint on a variable is told of while a block works on a copy of it."""

from collections.abc import Callable
from dataclasses import replace

import pytest

from scanbench.check.build import check_sources
from scanbench.engines.debug import READ, WRITE, DebugEngine, Listen
from scanbench.engines.interpreter.debugged import debug_engine
from scanbench.engines.native.debugged import DebugBuilds
from scanbench.program.program import Program
from scanbench.symbols.symbols import resolve
from tests.caseformat import MODELS

SOURCE = """
FUNCTION_BLOCK Inner
VAR_IN_OUT y : INT; END_VAR
y := y + 1;
IF y > 1 THEN RETURN; END_IF;
y := y + 1;
END_FUNCTION_BLOCK
PROGRAM Main
VAR inner : Inner; n : INT; END_VAR
inner(y := n);
END_PROGRAM
"""
CALL, RETURN = 10, 5


class Told:
    def __init__(self, engine: DebugEngine) -> None:
        self._engine = engine
        self.lines: list[tuple[int, bool]] = []

    def statement(self, site: int, count: int, depth: int) -> bool:
        return False

    def access(self, site: int, count: int, offset: int, size: int, written: bool) -> None:
        self.lines.append((self._engine.sites.statements[site].span.line, written))


@pytest.mark.parametrize("make", [debug_engine, DebugBuilds().engine])
def test_the_copies_are_accesses_of_the_call_and_of_return(make: Callable[[Program, bytearray], DebugEngine]) -> None:
    program = check_sources({"main.st": SOURCE}, replace(MODELS["GENERIC-IEC"], in_out="value")).program
    assert program is not None
    engine = make(program, bytearray(program.initial_image))
    at, told = resolve(program, "Main.n").offset, Told(engine)
    engine.hook(told)
    engine.listen(Listen(bytes={at: READ | WRITE}))
    engine.run(1)
    assert told.lines == [(CALL, False), (CALL, True)]
    told.lines.clear()
    engine.run(1)
    assert told.lines == [(CALL, False), (RETURN, True)]
