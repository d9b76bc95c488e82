"""What the files of a project declare, for tools that list it."""

from dataclasses import dataclass
from typing import ClassVar, Literal, get_args

from scanbench.check.declare.collect import globals_of
from scanbench.check.declare.names import qualified
from scanbench.public import Public
from scanbench.syntax import tree
from scanbench.syntax.parse_pou import ACTION

PouInfoKind = Literal[
    "program", "function_block", "function", "class", "interface", "method", "action", "property", "type", "global"
]  # fmt: skip
_POU_KINDS: dict[str, PouInfoKind] = {kind: kind for kind in get_args(PouInfoKind)}


@dataclass(frozen=True, slots=True)
class PouInfo(Public):
    """What a file declares, for the explorer."""

    PUBLIC: ClassVar = "Pou"

    name: str
    """In full: with its namespace, and for a method with its class."""
    kind: PouInfoKind
    file: str
    line: int


def pou_infos(parsed: list[tree.File]) -> list[PouInfo]:
    made = []
    for file in parsed:
        for pou in file.pous:
            name = qualified(pou.namespace, pou.name)
            made.append(PouInfo(name, _POU_KINDS[pou.kind], file.name, pou.span.line))
            made += _methods(name, pou)
        made += [
            PouInfo(qualified(each.namespace, each.name), "type", file.name, each.span.line) for each in file.types
        ]
        for section in (*file.globals, *(each for conf in file.configurations for each in globals_of(conf))):
            made += [
                PouInfo(qualified(section.namespace, each.name), "global", file.name, each.span.line)
                for each in section.variables
            ]
    return made


def _methods(owner: str, pou: tree.PouDeclaration) -> list[PouInfo]:
    """Methods, actions and properties; the two halves of a property are one."""
    made: dict[str, PouInfo] = {}
    for each in pou.methods:
        kind: PouInfoKind = "method" if each.kind == "method" else "property"
        if ACTION in each.modifiers:
            kind = "action"
        made.setdefault(each.name.upper(), PouInfo(f"{owner}.{each.name}", kind, each.span.file, each.span.line))
    return list(made.values())
