"""Functions and blocks that are hard to keep in order.

Results in frames, functions that write what their callers are reading, strings and structures in and out.
"""

from tests.programs.expressions import expression, position
from tests.programs.scope import COUNTERS, TEXT, Draw, Parts, Scope
from tests.programs.statements import body, element

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
VARIABLES = """\
list, list2 : Five := [1, 2, 3, 4, 5]; lists : ARRAY[1..5] OF Five; pair : Pair; pairs : ARRAY[1..5] OF Pair;
texts : ARRAY[1..5] OF STRING[12]; fb, fb2 : Inner;"""
WHOLES = ("list", "list2", "gl")


def calls(parts: Parts) -> None:
    """The ingredient."""
    parts.declarations += [CALLEES, _inner(parts.draw)]
    parts.variables.append(VARIABLES)
    scope = parts.main
    scope.add(TEXT, "gs")
    scope.add("INT", "pair.n", "list[2]", "fb.y", writable=False)
    scope.add_expression("DINT", _number)
    scope.add_expression("INT", lambda draw, scope, depth: f"{draw.one(*WHOLES)}[{_number(draw, scope, depth)}]")
    scope.add_expression(TEXT, _text)
    scope.statements += [_whole_arrays, _structures, _one_text, _block, _one_number]
    parts.end.append(_block(parts.draw, scope, 1))


def _inner(draw: Draw) -> str:
    scope = Scope()
    scope.add("INT", "x", "y", "io")
    scope.add("BOOL", "b")
    scope.add("REAL", "r")
    scope.add(TEXT, "t", "o")
    return (
        "FUNCTION_BLOCK Inner\nVAR_INPUT t : STRING[12]; END_VAR\nVAR_OUTPUT o : STRING[12] := 'out'; END_VAR\n"
        "VAR_INPUT x : INT; b : BOOL; END_VAR\nVAR_IN_OUT io : INT; END_VAR\nVAR_OUTPUT y : INT; END_VAR\n"
        f"VAR r : REAL := 1.5; {COUNTERS} END_VAR\n{body(draw, scope, 1, 1, 3)}\nEND_FUNCTION_BLOCK\n"
    )


def _number(draw: Draw, scope: Scope, depth: int) -> str:
    """A number of an element, from a function that has other things to do as well."""
    number = expression(draw, scope, "INT", depth - 1)
    if draw.likely(50):
        return f"Pick({number})"
    return f"Bump({number}, {draw.of(scope.writable['INT'])}, {draw.of(scope.writable[TEXT])})"


def _text(draw: Draw, scope: Scope, depth: int) -> str:
    if draw.likely(50):
        return f"texts[{_number(draw, scope, depth)}]"
    given = expression(draw, scope, TEXT, depth - 1)
    return f"Told({given}, {_whole(draw, scope)}, {expression(draw, scope, 'INT', depth - 1)})"


def _whole(draw: Draw, scope: Scope) -> str:
    name = draw.one(*WHOLES) if draw.likely(60) else f"lists[{_number(draw, scope, 1)}]"
    return f"Turned({name}, {expression(draw, scope, 'INT', 1)})" if draw.likely(50) else name


def _whole_arrays(draw: Draw, scope: Scope, depth: int) -> str:
    target = draw.one(*WHOLES) if draw.likely(50) else f"lists[{_number(draw, scope, 1)}]"
    return f"{target} := {_whole(draw, scope)};"


def _structures(draw: Draw, scope: Scope, depth: int) -> str:
    target = "pair" if draw.likely(50) else f"pairs[{_number(draw, scope, 1)}]"
    if draw.likely(40):
        return f"{target} := {draw.one('pair', f'pairs[{position(draw, scope)}]')};"
    given = [f"t := {expression(draw, scope, TEXT, 1)}", f"n := {expression(draw, scope, 'INT', 1)}"]
    for name, to in draw.subset({"o": "pairs", "s": "texts", "m": "list"}).items():
        given.append(f"{name} => {to}[{_number(draw, scope, 1)}]")
    return f"{target} := Made({', '.join(given)});"


def _one_text(draw: Draw, scope: Scope, depth: int) -> str:
    return f"texts[{_number(draw, scope, 1)}] := {expression(draw, scope, TEXT, 2)};"


def _one_number(draw: Draw, scope: Scope, depth: int) -> str:
    return f"{element(draw, scope, draw.one(*WHOLES))} := {expression(draw, scope, 'INT', 1)};"


def _block(draw: Draw, scope: Scope, depth: int) -> str:
    """The block, with strings in and out."""
    inputs = draw.subset({"t": TEXT, "x": "INT", "b": "BOOL"})
    given = [f"{name} := {expression(draw, scope, type, 1)}" for name, type in inputs.items()]
    if draw.likely(50):
        given.append(f"o => {draw.one(draw.of(scope.writable[TEXT]), f'texts[{_number(draw, scope, 1)}]')}")
    given.append(f"io := {draw.of(scope.writable['INT'])}")
    return f"{draw.one('fb', 'fb2')}({', '.join(given)});"
