"""The first pass over the trees: which name is declared where, and what a namespace puts before it."""

from collections.abc import Iterator
from dataclasses import dataclass, field, fields, is_dataclass, replace
from functools import partial
from typing import TypedDict

from scanbench.check.context import Report
from scanbench.check.declare.declarations import Declarations
from scanbench.check.declare.later import ToDeclare
from scanbench.check.declare.members import declare
from scanbench.check.declare.names import LIBRARY, Space, full_name, qualified
from scanbench.check.declare.rewritten import overloaded_in, rewritten, signature_of
from scanbench.check.declare.scopes import Pous
from scanbench.check.dialect import Allowance
from scanbench.check.dialect_rules import said
from scanbench.check.libraries.catalogue import library_of_file
from scanbench.check.standard.library import library_of
from scanbench.problems import Span
from scanbench.program.types import ELEMENTARY, Record, Section
from scanbench.syntax import tree

ENABLE = (("EN", "VAR_INPUT"), ("ENO", "VAR_OUTPUT"))


class _Place(TypedDict):
    namespace: str
    using: tuple[str, ...]


@dataclass(slots=True)
class Collector:
    """Registers what the files declare; the library steps back where the user declares the same name."""

    report: Report
    declarations: Declarations
    system: tree.File
    """What the model adds to the library."""
    enabling: frozenset[str]
    """Files in whose text EN or ENO occurs."""
    functions: dict[str, tree.PouDeclaration] = field(default_factory=dict)
    user: list[tree.PouDeclaration] = field(default_factory=list)
    """POUs of the user in order of declaration, functions and blocks."""
    library: dict[str, tree.PouDeclaration] = field(default_factory=dict)
    """POUs of the standard library, those that the user hides in the namespace `LIBRARY`."""
    tells: set[str] = field(default_factory=set)
    """Keys of blocks whose body names ENO without declaring it: it is TRUE whenever they start."""
    overloads: dict[str, list[str]] = field(default_factory=dict)
    """Of a FUNCTION whose name others have as well, the keys of those."""
    _seen: dict[str, Span] = field(default_factory=dict)

    def collect(self, parsed: list[tree.File]) -> None:
        """All names of types and POUs."""
        internal = self.declarations.names.internal
        libraries = [each for each in parsed if library_of_file(each.name) is not None]
        own = [each for each in parsed if library_of_file(each.name) is None]
        taken = _declared(own) if libraries else set()
        overloaded = overloaded_in(own)
        for file in (*own, *(_apart(each, taken) for each in libraries)):
            internal |= {space.upper(): space.upper().rpartition(".")[0] for space in file.internal}
            for declaration in file.types:
                key = self._first(declaration.namespace, declaration.name, declaration.span)
                if key is not None:
                    self.declarations.type_trees[key] = declaration
                    if declaration.access == "INTERNAL" and declaration.namespace:
                        internal[key] = declaration.namespace.upper()
            for pou in file.pous:
                pou, key = self._keyed(rewritten(pou, overloaded, self.declarations.dialect, self.report))
                if key is None:
                    continue
                if pou.access == "INTERNAL" and pou.namespace:
                    internal[key] = pou.namespace.upper()
                made = self.with_enable(key, pou) if file.name in self.enabling else pou
                self._register(key, made)
                self.user.append(made)
        pous = [pou for file in (*library_of(self.declarations.dialect), self.system) for pou in file.pous]
        hidden = {pou.name.upper() for pou in pous} & self._seen.keys()
        for pou in pous:
            key = pou.name.upper()
            if hidden:  # the library itself goes on using its own
                pou = replace(pou, namespace=LIBRARY if key in hidden else "", using=(LIBRARY,))
                key = qualified(pou.namespace, pou.name).upper()
            self.library[key] = pou
            self._register(key, pou)

    def _register(self, key: str, pou: tree.PouDeclaration) -> None:
        table = self.functions if pou.kind == "function" else self.declarations.block_trees
        table[key] = pou

    def _keyed(self, pou: tree.PouDeclaration) -> tuple[tree.PouDeclaration, str | None]:
        """The POU and its key, when its name is free, or other FUNCTIONs of that name have other inputs or outputs."""
        key = full_name(pou).upper()
        first = self.functions.get(key)
        if first is None or pou.kind != "function" or Allowance.OVERLOADS not in self.declarations.dialect.allows:
            return pou, self._first(pou.namespace, pou.name, pou.span)
        others = self.overloads.get(key, [])
        if any(signature_of(pou) == signature_of(self.functions[each]) for each in (key, *others)):
            return pou, self._first(pou.namespace, pou.name, pou.span)
        if library_of_file(pou.span.file) is None:
            used = f"`{pou.name}` is declared in {first.span} as well"
            self.report.warn("W006", said(self.declarations.dialect, Allowance.OVERLOADS, used), pou.span)
        made = replace(pou, overload=f"({len(others) + 2})")
        self.overloads[key] = [*others, full_name(made).upper()]
        return made, full_name(made).upper()

    def _first(self, namespace: str, name: str, span: Span) -> str | None:
        """The key, when the name is free."""
        key = qualified(namespace, name).upper()
        if key in ELEMENTARY:
            self.report.error("D001", f"`{name}` is a standard type; choose another name.", span)
            return None
        first = self._seen.setdefault(key, span)
        if first is not span and library_of_file(span.file) is None:  # a library steps back
            self.report.error("D001", f"`{name}` is declared already in {first}; rename one.", span)
        return key if first is span else None

    # ---- EN and ENO -------------------------------------------------------------------------------------

    def with_enable(self, key: str, pou: tree.PouDeclaration) -> tree.PouDeclaration:
        """A body that names EN or ENO has them as input and output, declared or not."""
        methods = tuple(self.with_enable("", method) for method in pou.methods)
        if methods != pou.methods:
            pou = replace(pou, methods=methods)
        if pou.kind not in ("function", "function_block", "method"):
            return pou
        declared = {variable.name.upper() for section in pou.sections for variable in section.variables}
        named = set(_names(pou.body))
        for name, keyword in ENABLE:
            if name in named and name not in declared:
                true = tree.Literal("bool", 1, None, pou.span)
                variable = tree.Variable(name, tree.NamedType("BOOL", pou.span), true, None, pou.span)
                section = tree.VariableSection(keyword, (), (variable,), pou.span)
                pou = replace(pou, sections=(*pou.sections, section))
                if name == "ENO" and key:
                    self.tells.add(key)
        return pou


def _declared(files: list[tree.File]) -> set[str]:
    """Names at the top, in upper case."""
    types = (each.name.upper() for file in files for each in file.types if not each.namespace)
    return {*types, *(each.name.upper() for file in files for each in file.pous if not each.namespace)}


def _apart(file: tree.File, hidden: set[str]) -> tree.File:
    """A library in which what the project declares as well is in the namespace `LIBRARY`: the library itself goes on using its own."""
    if hidden.isdisjoint(_declared([file])):
        return file
    types = [replace(each, **_hidden(each, hidden)) for each in file.types]
    return replace(file, types=types, pous=[replace(each, **_hidden(each, hidden)) for each in file.pous])


def _hidden(each: tree.PouDeclaration | tree.TypeDeclaration, hidden: set[str]) -> _Place:
    inside = each.name.upper() in hidden and not each.namespace
    return {"namespace": LIBRARY if inside else each.namespace, "using": (*each.using, LIBRARY)}


def _names(node: object) -> Iterator[str]:
    """Every plain name in a body, in upper case."""
    if isinstance(node, tree.Name):
        yield node.name.upper()
    elif isinstance(node, tuple):
        for each in node:
            yield from _names(each)
    elif is_dataclass(node) and not isinstance(node, Span | tree.Literal):
        for each in fields(node):
            yield from _names(getattr(node, each.name))


# ---- global variables ---------------------------------------------------------------------------------------------


def global_sections(parsed: list[tree.File]) -> list[tree.VariableSection]:
    """Every VAR_GLOBAL, of files, configurations and resources."""
    sections = [section for file in parsed for section in file.globals]
    return sections + [each for file in parsed for conf in file.configurations for each in globals_of(conf)]


def globals_of(configuration: tree.Configuration) -> tuple[tree.VariableSection, ...]:
    """VAR_GLOBAL of a configuration and of its resources."""
    return (*configuration.globals, *(each for resource in configuration.resources for each in resource.globals))


def declare_globals(parsed: list[tree.File], variables: Record, declarations: Declarations, pous: Pous) -> None:
    """Declares constants first, as the bounds of other variables may use them; which of them first, says who needs whom."""
    sections = global_sections(parsed)
    kept = _Lists(declarations, pous)
    coming: list[ToDeclare] = []
    for constant in (True, False):
        for section in sections:
            if ("CONSTANT" in section.qualifiers) != constant:
                continue
            using = (*section.using, *((LIBRARY,) if library_of_file(section.span.file) else ()))
            space = Space(section.namespace, using, section.list_name)
            for variable in section.variables:
                name, own = kept.name_of(section, variable)
                do = partial(kept.declare, variables, section, replace(variable, name=name), own)
                coming.append((name, constant, do, space))
    declarations.later.declare(variables, coming)


@dataclass(slots=True)
class _Lists:
    """Variables of lists are known as `LIST.x`, and as `x` where one list only has it."""

    declarations: Declarations
    pous: Pous
    lists: dict[str, str] = field(default_factory=dict)
    """The list that a variable came from, by the name it is kept under."""

    def name_of(self, section: tree.VariableSection, variable: tree.Variable) -> tuple[str, str]:
        """The name that it is kept under, and its name with that of its list, if it is in one."""
        name = qualified(section.namespace, variable.name)
        if not section.list_name:
            self.lists.setdefault(name.upper(), "")
            return name, ""
        own = f"{section.list_name}.{variable.name}"
        if self.lists.setdefault(name.upper(), section.list_name) not in ("", section.list_name):
            name = own
        self.pous.aliases[own.upper()] = name
        return name, own

    def declare(self, variables: Record, section: tree.VariableSection, variable: tree.Variable, own: str) -> None:
        """Adds a global variable, which has its full name."""
        if own and own == variable.name:
            name = qualified(section.namespace, own.rpartition(".")[2])
            first = f"{self.lists[name.upper()]}.{own.rpartition('.')[2]}"
            self.pous.ambiguous.setdefault(name.upper(), [first]).append(own)
        constant = "CONSTANT" in section.qualifiers
        member = declare(self.declarations, variables, variable, Section.GLOBAL, constant)
        if member is not None:
            member.retain = bool({"RETAIN", "PERSISTENT"} & set(section.qualifiers))
            member.persistent = "PERSISTENT" in section.qualifiers
