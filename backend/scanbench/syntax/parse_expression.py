"""Expressions of Structured Text."""

import re

from scanbench.problems import Span
from scanbench.syntax import tree
from scanbench.syntax.cursor import NAME, Cursor, Unexpected
from scanbench.syntax.lexer import DATA, Lex
from scanbench.syntax.parse_generic import chosen_type
from scanbench.syntax.parse_literal import literal
from scanbench.syntax.source import Stretch

BINARY: dict[str, tuple[int, str]] = {
    "OR": (0, "or"), "OR_ELSE": (0, "or_else"), "XOR": (1, "xor"), "AND": (2, "and"), "&": (2, "and"),
    "AND_THEN": (2, "and_then"), "=": (3, "eq"), "<>": (3, "ne"), "<": (4, "lt"), ">": (4, "gt"), "<=": (4, "le"),
    ">=": (4, "ge"), "+": (5, "add"), "-": (5, "sub"), "*": (6, "mul"), "/": (6, "div"), "MOD": (6, "mod"),
    "**": (7, "pow"),
}  # fmt: skip
"""Strength of the operators, 0 the weakest (IEC 61131-3, table 71); all are left-associative, and `-x` is stronger than all."""

ASSIGN = "assign"
"""The operator of an assignment inside of an expression."""
_IN_DATA = re.compile(r"%DB(?:([BWD])(\d{1,5})|X(\d{1,5})\.([0-7]))", re.IGNORECASE)
UNARY = {"-": "neg", "+": "plus", "NOT": "not"}
POSTFIX = frozenset((".", "[", "(", "^"))
QUOTED_NAME = POSTFIX | {":="}
FUNCTION_FORMS = ("AND", "OR", "XOR", "MOD")
"""Operators that are also functions: `AND(a, b)`."""
LITERALS = frozenset((Lex.INTEGER, Lex.REAL, Lex.TIME, Lex.STRING, Lex.TYPED))
REFUSED = {
    "__CATCH": "check before you compute; a trap stops the PLC",
    "__CURRENTTASK": "there is no information about tasks at run time",
}
FOREIGN = {
    "==": "write `=`",
    "&&": "write AND",
    ">>": "write SHR(value, count)",
    "<<": "write SHL(value, count)",
    **{f"{operator}=": f"write `x := x {operator} ...`" for operator in "+-*/"},
}
"""Operators of other languages that are read as two of ours."""
UNITS = frozenset(("d", "h", "m", "s", "ms", "us", "ns"))
MAX_CHAIN = 1000
POINTER_TO = "POINTER TO"
"""What a name begins with that stands for a type of pointers."""
SIZES = frozenset("SIZEOF XSIZEOF".split())


def expression(c: Cursor, weakest: int = 0) -> tree.Expression:
    """Operands joined by operators that are no weaker than this."""
    left, count = operand(c), 0
    texts = c.texts
    while (found := BINARY.get(texts[c.at])) is not None and found[0] >= weakest:
        c.at += 1
        right = expression(c, found[0] + 1)
        left = tree.BinaryOp(found[1], left, right, left.span.to(right.span))
        count += 1
        if count > MAX_CHAIN:
            raise c.fail(f"more than {MAX_CHAIN} operands in one expression; split it up")
    return left


def assignment(c: Cursor) -> tree.Expression:
    """An expression, or as vendors have it an assignment that is one: `b := x <= 0` has the value that `b` has then."""
    left = expression(c)
    if not c.accept(":="):
        return left
    right = assignment(c)
    return tree.BinaryOp(ASSIGN, left, right, left.span.to(right.span))


def operand(c: Cursor) -> tree.Expression:
    at, texts = c.at, c.texts
    kind = c.kinds[at]
    if kind is NAME and at != c.wall:
        text = texts[at]
        c.at = at + 1
        start = c.starts[at]
        span = Stretch(c.source, start, start + len(text))
        if texts[at + 1] == "<" and (chosen := chosen_type(c)):
            return postfix(c, tree.Name(f"{text}<{chosen}>", span))
        if (
            texts[at + 1] == "#" and c.kinds[at + 2] is NAME and c.wires is None
        ):  # `State# RUN`, as SIMATIC AX lets one write it
            c.at = at + 3
            return tree.TypedName(text, texts[at + 2], c.span_from(at))
        name = tree.Name(text, span)
        return postfix(c, name) if texts[at + 1] in POSTFIX else name
    if kind in LITERALS:
        c.at = at + 1
        if kind is Lex.STRING and texts[at][0] == '"' and texts[at + 1] in QUOTED_NAME:
            raise c.quoted(at)
        if kind is Lex.INTEGER and c.kinds[at + 1] is NAME and c.end_of(at) == c.starts[at + 1]:
            raise _no_number(c, at)
        return literal(c, at)
    if kind is Lex.ADDRESS:
        c.at = at + 1
        return tree.DirectAddress(texts[at], c.span_of(at))
    return _marked(c, at, texts[at])


def _no_number(c: Cursor, at: int) -> Unexpected:
    """Refuses `5s` and `3x`."""
    written = c.texts[at] + c.texts[at + 1]
    unit = c.texts[at + 1].lower() in UNITS
    hint = f"a time is written `T#{written}`" if unit else "a name begins with a letter, and an operator is before it"
    c.report("S003", f"`{written}` is neither a number nor a name: {hint}.", c.span_from(at))
    return Unexpected()


def _marked(c: Cursor, at: int, text: str) -> tree.Expression:
    """An operand that begins with an operator or keyword."""
    if text == "(":
        c.take()
        c.enter()
        inner = assignment(c)
        c.leave()
        c.expect(")", "to close the parenthesis")
        return postfix(c, inner) if c.is_("^", ".", "[") else inner
    if text in ("TRUE", "FALSE"):
        c.take()
        return tree.Literal("bool", int(text == "TRUE"), None, c.span_of(at))
    formal_not = text == "NOT" and c.texts[at + 1] == "(" and c.texts[at + 3] == ":="
    if (text in FUNCTION_FORMS or formal_not) and c.texts[at + 1] == "(":
        c.take()
        return postfix(c, tree.Name(text, c.span_of(at)))
    if text in UNARY:
        c.take()
        c.enter()
        inner = operand(c)
        c.leave()
        return tree.UnaryOp(UNARY[text], inner, c.span_from(at))
    if text == "&" and "&" not in (c.texts[at - 1], c.texts[at + 1]):
        c.take()
        c.enter()
        inner = operand(c)
        c.leave()
        return tree.UnaryOp("address", inner, c.span_from(at))
    if text == "#" and c.kinds[at + 1] is NAME:
        c.take()
        if c.wires is None:
            return operand(c)  # `#local`, as one vendor writes its local variables
        c.take()
        c.wires.add(c.texts[at + 1].upper())
        return postfix(c, tree.Name(f"#{c.texts[at + 1]}", c.span_from(at)), calls=False)
    twice = c.texts[at - 2 : at]
    if twice in (["+", "+"], ["-", "-"]) and c.end_of(at - 2) == c.starts[at - 1]:
        sign = twice[0]
        c.report(
            "S003", f"`{2 * sign}` is of another language; write `x := x {sign} 1`.",
            c.source.span(c.starts[at - 2], c.starts[at - 1] + 1),
        )  # fmt: skip
        raise Unexpected
    foreign = FOREIGN.get(c.texts[at - 1] + text)
    if foreign and c.starts[at - 1] + len(c.texts[at - 1]) == c.starts[at]:
        c.report("S003", f"`{c.texts[at - 1]}{text}` is of another language; {foreign}.", c.span_from(at - 1))
        raise Unexpected
    raise c.fail("an expression (a value, variable or call) expected")


def postfix(c: Cursor, base: tree.Expression, calls: bool = True) -> tree.Expression:
    """What follows a variable: `.member`, `[index]`, `(arguments)`, `^`, `.3`."""
    count = 0
    while (text := c.texts[c.at]) in POSTFIX:
        if text == ".":
            c.at += 1
            base = _member(c, base)
        elif text == "[":
            c.at += 1
            c.enter()
            indices = _list(c)
            c.leave()
            end = c.expect("]", "to close the index")
            base = tree.IndexOf(base, indices, base.span.to(c.span_of(end)))
        elif text == "^":
            base = tree.Dereference(base, base.span.to(c.here()))
            c.at += 1
        elif calls:
            base = _call(c, base)
        else:
            break
        count += 1
        if count > MAX_CHAIN:
            raise c.fail(f"more than {MAX_CHAIN} members, indices and calls in a row")
    return base


def _list(c: Cursor) -> tuple[tree.Expression, ...]:
    found = [expression(c)]
    while c.accept(","):
        found.append(expression(c))
    return tuple(found)


def _member(c: Cursor, base: tree.Expression) -> tree.Expression:
    at = c.at
    text, kind = c.texts[at], c.kinds[at]
    if kind is NAME:
        c.at = at + 1
        return tree.MemberOf(base, text, base.span.to(c.span_of(at)))
    if kind is Lex.INTEGER and text.isdigit() and len(text) < 4:
        c.at = at + 1
        return tree.PartialAccess(base, "X", int(text), base.span.to(c.span_of(at)))
    if kind is Lex.ADDRESS and (inside := _IN_DATA.fullmatch(text)):
        c.at = at + 1
        index = 8 * int(inside[2] or inside[3]) + int(inside[4] or 0)
        return tree.PartialAccess(base, f"{DATA}{(inside[1] or 'X').upper()}", index, base.span.to(c.span_of(at)))
    if kind is Lex.ADDRESS:
        size, (number, *bit) = text[1:2].upper(), text[2:].split(".")
        if size in "XBWDL" and all(each.isdigit() and len(each) < 4 for each in (number, *bit)) and len(bit) < 2:
            c.at = at + 1
            span = base.span.to(c.span_of(at))
            part = tree.PartialAccess(base, size, int(number), span)
            return tree.PartialAccess(part, "X", int(bit[0]), span) if bit else part
        raise c.fail("a part of a variable is written like x.%X3, x.%B1, x.%W0, x.%D0 or x.%B1.3")
    if kind is Lex.TYPED and (owner := _path(base)):
        c.at = at + 1
        return literal(c, at, owner + ".")
    if kind is Lex.KEYWORD and text not in ("AND", "OR", "XOR", "MOD", "NOT"):
        raise c.fail(f"the name of a member expected; `{text}` is a keyword and cannot be a name")
    raise c.fail("the name of a member expected")


def _call(c: Cursor, callee: tree.Expression) -> tree.Call:
    _refuse(c, callee)
    if isinstance(callee, tree.Name) and callee.name.upper() in SIZES and (of_pointer := _pointer_type(c)) is not None:
        return tree.Call(callee, (of_pointer,), _through(c, callee))
    if isinstance(callee, tree.Name) and callee.name.upper() == "__NEW":
        made = _new_pointers(c) or _new_generic(c)
        if made is not None:
            return tree.Call(callee, made, _through(c, callee))
    return tree.Call(callee, arguments(c, "call"), _through(c, callee))


def _new_generic(c: Cursor) -> tuple[tree.Argument, ...] | None:
    """`(FB<5>)` and `(FB<5>(limit := 3))` of vendors, where memory for a block with generic constants is asked for."""
    if not c.word(1) or c.texts[c.at + 2] != "<":
        return None
    c.take()
    start = c.take()
    c.take()
    values = [operand(c)]
    while c.accept(","):
        values.append(operand(c))
    c.expect(">", "to close the values of the generic constants")
    span = c.span_from(start)
    c.asked.append(tree.NamedType(c.texts[start], span, tuple(values)))
    numbers = [each.value for each in values if isinstance(each, tree.Literal) and isinstance(each.value, int)]
    if len(numbers) != len(values):
        c.report(
            "X001",
            "`__NEW` takes numbers as values of generic constants here; write a number, or declare a variable.",
            span,
        )
    made: tree.Expression = tree.Name(f"{c.texts[start]}<{', '.join(map(str, numbers))}>", span)
    if c.is_("("):
        made = tree.Call(made, arguments(c, "call"), c.span_from(start))
    what = "call"
    c.expect(")", f"to close the {what}")
    return (tree.Argument(None, False, made, span),)


def _new_pointers(c: Cursor) -> tuple[tree.Argument, ...] | None:
    """`(POINTER TO type, count)` of vendors, where memory for pointers is asked for."""
    if c.word(1) != "POINTER" or c.texts[c.at + 2] != "TO":
        return None
    c.take()
    start = c.at
    pointers = 0
    while c.word() == "POINTER" and c.texts[c.at + 1] == "TO":
        c.at += 2
        pointers += 1
    named = f"{POINTER_TO} " * pointers + c.qualified("a type")
    span = c.span_from(start)
    made = [tree.Argument(None, False, tree.Name(named, span), span)]
    while c.accept(","):
        value = expression(c)
        made.append(tree.Argument(None, False, value, value.span))
    what = "call"
    c.expect(")", f"to close the {what}")
    return tuple(made)


def _pointer_type(c: Cursor) -> tree.Argument | None:
    """`(POINTER TO type)` of vendors, where a size is asked for."""
    if c.word(1) not in ("POINTER", "REFERENCE") or c.texts[c.at + 2] != "TO":
        return None
    c.take()
    start = c.at
    while c.word() in ("POINTER", "REFERENCE") and c.texts[c.at + 1] == "TO":
        c.at += 2
    c.qualified("a type")
    span = c.span_from(start)
    what = "call"
    c.expect(")", f"to close the {what}")
    return tree.Argument(None, False, tree.Name(POINTER_TO, span), span)


def _through(c: Cursor, first: tree.Expression) -> Span:
    """From an expression to the last token taken."""
    return first.span.to(c.span_of(c.at - 1))


def _refuse(c: Cursor, callee: tree.Expression) -> None:
    if isinstance(callee, tree.Name) and callee.name.upper() in REFUSED:
        why = REFUSED[callee.name.upper()]
        c.report("X001", f"`{callee.name}` is not supported: {why}.", callee.span)
        raise Unexpected


def arguments(c: Cursor, of: str) -> tuple[tree.Argument, ...]:
    """`(a, name := b, name => c)`."""
    c.expect("(", f"to open the {of}")
    c.enter()
    found: list[tree.Argument] = []
    while c.texts[c.at] != ")":
        if c.kinds[c.at] is NAME and c.texts[c.at + 1] == ":=" and c.texts[c.at + 2] in (",", ")"):
            c.at += 2  # `name := ,` of vendors: the input keeps its value
        else:
            found.append(argument(c))
        if not c.accept(","):
            break
    c.leave()
    c.expect(")", f"to close the {of}")
    return tuple(found)


def argument(c: Cursor) -> tree.Argument:
    at = c.at
    if c.kinds[at] is NAME and c.texts[at + 1] in (":=", "=>"):
        c.at = at + 2
        output = c.texts[at + 1] == "=>"
        if output and c.texts[c.at] in (",", ")"):
            return tree.Argument(c.texts[at], output, None, c.span_from(at), place=c.span_of(at))
        value = expression(c)
        return tree.Argument(c.texts[at], output, value, c.span_from(at), place=c.span_of(at))
    if c.texts[at] == "NOT" and c.kinds[at + 1] is NAME and c.texts[at + 2] == "=>":
        c.at = at + 3
        value = expression(c)
        return tree.Argument(c.texts[at + 1], True, value, c.span_from(at), negated=True, place=c.span_of(at + 1))
    value = expression(c)
    return tree.Argument(None, False, value, value.span)


def _path(expression: tree.Expression) -> str:
    """`A.B` of names joined by dots, else nothing."""
    parts: list[str] = []
    while isinstance(expression, tree.MemberOf):
        parts.append(expression.name)
        expression = expression.owner
    return ".".join([expression.name, *reversed(parts)]) if isinstance(expression, tree.Name) else ""
