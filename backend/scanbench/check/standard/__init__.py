"""The standard library's lower half: intrinsics, which ST cannot say. The upper half is the `.st` files beside this one.

Integers: arguments and result have the same elementary type T unless stated. Strings are bytes, positions count from 1.
Real functions on REAL: computed in double by libm (or correctly rounded for sqrt), then rounded to single.

| name | arguments | rule |
|---|---|---|
| ABS | T number | two's complement: the smallest number stays; REAL clears the sign |
| SQRT LN LOG EXP SIN COS TAN ASIN ACOS ATAN | T real | libm; outside the domain NaN, poles and overflow give infinities |
| EXPT | T real, T real | libm pow |
| TRUNC | real -> integer T | towards zero, saturated, NaN is 0 |
| MIN MAX | T, T | numbers, bit strings, TIME (integers): plain; REAL: `a if a < b else b` (MIN), `a if a > b else b` (MAX) |
| SEL | BOOL g, T a, T b | a when g is FALSE, else b; both are evaluated; elementary T only |
| SHL SHR | T bits, LINT n | 0 when n < 0 or n >= width; SHR fills with zeros |
| ROL ROR | T bits, LINT n | n modulo the width (mathematical, so never negative) |
| BITCAST | DWORD<->REAL, LWORD<->LREAL | same bits; of a NaN the canonical one |
| CLOCK | - -> TIME | `Layout.CLOCK` of the image: the virtual time of this scan |
| LEN | s -> INT type | current length |
| LEFT RIGHT | s, LINT n | the first / last n characters; n < 0 is 0, n > length is all |
| MID | s, LINT n, LINT p | n characters from position p; p < 1 or p > length: empty |
| CONCAT | s, s | |
| INSERT | s, s2, LINT p | s2 behind position p of s; p < 0 is 0, p > length is length |
| DELETE | s, LINT n, LINT p | without n characters from p; p < 1 or p > length or n <= 0: s |
| REPLACE | s, s2, LINT n, LINT p | n characters from p replaced by s2; p < 1 is taken as 1, p > length+1 as length+1, n < 0 as 0 |
| FIND | s, s2 -> INT type | position of the first s2 in s, 0 when there is none or s2 is empty |
| INT_TO_STR | LINT -> STRING[20] | decimal |
| UINT_TO_STR | ULINT -> STRING[20] | decimal |
| REAL_TO_STR | LREAL x, LINT d -> STRING[32] | C's `%.*g` with d digits; `nan`, `inf`, `-inf` |
| STR_TO_INT | s -> LINT | blanks, sign, digits; what follows is dropped; none: 0; saturated at LINT |
| STR_TO_REAL | s -> LREAL | blanks, sign, digits with point and exponent (longest prefix that reads so); none: 0; overflow: infinity |

LIMIT is MIN(MAX(IN, MN), MX), evaluated in that order; MUX is a chain of SEL on its selector.

The result of a string function has the capacity in `Intrinsic.type`, which is large enough for every result or the
largest a STRING can have; what is beyond is cut.
"""
