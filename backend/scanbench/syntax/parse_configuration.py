"""Configurations: resources, tasks, program instances, VAR_CONFIG and VAR_ACCESS."""

from dataclasses import dataclass, field

from scanbench.problems import Span
from scanbench.syntax import parse_declaration, parse_expression, parse_initial, parse_type, tree
from scanbench.syntax.cursor import NAME, Cursor, Unexpected
from scanbench.syntax.lexer import Lex

WORDS = ("RESOURCE", "TASK")
PARTS = frozenset(("VAR_GLOBAL", "VAR_ACCESS", "VAR_CONFIG", "PROGRAM", "END_RESOURCE", "END_CONFIGURATION"))


@dataclass(slots=True)
class _Parts:
    """What a CONFIGURATION or a RESOURCE is made of."""

    globals: list[tree.VariableSection] = field(default_factory=list)
    tasks: list[tree.TaskDeclaration] = field(default_factory=list)
    programs: list[tree.ProgramDeclaration] = field(default_factory=list)
    resources: list[tree.ResourceDeclaration] = field(default_factory=list)
    settings: list[tree.Variable] = field(default_factory=list)
    accesses: list[tree.AccessDeclaration] = field(default_factory=list)


def configuration(c: Cursor) -> tree.Configuration:
    start = c.take()
    name = c.name("the name of the configuration")
    span = c.span_from(start)
    parts = _parts(c, "END_CONFIGURATION")
    parse_declaration.end(c, "END_CONFIGURATION", f"CONFIGURATION {c.texts[name]}")
    return tree.Configuration(
        c.texts[name], tuple(parts.globals), tuple(parts.tasks), tuple(parts.programs), span,
        tuple(parts.resources), tuple(parts.settings), tuple(parts.accesses), c.visible,
    )  # fmt: skip


def _parts(c: Cursor, end: str) -> _Parts:
    parts = _Parts()
    while not c.is_(end) and not c.ended():
        before, depth = c.at, c.depth
        try:
            if not _part_of(c, parts, end):
                break
        except Unexpected:
            c.depth = depth
            _skip_part(c, before)
    return parts


def _part_of(c: Cursor, parts: _Parts, end: str) -> bool:
    """Reads one part; false where something else begins."""
    text, word = c.texts[c.at], c.word()
    if text == ";":
        c.take()
    elif text == "VAR_GLOBAL":
        parts.globals.append(parse_declaration.section(c))
    elif text == "VAR_CONFIG":
        parts.settings += settings(c)
    elif text == "VAR_ACCESS":
        parts.accesses += _accesses(c)
    elif text == "PROGRAM":
        parts.programs.append(_program(c))
    elif word == "TASK":
        parts.tasks.append(_task(c))
    elif word == "RESOURCE" and end != "END_RESOURCE":
        parts.resources.append(_resource(c))
    elif text.startswith("END_") or text in ("FUNCTION", "FUNCTION_BLOCK", "TYPE", "CONFIGURATION"):
        return False
    else:
        raise c.fail(f"RESOURCE, TASK, PROGRAM, VAR_GLOBAL or {end} expected")
    return True


def _skip_part(c: Cursor, before: int) -> None:
    if c.at == before:
        c.take()
    while not c.ended() and c.texts[c.at] not in PARTS and c.word() not in WORDS:
        if c.texts[c.take()] == ";":
            return


def _resource(c: Cursor) -> tree.ResourceDeclaration:
    c.take()
    name = c.name("the name of the resource")
    if c.accept_word("ON"):
        c.name("the type of the resource")
    parts = _parts(c, "END_RESOURCE")
    for where in [each.span for each in parts.settings] + [each.span for each in parts.accesses]:
        c.report("S003", "VAR_CONFIG and VAR_ACCESS belong outside of a RESOURCE.", where)
    parse_declaration.end(c, "END_RESOURCE", f"RESOURCE {c.texts[name]}")
    return tree.ResourceDeclaration(
        c.texts[name], tuple(parts.globals), tuple(parts.tasks), tuple(parts.programs), c.span_of(name)
    )


def _task(c: Cursor) -> tree.TaskDeclaration:
    c.take()
    name = c.name("the name of the task")
    known: dict[str, tree.Expression | None] = {"INTERVAL": None, "PRIORITY": None, "SINGLE": None}
    c.expect("(", "after the name of the task")
    while not c.is_(")"):
        key = c.name("INTERVAL, SINGLE or PRIORITY")
        c.expect(":=", f"after {c.texts[key]}")
        value = parse_expression.expression(c)
        word = c.texts[key].upper()
        if word not in known:
            c.report("X001", f"{word} of a task is not supported.", c.span_of(key))
        elif known[word] is not None:
            c.report("D001", f"{word} of this task is given twice.", c.span_of(key))
        known[word] = value
        if not c.accept(","):
            break
    c.expect(")", "to close the task")
    c.close(";", "after the task")
    return tree.TaskDeclaration(c.texts[name], known["INTERVAL"], known["PRIORITY"], c.span_of(name), known["SINGLE"])


def _program(c: Cursor) -> tree.ProgramDeclaration:
    c.take()
    retain = c.word() == "RETAIN" and c.kinds[c.at + 1] is NAME
    if c.word() in ("RETAIN", "NON_RETAIN") and c.kinds[c.at + 1] is NAME:
        c.take()
    name = c.name("the name of the program instance")
    task = c.texts[c.name("the name of a task")] if c.accept_word("WITH") else None
    c.expect(":", "after the program instance, then its type")
    type = parse_type.parent(c, "the name of a PROGRAM")
    connections: list[tree.Argument] = []
    blocks: list[tuple[str, str, Span]] = []
    if c.accept("("):
        while not c.is_(")"):
            _connection(c, connections, blocks)
            if not c.accept(","):
                break
        c.expect(")", "to close the connections of the program")
    c.close(";", "after the program instance")
    span = c.span_of(name)
    return tree.ProgramDeclaration(c.texts[name], task, type, span, tuple(connections), tuple(blocks), retain)


def _connection(c: Cursor, connections: list[tree.Argument], blocks: list[tuple[str, str, Span]]) -> None:
    """`input := x`, `output => y`, or `instance WITH task`."""
    start = c.at
    if c.kinds[start] is NAME and c.word(1) == "WITH":
        c.at += 2
        task = c.name("the name of a task")
        blocks.append((c.texts[start], c.texts[task], c.span_from(start)))
        return
    argument = parse_expression.argument(c)
    if argument.name is None:
        raise c.fail("`input := value`, `output => variable` or `instance WITH task` expected", start)
    connections.append(argument)


# ---- VAR_CONFIG and VAR_ACCESS ------------------------------------------------------------------------------


def settings(c: Cursor) -> list[tree.Variable]:
    """`resource.program.instance.variable AT %IX1.0 : BOOL := TRUE;`"""
    found = []
    start = c.take()
    while not c.is_("END_VAR") and c.kinds[c.at] is NAME:
        try:
            first = c.at
            path = _instance_path(c)
            span = c.span_from(first)
            address, address_span = parse_type.located(c)
            c.expect(":", "after the path, then its type")
            spec = parse_type.type_spec(c)
            arguments = parse_expression.arguments(c, "initial values") if c.is_("(") else ()
            initial = parse_initial.initial(c) if c.accept(":=") else None
            c.close(";", f"after the setting of `{path}`")
            found.append(tree.Variable(path, spec, initial, address, span, address_span, arguments))
        except Unexpected:
            parse_type.skip_declaration(c)
    parse_declaration.end(c, "END_VAR", f"VAR_CONFIG of line {c.line_of(start)}")
    return found


def _accesses(c: Cursor) -> list[tree.AccessDeclaration]:
    """`name : resource.program.variable : type READ_WRITE;`"""
    found = []
    start = c.take()
    while not c.is_("END_VAR") and c.kinds[c.at] is NAME:
        try:
            name = c.take()
            c.expect(":", "after the name, then the path of the variable")
            path = _instance_path(c)
            c.expect(":", "after the path, then the type of the variable")
            spec = parse_type.type_spec(c)
            writable = c.word() == "READ_WRITE"
            if c.word() in ("READ_WRITE", "READ_ONLY"):
                c.take()
            c.close(";", f"after the access path `{c.texts[name]}`")
            found.append(tree.AccessDeclaration(c.texts[name], path, spec, writable, c.span_of(name)))
        except Unexpected:
            parse_type.skip_declaration(c)
    parse_declaration.end(c, "END_VAR", f"VAR_ACCESS of line {c.line_of(start)}")
    return found


def _instance_path(c: Cursor) -> str:
    """Names, indices and an address joined by dots, as written but for blanks."""
    start = c.at
    while c.kinds[c.at] in (NAME, Lex.ADDRESS, Lex.INTEGER) or c.is_(".", "[", "]", ","):
        c.take()
    if c.at == start:
        raise c.fail("the path of a variable expected")
    return "".join(c.texts[start : c.at])
