"""The loop that runs scans at a pace, in IR: one module for all programs, which a process compiles once.

It sleeps once for each scan: until the deadline, or until somebody interrupts. On Linux that is one wait on the interrupt itself
(a futex); elsewhere it sleeps in slices, and looks.
"""

import platform
import sys

from scanbench.engines.native.emit_module import ATTRIBUTES, UNLIKELY_BRANCH
from scanbench.program.layout import Layout

DONE, INTERRUPTED, TRAP, ASKED, CONDITION = 0, 1, 2, 3, 4
"""What the loop returns."""

SLICE_NS = 2_000_000
"""Longest sleep between two looks at the interrupt, where nothing can wake the loop."""
LATE_PERIODS = 10
LATE_NS = 100_000_000
"""A deadline that is more than both of these in the past is moved to now."""

_FUTEX_NUMBERS = {"x86_64": 202, "aarch64": 98, "riscv64": 98}
FUTEX = _FUTEX_NUMBERS.get(platform.machine()) if sys.platform == "linux" else None
"""Number of the system call; None where there is none."""
FUTEX_WAKE_PRIVATE = 1 | 128
_FUTEX_WAIT_BITSET_PRIVATE = 9 | 128
_ANY_BIT = 0xFFFF_FFFF
_PR_SET_TIMERSLACK = 29

SLEEP_ON_INTERRUPT = """\
declare i64 @syscall(i64, ...) nounwind
declare i32 @prctl(i32, ...) nounwind

define internal void @prepare() noinline #0 {{
; the kernel may not put off this thread's waking, by 50 us otherwise, to wake others at the same time
  %ok = call i32 (i32, ...) @prctl(i32 {timer_slack}, i64 1, i64 0, i64 0, i64 0)
  ret void
}}

define internal void @sleep(ptr %ctl, i64 %now, i64 %deadline) noinline #0 {{
; until the deadline, unless there is an interrupt, or one comes; a signal may end it, too
  %time = alloca {{ i64, i64 }}, align 8
  %s = sdiv i64 %deadline, 1000000000
  %scaled = mul i64 %s, 1000000000
  %ns = sub i64 %deadline, %scaled
  store i64 %s, ptr %time, align 8
  %nsat = getelementptr i8, ptr %time, i64 8
  store i64 %ns, ptr %nsat, align 8
  %ok = call i64 (i64, ...) @syscall(i64 {futex}, ptr %ctl, i64 {wait}, i64 0, ptr %time, ptr null, i64 {any_bit})
  ret void
}}
"""

SLEEP_IN_SLICES = """\
declare i32 @clock_nanosleep(i32, i32, ptr, ptr) nounwind

define internal void @prepare() noinline #0 {{
  ret void
}}

define internal void @sleep(ptr %ctl, i64 %now, i64 %deadline) noinline #0 {{
; until the deadline, but not for long: the caller looks whether somebody interrupted
  %time = alloca {{ i64, i64 }}, align 8
  %slice = add i64 %now, {slice}
  %until = call i64 @llvm.smin.i64(i64 %slice, i64 %deadline)
  %s = sdiv i64 %until, 1000000000
  %scaled = mul i64 %s, 1000000000
  %ns = sub i64 %until, %scaled
  store i64 %s, ptr %time, align 8
  %nsat = getelementptr i8, ptr %time, i64 8
  store i64 %ns, ptr %nsat, align 8
  %ok = call i32 @clock_nanosleep(i32 1, i32 1, ptr %time, ptr null)
  ret void
}}
"""

WAITING = """\
declare i32 @clock_gettime(i32, ptr) nounwind willreturn memory(argmem: readwrite, inaccessiblemem: readwrite)
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

define internal i64 @waitfor(ptr %ctl, ptr noalias %pace) noinline #0 {{
; sleeps until the deadline; gives the time, or -1 when somebody interrupted. Notes how late it is
entry:
  %period = load i64, ptr %pace, align 8
  %deadlineat = getelementptr i8, ptr %pace, i64 8
  %deadline = load i64, ptr %deadlineat, align 8
  br label %look
look:
  %interrupt = load volatile i32, ptr %ctl, align 8
  %interrupted = icmp ne i32 %interrupt, 0
  br i1 %interrupted, label %leave, label %time
time:
  %now = call i64 @now()
  %early = icmp slt i64 %now, %deadline
  br i1 %early, label %sleep, label %start
sleep:
  call void @sleep(ptr %ctl, i64 %now, i64 %deadline)
  br label %look
start:
  %lateness = sub i64 %now, %deadline
  %missed = icmp sgt i64 %lateness, %period
  %one = zext i1 %missed to i64
  %missesat = getelementptr i8, ptr %pace, i64 48
  %misses = load i64, ptr %missesat, align 8
  %newmisses = add i64 %misses, %one
  store i64 %newmisses, ptr %missesat, align 8
  %periods = mul i64 %period, {late_periods}
  %tolerated = call i64 @llvm.smax.i64(i64 %periods, i64 {late_ns})
  %lost = icmp sgt i64 %lateness, %tolerated
  %from = select i1 %lost, i64 %now, i64 %deadline
  store i64 %from, ptr %deadlineat, align 8
  %lateat = getelementptr i8, ptr %pace, i64 16
  %sum = load i64, ptr %lateat, align 8
  %newsum = add i64 %sum, %lateness
  store i64 %newsum, ptr %lateat, align 8
  %worstat = getelementptr i8, ptr %pace, i64 24
  %worst = load i64, ptr %worstat, align 8
  %newworst = call i64 @llvm.smax.i64(i64 %worst, i64 %lateness)
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
"""

APPLY_FORCES = """\
declare i32 @llvm.umin.i32(i32, i32)

define void @"loop.forces"(ptr %img, i64 %note, i32 %size) cold minsize optsize #0 {{
; byte = byte & ~mask | value & mask, for every entry in use whose byte there is (an image may come from a file); what it was
; is kept in the entry, at its byte %note
entry:
  %countat = getelementptr inbounds i8, ptr %img, i64 {count}
  %count = load i32, ptr %countat, align 4
  %limited = call i32 @llvm.umin.i32(i32 %count, i32 {limit})
  %n = zext i32 %limited to i64
  br label %next
next:
  %i = phi i64 [ 0, %entry ], [ %after, %apply ], [ %skipped, %one ]
  %more = icmp ult i64 %i, %n
  br i1 %more, label %one, label %done
one:
  %start = mul i64 %i, 8
  %at = add i64 %start, {table}
  %entryat = getelementptr inbounds i8, ptr %img, i64 %at
  %offset = load i32, ptr %entryat, align 8
  %skipped = add i64 %i, 1
  %inside = icmp ult i32 %offset, %size
  br i1 %inside, label %apply, label %next
apply:
  %maskat = getelementptr inbounds i8, ptr %entryat, i64 4
  %mask = load i8, ptr %maskat, align 1
  %valueat = getelementptr inbounds i8, ptr %entryat, i64 5
  %value = load i8, ptr %valueat, align 1
  %wide = zext i32 %offset to i64
  %byteat = getelementptr inbounds i8, ptr %img, i64 %wide
  %byte = load i8, ptr %byteat, align 1
  %noteat = getelementptr inbounds i8, ptr %entryat, i64 %note
  store i8 %byte, ptr %noteat, align 1
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
"""

RUN = """\
define i32 @"loop.run"(ptr noalias nonnull noundef align 8 %img, ptr %ctl, i64 %scans, ptr noalias %pace) #0 {{
; %ctl: u32 interrupt, +8 i64 trap, +16 the condition: i32 (ptr image), or null,
; +24 what samples: void (ptr image, ptr table, ptr ctl), or null, +32 its table, +40 the scan: i32 (ptr image)
; %pace: i64 period, deadline, late, worst, busy, scans, misses; null when nothing is to be measured
entry:
  %conditionat = getelementptr i8, ptr %ctl, i64 16
  %condition = load ptr, ptr %conditionat, align 8
  %conditional = icmp ne ptr %condition, null
  %sampleat = getelementptr i8, ptr %ctl, i64 24
  %sample = load ptr, ptr %sampleat, align 8
  %sampling = icmp ne ptr %sample, null
  %tableat = getelementptr i8, ptr %ctl, i64 32
  %table = load ptr, ptr %tableat, align 8
  %scanat = getelementptr i8, ptr %ctl, i64 40
  %scan = load ptr, ptr %scanat, align 8
  %measured = icmp ne ptr %pace, null
  br i1 %measured, label %paces, label %head
paces:
  %period = load i64, ptr %pace, align 8
  %slow = icmp sgt i64 %period, 0
  br i1 %slow, label %prepared, label %whole
prepared:
  call void @prepare()
  br label %head
whole:
  %began = call i64 @now()
  br label %head
head:
  %paced = phi i1 [ false, %entry ], [ true, %prepared ], [ false, %whole ], [ %paced, %on ]
  %around = phi i1 [ false, %entry ], [ false, %prepared ], [ true, %whole ], [ %around, %on ]
  %since = phi i64 [ 0, %entry ], [ 0, %prepared ], [ %began, %whole ], [ %since, %on ]
  %k = phi i64 [ 0, %entry ], [ 0, %prepared ], [ 0, %whole ], [ %k1, %on ]
  %interrupt = load volatile i32, ptr %ctl, align 8
  %interrupted = icmp ne i32 %interrupt, 0
  br i1 %interrupted, label %leave, label %look, !prof !0
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
  %status = call i32 %scan(ptr %img) nounwind willreturn
  %bad = icmp ne i32 %status, 0
  br i1 %bad, label %trapped, label %good, !prof !0
good:
  br i1 %paced, label %noted, label %counted
noted:
  call void @note(ptr %pace, i64 %at, i64 1)
  br label %counted
counted:
  %k1 = add nsw i64 %k, 1
  br i1 %sampling, label %row, label %judge
row:
  call void %sample(ptr %img, ptr %table, ptr %ctl) nounwind willreturn
  br label %judge
judge:
  br i1 %conditional, label %evaluate, label %requests
evaluate:
  %value = call i32 %condition(ptr %img) nounwind willreturn
  %holds = icmp ne i32 %value, 0
  br i1 %holds, label %leave, label %requests, !prof !0
requests:
  %askedat = getelementptr inbounds i8, ptr %img, i64 {asked_count}
  %count = load i32, ptr %askedat, align 4
  %asked = icmp ne i32 %count, 0
  br i1 %asked, label %leave, label %on, !prof !0
on:
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
  %reason = phi i32 [ {interrupted}, %head ], [ {done}, %look ], [ {interrupted}, %wait ], [ {asked}, %requests ], \
[ {condition}, %evaluate ], [ {trap}, %trapped ], [ {trap}, %notedtrap ]
  %ran = phi i64 [ %k, %head ], [ %k, %look ], [ %k, %wait ], [ %k1, %requests ], [ %k1, %evaluate ], [ %k, %trapped ], \
[ %k, %notedtrap ]
  br i1 %around, label %sum, label %out
sum:
  call void @note(ptr %pace, i64 %since, i64 %ran)
  br label %out
out:
  store volatile i32 0, ptr %ctl, align 8
  ret i32 %reason
}}"""


RUN_NAME, FORCES_NAME = "loop.run", "loop.forces"
"""What `RUN` and `APPLY_FORCES` define."""


def module() -> str:
    """The same for all programs, so that a process compiles it once: a program brings its scan."""
    waiting = WAITING.format(late_periods=LATE_PERIODS, late_ns=LATE_NS)
    forces = APPLY_FORCES.format(count=Layout.FORCE_COUNT, table=Layout.FORCES, limit=Layout.FORCE_LIMIT)
    run = RUN.format(
        asked_count=Layout.ASKED_COUNT,
        done=DONE,
        interrupted=INTERRUPTED,
        trap=TRAP,
        asked=ASKED,
        condition=CONDITION,
    )
    return "\n".join([waiting, _sleep(), forces, run, ATTRIBUTES, f"!0 = {UNLIKELY_BRANCH}", ""])


def _sleep() -> str:
    if FUTEX is None:
        return SLEEP_IN_SLICES.format(slice=SLICE_NS)
    return SLEEP_ON_INTERRUPT.format(
        futex=FUTEX, wait=_FUTEX_WAIT_BITSET_PRIVATE, any_bit=_ANY_BIT, timer_slack=_PR_SET_TIMERSLACK
    )
