"""Subrange checks: what goes on with which value, and what the list says of it."""

import pytest

from scanbench.program.layout import Layout
from scanbench.program.program import Assign, Binary, Const, Expr, For, Limit, Place, Sequence, Stmt, Violates
from scanbench.program.types import BOOL, BYTE, DINT, INT, LINT, SINT, UDINT, ULINT, Elementary
from tests.engines.native.hand_made import SPAN, HandMade, const, hand_made

VARIABLES = "i, j : INT; d : DINT; u : ULINT; l : LINT; s : SINT; b : BYTE; f : BOOL; e : BOOL; c : UDINT;"
ENTRY = 8


def set_to(hand: HandMade, name: str, value: Expr) -> Assign:
    return Assign(hand.at(name), value, SPAN)


@pytest.mark.parametrize("opt_level", [0, 2])
@pytest.mark.parametrize(
    ("name", "type", "low", "high", "value"),
    [
        ("i", INT, -6, 12, 13), ("i", INT, -6, 12, -7), ("i", INT, -6, 12, -6), ("i", INT, -32768, 32767, 5),
        ("i", INT, -32768, 0, 1), ("i", INT, 3, 32767, -32768), ("u", ULINT, 1 << 63, (1 << 64) - 2, (1 << 64) - 1),
        ("u", ULINT, 1 << 63, (1 << 64) - 2, 7), ("u", ULINT, 0, 1 << 63, 1 << 63), ("l", LINT, -(1 << 63), -1, 0),
        ("l", LINT, -(1 << 63), (1 << 63) - 2, (1 << 63) - 1), ("s", SINT, -1, 1, -128), ("b", BYTE, 16, 250, 251),
        ("d", DINT, 5, 5, 6), ("c", UDINT, 1, 4294967294, 0),
    ],
)  # fmt: skip
def test_a_value_is_brought_within_its_bounds(
    name: str, type: Elementary, low: int, high: int, value: int, opt_level: int
) -> None:
    hand = hand_made(VARIABLES)
    start = hand.offset(name)
    hand.memory[start : start + type.size] = (value & (1 << type.bits) - 1).to_bytes(type.size, "little")
    hand.run(set_to(hand, name, Limit(type, hand.get(name), low, high, 3)), opt_level=opt_level)
    brought = int.from_bytes(hand.memory[start : start + type.size], "little", signed=type.signed)
    assert brought == min(max(value, low), high)
    outside = int(brought != value)
    assert (hand.list_field(0), hand.list_field(ENTRY)) == (outside, 3 * outside)
    assert hand.memory[Layout.SUBRANGE_ERROR] == outside
    assert hand.memory[Layout.SUBRANGE_COUNT] == outside
    if outside:
        kept = hand.list_field(ENTRY + 16, 8)
        assert kept & (1 << 64) - 1 == value & (1 << 64) - 1


def test_the_list_counts_by_site_and_instance() -> None:
    hand = hand_made(VARIABLES)
    both = Binary(
        "add",
        INT,
        Limit(INT, hand.get("i"), 0, 10, 1),
        Limit(INT, Binary("add", INT, hand.get("i"), const(INT, 1)), 0, 10, 2),
    )
    hand.run(set_to(hand, "i", const(INT, 11)), set_to(hand, "j", both), scans=5)
    assert hand.number("j") == 20
    instance = hand.program.tasks[0].programs[0].offset
    for at, site, value in ((ENTRY, 1, 11), (ENTRY + 48, 2, 12)):
        fields = [hand.list_field(at), hand.list_field(at + 4)]
        fields += [hand.list_field(at + number, 8) for number in (8, 16, 24, 32, 40)]
        assert fields == [site, 5, instance, value, 0, 4, 0]
    assert hand.list_field(0) == 2
    assert int.from_bytes(hand.memory[Layout.SUBRANGE_COUNT : Layout.SUBRANGE_COUNT + 4], "little") == 10


def test_a_full_list_counts_what_it_drops_and_counters_saturate() -> None:
    hand = hand_made(VARIABLES)
    body: list[Stmt] = [set_to(hand, "i", const(INT, 11))]
    body += [set_to(hand, "j", Limit(INT, hand.get("i"), 0, 10, site)) for site in range(1, Layout.VIOLATION_LIMIT + 8)]
    hand.run(*body)
    assert (hand.list_field(0), hand.list_field(4)) == (Layout.VIOLATION_LIMIT, 7)
    start = hand.program.layout.violations
    for at in (start + 4, start + ENTRY + 4, Layout.SUBRANGE_COUNT):
        hand.memory[at : at + 4] = b"\xfe\xff\xff\xff"
    hand.run(*body, scans=2)
    for at in (start + 4, start + ENTRY + 4, Layout.SUBRANGE_COUNT):
        assert hand.memory[at : at + 4] == b"\xff\xff\xff\xff"


def test_violates_tells_and_records_only_with_a_site() -> None:
    hand = hand_made(VARIABLES)
    body = (
        set_to(hand, "i", const(INT, -1)),
        set_to(hand, "f", Violates(INT, hand.get("i"), 0, 10, 0)),
        set_to(hand, "e", Violates(INT, hand.get("i"), -1, 10, 0)),
    )
    hand.run(*body)
    assert (hand.number("f"), hand.number("e"), hand.list_field(0)) == (1, 0, 0)
    hand.run(*body, set_to(hand, "f", Violates(INT, hand.get("i"), 0, 10, 9)))
    assert (hand.number("f"), hand.list_field(0), hand.list_field(ENTRY)) == (1, 1, 9)


@pytest.mark.parametrize("opt_level", [0, 2])
def test_the_program_sees_the_error_in_the_same_scan(opt_level: int) -> None:
    from scanbench.program.program import Base, Load

    hand = hand_made(VARIABLES)
    error = Place(BOOL, Base.IMAGE, Layout.SUBRANGE_ERROR, variable="#system")
    count = Place(UDINT, Base.IMAGE, Layout.SUBRANGE_COUNT, variable="#system")
    hand.run(
        Assign(error, const(BOOL, 0), SPAN), Assign(count, const(UDINT, 4), SPAN), set_to(hand, "i", const(INT, 11)),
        set_to(hand, "j", Limit(INT, hand.get("i"), 0, 10, 1)), set_to(hand, "f", Load(error)), set_to(hand, "c", Load(count)),
        opt_level=opt_level,
    )  # fmt: skip
    assert (hand.number("f"), hand.number("c")) == (1, 5)


def test_the_variable_of_a_loop_ends_within_its_bounds() -> None:
    hand = hand_made(VARIABLES)
    total = set_to(hand, "j", Binary("add", INT, hand.get("j"), hand.get("i")))
    loop = For(hand.at("i"), const(INT, 1), const(INT, 10), const(INT, 1), (total,), False, 1, SPAN, (0, 10))
    hand.run(loop)
    assert (hand.number("i"), hand.number("j"), hand.list_field(0)) == (10, 55, 0)


def test_a_sequence_runs_before_its_value_and_leaves_what_was_read() -> None:
    hand = hand_made("s, t : STRING[20]; i, j : INT;")
    from scanbench.program.program import Intrinsic
    from scanbench.program.types import StringType

    text = StringType(20)
    inner = Sequence(
        (
            Assign(hand.at("s"), Const(text, b"new"), SPAN),
            Assign(hand.at("t"), Intrinsic("CONCAT", text, (hand.get("s"), Const(text, b"+"))), SPAN),
        ),
        hand.get("t"),
    )
    both = Intrinsic("CONCAT", text, (Intrinsic("CONCAT", text, (hand.get("s"), Const(text, b"|"))), inner))
    one = Sequence((set_to(hand, "i", const(INT, 5)),), hand.get("i"))
    hand.run(
        Assign(hand.at("s"), Const(text, b"old"), SPAN), Assign(hand.at("s"), both, SPAN),
        set_to(hand, "j", Binary("sub", INT, Binary("mul", INT, hand.get("i"), const(INT, 10)), one)),
    )  # fmt: skip
    start = hand.offset("s")
    assert hand.memory[start : start + 10] == b"\x08\x00old|new+"
    assert (hand.number("i"), hand.number("j")) == (5, -5)
