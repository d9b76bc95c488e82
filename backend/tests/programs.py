"""Random programs: well-formed ST from hypothesis, small enough to run in both engines, nasty enough to make them differ."""

from collections.abc import Callable
from dataclasses import dataclass

from hypothesis import strategies as st

INTEGERS = ("SINT", "INT", "DINT", "LINT", "USINT", "UINT", "UDINT", "ULINT")
BITS = ("BYTE", "WORD", "DWORD", "LWORD")
REALS = ("REAL", "LREAL")
WIDTH = {"SINT": 8, "INT": 16, "DINT": 32, "LINT": 64, "USINT": 8, "UINT": 16, "UDINT": 32, "ULINT": 64,
         "BYTE": 8, "WORD": 16, "DWORD": 32, "LWORD": 64}  # fmt: skip
TYPES = (*INTEGERS, *BITS, *REALS, "BOOL", "TIME", "STRING[12]")


Sub = Callable[[str], str]
"""Gives an expression of the type asked for."""


@dataclass(frozen=True)
class Shape:
    """Variables by type: the names that expressions may use."""

    names: dict[str, list[str]]
    calls: bool = False
    """Whether `CALLEES` and the variables that they are used with are in sight."""


CALLEES = """\
TYPE Five : ARRAY[1..5] OF INT; END_TYPE
TYPE Pair : STRUCT n : INT; t : STRING[12]; END_STRUCT; END_TYPE
VAR_GLOBAL gs : STRING[12] := 'g'; gl : Five := [9, 8, 7, 6, 5]; END_VAR
FUNCTION Bump : DINT
VAR_INPUT by_ : INT; END_VAR
VAR_IN_OUT n : INT; s : STRING[12]; END_VAR
n := n + by_; s := CONCAT('x', s); gs := CONCAT(s, gs); gl[1 + ABS(INT_TO_DINT(n)) MOD 5] := n;
Bump := 1 + ABS(INT_TO_DINT(n)) MOD 5;
END_FUNCTION
FUNCTION Made : Pair
VAR_INPUT t : STRING[12]; n : INT; END_VAR
VAR_OUTPUT o : Pair; s : STRING[12]; m : INT; END_VAR
Made.n := n; Made.t := t; o.n := n + 1; o.t := CONCAT(t, 'o'); s := CONCAT('s', t); m := n * 2;
END_FUNCTION
FUNCTION Pick : DINT
VAR_INPUT n : INT; END_VAR
VAR p : Pair; l : Five; END_VAR
p := Made(t := 'pick', n := n); l := Turned(gl, n);
Pick := 1 + ABS(INT_TO_DINT(p.n)) MOD 5;
END_FUNCTION
FUNCTION Turned : Five
VAR_INPUT l : Five; n : INT; END_VAR
Turned[1] := l[5]; Turned[2] := l[1] + n; Turned[5] := l[2];
END_FUNCTION
FUNCTION Told : STRING[12]
VAR_INPUT s : STRING[12]; l : Five; n : INT; END_VAR
Told := CONCAT(s, INT_TO_STRING(l[1] + n));
END_FUNCTION
"""
"""What is hard to keep in order: results in frames, and functions that write what their callers are reading."""
WHOLES = ["list", "list2", "gl"]


@st.composite
def literal(draw: st.DrawFn, type: str) -> str:
    if type == "BOOL":
        return draw(st.sampled_from(["TRUE", "FALSE"]))
    if type == "TIME":
        return f"T#{draw(st.integers(-5000, 5000))}ms"
    if type.startswith("STRING"):
        text = draw(st.text(alphabet="abcXYZ 019-", max_size=14))
        return f"'{text}'"
    if type in REALS:
        value = draw(
            st.one_of(
                st.integers(-3, 3),
                st.floats(-1e6, 1e6, width=32),
                st.floats(width=32, allow_nan=False, allow_infinity=False),
            )
        )
        return f"{type}#{float(value)!r}"
    width = WIDTH[type]
    signed = type in ("SINT", "INT", "DINT", "LINT")
    low, high = (-(1 << width - 1), (1 << width - 1) - 1) if signed else (0, (1 << width) - 1)
    edges = [low, low + 1, high, high - 1, 0, 1, 2, 3, 7]
    value = draw(st.one_of(st.sampled_from(edges), st.integers(low, high)))
    return f"{type}#{value}"


@st.composite
def expression(draw: st.DrawFn, shape: Shape, type: str, depth: int) -> str:
    """An expression of exactly this type."""
    leaves = [literal(type)]
    if shape.names.get(type):
        leaves += [st.sampled_from(shape.names[type])] * 3
    if depth == 0:
        return str(draw(st.one_of(*leaves)))

    def sub(wanted: str) -> str:
        return str(draw(expression(shape, wanted, depth - 1)))

    if shape.calls and type in ("DINT", "INT", "STRING[12]") and draw(st.integers(0, 3)) == 0:
        return draw(calling(shape, type, depth))
    choice = draw(st.integers(0, 9))
    if choice < 2:
        return str(draw(st.one_of(*leaves)))
    if type == "BOOL":
        return _bool(draw, sub, choice)
    if type == "TIME":
        if choice < 6:
            return f"({sub('TIME')} {draw(st.sampled_from('+-'))} {sub('TIME')})"
        return (
            f"({sub('TIME')} * {sub(draw(st.sampled_from(['INT', 'DINT', 'REAL'])))})"
            if choice < 9
            else f"DINT_TO_TIME({sub('DINT')})"
        )
    if type.startswith("STRING"):
        return _string(draw, sub, choice)
    if type in REALS:
        return _real(draw, sub, type, choice)
    if type in BITS:
        return _bits(draw, sub, type, choice)
    return _integer(draw, sub, type, choice)


@st.composite
def position(draw: st.DrawFn, shape: Shape, depth: int = 1) -> str:
    """A number of an element, from a function that has other things to do as well."""
    number = draw(expression(shape, "INT", max(depth - 1, 0)))
    if draw(st.booleans()):
        return f"Pick({number})"
    into = draw(st.sampled_from(shape.names["INT"])), draw(st.sampled_from(shape.names["STRING[12]"]))
    return f"Bump({number}, {into[0]}, {into[1]})"


@st.composite
def calling(draw: st.DrawFn, shape: Shape, type: str, depth: int) -> str:
    """An expression of this type that calls."""
    if type == "DINT":
        return draw(position(shape, depth))
    if type == "INT":
        return f"{draw(st.sampled_from(WHOLES))}[{draw(position(shape, depth))}]"
    if draw(st.booleans()):
        return f"texts[{draw(position(shape, depth))}]"
    given = [draw(expression(shape, each, depth - 1)) for each in ("STRING[12]", "INT")]
    return f"Told({given[0]}, {draw(whole(shape))}, {given[1]})"


@st.composite
def whole(draw: st.DrawFn, shape: Shape) -> str:
    """An array."""
    variable = draw(st.sampled_from([*WHOLES, f"lists[{draw(position(shape))}]"]))
    return f"Turned({variable}, {draw(expression(shape, 'INT', 1))})" if draw(st.booleans()) else variable


@st.composite
def made(draw: st.DrawFn, shape: Shape) -> str:
    """A call that gives a structure, and outputs."""
    given = [f"t := {draw(expression(shape, 'STRING[12]', 1))}", f"n := {draw(expression(shape, 'INT', 1))}"]
    outputs = {"o": "pairs", "s": "texts", "m": "list"}
    given += [f"{name} => {to}[{draw(position(shape))}]" for name, to in outputs.items() if draw(st.booleans())]
    return f"Made({', '.join(given)})"


@st.composite
def ordering(draw: st.DrawFn, shape: Shape) -> str:
    """A statement in which something is called between a value and where it goes."""
    target = draw(st.sampled_from(["", f"[{draw(position(shape))}]"]))
    match draw(st.integers(0, 4)):
        case 0:
            return f"{'lists' if target else draw(st.sampled_from(WHOLES))}{target} := {draw(whole(shape))};"
        case 1:
            return f"{'pairs' if target else 'pair'}{target} := {draw(made(shape))};"
        case 2:
            source = draw(st.sampled_from(["pair", f"pairs[{draw(position(shape))}]"]))
            return f"{'pairs' if target else 'pair'}{target} := {source};"
        case 3:
            return f"texts[{draw(position(shape))}] := {draw(expression(shape, 'STRING[12]', 2))};"
    return draw(block_call(shape))


@st.composite
def block_call(draw: st.DrawFn, shape: Shape) -> str:
    """The block, with strings in and out."""
    given = [
        f"{name} := {draw(expression(shape, type, 1))}"
        for name, type in {"t": "STRING[12]", "x": "INT", "b": "BOOL"}.items()
        if draw(st.booleans())
    ]
    to = st.sampled_from([*shape.names["STRING[12]"], f"texts[{draw(position(shape))}]"])
    given += [f"o => {draw(to)}"] if draw(st.booleans()) else []
    return f"{draw(st.sampled_from(['fb', 'fb2']))}({', '.join([*given, 'io := v_int1'])});"


def _bool(draw: st.DrawFn, sub: Sub, choice: int) -> str:
    if choice < 5:
        return f"({sub('BOOL')} {draw(st.sampled_from(['AND', 'OR', 'XOR', '=', '<>']))} {sub('BOOL')})"
    if choice < 6:
        return f"NOT {sub('BOOL')}"
    type = draw(st.sampled_from([*INTEGERS, *BITS, *REALS, "TIME", "STRING[12]"]))
    return f"({sub(type)} {draw(st.sampled_from(['=', '<>', '<', '<=', '>', '>=']))} {sub(type)})"


def _string(draw: st.DrawFn, sub: Sub, choice: int) -> str:
    text = "STRING[12]"
    match choice:
        case 2 | 3:
            return f"CONCAT({sub(text)}, {sub(text)})"
        case 4:
            return f"MID({sub(text)}, {sub('SINT')}, {sub('SINT')})"
        case 5:
            return f"REPLACE({sub(text)}, {sub(text)}, {sub('SINT')}, {sub('INT')})"
        case 6:
            return f"INSERT({sub(text)}, {sub(text)}, {sub('SINT')})"
        case 7:
            return f"DELETE({sub(text)}, {sub('USINT')}, {sub('SINT')})"
        case 8:
            return f"{draw(st.sampled_from(['LEFT', 'RIGHT']))}({sub(text)}, {sub('SINT')})"
    return f"DINT_TO_STRING({sub('DINT')})"


def _real(draw: st.DrawFn, sub: Sub, type: str, choice: int) -> str:
    if choice < 6:
        return f"({sub(type)} {draw(st.sampled_from('+-*/'))} {sub(type)})"
    if choice == 6:
        return f"(-{sub(type)})"
    if choice == 7:
        other = draw(st.sampled_from(["LINT", "UDINT", "LREAL" if type == "REAL" else "REAL", "ULINT"]))
        return f"{other}_TO_{type}({sub(other)})"
    if choice == 8:
        return f"{draw(st.sampled_from(['ABS', 'SQRT', 'SIN', 'EXP', 'LN', 'ATAN']))}({sub(type)})"
    return f"{draw(st.sampled_from(['MIN', 'MAX']))}({sub(type)}, {sub(type)})"


def _bits(draw: st.DrawFn, sub: Sub, type: str, choice: int) -> str:
    if choice < 6:
        return f"({sub(type)} {draw(st.sampled_from(['AND', 'OR', 'XOR']))} {sub(type)})"
    if choice == 6:
        return f"NOT {sub(type)}"
    if choice < 9:
        return f"{draw(st.sampled_from(['SHL', 'SHR', 'ROL', 'ROR']))}({sub(type)}, {sub('SINT')})"
    other = draw(st.sampled_from([*INTEGERS, *(each for each in BITS if each != type)]))
    return f"{other}_TO_{type}({sub(other)})"


def _integer(draw: st.DrawFn, sub: Sub, type: str, choice: int) -> str:
    if choice < 6:
        return f"({sub(type)} {draw(st.sampled_from(['+', '-', '*', 'MOD', '/']))} {sub(type)})"
    if choice == 6:
        return f"(-{sub(type)})"
    if choice == 7:
        other = draw(st.sampled_from([*(each for each in INTEGERS if each != type), *BITS, *REALS, "BOOL"]))
        return f"{other}_TO_{type}({sub(other)})"
    if choice == 8:
        return f"{draw(st.sampled_from(['MIN', 'MAX']))}({sub(type)}, {sub(type)})"
    return (
        f"SEL({sub('BOOL')}, {sub(type)}, {sub(type)})"
        if type != "INT"
        else f"FIND({sub('STRING[12]')}, {sub('STRING[12]')})"
    )


@st.composite
def statement(draw: st.DrawFn, shape: Shape, depth: int) -> str:
    if shape.calls and draw(st.integers(0, 2)) == 0:
        return draw(ordering(shape))
    choice = draw(st.integers(0, 9 if depth else 5))
    if choice <= 4:
        type = draw(st.sampled_from([type for type in shape.names if shape.names[type]]))
        return f"{draw(st.sampled_from(shape.names[type]))} := {draw(expression(shape, type, 2))};"
    inner = st.lists(statement(shape, max(depth - 1, 0)), min_size=1, max_size=3).map("\n".join)
    match choice:
        case 5:
            of = draw(st.sampled_from([type for type in ("INT", "USINT", "LINT") if shape.names.get(type)]))
            index = f"({draw(st.sampled_from(shape.names[of]))} + {draw(expression(shape, of, 1))})"
            if draw(st.booleans()):
                return f"list[{index}] := {draw(expression(shape, 'INT', 1))};"
            return f"list[1 + ABS(INT_TO_DINT(v_int0)) MOD 5] := list[{draw(st.integers(1, 5))}] + 1;"
        case 6 | 7:
            text = f"IF {draw(expression(shape, 'BOOL', 2))} THEN\n{draw(inner)}\n"
            if draw(st.booleans()):
                text += f"ELSE\n{draw(inner)}\n"
            return text + "END_IF;"
        case 8:
            counter = f"k{depth}"
            low, high = draw(st.integers(-3, 3)), draw(st.integers(-3, 6))
            step = draw(st.sampled_from(["", " BY 2", " BY -1", " BY -2"]))
            leave = f"IF {draw(expression(shape, 'BOOL', 1))} THEN EXIT; END_IF;" if draw(st.booleans()) else ""
            return f"FOR {counter} := {low} TO {high}{step} DO\n{draw(inner)}\n{leave}\nEND_FOR;"
    label = draw(st.integers(-2, 2))
    return (
        f"CASE {draw(expression(shape, 'INT', 1))} OF\n{label}: {draw(inner)}\n{label + 1}..{label + 9}: {draw(inner)}\n"
        f"ELSE {draw(inner)}\nEND_CASE;"
    )


@st.composite
def program(draw: st.DrawFn) -> str:
    """A PROGRAM with two variables of every type, arrays, and blocks and functions that it calls.

    The strings come first, where the block has its own: so are they at the same offsets of the two instances.
    """
    names: dict[str, list[str]] = {}
    lines = []
    for type in ("STRING[12]", *TYPES[:-1]):
        short = type.lower().split("[")[0]
        names[type] = [f"v_{short}{number}" for number in range(2)]
        for name in names[type]:
            lines.append(f"{name} : {type} := {draw(literal(type))};")
    shape = Shape({**names, "STRING[12]": [*names["STRING[12]"], "gs"]}, calls=True)
    body = draw(st.lists(statement(shape, 2), min_size=1, max_size=8))
    inner = Shape({"INT": ["x", "y", "io"], "BOOL": ["b"], "REAL": ["r"], "STRING[12]": ["t", "o"]})
    block = draw(st.lists(statement(inner, 1), min_size=1, max_size=3))
    counters = "k0, k1, k2 : INT;"
    variables = "\n".join(lines)
    return (
        CALLEES + "FUNCTION_BLOCK Inner\nVAR_INPUT t : STRING[12]; END_VAR\nVAR_OUTPUT o : STRING[12] := 'out'; END_VAR\n"
        "VAR_INPUT x : INT; b : BOOL; END_VAR\nVAR_IN_OUT io : INT; END_VAR\nVAR_OUTPUT y : INT; END_VAR\n"
        f"VAR r : REAL := 1.5; list : ARRAY[1..5] OF INT; v_int0 : INT; {counters} END_VAR\n" + "\n".join(block) + "\nEND_FUNCTION_BLOCK\n"
        f"PROGRAM Main\nVAR\n{variables}\nlist, list2 : Five := [1, 2, 3, 4, 5];\nlists : ARRAY[1..5] OF Five;\npair : Pair;\n"
        f"pairs : ARRAY[1..5] OF Pair;\ntexts : ARRAY[1..5] OF STRING[12];\nfb, fb2 : Inner;\n{counters}\nEND_VAR\n"
        + "\n".join([*body, draw(block_call(shape))]) + "\nEND_PROGRAM\n"
    )  # fmt: skip
