"""Wide strings, characters, dates and times of day."""

from tests.programs.expressions import LITERALS, expression, variable
from tests.programs.scope import TEXT, Draw, ExpressionMaker, Parts, Scope

WIDE = "WSTRING[9]"
DATES = ("DATE", "TIME_OF_DAY", "DATE_AND_TIME", "LTIME", "LDATE_AND_TIME")


def _wide(draw: Draw) -> str:
    return '"' + "".join(draw.choices(["a", "b", "é", "$0416", "語", "$D83D", "Z", "0"], k=draw.randint(0, 11))) + '"'


LITERALS.update(
    {
        WIDE: _wide,
        "CHAR": lambda draw: f"CHAR#'{draw.one('a', 'b', 'Z', ' ', '$FF', '$N')}'",
        "WCHAR": lambda draw: f'WCHAR#"{draw.one("a", "é", "語", "$FFFF")}"',
        "DATE": lambda draw: f"DATE#{draw.randint(1970, 2100)}-{draw.randint(1, 12):02}-{draw.randint(1, 28):02}",
        "TIME_OF_DAY": lambda draw: (
            f"TOD#{draw.randint(0, 23)}:{draw.randint(0, 59):02}:{draw.randint(0, 59):02}.{draw.randint(0, 999):03}"
        ),
        "DATE_AND_TIME": lambda draw: (
            f"DT#{draw.randint(1970, 2100)}-02-{draw.randint(1, 28):02}-{draw.randint(0, 23)}:00:{draw.randint(0, 59):02}"
        ),
        "LDATE_AND_TIME": lambda draw: f"LDT#{draw.randint(1900, 2200)}-12-31-{draw.randint(0, 23)}:59:59.999999999",
        "LTIME": lambda draw: f"LTIME#{draw.randint(-5000, 5000)}us",
    }
)


def wide_strings(parts: Parts) -> None:
    """The ingredient."""
    draw, scope = parts.draw, parts.main
    parts.declarations.append(
        f"FUNCTION Told2 : {WIDE}\nVAR_INPUT s : {WIDE}; c : WCHAR; END_VAR\nVAR_IN_OUT io : {WIDE}; END_VAR\n"
        "io := CONCAT(s, io); Told2 := CONCAT(io, WCHAR_TO_WSTRING(c));\nEND_FUNCTION"
    )
    parts.variables.append(
        f"ws0, ws1 : {WIDE} := {_wide(draw)}; ch0, ch1 : CHAR := 'x'; wc0, wc1 : WCHAR := \"y\"; wides : ARRAY[1..5] OF {WIDE};"
    )
    scope.add(WIDE, "ws0", "ws1", "wides[3]")
    scope.add("CHAR", "ch0", "ch1")
    scope.add("WCHAR", "wc0", "wc1")
    scope.add_expression(WIDE, _wide_expression)
    scope.add_expression(
        TEXT, lambda draw, scope, depth: f"WSTRING_TO_STRING({expression(draw, scope, WIDE, depth - 1)})"
    )
    scope.add_expression(
        TEXT, lambda draw, scope, depth: f"CHAR_TO_STRING({expression(draw, scope, 'CHAR', depth - 1)})"
    )
    scope.add_expression(
        "CHAR", lambda draw, scope, depth: f"STRING_TO_CHAR({expression(draw, scope, TEXT, depth - 1)})"
    )
    scope.add_expression(
        "CHAR", lambda draw, scope, depth: f"WCHAR_TO_CHAR({expression(draw, scope, 'WCHAR', depth - 1)})"
    )
    scope.add_expression(
        "WCHAR", lambda draw, scope, depth: f"CHAR_TO_WCHAR({expression(draw, scope, 'CHAR', depth - 1)})"
    )
    scope.add_expression(
        "WCHAR", lambda draw, scope, depth: f"WSTRING_TO_WCHAR({expression(draw, scope, WIDE, depth - 1)})"
    )
    scope.add_expression(
        "BYTE", lambda draw, scope, depth: f"CHAR_TO_BYTE({expression(draw, scope, 'CHAR', depth - 1)})"
    )
    scope.add_expression("INT", lambda draw, scope, depth: f"LEN({expression(draw, scope, WIDE, depth - 1)})")
    for type in (WIDE, "CHAR", "WCHAR"):
        scope.add_expression("BOOL", comparison(type))


def _wide_expression(draw: Draw, scope: Scope, depth: int) -> str:
    def sub(type: str) -> str:
        return expression(draw, scope, type, depth - 1)

    match draw.randrange(8):
        case 0 | 1:
            return f"CONCAT({sub(WIDE)}, {sub(WIDE)})"
        case 2:
            return f"MID({sub(WIDE)}, {sub('SINT')}, {sub('SINT')})"
        case 3:
            return f"REPLACE({sub(WIDE)}, {sub(WIDE)}, {sub('SINT')}, {sub('INT')})"
        case 4:
            return f"INSERT({sub(WIDE)}, {sub(WIDE)}, {sub('SINT')})"
        case 5:
            return f"{draw.one('LEFT', 'RIGHT')}({sub(WIDE)}, {sub('SINT')})"
        case 6:
            return f"Told2({sub(WIDE)}, {sub('WCHAR')}, {draw.of(scope.writable[WIDE])})"
    return f"STRING_TO_WSTRING({sub(TEXT)})"


def comparison(type: str) -> ExpressionMaker:
    """Makes comparisons of two values of the type."""

    def make(draw: Draw, scope: Scope, depth: int) -> str:
        a, b = variable(draw, scope, type), expression(draw, scope, type, depth - 1)
        return f"({a} {draw.one('=', '<>', '<', '<=', '>', '>=')} {b})"

    return make


# ---- dates --------------------------------------------------------------------------------------------------------


def dates(parts: Parts) -> None:
    """The ingredient."""
    draw, scope = parts.draw, parts.main
    for type in DATES:
        short = {"TIME_OF_DAY": "tod", "DATE_AND_TIME": "dt", "LDATE_AND_TIME": "ldt"}.get(type, type.lower())
        parts.variables.append(f"{short}0, {short}1 : {type} := {LITERALS[type](draw)};")
        scope.add(type, f"{short}0", f"{short}1")
        scope.add_expression("BOOL", comparison(type))
    of = expression
    scope.add_expression("DATE", lambda d, s, n: f"DT_TO_DATE({of(d, s, 'DATE_AND_TIME', n - 1)})")
    scope.add_expression("TIME_OF_DAY", lambda d, s, n: f"DT_TO_TOD({of(d, s, 'DATE_AND_TIME', n - 1)})")
    scope.add_expression(
        "TIME_OF_DAY", lambda d, s, n: f"({of(d, s, 'TIME_OF_DAY', n - 1)} {d.one('+', '-')} {of(d, s, 'TIME', n - 1)})"
    )
    scope.add_expression(
        "DATE_AND_TIME",
        lambda d, s, n: f"({of(d, s, 'DATE_AND_TIME', n - 1)} {d.one('+', '-')} {of(d, s, 'TIME', n - 1)})",
    )
    scope.add_expression(
        "DATE_AND_TIME", lambda d, s, n: f"CONCAT_DATE_TOD({of(d, s, 'DATE', n - 1)}, {of(d, s, 'TIME_OF_DAY', n - 1)})"
    )
    scope.add_expression(
        "LDATE_AND_TIME", lambda d, s, n: f"({of(d, s, 'LDATE_AND_TIME', n - 1)} + {of(d, s, 'LTIME', n - 1)})"
    )
    scope.add_expression("LDATE_AND_TIME", lambda d, s, n: f"DT_TO_LDT({of(d, s, 'DATE_AND_TIME', n - 1)})")
    scope.add_expression(
        "LTIME", lambda d, s, n: f"({of(d, s, 'LTIME', n - 1)} {d.one('+', '-')} {of(d, s, 'LTIME', n - 1)})"
    )
    scope.add_expression("LTIME", lambda d, s, n: f"TIME_TO_LTIME({of(d, s, 'TIME', n - 1)})")
    scope.add_expression("TIME", lambda d, s, n: f"({variable(d, s, 'DATE')} - {of(d, s, 'DATE', n - 1)})")
    scope.add_expression(
        "TIME", lambda d, s, n: f"({variable(d, s, 'DATE_AND_TIME')} - {of(d, s, 'DATE_AND_TIME', n - 1)})"
    )
    scope.add_expression(
        "TIME", lambda d, s, n: f"({variable(d, s, 'TIME_OF_DAY')} - {of(d, s, 'TIME_OF_DAY', n - 1)})"
    )
    scope.add_expression("TIME", lambda d, s, n: f"LTIME_TO_TIME({of(d, s, 'LTIME', n - 1)})")
