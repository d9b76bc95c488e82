"""Debugged code: it counts statements and may halt before each, keeps a stack of frames, tells of reads and writes.

See `engines.debug`. Most of it is in helpers: they are a small module that is optimised, while the program's is not, so that
debugged code is made quickly. They share `STATE` with the engine.
"""

from collections.abc import Iterator
from contextlib import contextmanager

from scanbench.engines.debug import READ, WRITE
from scanbench.engines.native import emit_observed
from scanbench.engines.native.emit_body import Body, Unit
from scanbench.engines.native.emit_memory import Address
from scanbench.engines.native.emit_observed import Observing, site
from scanbench.program.program import Base, For, Place, Pou, Program, Stmt, While
from scanbench.program.tasks import ProgramInstance
from scanbench.program.types import Kind

STATE = "@debugged"
COUNT, WANTED, DEPTH, EVERY, SILENT, ARMED, SIZE = 0, 8, 16, 20, 21, 22, 24
FLAGS, LISTEN, FRAMES, BEGIN, STATEMENT, ACCESS, WAYS = range(32, 88, 8)
"""u64 statements begun in this scan, u64 the count to call at, u32 frames in use, u8 call at every statement, u8 what runs
is not the user's program, u8 any byte is listened for, u64 size of the image; pointers: u8 for each site, u8 for each byte
of the image, the frames (the first one is never in use), room for the image of the scan's beginning, the functions to call,
u8 for each way that a statement can go.
"""
STATE_BYTES = 88
FRAME_BYTES = 16
"""u32 number of the POU in the program, u32 site, u64 instance."""
HALTED = -1
"""The status of what is left because the hook halted; those of traps are positive."""

HELPERS = """\
{observed} = external global [{observed_bytes} x i8], align 8
{state} = external global [{state_bytes} x i8], align 8
declare void @llvm.memcpy.p0.p0.i64(ptr, ptr, i64, i1)

define void @debug.begin(ptr %img) {{
; a scan begins
  store i64 0, ptr {state}, align 8
  store i32 0, ptr {depth}, align 8
  %begin = load ptr, ptr {begin}, align 8
  %size = load i64, ptr {size}, align 8
  call void @llvm.memcpy.p0.p0.i64(ptr %begin, ptr %img, i64 %size, i1 false)
  ret void
}}
define void @debug.silent(i8 %silent) {{
  store i8 %silent, ptr {silent}, align 1
  ret void
}}
define ptr @debug.enter(i32 %pou, i64 %instance) {{
; gives the frame
  %frames = load ptr, ptr {frames}, align 8
  %silent = load i8, ptr {silent}, align 1
  %heard = icmp eq i8 %silent, 0
  br i1 %heard, label %push, label %none
none:
  ret ptr %frames
push:
  %depth = load i32, ptr {depth}, align 8
  %deeper = add i32 %depth, 1
  store i32 %deeper, ptr {depth}, align 8
  %wide = zext i32 %deeper to i64
  %distance = mul i64 %wide, {frame_bytes}
  %frame = getelementptr i8, ptr %frames, i64 %distance
  store i32 %pou, ptr %frame, align 8
  %siteat = getelementptr i8, ptr %frame, i64 4
  store i32 -1, ptr %siteat, align 4
  %instanceat = getelementptr i8, ptr %frame, i64 8
  store i64 %instance, ptr %instanceat, align 8
  ret ptr %frame
}}
define void @debug.leave() {{
  %silent = load i8, ptr {silent}, align 1
  %one = icmp eq i8 %silent, 0
  %depth = load i32, ptr {depth}, align 8
  %by = zext i1 %one to i32
  %left = sub i32 %depth, %by
  store i32 %left, ptr {depth}, align 8
  ret void
}}
define i1 @debug.statement(ptr %frame, i32 %site) {{
; the statement is about to begin; decides whether to halt before it
  %silent = load i8, ptr {silent}, align 1
  %heard = icmp eq i8 %silent, 0
  br i1 %heard, label %begins, label %on
begins:
  %siteat = getelementptr i8, ptr %frame, i64 4
  store i32 %site, ptr %siteat, align 4
  %wide = zext i32 %site to i64
  %marks = load ptr, ptr {marks}, align 8
  %markat = getelementptr i8, ptr %marks, i64 %wide
  store i8 1, ptr %markat, align 1
  %before = load i64, ptr {state}, align 8
  %count = add i64 %before, 1
  store i64 %count, ptr {state}, align 8
  %wanted = load i64, ptr {wanted}, align 8
  %reached = icmp eq i64 %count, %wanted
  %flags = load ptr, ptr {flags}, align 8
  %flagat = getelementptr i8, ptr %flags, i64 %wide
  %flag = load i8, ptr %flagat, align 1
  %every = load i8, ptr {every}, align 1
  %either = or i8 %flag, %every
  %told = icmp ne i8 %either, 0
  %call = or i1 %told, %reached
  br i1 %call, label %tell, label %on
tell:
  %depth = load i32, ptr {depth}, align 8
  %hook = load ptr, ptr {statement}, align 8
  %answer = call i32 %hook(i32 %site, i64 %count, i32 %depth)
  %halts = icmp ne i32 %answer, 0
  ret i1 %halts
on:
  ret i1 false
}}
define void @debug.way(i32 %way, i8 %gone) {{
; a statement goes this way
  %silent = load i8, ptr {silent}, align 1
  %mark = lshr i8 %gone, %silent
  %wide = zext i32 %way to i64
  %ways = load ptr, ptr {ways}, align 8
  %markat = getelementptr i8, ptr %ways, i64 %wide
  %before = load i8, ptr %markat, align 1
  %marked = or i8 %before, %mark
  store i8 %marked, ptr %markat, align 1
  ret void
}}
define void @debug.access(i64 %offset, i64 %size, i32 %site, i8 %how, i8 %mask) {{
; these bytes were read or written
  %armed = load i8, ptr {armed}, align 1
  %silent = load i8, ptr {silent}, align 1
  %any = icmp ugt i8 %armed, %silent
  br i1 %any, label %start, label %done
start:
  %map = load ptr, ptr {listen}, align 8
  %end = add i64 %offset, %size
  br label %next
next:
  %at = phi i64 [ %offset, %start ], [ %after, %on ]
  %more = icmp ult i64 %at, %end
  br i1 %more, label %byte, label %done
byte:
  %bitsat = getelementptr i8, ptr %map, i64 %at
  %bits = load i8, ptr %bitsat, align 1
  %both = and i8 %bits, %how
  %wanted = icmp ne i8 %both, 0
  br i1 %wanted, label %tell, label %on
on:
  %after = add i64 %at, 1
  br label %next
tell:
  %frames = load ptr, ptr {frames}, align 8
  %depth = load i32, ptr {depth}, align 8
  %wide = zext i32 %depth to i64
  %distance = mul i64 %wide, {frame_bytes}
  %frame = getelementptr i8, ptr %frames, i64 %distance
  %siteat = getelementptr i8, ptr %frame, i64 4
  store i32 %site, ptr %siteat, align 4
  %count = load i64, ptr {state}, align 8
  %hook = load ptr, ptr {access}, align 8
  %kind = zext i8 %how to i32
  %widemask = zext i8 %mask to i32
  %high = shl i32 %widemask, 8
  %both32 = or i32 %kind, %high
  call void %hook(i32 %site, i64 %count, i64 %offset, i64 %size, i32 %both32)
  ret void
done:
  ret void
}}
"""

DECLARATIONS = """\
declare void @debug.begin(ptr)
declare void @debug.silent(i8)
declare ptr @debug.enter(i32, i64)
declare void @debug.leave()
declare i1 @debug.statement(ptr, i32)
declare void @debug.way(i32, i8)
declare void @debug.access(i64, i64, i32, i8, i8)"""


class Debugging(Observing):
    """What the emitters of debugged code know of the program."""

    whole_image = True

    def __init__(self, program: Program) -> None:
        super().__init__(program)
        self._numbers = {pou: number for number, pou in enumerate(program.pous)}

    def declare(self, unit: Unit) -> None:
        super().declare(unit)
        unit.module.declare("@debug.begin", DECLARATIONS)
        unit.module.define(STATE, f"global [{STATE_BYTES} x i8] zeroinitializer, align 8")

    # ---- the scan ---------------------------------------------------------------------------------------------

    def begin(self, body: Body) -> None:
        body.text.do(f"call void @debug.begin(ptr {body.image})")

    def silence(self, body: Body, silent: bool) -> None:
        super().silence(body, silent)
        body.text.do(f"call void @debug.silent(i8 {int(silent)})")

    @contextmanager
    def joined(self, body: Body, instance: ProgramInstance) -> Iterator[None]:
        body.frame = body.text.op(self._enter(instance.pou, str(instance.offset)))
        yield
        body.text.do("call void @debug.leave()")

    # ---- statements and frames --------------------------------------------------------------------------------

    def enter(self, body: Body) -> None:
        if self.has_sites(body.pou):
            instance = "0" if body.pou.kind == "function" else "%self"
            body.text.entry.append(f"  {body.frame} = {self._enter(body.pou, instance)}")

    def leave(self, body: Body) -> None:
        if self.has_sites(body.pou):
            body.text.do("call void @debug.leave()")

    def _enter(self, pou: Pou, instance: str) -> str:
        return f"call ptr @debug.enter(i32 {self._numbers[pou]}, i64 {instance})"

    def begins(self, body: Body, site: int) -> None:
        halts = body.text.op(f"call i1 @debug.statement(ptr {body.frame}, i32 {site})")
        body.text.trap_status(halts, str(HALTED))

    def calls(self, body: Body, callee: Pou) -> None:
        super().calls(body, callee)
        if body.site is not None:  # which may be after others inside of it have run
            body.text.do(f"store i32 {body.site}, ptr {body.text.address(body.frame, 4)}, align 4")

    def tries(self, body: Body) -> str:
        return body.text.op(f"load i32, ptr getelementptr (i8, ptr {STATE}, i64 {DEPTH}), align 8")

    def caught(self, body: Body, known: str) -> None:
        # the frames of what it called are left
        body.text.do(f"store i32 {known}, ptr getelementptr (i8, ptr {STATE}, i64 {DEPTH}), align 8")

    @contextmanager
    def loop(self, body: Body, statement: Stmt) -> Iterator[None]:
        outer, body.idle = body.idle, body.text.alloca("i8")
        body.text.do(f"store i8 1, ptr {body.idle}, align 1")
        yield
        body.idle = outer

    def goes(self, body: Body, statement: Stmt, way: int) -> None:
        self._goes(body, statement, way, "1")
        if isinstance(statement, For | While):
            body.text.do(f"store i8 0, ptr {body.idle}, align 1")

    def ends(self, body: Body, statement: Stmt) -> None:
        self._goes(body, statement, 1, body.text.op(f"load i8, ptr {body.idle}, align 1"))

    def _goes(self, body: Body, statement: Stmt, way: int, gone: str) -> None:
        number = self.sites.outcome(statement, way)
        if number is not None:
            body.text.do(f"call void @debug.way(i32 {number}, i8 {gone})")

    # ---- accesses ---------------------------------------------------------------------------------------------

    def read(self, body: Body, place: Place, where: Address) -> None:
        super().read(body, place, where)
        self._access(body, place, where, READ)

    def written(self, body: Body, place: Place, where: Address) -> None:
        self._access(body, place, where, WRITE)

    def _access(self, body: Body, place: Place, where: Address, how: int) -> None:
        if self.unheard(body):
            return
        given = f"i64 {_offset(body, place, where)}, i64 {place.type.size}, i32 {site(body)}, i8 {how}, i8 {_bits(body, place, where)}"
        body.text.do(f"call void @debug.access({given})")


def helpers() -> str:
    """The module of the helpers: the same for all programs."""
    fields = {
        "depth": DEPTH, "begin": BEGIN, "size": SIZE, "silent": SILENT, "frames": FRAMES, "wanted": WANTED, "flags": FLAGS,
        "every": EVERY, "statement": STATEMENT, "armed": ARMED, "listen": LISTEN, "access": ACCESS, "ways": WAYS,
    }  # fmt: skip
    addresses = {name: f"getelementptr (i8, ptr {STATE}, i64 {offset})" for name, offset in fields.items()}
    return HELPERS.format(
        observed=emit_observed.STATE,
        observed_bytes=emit_observed.STATE_BYTES,
        state=STATE,
        state_bytes=STATE_BYTES,
        frame_bytes=FRAME_BYTES,
        marks=emit_observed.field(emit_observed.MARKS),
        **addresses,
    )


def _bits(body: Body, place: Place, where: Address) -> str:
    """Which bits of its byte it is about."""
    if place.type.kind is not Kind.BOOL or not where.bit:
        return "-1"
    return str((1 << int(where.bit) ^ 0x80) - 0x80) if where.bit.isdigit() else body.text.op(f"shl i8 1, {where.bit}")


def _offset(body: Body, place: Place, where: Address) -> str:
    text = body.text
    if place.slot is not None or place.reference is not None or place.indices:
        pointer, image = (text.op(f"ptrtoint ptr {each} to i64") for each in (where.pointer, body.image))
        return text.op(f"sub i64 {pointer}, {image}")
    if place.base is Base.SELF:
        return text.op(f"add i64 {body.self.offset}, {place.offset}")
    return str(place.offset + (body.pou.frame_offset if place.base is Base.FRAME else 0))
