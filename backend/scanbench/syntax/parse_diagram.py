"""Function block diagrams -> tree: one box a line, in the order of execution. A bad line is reported and skipped."""

from collections.abc import Callable
from dataclasses import replace
from typing import TypeVar

from scanbench.syntax import networks, parse_expression, parse_type, tree
from scanbench.syntax.cursor import NAME, Cursor, Unexpected
from scanbench.syntax.lexer import Lex
from scanbench.syntax.parse_expression import FUNCTION_FORMS

T = TypeVar("T")
EDGES = {"R_EDGE": "P", "F_EDGE": "N"}
STARTS = frozenset((NAME, Lex.ADDRESS))


def items(c: Cursor, ended: str) -> tuple[tuple[networks.Item, ...], tuple[networks.Wire, ...]]:
    """The lines up to a word, and the wires that they set."""
    found: list[networks.Item] = []
    wires: list[networks.Wire] = []
    read: set[str] = set()
    while c.word() != ended and not c.ended() and not c.texts[c.at].startswith("END_"):
        if c.accept(";"):
            continue
        depth, before = c.depth, c.at
        c.wires = set()
        try:
            item = _item(c, wires, read)
            found.append(item)
            wires += _of_outputs(item, read)
            c.close(";", "at the end of the line")
        except Unexpected:
            c.depth = depth
            _skip(c, before, ended)
        finally:
            c.wires = None
    return tuple(found), tuple(wires)


def _of_outputs(item: networks.Item, read: set[str]) -> list[networks.Wire]:
    """The wires that outputs of a box set."""
    arguments = item.value.arguments if isinstance(item.value, networks.Function) else ()
    outputs = (networks.wire_at(each) for each in arguments if isinstance(each, tree.Argument))
    return [
        networks.Wire(
            each.name,
            each.type if isinstance(each, networks.TypedWire) else None,
            each.name.removeprefix(networks.WIRE).upper() in read,
            each.span,
        )
        for each in outputs
        if each is not None
    ]


def _skip(c: Cursor, before: int, ended: str) -> None:
    if c.at == before:
        c.take()
    while c.word() != ended and not c.ended() and not c.texts[c.at].startswith("END_") and not c.accept(";"):
        c.take()


def _item(c: Cursor, wires: list[networks.Wire], read: set[str]) -> networks.Item:
    start = c.at
    if c.is_("RETURN") or (c.word() == "JMP" and c.kinds[start + 1] is NAME):
        return _leave(c, start, read)
    if c.is_("#"):
        return _wire(c, start, wires, read)
    target, operator = _target(c)
    value = _box(c) if target is None else _value(c)
    if value is None:
        raise c.fail("`:=`, `S=`, `R=` or a call expected: a value alone goes nowhere", start)
    read |= c.wires or set()
    return networks.Item(target, operator, value, None, c.span_from(start))


def _leave(c: Cursor, start: int, read: set[str]) -> networks.Item:
    c.take()
    label = "" if c.texts[start] == "RETURN" else c.texts[c.take()]
    leave = networks.Leave(label, c.span_from(start))
    condition = None
    if c.accept("IF"):
        condition = _pin(c, None, c.at)
    read |= c.wires or set()
    return networks.Item(None, "", condition, leave, c.span_from(start))


def _wire(c: Cursor, start: int, wires: list[networks.Wire], read: set[str]) -> networks.Item:
    c.take()
    name = c.name("the name of a wire")
    span = c.span_from(start)
    type = parse_type.type_spec(c, named=False) if c.accept(":") else None
    c.expect("=", "after the wire")
    try:
        value = _value(c)
    finally:  # it is a wire, whatever is wrong after it
        read |= c.wires or set()
        wires.append(networks.Wire(f"#{c.texts[name]}", type, c.texts[name].upper() in read, span))
    return networks.Item(tree.Name(f"#{c.texts[name]}", span), "=", value, None, c.span_from(start))


def _target(c: Cursor) -> tuple[tree.Expression | None, str]:
    """The variable before `:=`, `S=` or `R=`; the place stays where there is none."""
    start = c.at
    if c.kinds[start] not in STARTS:
        return None, ""
    problems = len(c.problems)
    try:
        at = c.take()
        first: tree.Expression = (
            tree.Name(c.texts[at], c.span_of(at))
            if c.kinds[at] is NAME
            else tree.DirectAddress(c.texts[at], c.span_of(at))
        )
        target = parse_expression.postfix(c, first, calls=False)
    except Unexpected:
        del c.problems[problems:]
        c.at = start
        return None, ""
    if c.accept(":="):
        return target, ":="
    if c.word() in ("S", "R") and c.texts[c.at + 1] == "=":
        operator = f"{c.word()}="
        c.at += 2
        return target, operator
    c.at = start
    return None, ""


def _value(c: Cursor) -> networks.Function | networks.Pin | tree.Expression:
    return _box(c) or _pin(c, None, c.at)


def _box(c: Cursor) -> networks.Function | None:
    """A call that is all of a line; None where something else is there, or it goes on."""
    start, depth, problems, wires = c.at, c.depth, len(c.problems), set(c.wires or ())
    form = c.texts[start] in FUNCTION_FORMS
    if (c.kinds[start] is not NAME and not form) or (c.word() in EDGES and operand_follows(c, start)):
        return None
    c.take()
    name = tree.Name(c.texts[start], c.span_of(start))
    callee = name if form else parse_expression.postfix(c, name, calls=False)
    if c.is_("("):
        arguments = in_box(c, _argument)
        if c.is_(";"):
            return networks.Function(callee, arguments, c.span_from(start))
    c.at, c.depth, c.wires = start, depth, wires
    del c.problems[problems:]
    return None


def in_box(c: Cursor, argument: Callable[[Cursor], T]) -> tuple[T, ...]:
    """The arguments of a box in brackets, each read by `argument`."""
    c.expect("(", "to open the box")
    c.enter()
    found: list[T] = []
    while not c.is_(")"):
        found.append(argument(c))
        if not c.accept(","):
            break
    c.leave()
    c.expect(")", "to close the box")
    return tuple(found)


def _argument(c: Cursor) -> tree.Argument | networks.Pin:
    start = c.at
    if c.kinds[start] is NAME and c.texts[start + 1] == ":=":
        c.at += 2
        value = _pin(c, c.texts[start], start)
        if isinstance(value, networks.Pin):
            return value
        return tree.Argument(c.texts[start], False, value, c.span_from(start), place=c.span_of(start))
    if (c.kinds[start] is NAME or c.is_("NOT")) and "=>" in c.texts[start + 1 : start + 3]:
        read = set(c.wires or ())
        output = parse_expression.argument(c)
        wire = networks.wire_at(output)
        if wire is None:
            return output
        c.wires = read  # it is set here
        if not c.accept(":"):
            return output
        typed = networks.TypedWire(wire.name, wire.span, parse_type.type_spec(c, named=False))
        return replace(output, value=typed, span=c.span_from(start))
    value = _pin(c, None, start)
    return value if isinstance(value, networks.Pin) else tree.Argument(None, False, value, value.span)


def operand_follows(c: Cursor, at: int) -> bool:
    """Whether what comes after `P` or `R_EDGE` begins an operand, so that this is no name: `[P(x)]` is a call, `[P (x OR y)]` an edge."""
    after = at + 1
    if c.texts[after] == "(":
        return c.starts[after] > c.end_of(at)
    return c.kinds[after] in STARTS or c.texts[after] in ("NOT", "TRUE", "FALSE", "THIS", "SUPER")


def _pin(c: Cursor, name: str | None, start: int) -> networks.Pin | tree.Expression:
    """A value, or `NOT R_EDGE value`."""
    first = c.at
    negated = c.is_("NOT") and c.word(1) in EDGES
    at = first + 1 if negated else first
    edge = EDGES.get(c.texts[at].upper()) if c.kinds[at] is NAME else None
    if edge is None or not (c.texts[at + 1] == "#" or operand_follows(c, at)):
        return parse_expression.expression(c)
    c.at = at + 1
    operand = parse_expression.operand(c)
    written = "".join(c.texts[at + 1 : c.at])
    contact = networks.Contact(edge, operand, written, c.span_from(at))
    return networks.Pin(name, contact, negated, c.span_from(start))
