"""Tokens of literals -> literals of the tree."""

from scanbench.problems import Span
from scanbench.syntax import literals, tree
from scanbench.syntax.cursor import Cursor
from scanbench.syntax.lexer import TIME_TYPES, Lex

TIME_KINDS = {"TIME": "time", "DATE": "date", "TIME_OF_DAY": "tod", "DATE_AND_TIME": "dt"}
READERS = {"time": literals.duration, "date": literals.date, "tod": literals.time_of_day, "dt": literals.date_and_time}

Value = tuple[str, int | float | bytes, str | None]
"""Kind, value and type of a literal."""


def literal(c: Cursor, token: int, owner: str = "") -> tree.Literal | tree.TypedName:
    """The literal or typed name that this token is; `owner` is the namespace written before it."""
    text = c.texts[token]
    span = c.span_of(token)
    if c.kinds[token] is Lex.TYPED:
        type_name, value = text.split("#", 1)
        if (value[0] == "_" or value[0].isalpha()) and value.upper() not in ("TRUE", "FALSE"):
            return tree.TypedName(owner + type_name, value, span)
    try:
        kind, number, type_name_ = _value(c.kinds[token], text)
    except ValueError as error:
        what = "This string" if c.kinds[token] is Lex.STRING else f"`{text[:40]}`"
        c.report("S004", f"{what} cannot be read: {error}.", span)
        return _broken(c.kinds[token], text, span)
    return tree.Literal(kind, number, owner + type_name_ if type_name_ else None, span)


def _value(kind: Lex, text: str) -> Value:
    match kind:
        case Lex.INTEGER:
            return "int", literals.integer(text), None
        case Lex.REAL:
            return "real", literals.real(text), None
        case Lex.STRING:
            return _string(text, None)
    prefix, value = text.split("#", 1)
    if kind is Lex.TIME:
        type_name = TIME_TYPES[prefix.upper()]
        time_kind = TIME_KINDS[type_name.removeprefix("L")]
        return time_kind, READERS[time_kind](value), type_name
    if value[0] in "'\"":
        return _string(value, prefix)
    if value.upper() in ("TRUE", "FALSE"):
        return "bool", int(value.upper() == "TRUE"), prefix
    if "#" in value or value.replace("_", "").lstrip("+-").isdigit():
        return "int", literals.integer(value), prefix
    return "real", literals.real(value), prefix


def _string(text: str, type_name: str | None) -> Value:
    if text[0] == '"':
        return "wstring", literals.wide_string(text[1:-1]), type_name
    return "string", literals.string(text[1:-1]), type_name


def _broken(kind: Lex, text: str, span: Span) -> tree.Literal:
    """A substitute for a literal that could not be read, so that the rest is checked."""
    if kind is Lex.STRING:
        return tree.Literal("wstring" if text[0] == '"' else "string", b"", None, span)
    if kind is Lex.TIME:
        type_name = TIME_TYPES[text.split("#", 1)[0].upper()]
        return tree.Literal(TIME_KINDS[type_name.removeprefix("L")], 0, type_name, span)
    return tree.Literal("real" if kind is Lex.REAL else "int", 0, None, span)
