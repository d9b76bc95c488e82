"""Bodies in Instruction List, with jumps, and a configuration with several tasks."""

from tests.programs.expressions import expression, literal
from tests.programs.scope import COUNTERS, Draw, Parts, Scope
from tests.programs.statements import body

VALUES = {"INT": ["x", "y", "n"], "BOOL": ["b", "q"], "REAL": ["r"], "WORD": ["w"]}
INSTANCES = "tim : TON; edge : R_TRIG;"


def instruction_lists(parts: Parts) -> None:
    """The ingredient: a block and a function in IL."""
    draw, scope = parts.draw, parts.main
    parts.declarations += [
        "FUNCTION_BLOCK Listed\nVAR_INPUT x : INT; b : BOOL; END_VAR\nVAR_OUTPUT y : INT; q : BOOL; END_VAR\n"
        f"VAR n : INT := 2; r : REAL := 0.5; w : WORD := 16#00FF; {INSTANCES} END_VAR\n{_list(draw)}END_FUNCTION_BLOCK",
        "FUNCTION Rated : INT\nVAR_INPUT x : INT; b : BOOL; END_VAR\nVAR y, n : INT; q : BOOL; r : REAL; w : WORD; END_VAR\n"
        f"{_list(draw, instances=False)}LD y\nADD x\nST Rated\nEND_FUNCTION",
    ]
    parts.variables.append("listed, listed2 : Listed;")
    scope.add("INT", "listed.y", writable=False)
    scope.add_expression("INT", _rated)
    scope.statements.append(_listed)


def _rated(draw: Draw, scope: Scope, depth: int) -> str:
    return f"Rated({expression(draw, scope, 'INT', depth - 1)}, {expression(draw, scope, 'BOOL', depth - 1)})"


def _listed(draw: Draw, scope: Scope, depth: int) -> str:
    x, b = expression(draw, scope, "INT", 1), expression(draw, scope, "BOOL", 1)
    return f"{draw.one('listed', 'listed2')}(x := {x}, b := {b}{draw.one('', ', y => v_int0')});"


def _list(draw: Draw, instances: bool = True) -> str:
    """Instructions in blocks; a jump goes to the beginning of a block, where nothing is in the current result."""
    blocks = draw.randint(2, 4)
    lines: list[str] = []
    for number in range(blocks):
        lines.append(f"at{number}:")
        for _ in range(draw.randint(1, 3)):
            lines += _network(draw, instances)
        if draw.likely(60):
            lines += _jump(draw, draw.randrange(blocks), number)
    return "\n".join(lines) + "\n"


def _jump(draw: Draw, to: int, here: int) -> list[str]:
    if to > here:
        return draw.one(["LD q", f"JMPC at{to}"], [f"JMP at{to}"], ["LDN b", f"JMPCN at{to}"], ["LD b", "RETC"])
    # backward: counts, so that it ends in most cases
    return ["LD n", "ADD 1", "ST n", "GT 40", "RETC", "LD n", "MOD 5", "NE 0", f"JMPC at{to}"]


def _network(draw: Draw, instances: bool) -> list[str]:
    """From a load to a store."""
    type = draw.one("INT", "INT", "BOOL", "BOOL", "REAL", "WORD")
    lines = [f"LD{draw.one('', 'N') if type == 'BOOL' else ''} {_operand(draw, type)}"]
    for _ in range(draw.randint(0, 3)):
        lines += _operation(draw, type)
    if type in ("INT", "REAL") and draw.likely(30):
        lines.append(f"{draw.one('GT', 'GE', 'EQ', 'NE', 'LE', 'LT')} {_operand(draw, type)}")
        type = "BOOL"
    if type == "BOOL":
        store = draw.one("ST", "ST", "STN", "S", "R")
        lines.append(f"{store} q")
        if instances and draw.likely(20):
            lines += draw.one(["CAL tim(IN := q, PT := T#20ms)"], ["CALC edge(CLK := b)"], ["ST edge.CLK", "CAL edge"])
    else:
        lines.append(f"ST {draw.one(*[name for name in VALUES[type] if name not in ('x', 'b')])}")
    return lines


def _operand(draw: Draw, type: str) -> str:
    return draw.one(*VALUES[type]) if draw.likely(75) else literal(draw, type)


def _operation(draw: Draw, type: str) -> list[str]:
    operand = _operand(draw, type)
    match type:
        case "BOOL":
            op = draw.one("AND", "OR", "XOR", "ANDN", "ORN", "XORN")
            if draw.likely(30):
                return [f"{op}( {operand}", f"{draw.one('AND', 'OR', 'ORN')} {_operand(draw, type)}", ")"]
            return draw.one([f"{op} {operand}"], ["NOT"])
        case "WORD":
            return [f"{draw.one('AND', 'OR', 'XOR')} {operand}"]
    op = draw.one("ADD", "SUB", "MUL", *(["MOD"] if type == "INT" else []))
    if draw.likely(30):
        return [f"{op}( {operand}", f"{draw.one('ADD', 'MUL', 'SUB')} {_operand(draw, type)}", ")"]
    if type == "INT" and draw.likely(20):
        return draw.one([f"MAX {operand}"], [f"LIMIT {_operand(draw, type)}, 100"], ["ABS"])
    return [f"{op} {operand}"]


# ---- tasks --------------------------------------------------------------------------------------------------------


def tasks(parts: Parts) -> None:
    """The ingredient: Main in a task of its own, beside cyclic and event tasks that share globals with it."""
    draw = parts.draw
    scope = Scope()
    scope.add("INT", "n", "shared", "out")
    scope.add("INT", "given", writable=False)
    scope.add("BOOL", "go", "b")
    parts.declarations += [
        "PROGRAM Side\nVAR_INPUT given : INT; END_VAR\nVAR_OUTPUT out : INT; END_VAR\nVAR_EXTERNAL shared : INT; go : BOOL; END_VAR\n"
        f"VAR n : INT; b : BOOL; {COUNTERS} END_VAR\n{body(draw, scope, 1, 2, 4)}\nEND_PROGRAM",
    ]
    parts.main.add("BOOL", "go")
    parts.main.add("INT", "shared", "count")
    interval, priority = draw.one("", "INTERVAL := T#20ms, "), draw.randint(0, 3)
    parts.after.append(
        "CONFIGURATION Cell\nVAR_GLOBAL go : BOOL; shared, count : INT; END_VAR\nRESOURCE Cpu ON PLC\n"
        f"TASK slow(INTERVAL := T#{draw.one(10, 20, 30)}ms, PRIORITY := 2);\n"
        f"TASK event(SINGLE := go, {interval}PRIORITY := {priority});\n"
        "PROGRAM Main WITH slow : Main;\n"
        "PROGRAM first WITH event : Side(given := shared, out => count);\n"
        f"PROGRAM second{draw.one(' WITH slow', '', ' WITH event')} : Side(given := 5, out => shared);\n"
        "END_RESOURCE\nEND_CONFIGURATION"
    )
