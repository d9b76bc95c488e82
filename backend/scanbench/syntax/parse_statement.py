"""Statements of Structured Text. A bad statement is reported and skipped; the next one is read as usual."""

from collections.abc import Callable

from scanbench.syntax import tree
from scanbench.syntax.cursor import NAME, Cursor, Unexpected
from scanbench.syntax.lexer import Lex
from scanbench.syntax.parse_expression import assignment, expression, operand
from scanbench.syntax.parse_initial import assigned
from scanbench.syntax.parse_type import POU_ENDS, POU_STARTS, SECTIONS

BLOCK_ENDS = frozenset(("END_IF", "ELSIF", "ELSE", "END_CASE", "END_FOR", "END_WHILE", "UNTIL", "END_REPEAT",
                        "__CATCH", "__FINALLY", "__ENDTRY"))  # fmt: skip
STOPS = BLOCK_ENDS | POU_ENDS | POU_STARTS | SECTIONS | {"VAR_ACCESS", "VAR_CONFIG", "END_VAR", ""}
"""What a statement cannot begin with, and where a list of them therefore ends."""
STARTS = frozenset(("IF", "CASE", "FOR", "WHILE", "REPEAT", "EXIT", "RETURN", "__TRY"))
DECLARATIONS = frozenset(
    ("METHOD", "PROPERTY", "PROPERTY_GET", "PROPERTY_SET", "ACTION", "CLASS", "INTERFACE", "NAMESPACE", "USING")
)
"""Words that begin a declaration when a name follows; no statement begins with two names."""
OPERATORS_WITH_NAME = ("S", "R", "REF")
CHART = "a chart (SFC) is a body of its own, without statements beside it"
REFUSED = {
    "GOTO": "use IF and loops",
    "TRY": "check before you compute; a trap stops the PLC",
    "REGION": "remove it, and its END_REGION",
    "END_REGION": "remove it, and its REGION",
    **dict.fromkeys(("INITIAL_STEP", "STEP", "END_STEP", "TRANSITION", "END_TRANSITION"), CHART),
    **dict.fromkeys(("_LD_BODY", "_FBD_BODY", "_CFC_BODY", "_SFC_BODY"), "convert the drawing to Structured Text"),
}
COMBINED = {"+": "add", "-": "sub", "*": "mul", "/": "div"}
"""Operators of assignments like `a += b`."""
LABEL_KINDS = frozenset((NAME, Lex.INTEGER, Lex.TYPED, Lex.STRING, Lex.TIME))
LABEL_TEXTS = frozenset(", .. . - + * / ** & ( ) MOD AND OR XOR NOT TRUE FALSE".split())
"""What a constant expression is made of. Nothing else that begins a statement reaches a `:` by way of these."""
MAX_LABELS = 1000


def statements(c: Cursor, labels: bool = False) -> tuple[tree.Statement, ...]:
    """Statements up to something that ends a block; with `labels` also up to the next label of a CASE."""
    found: list[tree.Statement] = []
    depth, kinds, texts = c.depth, c.kinds, c.texts
    while (text := texts[before := c.at]) not in STOPS:
        if text == ";":
            c.at += 1
            continue
        name = kinds[before] is NAME
        if name and (before == c.wall or (kinds[before + 1] is NAME and declaration_follows(c))):
            break
        if labels and _at_label(c):
            break
        try:
            keyword = KEYWORDS.get(text)
            if keyword is None:
                found.append(_simple(c, name))
            else:
                c.enter(POU_ENDS)
                found.append(keyword(c))
                c.depth = depth
        except Unexpected:
            c.depth = depth
            _skip(c, before)
    return tuple(found)


def declaration_follows(c: Cursor) -> bool:
    """Whether METHOD, or a word like it, begins a declaration here."""
    return c.word() in DECLARATIONS and (c.word(1) not in OPERATORS_WITH_NAME or c.texts[c.at + 2] != "=")


def _skip(c: Cursor, before: int) -> None:
    """To the beginning of what may be the next statement; always at least one token on."""
    if c.at == before:
        c.take()
    line = c.line_of(c.at - 1)
    while (text := c.texts[c.at]) not in STOPS and text not in STARTS and c.at != c.wall:
        if c.kinds[c.at] is NAME and c.line_of(c.at) > line:
            if c.texts[c.at + 1] in (":=", "(", ".", "[") or declaration_follows(c):
                return
        c.take()
        if text == ";":
            return


def _simple(c: Cursor, name: bool) -> tree.Statement:
    """An assignment, a call, or a word that is a statement only when nothing else follows it."""
    start = c.at
    if name and c.texts[start + 1] not in (":=", "(", ".", "["):
        word = c.word()
        if word == "CONTINUE" and (c.texts[start + 1] == ";" or c.texts[start + 1] in STOPS):
            c.take()
            c.close(";", "after CONTINUE")
            return tree.ContinueStatement(c.span_of(start))
        if word == "JMP" and c.kinds[start + 1] is NAME and c.texts[start + 2] == ";":
            c.at += 3
            return tree.JumpStatement(c.texts[start + 1], c.span_of(start))
        if c.texts[start + 1] == ":":
            c.at += 2
            return tree.LabelStatement(c.texts[start], c.span_of(start))
        _refused(c, word)
    combined = _combined(c) if c.combines else None
    if combined is not None:
        return combined
    target = expression(c)
    if c.accept(":="):
        value = assigned(c)
        also = []
        while c.accept(":="):
            also.append(value)
            value = assigned(c)
        span = c.span_from(start)
        c.close(";", "at the end of the assignment")
        return tree.Assignment(target, value, span, also=tuple(also))
    return _other(c, start, target)


def _combined(c: Cursor) -> tree.Assignment | None:
    """`a += b`, the same for `-`, `*` and `/`; None of any other statement, of which nothing is taken."""
    start = c.at
    target = operand(c)
    operator = c.texts[c.at]
    if operator not in COMBINED or c.texts[c.at + 1] != "=" or c.end_of(c.at) != c.starts[c.at + 1]:
        c.at = start
        return None
    mark = c.source.span(c.starts[c.at], c.starts[c.at] + 2)
    c.at += 2
    value = tree.BinaryOp(COMBINED[operator], target, expression(c), mark)
    span = c.span_from(start)
    c.close(";", "at the end of the assignment")
    return tree.Assignment(target, value, span, f"{operator}=")


def _other(c: Cursor, start: int, target: tree.Expression) -> tree.Statement:
    word = c.word()
    if word in OPERATORS_WITH_NAME and c.texts[c.at + 1] == "=":
        c.at += 2
        return _assigned(c, start, target, word + "=")
    if c.accept("?="):
        return _assigned(c, start, target, "?=")
    if isinstance(target, tree.BinaryOp) and target.op == "eq":
        c.report("S003", "An assignment is written `:=`; `=` compares.", target.span)
        c.close(";", "at the end of the statement")
        return tree.Assignment(target.left, target.right, target.span)
    span = c.span_from(start)
    if not isinstance(target, tree.Call) and not c.is_(";"):
        raise c.fail("`:=` or `;` expected")
    c.close(";", "at the end of the call" if isinstance(target, tree.Call) else "at the end of the statement")
    return tree.ExpressionStatement(target, span)


def _assigned(c: Cursor, start: int, target: tree.Expression, operator: str) -> tree.Statement:
    value = expression(c)
    span = c.span_from(start)
    c.close(";", "at the end of the assignment")
    return tree.Assignment(target, value, span, operator)


def _refused(c: Cursor, word: str) -> None:
    latched = c.word(1) in OPERATORS_WITH_NAME and c.texts[c.at + 2] == "="
    if word in REFUSED and (word[0] == "_" or (c.texts[c.at + 1] not in (";", "?=", "=", "^") and not latched)):
        c.report("X001", f"{word} is not supported; {REFUSED[word]}.", c.here())
        raise Unexpected


def _exit(c: Cursor) -> tree.Statement:
    start = c.take()
    leaves = c.texts[start] == "EXIT"
    condition = expression(c) if not leaves and c.is_("(") else None
    c.close(";", f"after {c.texts[start]}")
    span = c.span_of(start)
    return tree.ExitStatement(span) if leaves else tree.ReturnStatement(span, condition)


def _condition(c: Cursor, keyword: str) -> tree.Expression:
    start, depth = c.at, c.depth
    try:
        condition = assignment(c)
    except Unexpected:
        c.depth = depth
        if not _reach(c, keyword):
            raise
        return tree.Literal("bool", 0, None, c.span_of(start))
    if not c.accept(keyword):
        c.close(keyword, "after the selector" if keyword == "OF" else "after the condition")
    return condition


def _reach(c: Cursor, keyword: str) -> bool:
    """Goes after the keyword, if it comes before the statement ends."""
    at = c.at
    while c.texts[at] not in STOPS and c.texts[at] not in STARTS and c.texts[at] not in (";", ":=", keyword):
        at += 1
    if c.texts[at] != keyword or keyword == "OF":
        return False
    c.at = at + 1
    return True


def _if(c: Cursor) -> tree.Statement:
    start = c.take()
    branches = [(_condition(c, "THEN"), statements(c))]
    orelse: tuple[tree.Statement, ...] = ()
    while c.accept("ELSIF"):
        branches.append((_condition(c, "THEN"), statements(c)))
    if c.accept("ELSE"):
        orelse = statements(c)
    span = c.span_from(start)
    _close_block(c, "END_IF", start)
    return tree.IfStatement(tuple(branches), orelse, span)


def _close_block(c: Cursor, keyword: str, start: int) -> None:
    if not c.accept(keyword):
        of = f"{c.texts[start]} of line {c.line_of(start)}"
        c.report("S003", f"`{keyword}` expected to close the {of}{c.found()}.", c.here())
    c.accept(";")


def _case(c: Cursor) -> tree.Statement:
    start = c.take()
    selector = _condition(c, "OF")
    span = c.span_from(start)
    branches = []
    orelse: tuple[tree.Statement, ...] = ()
    while c.texts[c.at] not in STOPS:
        if c.accept(";"):
            continue
        before = c.at
        labels = _labels(c)
        branches.append((labels, statements(c, labels=True)))
        if c.at == before:
            break
    if c.accept("ELSE"):
        c.accept(":")
        orelse = statements(c)
    _close_block(c, "END_CASE", start)
    return tree.CaseStatement(selector, tuple(branches), orelse, span)


def _labels(c: Cursor) -> tuple[tuple[tree.Expression, tree.Expression | None], ...]:
    labels = []
    depth = c.depth
    try:
        while True:
            first = expression(c)
            labels.append((first, expression(c) if c.accept("..") else None))
            if not c.accept(","):
                break
        c.expect(":", "after the label of the CASE")
    except Unexpected:
        c.depth = depth
        _skip(c, c.at)
    return tuple(labels)


def _at_label(c: Cursor) -> bool:
    """Looks for `value [.. value] {, ...} :` from here."""
    at = c.at
    kinds, texts = c.kinds, c.texts
    last = min(at + MAX_LABELS, len(texts) - 1)
    while at < last and (kinds[at] in LABEL_KINDS or texts[at] in LABEL_TEXTS):
        at += 1
    return at > c.at and texts[at] == ":"


def _for(c: Cursor) -> tree.Statement:
    start = c.take()
    variable = expression(c)
    if (
        isinstance(variable, tree.BinaryOp) and variable.op == "eq" and c.texts[c.at].upper() == "TO"
    ):  # `FOR i = 1 TO`, as in Basic
        found = "`:=` expected after the control variable of the FOR, found `=`."
        c.report("S003", found, variable.span)
        first: tree.Expression = variable.right
        variable = variable.left
    else:
        c.expect(":=", "after the control variable of the FOR")
        first = expression(c)
    c.expect("TO", "after the start value of the FOR")
    last = expression(c)
    step = expression(c) if c.accept_word("BY") else None
    c.close("DO", "after the bounds of the FOR")
    span = c.span_from(start)
    body = statements(c)
    _close_block(c, "END_FOR", start)
    return tree.ForStatement(variable, first, last, step, body, span)


def _while(c: Cursor) -> tree.Statement:
    start = c.take()
    condition = _condition(c, "DO")
    span = c.span_from(start)
    body = statements(c)
    _close_block(c, "END_WHILE", start)
    return tree.WhileStatement(condition, body, span)


def _repeat(c: Cursor) -> tree.Statement:
    start = c.take()
    span = c.span_from(start)
    body = statements(c)
    c.expect("UNTIL", f"to close the REPEAT of line {c.line_of(start)}")
    until = assignment(c)
    c.accept(";")
    _close_block(c, "END_REPEAT", start)
    return tree.RepeatStatement(body, until, span)


def _try(c: Cursor) -> tree.Statement:
    start = c.take()
    span = c.span_of(start)
    body = statements(c)
    caught, at = None, c.at
    if c.accept("__CATCH"):
        if c.accept("(") and not c.accept(")"):
            caught = expression(c)
            c.close(")", "after the variable of the __CATCH")
    else:
        c.report("S003", f"`__CATCH` expected after the __TRY of line {c.line_of(start)}{c.found()}.", c.here())
    catch = c.span_from(at) if c.at > at else span
    handler = statements(c)
    final = statements(c) if c.accept("__FINALLY") else ()
    _close_block(c, "__ENDTRY", start)
    return tree.TryStatement(body, caught, catch, handler, final, span)


KEYWORDS: dict[str, Callable[[Cursor], tree.Statement]] = {
    "IF": _if,
    "CASE": _case,
    "FOR": _for,
    "WHILE": _while,
    "REPEAT": _repeat,
    "EXIT": _exit,
    "RETURN": _exit,
    "__TRY": _try,
}
