"""POUs: programs, blocks, functions, classes, interfaces, and their contents."""

from dataclasses import replace

from scanbench.problems import Span
from scanbench.syntax import parse_chart, parse_declaration, parse_il, parse_type, tree
from scanbench.syntax.chart import Chart, variables
from scanbench.syntax.cursor import NAME, Cursor
from scanbench.syntax.lexer import Lex
from scanbench.syntax.networks import NetworkBody, memories
from scanbench.syntax.parse_declaration import ACCESS
from scanbench.syntax.parse_generic import TYPE_PARAMETERS, VARIADIC, grouped, type_parameters
from scanbench.syntax.parse_statement import BLOCK_ENDS
from scanbench.syntax.parse_type import POU_STARTS
from scanbench.syntax.pragmas import CALL_AFTER_INIT, InOutPragma, after_init, has_stub_pragma
from scanbench.syntax.source import Stretch

MODIFIERS = frozenset(("ABSTRACT", "FINAL", "OVERRIDE"))
ENDS = {
    "PROGRAM": "END_PROGRAM", "FUNCTION": "END_FUNCTION", "FUNCTION_BLOCK": "END_FUNCTION_BLOCK",
    "CLASS": "END_CLASS", "INTERFACE": "END_INTERFACE",
}  # fmt: skip
ACTION = "ACTION"
"""Among the modifiers of a method: it is an ACTION."""
MEMBERS = frozenset(("METHOD", "PROPERTY", "PROPERTY_GET", "PROPERTY_SET", "ACTION"))
SETTINGS_OF_VENDORS = frozenset(("VERSION", "TITLE", "AUTHOR", "FAMILY"))

Body = tuple[tree.Statement, ...] | tree.IlBody | NetworkBody | Chart


def pou(c: Cursor, namespace: str = "", using: tuple[str, ...] = ()) -> tree.PouDeclaration:
    """From PROGRAM, FUNCTION_BLOCK, FUNCTION, CLASS or INTERFACE to its end."""
    first = c.take()
    policy = parse_type.subrange_policy(c, first)
    kind = c.texts[first].upper()
    access, modifiers = _modifiers(c)
    name = c.name(f"the name of the {kind}")
    sections: list[tree.VariableSection] = []
    while kind == "FUNCTION_BLOCK" and c.is_("VAR_GENERIC"):  # before or after what it extends
        sections.append(parse_declaration.section(c))
    parameters = type_parameters(c) if kind == "FUNCTION" else {}
    c.variadic = False
    header = _header(c, kind, name)
    in_out = _in_out(c, first) if kind == "FUNCTION_BLOCK" and c.pragmas else ""
    methods: list[tree.PouDeclaration] = []
    body: Body = ()
    while True:
        before = c.at
        if c.is_("VAR_GLOBAL") and not _end_follows(c, ENDS[kind]):
            break
        sections += parse_declaration.sections(c)
        if c.is_("VAR_ACCESS", "VAR_CONFIG"):
            _skip_section(c, kind)
            continue
        _vendor_lines(c)
        if c.word() in MEMBERS and c.kinds[c.at + 1] is NAME:
            methods += member(c, kind)
            continue
        body = _joined(body, whole_body(c, body))
        if c.at == before:
            break
    if body and kind in ("CLASS", "INTERFACE"):
        where = body[0].span if isinstance(body, tuple) else body.span
        c.report("S003", f"A {kind} has no statements of its own; put them into a METHOD.", where)
    if isinstance(body, NetworkBody):
        body = replace(body, owner=c.texts[name])
        sections += memories(body) if kind in ("PROGRAM", "FUNCTION_BLOCK") else ()
    if isinstance(body, Chart):
        body = replace(body, owner=c.texts[name], whole=body.whole and c.is_(ENDS[kind]))
        sections += (*variables(body), *memories(body.conditions)) if kind in ("PROGRAM", "FUNCTION_BLOCK") else ()
    _pou_end(c, kind, name)
    stub = bool(c.pragmas) and has_stub_pragma(c.pragmas, c.starts[first], c.starts[c.at])
    result, extends, implements, more = header
    sections, result = grouped(parameters, sections, result)
    modifiers += (TYPE_PARAMETERS,) * bool(parameters) + (VARIADIC,) * c.variadic
    made = tree.PouDeclaration(
        kind.lower(), c.texts[name], result, tuple(sections), body, c.span_of(name), (),
        extends, implements, modifiers, access, namespace, using + more, in_out, stub, policy=policy, asked=_asked(c),
    )  # fmt: skip
    return with_member(made, methods)


def _asked(c: Cursor) -> tuple[tree.NamedType, ...]:
    """The generic blocks that were asked for since the last POU."""
    made, c.asked = tuple(c.asked), []
    return made


def _in_out(c: Cursor, first: int) -> str:
    """What a pragma between the token before `first` and the next one says of in-outs."""
    begin = c.end_of(first - 1) if first else 0
    mine = [each for each in c.in_out_pragmas if begin <= each.start < c.starts[c.at]]
    for each in mine:
        c.in_out_pragmas.remove(each)
        if not each.convention:
            c.report("S003", f"`'value'` or `'reference'` expected, found `{each.said}`.", _span_of(c, each))
    for each in mine[1:]:
        c.report("S003", "One pragma `in_out` is enough for a FUNCTION_BLOCK; remove this one.", _span_of(c, each))
    return mine[0].convention if mine else ""


def check_pragmas(c: Cursor) -> None:
    """Reports pragmas `in_out` and `subrange` at places where they have no meaning."""
    for each in c.in_out_pragmas:
        message = "A pragma `in_out` belongs before a FUNCTION_BLOCK or after its name; move it there."
        c.report("S003", message, _span_of(c, each))
    for other in c.subrange_policies:
        message = (
            "A pragma `subrange` belongs right before the declaration of a variable, a type or a POU; move it there."
        )
        c.report("S003", message, Stretch(c.source, other.start, other.end))


def _span_of(c: Cursor, pragma: InOutPragma) -> Span:
    return Stretch(c.source, pragma.start, pragma.end)


def whole_body(c: Cursor, first: Body = ()) -> Body:
    """A body, or what follows its `first` part; what closes a block that was never opened is reported, and the body goes on."""
    body = parse_il.body(c, first)
    while c.texts[c.at] in BLOCK_ENDS:
        stray = c.take()
        c.report("S003", f"`{c.texts[stray]}` without its beginning.", c.span_of(stray))
        c.accept(";")
        body = _joined(body, parse_il.body(c, body or first))
    return body


def _modifiers(c: Cursor) -> tuple[str, tuple[str, ...]]:
    """Access and modifiers before a name, in any order."""
    access, modifiers = "PUBLIC", []
    while c.word() in ACCESS | MODIFIERS and c.kinds[c.at + 1] is NAME:
        word = c.word()
        c.take()
        if word in ACCESS:
            access = word
        else:
            modifiers.append(word)
    return access, tuple(modifiers)


def _header(
    c: Cursor, kind: str, name: int
) -> tuple[tree.TypeSpec | None, tuple[tree.NamedType, ...], tuple[tree.NamedType, ...], tuple[str, ...]]:
    """Parses what follows the name: result, bases, interfaces, namespaces used."""
    result: tree.TypeSpec | None = None
    extends: tuple[tree.NamedType, ...] = ()
    implements: tuple[tree.NamedType, ...] = ()
    using: tuple[str, ...] = ()
    while True:
        if c.is_(":") and kind in ("FUNCTION", "METHOD", "PROPERTY", "PROPERTY_GET", "PROPERTY_SET"):
            c.take()
            result = parse_type.type_spec(c)
            if _says(c, "VOID", result):
                result = None
        elif c.word() == "EXTENDS" and c.kinds[c.at + 1] is NAME:
            c.take()
            extends += _parents(c, "the name of the base")
        elif c.word() == "IMPLEMENTS" and c.kinds[c.at + 1] is NAME:
            c.take()
            implements += _parents(c, "the name of an interface")
        elif c.word() == "USING" and c.kinds[c.at + 1] is NAME:
            using += using_names(c)
        elif c.is_(";") and not using:
            c.take()
        else:
            break
    if len(extends) > 1 and kind != "INTERFACE":
        message = f"A {kind} extends one other only; implement INTERFACEs for more."
        c.report("S003", message, c.span_of(name))
        extends = extends[:1]
    return result, extends, implements, using


def _says(c: Cursor, name: str, spec: tree.TypeSpec) -> bool:
    return isinstance(spec, tree.NamedType) and spec.name.upper() == name


def _parents(c: Cursor, what: str) -> tuple[tree.NamedType, ...]:
    found = [parse_type.parent(c, what)]
    while c.accept(","):
        found.append(parse_type.parent(c, what))
    return tuple(found)


def using_names(c: Cursor) -> tuple[str, ...]:
    """`USING A.B, C;`"""
    c.take()
    what = "the name of a NAMESPACE"
    found = [c.qualified(what)]
    while c.accept(","):
        found.append(c.qualified(what))
    c.close(";", "after USING")
    return tuple(found)


def _end_follows(c: Cursor, end: str) -> bool:
    """Whether this POU's end comes before the next POU begins."""
    for at in range(c.at, len(c.texts)):
        text = c.texts[at]
        if text == end or text in POU_STARTS:
            return text == end
    return False


def _skip_section(c: Cursor, kind: str) -> None:
    start = c.take()
    message = f"{c.texts[start]} in a {kind} is not supported; write it inside of the CONFIGURATION."
    c.report("X001", message, c.span_of(start))
    while not c.ended() and not c.accept("END_VAR") and c.texts[c.at] not in POU_STARTS:
        c.take()
    c.accept(";")


def _vendor_lines(c: Cursor) -> None:
    """`VERSION : 0.1`, `TITLE = ...`, `BEGIN`, which one vendor's exports have before the statements."""
    while c.word() in SETTINGS_OF_VENDORS and c.texts[c.at + 1] in (":", "="):
        line = c.line_of(c.at)
        while not c.ended() and c.line_of(c.at) == line:
            c.take()
    if c.word() == "BEGIN" and c.texts[c.at + 1] not in (":=", "(", ".", "[", ";"):
        c.take()


def _pou_end(c: Cursor, kind: str, name: int) -> None:
    end = ENDS[kind]
    if not c.accept(end):
        message = f"`{end}` expected to close {kind} {c.texts[name]}{c.found()}."
        c.report("S003", message, c.here())
        if c.texts[c.at] in ENDS.values() or c.texts[c.at].startswith("END_"):
            c.take()
    c.accept(";")


# ---- members --------------------------------------------------------------------------------------------------


def member(c: Cursor, owner: str) -> list[tree.PouDeclaration]:
    """A METHOD, ACTION or PROPERTY."""
    first = c.take()
    word = c.texts[first].upper()
    if word == "ACTION" and parse_chart.follows(c):
        c.report("S003", f"the name of the ACTION expected{c.found()}.", c.here())
        return []
    if word == "ACTION":
        return [_action(c)]
    access, modifiers = _modifiers(c)
    if word == "METHOD" and c.pragmas and after_init(c.pragmas, c.end_of(first - 1) if first else 0, c.starts[first]):
        modifiers += (CALL_AFTER_INIT,)
    name = c.name(f"the name of the {word}")
    result, _, _, _ = _header(c, word, name)
    if word == "METHOD":
        return [_method(c, owner, name, result, access, modifiers)]
    return _property(c, owner, word, name, result, access, modifiers)


def _method(
    c: Cursor, owner: str, name: int, result: tree.TypeSpec | None, access: str, modifiers: tuple[str, ...]
) -> tree.PouDeclaration:
    sections = parse_declaration.sections(c)
    body = whole_body(c)
    # in an interface, and where a vendor's export says nothing more, the next declaration ends it
    if not c.accept("END_METHOD") and not (owner == "INTERFACE" and not body):
        _missing(c, "END_METHOD", f"METHOD {c.texts[name]}")
    c.accept(";")
    return _declared(c, "method", name, result, sections, body, access, modifiers)


def _action(c: Cursor) -> tree.PouDeclaration:
    """A method without variables of its own."""
    name = c.name("the name of the ACTION")
    c.accept(":")
    c.wall = parse_chart.wall(c)
    body = whole_body(c)
    c.wall = -1
    if not c.accept("END_ACTION"):
        _missing(c, "END_ACTION", f"ACTION {c.texts[name]}")
    c.accept(";")
    return _declared(c, "method", name, None, (), body, "PUBLIC", (ACTION,))


def _property(
    c: Cursor,
    owner: str,
    word: str,
    name: int,
    result: tree.TypeSpec | None,
    access: str,
    modifiers: tuple[str, ...],
) -> list[tree.PouDeclaration]:
    what = f"{word} {c.texts[name]}"
    if result is None:
        c.report("S003", f"{what} needs a type: `{word} {c.texts[name]} : INT`.", c.span_of(name))
    found: list[tree.PouDeclaration] = []
    if word != "PROPERTY":
        sections = parse_declaration.sections(c)
        kind = "get" if word == "PROPERTY_GET" else "set"
        found.append(_declared(c, kind, name, result, sections, whole_body(c), access, modifiers))
    if word == "PROPERTY":
        _variables_of_property(c, name)
    while word == "PROPERTY" and (part := _part(c)):
        before, _ = _modifiers(c)
        c.take()
        own_access, _ = _modifiers(c)
        if c.word() in ACCESS and c.kinds[c.at + 1] is Lex.KEYWORD:  # before its variables, as TwinCAT writes it
            own_access = c.texts[c.take()].upper()
        own_access = before if own_access == "PUBLIC" else own_access
        sections = parse_declaration.sections(c)
        body = whole_body(c) if not _part(c) else ()
        shown = own_access if own_access != "PUBLIC" else access
        found.append(_declared(c, part.lower(), name, result, sections, body, shown, modifiers))
        if not c.accept(f"END_{part}") and owner != "INTERFACE" and not c.is_("END_PROPERTY"):
            _missing(c, f"END_{part}", f"{part} of {what}")
        c.accept(";")
    if not found and owner == "INTERFACE":
        found = [_declared(c, kind, name, result, (), (), access, modifiers) for kind in ("get", "set")]
    if not found:
        c.report("S003", f"{what} has neither GET nor SET.", c.span_of(name))
    if not c.accept("END_PROPERTY") and owner != "INTERFACE":
        _missing(c, "END_PROPERTY", what)
    c.accept(";")
    return found


def _variables_of_property(c: Cursor, name: int) -> None:
    """An empty `VAR END_VAR`, which one vendor's tool writes; no documentation tells what variables there would be."""
    for section in parse_declaration.sections(c):
        if section.variables:
            message = f"Variables of PROPERTY {c.texts[name]} are not supported; declare them after GET or SET."
            c.report("X001", message, section.span)


def _part(c: Cursor) -> str:
    """GET or SET, when that begins a part of a property; before it or after it is who may use it."""
    at = c.at + (c.word() in parse_declaration.ACCESS)
    word = c.texts[at].upper()
    return word if word in ("GET", "SET") and c.texts[at + 1] not in (":=", "(", ".", "[") else ""


def _missing(c: Cursor, end: str, of: str) -> None:
    c.report("S003", f"`{end}` expected to close {of}{c.found()}.", c.here())


def _declared(
    c: Cursor,
    kind: str,
    name: int,
    result: tree.TypeSpec | None,
    sections: tuple[tree.VariableSection, ...],
    body: Body,
    access: str,
    modifiers: tuple[str, ...],
) -> tree.PouDeclaration:
    return tree.PouDeclaration(
        kind,
        c.texts[name],
        result,
        sections,
        body,
        c.span_of(name),
        modifiers=modifiers,
        access=access,
        asked=_asked(c),
    )


def _joined(first: Body, second: Body) -> Body:
    """Joins the two parts of a body that has a method in its middle."""
    if not first or not second:
        return first or second
    if isinstance(first, tree.IlBody) and isinstance(second, tree.IlBody):
        return replace(first, instructions=first.instructions + second.instructions)
    if isinstance(first, NetworkBody) and isinstance(second, NetworkBody):
        return replace(first, networks=first.networks + second.networks)
    if isinstance(first, Chart) and isinstance(second, Chart):
        span = first.span
        if isinstance(span, Stretch) and isinstance(second.span, Stretch):
            span = Stretch(span.source, span.start, second.span.end)  # actions between them are part of the chart
        steps, transitions = first.steps + second.steps, first.transitions + second.transitions
        return replace(first, steps=steps, transitions=transitions, span=span, whole=first.whole and second.whole)
    if isinstance(first, tuple) and isinstance(second, tuple):
        return first + second
    return first


def with_member(pou: tree.PouDeclaration, members: list[tree.PouDeclaration]) -> tree.PouDeclaration:
    """A POU with these members. What edges, loops and charts of an ACTION remember are variables of the POU."""
    own = [_owned(each, pou.name) for each in members]
    bodies = [each.body for each in own if ACTION in each.modifiers and pou.kind in ("program", "function_block")]
    kept = [section for body in bodies if isinstance(body, NetworkBody) for section in memories(body)]
    charts = [body for body in bodies if isinstance(body, Chart)]
    kept += [section for body in charts for section in (*variables(body), *memories(body.conditions))]
    return replace(pou, methods=(*pou.methods, *own), sections=(*pou.sections, *kept))


def _owned(member: tree.PouDeclaration, owner: str) -> tree.PouDeclaration:
    named = f"{owner}.{member.name}"
    if isinstance(member.body, NetworkBody):
        return replace(member, body=replace(member.body, owner=named))
    if isinstance(member.body, Chart):
        return replace(member, body=replace(member.body, owner=named, action=member.name))
    return member
