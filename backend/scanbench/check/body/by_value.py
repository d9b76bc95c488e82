"""In-outs by value: a block copies what was passed into a variable of its own, runs, and copies that back.

The call stores a reference to what is passed in a hidden in-out next to the variable (`types.actual_name`). So the address is
computed once, before the call, and the variable that was bound in the last execution stays known. The body of the block makes
the copies, so they are compiled once for all calls, also for those through a base or an interface.
"""

from collections.abc import Callable
from dataclasses import replace

from scanbench.check.declare.scopes import place_of
from scanbench.program.program import (
    Assign,
    Base,
    Blocks,
    Case,
    Const,
    For,
    If,
    Load,
    Place,
    Repeat,
    Return,
    Stmt,
    Try,
    While,
)
from scanbench.program.types import BOOL, Member, Record, actual_of

NullTrap = Callable[[Member], int]
"""The trap site of an in-out that is not connected."""


def around(record: Record, body: tuple[Stmt, ...], null_trap: NullTrap) -> tuple[Stmt, ...]:
    """The body of a block with the copies around it; the body itself where no in-out is by value."""
    copied = [each for each in record.members.values() if each.copied]
    if not copied:
        return body
    outside = {each.name: place_of(actual_of(record, each), Base.SELF, record, null_trap(each)) for each in copied}
    inside = {each.name: place_of(each, Base.SELF, record, 0) for each in copied}
    into = [Assign(inside[each.name], Load(outside[each.name]), each.span) for each in copied]
    back = tuple(copy_back(inside[each.name], outside[each.name], each) for each in copied if not each.constant)
    return (*into, *_before_returns(body, back), *back)


def copy_back(inside: Place, outside: Place, member: Member) -> Stmt:
    """What the block has goes to what was passed."""
    return Assign(outside, Load(inside), member.span)


def _before_returns(body: tuple[Stmt, ...], back: tuple[Stmt, ...]) -> tuple[Stmt, ...]:
    return tuple(_before_return(each, back) for each in body) if back else body


def _before_return(stmt: Stmt, back: tuple[Stmt, ...]) -> Stmt:
    match stmt:
        case Return(span):
            return If(((Const(BOOL, 1), (*back, stmt)),), (), span)
        case If():
            made = tuple((condition, _before_returns(body, back)) for condition, body in stmt.branches)
            return replace(stmt, branches=made, orelse=_before_returns(stmt.orelse, back))
        case Case():
            labelled = tuple((labels, _before_returns(body, back)) for labels, body in stmt.branches)
            return replace(stmt, branches=labelled, orelse=_before_returns(stmt.orelse, back))
        case For() | While() | Repeat():
            return replace(stmt, body=_before_returns(stmt.body, back))
        case Blocks():
            return replace(stmt, blocks=tuple(_before_returns(block, back) for block in stmt.blocks))
        case Try():
            body, handler = _before_returns(stmt.body, back), _before_returns(stmt.handler, back)
            # what `final` changes after a RETURN is copied as well
            final = (*stmt.final, *back) if stmt.final and (body, handler) != (stmt.body, stmt.handler) else stmt.final
            return replace(stmt, body=body, handler=handler, final=final)
        case _:
            return stmt
