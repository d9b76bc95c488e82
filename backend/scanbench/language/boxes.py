"""The functions and function blocks that a diagram can call at a position, with their pins: what a drawing needs to put a box in."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

from scanbench.check.body.context import Body
from scanbench.check.declare.names import qualified
from scanbench.check.standard.functions import FUNCTIONS
from scanbench.check.standard.library import library_of
from scanbench.check.uses import Symbol
from scanbench.language.describe import describe
from scanbench.language.reading import Reading
from scanbench.language.standard import PARAMETER, text_of
from scanbench.program.types import Record, Section
from scanbench.syntax import tree

BoxKind = Literal["function", "block", "instance"]
INPUTS, OUTPUTS = ("VAR_INPUT", "VAR_IN_OUT"), ("VAR_OUTPUT",)


@dataclass(frozen=True, slots=True)
class Box:
    name: str
    kind: BoxKind
    type: str
    """Of an instance the name of its block, else empty."""
    inputs: tuple[str, ...]
    """Names of pins, in order; in-outs are among them."""
    outputs: tuple[str, ...]
    """Without the result of a function."""
    types: tuple[str, ...]
    """Those of the inputs, then of the outputs; empty where a pin takes several, or has one without a name. So are all of a standard function."""
    by_position: bool
    """Whether arguments are written without their names: a standard function."""
    more: bool
    """Whether it takes more inputs than are named."""
    comment: str
    """What it does, without its pins: one sentence a line. Empty where nobody wrote it."""


def boxes(reading: Reading, file: str, position: int) -> list[Box]:
    """The instances that are visible at a position first, then what the project declares, then the standard library. Empty outside of POUs."""
    around = reading.around(file, position)
    if around is None:
        return []
    body = reading.body(around)
    found = [] if body is None else list(_instances(body))
    return [*found, *_declared(reading), *_library(reading), *_standard()]


def _instances(body: Body) -> Iterator[Box]:
    scope = body.scope
    for owner in (scope.frame, scope.instance, scope.globals):
        for member in () if owner is None else owner.members.values():
            type = member.type
            if member.hidden or not isinstance(type, Record):
                continue
            pins = [each for each in type.members.values() if not each.hidden and not each.name.startswith("__")]
            inputs = [each for each in pins if each.section in (Section.INPUT, Section.IN_OUT)]
            outputs = [each for each in pins if each.section is Section.OUTPUT]
            if inputs or outputs:
                types = tuple(str(each.type) for each in (*inputs, *outputs))
                ins, outs = (tuple(each.name for each in some) for some in (inputs, outputs))
                yield Box(member.name, "instance", type.name, ins, outs, types, False, False, "")


def _declared(reading: Reading) -> Iterator[Box]:
    for pou in reading.project.checker.names.user:
        if pou.kind in ("function", "function_block"):
            yield _of(reading, pou, qualified(pou.namespace, pou.name))


def _library(reading: Reading) -> Iterator[Box]:
    for file in library_of(reading.project.checker.declarations.dialect):
        for pou in file.pous:
            if pou.kind in ("function", "function_block") and not pou.name.startswith("__"):
                yield _of(reading, pou, pou.name)


def _of(reading: Reading, pou: tree.PouDeclaration, name: str) -> Box:
    def pins(keywords: tuple[str, ...]) -> tuple[tree.Variable, ...]:
        return tuple(
            each
            for section in pou.sections
            if section.keyword in keywords
            for each in section.variables
            if not each.name.startswith("__")
        )

    told = describe(reading, Symbol("pou", "", name.upper()))
    comment = "" if told is None else _about(told.comment)
    kind: BoxKind = "function" if pou.kind == "function" else "block"
    inputs, outputs = pins(INPUTS), pins(OUTPUTS)
    types = tuple(
        each.type.name.upper() if isinstance(each.type, tree.NamedType) else "" for each in (*inputs, *outputs)
    )
    return Box(
        name,
        kind,
        "",
        tuple(each.name for each in inputs),
        tuple(each.name for each in outputs),
        types,
        False,
        False,
        comment,
    )


def _standard() -> Iterator[Box]:
    for name, row in FUNCTIONS.items():
        yield Box(name, "function", "", row.formals, (), (), True, row.variadic, _about(text_of(name)))


def _about(text: str) -> str:
    return "\n".join(line for line in text.splitlines() if not PARAMETER.match(line))
