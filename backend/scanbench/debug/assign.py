"""Assignments from outside in the scope of a frame: what an execution point does, and an expression that assigns."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeVar

from scanbench.check.typed.condition import BadCondition
from scanbench.check.typed.local import LocalAssignments, locals_of
from scanbench.engines.interpreter.evaluate import Evaluator, NoValue
from scanbench.program.copies import Spot
from scanbench.program.program import Pou, Program
from scanbench.program.types import Type
from scanbench.runtime.command import Command, Patch, Plan, Refusal, View
from scanbench.runtime.forces import forced_table
from scanbench.runtime.rights import Right, may
from scanbench.runtime.target import everywhere
from scanbench.symbols.names import names_of
from scanbench.symbols.values import format_value

Local = TypeVar("Local")
"""What was compiled."""
_NAMES = 10_000
"""Places whose names are kept, as they take long to find."""


@dataclass(frozen=True, slots=True)
class Assign(Command):
    """`text` as typed, `a := a + 1; b := TRUE;`, in the scope of a POU: values are those of the moment."""

    pou: str
    """Empty: of the whole program."""
    instance: int
    """Byte offset of its instance."""
    text: str

    def plan(self, view: View) -> Plan | Refusal:
        """A patch for each assignment, in their order."""
        program = view.statements
        local = in_scope(program, self.pou, lambda pou: locals_of(program).assignments(pou, self.text))
        if isinstance(local, Refusal):
            return local
        return Assigning(Evaluator(program, bytearray(view.memory)), local).plan(view, self.instance)


class Assigning:
    """Assignments in one scope, made ready to be planned many times on one image."""

    def __init__(self, evaluator: Evaluator, local: LocalAssignments) -> None:
        self._program, self._text = evaluator.program, local.text
        self._run = evaluator.assigning(local)
        self._names: dict[Spot, str] = {}

    def plan(self, view: View, instance: int) -> Plan | Refusal:
        """See `Assign.plan`; the view is of the evaluator's image as it is now."""
        try:
            stored = self._run(instance)
        except NoValue as error:
            return Refusal(str(error))
        actual = self._program.layout.copies.actual
        stored = [(each, actual(view.memory, *spot) or spot, data) for each, spot, data in stored]
        for each, spot, _ in stored:
            refusal = refused(view, spot, each.target.type, each.shown)
            if refusal is not None:
                return refusal
        patches = tuple(each for _, spot, data in stored for each in everywhere(view, patch(spot, data)))
        said = "; ".join(self._said(spot, each.target.type, data) for each, spot, data in stored)
        return Plan(patches, said or f"{self._text}: nothing to do")

    def _said(self, spot: Spot, type: Type, data: bytes) -> str:
        if spot not in self._names:
            if len(self._names) >= _NAMES:
                self._names.clear()
            self._names[spot] = names_of(self._program).text(*spot, type)
        value = format_value(type, data) or f"({type.name})"
        return f"{self._names[spot]} := {value}"


def in_scope(program: Program, name: str, compiled: Callable[[Pou | None], Local | BadCondition]) -> Local | Refusal:
    """What was compiled in the scope of the POU of this name; of an empty name, in that of the whole program."""
    found = next((each for each in program.pous if each.name.upper() == name.upper()), None)
    if name and found is None:
        return Refusal(f"the program has no POU {name} any more")
    local = compiled(found)
    return Refusal(local.message, local.near) if isinstance(local, BadCondition) else local


def patch(spot: Spot, data: bytes) -> Patch:
    """What stores a value there."""
    offset, bit = spot
    return Patch.whole(offset, data) if bit is None else Patch.of_bit(offset, bit, data[0] != 0)


def refused(view: View, spot: Spot, type: Type, shown: str) -> Refusal | None:
    """Why a tool may not write there."""
    offset, bit = spot
    found = view.program.layout.area_at(offset)
    size = 1 if bit is not None else type.size
    if found is not None and found[0].protected(found[1], size, "tool") is not None:
        where = names_of(view.program).text(offset, bit, type)
        return Refusal(f"{shown}: {where} is read-only for tools on {view.model.name}, as on the device")
    table = forced_table(view)
    one = 1 << bit if bit is not None else 0xFF
    if any(table.get(at, (0, 0))[0] & one for at in range(offset, offset + size)):
        return Refusal(f"{shown} is forced, so a write would be lost: release the force first")
    return may(view.header.mode, Right.WRITE, shown)
