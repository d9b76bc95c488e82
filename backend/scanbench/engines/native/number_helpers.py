"""Helpers of the emitted code for numbers as text, in IR: written, and found in strings. See `string_helpers.py`."""

DECIMAL = """\
define internal i64 @s.decimal(ptr %to, i64 %value, i1 %minus) noinline #0 {
; writes the digits of an unsigned number, with a sign before them, and gives their count
entry:
  %digits = alloca [24 x i8], align 8
  br label %digit
digit:
  %rest = phi i64 [ %value, %entry ], [ %quotient, %digit ]
  %at = phi i64 [ 24, %entry ], [ %before, %digit ]
  %quotient = udiv i64 %rest, 10
  %tens = mul i64 %quotient, 10
  %units = sub i64 %rest, %tens
  %narrow = trunc i64 %units to i8
  %char = add i8 %narrow, 48
  %before = add i64 %at, -1
  %place = getelementptr i8, ptr %digits, i64 %before
  store i8 %char, ptr %place, align 1
  %more = icmp ne i64 %quotient, 0
  br i1 %more, label %digit, label %sign
sign:
  %signat = add i64 %before, -1
  %signplace = getelementptr i8, ptr %digits, i64 %signat
  store i8 45, ptr %signplace, align 1
  %start = select i1 %minus, i64 %signat, i64 %before
  %from = getelementptr i8, ptr %digits, i64 %start
  %n = sub i64 24, %start
  call void @s.copy(ptr %to, ptr %from, i64 %n)
  ret i64 %n
}"""

REAL_TEXT = """\
declare i32 @snprintf(ptr, i64, ptr, ...)
@s.format = private unnamed_addr constant [5 x i8] c"%.*g\\00"
define internal i64 @s.realtext(ptr %to, double %x, i64 %digits) noinline #0 {
; writes at most 32 characters and a zero; precision beyond 1000 digits shows nothing more
  %nan = fcmp uno double %x, 0.0
  br i1 %nan, label %isnan, label %number
isnan:
  store i8 110, ptr %to, align 1
  %a = getelementptr i8, ptr %to, i64 1
  store i8 97, ptr %a, align 1
  %n = getelementptr i8, ptr %to, i64 2
  store i8 110, ptr %n, align 1
  ret i64 3
number:
  %most = icmp sgt i64 %digits, 1000
  %high = select i1 %most, i64 1000, i64 %digits
  %least = icmp slt i64 %high, -1
  %low = select i1 %least, i64 -1, i64 %high
  %precision = trunc i64 %low to i32
  %written = call i32 (ptr, i64, ptr, ...) @snprintf(ptr %to, i64 33, ptr @s.format, i32 %precision, double %x)
  %cut = icmp sgt i32 %written, 32
  %count = select i1 %cut, i32 32, i32 %written
  %wide = sext i32 %count to i64
  ret i64 %wide
}"""

SCAN = """\
define internal i8 @s.at(ptr %a, i64 %n, i64 %i) alwaysinline #0 {
; the character at a position, or 0 after the end
  %in = icmp ult i64 %i, %n
  br i1 %in, label %read, label %end
read:
  %p = getelementptr i8, ptr %a, i64 %i
  %c = load i8, ptr %p, align 1
  ret i8 %c
end:
  ret i8 0
}
define internal i1 @s.isdigit(ptr %a, i64 %n, i64 %i) alwaysinline #0 {
  %c = call i8 @s.at(ptr %a, i64 %n, i64 %i)
  %d = sub i8 %c, 48
  %is = icmp ult i8 %d, 10
  ret i1 %is
}
define internal i64 @s.blanks(ptr %a, i64 %n) alwaysinline #0 {
; count of leading blanks
entry:
  br label %next
next:
  %i = phi i64 [ 0, %entry ], [ %after, %next ]
  %c = call i8 @s.at(ptr %a, i64 %n, i64 %i)
  %space = icmp eq i8 %c, 32
  %tab = icmp eq i8 %c, 9
  %blank = or i1 %space, %tab
  %after = add i64 %i, 1
  br i1 %blank, label %next, label %done
done:
  ret i64 %i
}
define internal i64 @s.sign(ptr %a, i64 %n, i64 %i) alwaysinline #0 {
; the position after a sign
  %c = call i8 @s.at(ptr %a, i64 %n, i64 %i)
  %plus = icmp eq i8 %c, 43
  %minus = icmp eq i8 %c, 45
  %is = or i1 %plus, %minus
  %step = zext i1 %is to i64
  %after = add i64 %i, %step
  ret i64 %after
}
define internal i64 @s.digits(ptr %a, i64 %n, i64 %i) alwaysinline #0 {
; the position after digits
entry:
  br label %next
next:
  %at = phi i64 [ %i, %entry ], [ %after, %next ]
  %is = call i1 @s.isdigit(ptr %a, i64 %n, i64 %at)
  %after = add i64 %at, 1
  br i1 %is, label %next, label %done
done:
  ret i64 %at
}"""

TO_INT = """\
declare { i64, i1 } @llvm.smul.with.overflow.i64(i64, i64)
declare { i64, i1 } @llvm.ssub.with.overflow.i64(i64, i64)
define internal i64 @s.toint(ptr %a, i64 %n) noinline #0 {
; counts down from zero, as the smallest number has no positive counterpart
entry:
  %from = call i64 @s.blanks(ptr %a, i64 %n)
  %c = call i8 @s.at(ptr %a, i64 %n, i64 %from)
  %minus = icmp eq i8 %c, 45
  %first = call i64 @s.sign(ptr %a, i64 %n, i64 %from)
  br label %next
next:
  %i = phi i64 [ %first, %entry ], [ %after, %add ]
  %sum = phi i64 [ 0, %entry ], [ %less, %add ]
  %is = call i1 @s.isdigit(ptr %a, i64 %n, i64 %i)
  br i1 %is, label %digit, label %done
digit:
  %d = call i8 @s.at(ptr %a, i64 %n, i64 %i)
  %units = sub i8 %d, 48
  %wide = zext i8 %units to i64
  %product = call { i64, i1 } @llvm.smul.with.overflow.i64(i64 %sum, i64 10)
  %tens = extractvalue { i64, i1 } %product, 0
  %over1 = extractvalue { i64, i1 } %product, 1
  br i1 %over1, label %saturate, label %subtract
subtract:
  %difference = call { i64, i1 } @llvm.ssub.with.overflow.i64(i64 %tens, i64 %wide)
  %less = extractvalue { i64, i1 } %difference, 0
  %over2 = extractvalue { i64, i1 } %difference, 1
  br i1 %over2, label %saturate, label %add
add:
  %after = add i64 %i, 1
  br label %next
saturate:
  %bound = select i1 %minus, i64 -9223372036854775808, i64 9223372036854775807
  ret i64 %bound
done:
  %smallest = icmp eq i64 %sum, -9223372036854775808
  %negated = sub i64 0, %sum
  %positive = select i1 %smallest, i64 9223372036854775807, i64 %negated
  %result = select i1 %minus, i64 %sum, i64 %positive
  ret i64 %result
}"""

TO_REAL = """\
declare double @strtod(ptr, ptr)
define internal double @s.toreal(ptr %a, i64 %n) noinline #0 {
; finds the longest prefix that is a number, and has libc convert a copy of just that
entry:
  %copy = alloca [32768 x i8], align 16
  %from = call i64 @s.blanks(ptr %a, i64 %n)
  %first = call i64 @s.sign(ptr %a, i64 %n, i64 %from)
  %whole = call i64 @s.digits(ptr %a, i64 %n, i64 %first)
  %count1 = sub i64 %whole, %first
  %c = call i8 @s.at(ptr %a, i64 %n, i64 %whole)
  %point = icmp eq i8 %c, 46
  %fractionat = add i64 %whole, 1
  %fractionend = call i64 @s.digits(ptr %a, i64 %n, i64 %fractionat)
  %fraction = sub i64 %fractionend, %fractionat
  %count2 = select i1 %point, i64 %fraction, i64 0
  %count = add i64 %count1, %count2
  %none = icmp eq i64 %count, 0
  br i1 %none, label %zero, label %number
number:
  %mantissa = select i1 %point, i64 %fractionend, i64 %whole
  %e = call i8 @s.at(ptr %a, i64 %n, i64 %mantissa)
  %lower = or i8 %e, 32
  %ise = icmp eq i8 %lower, 101
  %signat = add i64 %mantissa, 1
  %digitat = call i64 @s.sign(ptr %a, i64 %n, i64 %signat)
  %isdigit = call i1 @s.isdigit(ptr %a, i64 %n, i64 %digitat)
  %exponentend = call i64 @s.digits(ptr %a, i64 %n, i64 %digitat)
  %isexponent = and i1 %ise, %isdigit
  %end = select i1 %isexponent, i64 %exponentend, i64 %mantissa
  %size = sub i64 %end, %from
  %start = getelementptr i8, ptr %a, i64 %from
  call ptr @memcpy(ptr %copy, ptr %start, i64 %size)
  %zeroat = getelementptr i8, ptr %copy, i64 %size
  store i8 0, ptr %zeroat, align 1
  %result = call double @strtod(ptr %copy, ptr null)
  ret double %result
zero:
  ret double 0.0
}
declare ptr @memcpy(ptr, ptr, i64)"""
