"""IL's blocks and jumps, and CONTINUE."""

import pytest

from scanbench.engines.engine import Reason
from scanbench.program.layout import Layout
from scanbench.program.program import (
    Assign,
    Binary,
    Blocks,
    Compare,
    Continue,
    Exit,
    Expr,
    For,
    If,
    Jump,
    Repeat,
    Return,
    Stmt,
    While,
)
from scanbench.program.sites import TrapKind
from scanbench.program.types import BOOL, INT
from tests.engines.native.hand_made import SPAN, HandMade, const, hand_made, trap

LOOP = trap(TrapKind.LOOP)


def add(hand: HandMade, name: str, value: Expr | int) -> Assign:
    amount = const(INT, value) if isinstance(value, int) else value
    return Assign(hand.at(name), Binary("add", INT, hand.get(name), amount), SPAN)


def when(hand: HandMade, name: str, op: str, value: int, *body: Stmt) -> If:
    return If(((Compare(op, BOOL, hand.get(name), const(INT, value)), body),), (), SPAN)


@pytest.mark.parametrize("opt_level", [0, 2])
def test_blocks_run_one_after_the_other_and_jumps_go_elsewhere(opt_level: int) -> None:
    hand = hand_made("i, j, k : INT;")
    blocks = Blocks(
        (
            (add(hand, "i", 1), Jump(2, False, LOOP, SPAN)),
            (add(hand, "j", 100),),
            (add(hand, "j", 1), when(hand, "j", "lt", 5, Jump(2, True, LOOP, SPAN)), when(hand, "i", "gt", 2, Jump(4, False, LOOP, SPAN))),
            (add(hand, "k", 1), when(hand, "k", "gt", 1, Return(SPAN)), Jump(0, True, LOOP, SPAN)),
            (),
        ),
        SPAN,
    )  # fmt: skip
    assert hand.run(blocks, add(hand, "k", 10), opt_level=opt_level).reason is Reason.DONE
    assert (hand.number("i"), hand.number("j"), hand.number("k")) == (2, 6, 2)


def test_a_jump_back_takes_from_the_budget() -> None:
    hand = hand_made("i : INT;")
    limit = Layout.BUDGET_LIMIT
    hand.memory[limit : limit + 8] = (100).to_bytes(8, "little")
    stop = hand.run(Blocks(((add(hand, "i", 1), Jump(0, True, LOOP, SPAN)),), SPAN))
    assert (stop.reason, stop.trap, hand.number("i")) == (Reason.TRAP, LOOP, 101)


@pytest.mark.parametrize("opt_level", [0, 2])
@pytest.mark.parametrize("exits", [False, True])
def test_continue_goes_on_with_the_next_round_of_for(opt_level: int, exits: bool) -> None:
    hand = hand_made("i, j, n : INT;")
    skip = when(hand, "i", "eq", 3, Continue(SPAN))
    body: tuple[Stmt, ...] = (skip, add(hand, "j", hand.get("i")))
    if exits:
        body = (*body, when(hand, "i", "eq", 7, Exit(SPAN)))
    counted = For(hand.at("i"), const(INT, 1), const(INT, 5), const(INT, 1), body, exits, LOOP, SPAN)
    general = For(hand.at("i"), const(INT, 9), const(INT, 1), hand.get("n"), body, exits, LOOP, SPAN)
    hand.run(counted, Assign(hand.at("n"), const(INT, -2), SPAN), general, opt_level=opt_level)
    assert hand.number("j") == 12 + (9 + 7 if exits else 9 + 7 + 5 + 1)
    assert hand.number("i") == (7 if exits else -1)


@pytest.mark.parametrize("opt_level", [0, 2])
def test_continue_in_while_and_repeat(opt_level: int) -> None:
    hand = hand_made("i, j, k : INT;")
    skip = when(hand, "i", "ge", 4, Continue(SPAN))
    loop = While(
        Compare("lt", BOOL, hand.get("i"), const(INT, 10)), (add(hand, "i", 1), skip, add(hand, "j", 1)), LOOP, SPAN
    )
    again = when(hand, "k", "lt", 3, Continue(SPAN))
    repeat = Repeat(
        (add(hand, "k", 1), again, add(hand, "j", 100)), Compare("ge", BOOL, hand.get("k"), const(INT, 5)), LOOP, SPAN
    )
    hand.run(loop, repeat, opt_level=opt_level)
    assert (hand.number("i"), hand.number("j"), hand.number("k")) == (10, 303, 5)
