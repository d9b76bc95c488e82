"""Functions with locals of every type, which native code keeps in registers; and variables that overlap in an area."""

from tests.programs.expressions import expression, literal
from tests.programs.scope import COUNTERS, TEXT, TYPES, WIDTH, Draw, Parts, Scope
from tests.programs.statements import body, element

AREA = {
    "q0 AT %QX0.3": "BOOL", "q1 AT %QX1.7": "BOOL", "qb AT %QB1": "BYTE", "m0 AT %MX2.5": "BOOL", "m1 AT %MB2": "BYTE",
    "m2 AT %MW2": "INT", "m3 AT %MW1": "WORD", "m4 AT %MD1": "DINT", "m5 AT %MD1": "REAL", "m6 AT %ML0": "LWORD",
    "i0 AT %IX0.1": "BOOL",
}  # fmt: skip


def _locals(draw: Draw, scope: Scope) -> list[str]:
    lines = []
    for type in TYPES:
        if draw.likely(40):
            name = f"l_{type.lower().split('[')[0]}"
            lines.append(f"{name} : {type} := {literal(draw, type)};")
            scope.add(type, name)
            if type in WIDTH and draw.likely(30):
                scope.add("BOOL", f"{name}.%X{draw.randrange(WIDTH[type])}")
    return lines


def frames(parts: Parts) -> None:
    """The ingredient."""
    draw, scope = parts.draw, parts.main
    inner, block = Scope(), Scope()
    for each in (inner, block):
        each.add("INT", "a", "io", "oi", "arr[3]", "arr[1]")
        each.add("BOOL", "b", "flag")
        each.add(TEXT, "tx", "ot")
        each.statements.append(lambda d, s, n: f"{element(d, s, 'arr')} := {expression(d, s, 'INT', 1)};")
        each.statements.append(
            lambda d, s, n: d.one("arr2 := arr;", "arr := arr2;", "un2 := un;", "arr[2] := arr2[4];")
        )
        each.add("WORD", "un.w")
        each.add("BYTE", "un.b[1]")
    inner.add("REAL", "Deep", "x")
    interface = (
        "VAR_INPUT a : INT; b : BOOL; END_VAR\nVAR_IN_OUT io : INT; tx : STRING[12]; flag : BOOL; END_VAR\n"
        "VAR_OUTPUT oi : INT := 7; ot : STRING[12]; END_VAR\n"
    )
    arrays = f"arr, arr2 : ARRAY[1..5] OF INT := [5, 4, 3]; un, un2 : Halves; {COUNTERS}"
    parts.declarations += [
        "TYPE Halves : UNION w : WORD; b : ARRAY[0..1] OF BYTE; END_UNION; END_TYPE",
        f"FUNCTION Deep : REAL\n{interface}VAR_INPUT x : REAL; END_VAR\nVAR\n",
        *_locals(draw, inner),
        f"{arrays}\nEND_VAR\n{body(draw, inner, 2, 2, 5)}\nEND_FUNCTION",
        f"FUNCTION_BLOCK Worker\n{interface}VAR_TEMP\n",
        *_locals(draw, block),
        f"END_VAR\nVAR {arrays} END_VAR\n{body(draw, block, 2, 2, 4)}\nEND_FUNCTION_BLOCK",
    ]
    parts.variables.append("worker, worker2 : Worker;")
    if draw.likely(60):
        parts.variables += [f"{name} : {type};" for name, type in AREA.items()]
        for name, type in AREA.items():
            scope.add(type, name.split()[0], writable=not name.startswith("i"))
    scope.add_expression("REAL", _deep)
    scope.statements += [_worker, _worker, lambda d, s, n: f"{d.of(s.writable['INT'])} := TRUNC_INT({_deep(d, s, n)});"]


def _arguments(draw: Draw, scope: Scope, depth: int) -> list[str]:
    given = [
        f"{name} := {expression(draw, scope, type, depth - 1)}"
        for name, type in draw.subset({"a": "INT", "b": "BOOL"}).items()
    ]
    for name, type in {"io": "INT", "tx": TEXT, "flag": "BOOL"}.items():
        given.append(
            f"{name} := {draw.of([each for each in scope.writable[type] if '%' not in each and '.' not in each])}"
        )
    for name, type in draw.subset({"oi": "INT", "ot": TEXT}).items():
        given.append(f"{name} => {draw.of(scope.writable[type])}")
    return given


def _deep(draw: Draw, scope: Scope, depth: int) -> str:
    given = _arguments(draw, scope, depth)
    if draw.likely(50):
        given.append(f"x := {expression(draw, scope, 'REAL', depth - 1)}")
    return f"Deep({', '.join(given)})"


def _worker(draw: Draw, scope: Scope, depth: int) -> str:
    return f"{draw.one('worker', 'worker2')}({', '.join(_arguments(draw, scope, 2))});"
