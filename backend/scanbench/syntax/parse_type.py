"""Types and initial values."""

from scanbench.problems import Span
from scanbench.syntax import parse_expression, parse_initial, tree
from scanbench.syntax.cursor import NAME, Cursor, Unexpected
from scanbench.syntax.lexer import Lex
from scanbench.syntax.parse_generic import any_number_follows
from scanbench.syntax.pragmas import POLICIES
from scanbench.syntax.source import Stretch

INTEGERS = frozenset("SINT INT DINT LINT USINT UINT UDINT ULINT BYTE WORD DWORD LWORD".split())
SECTIONS = frozenset(
    "VAR VAR_INPUT VAR_OUTPUT VAR_IN_OUT VAR_TEMP VAR_GLOBAL VAR_EXTERNAL VAR_STAT VAR_INST VAR_GENERIC".split()
)
POU_STARTS = frozenset(("PROGRAM", "FUNCTION", "FUNCTION_BLOCK", "TYPE", "CONFIGURATION"))
POU_ENDS = frozenset(
    "END_PROGRAM END_FUNCTION END_FUNCTION_BLOCK END_CLASS END_INTERFACE END_METHOD END_PROPERTY END_GET END_SET "
    "END_ACTION END_NAMESPACE END_TYPE END_CONFIGURATION END_RESOURCE".split()
)
DECLARATIONS_END = SECTIONS | POU_STARTS | POU_ENDS | {"END_VAR", "END_STRUCT", "END_UNION", "VAR_ACCESS", "VAR_CONFIG"}
NOT_A_NAME = frozenset((":", ",", ":=", "AT"))
"""What follows a variable's name, so that a word before it is no qualifier."""


def type_spec(c: Cursor, named: bool = False) -> tree.TypeSpec:
    """A type; `named` in a TYPE declaration, where `Base (A, B)` can only be an enumeration."""
    start = c.at
    c.enter(POU_ENDS)
    spec = _type_spec(c, start, named)
    c.leave()
    return spec


def _type_spec(c: Cursor, start: int, named: bool) -> tree.TypeSpec:
    match c.texts[start]:
        case "ARRAY":
            return _array(c)
        case "STRUCT":
            return structure(c)
        case "(":
            return _enumeration(c, None, start)
    word = c.word()
    if word == "UNION" and c.kinds[start + 1] is not Lex.OPERATOR:
        return structure(c)
    if word == "REF_TO" or (word in ("POINTER", "REFERENCE") and c.texts[start + 1] == "TO"):
        return _reference(c, word)
    if word in ("STRING", "WSTRING"):
        return _string_type(c, word == "WSTRING")
    base = _with_values(c, tree.NamedType(c.qualified("a type"), c.span_from(start)))
    if c.is_("("):
        return _restricted(c, base, start, named)
    return base


def _reference(c: Cursor, word: str) -> tree.ReferenceSpec:
    start = c.take()
    if word != "REF_TO":
        c.take()
    target = type_spec(c)
    return tree.ReferenceSpec(target, word == "POINTER", c.span_from(start), word == "REFERENCE")


def _restricted(c: Cursor, base: tree.NamedType, start: int, named: bool) -> tree.TypeSpec:
    """`INT (1..5)`, `INT (A, B)`; what belongs to an instance (`FB(a := 1)`) is left to the caller."""
    begin = c.at
    if _range_follows(c):
        c.take()
        low = parse_expression.expression(c)
        c.expect("..", "between the bounds of the subrange")
        high = parse_expression.expression(c)
        c.expect(")", "to close the subrange")
        return tree.SubrangeSpec(base, low, high, c.span_from(start))
    c.at = begin
    if named or base.name.upper() in INTEGERS:
        return _enumeration(c, base, start)
    return base


def _range_follows(c: Cursor) -> bool:
    """Whether `..` comes before the parenthesis closes."""
    depth, at = 0, c.at
    while c.kinds[at] is not Lex.END:
        text = c.texts[at]
        if text == "(":
            depth += 1
        elif text == ")":
            depth -= 1
            if depth == 0:
                return False
        elif text == ".." and depth == 1:
            return True
        elif text in (";", ":", ":="):
            return False
        at += 1
    return False


def _enumeration(c: Cursor, base: tree.NamedType | None, start: int) -> tree.EnumSpec:
    c.expect("(", "before the values")
    values = []
    while not c.is_(")"):
        name = c.name("the name of a value")
        number = parse_expression.expression(c) if c.accept(":=") else None
        values.append((c.texts[name], number, c.span_of(name)))
        if not c.accept(","):
            break
    c.expect(")", "to close the enumeration")
    if not values:
        c.report("S003", "An enumeration needs at least one value.", c.span_from(start))
        raise Unexpected
    if base is None and c.kinds[c.at] is NAME and c.word() in INTEGERS:
        base = tree.NamedType(c.texts[c.at], c.here())
        c.take()
    return tree.EnumSpec(tuple(values), base, c.span_from(start))


def _string_type(c: Cursor, wide: bool) -> tree.StringSpec:
    start, length = c.take(), None
    for opening, closing in (("[", "]"), ("(", ")")):
        if c.accept(opening):
            length = parse_expression.expression(c)
            c.expect(closing, "to close the length of the STRING")
            break
    return tree.StringSpec(length, c.span_from(start), wide)


def _array(c: Cursor) -> tree.TypeSpec:
    start = c.take()
    c.expect("[", "after ARRAY")
    ranges: list[tuple[tree.Expression, tree.Expression]] = []
    stars = 0
    while True:
        if c.accept("*"):
            stars += 1
        else:
            low = parse_expression.expression(c)
            c.expect("..", "between the bounds of the array")
            ranges.append((low, parse_expression.expression(c)))
        if not c.accept(","):
            break
    c.expect("]", "to close the bounds of the array")
    c.expect("OF", "after the bounds of the array")
    element = type_spec(c)
    span = c.span_from(start)
    if stars and ranges:
        c.report("S003", "The bounds of an array are all given, or all `*`.", span)
        raise Unexpected
    return tree.OpenArraySpec(stars, element, span) if stars else tree.ArraySpec(tuple(ranges), element, span)


def variables(c: Cursor) -> tuple[tree.Variable, ...]:
    """Declarations up to what closes them."""
    found: list[tree.Variable] = []
    while not c.ended():
        depth = c.depth
        if c.kinds[c.at] is Lex.KEYWORD and c.texts[c.at + 1] == ":":
            word = c.texts[c.at]
            c.report("S003", f"`{word}` is a keyword and cannot be the name of a variable; rename it.", c.here())
            c.take()
            skip_declaration(c)
            continue
        if c.texts[c.at] in DECLARATIONS_END:
            break
        if c.accept(";"):
            continue
        try:
            found += _variables(c)
        except Unexpected:
            c.depth = depth
            skip_declaration(c)
    return tuple(found)


def skip_declaration(c: Cursor) -> None:
    while c.texts[c.at] not in DECLARATIONS_END and not c.ended():
        if c.texts[c.take()] == ";":
            return


def subrange_policy(c: Cursor, first: int | None = None) -> str:
    """What a pragma right before the token `first` (else the next one) says of values outside of a subrange."""
    first = c.at if first is None else first
    begin = c.end_of(first - 1) if first else 0
    mine = [each for each in c.subrange_policies if begin <= each.start < c.starts[first]]
    for each in mine:
        c.subrange_policies.remove(each)
        if not each.policy:
            said = "', '".join(POLICIES)
            c.report("S003", f"One of '{said}' expected, found `{each.said}`.", Stretch(c.source, each.start, each.end))
    return mine[-1].policy if mine else ""


def _variables(c: Cursor) -> list[tree.Variable]:
    """`a, b : type := value;` or `a AT address : type := value;`"""
    if c.is_("AT"):
        return _nameless(c)
    policy = subrange_policy(c)
    names = [c.name("the name of a variable")]
    address, address_span = located(c)
    while c.accept(","):
        names.append(c.name("the name of a variable"))
    if address is None:
        address, address_span = located(c)
    c.expect(":", f"after `{c.texts[names[-1]]}`, then its type")
    if any_number_follows(c):
        c.close(";", f"after the declaration of `{c.texts[names[0]]}`")
        return []
    spec = type_spec(c)
    if any_number_follows(c):
        c.close(";", f"after the declaration of `{c.texts[names[0]]}`")
        return []
    edge = c.word()[0] if c.word() in ("R_EDGE", "F_EDGE") else ""
    if edge:
        c.take()
    if address is None:
        address, address_span = located(c)
    arguments: tuple[tree.Argument, ...] = ()
    if c.is_("(") and isinstance(spec, tree.NamedType):
        arguments = parse_expression.arguments(c, "initial values")
    elements = _elements(c) if c.is_("[") and isinstance(spec, tree.ArraySpec) else ()
    initial = _initial_of(c, spec) if c.accept(":=") else None
    if c.word() == "REF" and c.texts[c.at + 1] == "=":
        c.at += 2
        where = c.at
        bound = parse_expression.expression(c)
        initial = tree.Call(
            tree.Name("REF", c.span_of(where)), (tree.Argument(None, False, bound, bound.span),), bound.span
        )
    c.close(";", f"after the declaration of `{c.texts[names[0]]}`")
    return [
        tree.Variable(
            c.texts[name], spec, initial, address, c.span_of(name), address_span, arguments, edge, elements, policy
        )
        for name in names
    ]


def _elements(c: Cursor) -> tuple[tuple[tree.Argument, ...], ...]:
    """`[(a := 1), (a := 2)]` after the type of an array: the arguments of each of its blocks."""
    c.take()
    found: list[tuple[tree.Argument, ...]] = []
    while not c.is_("]"):
        found.append(parse_expression.arguments(c, "arguments of an element"))
        if not c.accept(","):
            break
    c.expect("]", "to close the arguments of the elements")
    return tuple(found)


def _initial_of(c: Cursor, spec: tree.TypeSpec) -> tree.Initial:
    if isinstance(spec, tree.ArraySpec) and not c.is_("[") and c.kinds[c.at] is not NAME:
        return parse_initial.bare_array_initial(c)
    return parse_initial.initial(c)


def _nameless(c: Cursor) -> list[tree.Variable]:
    """`AT %IX1.0 : BOOL;`: the address is used as it is, nothing is declared."""
    start = c.at
    located(c)
    c.expect(":", "after the address, then its type")
    type_spec(c)
    if c.accept(":="):
        parse_initial.initial(c)
        c.report("X001", "An initial value needs a variable with a name before AT.", c.span_from(start))
    c.close(";", "after the declaration")
    return []


def located(c: Cursor) -> tuple[str | None, Span | None]:
    """The address after AT, as written: each vendor has a notation of its own."""
    if not c.accept("AT"):
        return None, None
    start = c.at
    while not c.is_(":", ";", ":=", "END_VAR") and not c.ended():
        c.take()
    if c.at == start:
        raise c.fail("an address expected after AT")
    return c.source.text[c.starts[start] : c.end_of(c.at - 1)], c.span_from(start)


def structure(c: Cursor, extends: tree.NamedType | None = None) -> tree.StructSpec:
    start = c.take()
    union = c.texts[start] != "STRUCT"
    overlap = bool(c.word() == "OVERLAP" and c.texts[c.at + 1] not in NOT_A_NAME and c.take())
    if c.word() == "EXTENDS" and c.texts[c.at + 1] not in NOT_A_NAME:
        c.take()
        extends = parent(c, "the name of a structure")
    members = variables(c)
    keyword = "END_UNION" if union else "END_STRUCT"
    if not c.accept(keyword):
        raise c.fail(f"`{keyword}` expected")
    return tree.StructSpec(members, c.span_from(start), union, overlap, extends)


def parent(c: Cursor, what: str) -> tree.NamedType:
    """What something extends, implements or is an instance of."""
    first = c.at
    return _with_values(c, tree.NamedType(c.qualified(what), c.span_from(first)))


def _with_values(c: Cursor, base: tree.NamedType) -> tree.NamedType:
    """`FB<10, n, (2 * n)>` of vendors: the values of generic constants."""
    if not c.accept("<"):
        return base
    values = [parse_expression.operand(c)]
    while c.accept(","):
        values.append(parse_expression.operand(c))
    c.expect(">", "to close the values of the generic constants")
    return tree.NamedType(base.name, base.span, tuple(values))
