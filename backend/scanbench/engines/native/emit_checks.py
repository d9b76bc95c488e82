"""Subrange checks: a branch that is hardly ever taken, and a list in the image of what was found there."""

from scanbench.engines.native import emit_deferred
from scanbench.engines.native.emit_body import Body
from scanbench.engines.native.emit_function import UNLIKELY, Value
from scanbench.engines.native.emit_operators import convert, intrinsic
from scanbench.engines.native.emit_places import address, load, reference
from scanbench.engines.native.emit_types import elementary, integer, value_type
from scanbench.engines.native.ranges import within
from scanbench.program.copies import BYTE_OFFSET, DEEPEST
from scanbench.program.layout import Layout
from scanbench.program.program import Base, Limit, Place, Pou, Violates
from scanbench.program.types import ULINT, Elementary

LIST = "@violations"
"""The name of the number that holds the offset of the list in the image."""

COPIES = "@copies"
"""How many in-outs by value there are, and of each where its own variable begins and ends and where its slot is: `Copies`."""

LIST_TAG = "#violations"
"""Of the call that records: no variable of the program is touched by it, but those in the header, which have no tag."""

PATHS = "@paths"
"""The name of the number that holds the offset of the paths in the image."""

CALLERS = "@callers"
"""Of each call, by its number, where it is noted who called the POU that has it: `calling.callers`."""

RECORD = """\
declare void @llvm.memset.p0.i64(ptr, i8, i64, i1)
declare void @llvm.memmove.p0.p0.i64(ptr, ptr, i64, i1)
declare i32 @llvm.uadd.sat.i32(i32, i32)
declare i32 @llvm.umin.i32(i32, i32)
define internal void @violation(ptr nonnull %img, i64 %list, i32 %site, i64 %instance, i64 %value, i64 %more, i64 %called) noinline cold #0 {{
; finds the entry of the site, instance, variable and path, or appends one; all counters saturate
entry:
  %path = alloca [{levels} x i64], align 8
  call void @llvm.memset.p0.i64(ptr %path, i8 0, i64 {pathbytes}, i1 false)
  br label %walk
walk:
  %level = phi i64 [ 0, %entry ], [ %deeper, %above ]
  %slot = phi i64 [ %called, %entry ], [ %upper, %above ]
  %deeper = add i64 %level, 1
  %known = icmp ne i64 %slot, 0
  %room = icmp ult i64 %level, {levels}
  %noted = and i1 %known, %room
  br i1 %noted, label %caller, label %walked
caller:
  %slotat = getelementptr inbounds i8, ptr %img, i64 %slot
  %call = load i64, ptr %slotat, align 8
  %callnumber = and i64 %call, 4294967295
  %bysystem = icmp eq i64 %callnumber, 0
  br i1 %bysystem, label %walked, label %above
above:
  %levelat = getelementptr inbounds i64, ptr %path, i64 %level
  store i64 %call, ptr %levelat, align 8
  %upperat = getelementptr i32, ptr {callers}, i64 %callnumber
  %upper32 = load i32, ptr %upperat, align 4
  %upper = zext i32 %upper32 to i64
  br label %walk
walked:
  %paths = load i64, ptr {paths}, align 8
  %haspaths = icmp ne i64 %paths, 0
  %pathsinimage = getelementptr inbounds i8, ptr %img, i64 %paths
  %pathsat = select i1 %haspaths, ptr %pathsinimage, ptr %path
  %pathstep = select i1 %haspaths, i64 {pathbytes}, i64 0
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
  %i = phi i64 [ 0, %walked ], [ %after, %other ]
  %start = mul i64 %i, {bytes}
  %pathstart = mul i64 %i, %pathstep
  %itspath = getelementptr inbounds i8, ptr %pathsat, i64 %pathstart
  %payload = add i64 %start, 8
  %at = getelementptr inbounds i8, ptr %head, i64 %payload
  %timesat = getelementptr inbounds i8, ptr %at, i64 4
  %instanceat = getelementptr inbounds i8, ptr %at, i64 8
  %moreat = getelementptr inbounds i8, ptr %at, i64 40
  %left = icmp ult i64 %i, %n
  br i1 %left, label %look, label %new
look:
  %itssite = load i32, ptr %at, align 4
  %itsinstance = load i64, ptr %instanceat, align 8
  %samesite = icmp eq i32 %itssite, %site
  %sameinstance = icmp eq i64 %itsinstance, %instance
  %itsmore = load i64, ptr %moreat, align 8
  %differs = xor i64 %itsmore, %more
  %bound = and i64 %differs, {bound}
  %samebound = icmp eq i64 %bound, 0
  %sameplace = and i1 %sameinstance, %samebound
  %same = and i1 %samesite, %sameplace
  br i1 %same, label %compare, label %other
compare:
  %j = phi i64 [ 0, %look ], [ %j1, %equal ]
  %all = icmp uge i64 %j, {levels}
  br i1 %all, label %again, label %pair
pair:
  %itscallat = getelementptr inbounds i64, ptr %itspath, i64 %j
  %itscall = load i64, ptr %itscallat, align 8
  %owncallat = getelementptr inbounds i64, ptr %path, i64 %j
  %owncall = load i64, ptr %owncallat, align 8
  %samecall = icmp eq i64 %itscall, %owncall
  %j1 = add i64 %j, 1
  br i1 %samecall, label %equal, label %other
equal:
  br label %compare
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
  call void @llvm.memmove.p0.p0.i64(ptr %itspath, ptr %path, i64 {pathbytes}, i1 false)
  br label %again
again:
  %times = load i32, ptr %timesat, align 4
  %oncemore = call i32 @llvm.uadd.sat.i32(i32 %times, i32 1)
  store i32 %oncemore, ptr %timesat, align 4
  %valueat = getelementptr inbounds i8, ptr %at, i64 16
  store i64 %value, ptr %valueat, align 8
  store i64 %more, ptr %moreat, align 8
  %lastat = getelementptr inbounds i8, ptr %at, i64 32
  store i64 %scan, ptr %lastat, align 8
  ret void
}}"""


ACTUAL = """\
define internal i64 @violation.actual(ptr nonnull %img, i64 %first) noinline cold #0 {{
; the byte that this one is a copy of in the end
entry:
  %n = load i64, ptr {copies}, align 8
  br label %deeper
deeper:
  %at = phi i64 [ %first, %entry ], [ %moved, %go ]
  %deep = phi i64 [ 0, %entry ], [ %deeper.1, %go ]
  %deeper.1 = add i64 %deep, 1
  %ends = icmp uge i64 %deep, {deepest}
  br i1 %ends, label %done, label %next
next:
  %i = phi i64 [ 0, %deeper ], [ %after, %other ]
  %left = icmp ult i64 %i, %n
  br i1 %left, label %look, label %done
look:
  %row = mul i64 %i, 24
  %startat = getelementptr inbounds i8, ptr getelementptr (i8, ptr {copies}, i64 8), i64 %row
  %start = load i64, ptr %startat, align 8
  %endat = getelementptr inbounds i8, ptr %startat, i64 8
  %end = load i64, ptr %endat, align 8
  %distance = sub i64 %at, %start
  %length = sub i64 %end, %start
  %inside = icmp ult i64 %distance, %length
  br i1 %inside, label %found, label %other
other:
  %after = add i64 %i, 1
  br label %next
found:
  %slotat = getelementptr inbounds i8, ptr %startat, i64 16
  %slot = load i64, ptr %slotat, align 8
  %refat = getelementptr inbounds i8, ptr %img, i64 %slot
  %ref = load i64, ptr %refat, align 8
  %target = and i64 %ref, 4294967295
  %moved = add i64 %target, %distance
  %bound = icmp ne i64 %target, 0
  %plain = icmp ult i64 %ref, 34359738368
  %goes = and i1 %bound, %plain
  br i1 %goes, label %go, label %done
go:
  br label %deeper
done:
  ret i64 %at
}}"""


def limit(body: Body, expr: Limit) -> Value:
    """The value within its bounds; what was outside is recorded."""
    type = elementary(expr.value.type)
    return convert(body, type, elementary(expr.type), _limited(body, expr, type))


def _limited(body: Body, expr: Limit, type: Elementary) -> Value:
    """The same in the type of the value, which may be wider."""
    name = value_type(type)
    value = body.scalar(expr.value)
    if expr.site == 0 or within(value.range, (expr.low, expr.high)):
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
    _record(body, value, type, expr)
    brought = within_bounds(body, value, type, (expr.low, expr.high))
    recorded = text.block
    text.go(on)
    text.begin(on)
    ssa = text.op(f"phi {name} [ {value.ssa}, %{before} ], [ {brought.ssa}, %{recorded} ]")
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
        _record(body, value, type, expr)
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


def is_outside(body: Body, place: Place, low: int, high: int) -> str:
    """Whether a variable is outside of these bounds; nothing is recorded."""
    type = elementary(place.type)
    return _outside(body, load(body, place), type, (low, high))


def _distance(body: Body, value: Value, type: Elementary, low: int) -> str:
    return body.text.op(f"sub {value_type(type)} {value.ssa}, {integer(low, type)}") if low else value.ssa


def _record(body: Body, value: Value, type: Elementary, check: Limit | Violates) -> None:
    record = RECORD.format(
        error=Layout.SUBRANGE_ERROR,
        count=Layout.SUBRANGE_COUNT,
        scan=Layout.SCAN,
        limit=Layout.VIOLATION_LIMIT,
        bytes=Layout.VIOLATION_BYTES,
        bound=Layout.VIOLATION_BOUND,
        levels=Layout.PATH_LIMIT,
        pathbytes=8 * Layout.PATH_LIMIT,
        paths=PATHS,
        callers=CALLERS,
    )
    body.module.declare("@violation", record)
    number = str(check.site)
    if body.unit.has(body.pou):
        first = body.text.op(f"load i32, ptr {body.unit.symbol(body.pou).replace('p.', 'check.', 1)}, align 4")
        number = body.text.op(f"add i32 {first}, {check.site}")
    violations = body.text.op(f"load i64, ptr {LIST}, align 8")
    wide, more = _in_64_bits(body, value, type)
    if check.bound is not None:
        body.module.declare("@violation.actual", ACTUAL.format(copies=COPIES, deepest=DEEPEST))
        first = body.text.op(f"and i64 {reference(body, check.bound)}, {Layout.VIOLATION_BOUND}")
        actual = f"call i64 @violation.actual(ptr {body.image}, i64 {first})"
        more = body.text.op(f"or i64 {body.text.op(actual)}, {more}")
    given = f"i64 {violations}, i32 {number}, i64 {running(body)}, i64 {wide}, i64 {more}, i64 {body.pou.called_at}"
    body.text.do(f"call void @violation(ptr {body.image}, {given}){body.module.tag(LIST_TAG)}")


def _in_64_bits(body: Body, value: Value, type: Elementary) -> tuple[str, str]:
    """The number as an entry keeps it, and what the entry says of it."""
    text, name = body.text, value_type(type)
    if type.bits <= 64:
        how = "sext" if type.signed else "zext"
        return (value.ssa if type.bits == 64 else text.op(f"{how} {name} {value.ssa} to i64")), "0"
    near = within_bounds(body, value, type, (-(1 << 64) if type.signed else 0, (1 << 64) - 1)).ssa
    beyond = text.op(f"zext i1 {text.op(f'icmp ne {name} {near}, {value.ssa}')} to i64")
    upper = text.op(f"lshr {name} {near}, 64")
    sign = text.op(f"shl i64 {text.op(f'trunc {name} {upper} to i64')}, {Layout.VIOLATION_SIGN}")
    flags = text.op(f"or i64 {sign}, {text.op(f'shl i64 {beyond}, {Layout.VIOLATION_BEYOND}')}")
    wide = text.op(f"or i64 {flags}, {1 << Layout.VIOLATION_WIDE}")
    return text.op(f"trunc {name} {near} to i64"), wide


def note_call(body: Body, callee: Pou, site: int) -> None:
    """Writes down who calls, where that is wanted."""
    if not callee.called_at:
        return
    text, call = body.text, "0"
    if site and body.unit.has(body.pou):
        first = text.op(f"load i32, ptr {body.unit.symbol(body.pou).replace('p.', 'call.', 1)}, align 4")
        call = text.op(f"zext i32 {text.op(f'add i32 {first}, {site}')} to i64")
        if (instance := running(body)) != "0":
            call = text.op(f"or i64 {call}, {text.op(f'shl i64 {instance}, 32')}")
    where = text.address(body.image, callee.called_at)
    text.do(f"store i64 {call}, ptr {where}, align 8{body.module.tag(LIST_TAG)}")


def running(body: Body) -> str:
    """Where the instance begins whose body or method this is; 0 in a FUNCTION."""
    this = body.pou.this
    if this is None:
        return body.instance_offset
    slot = address(body, Place(ULINT, Base.FRAME, this.offset))
    whole = body.text.op(f"load i64, ptr {slot.pointer}, align 1{slot.tag}")
    return body.text.op(f"and i64 {whole}, {BYTE_OFFSET}")
