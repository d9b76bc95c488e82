"""Sequential function charts -> tree. A bad step or transition is reported and skipped; the next one is read as usual."""

from scanbench.syntax import chart, networks, parse_expression, parse_networks, parse_statement, tree
from scanbench.syntax.cursor import NAME, Cursor, Unexpected
from scanbench.syntax.lexer import Lex
from scanbench.syntax.parse_statement import STOPS


def follows(c: Cursor) -> bool:
    """Whether a step or a transition begins here; elsewhere these words are names."""
    if c.kinds[c.at] is not NAME:
        return False
    word, second, third = c.texts[c.at].upper(), c.at + 1, c.texts[c.at + 2].upper()
    if word in ("STEP", "INITIAL_STEP"):
        return c.kinds[second] is NAME and third == ":"
    if word != "TRANSITION":
        return False
    if c.kinds[second] is NAME:
        return c.texts[second].upper() == "FROM" or third in ("FROM", "(")
    return c.texts[second] == "(" and third == "PRIORITY"


def body(c: Cursor) -> chart.Chart:
    """Steps and transitions up to the end of the POU, or to a declaration inside of it."""
    start = c.at
    steps: list[chart.Step] = []
    transitions: list[chart.Transition] = []
    whole = True
    while not _ended(c):
        before, depth = c.at, c.depth
        try:
            if not follows(c):
                raise c.fail("STEP, INITIAL_STEP, TRANSITION or ACTION expected: this body is a chart")
            if c.word() == "TRANSITION":
                transitions.append(_transition(c))
            else:
                steps.append(_step(c))
        except Unexpected:
            c.depth, whole = depth, False
            _skip(c, before)
    return chart.Chart(tuple(steps), tuple(transitions), c.span_from(start), whole=whole)


def _ended(c: Cursor) -> bool:
    if c.texts[c.at] in STOPS:
        return True
    return c.kinds[c.at + 1] is NAME and parse_statement.declaration_follows(c)


def _skip(c: Cursor, before: int) -> None:
    """To the next step or transition, at least one token on."""
    if c.at == before:
        c.take()
    while not _ended(c) and not follows(c):
        if c.accept_word("END_STEP", "END_TRANSITION"):
            c.accept(";")
            return
        c.take()


def _step(c: Cursor) -> chart.Step:
    start = c.take()
    initial = c.texts[start].upper() == "INITIAL_STEP"
    name = _name(c, "the name of the step")
    head = c.span_from(start)
    c.expect(":", "after the name of the step")
    found: list[chart.Association] = []
    while c.word() != "END_STEP" and not _ended(c) and not follows(c):
        if not c.accept(";"):
            found.append(_association(c))
    if not c.accept_word("END_STEP"):
        c.report("S003", f"END_STEP expected to close the step {name.name}{c.found()}.", c.here())
    c.accept(";")
    return chart.Step(name, initial, tuple(found), head)


def _name(c: Cursor, what: str) -> tree.Name:
    at = c.name(what)
    return tree.Name(c.texts[at], c.span_of(at))


def _association(c: Cursor) -> chart.Association:
    start = c.at
    base: tree.Expression
    if c.kinds[start] is Lex.ADDRESS:
        base = tree.DirectAddress(c.texts[c.take()], c.span_of(start))
    else:
        base = _name(c, "an action, or END_STEP,")
    action = parse_expression.postfix(c, base, calls=False)
    written = "".join(c.texts[start : c.at])
    qualifier = "N"
    duration = indicator = None
    if c.accept("("):
        if c.kinds[c.at] is NAME and c.texts[c.at + 1] in (")", ","):
            qualifier = c.word()
            c.take()
        if qualifier not in chart.QUALIFIERS:
            message = f"`{qualifier}` is no qualifier; there are N, R, S, L, D, P, P0, P1, SD, DS and SL."
            c.report("S003", message, c.span_of(c.at - 1))
            qualifier = "N"
        if qualifier in chart.TIMED and c.accept(","):
            duration = parse_expression.expression(c)
        if c.accept(","):
            indicator = parse_expression.expression(c)
        c.close(")", "to close the action")
    span = c.span_from(start)
    _check_duration(c, written, qualifier, duration, indicator, start)
    c.close(";", "after an action")
    return chart.Association(action, written, qualifier, duration, indicator, span)


def _check_duration(
    c: Cursor,
    name: str,
    qualifier: str,
    duration: tree.Expression | None,
    indicator: tree.Expression | None,
    start: int,
) -> None:
    if qualifier in chart.TIMED and duration is None:
        c.report("S003", f"{qualifier} needs a duration: `{name}({qualifier}, T#1s)`.", c.span_from(start))
    if qualifier not in chart.TIMED and isinstance(indicator, tree.Literal):
        c.report("S003", f"{qualifier} takes no duration; remove it.", indicator.span)


def _transition(c: Cursor) -> chart.Transition:
    start, name = c.take(), ""
    if c.word() != "FROM" and c.kinds[c.at] is NAME:
        name = c.texts[c.take()]
    priority = _priority(c)
    if not c.accept_word("FROM"):
        raise c.fail("FROM and the steps that the transition ends expected")
    sources = _steps(c)
    c.expect("TO", "before the steps that follow")
    targets = _steps(c)
    head = c.span_from(start)
    condition = _condition(c)
    if not c.accept_word("END_TRANSITION"):
        message = f"END_TRANSITION expected to close the transition of line {c.line_of(start)}{c.found()}."
        c.report("S003", message, c.here())
    c.accept(";")
    return chart.Transition(name, priority, sources, targets, condition, head)


def _priority(c: Cursor) -> int | None:
    if not c.accept("("):
        return None
    if not c.accept_word("PRIORITY"):
        raise c.fail("PRIORITY expected")
    c.expect(":=", "after PRIORITY")
    if c.kinds[c.at] is not Lex.INTEGER or not c.texts[c.at].isdigit():
        raise c.fail("a number expected for the priority; the lowest is tested first")
    priority = int(c.texts[c.take()])
    c.close(")", "to close PRIORITY")
    return priority


def _steps(c: Cursor) -> tuple[tree.Name, ...]:
    if not c.accept("("):
        return (_name(c, "the name of a step"),)
    found = [_name(c, "the name of a step")]
    while c.accept(","):
        found.append(_name(c, "the name of a step"))
    c.close(")", "to close the steps")
    return tuple(found)


def _condition(c: Cursor) -> tree.Expression | networks.Rung:
    if c.accept(":="):
        condition = parse_expression.expression(c)
        c.accept(";")
        return condition
    if not c.accept(":"):
        raise c.fail("`:=` and the condition of the transition expected")
    if not parse_networks.follows(c) or c.word() != "RUNG":
        raise c.fail("RUNG expected: a condition is an expression after `:=`, or a rung after `:`")
    rung = parse_networks.network(c)
    assert isinstance(rung, networks.Rung)
    return rung
