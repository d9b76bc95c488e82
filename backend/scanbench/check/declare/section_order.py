"""In which order variables are declared: a constant may be named above its own declaration, or in a file before that."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import fields, is_dataclass

from scanbench.problems import Span
from scanbench.program.types import ELEMENTARY
from scanbench.syntax import tree

MAX_DEPTH = 100
"""Constants that need each other in a chain; further ones are told not to be declared."""


def constants_first(sections: tuple[tree.VariableSection, ...]) -> tuple[tree.VariableSection, ...]:
    """The sections as they are written; those of constants come first where a section above them names one, as in
    `VAR a : ARRAY[0..n] OF INT; END_VAR VAR CONSTANT n : INT := 9; END_VAR`."""
    last = max((at for at, each in enumerate(sections) if "CONSTANT" in each.qualifiers), default=0)
    if last == 0:
        return sections
    later = {
        each.name.upper(): at
        for at, section in enumerate(sections)
        if "CONSTANT" in section.qualifiers and section.keyword == "VAR"
        for each in section.variables
    }
    for at, section in enumerate(sections[:last]):
        names = {name.upper() for each in section.variables for name in _names((each.type, each.initial))}
        if any(later.get(name, at) > at for name in names):
            first = [each for each in sections if "CONSTANT" in each.qualifiers and each.keyword == "VAR"]
            return (*first, *(each for each in sections if each not in first))
    return sections


GlobalConstant = tuple[tree.VariableSection, tree.Variable]


def by_need(constants: Sequence[GlobalConstant], types: Mapping[str, tree.TypeDeclaration]) -> Iterator[GlobalConstant]:
    """Global constants as they are written, in the order of the files; one that another needs, also by way of a type, before that."""
    named: dict[str, list[int]] = {}
    for number, (_, variable) in enumerate(constants):
        named.setdefault(variable.name.upper(), []).append(number)
    done, seen = set[int](), set[str]()

    def needed(names: Iterable[str], depth: int) -> Iterator[int]:
        for name in names:
            key = name.upper()
            if key in types and key not in seen:
                seen.add(key)
                yield from needed(_names(types[key].type), depth)
            for number in named.get(key, ()):
                if number not in done and depth < MAX_DEPTH:
                    done.add(number)
                    yield from needed(_names((constants[number][1].type, constants[number][1].initial)), depth + 1)
                    yield number

    for number, (_, variable) in enumerate(constants):
        if number in done:
            continue
        if isinstance(variable.type, tree.NamedType) and isinstance(variable.initial, tree.Literal | None):
            if variable.type.name.upper() in ELEMENTARY:
                done.add(number)
                yield constants[number]
                continue
        yield from (constants[each] for each in needed((variable.name,), 0))


def named_variables(node: object) -> Iterator[str]:
    """The names of variables in an expression, without those of their members."""
    if isinstance(node, tree.Name):
        yield node.name
    elif isinstance(node, tree.MemberOf):
        yield from named_variables(node.owner)
    elif isinstance(node, tuple):
        for each in node:
            yield from named_variables(each)
    elif is_dataclass(node) and not isinstance(node, Span | type):
        for each in fields(node):
            yield from named_variables(getattr(node, each.name))


def _names(node: object) -> Iterator[str]:
    """The names in a part of a tree, those of types and members too."""
    if isinstance(node, tree.Name | tree.NamedType):
        yield node.name.rpartition(".")[2]
    elif isinstance(node, tree.MemberOf):
        yield node.name
        yield from _names(node.owner)
    elif isinstance(node, tuple):
        for each in node:
            yield from _names(each)
    elif is_dataclass(node) and not isinstance(node, Span | type):
        for each in fields(node):
            yield from _names(getattr(node, each.name))
