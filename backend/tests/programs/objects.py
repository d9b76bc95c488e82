"""Methods, inheritance, interfaces; EN and ENO."""

from tests.programs.expressions import expression
from tests.programs.scope import COUNTERS, TEXT, Draw, ExpressionMaker, Parts, Scope
from tests.programs.statements import body, element, statement


def _method(draw: Draw, name: str, own: dict[str, list[str]], calls: list[str], words: str = "PUBLIC") -> str:
    """A method that returns a number and takes a number, a flag and a text that it may change."""
    scope = Scope()
    for type, names in {**own, "INT": [*own["INT"], "x", "io", name], "BOOL": ["b"]}.items():
        scope.add(type, *names)
    for call in calls:
        scope.add_expression("INT", _call_of(call))
    return (
        f"METHOD {words} {name} : INT\nVAR_INPUT x : INT; b : BOOL; END_VAR\nVAR_IN_OUT io : INT; END_VAR\n"
        f"VAR {COUNTERS} END_VAR\n{body(draw, scope, 1, 1, 3)}\nEND_METHOD\n"
    )


def _call_of(method: str) -> ExpressionMaker:
    return lambda draw, scope, depth: _called(draw, scope, method, depth)


def _called(draw: Draw, scope: Scope, method: str, depth: int) -> str:
    """A call of a method on one object."""
    x, b = expression(draw, scope, "INT", depth - 1), expression(draw, scope, "BOOL", depth - 1)
    io = draw.of([name for name in scope.writable["INT"] if "[" not in name and "%" not in name])
    return draw.one(
        f"{method}({x}, {b}, {io})", f"{method}(io := {io}, x := {x})", f"{method}(x := {x}, b := {b}, io := {io})"
    )


def objects(parts: Parts) -> None:
    """The ingredient."""
    draw, scope = parts.draw, parts.main
    base = {"INT": ["n", "y"], TEXT: ["s"]}
    derived = {**base, "INT": ["n", "y", "m"], "DINT": ["d"]}
    block = Scope()
    for type, names in {**derived, "BOOL": ["on"]}.items():
        block.add(type, *names)
    block.add_expression("INT", _call_of("THIS.Up"))
    prototype = "METHOD Up : INT\nVAR_INPUT x : INT; b : BOOL; END_VAR\nVAR_IN_OUT io : INT; END_VAR\nEND_METHOD\n"
    parts.declarations += [
        f"INTERFACE Ups\n{prototype}END_INTERFACE\n",
        "FUNCTION_BLOCK Base IMPLEMENTS Ups\nVAR_INPUT on : BOOL; END_VAR\nVAR_OUTPUT y : INT; END_VAR\nVAR PROTECTED n : INT := 3; s : STRING[12]; END_VAR\n"
        + _method(draw, "Up", base, [])
        + _method(draw, "Twice", base, ["THIS.Up"])
        + f"PROPERTY PUBLIC Kept : INT\nGET\nKept := n + 1;\nEND_GET\nSET\n{_setter(draw)}END_SET\nEND_PROPERTY\n"
        + "n := n + 1; y := n * 2;\nEND_FUNCTION_BLOCK\n",
        "FUNCTION_BLOCK Derived EXTENDS Base\nVAR m : INT; d : DINT; END_VAR\n"
        f"VAR {COUNTERS} END_VAR\n"
        + _method(draw, "Up", derived, ["SUPER.Up"], "PUBLIC OVERRIDE")
        + f"SUPER();\n{body(draw, block, 1, 1, 2)}\nEND_FUNCTION_BLOCK\n",
        "CLASS Plain IMPLEMENTS Ups\nVAR PUBLIC n, y : INT; s : STRING[12]; END_VAR\n"
        + _method(draw, "Up", base, [])
        + "END_CLASS\n",
        "FUNCTION Through : INT\nVAR_IN_OUT who : Base; END_VAR\nVAR_INPUT x : INT; END_VAR\nVAR_IN_OUT io : INT; END_VAR\n"
        "Through := who.Twice(x := x, io := io) + who.y;\nEND_FUNCTION\n",
    ]
    parts.variables.append(
        "base : Base; derived, derived2 : Derived; plain : Plain; ups, ups2 : Ups; many : ARRAY[1..5] OF Derived;\n"
        "rb : REF_TO Base; rd : REF_TO Derived;"
    )
    parts.start.append(f"ups := {draw.one('base', 'derived', 'plain')}; rb := REF(base);")
    scope.add("INT", "base.y", "derived.y", writable=False)
    scope.add("INT", "base.Kept", "derived.Kept", "many[2].Kept", writable=False)
    for each in (
        "many[1 + ABS(v_int0 MOD 5)].Up",
        "base.Up",
        "derived.Up",
        "derived.Twice",
        "derived2.Twice",
        "plain.Up",
        "ups.Up",
        "ups.Up",
    ):
        scope.add_expression("INT", _call_of(each))
    scope.add_expression("INT", _through)
    scope.statements += [_block, _turned, _kept, _attempt]


def _through(draw: Draw, scope: Scope, depth: int) -> str:
    return f"Through({draw.one('base', 'derived', 'derived2')}, {expression(draw, scope, 'INT', depth - 1)}, v_int1)"


def _block(draw: Draw, scope: Scope, depth: int) -> str:
    return f"{draw.one('base', 'derived', 'derived2', element(draw, scope, 'many'))}(on := {expression(draw, scope, 'BOOL', 1)});"


def _setter(draw: Draw) -> str:
    scope = Scope()
    scope.add("INT", "n", "y", "Kept")
    scope.add_expression("INT", _call_of("THIS.Twice"))
    return f"{statement(draw, scope, 0)}\nn := Kept;\n"


def _kept(draw: Draw, scope: Scope, depth: int) -> str:
    return f"{draw.one('base', 'derived', element(draw, scope, 'many'))}.Kept := {expression(draw, scope, 'INT', 1)};"


def _attempt(draw: Draw, scope: Scope, depth: int) -> str:
    """Assignment attempts: whether they succeed is known at run time only."""
    if draw.likely(50):
        return (
            f"rb := REF({draw.one('base', 'derived', 'many[3]')}); rd ?= rb;\n"
            f"IF rd <> NULL THEN v_int0 := {_called(draw, scope, 'rd^.Up', 1)}; END_IF;"
        )
    return f"ups2 ?= {draw.one('ups', 'rb^')};\nIF ups2 <> NULL THEN v_int0 := {_called(draw, scope, 'ups2.Up', 1)}; END_IF;"


def _turned(draw: Draw, scope: Scope, depth: int) -> str:
    return f"ups := {draw.one('base', 'derived', 'derived2', 'plain')};"


# ---- EN and ENO ---------------------------------------------------------------------------------------------------

ENABLED = """\
FUNCTION Half : INT
VAR_INPUT x : INT; END_VAR
VAR_OUTPUT rest : INT; END_VAR
Half := x / 2; rest := x MOD 2; IF x < 0 THEN ENO := FALSE; END_IF;
END_FUNCTION
FUNCTION_BLOCK Counted
VAR_INPUT by_ : INT; END_VAR
VAR_OUTPUT n : INT; END_VAR
n := n + by_;
END_FUNCTION_BLOCK
"""


def enabled(parts: Parts) -> None:
    """The ingredient."""
    scope = parts.main
    parts.declarations.append(ENABLED)
    parts.variables.append("counted, counted2 : Counted; ok : BOOL; rest : INT; tim : TON;")
    scope.add("BOOL", "ok", writable=False)
    scope.add("INT", "rest", "counted.n", writable=False)
    scope.add_expression("INT", _enabled)
    scope.statements.append(_enabled_block)


def _enabled(draw: Draw, scope: Scope, depth: int) -> str:
    en = f"EN := {expression(draw, scope, 'BOOL', depth - 1)}"
    eno = draw.one(", ENO => ok", "")
    a, b = (expression(draw, scope, "INT", depth - 1) for _ in range(2))
    return draw.one(
        f"Half({en}, x := {a}, rest => rest{eno})",
        f"Half(x := {a}{eno})",
        f"ADD({en}, IN1 := {a}, IN2 := {b}{eno})",
        f"LIMIT({en}, MN := {a}, IN := {b}, MX := v_int0{eno})",
    )


def _enabled_block(draw: Draw, scope: Scope, depth: int) -> str:
    en, eno = f"EN := {expression(draw, scope, 'BOOL', 1)}", draw.one(", ENO => ok", "")
    by = expression(draw, scope, "INT", 1)
    return draw.one(
        f"{draw.one('counted', 'counted2')}({en}, by_ := {by}, n => v_int0{eno});",
        f"tim({en}, IN := v_bool0, PT := T#20ms{eno});",
    )
