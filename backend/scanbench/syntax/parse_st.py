"""Structured Text and Instruction List -> tree: everything that one file declares."""

import re

from scanbench.problems import Problem
from scanbench.syntax import parse_configuration, parse_declaration, parse_initial, parse_pou, parse_type, tree
from scanbench.syntax.cursor import NAME, Cursor, Unexpected
from scanbench.syntax.parse_generic import external, named_apart
from scanbench.syntax.parse_pou import MEMBERS, with_member
from scanbench.syntax.pragmas import is_external
from scanbench.syntax.source import Source

TOPS = frozenset(("PROGRAM", "FUNCTION_BLOCK", "FUNCTION", "TYPE", "VAR_GLOBAL", "VAR_CONFIG", "CONFIGURATION"))
WORDS = frozenset(("CLASS", "INTERFACE", "NAMESPACE", "USING", "ACTIONS")) | MEMBERS
REFUSED = {
    "ORGANIZATION_BLOCK": "write a PROGRAM, and a TASK in a CONFIGURATION",
    "DATA_BLOCK": "write VAR_GLOBAL",
    "VAR_ACCESS": "write it inside of the CONFIGURATION",
}
ATTRIBUTES = re.compile(
    r"\{\s*attribute\s*(?::=)?\s*'(qualified_only|to_string|pack_mode)'(?:\s*:=\s*'([^']*)')?", re.IGNORECASE
)


def parse_st(source: Source) -> tuple[tree.File, list[Problem]]:
    """The tree of what could be read, and every problem on the way, in the order of the text."""
    return whole(Cursor(source))


def whole(c: Cursor) -> tuple[tree.File, list[Problem]]:
    """Everything up to the end of the text, and the problems in their order."""
    result = tree.File(c.source.name)
    while not c.ended():
        _next(c, result)
    for owner, span, members in c.actions:
        found = [at for at, pou in enumerate(result.pous) if pou.name.upper() == owner.upper()]
        if found:
            result.pous[found[-1]] = with_member(result.pous[found[-1]], members)
        else:
            c.report("D002", f"There is no POU `{owner}` in this file, whose ACTIONS these could be.", span)
    parse_pou.check_pragmas(c)
    c.problems.sort(key=lambda problem: (problem.span.line, problem.span.column))
    return result, c.problems


def _next(c: Cursor, result: tree.File) -> None:
    before = c.at
    try:
        _top(c, result)
    except Unexpected:
        c.depth = 0
        _skip_top(c, before)


def _top(c: Cursor, result: tree.File) -> None:
    text, word = c.texts[c.at], c.word()
    if text == ";":
        c.take()
    elif text in ("PROGRAM", "FUNCTION_BLOCK", "FUNCTION") or word in ("CLASS", "INTERFACE"):
        _pou(c, result)
    elif text == "TYPE":
        _types(c, result)
    elif text == "VAR_GLOBAL":
        result.globals.append(parse_declaration.section(c, c.list_name, c.namespace))
    elif text == "VAR_CONFIG":
        result.settings += parse_configuration.settings(c)
    elif text == "CONFIGURATION":
        result.configurations.append(parse_configuration.configuration(c))
    elif word == "NAMESPACE":
        _namespace(c, result)
    elif word == "USING":
        c.visible += parse_pou.using_names(c)
    elif word == "ACTION" and (owner := named_apart(c)) is not None:
        c.actions.append((owner, c.here(), parse_pou.member(c, "FUNCTION_BLOCK")))
    elif word == "ACTIONS":
        _actions(c, result)
    elif word in MEMBERS and result.pous:
        # exports of vendors write methods and actions after the POU they belong to
        last = result.pous[-1]
        result.pous[-1] = with_member(last, parse_pou.member(c, last.kind.upper()))
    elif (refused := word or text) in REFUSED:
        c.report("X001", f"{refused} is not supported here; {REFUSED[refused]}.", c.here())
        raise Unexpected
    elif word in MEMBERS:
        c.report(
            "S003",
            f"{word} belongs into a FUNCTION_BLOCK: write it after one, or before its END_FUNCTION_BLOCK.",
            c.here(),
        )
        raise Unexpected
    else:
        raise c.fail("PROGRAM, FUNCTION_BLOCK, FUNCTION, CLASS, INTERFACE, TYPE, VAR_GLOBAL or CONFIGURATION expected")


def _pou(c: Cursor, result: tree.File) -> None:
    first = c.at
    pou = parse_pou.pou(c, c.namespace, c.visible)
    if c.pragmas and is_external(c.pragmas, c.end_of(first - 1) if first else 0, c.starts[first]):
        pou, given = external(c, pou)
        result.globals += [] if given is None else [given]
    result.pous.append(pou)


def _actions(c: Cursor, result: tree.File) -> None:
    """`ACTIONS Pump ... END_ACTIONS` beside a POU, as some exports write its actions; without a name, those of the one before."""
    start = c.take()
    name = start
    if c.kinds[c.at] is NAME and c.word() != "ACTION":
        name = c.name("the name of the POU")
        c.accept(":")
    members: list[tree.PouDeclaration] = []
    while c.word() == "ACTION":
        members += parse_pou.member(c, "FUNCTION_BLOCK")
    c.actions.append(
        (c.texts[name] if name != start or not result.pous else result.pous[-1].name, c.span_of(name), members)
    )
    if not c.accept_word("END_ACTIONS"):
        c.report(
            "S003", f"`END_ACTIONS` expected to close the ACTIONS of line {c.span_of(start).line}{c.found()}.", c.here()
        )
    c.accept(";")


def _skip_top(c: Cursor, before: int) -> None:
    if c.at == before:
        c.take()
    while not c.ended() and c.texts[c.at] not in TOPS and not c.is_("END_NAMESPACE"):
        if c.word() in WORDS and c.kinds[c.at + 1] is NAME:
            return
        c.take()


def _namespace(c: Cursor, result: tree.File) -> None:
    start = c.take()
    internal = c.word() == "INTERNAL" and c.kinds[c.at + 1] is NAME
    if internal:
        c.take()
    outer, visible = c.namespace, c.visible
    name = c.qualified("the name of the NAMESPACE")
    c.namespace = f"{outer}.{name}" if outer else name
    if internal:
        result.internal.append(c.namespace)
    try:
        c.enter({""})
        while not c.is_("END_NAMESPACE") and not c.ended():
            depth = c.depth
            _next(c, result)
            c.depth = depth
    finally:
        c.leave()
        c.namespace, c.visible = outer, visible
    parse_declaration.end(c, "END_NAMESPACE", f"NAMESPACE of line {c.line_of(start)}")


def _types(c: Cursor, result: tree.File) -> None:
    start = c.take()
    attributes = _attributes(c, start)
    access = "PUBLIC"
    if c.word() in ("PUBLIC", "INTERNAL") and c.kinds[c.at + 1] is NAME:
        access = c.word()
        c.take()
    while not c.is_("END_TYPE") and not c.ended() and c.texts[c.at] not in TOPS:
        depth = c.depth
        if c.accept(";"):
            continue
        try:
            result.types.append(_type(c, attributes, access))
        except Unexpected:
            c.depth = depth
            _skip_type(c)
    parse_declaration.end(c, "END_TYPE", f"TYPE of line {c.line_of(start)}")


def _skip_type(c: Cursor) -> None:
    """To after the declaration; its structure may have members that end in `;`."""
    while not c.is_("END_TYPE") and not c.ended() and c.texts[c.at] not in TOPS:
        if c.texts[c.take()] == ";" or c.is_("END_VAR"):
            return


def _type(c: Cursor, attributes: tuple[str, ...], access: str) -> tree.TypeDeclaration:
    policy = parse_type.subrange_policy(c)
    name = c.name("the name of a type")
    attributes = (*attributes, *_attributes(c, name))
    extends = None
    if c.word() == "EXTENDS":
        c.take()
        extends = parse_type.parent(c, "the name of a structure")
    c.expect(":", "after the name of the type")
    spec = parse_type.structure(c, extends) if extends and c.is_("STRUCT") else parse_type.type_spec(c, named=True)
    initial = parse_initial.initial(c) if c.accept(":=") else None
    if not isinstance(spec, tree.StructSpec) or c.is_(";"):
        c.close(";", f"after the declaration of `{c.texts[name]}`")
    return tree.TypeDeclaration(
        c.texts[name], spec, initial, c.span_of(name), c.namespace, c.visible, access, attributes, policy
    )


def _attributes(c: Cursor, token: int) -> tuple[str, ...]:
    """Those of a vendor that come immediately before this token."""
    first = c.end_of(token - 1) if token else 0
    last = c.starts[token]
    found = (ATTRIBUTES.match(text) for at, text in c.pragmas if first <= at < last)
    said = ((each.group(1).lower(), each.group(2) or "") for each in found if each)
    return tuple(f"{name}={value}" if name == "pack_mode" else name for name, value in said)
