"""Inputs with R_EDGE and F_EDGE: a body begins by finding out whether the edge is there, and reads that."""

from scanbench.check.body import fold
from scanbench.check.declare.scopes import place_of
from scanbench.program.program import Assign, Base, Expr, Load, Stmt
from scanbench.program.types import BOOL, Record


def edges(record: Record) -> tuple[Stmt, ...]:
    """What a block's body begins with; see `specs.place_edge` for the hidden variables."""
    made: list[Stmt] = []
    if not any(key.endswith("_EDGE") and "$" in key for key in record.members):
        return ()
    for member in record.members.values():
        for edge in ("R", "F"):
            found = record.members.get(f"{member.name}${edge}_EDGE".upper())
            if found is None:
                continue
            previous = place_of(record.members[f"{member.name}$PREVIOUS".upper()], Base.SELF, record, 0)
            now: Expr = Load(place_of(member, Base.SELF, record, 0))
            before: Expr = Load(previous)
            if edge == "R":
                value = fold.binary("and", BOOL, now, fold.unary("not", BOOL, before))
            else:
                value = fold.binary("and", BOOL, before, fold.unary("not", BOOL, now))
            made.append(Assign(place_of(found, Base.SELF, record, 0), value, member.span))
            made.append(Assign(previous, now, member.span))
    return tuple(made)
