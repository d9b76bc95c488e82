"""Rungs of a ladder diagram, and function block diagrams beside them -> tree. A bad one is reported and skipped; the next one is read as usual."""

from scanbench.syntax import half_words, networks, parse_diagram, parse_expression, parse_statement, tree
from scanbench.syntax.cursor import NAME, Cursor, Unexpected
from scanbench.syntax.lexer import Lex
from scanbench.syntax.parse_statement import STOPS
from scanbench.syntax.source import Stretch

ENDS = frozenset(("END_RUNG", "END_NETWORK"))
WALLS = ENDS | {"RUNG", "NETWORK"}
MODES = {"[": ("P", "N"), "(": ("S", "R", "P", "N")}


def follows(c: Cursor) -> bool:
    """Whether a body of networks begins here: RUNG or NETWORK on a line with nothing but a label and a title."""
    return _at_network(c, c.at)


def _at_network(c: Cursor, at: int) -> bool:
    if c.kinds[at] is not NAME or c.texts[at].upper() not in ("RUNG", "NETWORK"):
        return False
    last = at
    if c.kinds[last + 1] is NAME and c.texts[last + 2] == ":" and _same_line(c, at, last + 1):
        last += 2
    if c.kinds[last + 1] is Lex.STRING and _same_line(c, at, last + 1):
        last += 1
    return not _same_line(c, last, last + 1) or c.kinds[last + 1] is Lex.END


def _same_line(c: Cursor, first: int, second: int) -> bool:
    return c.source.text.find("\n", c.starts[first], c.starts[second]) < 0


def body(c: Cursor) -> networks.NetworkBody:
    """Networks up to the end of the POU, or to a declaration inside of it."""
    start = c.at
    found: list[networks.Rung | networks.Diagram] = []
    while not _ended(c):
        if _at_network(c, c.at):
            found.append(network(c))
            continue
        if half := half_words.network(c):
            half_words.report(c, half)
            if c.texts[c.at + 1] in STOPS - {"RETURN"}:
                c.take()
            else:
                found.append(network(c, half))
            continue
        c.report("S003", f"RUNG or NETWORK expected: this body is a diagram{c.found()}.", c.here())
        _skip(c)
    return networks.NetworkBody(tuple(found), c.span_from(start))


def _ended(c: Cursor) -> bool:
    if c.texts[c.at] in STOPS or c.at == c.wall:
        return True
    return c.kinds[c.at + 1] is NAME and parse_statement.declaration_follows(c)


def _skip(c: Cursor) -> None:
    """To the next rung, at least one token on."""
    c.take()
    while not _ended(c) and not _at_network(c, c.at):
        if c.accept_word("END_RUNG", "END_NETWORK"):
            return
        c.take()


def network(c: Cursor, half: str = "") -> networks.Rung | networks.Diagram:
    """The next rung or diagram; `half` is what its first word, which was reported, means."""
    off = _is_off(c)
    start = c.take()
    kind = half or c.texts[start].upper()
    label = ""
    if c.texts[c.at + 1] == ":":
        label = c.texts[c.at]
        c.at += 2
    if c.kinds[c.at] is Lex.STRING:
        c.take()
    head, depth, around, told = c.span_from(start), c.depth, c.wall, len(c.problems)
    path: networks.Path = ()
    items: tuple[networks.Item, ...] = ()
    wires: tuple[networks.Wire, ...] = ()
    c.wall = _end_of(c, around)
    try:
        if kind == "RUNG":
            path = _path(c)
        else:
            items, wires = parse_diagram.items(c, "END_NETWORK")
        if not c.accept_word(f"END_{kind}"):
            if c.texts[c.at] in STOPS and len(c.problems) > told:
                raise Unexpected  # what is not closed in it was reported, and nothing comes after that
            raise c.fail(f"END_{kind} expected to close the {kind} of line {c.line_of(start)}")
    except Unexpected:
        c.depth, c.wall = depth, around
        if not _at_network(c, c.at) and not _ended(c) and not c.accept_word("END_RUNG", "END_NETWORK"):
            _skip(c)
    finally:
        c.wall = around
    for at, text in c.pragmas:
        if c.starts[start] < at < c.end_of(c.at - 1) and _says_off(text):
            place = Stretch(c.source, at, at + len(text))
            c.report("S003", f"`{{off}}` switches a whole {kind} off: write it above the word {kind}.", place)
    if kind == "NETWORK":
        return networks.Diagram(label, items, wires, off, head)
    return networks.Rung(label, path, off, head)


def _end_of(c: Cursor, around: int) -> int:
    """The word on a line of its own that ends the network here, the next network where that is missing, or what ends all around."""
    at, texts, kinds = c.at, c.texts, c.kinds
    while texts[at] not in STOPS and at != around:
        if kinds[at] is NAME and texts[at].upper() in WALLS and half_words.first_of_line(c, at):
            if texts[at].upper() in ENDS or _at_network(c, at):
                return at
        at += 1
    return around


def _is_off(c: Cursor) -> bool:
    """Whether the pragma `{off}` is right before the rung."""
    first = c.end_of(c.at - 1) if c.at else 0
    return any(first <= at < c.starts[c.at] and _says_off(text) for at, text in c.pragmas)


def _says_off(pragma: str) -> bool:
    return pragma[1:-1].strip().lower() == "off"


# ---- elements -----------------------------------------------------------------------------------------------------


def _path(c: Cursor) -> networks.Path:
    found: list[networks.Element] = []
    while not c.is_("|", ">") and c.word() != "END_RUNG" and not _ended_path(c):
        found.append(_element(c))
        last = found[-1]
        if isinstance(last, networks.Leave) or (isinstance(last, networks.Link) and last.sends):
            break
    return tuple(found)


def _ended_path(c: Cursor) -> bool:
    return c.texts[c.at] in STOPS - {"RETURN"} or _at_network(c, c.at)


def _element(c: Cursor) -> networks.Element:
    start = c.at
    if c.is_("["):
        return networks.Contact(*_operand(c, "[", "]", "the contact"), c.span_from(start))
    if c.is_("("):
        return networks.Coil(*_operand(c, "(", ")", "the coil"), c.span_from(start))
    if c.is_("<"):
        return _parallel(c)
    if c.is_("#") or (c.is_("-") and c.texts[start + 1] == ">"):
        sends = c.is_("-")
        c.at += 3 if sends else 1
        if sends and c.texts[c.at - 1] != "#":
            raise c.fail("`#` and the name of a link expected after `->`", c.at - 1)
        name = c.name("the name of a link")
        return networks.Link(c.texts[name], sends, c.span_from(start))
    if c.accept("RETURN"):
        return networks.Leave("", c.span_from(start))
    if c.word() == "JMP" and c.kinds[start + 1] is NAME:
        c.at += 2
        return networks.Leave(c.texts[c.at - 1], c.span_from(start))
    if c.kinds[start] is NAME:
        return _box(c)
    raise c.fail("a contact `[ ]`, a coil `( )`, a box, `<`, a link, JMP, RETURN or END_RUNG expected")


def _operand(c: Cursor, opening: str, closing: str, what: str) -> tuple[str, tree.Expression, str]:
    c.take()
    mode = ""
    if c.accept("/"):
        mode = "/"
    elif c.word() in MODES[opening] and parse_diagram.operand_follows(c, c.at):
        mode = c.word()
        c.take()
    first = c.at
    if c.is_(closing):
        raise c.fail(f"a variable expected in {what}")
    value = parse_expression.expression(c)
    written = c.source.text[c.starts[first] : c.end_of(c.at - 1)]
    c.close(closing, f"to close {what}")
    return mode, value, "".join(written.split())


def _parallel(c: Cursor) -> networks.Parallel:
    start = c.take()
    c.enter()
    branches = [_path(c)]
    while c.accept("|"):
        branches.append(_path(c))
    c.leave()
    if not c.is_(">"):
        raise c.fail(f"`|` or `>` expected in the parallel branches of line {c.line_of(start)}")
    c.take()
    return networks.Parallel(tuple(branches), c.span_from(start))


def _box(c: Cursor) -> networks.Box:
    start, result = c.at, None
    callee = _variable(c)
    if c.accept(":="):
        result, callee = callee, _callee(c)
    if not c.is_("("):
        raise c.fail("`(` expected: a box is a call, and a variable belongs in `[ ]` or `( )`")
    arguments = parse_diagram.in_box(c, _argument)
    closing, output = c.at - 1, ""
    if c.is_(".") and c.kinds[c.at + 1] is NAME:
        output = c.texts[c.at + 1]
        c.at += 2
    return networks.Box(result, callee, arguments, output, c.span_from(start), c.span_from(closing))


def _callee(c: Cursor) -> tree.Expression:
    """What a result is taken from: also AND and its like."""
    if c.texts[c.at] not in parse_expression.FUNCTION_FORMS:
        return _variable(c)
    at = c.take()
    return tree.Name(c.texts[at], c.span_of(at))


def _variable(c: Cursor) -> tree.Expression:
    at = c.name("the name of a block or function")
    return parse_expression.postfix(c, tree.Name(c.texts[at], c.span_of(at)), calls=False)


def _argument(c: Cursor) -> tree.Argument | networks.Branch:
    start = c.at
    negated = c.is_("NOT") and c.texts[start + 2] == "=>"
    first = start + negated
    named = c.kinds[first] is NAME and c.texts[first + 1] in (":=", "=>")
    value = first + 2 if named else start
    name, place = (c.texts[first], c.span_of(first)) if named else (None, None)
    output = named and c.texts[first + 1] == "=>"
    if c.texts[value] == networks.POWER:
        c.at = value + 1
        return tree.Argument(name, False, tree.Name(networks.POWER, c.span_of(value)), c.span_from(start), place=place)
    if c.texts[value] == "#" and output:
        c.at = value + 1
        wire = c.name("the name of a link")
        return tree.Argument(
            name, True, tree.Name(networks.WIRE + c.texts[wire], c.span_of(wire)), c.span_from(start),
            negated=negated, place=place,
        )  # fmt: skip
    if c.texts[value] == "<" and name is not None and not output:
        c.at = value
        return networks.Branch(name, _parallel(c), c.span_from(start))
    _refuse_power(c, value)
    return parse_expression.argument(c)


def _refuse_power(c: Cursor, at: int) -> None:
    """Refuses `NOT ~` and its like: the power is no operand."""
    while c.texts[at] not in (",", ")", ";", "") and at != c.wall:
        if c.texts[at] == networks.POWER:
            message = (
                "`~` is the power itself and stands alone: set a BOOL by a coil before the box, `(x)` or `(/ x)`, "
                "and write that here."
            )
            c.report("S003", message, c.span_of(at))
            raise Unexpected
        at += 1
