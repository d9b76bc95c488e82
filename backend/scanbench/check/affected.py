"""What an edit of a POU's declarations may change elsewhere: all that mentions it, or that is declared by what mentions it.

Names are the only way from a body to the declarations of other POUs. So a body whose text has none of these names keeps its
problems, and needs no new check.
"""

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import fields, is_dataclass, replace

from scanbench.check.declare.collect import globals_of
from scanbench.problems import Span
from scanbench.syntax import tree
from scanbench.syntax.chunks import Chunk

INNER = ("VAR", "VAR_TEMP")
"""Sections of a block that its callers have nothing to do with."""
SIZES = frozenset(("SIZEOF",))
"""What sees a type without naming its members."""
_WORD = re.compile(r"[^\W\d]\w*")


class Words:
    """The words of each chunk, all and by declaration, in upper case; found once for each text."""

    def __init__(self) -> None:
        self._all: dict[int, tuple[str, frozenset[str]]] = {}
        self._declared: dict[int, tuple[tree.File, dict[str, frozenset[str]]]] = {}

    def of(self, chunk: Chunk) -> frozenset[str]:
        """All words of the chunk, comments and strings included."""
        text, known = chunk.source.text, self._all.get(id(chunk))
        if known is None or known[0] != text:
            known = self._all[id(chunk)] = text, frozenset(_WORD.findall(text.upper()))
        return known[1]

    def declared(self, chunk: Chunk) -> dict[str, frozenset[str]]:
        """What each declaration of the chunk mentions."""
        known = self._declared.get(id(chunk))
        if known is None or known[0] is not chunk.file:
            known = self._declared[id(chunk)] = chunk.file, _declared(chunk.file)
        return known[1]


def tainted(changed: Iterable[str], chunks: Iterable[Chunk], words: Words) -> set[str]:
    """The changed POUs, and every type, POU and global variable whose declaration leads to one; names in upper case."""
    declared: dict[str, frozenset[str]] = {}
    for chunk in chunks:
        for name, mentions in words.declared(chunk).items():
            declared[name] = declared.get(name, frozenset()) | mentions
    found = {name.upper() for name in changed}
    grown = True
    while grown:
        more = {name for name, mentions in declared.items() if name not in found and not found.isdisjoint(mentions)}
        grown = bool(more)
        found |= more
    return found


def inner_changes(old: tree.PouDeclaration, new: tree.PouDeclaration) -> frozenset[str] | None:
    """Names of the variables that differ, when only variables do that others reach by their names alone; else None."""
    around = [
        [replace(pou, body=(), sections=())] + [each for each in pou.sections if each.keyword not in INNER]
        for pou in (old, new)
    ]  # fmt: skip
    if around[0] != around[1]:
        return None
    mine, theirs = ({each.name.upper(): (section.qualifiers, section.access, _shape(each))
                     for section in pou.sections if section.keyword in INNER for each in section.variables}
                    for pou in (old, new))  # fmt: skip
    return frozenset(name for name in mine.keys() | theirs.keys() if mine.get(name) != theirs.get(name))


def _shape(node: object) -> object:
    """The same for two trees that differ in places only."""
    if isinstance(node, Span):
        return None
    if isinstance(node, tuple | list):
        return tuple(_shape(each) for each in node)
    if is_dataclass(node) and not isinstance(node, type):
        return type(node), tuple(_shape(getattr(node, field.name)) for field in fields(node))
    return node


def tells_enumerators(pou: tree.PouDeclaration) -> bool:
    """Whether its variables bring names of values along, which may be seen from anywhere."""
    return any(isinstance(node, tree.EnumSpec) for node in _nodes(pou.sections))


def _declared(file: tree.File) -> dict[str, frozenset[str]]:
    made: dict[str, frozenset[str]] = {}
    for name, node in _declarations(file):
        key = name.upper()
        made[key] = made.get(key, frozenset()) | frozenset(_mentioned(node))
    return made


def _declarations(file: tree.File) -> Iterator[tuple[str, object]]:
    for declaration in file.types:
        yield declaration.name, declaration
    for pou in file.pous:
        yield pou.name, (pou.sections, pou.result, pou.extends, pou.implements)
    for section in (*file.globals, *(each for conf in file.configurations for each in globals_of(conf))):
        for variable in section.variables:
            yield variable.name, variable


def _mentioned(node: object) -> Iterator[str]:
    """Every text in a tree that may be a name."""
    for each in _nodes(node):
        if isinstance(each, str):
            yield from _WORD.findall(each.upper())


def _nodes(node: object) -> Iterator[object]:
    yield node
    if isinstance(node, tuple | list):
        for each in node:
            yield from _nodes(each)
    elif isinstance(node, Mapping):
        for each in node.values():
            yield from _nodes(each)
    elif is_dataclass(node) and not isinstance(node, Span | type):
        for field in fields(node):
            yield from _nodes(getattr(node, field.name))
