"""The numbers that a program raises user errors with: constants in its calls of FAL, FALS and their like.

A number that is computed is not found: only a run shows it.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from scanbench.faults.reaction.places import parts
from scanbench.plcmodel.model import Instruction, Model
from scanbench.problems import Span
from scanbench.program.bodies import every
from scanbench.program.origin import in_library, is_system
from scanbench.program.program import CallFunction, Const, Convert, Expr, Place, Program, Stmt
from scanbench.public import Public


@dataclass(frozen=True, slots=True)
class RaisedNumber(Public):
    """A number that the program raises an error with, and the first call that does."""

    PUBLIC: ClassVar = "RaisedNumber"

    kind: str
    """What it is in a hardware configuration: `fal`, `fals`."""
    number: int
    text: str
    """The text that the program gives the error; empty where it gives none, or computes it."""
    file: str
    line: int


def raised_numbers(program: Program) -> tuple[RaisedNumber, ...]:
    """Each number once, by kind and number."""
    model = program.layout.model
    found: dict[tuple[str, int], RaisedNumber] = {}
    for file, line, call in sorted(_calls(program), key=lambda each: each[:2]):
        number = _number(call, model)
        if number is None:
            continue
        kind, value, text = number
        known = found.get((kind, value))
        if known is None or (text and not known.text):
            place = (file, line) if known is None else (known.file, known.line)
            found[kind, value] = RaisedNumber(kind, value, text, *place)
    return tuple(found[key] for key in sorted(found))


def _calls(program: Program) -> Iterator[tuple[str, int, CallFunction]]:
    """The calls of functions that are made from the model, in what people wrote."""
    for pou in program.pous:
        if in_library(pou.span):
            continue
        at: dict[int, tuple[str, int, CallFunction]] = {}
        for statement in every(pou.body):
            span = _span(statement) or pou.span
            for node in parts(statement):
                if isinstance(node, CallFunction) and is_system(node.pou.span):
                    plain = span.plain()
                    at[id(node)] = plain.file, plain.line, node  # a statement inside comes later, and says it better
        yield from at.values()


def _span(statement: Stmt) -> Span | None:
    found = getattr(statement, "span", None)
    return found if isinstance(found, Span) else None


def _number(call: CallFunction, model: Model) -> tuple[str, int, str] | None:
    """Kind, number and text of a call that raises an error; None of any other call, and of a number that is computed."""
    for made in model.instructions:
        if made.name.upper() != call.pou.name.upper():
            continue
        number = _constant(call, made.parameter)
        kind = _kind(model, made)
        if kind and isinstance(number, int) and made.minimum <= number <= made.maximum:
            text = _constant(call, made.text) if made.text else None
            return kind, number, text.decode("latin-1").rstrip("\0") if isinstance(text, bytes) else ""
    return None


def _kind(model: Model, made: Instruction) -> str:
    entry = model.error(made.error)
    detail = None if entry is None else entry.detail(made.detail)
    return "" if detail is None else detail.hardware


def _constant(call: CallFunction, parameter: str) -> int | float | bytes | None:
    given = dict(zip(call.pou.parameters, call.args, strict=False)).get(parameter.upper())
    return None if given is None or isinstance(given, Place) else _value(given)


def _value(given: Expr) -> int | float | bytes | None:
    while isinstance(given, Convert):
        given = given.operand
    return given.value if isinstance(given, Const) else None
