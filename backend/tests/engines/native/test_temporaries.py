"""Where strings, arrays and structures stay inside of a statement: not on the stack, and not without end."""

import re

import pytest

from scanbench.engines.native.emit_body import SCRATCH_LIMIT, TooLarge
from scanbench.engines.native.emit_program import emit_program
from scanbench.engines.native.engine import NativeEngine
from tests.engines.native.plc import check

WIDE = """\
TYPE Wide : ARRAY[0..{last}] OF LREAL; END_TYPE
FUNCTION Same : Wide
VAR_INPUT a : Wide; k : DINT; END_VAR
Same[k] := a[k];
END_FUNCTION
FUNCTION Three : DINT
Three := 3;
END_FUNCTION
PROGRAM Main
VAR a : Wide; END_VAR
a := Same(Same(Same(a, Three()), Three()), Three());
END_PROGRAM
"""

TEXTS = """\
FUNCTION Long : STRING[32767]
VAR_INPUT i : INT; END_VAR
Long := 'abc';
END_FUNCTION
PROGRAM Main
VAR s : STRING[32767]; END_VAR
{statements}
END_PROGRAM
"""


def concat(parts: int) -> str:
    return f"s := CONCAT({', '.join(['Long(1)'] * parts)});"


def reserved(ir: str) -> int:
    return sum(int(size) for size in re.findall(r"internal global \[(\d+) x i8\]", ir))


def test_nothing_large_is_on_the_stack() -> None:
    ir = emit_program(check(WIDE.format(last=100_000)))
    on_stack = re.findall(r"alloca \[(\d+) x i8\]", ir)
    assert not on_stack
    assert reserved(ir) >= 800_000


def test_hundreds_of_long_strings_in_one_statement() -> None:
    program = check(TEXTS.format(statements=concat(400)))
    memory = bytearray(program.initial_image)
    NativeEngine(program, memory).run(1)
    assert b"abc" * 400 in memory


def test_the_next_statement_uses_the_memory_again() -> None:
    once = reserved(emit_program(check(TEXTS.format(statements=concat(3)))))
    often = reserved(emit_program(check(TEXTS.format(statements="\n".join([concat(3)] * 20)))))
    assert once == often


def test_too_much_is_refused_with_the_name_of_the_pou() -> None:
    program = check(WIDE.format(last=SCRATCH_LIMIT // 16))
    with pytest.raises(TooLarge, match=r"^Main needs \d+ bytes"):
        emit_program(program)
