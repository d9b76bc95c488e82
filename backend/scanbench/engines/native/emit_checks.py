"""Subrange checks: a branch that is hardly ever taken, and a list in the image of what was found there."""

from scanbench.engines.native import emit_deferred
from scanbench.engines.native.emit_body import Body
from scanbench.engines.native.emit_function import UNLIKELY, Value
from scanbench.engines.native.emit_operators import convert, intrinsic
from scanbench.engines.native.emit_places import address
from scanbench.engines.native.emit_types import elementary, integer, value_type
from scanbench.engines.native.ranges import within
from scanbench.program.copies import BYTE_OFFSET
from scanbench.program.layout import Layout
from scanbench.program.program import Base, Limit, Place, Violates
from scanbench.program.types import ULINT, Elementary

LIST = "@violations"
"""The name of the number that holds the offset of the list in the image."""

LIST_TAG = "#violations"
"""Of the call that records: no variable of the program is touched by it, but those in the header, which have no tag."""

RECORD = """\
declare i32 @llvm.uadd.sat.i32(i32, i32)
declare i32 @llvm.umin.i32(i32, i32)
define internal void @violation(ptr nonnull %img, i64 %list, i32 %site, i64 %instance, i64 %value) noinline cold #0 {{
; finds the entry of the site and instance, or appends one; all counters saturate
entry:
  %errorat = getelementptr inbounds i8, ptr %img, i64 {error}
  store i8 1, ptr %errorat, align 1
  %countat = getelementptr inbounds i8, ptr %img, i64 {count}
  %count = load i32, ptr %countat, align 4
  %counted = call i32 @llvm.uadd.sat.i32(i32 %count, i32 1)
  store i32 %counted, ptr %countat, align 4
  %scanat = getelementptr inbounds i8, ptr %img, i64 {scan}
  %scan = load i64, ptr %scanat, align 8
  %head = getelementptr inbounds i8, ptr %img, i64 %list
  %used = load i32, ptr %head, align 4
  %within = call i32 @llvm.umin.i32(i32 %used, i32 {limit})
  %n = zext i32 %within to i64
  br label %next
next:
  %i = phi i64 [ 0, %entry ], [ %after, %other ]
  %start = mul i64 %i, {bytes}
  %payload = add i64 %start, 8
  %at = getelementptr inbounds i8, ptr %head, i64 %payload
  %timesat = getelementptr inbounds i8, ptr %at, i64 4
  %instanceat = getelementptr inbounds i8, ptr %at, i64 8
  %more = icmp ult i64 %i, %n
  br i1 %more, label %look, label %new
look:
  %itssite = load i32, ptr %at, align 4
  %itsinstance = load i64, ptr %instanceat, align 8
  %samesite = icmp eq i32 %itssite, %site
  %sameinstance = icmp eq i64 %itsinstance, %instance
  %same = and i1 %samesite, %sameinstance
  br i1 %same, label %again, label %other
other:
  %after = add i64 %i, 1
  br label %next
new:
  %full = icmp uge i64 %i, {limit}
  br i1 %full, label %drop, label %append
drop:
  %droppedat = getelementptr inbounds i8, ptr %head, i64 4
  %dropped = load i32, ptr %droppedat, align 4
  %lost = call i32 @llvm.uadd.sat.i32(i32 %dropped, i32 1)
  store i32 %lost, ptr %droppedat, align 4
  ret void
append:
  %narrow = trunc i64 %i to i32
  %grown = add i32 %narrow, 1
  store i32 %grown, ptr %head, align 4
  store i32 %site, ptr %at, align 4
  store i32 0, ptr %timesat, align 4
  store i64 %instance, ptr %instanceat, align 8
  %firstat = getelementptr inbounds i8, ptr %at, i64 24
  store i64 %scan, ptr %firstat, align 8
  %reservedat = getelementptr inbounds i8, ptr %at, i64 40
  store i64 0, ptr %reservedat, align 8
  br label %again
again:
  %times = load i32, ptr %timesat, align 4
  %oncemore = call i32 @llvm.uadd.sat.i32(i32 %times, i32 1)
  store i32 %oncemore, ptr %timesat, align 4
  %valueat = getelementptr inbounds i8, ptr %at, i64 16
  store i64 %value, ptr %valueat, align 8
  %lastat = getelementptr inbounds i8, ptr %at, i64 32
  store i64 %scan, ptr %lastat, align 8
  ret void
}}"""


def limit(body: Body, expr: Limit) -> Value:
    """The value within its bounds; what was outside is recorded."""
    type = elementary(expr.value.type)
    return convert(body, type, elementary(expr.type), _limited(body, expr, type))


def _limited(body: Body, expr: Limit, type: Elementary) -> Value:
    """The same in the type of the value, which may be wider."""
    name = value_type(type)
    value = body.scalar(expr.value)
    if within(value.range, (expr.low, expr.high)):
        return value
    text, bounds = body.text, (expr.low, expr.high)
    if body.farthest is not None:
        emit_deferred.note(body, _distance(body, value, type, expr.low), name, integer(expr.high - expr.low, type))
        if body.optimistic:
            return Value(value.ssa, *_brought(value, bounds))
        return within_bounds(body, value, type, bounds)
    outside = _outside(body, value, type, bounds)
    before, beyond, on = text.block, text.name("beyond"), text.name("on")
    text.choose(outside, beyond, on, UNLIKELY)
    text.begin(beyond)
    _record(body, value, type, expr.site)
    brought = within_bounds(body, value, type, (expr.low, expr.high))
    text.go(on)
    text.begin(on)
    ssa = text.op(f"phi {name} [ {value.ssa}, %{before} ], [ {brought.ssa}, %{beyond} ]")
    return Value(ssa, brought.low, brought.high)


def violates(body: Body, expr: Violates) -> Value:
    """Whether the value is outside; recorded if there is a site for it."""
    type = elementary(expr.value.type)
    value = body.scalar(expr.value)
    if within(value.range, (expr.low, expr.high)):
        return Value("false", 0, 0)
    outside = _outside(body, value, type, (expr.low, expr.high))
    if expr.site:
        text, beyond, on = body.text, body.text.name("beyond"), body.text.name("on")
        text.choose(outside, beyond, on, UNLIKELY)
        text.begin(beyond)
        _record(body, value, type, expr.site)
        text.go(on)
        text.begin(on)
    return Value(outside, 0, 1)


def within_bounds(body: Body, value: Value, type: Elementary, bounds: tuple[int, int]) -> Value:
    """The value, brought between bounds of its type."""
    low, high = bounds
    sign, name = "s" if type.signed else "u", value_type(type)
    raised = intrinsic(body, f"{sign}max", name, value.ssa, integer(low, type))
    ssa = intrinsic(body, f"{sign}min", name, raised, integer(high, type))
    return Value(ssa, *_brought(value, bounds))


def _brought(value: Value, bounds: tuple[int, int]) -> tuple[int, int]:
    low, high = bounds
    return min(max(value.low, low), high), min(max(value.high, low), high)


def _outside(body: Body, value: Value, type: Elementary, bounds: tuple[int, int]) -> str:
    """One comparison: below the lower bound the distance wraps, and is large."""
    low, high = bounds
    return body.text.op(f"icmp ugt {value_type(type)} {_distance(body, value, type, low)}, {integer(high - low, type)}")


def _distance(body: Body, value: Value, type: Elementary, low: int) -> str:
    return body.text.op(f"sub {value_type(type)} {value.ssa}, {integer(low, type)}") if low else value.ssa


def _record(body: Body, value: Value, type: Elementary, site: int) -> None:
    record = RECORD.format(
        error=Layout.SUBRANGE_ERROR,
        count=Layout.SUBRANGE_COUNT,
        scan=Layout.SCAN,
        limit=Layout.VIOLATION_LIMIT,
        bytes=Layout.VIOLATION_BYTES,
    )
    body.module.declare("@violation", record)
    wide = value.ssa
    if type.bits < 64:
        how = "sext" if type.signed else "zext"
        wide = body.text.op(f"{how} {value_type(type)} {value.ssa} to i64")
    number = str(site)
    if body.unit.has(body.pou):
        first = body.text.op(f"load i32, ptr {body.unit.symbol(body.pou).replace('p.', 'check.', 1)}, align 4")
        number = body.text.op(f"add i32 {first}, {site}")
    violations = body.text.op(f"load i64, ptr {LIST}, align 8")
    given = f"ptr {body.image}, i64 {violations}, i32 {number}, i64 {_instance(body)}, i64 {wide}"
    body.text.do(f"call void @violation({given}){body.module.tag(LIST_TAG)}")


def _instance(body: Body) -> str:
    """Where the instance begins whose body or method this is; 0 in a FUNCTION."""
    this = body.pou.this
    if this is None:
        return body.instance_offset
    slot = address(body, Place(ULINT, Base.FRAME, this.offset))
    whole = body.text.op(f"load i64, ptr {slot.pointer}, align 1{slot.tag}")
    return body.text.op(f"and i64 {whole}, {BYTE_OFFSET}")
