"""What each function of the table does, in the form of the comments above the library's ST: sentences, then a line for each parameter
that they do not explain. The reference page, hovers and completions have them from here."""

_N = "- N: how many bits; where it is negative, or not less than the width, the result is 0"
_TURN = "- N: how many bits; a negative number turns the other way"
_L, _P = "- L: how many characters", "- P: the position of the first one, from 1"
_CHAIN = "\n- IN1, IN2: numbers, bit strings, times or texts, all of them of a common type"
_HERE = "IN as it is: a virtual PLC keeps the lowest byte first."

TEXTS = {
    # numeric
    "ABS": "The value IN without its sign. The smallest integer of a type, which has no positive counterpart, stays.",
    "SQRT": "The square root of IN; of a negative number NaN.",
    "LN": "The natural logarithm of IN; of a negative number NaN.",
    "LOG": "The logarithm of IN to base 10; of a negative number NaN.",
    "EXP": "The number e to the power of IN.",
    "SIN": "The sine of IN, an angle in radians.",
    "COS": "The cosine of IN, an angle in radians.",
    "TAN": "The tangent of IN, an angle in radians.",
    "ASIN": "The angle in radians whose sine is IN; NaN where IN is not from -1 to 1.",
    "ACOS": "The angle in radians whose cosine is IN; NaN where IN is not from -1 to 1.",
    "ATAN": "The angle in radians whose tangent is IN, from -pi/2 to pi/2.",
    "ATAN2": "The angle in radians from the X axis to the point (X, Y), from -pi to pi.",
    # arithmetic
    "ADD": "The sum of all arguments.",
    "MUL": "The product of all arguments.",
    "SUB": "The difference IN1 - IN2.",
    "DIV": "The quotient IN1 / IN2. Of integers and times the part after the point is cut; an integer division by zero is a run-time error.",
    "MOD": "The remainder of IN1 / IN2, with the sign of IN1; 0 where IN2 is 0.",
    "EXPT": "IN1 to the power of IN2.",
    "MOVE": "The value IN as it is.",
    # bits
    "SHL": f"IN moved to the left; zeros come in from the right.\n- IN: the bit string\n{_N}",
    "SHR": f"IN moved to the right; zeros come in from the left.\n- IN: the bit string\n{_N}",
    "ROL": f"IN moved to the left; what goes out there comes in from the right.\n- IN: the bit string\n{_TURN}",
    "ROR": f"IN moved to the right; what goes out there comes in from the left.\n- IN: the bit string\n{_TURN}",
    "AND": "AND of all arguments, bit by bit.",
    "OR": "OR of all arguments, bit by bit.",
    "XOR": "XOR of all arguments, bit by bit: whether an odd number of them is TRUE.",
    "NOT": "The bits of IN, each of them inverted.",
    # selection
    "SEL": "One of two values; both are computed.\n- G: which one\n- IN0: the result while G is FALSE\n- IN1: the result while G is TRUE",
    "MAX": "The largest of all arguments.",
    "MIN": "The smallest of all arguments.",
    "LIMIT": "IN, but not below MN and not above MX.\n- MN: the smallest result\n- IN: the value\n"
             "- MX: the largest result, also where MN is larger",
    "MUX": "One of several values; all are computed.\n- K: which one, from 0; beyond the last it is the last\n"
           "- IN0: the result while K is 0; IN1 that while K is 1, and so on",
    # comparison
    "GT": f"Whether each argument is greater than the next one.{_CHAIN}",
    "GE": f"Whether each argument is greater than the next one or equal.{_CHAIN}",
    "EQ": f"Whether all arguments are equal.{_CHAIN}",
    "LE": f"Whether each argument is less than the next one or equal.{_CHAIN}",
    "LT": f"Whether each argument is less than the next one.{_CHAIN}",
    "NE": f"Whether the arguments differ.{_CHAIN}",
    # strings
    "LEN": "How many characters the text IN has now.",
    "LEFT": f"The first characters of a text.\n- IN: the text\n{_L}; more than there are give all",
    "RIGHT": f"The last characters of a text.\n- IN: the text\n{_L}; more than there are give all",
    "MID": f"Some characters of a text.\n- IN: the text\n{_L}\n{_P}; where the text has none there, the result is empty",
    "CONCAT": "All arguments as one text, in their order.",
    "INSERT": "A text with a text put into it.\n- IN1: the text\n- IN2: what is put in\n- P: after which character of IN1; 0 is its beginning",
    "DELETE": f"A text without some of its characters.\n- IN: the text\n{_L}\n{_P}",
    "REPLACE": "A text with some of its characters replaced.\n- IN1: the text\n- IN2: what takes their place\n"
               f"{_L} of IN1 are replaced\n{_P}",
    "FIND": "The position of the first place where a text contains a text, from 1; 0 where it does not.\n- IN1: the text that is searched\n"
            "- IN2: what is looked for; an empty text is nowhere",
    # byte order and validity
    "TO_BIG_ENDIAN": "IN with its bytes in reverse order, as a device reads it that keeps the highest byte first.",
    "TO_LITTLE_ENDIAN": _HERE,
    "FROM_BIG_ENDIAN": "IN with its bytes in reverse order: the value that a device wrote that keeps the highest byte first.",
    "FROM_LITTLE_ENDIAN": _HERE,
    "IS_VALID": "Whether IN is a number: neither NaN nor infinite.",
    # the clock
    "TIME": "The virtual time of the scan, since the program started.",
    "LTIME": "The virtual time of the scan, since the program started, to the nanosecond.",
    # what takes no value
    "REF": "A reference to the variable that is given.",
    "ADR": "A pointer to the variable that is given.",
    "SIZEOF": "How many bytes the variable or type takes that is given.",
    "LOWER_BOUND": "The lowest index of an array, in the dimension that is given, from 1.",
    "UPPER_BOUND": "The highest index of an array, in the dimension that is given, from 1.",
    "EN_CHECK": "TRUE where the ENO that is given is FALSE; the place is noted then.",
    "SUBRANGE_ERROR": "TRUE where the last value for the variable that is given was outside its range.",
    "__ISVALIDREF": "Whether the reference that is given refers to something.",
}  # fmt: skip
