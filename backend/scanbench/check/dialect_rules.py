"""The rules of IEC 61131-3 that the dialects do not have, and the warning that names them."""

from scanbench.check.dialect import Allowance, Dialect, Rule

RULES: dict[Allowance, Rule] = {
    Allowance.BIT_NUMBERS: Rule(
        "BYTE, WORD, DWORD and LWORD as unsigned numbers, in calculations, comparisons, indices and counts",
        "a bit string is no number",
        "`UINT_TO_WORD(WORD_TO_UINT(w) + 1)`",
    ),
    Allowance.BIT_CONVERSION: Rule(
        "a bit string where an integer of the same or a larger size is wanted, and the other way round",
        "bit strings and integers are converted by name",
        "`i := WORD_TO_INT(w)`",
    ),
    Allowance.NARROWING: Rule(
        "an integer or bit string where a smaller one, or an integer with the other sign, is wanted: the low bits are taken",
        "only what loses nothing is converted without a name",
        "`i := DINT_TO_INT(d)`",
    ),
    Allowance.REAL_CONVERSION: Rule(
        "an LREAL, or a large integer, where a REAL is wanted: the nearest value is taken",
        "only what loses nothing is converted without a name",
        "`r := LREAL_TO_REAL(l)`",
    ),
    Allowance.BITS_AS_REALS: Rule(
        "a bit string where a REAL or LREAL is wanted: the nearest value of its number is taken",
        "bit strings and numbers are converted by name",
        "`r := UDINT_TO_REAL(DWORD_TO_UDINT(d))`",
    ),
    Allowance.SIGNED_BITS: Rule(
        "a signed integer where a larger bit string is wanted: it is extended by its sign",
        "bit strings and integers are converted by name",
        "`d := INT_TO_DWORD(i)`",
    ),
    Allowance.WRAPPED_REALS: Rule(
        "a REAL or LREAL beyond the limits of the integer that is wanted loses its upper bits",
        "only what loses nothing is converted without a name",
        "`i := DINT_TO_INT(REAL_TO_DINT(r))`",
    ),
    Allowance.TIME_NUMBERS: Rule(
        "a DINT, UDINT or DWORD as a TIME of so many milliseconds, and a TIME or TIME_OF_DAY as such a number",
        "a duration is no number",
        "`t := DINT_TO_TIME(d)`",
    ),
    Allowance.CHAR_NUMBERS: Rule(
        "a CHAR where a bit string or an integer is wanted, and a BYTE, WORD or integer where a CHAR is: its code is taken",
        "a character is no number",
        "`b := CHAR_TO_BYTE(c)`",
    ),
    Allowance.INTEGER_BITS: Rule(
        "AND, OR, XOR, NOT, SHL, ROL and ROR on integers, and SHR on unsigned ones",
        "these operations are for bit strings",
        "`WORD_TO_UINT(SHL(UINT_TO_WORD(u), 2))`",
    ),
    Allowance.ENUM_NUMBERS: Rule(
        "a number where a value of an enumeration is wanted",
        "an enumeration has only the values that it names",
        "`state := State#Ready`",
    ),
    Allowance.NUMBER_OF_BITS: Rule(
        "`DWORD_TO_REAL`, `REAL_TO_DWORD` and their like convert the number",
        "such conversions copy the bits",
        "`UDINT_TO_REAL(DWORD_TO_UDINT(d))`",
    ),
    Allowance.WIDE_RESULTS: Rule(
        "sums, differences and products of integers are computed in 64 bits, and cut where they are stored or converted",
        "their results have the type of their operands",
        "`INT_TO_DINT(i) + INT_TO_DINT(j)`",
    ),
    Allowance.STRING_FROM_ZERO: Rule(
        "characters of a string counted from 0, and read as BYTE or WORD",
        "the first character has number 1, and is a CHAR",
        "`s[i + 1]`",
    ),
    Allowance.STRING_BYTES: Rule(
        "a STRING as its bytes up to the first 16#00: written by index, and read and written by a POINTER TO BYTE",
        "a string has a length, and no bytes",
        "`s := REPLACE(s, 'x', 1, 3)`",
    ),
    Allowance.ARGUMENT_NAMES: Rule(
        "the vendor's names for the arguments of string functions: STR, STR1, STR2, SIZE, LEN, POS",
        "these arguments are IN, IN1, IN2, L and P",
        "`LEFT(IN := s, L := 3)`",
    ),
    Allowance.CHAINED_ASSIGNMENT: Rule(
        "several assignments in one, `a := b := c`",
        "an assignment has one variable",
        "`b := c; a := b;`",
    ),
    Allowance.ASSIGNED_VALUES: Rule(
        "an assignment as a value, `IF ready := (i = 3) THEN`",
        "an assignment is a statement, and has no value",
        "`ready := i = 3; IF ready THEN`",
    ),
    Allowance.CHAINED_APART: Rule(
        "variables of different types in several assignments in one, and an index that is assigned as well",
        "an assignment has one variable",
        "`b := c; a := b;`",
    ),
    Allowance.BIT_SUMS: Rule(
        "a sum, difference or product of bit strings where one of no more bits is wanted",
        "a bit string is no number",
        "`UDINT_TO_DWORD(DWORD_TO_UDINT(d) + 1)`",
    ),
    Allowance.INSTRUCTION_CALLS: Rule(
        "an instance of a timer or counter that is called by the name of its instruction, `timer.TON(...)`",
        "an instance is called by its own name",
        "`timer(IN := start, PT := T#1s)`",
    ),
    Allowance.INSTRUCTION_TYPES: Rule(
        "an instruction whose type is found by those of its arguments: NORM_X, SCALE_X, SWAP",
        "a function has the type that it is declared with",
        "`NORM_X_REAL(MIN := low, VALUE := x, MAX := high)`",
    ),
    Allowance.TRUE_TEXTS: Rule(
        "every REAL but 0.0 is TRUE as a BOOL, and of all texts 'TRUE' and 'true' alone",
        "a REAL is rounded before it becomes a BOOL, and the text '1' is TRUE as well",
        "`r <> 0.0`",
    ),
    Allowance.HALVES_AWAY: Rule(
        "`REAL_TO_INT` and the like round halves away from zero, and what is beyond the limits loses its upper bits",
        "halves are rounded to the even number, and what is beyond the limits is the nearest limit",
        "`REAL_TO_INT(LIMIT(-32768.0, r, 32767.0))`",
    ),
    Allowance.TEXT_NUMBERS: Rule(
        "a text with a base or with `_` as an integer, '16#1F' or '1_000', of which the low bits are taken",
        "a text is read as decimal digits, and what is beyond the limits is the nearest limit",
        "`STRING_TO_INT('31')`",
    ),
    Allowance.SIGNED_TEXTS: Rule(
        "`INT_TO_STRING` and the like begin with the sign, also with `+`",
        "a positive number has no sign in a text",
        "`CONCAT('+', INT_TO_STRING(i))`",
    ),
    Allowance.BLOCK_MOVES: Rule(
        "MOVE_BLK, FILL_BLK, SCATTER, GATHER, DEMUX, S_MOVE, S_CONV, STRG_VAL, VAL_STRG and PRESET_TIMER, which assign to what is at OUT",
        "only an assignment, or an output of a call, changes a variable",
        "`FOR i := 0 TO 3 DO b[i] := a[i]; END_FOR`",
    ),
    Allowance.VARIANTS: Rule(
        "`Variant`: an input that takes a variable of any type, with TypeOf, VariantGet, VariantPut, CountOfElements and the like",
        "a variable has the type of the input that it is passed to",
        "an input of the type that is passed, ARRAY[*] in VAR_IN_OUT",
    ),
    Allowance.INTEGER_SHIFTS: Rule(
        "SHL, SHR, ROL and ROR of integers; SHR of a signed one fills with its sign",
        "these operations are for bit strings",
        "`WORD_TO_INT(SHL(INT_TO_WORD(i), 2))`",
    ),
    Allowance.RETURN_CONDITION: Rule(
        "a condition after RETURN, `RETURN(done)`",
        "RETURN has none",
        "an IF around it, `IF done THEN RETURN; END_IF`",
    ),
    Allowance.BARE_CALLS: Rule(
        "a call of a method, action or function without parentheses, where it needs no arguments",
        "a call has parentheses",
        "`reset();`",
    ),
    Allowance.BLOCK_VARIABLES: Rule(
        "variables in VAR of a function block read from outside",
        "only inputs and outputs can be used there",
        "`VAR_OUTPUT`",
    ),
    Allowance.LIFE: Rule(
        "`FB_init`, `FB_reinit` and methods with the attribute `call_after_init` that run by themselves",
        "instances start with the initial values of their variables",
        "`unit : Unit := (limit := 5)`",
    ),
    Allowance.KEPT_VARIABLES: Rule(
        "VAR_INST in methods (kept by each instance), VAR_STAT in methods, functions and blocks (one for all)",
        "a FUNCTION and a METHOD keep nothing between calls",
        "a VAR of the block, a VAR_GLOBAL",
    ),
    Allowance.BLOCK_TEMPORARIES: Rule(
        "instances of blocks in FUNCTION, METHOD and VAR_TEMP, which are initialised at each call",
        "an instance keeps its state, so it is declared in the VAR of a block or program",
        "`VAR unit : Unit; END_VAR` in the block",
    ),
    Allowance.VENDOR_OPERATORS: Rule(
        "`__POUNAME()`, `__POSITION()`, `__VARINFO`, `__QUERYINTERFACE`, `__QUERYPOINTER`, `XSIZEOF`, `SIZEOF(POINTER TO INT)`, `ANY_TO_INT`",
        "there are no such operators",
        "`?=`, `SIZEOF(x)`, `TO_INT(x)`",
    ),
    Allowance.VENDOR_TYPES: Rule(
        "XINT, UXINT, XWORD (with `__` before them or not) and PVOID, as types of 64 bits; BIT, of which eight share a byte",
        "there are no such types",
        "LINT, ULINT, LWORD, POINTER TO, `AT %X0.3` in a STRUCT",
    ),
    Allowance.FINAL_INTERFACES: Rule(
        "FINAL before a method or property of an INTERFACE, which means nothing there",
        "nothing can override what is FINAL",
        "`METHOD start` without FINAL",
    ),
    Allowance.LABELS: Rule(
        "labels and `JMP label;` among the statements of a POU",
        "there are no jumps in Structured Text",
        "IF and loops",
    ),
    Allowance.ROUNDING: Rule(
        "a REAL or LREAL where an integer is wanted: the nearest one is taken, of two the even one",
        "only what loses nothing is converted without a name",
        "`d := REAL_TO_DINT(r)`",
    ),
    Allowance.DINT_RESULTS: Rule(
        "SINT, INT, USINT and UINT are calculated with as DINT (in AND, OR, XOR and NOT with zeros before their bits), and integers beside a REAL as REAL",
        "a result has the type that its operands have in common",
        "`INT_TO_DINT(i) + INT_TO_DINT(j)`",
    ),
    Allowance.LOCAL_ADDRESSES: Rule(
        "ADR and REF of variables of a FUNCTION or METHOD, and of VAR_TEMP: after the call they refer to what it left there",
        "a reference may not outlive what it refers to",
        "a VAR of the block, or a VAR_IN_OUT",
    ),
    Allowance.DIRECT_REFERENCES: Rule(
        "a variable as the argument or start value of what has the type REFERENCE TO, an instance as that of an INTERFACE, THIS as that of a pointer",
        "a reference is made by name",
        "`unit(r := REF(level))`",
    ),
    Allowance.POINTER_NUMBERS: Rule(
        "a pointer where an integer or a bit string of 64 or 32 bits is wanted, compared with one, and the other way round",
        "an address is no number",
        "POINTER TO",
    ),
    Allowance.ANY_INPUTS: Rule(
        "inputs of the type ANY, ANY_NUM and the like, which have the address (pValue), the size (diSize) and the TypeClass of a variable",
        "a FUNCTION with such inputs computes with the value, and has the type that is passed",
        "a VAR_IN_OUT",
    ),
    Allowance.WORD_COUNTERS: Rule("PV and CV of CTU, CTD, CTUD as WORD, 0 to 65535", "they are INT", "a CTU_UDINT"),
    Allowance.SHORT_TIMES: Rule(
        "TIME, TOD, DATE and DT as numbers of 32 bits without a sign, of milliseconds or seconds, which begin again at 0",
        "they have a sign, and go as far as 64 bits",
        "LTIME",
    ),
    Allowance.REAL_FUNCTIONS: Rule("SQRT, SIN and the like of integers", "they take reals", "`SQRT(INT_TO_LREAL(i))`"),
    Allowance.ALIKE_STRUCTURES: Rule("assignments of STRUCTs with the same members", "each is a type", "one TYPE"),
    Allowance.INSTANCE_COPIES: Rule(
        "an assignment of an instance of a block to one of the same block: all that it has is copied, pointers too",
        "an instance is never assigned",
        "assignments of what is to be copied",
    ),
    Allowance.PROGRAM_CALLS: Rule(
        "calls of a PROGRAM by other POUs, and its variables read there; without tasks in the project it then does not run by itself",
        "a task runs a PROGRAM, and nobody else sees it",
        "a FUNCTION_BLOCK, and an instance in VAR_GLOBAL",
    ),
    Allowance.HEAP: Rule(
        "`__NEW(type)`, `__NEW(type, count)`, `__DELETE(pointer)`, with the memory of the library `__HEAP`",
        "all memory is declared",
        "an ARRAY, and a number of how many of its elements are used",
    ),
    Allowance.UNLINKED_ADDRESSES: Rule(
        "`AT %I*`, `AT %Q*` and `AT %M*` for inputs, outputs, members of structures and instances of blocks",
        "only VAR and VAR_GLOBAL of elementary data wait for an address",
        "the variable without AT, and an assignment from one that has an address",
    ),
    Allowance.TRY: Rule(
        "`__TRY`, `__CATCH`, `__FINALLY`: a division by zero, an index outside and a pointer to nothing go on in the `__CATCH`",
        "such an error stops the program",
        "a condition before it, `IF divisor <> 0 THEN`",
    ),
    Allowance.GENERIC_CONSTANTS: Rule(
        "`VAR_GENERIC CONSTANT` of a block, whose values come with each instance, `buffer : Buffer<20>`",
        "a constant has one value",
        "a block for each value, or VAR_IN_OUT with ARRAY[*]",
    ),
    Allowance.SHORTER_STRINGS: Rule(
        "a STRING of fewer characters, or an array of them for ARRAY[*], for a VAR_IN_OUT of a FUNCTION or METHOD that only reads it",
        "a variable has the type of the in-out that it is passed to",
        "`VAR_IN_OUT CONSTANT`",
    ),
    Allowance.OVERLOADS: Rule(
        "several FUNCTIONs or methods of one name, with inputs of different types: a call is of the one that its arguments fit best",
        "a name is declared once",
        "a name for each of them",
    ),
    Allowance.COMBINED_ASSIGNMENT: Rule(
        "`x += 1`, and the same with `-`, `*` and `/`",
        "an assignment has the operator `:=`",
        "`x := x + 1`",
    ),
    Allowance.BLOCK_WRITES: Rule(
        "variables in VAR and outputs of a function block written from outside",
        "only its inputs are assigned there",
        "`VAR_INPUT`",
    ),
    Allowance.TEXT_STRUCTURES: Rule(
        "texts that are a structure of LEN and DATA in comparisons",
        "structures are not compared",
        "`Logix.COMPARE(a, b) = 0`",
    ),
    Allowance.ACTION_ARGUMENTS: Rule(
        "inputs and outputs of a block in the call of its ACTION, `table.Add(key := 3, ok => done)`",
        "an ACTION has no arguments",
        "`table.key := 3;` before it, and `done := table.ok;` after it",
    ),
    Allowance.OUTSIDE_PARTS: Rule(
        "variables of a PROGRAM, and parts of the structures and blocks in a block, written from outside",
        "only inputs of a block are assigned from outside",
        "`VAR_INPUT`",
    ),
    Allowance.TEXT_CASES: Rule(
        "CASE of a STRING or a CHAR, with texts as labels, and ranges of characters",
        "CASE chooses by an integer or an enumeration",
        "`IF text = 'on' THEN`",
    ),
    Allowance.RECURSION: Rule(
        "FUNCTIONs and methods that call themselves, at most 100 deep",
        "no POU leads to itself",
        "a loop, with an ARRAY of what is still to be done",
    ),
    Allowance.LITERAL_VALUES: Rule(
        "`numbers := [1, 2, 3(0)]` and `point := (x := 1, y := 2)` among the statements; what is left out has the start value of its type",
        "only a declaration gives all values of an array or structure",
        "`numbers[1] := 1; numbers[2] := 2;`",
    ),
    Allowance.ADDRESS_OPERATOR: Rule("`&x` as the address of a variable", "`&` joins two operands, as AND", "`REF(x)`"),
    Allowance.OPEN_REFERENCES: Rule(
        "REF_TO ARRAY[*]: a reference to an array of any size, with its bounds",
        "what is referred to has a size",
        "`REF_TO ARRAY[0..9] OF INT`",
    ),
    Allowance.OPEN_INPUTS: Rule("inputs ARRAY[*] that are written", "an input is not written", "`VAR_IN_OUT`"),
    Allowance.SETTING_LISTS: Rule("VAR_CONFIG outside of a CONFIGURATION", "it is a part of one", "VAR_CONFIG in it"),
    Allowance.COUNTER_WRITES: Rule(
        "assignments to the counter of a FOR loop inside of it, by `:=`, `=>` or an in-out: after each round the step is added to what it then is",
        "only the loop changes its counter",
        "`EXIT`, or a WHILE loop",
    ),
    Allowance.MIXED_ARGUMENTS: Rule(
        "arguments by position after some by name: they go to those that have no name in the call, in their order",
        "arguments have names, or are all in their order",
        "`fill(level := 3, time := t)`",
    ),
    Allowance.REAL_MOD: Rule(
        "MOD of REALs: what is left of a division whose quotient is cut to a whole number",
        "MOD is for integers",
        "`r - DINT_TO_REAL(TRUNC(r / s)) * s`",
    ),
    Allowance.LITERAL_SIZES: Rule(
        "a number beside a smaller bit string: it has the smallest type that holds it",
        "a number has the type of the bit string beside it",
        "`b XOR WORD#16#1FF`",
    ),
    Allowance.FOR_ENDS: Rule(
        "the end value and the step of a FOR loop that are computed for each round",
        "they are computed once, as the loop begins",
        "`last := n; FOR i := 1 TO last`",
    ),
    Allowance.START_EXPRESSIONS: Rule(
        "a start value that is computed: in a FUNCTION or METHOD at each call, else when the instance is initialised",
        "a start value is a constant",
        "an assignment in the body",
    ),
}


def said(dialect: Dialect, allowance: Allowance, what: str, instead: str = "") -> str:
    """The warning of something that only the dialect allows. `what` is it, `instead` the strict way to write it."""
    rule = RULES[allowance]
    return (
        f"{what}. {dialect.title} allows this; in IEC 61131-3 {rule.strict}. The strict way: {instead or rule.instead}."
    )
