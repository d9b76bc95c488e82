"""The standard functions that ST cannot say: which arguments they take, and which intrinsic they become.

Each row of `FUNCTIONS` is a signature: the names of the formal arguments and how they are typed.

- `same`: all arguments, and the result, have one common type of the kinds given
- `shift`: a bit string and a count
- `string`: strings and numbers; see `StringFunction`
"""

from dataclasses import dataclass

from scanbench.check.types import Kind

NUMBERS = (Kind.INT, Kind.UINT, Kind.REAL)
ORDERED = (*NUMBERS, Kind.BITS, Kind.BOOL, Kind.TIME)


@dataclass(frozen=True, slots=True)
class Same:
    """All of `formals` and the result have one type; `variadic` allows more of the last one, taken pairwise."""

    intrinsic: str
    formals: tuple[str, ...]
    kinds: tuple[Kind, ...]
    variadic: bool = False


@dataclass(frozen=True, slots=True)
class Shift:
    intrinsic: str


@dataclass(frozen=True, slots=True)
class StringFunction:
    """`formals` as name and kind: `s` a string, `n` an integer. `result`: `sum` of capacities, `first`, or `INT`."""

    intrinsic: str
    formals: tuple[tuple[str, str], ...]
    result: str


@dataclass(frozen=True, slots=True)
class Operator:
    """A function that is an operator by another name."""

    op: str
    variadic: bool = False


REALS = (Kind.REAL,)

FUNCTIONS: dict[str, Same | Shift | StringFunction | Operator] = {
    "ABS": Same("ABS", ("IN",), NUMBERS),
    **{name: Same(name, ("IN",), REALS) for name in ("SQRT", "LN", "LOG", "EXP", "SIN", "COS", "TAN", "ASIN", "ACOS", "ATAN")},
    "MIN": Same("MIN", ("IN1", "IN2"), ORDERED, variadic=True),
    "MAX": Same("MAX", ("IN1", "IN2"), ORDERED, variadic=True),
    "SHL": Shift("SHL"),
    "SHR": Shift("SHR"),
    "ROL": Shift("ROL"),
    "ROR": Shift("ROR"),
    "LEN": StringFunction("LEN", (("IN", "s"),), "INT"),
    "LEFT": StringFunction("LEFT", (("IN", "s"), ("L", "n")), "first"),
    "RIGHT": StringFunction("RIGHT", (("IN", "s"), ("L", "n")), "first"),
    "MID": StringFunction("MID", (("IN", "s"), ("L", "n"), ("P", "n")), "first"),
    "CONCAT": StringFunction("CONCAT", (("IN1", "s"), ("IN2", "s")), "sum"),
    "INSERT": StringFunction("INSERT", (("IN1", "s"), ("IN2", "s"), ("P", "n")), "sum"),
    "DELETE": StringFunction("DELETE", (("IN", "s"), ("L", "n"), ("P", "n")), "first"),
    "REPLACE": StringFunction("REPLACE", (("IN1", "s"), ("IN2", "s"), ("L", "n"), ("P", "n")), "sum"),
    "FIND": StringFunction("FIND", (("IN1", "s"), ("IN2", "s")), "INT"),
    "ADD": Operator("add", variadic=True),
    "MUL": Operator("mul", variadic=True),
    "SUB": Operator("sub"),
    "DIV": Operator("div"),
    "EXPT": Operator("pow"),
    "GT": Operator("gt"),
    "GE": Operator("ge"),
    "EQ": Operator("eq"),
    "LE": Operator("le"),
    "LT": Operator("lt"),
    "NE": Operator("ne"),
}  # fmt: skip

SPECIAL = ("SEL", "LIMIT", "MUX", "MOVE", "TRUNC", "TIME")
"""Functions with a shape of their own, see `check/calls.py`."""
