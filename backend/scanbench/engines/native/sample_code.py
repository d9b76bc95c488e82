"""Samplings as machine code of their own, which the loop calls by its address after each scan."""

from collections.abc import Sequence
from functools import lru_cache

from scanbench.check.typed.condition import Signal
from scanbench.engines.native import emit_expressions, emit_statements, jit
from scanbench.engines.native.compiler import FAST
from scanbench.engines.native.emit_body import Body, Unit
from scanbench.engines.native.emit_function import FunctionText
from scanbench.engines.sample import CAPACITY, HEAD_WORDS, NEXT, RING, TAKEN, WORD, WRITTEN, Sampling
from scanbench.problems import Span
from scanbench.program.layout import Layout
from scanbench.program.program import Pou, Program
from scanbench.program.types import Kind, Record

KEPT = 32
"""Modules whose code is kept: the same one comes again when other code of the program takes over."""

HEAD = """\
define void @sample(ptr {image}, ptr %table, ptr %ctl) #0 {{
; %table: of each sampling the address of its control block; %ctl: u32 interrupt, set where a ring is full
entry:
  %scanat = getelementptr inbounds i8, ptr %img, i64 {scan}
  %after = load i64, ptr %scanat, align 8
  %scan = sub i64 %after, 1
  br label %look0
"""
ROW = """\
look{n}:
  %slot{n} = getelementptr i8, ptr %table, i64 {slot}
  %block{n} = load ptr, ptr %slot{n}, align 8
  %rest{n} = urem i64 %scan, {every}
  %due{n} = icmp eq i64 %rest{n}, 0
  %nextat{n} = getelementptr i8, ptr %block{n}, i64 {next}
  %next{n} = load i64, ptr %nextat{n}, align 8
  %fresh{n} = icmp uge i64 %scan, %next{n}
  %go{n} = and i1 %due{n}, %fresh{n}
  br i1 %go{n}, label %row{n}, label %look{m}
row{n}:
  store i64 %after, ptr %nextat{n}, align 8
  %takenat{n} = getelementptr i8, ptr %block{n}, i64 {taken}
  %taken{n} = load i64, ptr %takenat{n}, align 8
  %writtenat{n} = getelementptr i8, ptr %block{n}, i64 {written}
  %written{n} = load i64, ptr %writtenat{n}, align 8
  %capacityat{n} = getelementptr i8, ptr %block{n}, i64 {capacity}
  %capacity{n} = load i64, ptr %capacityat{n}, align 8
  %ringat{n} = getelementptr i8, ptr %block{n}, i64 {ring}
  %ring{n} = load ptr, ptr %ringat{n}, align 8
  %index{n} = urem i64 %written{n}, %capacity{n}
  %byte{n} = mul i64 %index{n}, {row_bytes}
  %to{n} = getelementptr i8, ptr %ring{n}, i64 %byte{n}
  store i64 %scan, ptr %to{n}, align 8
{signals}
  %validat{n} = getelementptr i8, ptr %to{n}, i64 {valid}
  store i64 %valid{n}.{count}, ptr %validat{n}, align 8
{compared}
  br i1 %differs{n}, label %keep{n}, label %look{m}
keep{n}:
  %more{n} = add i64 %written{n}, 1
  store i64 %more{n}, ptr %writtenat{n}, align 8
  %held{n} = sub i64 %more{n}, %taken{n}
  %full{n} = icmp uge i64 %held{n}, %capacity{n}
  br i1 %full{n}, label %full{n}.interrupt, label %look{m}
full{n}.interrupt:
  store volatile i32 1, ptr %ctl, align 8
  br label %look{m}
"""
SIGNAL = """\
  %at{n}.{i} = getelementptr i8, ptr %to{n}, i64 {offset}
  store i64 0, ptr %at{n}.{i}, align 8
  %status{n}.{i} = call i32 @signal{n}.{i}(ptr %img, ptr %at{n}.{i})
  %ok{n}.{i} = icmp eq i32 %status{n}.{i}, 0
  %bit{n}.{i} = select i1 %ok{n}.{i}, i64 {bit}, i64 0
  %valid{n}.{j} = or i64 %valid{n}.{i}, %bit{n}.{i}"""
ALWAYS = "  %differs{n} = icmp eq i64 0, 0"
CHANGED_HEAD = """\
  %first{n} = icmp eq i64 %written{n}, 0
  %back{n} = select i1 %first{n}, i64 0, i64 1
  %before{n} = sub i64 %written{n}, %back{n}
  %indexbefore{n} = urem i64 %before{n}, %capacity{n}
  %bytebefore{n} = mul i64 %indexbefore{n}, {row_bytes}
  %from{n} = getelementptr i8, ptr %ring{n}, i64 %bytebefore{n}
  %other{n}.1 = select i1 %first{n}, i64 1, i64 0"""
CHANGED = """\
  %newat{n}.{w} = getelementptr i8, ptr %to{n}, i64 {offset}
  %new{n}.{w} = load i64, ptr %newat{n}.{w}, align 8
  %oldat{n}.{w} = getelementptr i8, ptr %from{n}, i64 {offset}
  %old{n}.{w} = load i64, ptr %oldat{n}.{w}, align 8
  %xor{n}.{w} = xor i64 %new{n}.{w}, %old{n}.{w}
  %other{n}.{v} = or i64 %other{n}.{w}, %xor{n}.{w}"""


def link_samplings(program: Program, samplings: Sequence[Sampling]) -> jit.Code:
    """The code, in this process, as `sample`."""
    return jit.link([_compiled(emit_samplings(program, samplings))], jit.Timings())


@lru_cache(KEPT)
def _compiled(text: str) -> bytes:
    return jit.compile_object(text, FAST, jit.Timings())


def emit_samplings(program: Program, samplings: Sequence[Sampling]) -> str:
    """The module's text. Each signal is a function of its own, so that a trap in one leaves the others their values."""
    layout = program.layout
    image = f"nonnull noundef align 8 dereferenceable({layout.size}) %img"
    unit = Unit(image_size=layout.size, state_size=layout.state_size)
    parts = [HEAD.format(image=image, scan=Layout.SCAN)]
    for number, sampling in enumerate(samplings):
        for index, signal in enumerate(sampling.signals):
            _emit_signal(unit, image, f"{number}.{index}", signal)
        parts.append(_row(number, sampling))
    parts.append(f"look{len(samplings)}:\n  ret void\n}}")
    unit.module.add("".join(parts))
    return unit.module.text()


def _emit_signal(unit: Unit, image: str, name: str, signal: Signal) -> None:
    empty = Record("SIGNAL", Kind.STRUCT)
    pou = Pou("SIGNAL", "function", empty, empty, (), None, Span("", 0, 0, 0, 0))
    scratch = f'@"t.signal{name}"'
    text = FunctionText(f"define internal i32 @signal{name}(ptr {image}, ptr %to) #0", scratch)
    body = Body(unit, pou, text, emit_expressions.scalar, emit_expressions.pieces, emit_statements.run)
    ssa, type = body.scalar(signal.expr).ssa, signal.type
    if type.kind is Kind.REAL:
        ssa = text.op(f"bitcast {'float' if type.size == 4 else 'double'} {ssa} to i{8 * type.size}")
    wide = ssa if type.bits == 64 else text.op(f"zext i{type.bits} {ssa} to i64")
    text.do(f"store i64 {wide}, ptr %to, align 8")
    text.do("ret i32 0")
    if text.scratch_size:
        unit.reserve(pou, scratch, text.scratch_size)
    unit.module.add(text.text())


def _row(number: int, sampling: Sampling) -> str:
    row_bytes = WORD * sampling.words
    signals = [f"  %valid{number}.0 = or i64 0, 0"]
    for i in range(len(sampling.signals)):
        bit = 1 << i if i < 63 else -(1 << 63)
        signals.append(SIGNAL.format(n=number, i=i, j=i + 1, offset=WORD * (HEAD_WORDS + i), bit=bit))
    return ROW.format(
        n=number, m=number + 1, slot=WORD * number, every=sampling.every, next=NEXT, taken=TAKEN, written=WRITTEN,
        capacity=CAPACITY, ring=RING, row_bytes=row_bytes, signals="\n".join(signals), valid=WORD,
        count=len(sampling.signals), compared=_compared(number, sampling, row_bytes),
    )  # fmt: skip


def _compared(number: int, sampling: Sampling, row_bytes: int) -> str:
    if not sampling.changes:
        return ALWAYS.format(n=number)
    words = range(1, sampling.words)
    lines = [CHANGED_HEAD.format(n=number, row_bytes=row_bytes)]
    lines += [CHANGED.format(n=number, w=word, v=word + 1, offset=WORD * word) for word in words]
    lines.append(f"  %differs{number} = icmp ne i64 %other{number}.{sampling.words}, 0")
    return "\n".join(lines)
