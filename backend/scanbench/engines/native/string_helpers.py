"""Helpers of the emitted code for strings, in IR: copying, comparing, searching; the list has those for numbers, too.

Characters are given as a pointer and an i64 count; the length before them is the callers' business.
"""

from scanbench.engines.native.number_helpers import DECIMAL, REAL_TEXT, SCAN, TO_INT, TO_REAL

COPY = """\
declare ptr @memmove(ptr, ptr, i64)
define internal void @s.copy(ptr %to, ptr %from, i64 %n) noinline #0 {
; all loads come before the stores, so that the two may overlap
  %small = icmp ule i64 %n, 16
  br i1 %small, label %upto16, label %over16
upto16:
  %is8 = icmp uge i64 %n, 8
  br i1 %is8, label %from8, label %upto7
from8:
  %o8 = add i64 %n, -8
  %f8 = getelementptr i8, ptr %from, i64 %o8
  %t8 = getelementptr i8, ptr %to, i64 %o8
  %a8 = load i64, ptr %from, align 1
  %b8 = load i64, ptr %f8, align 1
  store i64 %a8, ptr %to, align 1
  store i64 %b8, ptr %t8, align 1
  ret void
upto7:
  %is4 = icmp uge i64 %n, 4
  br i1 %is4, label %from4, label %upto3
from4:
  %o4 = add i64 %n, -4
  %f4 = getelementptr i8, ptr %from, i64 %o4
  %t4 = getelementptr i8, ptr %to, i64 %o4
  %a4 = load i32, ptr %from, align 1
  %b4 = load i32, ptr %f4, align 1
  store i32 %a4, ptr %to, align 1
  store i32 %b4, ptr %t4, align 1
  ret void
upto3:
  %is1 = icmp ne i64 %n, 0
  br i1 %is1, label %from1, label %done
from1:
  %half = lshr i64 %n, 1
  %last = add i64 %n, -1
  %f1 = getelementptr i8, ptr %from, i64 %half
  %f2 = getelementptr i8, ptr %from, i64 %last
  %t1 = getelementptr i8, ptr %to, i64 %half
  %t2 = getelementptr i8, ptr %to, i64 %last
  %a1 = load i8, ptr %from, align 1
  %b1 = load i8, ptr %f1, align 1
  %c1 = load i8, ptr %f2, align 1
  store i8 %a1, ptr %to, align 1
  store i8 %b1, ptr %t1, align 1
  store i8 %c1, ptr %t2, align 1
  ret void
over16:
  %is32 = icmp ule i64 %n, 32
  br i1 %is32, label %from16, label %large
from16:
  %o16 = add i64 %n, -16
  %f16 = getelementptr i8, ptr %from, i64 %o16
  %t16 = getelementptr i8, ptr %to, i64 %o16
  %a16 = load <16 x i8>, ptr %from, align 1
  %b16 = load <16 x i8>, ptr %f16, align 1
  store <16 x i8> %a16, ptr %to, align 1
  store <16 x i8> %b16, ptr %t16, align 1
  ret void
large:
  call ptr @memmove(ptr %to, ptr %from, i64 %n)
  ret void
done:
  ret void
}"""

LENGTH = """\
declare ptr @memchr(ptr, i32, i64)
define internal i64 @s.length(ptr %a, i64 %n) #0 {
; characters before the first 0, at most %n
  %found = call ptr @memchr(ptr %a, i32 0, i64 %n)
  %none = icmp eq ptr %found, null
  %foundat = ptrtoint ptr %found to i64
  %aat = ptrtoint ptr %a to i64
  %distance = sub i64 %foundat, %aat
  %result = select i1 %none, i64 %n, i64 %distance
  ret i64 %result
}"""

ORDER = """\
declare i32 @memcmp(ptr, ptr, i64)
define internal i64 @s.order(ptr %a, i64 %n, ptr %b, i64 %m) #0 {
; negative, 0 or positive if the first string sorts before, equals, or sorts after the second
  %shorter = icmp ult i64 %n, %m
  %common = select i1 %shorter, i64 %n, i64 %m
  %found = call i32 @memcmp(ptr %a, ptr %b, i64 %common)
  %same = icmp eq i32 %found, 0
  %rest = sub i64 %n, %m
  %wide = sext i32 %found to i64
  %result = select i1 %same, i64 %rest, i64 %wide
  ret i64 %result
}"""

EQUAL = """\
define internal i1 @s.equal(ptr %a, i64 %n, ptr %b, i64 %m) #0 {
  %sized = icmp eq i64 %n, %m
  br i1 %sized, label %compare, label %no
compare:
  %small = icmp ult i64 %n, 8
  br i1 %small, label %bytes, label %words
words:
  %i = phi i64 [ 0, %compare ], [ %next, %more ]
  %left = sub i64 %n, %i
  %tail = icmp ult i64 %left, 8
  %atend = add i64 %n, -8
  %at = select i1 %tail, i64 %atend, i64 %i
  %ap = getelementptr i8, ptr %a, i64 %at
  %bp = getelementptr i8, ptr %b, i64 %at
  %av = load i64, ptr %ap, align 1
  %bv = load i64, ptr %bp, align 1
  %alike = icmp eq i64 %av, %bv
  br i1 %alike, label %more, label %no
more:
  %next = add i64 %i, 8
  %go = icmp ult i64 %next, %n
  br i1 %go, label %words, label %yes
bytes:
  %j = phi i64 [ 0, %compare ], [ %after, %step ]
  %end = icmp eq i64 %j, %n
  br i1 %end, label %yes, label %one
one:
  %cp = getelementptr i8, ptr %a, i64 %j
  %dp = getelementptr i8, ptr %b, i64 %j
  %cv = load i8, ptr %cp, align 1
  %dv = load i8, ptr %dp, align 1
  %both = icmp eq i8 %cv, %dv
  br i1 %both, label %step, label %no
step:
  %after = add i64 %j, 1
  br label %bytes
yes:
  ret i1 true
no:
  ret i1 false
}"""

ORDER_WIDE = """\
define internal i64 @s.orderwide(ptr %a, i64 %n, ptr %b, i64 %m) noinline #0 {
; the same for characters of two bytes
entry:
  %shorter = icmp ult i64 %n, %m
  %common = select i1 %shorter, i64 %n, i64 %m
  br label %next
next:
  %i = phi i64 [ 0, %entry ], [ %after, %same ]
  %end = icmp eq i64 %i, %common
  br i1 %end, label %lengths, label %look
look:
  %at = shl i64 %i, 1
  %ap = getelementptr i8, ptr %a, i64 %at
  %bp = getelementptr i8, ptr %b, i64 %at
  %av = load i16, ptr %ap, align 1
  %bv = load i16, ptr %bp, align 1
  %alike = icmp eq i16 %av, %bv
  br i1 %alike, label %same, label %differ
same:
  %after = add i64 %i, 1
  br label %next
differ:
  %wa = zext i16 %av to i64
  %wb = zext i16 %bv to i64
  %difference = sub i64 %wa, %wb
  ret i64 %difference
lengths:
  %rest = sub i64 %n, %m
  ret i64 %rest
}"""

WIDEN = """\
define internal void @s.widen(ptr noalias %to, ptr noalias %from, i64 %n) noinline #0 {
entry:
  br label %next
next:
  %i = phi i64 [ 0, %entry ], [ %after, %one ]
  %end = icmp eq i64 %i, %n
  br i1 %end, label %done, label %one
one:
  %p = getelementptr i8, ptr %from, i64 %i
  %c = load i8, ptr %p, align 1
  %wide = zext i8 %c to i16
  %at = shl i64 %i, 1
  %q = getelementptr i8, ptr %to, i64 %at
  store i16 %wide, ptr %q, align 1
  %after = add i64 %i, 1
  br label %next
done:
  ret void
}"""

NARROW = """\
define internal void @s.narrow(ptr noalias %to, ptr noalias %from, i64 %n) noinline #0 {
entry:
  br label %next
next:
  %i = phi i64 [ 0, %entry ], [ %after, %one ]
  %end = icmp eq i64 %i, %n
  br i1 %end, label %done, label %one
one:
  %at = shl i64 %i, 1
  %p = getelementptr i8, ptr %from, i64 %at
  %c = load i16, ptr %p, align 1
  %strange = icmp ugt i16 %c, 255
  %kept = select i1 %strange, i16 63, i16 %c
  %small = trunc i16 %kept to i8
  %q = getelementptr i8, ptr %to, i64 %i
  store i8 %small, ptr %q, align 1
  %after = add i64 %i, 1
  br label %next
done:
  ret void
}"""

_FIND = """\
define internal i64 @s.{name}(ptr %a, i64 %n, ptr %b, i64 %m) #0 {{
; position from 1 of the first %b in %a, or 0; counted in characters of {char}
  %empty = icmp eq i64 %m, 0
  %toolong = icmp ugt i64 %m, %n
  %never = or i1 %empty, %toolong
  br i1 %never, label %none, label %look
look:
{far}near:
  %last = sub i64 %n, %m
  %size = shl i64 %m, {shift}
  %first = load {char}, ptr %b, align 1
  br label %try
try:
  %i = phi i64 [ 0, %near ], [ %next, %miss ]
  %at = shl i64 %i, {shift}
  %p = getelementptr i8, ptr %a, i64 %at
  %c = load {char}, ptr %p, align 1
  %start = icmp eq {char} %c, %first
  br i1 %start, label %compare, label %miss
compare:
  %same = call i1 @s.equal(ptr %p, i64 %size, ptr %b, i64 %size)
  br i1 %same, label %found, label %miss
miss:
  %next = add i64 %i, 1
  %on = icmp sle i64 %next, %last
  br i1 %on, label %try, label %none
found:
  %position = add i64 %i, 1
  ret i64 %position
none:
  ret i64 0
}}"""
_FAR = """\
  %large = icmp ugt i64 %n, 64
  br i1 %large, label %far, label %near
far:
  %hit = call ptr @memmem(ptr %a, i64 %n, ptr %b, i64 %m)
  %missed = icmp eq ptr %hit, null
  %hitat = ptrtoint ptr %hit to i64
  %aat = ptrtoint ptr %a to i64
  %distance = sub i64 %hitat, %aat
  %farposition = add i64 %distance, 1
  %farresult = select i1 %missed, i64 0, i64 %farposition
  ret i64 %farresult
"""
"""Long texts are a matter for the C library, which knows none of wide characters."""
FIND = "declare ptr @memmem(ptr, i64, ptr, i64)\n" + _FIND.format(name="find", char="i8", shift=0, far=_FAR)
FIND_WIDE = _FIND.format(name="findwide", char="i16", shift=1, far="  br label %near\n")

HELPERS: dict[str, tuple[str, tuple[str, ...]]] = {
    "copy": (COPY, ()),
    "length": (LENGTH, ()),
    "order": (ORDER, ()),
    "equal": (EQUAL, ()),
    "orderwide": (ORDER_WIDE, ()),
    "find": (FIND, ("equal",)),
    "findwide": (FIND_WIDE, ("equal",)),
    "widen": (WIDEN, ()),
    "narrow": (NARROW, ()),
    "decimal": (DECIMAL, ("copy",)),
    "realtext": (REAL_TEXT, ()),
    "scan": (SCAN, ()),
    "toint": (TO_INT, ("scan",)),
    "toreal": (TO_REAL, ("scan",)),
}
"""Text of a helper, and the helpers it calls."""
