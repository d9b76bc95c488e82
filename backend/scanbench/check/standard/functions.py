"""The standard functions that ST cannot say: which arguments they take, and how `check/body/standard_calls.py` makes them.

Each row of `FUNCTIONS` is a signature: the names of the formal arguments (the last one again and again, counting on,
where it is `variadic`), and what is known of their types. `check/standard/*.st` holds those that ST can say.
"""

from dataclasses import dataclass

from scanbench.program.types import (
    DATE,
    DATE_AND_TIME,
    LDATE,
    LDATE_AND_TIME,
    LTIME,
    LTIME_OF_DAY,
    TIME,
    TIME_OF_DAY,
    Elementary,
    Kind,
)

NUMBERS = (Kind.INT, Kind.UINT, Kind.REAL)
REALS = (Kind.REAL,)
SIGNED = (*NUMBERS, Kind.TIME)
ORDERED = (*NUMBERS, Kind.BITS, Kind.BOOL, Kind.TIME, Kind.DATE, Kind.CHAR, Kind.STRING)


@dataclass(frozen=True, slots=True)
class Same:
    """All of `formals` and the result have one type; more than two are taken pairwise."""

    intrinsic: str
    formals: tuple[str, ...]
    kinds: tuple[Kind, ...]
    variadic: bool = False


@dataclass(frozen=True, slots=True)
class Shift:
    """A bit string and a count."""

    intrinsic: str
    formals: tuple[str, ...] = ("IN", "N")
    variadic: bool = False


@dataclass(frozen=True, slots=True)
class StringFunction:
    """`kinds`, one letter a formal: `s` a string (STRING or WSTRING, all alike) or a character, `n` an integer.

    `result`: `sum` of the capacities, `first`, or `INT`.
    """

    intrinsic: str
    formals: tuple[str, ...]
    kinds: str
    result: str
    variadic: bool = False


@dataclass(frozen=True, slots=True)
class Operator:
    """A function that does the same as an operator; `types` if its name determines them."""

    op: str
    formals: tuple[str, ...] = ("IN1", "IN2")
    variadic: bool = False
    types: tuple[Elementary, Elementary] | None = None


@dataclass(frozen=True, slots=True)
class Chain:
    """A comparison: `GT(a, b, c)` is `a > b AND b > c`."""

    op: str
    formals: tuple[str, ...] = ("IN1", "IN2")
    variadic: bool = True


@dataclass(frozen=True, slots=True)
class Special:
    """A function with a shape of its own; `says` is what it takes and gives, for the reference page."""

    formals: tuple[str, ...]
    says: str
    variadic: bool = False


Row = Same | Shift | StringFunction | Operator | Chain | Special


def _times() -> dict[str, Row]:
    """`ADD_TOD_TIME` and its like, on the short and the long types."""
    rows: dict[str, Row] = {}
    for long, (time, date, tod, moment) in (
        ("", (TIME, DATE, TIME_OF_DAY, DATE_AND_TIME)),
        ("L", (LTIME, LDATE, LTIME_OF_DAY, LDATE_AND_TIME)),
    ):
        for op in ("add", "sub"):
            rows[f"{op.upper()}_{long}TIME"] = Operator(op, types=(time, time))
            rows[f"{op.upper()}_{long}TOD_{long}TIME"] = Operator(op, types=(tod, time))
            rows[f"{op.upper()}_{long}DT_{long}TIME"] = Operator(op, types=(moment, time))
        for name, type in ((f"{long}DATE", date), (f"{long}TOD", tod), (f"{long}DT", moment)):
            rows[f"SUB_{name}_{name}"] = Operator("sub", types=(type, type))
        for op in ("mul", "div"):
            rows[f"{op.upper()}_{long}TIME"] = Special(("IN1", "IN2"), f"{time}, a number -> {time}")
    for op in ("MUL", "DIV"):
        says = f"TIME, a number -> TIME: the name of {op}_TIME in edition 2"
        rows[f"{op}TIME"] = Special(("IN1", "IN2"), says)
    return rows


FUNCTIONS: dict[str, Row] = {
    # numeric
    "ABS": Same("ABS", ("IN",), SIGNED),
    **{name: Same(name, ("IN",), REALS) for name in ("SQRT", "LN", "LOG", "EXP", "SIN", "COS", "TAN", "ASIN", "ACOS", "ATAN")},
    "ATAN2": Same("ATAN2", ("Y", "X"), REALS),
    # arithmetic
    "ADD": Operator("add", variadic=True),
    "MUL": Operator("mul", variadic=True),
    "SUB": Operator("sub"),
    "DIV": Operator("div"),
    "MOD": Operator("mod"),
    "EXPT": Operator("pow"),
    "MOVE": Special(("IN",), "any -> the same"),
    **_times(),
    # bits
    "SHL": Shift("SHL"),
    "SHR": Shift("SHR"),
    "ROL": Shift("ROL"),
    "ROR": Shift("ROR"),
    "AND": Operator("and", variadic=True),
    "OR": Operator("or", variadic=True),
    "XOR": Operator("xor", variadic=True),
    "NOT": Special(("IN",), "BOOL or bit string -> the same"),
    # selection
    "SEL": Special(("G", "IN0", "IN1"), "BOOL, any, any -> that type"),
    "MAX": Same("MAX", ("IN1", "IN2"), ORDERED, variadic=True),
    "MIN": Same("MIN", ("IN1", "IN2"), ORDERED, variadic=True),
    "LIMIT": Special(("MN", "IN", "MX"), "any elementary type or string -> the same"),
    "MUX": Special(("K", "IN0"), "integer, any, ... -> that type", variadic=True),
    # comparison
    "GT": Chain("gt"),
    "GE": Chain("ge"),
    "EQ": Chain("eq"),
    "LE": Chain("le"),
    "LT": Chain("lt"),
    "NE": Chain("ne", variadic=False),
    # strings
    "LEN": StringFunction("LEN", ("IN",), "s", "INT"),
    "LEFT": StringFunction("LEFT", ("IN", "L"), "sn", "first"),
    "RIGHT": StringFunction("RIGHT", ("IN", "L"), "sn", "first"),
    "MID": StringFunction("MID", ("IN", "L", "P"), "snn", "first"),
    "CONCAT": StringFunction("CONCAT", ("IN1", "IN2"), "ss", "sum", variadic=True),
    "INSERT": StringFunction("INSERT", ("IN1", "IN2", "P"), "ssn", "sum"),
    "DELETE": StringFunction("DELETE", ("IN", "L", "P"), "snn", "first"),
    "REPLACE": StringFunction("REPLACE", ("IN1", "IN2", "L", "P"), "ssnn", "sum"),
    "FIND": StringFunction("FIND", ("IN1", "IN2"), "ss", "INT"),
    # byte order and validity
    "TO_BIG_ENDIAN": Special(("IN",), "integer, bit string, character or time -> the same, bytes in reverse order"),
    "TO_LITTLE_ENDIAN": Special(("IN",), "integer, bit string, character or time -> the same"),
    "FROM_BIG_ENDIAN": Special(("IN",), "integer, bit string, character or time -> the same, bytes in reverse order"),
    "FROM_LITTLE_ENDIAN": Special(("IN",), "integer, bit string, character or time -> the same"),
    "IS_VALID": Special(("IN",), "REAL or LREAL -> BOOL: neither NaN nor infinite"),
    # the clock (vendors)
    "TIME": Special((), "-> TIME: the virtual time of the scan"),
    "LTIME": Special((), "-> LTIME: the virtual time of the scan"),
}  # fmt: skip

INTERNAL: dict[str, Row] = {
    "__CODE_AT": Special(("IN", "P"), "STRING, integer -> INT: code of the character there, or 0")
}
"""Known to the library's own ST only."""
