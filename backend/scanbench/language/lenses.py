"""What an editor shows above a declaration: how many instances a program has of it, and how often it is named."""

from collections import Counter
from dataclasses import dataclass
from typing import Literal

from scanbench.check.uses import Symbol
from scanbench.language.declared import Declared, member_of
from scanbench.language.navigate import named_at, references
from scanbench.language.reading import Reading
from scanbench.program.types import ArrayType, Record, Section, Type
from scanbench.syntax import tree

Counted = Literal["instances", "references"]
_INSTANCED = ("program", "function_block", "class")
_ELSEWHERE = (Section.IN_OUT, Section.EXTERNAL)
"""What is declared so is an instance that something else has."""


@dataclass(frozen=True, slots=True)
class Lens:
    """One number above a declaration. It is counted when somebody sees it."""

    declared: Declared
    counted: Counted


def lenses(reading: Reading, file: str) -> list[Lens]:
    """Those of a file: of POUs, methods and types. A program is named by a configuration at most, so its references say nothing."""
    found: dict[Symbol, list[Lens]] = {}
    for each in reading.declared_in(file):
        if each.symbol.kind in ("pou", "method", "type"):
            found.setdefault(each.symbol, [Lens(each, counted) for counted in _counted(each)])
    return [lens for same in found.values() for lens in same]


def _counted(declared: Declared) -> list[Counted]:
    node = declared.node
    kind = node.kind if isinstance(node, tree.PouDeclaration) else ""
    instances: list[Counted] = ["instances"] if kind in _INSTANCED else []
    return instances if kind == "program" else [*instances, "references"]


def count(reading: Reading, symbol: Symbol, counted: Counted) -> int | None:
    """None where nobody knows it: a program with errors has no instances."""
    if counted == "references":
        return len(references(reading, symbol, declaration=False))
    program = reading.checked.program
    if program is None:
        return None
    inside = _Instances()
    roots = [each.pou.instance for each in program.shown]
    return sum(inside.of(each)[symbol.name] for each in (*roots, reading.project.checker.globals))


class _Instances:
    """How many instances of each block are in what is declared with a type, itself among them."""

    def __init__(self) -> None:
        self._known: dict[int, Counter[str]] = {}

    def of(self, type: Type) -> Counter[str]:
        if isinstance(type, ArrayType):
            return Counter({name: type.count * number for name, number in self.of(type.element).items()})
        if not isinstance(type, Record):
            return Counter()
        known = self._known.get(id(type))
        if known is None:
            known = self._known[id(type)] = Counter({type.name.upper(): 1})
            for member in type.members.values():
                if member.section not in _ELSEWHERE:
                    known.update(self.of(member.type))
        return known


def instances_at(reading: Reading, file: str, position: int) -> list[Declared]:
    """The variables that are instances, or arrays of instances, of what is named at a position."""
    named = named_at(reading, file, position)
    if named is None or named.symbol.kind != "pou":
        return []
    found = []
    for each in (each for name in sorted(reading.files) for each in reading.declared_in(name)):
        member = member_of(reading.project.checker, each.symbol) if isinstance(each.node, tree.Variable) else None
        if member is not None and member.section not in _ELSEWHERE and _made_of(member.type) == named.symbol.name:
            found.append(each)
    return found


def _made_of(type: Type) -> str:
    while isinstance(type, ArrayType):
        type = type.element
    return type.name.upper() if isinstance(type, Record) else ""
