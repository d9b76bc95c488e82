"""References, and arrays whose bounds come with the call."""

from tests.programs.expressions import expression
from tests.programs.scope import COUNTERS, Draw, ExpressionMaker, Parts, Scope, StatementMaker
from tests.programs.statements import RARE, body


def references(parts: Parts) -> None:
    """The ingredient: a reference to a variable of each type, which may be pointed to another."""
    draw, scope = parts.draw, parts.main
    parts.declarations.append(
        "TYPE Node : STRUCT value : INT; next : REF_TO Node; flag : BOOL; END_STRUCT; END_TYPE\n"
        "FUNCTION Follow : INT\nVAR_INPUT node : REF_TO Node; into : REF_TO INT; END_VAR\n"
        "IF node <> NULL AND into <> NULL THEN\nFollow := node^.value + into^; into^ := Follow; node^.flag := NOT node^.flag;\nEND_IF;\nEND_FUNCTION"
    )
    parts.variables.append("nodes : ARRAY[1..3] OF Node; rn, rm : REF_TO Node; rz : REF_TO INT;")
    parts.start += [
        "nodes[1].next := REF(nodes[2]); nodes[2].next := REF(nodes[3]); nodes[3].next := REF(nodes[1]);",
        "rn := REF(nodes[2]); rm := rn^.next;",
    ]
    for type in list(scope.writable):
        targets = [name for name in scope.writable[type] if not {"%", "."} & set(name)]
        if targets:
            name = f"r_{type.lower().split('[')[0]}"
            parts.variables.append(f"{name} : REF_TO {type};")
            parts.start.append(f"{name} := REF({draw.of(targets)});")
            scope.statements.append(_again(name, targets))
            scope.add_expression("BOOL", _same(name, targets))
            scope.add(type, f"{name}^")
    scope.add("INT", "rn^.value", "rm^.next^.value")
    scope.add("BOOL", "rn^.flag")
    scope.add_expression("INT", _follow)
    scope.statements += [_step, _whole]


def _again(name: str, targets: list[str]) -> StatementMaker:
    def make(draw: Draw, scope: Scope, depth: int) -> str:
        if draw.likely(RARE):
            return f"{name} := NULL;"
        return f"{name} := REF({draw.of(targets)});"

    return make


def _same(name: str, targets: list[str]) -> ExpressionMaker:
    def make(draw: Draw, scope: Scope, depth: int) -> str:
        return f"({name} {draw.one('=', '<>')} {draw.one('NULL', f'REF({draw.of(targets)})')})"

    return make


def _follow(draw: Draw, scope: Scope, depth: int) -> str:
    to = f"REF({draw.one('v_int0', 'v_int1')})" if draw.likely(80) else "rz"
    return f"Follow({draw.one('rn', 'rm', 'rn^.next', 'REF(nodes[1])')}, {to})"


def _step(draw: Draw, scope: Scope, depth: int) -> str:
    return draw.one(
        "rn := rn^.next;", "rm := rm^.next^.next;", "rn := rm;", "rm := REF(nodes[1 + ABS(v_int0 MOD 3)]);",
        "nodes[1].next := rn;",
    )  # fmt: skip


def _whole(draw: Draw, scope: Scope, depth: int) -> str:
    return draw.one("rn^ := nodes[1];", "nodes[2] := rm^;", "rm^ := rn^;", "rn^.next^ := nodes[3];")


# ---- pointers -----------------------------------------------------------------------------------------------------

POINTED = {"INT": "pi_", "BYTE": "py_", "DWORD": "pd_", "REAL": "pr_", "LINT": "pl_", "BOOL": "pb_"}
"""Names of pointers, by what they point to."""


def pointers(parts: Parts) -> None:
    """The ingredient: pointers that are computed with, and so point into the middle of other variables."""
    draw, scope = parts.draw, parts.main
    parts.variables += [f"{name}, {name}2 : POINTER TO {type};" for type, name in POINTED.items()]
    parts.variables.append("heap : ARRAY[0..31] OF BYTE; ")
    for type, name in POINTED.items():
        names = [each for each in scope.writable.get(type, []) if not {"%", "."} & set(each)]
        parts.variables.append(f"x{name} : {type};")
        targets = [*names, f"x{name}"]
        parts.start.append(f"{name} := ADR({draw.of(targets)}); {name}2 := ADR(x{name});")
        scope.add(type, f"{name}^", f"{name}2^")
        scope.statements.append(_moved(name, targets))
        scope.add_expression("BOOL", _same_pointer(name))


def _moved(name: str, targets: list[str]) -> StatementMaker:
    def make(draw: Draw, scope: Scope, depth: int) -> str:
        if draw.likely(RARE):
            return f"{name} := {name} {draw.one('+ 16#4000_0000', '- 16#7FFF_FFFF', '+ 16#1_0000_0000', '- 100_000')};"
        start = draw.one(name, f"{name}2", f"ADR({draw.of(targets)})")
        return f"{name} := {start} {draw.one('+', '-')} {draw.randint(0, 5)};"

    return make


def _same_pointer(name: str) -> ExpressionMaker:
    return lambda draw, scope, depth: f"({name} {draw.one('=', '<>')} {draw.one('NULL', f'{name}2')})"


# ---- arrays of any length -----------------------------------------------------------------------------------------

OPEN = """\
FUNCTION Total : INT
VAR_IN_OUT a : ARRAY[*] OF INT; END_VAR
VAR i : LINT; END_VAR
FOR i := LOWER_BOUND(a, 1) TO UPPER_BOUND(a, 1) DO Total := Total * 3 + a[i]; END_FOR;
END_FUNCTION
FUNCTION Turn : INT
VAR_INPUT by_ : INT; END_VAR
VAR_IN_OUT a : ARRAY[*] OF INT; END_VAR
VAR low, high, n, i : LINT; kept : INT; END_VAR
low := LOWER_BOUND(a, 1); high := UPPER_BOUND(a, 1); n := high - low + 1;
FOR i := low TO high - 1 DO kept := a[i]; a[i] := a[i + 1] + by_; a[i + 1] := kept; END_FOR;
Turn := Total(a);
END_FUNCTION
"""


def open_arrays(parts: Parts) -> None:
    """The ingredient."""
    draw, scope = parts.draw, parts.main
    inner = Scope()
    inner.add("INT", "x", "y")
    inner.add("INT", "g[LOWER_BOUND(g, 1), UPPER_BOUND(g, 2)]", "g[1, 1]")
    inner.add("LINT", "UPPER_BOUND(g, 1)", "LOWER_BOUND(g, 2)", writable=False)
    inner.add("BOOL", "b")
    parts.declarations += [
        OPEN,
        "FUNCTION_BLOCK Grid\nVAR_IN_OUT g : ARRAY[*, *] OF INT; END_VAR\nVAR_INPUT x : INT; END_VAR\nVAR_OUTPUT y : INT; END_VAR\n"
        f"VAR b : BOOL; {COUNTERS} END_VAR\n{body(draw, inner, 1, 1, 3)}\nEND_FUNCTION_BLOCK",
    ]
    parts.variables.append(
        "o3 : ARRAY[3..7] OF INT := [1, 2, 3]; o1 : ARRAY[-2..-1] OF INT; g1 : ARRAY[0..2, 1..4] OF INT; g2 : ARRAY[1..1, -3..1] OF INT;\n"
        "grid : Grid;"
    )
    scope.add("INT", "o3[5]", "o1[-1]", "g1[1, 2]", "g2[1, 0]")
    scope.add_expression("INT", _open_call)
    scope.statements.append(_grid)


def _open_call(draw: Draw, scope: Scope, depth: int) -> str:
    if draw.likely(50):
        return f"Total({draw.one('o3', 'o1')})"
    return f"Turn({expression(draw, scope, 'INT', depth - 1)}, {draw.one('o3', 'o1')})"


def _grid(draw: Draw, scope: Scope, depth: int) -> str:
    return f"grid(g := {draw.one('g1', 'g2')}, x := {expression(draw, scope, 'INT', 1)});"
