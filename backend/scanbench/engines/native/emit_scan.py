"""The scan, and the loop that runs scans at a pace: the contract of `engines/engine.py` in IR."""

from scanbench.check.layout import Layout
from scanbench.check.program import Pou, Program, ProgramInstance, Task
from scanbench.check.types import BOOL, Kind, Record
from scanbench.engines.native import emit_expressions, emit_statements
from scanbench.engines.native.emit_body import Body, Unit
from scanbench.engines.native.emit_function import UNLIKELY, FunctionText, Value
from scanbench.engines.native.emit_memory import store
from scanbench.engines.native.emit_places import address, load
from scanbench.problems import Span

DONE, KNOCKED, TRAP = 0, 1, 2
"""What `@run` returns."""

SLICE_NS = 2_000_000
"""Longest sleep between two looks at the knock."""
LATE_PERIODS = 10
LATE_NS = 100_000_000
"""A deadline that is more than both of these in the past is moved to now."""

SCRATCH = '@"t.scan"'
"""Memory of the temporaries of what a configuration connects."""

APPLY_FORCES = """\
define internal void @forces(ptr %img) noinline cold #0 {{
; byte = byte & ~mask | value & mask, for every entry in use
entry:
  %countat = getelementptr inbounds i8, ptr %img, i64 {count}
  %count = load i32, ptr %countat, align 4
  %limited = call i32 @llvm.umin.i32(i32 %count, i32 {limit})
  %n = zext i32 %limited to i64
  br label %next
next:
  %i = phi i64 [ 0, %entry ], [ %after, %one ]
  %more = icmp ult i64 %i, %n
  br i1 %more, label %one, label %done
one:
  %start = mul i64 %i, 8
  %at = add i64 %start, {table}
  %entryat = getelementptr inbounds i8, ptr %img, i64 %at
  %offset = load i32, ptr %entryat, align 8
  %maskat = getelementptr inbounds i8, ptr %entryat, i64 4
  %mask = load i8, ptr %maskat, align 1
  %valueat = getelementptr inbounds i8, ptr %entryat, i64 5
  %value = load i8, ptr %valueat, align 1
  %wide = zext i32 %offset to i64
  %byteat = getelementptr inbounds i8, ptr %img, i64 %wide
  %byte = load i8, ptr %byteat, align 1
  %keep = xor i8 %mask, -1
  %kept = and i8 %byte, %keep
  %set = and i8 %value, %mask
  %forced = or i8 %kept, %set
  store i8 %forced, ptr %byteat, align 1
  %after = add i64 %i, 1
  br label %next
done:
  ret void
}}
declare i32 @llvm.umin.i32(i32, i32)"""

RUN = """\
declare i32 @clock_gettime(i32, ptr) nounwind willreturn memory(argmem: readwrite, inaccessiblemem: readwrite)
declare i32 @clock_nanosleep(i32, i32, ptr, ptr) nounwind willreturn memory(argmem: readwrite, inaccessiblemem: readwrite)
declare i64 @llvm.smin.i64(i64, i64)
declare i64 @llvm.smax.i64(i64, i64)

define internal i64 @now() noinline #0 {{
; nanoseconds of CLOCK_MONOTONIC
  %time = alloca {{ i64, i64 }}, align 8
  %ok = call i32 @clock_gettime(i32 1, ptr %time)
  %s = load i64, ptr %time, align 8
  %nsat = getelementptr i8, ptr %time, i64 8
  %ns = load i64, ptr %nsat, align 8
  %scaled = mul i64 %s, 1000000000
  %sum = add i64 %scaled, %ns
  ret i64 %sum
}}

define internal void @sleepuntil(i64 %when) noinline #0 {{
  %time = alloca {{ i64, i64 }}, align 8
  %s = sdiv i64 %when, 1000000000
  %scaled = mul i64 %s, 1000000000
  %ns = sub i64 %when, %scaled
  store i64 %s, ptr %time, align 8
  %nsat = getelementptr i8, ptr %time, i64 8
  store i64 %ns, ptr %nsat, align 8
  %ok = call i32 @clock_nanosleep(i32 1, i32 1, ptr %time, ptr null)
  ret void
}}

define internal i64 @waitfor(ptr noalias %ctl, ptr noalias %pace) noinline #0 {{
; sleeps until the deadline; gives the time, or -1 when somebody knocked. Notes how late it is
entry:
  %period = load i64, ptr %pace, align 8
  %deadlineat = getelementptr i8, ptr %pace, i64 8
  %deadline = load i64, ptr %deadlineat, align 8
  br label %look
look:
  %knock = load volatile i8, ptr %ctl, align 8
  %knocked = icmp ne i8 %knock, 0
  br i1 %knocked, label %leave, label %time
time:
  %now = call i64 @now()
  %early = icmp slt i64 %now, %deadline
  br i1 %early, label %sleep, label %start
sleep:
  %slice = add i64 %now, {slice}
  %until = call i64 @llvm.smin.i64(i64 %slice, i64 %deadline)
  call void @sleepuntil(i64 %until)
  br label %look
start:
  %behind = sub i64 %now, %deadline
  %periods = mul i64 %period, {late_periods}
  %tolerated = call i64 @llvm.smax.i64(i64 %periods, i64 {late_ns})
  %lost = icmp sgt i64 %behind, %tolerated
  %from = select i1 %lost, i64 %now, i64 %deadline
  store i64 %from, ptr %deadlineat, align 8
  %late = sub i64 %now, %from
  %lateat = getelementptr i8, ptr %pace, i64 16
  %sum = load i64, ptr %lateat, align 8
  %newsum = add i64 %sum, %late
  store i64 %newsum, ptr %lateat, align 8
  %worstat = getelementptr i8, ptr %pace, i64 24
  %worst = load i64, ptr %worstat, align 8
  %newworst = call i64 @llvm.smax.i64(i64 %worst, i64 %late)
  store i64 %newworst, ptr %worstat, align 8
  ret i64 %now
leave:
  ret i64 -1
}}

define internal void @note(ptr noalias %pace, i64 %began, i64 %counted) noinline #0 {{
; the scan is over: time spent; and where it counts, the next deadline
  %now = call i64 @now()
  %spent = sub i64 %now, %began
  %busyat = getelementptr i8, ptr %pace, i64 32
  %busy = load i64, ptr %busyat, align 8
  %newbusy = add i64 %busy, %spent
  store i64 %newbusy, ptr %busyat, align 8
  %scansat = getelementptr i8, ptr %pace, i64 40
  %scans = load i64, ptr %scansat, align 8
  %newscans = add i64 %scans, %counted
  store i64 %newscans, ptr %scansat, align 8
  %period = load i64, ptr %pace, align 8
  %step = mul i64 %period, %counted
  %deadlineat = getelementptr i8, ptr %pace, i64 8
  %deadline = load i64, ptr %deadlineat, align 8
  %next = add i64 %deadline, %step
  store i64 %next, ptr %deadlineat, align 8
  ret void
}}

define i32 @run(ptr noalias nonnull noundef align 8 dereferenceable({size}) %img, ptr noalias %ctl, i64 %scans, ptr noalias %pace) #0 {{
; %ctl: u8 knock, +8 i64 trap. %pace: i64 period, deadline, late, worst, busy, scans; null when nothing is to be measured
entry:
  %measured = icmp ne ptr %pace, null
  br i1 %measured, label %paces, label %head
paces:
  %period = load i64, ptr %pace, align 8
  %slow = icmp sgt i64 %period, 0
  br i1 %slow, label %head, label %whole
whole:
  %began = call i64 @now()
  br label %head
head:
  %paced = phi i1 [ false, %entry ], [ true, %paces ], [ false, %whole ], [ %paced, %counted ]
  %around = phi i1 [ false, %entry ], [ false, %paces ], [ true, %whole ], [ %around, %counted ]
  %since = phi i64 [ 0, %entry ], [ 0, %paces ], [ %began, %whole ], [ %since, %counted ]
  %k = phi i64 [ 0, %entry ], [ 0, %paces ], [ 0, %whole ], [ %k1, %counted ]
  %knock = load volatile i8, ptr %ctl, align 8
  %knocked = icmp ne i8 %knock, 0
  br i1 %knocked, label %leave, label %look, !prof !0
look:
  %more = icmp slt i64 %k, %scans
  br i1 %more, label %ready, label %leave
ready:
  br i1 %paced, label %wait, label %go
wait:
  %start = call i64 @waitfor(ptr %ctl, ptr %pace)
  %called = icmp slt i64 %start, 0
  br i1 %called, label %leave, label %go
go:
  %at = phi i64 [ 0, %ready ], [ %start, %wait ]
  %status = call i32 @scan(ptr %img)
  %bad = icmp ne i32 %status, 0
  br i1 %bad, label %trapped, label %good, !prof !0
good:
  br i1 %paced, label %noted, label %counted
noted:
  call void @note(ptr %pace, i64 %at, i64 1)
  br label %counted
counted:
  %k1 = add nsw i64 %k, 1
  br label %head
trapped:
  %wide = zext i32 %status to i64
  %trapat = getelementptr i8, ptr %ctl, i64 8
  store i64 %wide, ptr %trapat, align 8
  br i1 %paced, label %notedtrap, label %leave
notedtrap:
  call void @note(ptr %pace, i64 %at, i64 0)
  br label %leave
leave:
  %reason = phi i32 [ {knocked}, %head ], [ {done}, %look ], [ {knocked}, %wait ], [ {trap}, %trapped ], [ {trap}, %notedtrap ]
  br i1 %around, label %sum, label %out
sum:
  call void @note(ptr %pace, i64 %since, i64 %k)
  br label %out
out:
  store volatile i8 0, ptr %ctl, align 8
  ret i32 %reason
}}"""


def emit(unit: Unit, program: Program) -> None:
    """Adds `@scan` and `@run` to the module."""
    size = program.layout.size
    unit.module.declare(
        "@forces",
        APPLY_FORCES.format(count=Layout.FORCE_COUNT, table=Layout.FORCES, limit=Layout.FORCE_LIMIT),
    )
    unit.module.add(_scan(unit, program))
    run = RUN.format(
        size=size, slice=SLICE_NS, late_periods=LATE_PERIODS, late_ns=LATE_NS, done=DONE, knocked=KNOCKED, trap=TRAP
    )
    unit.module.declare("@run", run)


def _scan(unit: Unit, program: Program) -> str:
    size = program.layout.size
    head = f"define internal i32 @scan(ptr nonnull noundef align 8 dereferenceable({size}) %img) #0"
    text = FunctionText(head, SCRATCH)
    body = _around(unit, text)
    scan = _field(text, Layout.SCAN)
    number = text.op(f"load i64, ptr {scan}, align 8{unit.module.tag('#scan')}")
    clock = text.op(f"and i64 {text.op(f'mul i64 {number}, {program.interval_ns}')}, {(1 << 63) - 1}")
    text.do(f"store i64 {clock}, ptr {_field(text, Layout.CLOCK)}, align 8{unit.module.tag('#clock')}")
    limit = text.op(f"load i64, ptr {_field(text, Layout.BUDGET_LIMIT)}, align 8{unit.module.tag('#limit')}")
    text.do(f"store i64 {limit}, ptr {_field(text, Layout.BUDGET)}, align 8{unit.module.tag('#budget')}")
    _forces(unit, text)
    for task in program.tasks:
        _task(body, task, number)
    _forces(unit, text)
    following = text.op(f"add i64 {number}, 1")
    text.do(f"store i64 {following}, ptr {scan}, align 8{unit.module.tag('#scan')}")
    text.do("ret i32 0")
    if text.scratch_size:
        unit.reserve(body.pou, SCRATCH, text.scratch_size)
    return text.text()


def _around(unit: Unit, text: FunctionText) -> Body:
    """What runs around the programs, for which all places are in the image."""
    empty = Record("CONFIGURATION", Kind.STRUCT)
    pou = Pou("CONFIGURATION", "function", empty, empty, (), None, Span("", 0, 0, 0, 0))
    return Body(unit, pou, text, emit_expressions.scalar, emit_expressions.pieces, emit_statements.run)


def _field(text: FunctionText, offset: int) -> str:
    return text.op(f"getelementptr inbounds nuw i8, ptr %img, i64 {offset}")


def _forces(unit: Unit, text: FunctionText) -> None:
    where = _field(text, Layout.FORCE_COUNT)
    count = text.op(f"load i32, ptr {where}, align 4{unit.module.tag('#forcecount')}")
    apply, on = text.name("force"), text.name("on")
    text.choose(text.op(f"icmp ne i32 {count}, 0"), apply, on, UNLIKELY)
    text.begin(apply)
    text.do("call void @forces(ptr %img)")
    text.go(on)
    text.begin(on)


def _task(body: Body, task: Task, number: str) -> None:
    text = body.text
    due, on = text.name("due"), text.name("on")
    text.choose(_is_due(body, task, number), due, on)
    text.begin(due)
    for instance in task.programs:
        _program(body, instance)
    text.go(on)
    text.begin(on)


def _is_due(body: Body, task: Task, number: str) -> str:
    text, cyclic = body.text, "false"
    if task.every:
        cyclic = text.op(f"icmp eq i64 {text.op(f'urem i64 {number}, {task.every}')}, 0") if task.every > 1 else "true"
    if task.single is None or task.previous is None:
        return cyclic
    single = load(body, task.single).ssa
    where = address(body, task.previous)
    before = load(body, task.previous).ssa
    store(body, where, BOOL, Value(single, 0, 1))
    return text.op(f"select i1 {single}, i1 {text.op(f'xor i1 {before}, true')}, i1 {cyclic}")


def _program(body: Body, instance: ProgramInstance) -> None:
    body.run(instance.before)
    call = f"call i32 {body.unit.symbol(instance.pou)}(ptr %img, i64 {instance.offset})"
    body.text.check_status(body.text.op(call))
    body.run(instance.after)
