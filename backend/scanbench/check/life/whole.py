"""The program that runs before all others in each scan, and initialises what is new: at a start all of it.

Its variables are in the image. `version` is the number of the program that was initialised: 0 after a start. `kept` is
retained, so a warm start finds it.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from scanbench.check.declare.scopes import Pous, place_of
from scanbench.check.life.code import Code
from scanbench.check.life.make import GLOBALS, NOWHERE
from scanbench.check.life.numbers import joined
from scanbench.program.program import (
    Assign,
    Base,
    CallFunction,
    Compare,
    Const,
    Evaluate,
    Expr,
    If,
    Load,
    Place,
    Pou,
    Stmt,
    Unary,
)
from scanbench.program.tasks import ProgramInstance
from scanbench.program.types import BOOL, ULINT, Kind, Member, Record, Section

NAME = "$Life"


@dataclass(slots=True)
class Whole:
    """Of one program."""

    pou: Pou
    code: Code
    globals: Record

    def write(self, instances: Sequence[ProgramInstance]) -> None:
        """Its body, when all instances have their places: global variables come first, then the programs."""
        parts = [f"{each.name} {self.code.numbers.of(each.pou.instance)}" for each in instances]
        number = joined([str(self.code.numbers.of(self.globals)), *parts])
        version, kept = (self._place(name) for name in ("version", "kept"))
        first = Unary("not", BOOL, Load(kept))
        off: Expr = Const(BOOL, 0)
        on: Expr = Const(BOOL, 1)
        new = self._calls(self.code.starts, instances, first, off)
        changed = self._calls(self.code.changes, instances, off, on)
        begins = If(((Compare("eq", BOOL, Load(version), Const(ULINT, 0)), tuple(new)),), tuple(changed), NOWHERE)
        done = (Assign(version, Const(ULINT, number), NOWHERE), Assign(kept, on, NOWHERE))
        differs = Compare("ne", BOOL, Load(version), Const(ULINT, number))
        self.pou.body = (If(((differs, (begins, *done)),), (), NOWHERE),)

    def _place(self, name: str) -> Place:
        return place_of(self.pou.instance.members[name.upper()], Base.SELF, self.pou.instance, 0)

    def _calls(
        self, pous: dict[str, Pou], instances: Sequence[ProgramInstance], retains: Expr, copy: Expr
    ) -> list[Stmt]:
        made: list[Stmt] = []
        whole = pous.get(GLOBALS.upper())
        if whole is not None:
            made.append(Evaluate(CallFunction(whole, None, (retains, copy)), NOWHERE))
        for each in instances:
            callee = pous.get(each.pou.name.upper())
            if callee is not None and each.pou.kind == "program":
                this = Place(callee.frame.members["THIS"].type, Base.IMAGE, each.offset)
                made.append(Evaluate(CallFunction(callee, None, (this, retains, copy)), NOWHERE))
        return made


def whole_of(code: Code, pous: Pous, variables: Record) -> Whole | None:
    """None where nothing in the program needs it."""
    programs = [each.name.upper() for each in pous.blocks.values() if each.kind == "program"]
    called = [
        each
        for table in (code.starts, code.changes)
        for key, each in table.items()
        if key in (GLOBALS.upper(), *programs)
    ]
    if not called:
        return None
    record, frame = Record(NAME, Kind.BLOCK), Record(NAME, Kind.STRUCT)
    record.place(Member("version", ULINT, Section.VAR, NOWHERE, hidden=True, non_retain=True))
    record.place(Member("kept", BOOL, Section.VAR, NOWHERE, hidden=True, retain=True))
    record.close()
    pou = Pou(NAME, "program", record, frame, (), None, NOWHERE)
    for each in called:
        pous.use(pou, each)
    return Whole(pou, code, variables)
