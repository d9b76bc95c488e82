"""Random literals and expressions of a given type."""

from collections.abc import Callable

from tests.programs.scope import BITS, INTEGERS, REALS, TEXT, WIDTH, Draw, Scope

Sub = Callable[..., str]
"""Gives an expression of the type asked for, or of one of several."""
LITERALS: dict[str, Callable[[Draw], str]] = {}
"""Of types that an ingredient brings."""


def bounds(type: str) -> tuple[int, int]:
    width = WIDTH[type]
    return (-(1 << width - 1), (1 << width - 1) - 1) if type in INTEGERS[:4] else (0, (1 << width) - 1)


def literal(draw: Draw, type: str) -> str:
    if type in WIDTH:
        low, high = bounds(type)
        if draw.likely(50):
            return f"{type}#{draw.one(low, low + 1, high, high - 1, 0, 1, 2, 3, 7)}"
        return f"{type}#{draw.randint(low, high) if draw.likely(40) else draw.randint(max(low, -20), 100)}"
    match type:
        case "BOOL":
            return draw.one("TRUE", "FALSE")
        case "TIME":
            return f"T#{draw.randint(-5000, 5000)}ms"
        case "REAL" | "LREAL":
            value = draw.one(
                float(draw.randint(-3, 3)), draw.uniform(-1e3, 1e3), draw.uniform(-1, 1) * 10.0 ** draw.randint(-38, 37)
            )
            return f"{type}#{value:.7e}" if type == "REAL" else f"{type}#{value!r}"
        case "STRING[12]":
            return f"'{''.join(draw.choices('abcXYZ 019-', k=draw.randint(0, 14)))}'"
    return LITERALS[type](draw)


def expression(draw: Draw, scope: Scope, type: str, depth: int) -> str:
    """An expression of exactly this type."""
    names = scope.readable.get(type)
    if depth <= 0 or draw.likely(15):
        return draw.of(names) if names and draw.likely(75) else literal(draw, type)
    makers = scope.expressions.get(type)
    if makers and (type not in COMMON or draw.likely(30)):
        return draw.of(makers)(draw, scope, depth)

    def sub(*wanted: str) -> str:
        return expression(draw, scope, wanted[0] if len(wanted) == 1 else scope.known(draw, *wanted), depth - 1)

    if type in INTEGERS:
        return _integer(draw, scope, sub, type)
    if type in BITS:
        return _bits(draw, scope, sub, type)
    if type in REALS:
        return _real(draw, scope, sub, type)
    match type:
        case "BOOL":
            return _bool(draw, scope, sub)
        case "TIME":
            return _time(draw, sub)
        case "STRING[12]":
            return _string(draw, sub)
    return draw.of(names) if names else literal(draw, type)


COMMON = {*INTEGERS, *BITS, *REALS, "BOOL", "TIME", TEXT}
"""Types that have expressions without any ingredient."""


def variable(draw: Draw, scope: Scope, type: str) -> str:
    """A name to read, so that nothing is known of the value when the program is checked."""
    return draw.of(scope.readable[type])


def position(draw: Draw, scope: Scope, depth: int = 1) -> str:
    """A number from 1 to 5."""
    return f"1 + ABS(INT_TO_DINT({variable(draw, scope, 'INT')} + {expression(draw, scope, 'INT', depth - 1)})) MOD 5"


def _bool(draw: Draw, scope: Scope, sub: Sub) -> str:
    choice = draw.randrange(10)
    if choice < 4:
        return f"({sub('BOOL')} {draw.one('AND', 'OR', 'XOR', '=', '<>', '&')} {sub('BOOL')})"
    if choice < 5:
        return f"NOT {sub('BOOL')}"
    type = scope.known(draw, *INTEGERS, *BITS, *REALS, "TIME", TEXT)
    if choice == 9:
        return f"{draw.one('GT', 'GE', 'EQ', 'LE', 'LT')}({sub(type)}, {sub(type)}, {sub(type)})"
    return f"({sub(type)} {draw.one('=', '<>', '<', '<=', '>', '>=')} {sub(type)})"


def _time(draw: Draw, sub: Sub) -> str:
    match draw.randrange(5):
        case 0 | 1:
            return f"({sub('TIME')} {draw.one('+', '-')} {sub('TIME')})"
        case 3:
            return _chosen(draw, sub, "TIME")
        case 2:
            return f"({sub('TIME')} * {sub('INT', 'DINT', 'REAL')})"
    return f"DINT_TO_TIME({sub('DINT')})"


def _string(draw: Draw, sub: Sub) -> str:
    match draw.randrange(9):
        case 7:
            return _chosen(draw, sub, TEXT)
        case 0 | 1:
            return f"CONCAT({sub(TEXT)}, {sub(TEXT)})"
        case 2:
            return f"MID({sub(TEXT)}, {sub('SINT')}, {sub('SINT')})"
        case 3:
            return f"REPLACE({sub(TEXT)}, {sub(TEXT)}, {sub('SINT')}, {sub('INT')})"
        case 4:
            return f"INSERT({sub(TEXT)}, {sub(TEXT)}, {sub('SINT')})"
        case 5:
            return f"DELETE({sub(TEXT)}, {sub('USINT')}, {sub('SINT')})"
        case 6:
            return f"{draw.one('LEFT', 'RIGHT')}({sub(TEXT)}, {sub('SINT')})"
    return f"DINT_TO_STRING({sub('DINT')})"


def _real(draw: Draw, scope: Scope, sub: Sub, type: str) -> str:
    choice = draw.randrange(12)
    if choice < 5:
        return f"({sub(type)} {draw.one(*'+-*/')} {sub(type)})"
    if choice == 10:
        return _chosen(draw, sub, type)
    if choice == 11:
        return f"{draw.one('EXPT', 'ATAN2')}({sub(type)}, {sub(type)})"
    if choice == 5:
        return f"(-{sub(type)})"
    if choice < 8:
        other = scope.known(draw, "LINT", "UDINT", "LREAL" if type == "REAL" else "REAL", "ULINT", "INT")
        return f"{other}_TO_{type}({sub(other)})"
    if choice == 8:
        return f"{draw.one('ABS', 'SQRT', 'SIN', 'EXP', 'LN', 'ATAN', 'LOG', 'COS', 'ASIN')}({sub(type)})"
    return f"{draw.one('MIN', 'MAX')}({sub(type)}, {sub(type)})"


def _bits(draw: Draw, scope: Scope, sub: Sub, type: str) -> str:
    choice = draw.randrange(11)
    if choice < 5:
        return f"({sub(type)} {draw.one('AND', 'OR', 'XOR')} {sub(type)})"
    if choice == 10:
        return _chosen(draw, sub, type)
    if choice == 5:
        return f"NOT {sub(type)}"
    if choice < 8:
        return f"{draw.one('SHL', 'SHR', 'ROL', 'ROR')}({sub(type)}, {sub('SINT')})"
    other = scope.known(draw, *INTEGERS, *(each for each in BITS if each != type))
    return f"{other}_TO_{type}({sub(other)})"


def _integer(draw: Draw, scope: Scope, sub: Sub, type: str) -> str:
    choice = draw.randrange(23)
    if choice == 20:
        return f"TRUNC_{type}({sub(*REALS)})"
    if choice > 20:
        return _chosen(draw, sub, type)
    if choice < 10:
        return f"({sub(type)} {draw.one('+', '-', '*', 'MOD')} {sub(type)})"
    if choice < 12:
        return f"({sub(type)} / {divisor(draw, type)})"
    if choice == 12:
        return f"(-{sub(type)})"
    if choice < 16:
        other = scope.known(draw, *(each for each in INTEGERS if each != type), *BITS, *REALS, "BOOL")
        return f"{other}_TO_{type}({sub(other)})"
    if choice < 18:
        return f"{draw.one('MIN', 'MAX')}({sub(type)}, {sub(type)})"
    if type == "INT":
        return f"FIND({sub(TEXT)}, {sub(TEXT)})"
    return f"SEL({sub('BOOL')}, {sub(type)}, {sub(type)})"


def _chosen(draw: Draw, sub: Sub, type: str) -> str:
    """The functions of selection, which any elementary type has."""
    return draw.one(
        f"LIMIT({sub(type)}, {sub(type)}, {sub(type)})",
        f"MUX({sub('INT', 'USINT')}, {sub(type)}, {sub(type)}, {sub(type)})",
        f"{draw.one('MIN', 'MAX')}({sub(type)}, {sub(type)}, {sub(type)})",
        f"SEL({sub('BOOL')}, {sub(type)}, {sub(type)})",
    )


def divisor(draw: Draw, type: str) -> str:
    """Hardly ever zero: what follows a trap is not compared."""
    low, high = bounds(type)
    return f"{type}#{draw.one(2, 3, 7, high, max(low, -1) or 1, low or 1)}"
