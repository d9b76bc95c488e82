"""Sections of variables."""

from scanbench.syntax import parse_type, tree
from scanbench.syntax.cursor import Cursor

QUALIFIERS = frozenset(("CONSTANT", "RETAIN", "NON_RETAIN", "PERSISTENT"))
ACCESS = frozenset(("PUBLIC", "PROTECTED", "PRIVATE", "INTERNAL"))


def sections(c: Cursor) -> tuple[tree.VariableSection, ...]:
    found = []
    while c.texts[c.at] in parse_type.SECTIONS:
        found.append(section(c))
    return tuple(found)


def section(c: Cursor, list_name: str = "", namespace: str = "") -> tree.VariableSection:
    """One section of variables."""
    start = c.take()
    span = c.span_of(start)
    qualifiers, access = [], "PROTECTED"
    while (word := c.word()) and c.texts[c.at + 1] not in parse_type.NOT_A_NAME:
        if word in QUALIFIERS:
            qualifiers.append(word)
        elif word in ACCESS:
            access = word
        else:
            break
        c.take()
    variables = parse_type.variables(c)
    end(c, "END_VAR", f"{c.texts[start]} of line {span.line}")
    keyword, kept = c.texts[start], ""
    if keyword in ("VAR_STAT", "VAR_INST"):
        # what a block keeps between calls has no word of its own in the standard
        keyword, kept = "VAR", keyword
    using = c.visible if keyword == "VAR_GLOBAL" else ()
    return tree.VariableSection(keyword, tuple(qualifiers), variables, span, access, namespace, list_name, kept, using)


def end(c: Cursor, keyword: str, of: str) -> None:
    """The closing keyword; the `;` after it may be missing, as vendors allow."""
    if not c.accept(keyword):
        c.report("S003", f"`{keyword}` expected to close the {of}{c.found()}.", c.here())
    c.accept(";")
