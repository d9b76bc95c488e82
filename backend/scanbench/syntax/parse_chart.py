"""Sequential function charts -> tree. A bad step or transition is reported and skipped; the next one is read as usual."""

from scanbench.syntax import chart, half_words, networks, parse_expression, parse_networks, parse_statement, tree
from scanbench.syntax.cursor import NAME, Cursor, Unexpected
from scanbench.syntax.lexer import Lex
from scanbench.syntax.parse_statement import DECLARATIONS, STOPS
from scanbench.syntax.parse_type import POU_ENDS, POU_STARTS


def follows(c: Cursor, at: int | None = None) -> bool:
    """Whether a step or a transition begins here, or at a token; elsewhere these words are names."""
    at = c.at if at is None else at
    if c.kinds[at] is not NAME:
        return False
    word, second, third = c.texts[at].upper(), at + 1, c.texts[at + 2].upper()
    if word in ("STEP", "INITIAL_STEP"):
        return c.kinds[second] is NAME and third == ":"
    if word != "TRANSITION":
        return False
    if c.kinds[second] is NAME:
        return c.texts[second].upper() == "FROM" or third in ("FROM", "(")
    return c.texts[second] == "(" and third == "PRIORITY"


def wall(c: Cursor) -> int:
    """The step or transition that goes on after an ACTION without END_ACTION; -1 where that is there, or nothing of a chart."""
    at, part = c.at, -1
    while c.texts[at] not in POU_ENDS | POU_STARTS and c.kinds[at] is not Lex.END:
        if part < 0 and follows(c, at):
            part = at
        if c.texts[at].upper() in DECLARATIONS and c.kinds[at + 1] is NAME:
            break
        at += 1
    return -1 if c.texts[at] == "END_ACTION" else part


def body(c: Cursor) -> chart.Chart:
    """Steps and transitions up to the end of the POU, or to a declaration inside of it."""
    start = c.at
    steps: list[chart.Step] = []
    transitions: list[chart.Transition] = []
    whole = True
    while not _ended(c):
        before, depth = c.at, c.depth
        try:
            word = _beginning(c)
            if word == "TRANSITION":
                transitions.append(_transition(c))
            elif word:
                steps.append(_step(c, word == "INITIAL_STEP"))
            whole = whole and follows(c, before)
        except Unexpected:
            c.depth, whole = depth, False
            _skip(c, before)
    return chart.Chart(tuple(steps), tuple(transitions), c.span_from(start), whole=whole)


def _beginning(c: Cursor) -> str:
    """The word that begins a step or a transition; one that is half written is reported, and empty where nothing comes after it."""
    if follows(c):
        return c.word()
    half = half_words.chart(c)
    if not half:
        raise c.fail("STEP, INITIAL_STEP, TRANSITION or ACTION expected: this body is a chart")
    half_words.report(c, half)
    if c.texts[c.at + 1] not in STOPS:
        return half
    c.take()
    return ""


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


def _step(c: Cursor, initial: bool) -> chart.Step:
    start, told = c.take(), len(c.problems)
    name = _name(c, "the name of the step")
    head = c.span_from(start)
    c.expect(":", "after the name of the step")
    found: list[chart.Association] = []
    while c.word() != "END_STEP" and not _ended(c) and not follows(c):
        if not c.accept(";"):
            found.append(_association(c))
    if not c.accept_word("END_STEP") and not (c.texts[c.at] in STOPS and len(c.problems) > told):
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
        if c.kinds[c.at] is NAME and (c.texts[c.at + 1] in (")", ",") or _half_use(c)):
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
        if not c.is_(")"):  # what is missing after it belongs to the same mistake
            c.close(")", "to close the action")
            c.accept(";")
            return chart.Association(action, written, qualifier, duration, indicator, c.span_from(start))
        c.take()
    span = c.span_from(start)
    _check_duration(c, written, qualifier, duration, indicator, start)
    c.close(";", "after an action")
    return chart.Association(action, written, qualifier, duration, indicator, span)


def _half_use(c: Cursor) -> bool:
    """Whether a qualifier is the last word of an action that nothing closes."""
    return c.word() in chart.QUALIFIERS and (
        c.texts[c.at + 1] in STOPS or c.word(1) == "END_STEP" or c.texts[c.at + 1] == ";"
    )


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
