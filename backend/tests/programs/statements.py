"""Random statements."""

from tests.programs.expressions import divisor, expression, position, variable
from tests.programs.scope import Draw, Scope

RARE = 2
"""Percent of statements that may well trap."""


def body(draw: Draw, scope: Scope, depth: int, low: int, high: int) -> str:
    """Some statements."""
    return "\n".join(statement(draw, scope, depth) for _ in range(draw.randint(low, high)))


def assignment(draw: Draw, scope: Scope) -> str:
    type = draw.of([type for type, names in scope.writable.items() if names])
    return f"{draw.of(scope.writable[type])} := {expression(draw, scope, type, 2)};"


def statement(draw: Draw, scope: Scope, depth: int) -> str:
    """One that holds others no deeper than `depth`; below 0 it is an assignment."""
    if depth < 0:
        return assignment(draw, scope)
    if scope.statements and draw.likely(35):
        return draw.of(scope.statements)(draw, scope, depth)
    if draw.likely(RARE) and scope.writable.get("INT"):
        return f"{draw.of(scope.writable['INT'])} := {variable(draw, scope, 'INT')} / {_any(draw, scope)};"
    if depth == 0 or draw.likely(55):
        return assignment(draw, scope)
    match draw.randrange(10 if scope.loops else 4):
        case 0 | 1:
            return _if(draw, scope, depth)
        case 2 | 3:
            return _case(draw, scope, depth)
        case 4 | 5 | 6:
            return _for(draw, scope, depth)
        case 7 | 8:
            return _while(draw, scope, depth)
    return _repeat(draw, scope, depth)


def _any(draw: Draw, scope: Scope) -> str:
    return draw.one(variable(draw, scope, "INT"), divisor(draw, "INT"))


def _if(draw: Draw, scope: Scope, depth: int) -> str:
    text = f"IF {expression(draw, scope, 'BOOL', 2)} THEN\n{body(draw, scope, depth - 1, 1, 2)}\n"
    while draw.likely(20):
        text += f"ELSIF {expression(draw, scope, 'BOOL', 2)} THEN\n{body(draw, scope, depth - 1, 1, 2)}\n"
    if draw.likely(50):
        text += f"ELSE\n{body(draw, scope, depth - 1, 1, 2)}\n"
    return text + "END_IF;"


def _case(draw: Draw, scope: Scope, depth: int) -> str:
    label = draw.randint(-2, 2)
    selector = (
        f"({variable(draw, scope, 'INT')} MOD {draw.randint(3, 12)})"
        if draw.likely(60)
        else expression(draw, scope, "INT", 1)
    )
    text = f"CASE {selector} OF\n{label}: {body(draw, scope, depth - 1, 1, 1)}\n"
    text += f"{label + 1}..{label + 4}, {label + 7}: {body(draw, scope, depth - 1, 1, 2)}\n"
    if draw.likely(60):
        text += f"ELSE {body(draw, scope, depth - 1, 1, 1)}\n"
    return text + "END_CASE;"


def _leave(draw: Draw, scope: Scope) -> str:
    """A statement that leaves the round or the loop, at times."""
    if draw.likely(50):
        return ""
    return f"IF {expression(draw, scope, 'BOOL', 1)} THEN {draw.one('EXIT', 'CONTINUE', 'CONTINUE', 'EXIT', 'RETURN')}; END_IF;\n"


def _round(draw: Draw, scope: Scope, depth: int) -> str:
    """The body of a loop."""
    first = body(draw, scope, depth - 1, 1, 2)
    return f"{first}\n{_leave(draw, scope)}{body(draw, scope, 0, 0, 1)}\n"


def _for(draw: Draw, scope: Scope, depth: int) -> str:
    if draw.likely(20):  # to the end of the type
        head = draw.one(
            f"ku{depth} := {draw.randint(249, 255)} TO 255", f"ku{depth} := {draw.randint(0, 9)} TO 255 BY 100",
            f"ks{depth} := {draw.randint(120, 127)} TO 127", f"ks{depth} := -120 TO -128 BY -3",
        )  # fmt: skip
        return f"FOR {head} DO\n{_round(draw, scope, depth)}END_FOR;"
    low = draw.one(str(draw.randint(-3, 3)), f"({variable(draw, scope, 'INT')} MOD 3)")
    high = draw.one(str(draw.randint(-3, 6)), f"({variable(draw, scope, 'INT')} MOD 6)")
    step = draw.one("", "", " BY 2", " BY -1", " BY -2", f" BY ({variable(draw, scope, 'INT')} MOD 3)")
    return f"FOR k{depth} := {low} TO {high}{step} DO\n{_round(draw, scope, depth)}END_FOR;"


def _while(draw: Draw, scope: Scope, depth: int) -> str:
    more = f"w{depth} < {draw.randint(1, 5)}"
    condition = f"{expression(draw, scope, 'BOOL', 1)} AND {more}" if draw.likely(60) else more
    if draw.likely(RARE):
        condition = expression(draw, scope, "BOOL", 1)  # it may well go on for ever
    return f"w{depth} := 0;\nWHILE {condition} DO\nw{depth} := w{depth} + 1;\n{_round(draw, scope, depth)}END_WHILE;"


def _repeat(draw: Draw, scope: Scope, depth: int) -> str:
    until = f"w{depth} > {draw.randint(1, 4)}"
    if draw.likely(60):
        until += f" OR {expression(draw, scope, 'BOOL', 1)}"
    return f"w{depth} := 0;\nREPEAT\nw{depth} := w{depth} + 1;\n{_round(draw, scope, depth)}UNTIL {until} END_REPEAT;"


def element(draw: Draw, scope: Scope, array: str) -> str:
    """An element of an array of five; hardly ever one that does not exist."""
    if draw.likely(RARE):
        return f"{array}[{variable(draw, scope, 'INT')}]"
    return f"{array}[{position(draw, scope)}]"
