"""What the texts declare: of each symbol where and how; and what the checks made of a variable."""

from collections.abc import Iterator
from dataclasses import dataclass

from scanbench.check.build import Checker
from scanbench.check.declare.names import qualified
from scanbench.check.uses import INLINE, Symbol
from scanbench.problems import Span
from scanbench.program.types import Member, Record, Reference, Section
from scanbench.syntax import tree

PARAMETERS = (Section.INPUT, Section.OUTPUT, Section.IN_OUT)
"""What a caller sees of a POU."""


@dataclass(frozen=True, slots=True)
class Declared:
    """One declaration of a symbol; halves of a property are two."""

    symbol: Symbol
    name: str
    """As written."""
    span: Span
    """Of the name."""
    node: tree.PouDeclaration | tree.TypeDeclaration | tree.Variable
    """Of a value of an enumeration, what lists it."""
    list_name: str = ""
    """Of a variable in a list of global variables."""


def declarations(file: tree.File) -> list[Declared]:
    """All that a file, or a part of one, declares. VAR_EXTERNAL declares nothing: it names what something else declares."""
    found: list[Declared] = []
    for pou in file.pous:
        found += _pou(pou)
    for member in file.members:
        found += (each for method in member.methods for each in _method(method, member.name.upper()))
    for type in file.types:
        found += _type(type)
    sections = list(file.globals)
    for each in file.configurations:
        sections += [*each.globals, *(section for resource in each.resources for section in resource.globals)]
    for section in sections:
        for variable in section.variables:
            symbol = Symbol("variable", "GLOBAL", qualified(section.namespace, variable.name).upper())
            found.append(Declared(symbol, variable.name, variable.span, variable, section.list_name))
            found += _inside(variable)
    return found


def _pou(pou: tree.PouDeclaration) -> Iterator[Declared]:
    key = qualified(pou.namespace, pou.name).upper()
    yield Declared(Symbol("pou", "", key), pou.name, pou.span, pou)
    yield from _variables(pou, key)
    for method in pou.methods:
        yield from _method(method, key)


def _method(method: tree.PouDeclaration, owner: str) -> Iterator[Declared]:
    yield Declared(Symbol("method", owner, method.name.upper()), method.name, method.span, method)
    half = f".{method.kind.upper()}" if method.kind in ("get", "set") else ""
    yield from _variables(method, f"{owner}.{method.name.upper()}{half}")


def _variables(pou: tree.PouDeclaration, owner: str) -> Iterator[Declared]:
    for section in pou.sections:
        if section.keyword == "VAR_EXTERNAL":
            continue
        for variable in section.variables:
            # EN and ENO, which a body only names, and the memory of an edge
            if variable.span is not pou.span and not variable.name.startswith("$"):
                yield Declared(Symbol("variable", owner, variable.name.upper()), variable.name, variable.span, variable)
                yield from _inside(variable)


def _inside(variable: tree.Variable) -> Iterator[Declared]:
    """What the type of a variable declares that has no name of its own."""
    spec = variable.type
    while isinstance(spec, tree.ArraySpec):
        spec = spec.element
    if isinstance(spec, tree.EnumSpec):
        owner = f"({', '.join(name for name, _, _ in spec.values)})".upper()
        for name, _, span in spec.values:
            yield Declared(Symbol("value", owner, name.upper()), name, span, variable)
    elif isinstance(spec, tree.StructSpec):
        for member in spec.members:
            yield Declared(Symbol("variable", INLINE, member.name.upper()), member.name, member.span, member)
            yield from _inside(member)


def _type(type: tree.TypeDeclaration) -> Iterator[Declared]:
    key = qualified(type.namespace, type.name).upper()
    yield Declared(Symbol("type", "", key), type.name, type.span, type)
    if isinstance(type.type, tree.EnumSpec):
        for name, _, span in type.type.values:
            yield Declared(Symbol("value", key, name.upper()), name, span, type)
    elif isinstance(type.type, tree.StructSpec):
        for member in type.type.members:
            yield Declared(Symbol("variable", key, member.name.upper()), member.name, member.span, member)
            yield from _inside(member)


# ---- what was made of it --------------------------------------------------------------------------------------------


def member_of(checker: Checker, symbol: Symbol) -> Member | None:
    """The variable of a symbol, also one of the library or the model; None where its declaration was refused."""
    if symbol.kind != "variable":
        return None
    found = (record.members.get(symbol.name) for record in _records(checker, symbol.owner))
    return next((member for member in found if member is not None), None)


def _records(checker: Checker, owner: str) -> Iterator[Record]:
    """What has the variables of this owner."""
    if owner == "GLOBAL":
        yield checker.globals
    if owner == checker.declarations.symbols.name.upper():
        yield checker.declarations.symbols
    type = checker.declarations.types.get(owner)
    record = type.target if isinstance(type, Reference) else type
    if isinstance(record, Record):
        yield record
    for pous in (checker.pous.functions, checker.pous.blocks):
        if owner in pous:
            yield pous[owner].frame
    for instance in checker.pous.instances.values():
        if instance.pou.name.upper().partition("<")[0] == owner:
            yield instance.pou.frame
    for half in ("", ".GET", ".SET"):
        home, _, name = owner.removesuffix(half).rpartition(".")
        around = checker.pous.classes.by_key.get(home)
        method = None if around is None else around.methods.get(name + half)
        if method is not None and method.pou is not None:
            yield method.pou.frame
