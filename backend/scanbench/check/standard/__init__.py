"""The standard library's lower half: intrinsics, which ST cannot say. The upper half is the `.st` files in this folder.

Integers: arguments and result have the same elementary type T unless stated. Strings are STRING (a byte a character) or
WSTRING (a UTF-16 unit a character), all of one call and its result of one width unless stated; s is a string of either;
lengths and positions are in characters, positions count from 1. Arguments are evaluated from left to right, all of them.
Real functions on REAL: computed in double by libm (or correctly rounded for sqrt), then rounded to single.

| name | arguments | rule |
|---|---|---|
| ABS | T number or TIME | two's complement: the smallest number stays; REAL clears the sign |
| SQRT LN LOG EXP SIN COS TAN ASIN ACOS ATAN | T real | libm; outside the domain NaN, poles and overflow give infinities |
| ATAN2 | T real y, T real x | libm atan2 |
| EXPT | T real, T real | libm pow |
| TRUNC | real -> integer T | towards zero, saturated at T, NaN is 0 |
| MIN MAX | T, T | any elementary T (integers, bits, CHAR, BOOL, TIME, DATE by their integer): plain; REAL: `a if a < b else b` (MIN), `a if a > b else b` (MAX) |
| MIN MAX | s, s | the same with strings by code as `Compare` has them |
| SEL | BOOL g, T a, T b | a when g is FALSE, else b; any elementary T |
| SEL | BOOL g, s a, s b | the same with strings |
| MUX | LINT k, T v0, T v1, ... | v[k], k < 0 is 0 and k beyond the last is the last; any elementary T; one value at least |
| MUX | LINT k, s v0, s v1, ... | the same with strings |
| SHL SHR | T bits, LINT n | 0 when n < 0 or n >= width; SHR fills with zeros |
| ROL ROR | T bits, LINT n | n modulo the width (mathematical, so never negative) |
| SWAP | T of 1, 2, 4, 8 bytes, no REAL | its bytes in reverse order |
| BITCAST | DWORD<->REAL, LWORD<->LREAL | same bits; of a NaN the canonical one |
| CLOCK | - -> TIME or LTIME | `Layout.CLOCK` of the image: the virtual time of this scan |
| LEN | s -> INT type | current length |
| LEFT RIGHT | s, LINT n | the first / last n characters; n < 0 is 0, n > length is all |
| MID | s, LINT n, LINT p | n characters from position p; p < 1 or p > length: empty |
| CONCAT | s, s | |
| INSERT | s, s2, LINT p | s2 after position p of s; p < 0 is 0, p > length is length |
| DELETE | s, LINT n, LINT p | without n characters from p; p < 1 or p > length or n <= 0: s |
| REPLACE | s, s2, LINT n, LINT p | n characters from p replaced by s2; p < 1 is taken as 1, p > length+1 as length+1, n < 0 as 0 |
| FIND | s, s2 -> INT type | position of the first s2 in s, 0 when there is none or s2 is empty |
| CHAR_AT | s, LINT p -> CHAR (of STRING), WCHAR (of WSTRING) | the character at p; 0 when p < 1 or p > length |
| CHAR_STR | CHAR -> STRING[1], WCHAR -> WSTRING[1] | that one character, also when it is 0 |
| RECODE | STRING -> WSTRING, WSTRING -> STRING | same length, same codes; a code beyond 255 becomes `?` (63) in a STRING |
| INT_TO_STR | LINT -> STRING[20] | decimal |
| UINT_TO_STR | ULINT -> STRING[20] | decimal |
| REAL_TO_STR | LREAL x, LINT d -> STRING[32] | C's `%.*g` with d digits; `nan`, `inf`, `-inf` |
| STR_TO_INT | STRING -> LINT | blanks, sign, digits; what follows is dropped; none: 0; saturated at LINT |
| STR_TO_REAL | STRING -> LREAL | blanks, sign, digits with point and exponent (longest prefix that reads so); none: 0; overflow: infinity |

LIMIT is MIN(MAX(MN, IN), MX), so MX wins where MN > MX, and a NaN gives MX.

The result of a string function has the capacity in `Intrinsic.type`, which is large enough for every result or the
largest a STRING can have; what is beyond is cut.
"""
