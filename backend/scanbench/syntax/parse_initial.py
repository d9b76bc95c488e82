"""Initial values of variables, arrays and structures."""

from scanbench.syntax import parse_expression, parse_literal, tree
from scanbench.syntax.cursor import NAME, Cursor
from scanbench.syntax.lexer import Lex

BY_ORDER = "#"
"""Before the number of a member of a structure, where its value is given by order and not by name."""

# ---- initial values -----------------------------------------------------------------------------------------


def initial(c: Cursor) -> tree.Initial:
    start = c.at
    c.enter()
    try:
        if c.accept("["):
            return _array_initial(c, start)
        if c.is_("(") and c.kinds[start + 1] is NAME and (c.texts[start + 2] == ":=" or _names_part(c)):
            return _struct_initial(c)
        if c.parts and c.is_("(") and _is_list(c):
            return _by_order(c)
        return parse_expression.expression(c)
    finally:
        c.leave()


def assigned(c: Cursor) -> tree.Expression:
    """What follows `:=` among the statements: an expression, or of vendors all values of an array or structure."""
    start = c.at
    if not c.is_("[") and not (c.is_("(") and c.kinds[start + 1] is NAME and c.texts[start + 2] == ":="):
        return parse_expression.expression(c)
    given = initial(c)
    if c.texts[c.at] in parse_expression.BINARY:  # `(a := 1) + 2`
        c.at = start
        return parse_expression.expression(c)
    assert isinstance(given, tree.ArrayInit | tree.StructInit)
    return tree.Aggregate(given, c.span_from(start))


def bare_array_initial(c: Cursor) -> tree.Initial:
    """`1, 2, 3(0)`: an array's values without brackets, or in parentheses, as vendors write them."""
    start = c.at
    closed = c.is_("(") and _is_list(c) and c.accept("(")
    items = [_repeated(c)]
    while c.accept(","):
        items.append(_repeated(c))
    if closed:
        c.expect(")", "to close the initial values")
    return tree.ArrayInit(tuple(items), c.span_from(start))


def _array_initial(c: Cursor, start: int) -> tree.Initial:
    items: list[tuple[tree.Expression | None, tree.Initial]] = []
    while not c.is_("]"):
        items.append(_repeated(c))
        if not c.accept(","):
            break
    c.expect("]", "to close the initial values")
    return tree.ArrayInit(tuple(items), c.span_from(start))


def _repeated(c: Cursor) -> tuple[tree.Expression | None, tree.Initial]:
    """`3(0)` stands for `0, 0, 0`, and `3()` for three default values."""
    at = c.at
    if c.texts[at + 1] != "(" or c.kinds[at] not in (Lex.INTEGER, NAME):
        return None, initial(c)
    if c.kinds[at] is NAME and not _count_follows(c):
        return None, initial(c)  # perhaps a constant as a count, `SIZE(0)`: what it is, only the check knows
    c.take()
    count = parse_literal.literal(c, at) if c.kinds[at] is Lex.INTEGER else tree.Name(c.texts[at], c.span_of(at))
    if c.kinds[at + 2] is NAME and c.texts[at + 3] == ":=":
        return count, _struct_initial(c)
    c.expect("(", "after the count")
    value = initial(c)
    c.expect(")", "after the repeated value")
    return count, value


def _count_follows(c: Cursor) -> bool:
    """Whether `Name(` repeats a value: only a structure or an array after it cannot be a call."""
    at = c.at
    return c.texts[at + 2] in ("[", "(")


def _struct_initial(c: Cursor) -> tree.StructInit:
    start = c.expect("(", "before the members")
    members = []
    if c.parts:
        return _parts(c, start)
    while not c.is_(")"):
        name = c.name("the name of a member")
        c.expect(":=", "after the name of the member")
        members.append((c.texts[name], initial(c), c.span_of(name)))
        if not c.accept(","):
            break
    c.expect(")", "to close the initial values")
    return tree.StructInit(tuple(members), c.span_from(start))


def _is_list(c: Cursor) -> bool:
    """Whether the parenthesis has several values, `(1, (), 3)`, or nothing: SCL gives the members of a structure by order."""
    at, depth = c.at + 1, 0
    if c.texts[at] == ")":
        return True
    while c.kinds[at] is not Lex.END and c.texts[at] != ";":
        if depth == 0 and c.texts[at] in (",", ")"):
            return c.texts[at] == ","
        depth += {"(": 1, "[": 1, ")": -1, "]": -1}.get(c.texts[at], 0)
        at += 1
    return False


def _by_order(c: Cursor) -> tree.StructInit:
    """`(32, (), TRUE)`: the members by order; what is empty keeps the start value of its type."""
    start = c.take()
    members = []
    number = 0
    while not c.is_(")"):
        if c.is_("(") and c.texts[c.at + 1] == ")":
            c.take()
            c.take()
        else:
            at = c.here()
            members.append((f"{BY_ORDER}{number}", initial(c), at))
        number += 1
        if not c.accept(","):
            break
    c.expect(")", "to close the initial values")
    return tree.StructInit(tuple(members), c.span_from(start))


def _names_part(c: Cursor) -> bool:
    return c.parts and c.texts[c.at + 2] in (".", "[")


def _parts(c: Cursor, start: int) -> tree.StructInit:
    parts = []
    while not c.is_(")"):
        name = c.name("the name of a member")
        target = parse_expression.postfix(c, tree.Name(c.texts[name], c.span_of(name)), calls=False)
        c.expect(":=", "after the name of the member")
        parts.append((target, initial(c)))
        if not c.accept(","):
            break
    c.expect(")", "to close the initial values")
    return tree.StructInit((), c.span_from(start), tuple(parts))
