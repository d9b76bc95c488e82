"""Enumerations, subranges, unions and parts of bit strings."""

from tests.programs.expressions import LITERALS, expression, variable
from tests.programs.scope import WIDTH, Draw, ExpressionMaker, Parts, Scope
from tests.programs.statements import body

# ---- enumerations -----------------------------------------------------------------------------------------------

ENUMERATIONS = {"Color": ("RED", "GREEN", "BLUE", "VIOLET"), "Level": ("LOW", "MIDDLE", "HIGH")}
LITERALS.update(
    {
        "Color": lambda draw: f"Color#{draw.one(*ENUMERATIONS['Color'])}",
        "Level": lambda draw: f"Level#{draw.one(*ENUMERATIONS['Level'])}",
    }
)


def enumerations(parts: Parts) -> None:
    """The ingredient."""
    scope = parts.main
    parts.declarations.append(
        "TYPE Color : (RED, GREEN := 5, BLUE, VIOLET := -3); Level : USINT (LOW := 1, MIDDLE := 100, HIGH := 200); END_TYPE"
    )
    parts.variables.append(
        "c0 : Color; c1 : Color := Color#BLUE; lv0, lv1 : Level := Level#HIGH; colors : ARRAY[1..5] OF Color;"
    )
    scope.add("Color", "c0", "c1", "colors[2]")
    scope.add("Level", "lv0", "lv1")
    for type in ENUMERATIONS:
        scope.add_expression(type, _choice(type))
        scope.add_expression("BOOL", _comparison(type))
    scope.statements.append(_case)


def _choice(type: str) -> ExpressionMaker:
    def make(draw: Draw, scope: Scope, depth: int) -> str:
        a, b = (expression(draw, scope, type, depth - 1) for _ in range(2))
        return f"SEL({expression(draw, scope, 'BOOL', depth - 1)}, {a}, {b})"

    return make


def _comparison(type: str) -> ExpressionMaker:
    def make(draw: Draw, scope: Scope, depth: int) -> str:
        a, b = (expression(draw, scope, type, depth - 1) for _ in range(2))
        return f"({a} {draw.one('=', '<>')} {b})"

    return make


def _case(draw: Draw, scope: Scope, depth: int) -> str:
    inner = [body(draw, scope, depth - 1, 1, 1) for _ in range(3)]
    return f"CASE {draw.one('c0', 'c1')} OF\nColor#RED: {inner[0]}\nColor#GREEN, Color#VIOLET: {inner[1]}\nELSE {inner[2]}\nEND_CASE;"


# ---- subranges --------------------------------------------------------------------------------------------------

SUBRANGES = """\
TYPE Small : INT (-6..12); Tiny : USINT (3..9); Huge : ULINT (16#8000_0000_0000_0000..16#FFFF_FFFF_FFFF_FFF0); END_TYPE
TYPE Box : STRUCT low : Small; high : DINT (0..1000); END_STRUCT; END_TYPE
FUNCTION Brought : Small
VAR_INPUT x : Small; by_ : INT; END_VAR
Brought := x + by_;
END_FUNCTION
FUNCTION_BLOCK Keeper
VAR_INPUT x : Small; END_VAR
VAR_OUTPUT y : Small; wide : INT; END_VAR
VAR_IN_OUT io : Small; END_VAR
VAR n : Tiny; END_VAR
y := x + io; wide := io * 2; n := n + 1; io := x - 1;
END_FUNCTION_BLOCK
"""
RANGED = {
    "s0": "INT",
    "s1": "INT",
    "t0": "USINT",
    "h0": "ULINT",
    "box.low": "INT",
    "box.high": "DINT",
    "boxes[2].low": "INT",
}


def subranges(parts: Parts) -> None:
    """The ingredient."""
    scope = parts.main
    parts.declarations.append(SUBRANGES)
    parts.variables.append(
        "s0 : Small; s1 : Small := 5; t0 : Tiny; h0 : Huge; box : Box; boxes : ARRAY[1..3] OF Box; keeper, keeper2 : Keeper;\n"
        "row : ARRAY[-6..12] OF INT;"
    )
    for name, type in RANGED.items():
        scope.add(type, name, writable=False)
    scope.add("INT", "row[s0]", "row[s1]")
    scope.add_expression("INT", _brought, lambda draw, scope, depth: draw.one("keeper.y", "row[s0]", "keeper2.wide"))
    scope.add_expression("BOOL", lambda draw, scope, depth: f"SUBRANGE_ERROR({draw.one(*RANGED)})")
    scope.add_expression("UDINT", lambda draw, scope, depth: "_SubrangeErrorCount")
    scope.statements += [_ranged, _ranged, _kept, _ranged_for, _ranged_case]
    parts.end.append("_SubrangeError := FALSE;" if parts.draw.likely(20) else "")


def _brought(draw: Draw, scope: Scope, depth: int) -> str:
    """Variables in both arguments, as constants out of range are refused."""
    x = f"({variable(draw, scope, 'INT')} + {expression(draw, scope, 'INT', depth - 1)})"
    return f"Brought({x}, {expression(draw, scope, 'INT', depth - 1)})"


def _ranged(draw: Draw, scope: Scope, depth: int) -> str:
    name, type = draw.of(list(RANGED.items()))
    other = draw.of([other for other, of in RANGED.items() if of == type])
    return f"{name} := {other} {draw.one('+', '-')} {expression(draw, scope, type, 1)};"


def _kept(draw: Draw, scope: Scope, depth: int) -> str:
    given = [f"x := {variable(draw, scope, 'INT')} + 1"] if draw.likely(70) else []
    given += [f"y => {draw.one('s0', 's1', 'v_int0')}"] if draw.likely(50) else []
    given += [f"wide => {draw.one('s0', 'v_int1')}"] if draw.likely(50) else []
    return f"{draw.one('keeper', 'keeper2')}({', '.join([*given, 'io := ' + draw.one('s0', 's1')])});"


def _ranged_for(draw: Draw, scope: Scope, depth: int) -> str:
    low, high = draw.randint(-6, 6), draw.randint(0, 14)
    return f"FOR s1 := {low} TO {f'v_int0 MOD {high}' if high > 12 else high} BY {draw.one(1, 3, 5)} DO {body(draw, _without(scope, 's1'), 0, 1, 1)} END_FOR;"


def _without(scope: Scope, name: str) -> Scope:
    """The scope in which a name is not written: it is the counter of the loop around."""
    writable = {type: [each for each in names if name not in each] for type, names in scope.writable.items()}
    return Scope(scope.readable, {type: names for type, names in writable.items() if names}, {}, [], loops=False)


def _ranged_case(draw: Draw, scope: Scope, depth: int) -> str:
    inner = [body(draw, scope, depth - 1, 1, 1) for _ in range(3)]
    return f"CASE s0 OF\n-6..0: {inner[0]}\n1, 3, 5..9: {inner[1]}\nELSE {inner[2]}\nEND_CASE;"


# ---- parts of variables -----------------------------------------------------------------------------------------


def parts_of_bits(parts: Parts) -> None:
    """The ingredient."""
    draw, scope = parts.draw, parts.main
    parts.variables.append("pw : WORD := 16#1234; pd : DWORD; pl : LWORD := 16#8000_0000_0000_0001; pi : INT := -2;")
    for name, type in {"pw": "WORD", "pd": "DWORD", "pl": "LWORD"}.items():
        width = WIDTH[type]
        scope.add(type, name)
        scope.add("BOOL", f"{name}.%X{draw.randrange(width)}", f"{name}.%X{draw.one(0, 7, 8, width - 1)}")
        scope.add("BYTE", f"{name}.%B{draw.randrange(width // 8)}")
        if width > 16:
            scope.add("WORD", f"{name}.%W{draw.randrange(width // 16)}")
    scope.add("DWORD", f"pl.%D{draw.randrange(2)}")
    scope.add("INT", "pi")
    scope.add("BOOL", f"pi.{draw.randrange(16)}", f"pl.{draw.randrange(64)}")


def unions(parts: Parts) -> None:
    """The ingredient."""
    scope = parts.main
    parts.declarations.append(
        "TYPE Mix : UNION w : WORD; b : ARRAY[0..7] OF BYTE; i : INT; d : DWORD; l : LINT; r : REAL; x : LREAL; f : BOOL; END_UNION; END_TYPE"
    )
    parts.variables.append("mix, mix2 : Mix; mixes : ARRAY[1..2] OF Mix;")
    for name in ("mix", "mixes[2]"):
        for member, type in {"w": "WORD", "i": "INT", "d": "DWORD", "l": "LINT", "r": "REAL", "x": "LREAL"}.items():
            scope.add(type, f"{name}.{member}")
        scope.add("BYTE", f"{name}.b[0]", f"{name}.b[3]", f"{name}.b[ABS(v_int0 MOD 8)]")
        scope.add("BOOL", f"{name}.f")
    scope.statements.append(
        lambda draw, scope, depth: f"{draw.one('mix', 'mix2', 'mixes[1]')} := {draw.one('mix', 'mix2', 'mixes[2]')};"
    )
