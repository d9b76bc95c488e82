"""A condition as machine code of its own, which the loop calls by its address."""

from functools import lru_cache

from scanbench.check.typed.condition import Condition
from scanbench.engines.native import emit_expressions, emit_statements, jit
from scanbench.engines.native.compiler import FAST
from scanbench.engines.native.emit_body import Body, Unit
from scanbench.engines.native.emit_function import FunctionText
from scanbench.problems import Span
from scanbench.program.program import Pou, Program
from scanbench.program.types import Kind, Record

KEPT = 32
"""Conditions whose code is kept: the same one comes again when optimised code of the program takes over."""
SCRATCH = '@"t.condition{n}"'

ENTRY = """\
define i32 @condition(ptr {image}) #0 {{
; 1 where one of them holds. A trap is the number of a site, which is positive
{calls}  ret i32 0
holds:
  ret i32 1
}}"""
CALL = """\
  %status{n} = call i32 @evaluate{n}(ptr %img)
  %holds{n} = icmp {holds} i32 %status{n}, 0
  br i1 %holds{n}, label %holds, label %next{n}
next{n}:
"""


def link_condition(program: Program, *conditions: Condition) -> jit.Code:
    """The code, in this process, as `condition`: whether one of these holds."""
    return _linked(emit_condition(program, *conditions))


@lru_cache(KEPT)
def _linked(text: str) -> jit.Code:
    return jit.link([jit.compile_object(text, FAST, jit.Timings())], jit.Timings())


def emit_condition(program: Program, *conditions: Condition) -> str:
    """The module's text. Each condition is a function of its own, so that a trap in one hides no other."""
    layout = program.layout
    image = f"nonnull noundef align 8 dereferenceable({layout.size}) %img"
    unit = Unit(image_size=layout.size, state_size=layout.state_size)
    empty = Record("CONDITION", Kind.STRUCT)
    for number, condition in enumerate(conditions):
        pou = Pou("CONDITION", "function", empty, empty, (), None, Span("", 0, 0, 0, 0))
        scratch = SCRATCH.format(n=number)
        text = FunctionText(f"define internal i32 @evaluate{number}(ptr {image}) #0", scratch)
        body = Body(unit, pou, text, emit_expressions.scalar, emit_expressions.pieces, emit_statements.run)
        value = body.scalar(condition.expr)
        text.do(f"ret i32 {text.op(f'sext i1 {value.ssa} to i32')}")
        if text.scratch_size:
            unit.reserve(pou, scratch, text.scratch_size)
        unit.module.add(text.text())
    calls = "".join(
        CALL.format(n=number, holds="ne" if each.unknown else "slt") for number, each in enumerate(conditions)
    )
    unit.module.add(ENTRY.format(image=image, calls=calls))
    return unit.module.text()
