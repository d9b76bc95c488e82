"""Memory of the model: arrays, structures and strings that lie there over one another, and addresses in the program's text."""

from tests.programs.expressions import expression, position
from tests.programs.scope import Draw, Parts, Scope
from tests.programs.statements import element

LOCATED = {
    "a0 AT %MX10.2": "BOOL", "a2 AT %IX0.1": "BOOL", "a1 AT %MX10.7": "BOOL", "ab AT %MB10": "BYTE", "aw AT %MW5": "WORD", "an AT %MW6": "INT",
    "ax AT %MB20": "STRING[12]", "ad AT %MD5": "DINT",
}  # fmt: skip
DECLARATIONS = """\
TYPE Spot : STRUCT n : INT; on : WORD; more : ARRAY[1..2] OF INT; END_STRUCT; END_TYPE
FUNCTION_BLOCK Reader
VAR_INPUT n : INT; END_VAR
VAR_IN_OUT flag : BOOL; spot : Spot; END_VAR
VAR_OUTPUT y : INT; END_VAR
VAR own AT %MW6 : INT; edge : R_TRIG; END_VAR
edge(CLK := flag);
IF edge.Q OR spot.on > 7 THEN y := y + own + spot.more[1]; END_IF;
y := y + Sum(spot.more, n);
END_FUNCTION_BLOCK
FUNCTION Sum : INT
VAR_IN_OUT list : ARRAY[*] OF INT; END_VAR
VAR_INPUT n : INT; END_VAR
VAR i : DINT; END_VAR
FOR i := LOWER_BOUND(list, 1) TO UPPER_BOUND(list, 1) DO Sum := Sum + list[i]; IF Sum > n THEN RETURN; END_IF; END_FOR;
END_FUNCTION
"""
LISTS = ("alist", "blist", "spot.more")


def areas(parts: Parts) -> None:
    """The ingredient."""
    scope = parts.main
    parts.declarations.append(DECLARATIONS)
    parts.variables += [f"{name} : {type};" for name, type in LOCATED.items()]
    parts.variables += [
        "alist AT %MW5 : ARRAY[1..5] OF INT; blist AT %MW6 : ARRAY[1..5] OF INT; spot AT %MB12 : Spot; kept : Spot;",
        "flags : ARRAY[1..5] OF BOOL; reader, reader2 : Reader; ton : TON; to_flag : REF_TO BOOL; to_spot : REF_TO Spot;",
    ]
    for name, type in LOCATED.items():
        scope.add(type, name.split()[0], writable="%I" not in name)
    scope.add("BOOL", "%MX10.2", "%MX12.0", "a1", "flags[2]", "aw.%X3")
    scope.add("WORD", "%MW6")
    scope.add("INT", "spot.n", "spot.more[2]", "alist[3]")
    scope.add_expression("INT", lambda draw, scope, depth: f"{draw.one(*LISTS[:2])}[{position(draw, scope)}]")
    scope.add_expression("INT", lambda draw, scope, depth: f"Sum({draw.one(*LISTS)}, {draw.randrange(100)})")
    scope.add_expression("BOOL", lambda draw, scope, depth: f"flags[{position(draw, scope)}]")
    scope.add_expression("BOOL", lambda draw, scope, depth: "(to_flag <> NULL AND_THEN to_flag^)")
    scope.statements += [_whole, _reader, _point, _timer]
    parts.end.append(_reader(parts.draw, scope, 1))


def _whole(draw: Draw, scope: Scope, depth: int) -> str:
    return draw.one(
        "alist := blist;", "spot := kept;", "kept := spot;", "blist := alist;",
        f"{element(draw, scope, 'alist')} := {expression(draw, scope, 'INT', 1)};",
    )  # fmt: skip


def _reader(draw: Draw, scope: Scope, depth: int) -> str:
    flag, spot = draw.one("a0", "a1", "flags[1]"), draw.one("spot", "kept")
    number = expression(draw, scope, "INT", 1)
    return f"{draw.one('reader', 'reader2')}(n := {number}, flag := {flag}, spot := {spot}, y => {draw.one('an', 'kept.n')});"


def _point(draw: Draw, scope: Scope, depth: int) -> str:
    return draw.one(
        "to_flag := REF(a0);", "to_flag := REF(flags[3]);", "to_spot := REF(spot);", "IF to_spot <> NULL THEN kept := to_spot^; END_IF;",
        "IF to_flag <> NULL THEN to_flag^ := NOT to_flag^; END_IF;", "IF to_spot <> NULL THEN to_spot^.more[1] := to_spot^.n; END_IF;",
    )  # fmt: skip


def _timer(draw: Draw, scope: Scope, depth: int) -> str:
    return f"ton(IN := {expression(draw, scope, 'BOOL', 1)}, PT := T#10ms); a1 := ton.Q;"
