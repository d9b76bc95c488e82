"""References: what they reach, what they may not, and parts of variables."""

import pytest

from scanbench.engines.engine import Reason, Stop
from scanbench.program.layout import Layout
from scanbench.program.program import Assign, Base, Binary, CallBlock, Const, Expr, Index, Load, Place, RefOf
from scanbench.program.sites import TrapKind
from scanbench.program.types import BOOL, BYTE, DINT, INT, LINT, ULINT, WORD, ArrayType
from tests.engines.native.hand_made import SPAN, HandMade, const, hand_made, reference_to, through, trap

NULL = Stop(Reason.TRAP, trap(TrapKind.NULL))


def made() -> HandMade:
    return hand_made("r : ULINT; a, b : DINT; w : WORD; f, g : BOOL; l : ARRAY[0..3] OF INT; n : INT; s : STRING[5];")


def refer(hand: HandMade, to: Place) -> Assign:
    return Assign(hand.at("r"), RefOf(to, reference_to(to.type)), SPAN)


def test_a_reference_reads_and_writes_what_it_refers_to() -> None:
    hand = made()
    there = through(DINT, hand.get("r"))
    one = const(DINT, 41)
    add = Binary("add", DINT, Load(there), const(DINT, 1))
    assert hand.run(
        refer(hand, hand.at("a")), Assign(hand.at("a"), one, SPAN), Assign(there, add, SPAN),
        Assign(hand.at("b"), hand.get("a"), SPAN),
    ).reason is Reason.DONE  # fmt: skip
    assert (hand.number("a"), hand.number("b")) == (42, 42)
    assert hand.number("r") == hand.offset("a")


@pytest.mark.parametrize("opt_level", [0, 2])
def test_a_write_through_a_reference_is_seen_between_two_reads(opt_level: int) -> None:
    hand = made()
    there = through(DINT, hand.get("r"))
    total = Binary("add", DINT, Binary("mul", DINT, hand.get("a"), const(DINT, 100)), hand.get("b"))
    hand.run(
        refer(hand, hand.at("a")), Assign(hand.at("a"), const(DINT, 3), SPAN), Assign(hand.at("b"), hand.get("a"), SPAN),
        Assign(there, const(DINT, 7), SPAN), Assign(hand.at("b"), total, SPAN), opt_level=opt_level,
    )  # fmt: skip
    assert hand.number("b") == 703


@pytest.mark.parametrize(
    ("value", "traps"),
    [
        (0, True), (1, True), (Layout.HEADER_SIZE - 1, True), (Layout.HEADER_SIZE, False), (-4, False), (-3, True),
        (-1, True), (1 << 35 | Layout.HEADER_SIZE, True), (1 << 63 | Layout.HEADER_SIZE, True),
        ((1 << 64) - 1, True), (5 << 32 | Layout.HEADER_SIZE, False),
    ],
)  # fmt: skip
def test_a_reference_must_lie_in_the_image(value: int, traps: bool) -> None:
    hand = made()
    value = hand.program.layout.state_size + value if value < 0 else value
    body = [
        Assign(hand.at("r"), Const(ULINT, value), SPAN),
        Assign(hand.at("b"), Load(through(DINT, hand.get("r"))), SPAN),
    ]
    stop = hand.run(*body)
    assert stop == (NULL if traps else Stop(Reason.DONE))


def test_the_whole_of_a_value_must_lie_in_the_image() -> None:
    hand = made()
    array = ArrayType(((0, 3),), INT)
    for short, traps in ((8, False), (7, True)):
        at = const(ULINT, hand.program.layout.state_size - short)
        element = Place(INT, Base.IMAGE, 0, (Index(hand.get("n"), 0, 3, 2, trap(TrapKind.BOUNDS)),),
                        reference=at, null_trap=trap(TrapKind.NULL))  # fmt: skip
        assert hand.run(Assign(hand.at("n"), Load(element), SPAN)) == (NULL if traps else Stop(Reason.DONE))
        assert hand.run(Assign(hand.at("l"), Load(through(array, at)), SPAN)) == (NULL if traps else Stop(Reason.DONE))


def test_null_is_found_before_the_index() -> None:
    hand = made()
    bad = Index(const(INT, 9), 0, 3, 2, trap(TrapKind.BOUNDS))
    place = Place(INT, Base.IMAGE, 0, (bad,), reference=hand.get("r"), null_trap=trap(TrapKind.NULL))
    assert hand.run(Assign(place, const(INT, 1), SPAN)) == NULL


def test_computed_bounds_are_checked_and_what_they_lead_to() -> None:
    hand = made()

    def element(low: int, high: int, stride: int) -> Place:
        bounds: list[Expr] = [const(LINT, each) for each in (low, high, stride)]
        index = Index(hand.get("n"), bounds[0], bounds[1], bounds[2], trap(TrapKind.BOUNDS))
        return Place(INT, Base.IMAGE, 0, (index,), reference=hand.get("r"), null_trap=trap(TrapKind.NULL))

    start = refer(hand, hand.at("l"))
    set_n = Assign(hand.at("n"), const(INT, 2), SPAN)
    assert hand.run(start, set_n, Assign(element(1, 4, 2), const(INT, 77), SPAN)).reason is Reason.DONE
    assert hand.memory[hand.offset("l") + 2] == 77
    assert hand.run(start, set_n, Assign(element(3, 9, 2), const(INT, 77), SPAN)).trap == trap(TrapKind.BOUNDS)
    assert hand.run(start, set_n, Assign(element(-1, 9, 1 << 40), const(INT, 77), SPAN)) == NULL
    assert hand.run(start, set_n, Assign(element(0, 9, -(1 << 62)), const(INT, 77), SPAN)) == NULL


def test_references_to_references_and_to_bits() -> None:
    hand = hand_made("r, q : ULINT; w : WORD; f, g : BOOL;")
    bit = hand.at("w", BOOL, add=1, bit=3)
    inner = RefOf(bit, reference_to(BOOL))
    outer = through(BOOL, Load(through(ULINT, hand.get("q"))))
    hand.run(
        Assign(hand.at("r"), inner, SPAN), Assign(hand.at("q"), RefOf(hand.at("r"), reference_to(ULINT)), SPAN),
        Assign(outer, const(BOOL, 1), SPAN), Assign(hand.at("f"), Load(outer), SPAN), Assign(hand.at("g"), Load(bit), SPAN),
    )  # fmt: skip
    assert hand.number("w") == 1 << 11
    assert (hand.number("f"), hand.number("g")) == (1, 1)
    assert hand.number("r") == (hand.offset("w") + 1) | 3 << 32


def test_a_bit_of_an_integer_through_a_reference() -> None:
    hand = made()
    bit = Place(BOOL, Base.IMAGE, 1, bit=7, reference=hand.get("r"), null_trap=trap(TrapKind.NULL))
    hand.run(refer(hand, hand.at("w")), Assign(bit, const(BOOL, 1), SPAN), Assign(hand.at("f"), Load(bit), SPAN))
    assert hand.number("w") & 0xFFFF == 0x8000
    assert hand.number("f") == 1


def test_parts_of_a_variable_are_the_variable() -> None:
    hand = made()
    high, low = hand.at("w", BYTE, add=1), hand.at("w", BYTE)
    hand.run(
        Assign(hand.at("w"), const(WORD, 0x1234), SPAN), Assign(high, Load(low), SPAN),
        Assign(hand.at("w", BOOL, bit=0), const(BOOL, 1), SPAN), Assign(hand.at("a", WORD), hand.get("w"), SPAN),
    )  # fmt: skip
    assert hand.number("a") == 0x3435


def test_a_boolean_is_bit_0_of_its_byte() -> None:
    hand = made()
    hand.run(Assign(hand.at("f", BYTE), const(BYTE, 0x42), SPAN), Assign(hand.at("g"), hand.get("f"), SPAN))
    assert hand.number("g") == 0


def test_a_string_whose_length_was_overwritten_has_its_capacity() -> None:
    hand = hand_made("s, t : STRING[5];")
    hand.run(
        Assign(hand.at("s"), const(hand.at("s").type, b"abcde"), SPAN), Assign(hand.at("s", WORD), const(WORD, 60000), SPAN),
        Assign(hand.at("t"), hand.get("s"), SPAN),
    )  # fmt: skip
    start = hand.offset("t")
    assert hand.memory[start : start + 7] == b"\x05\x00abcde"


def test_an_instance_runs_through_a_reference_and_must_be_in_the_image() -> None:
    counter = "FUNCTION_BLOCK Counter VAR n : INT; END_VAR n := n + 1; END_FUNCTION_BLOCK"
    hand = hand_made("r : ULINT; c : Counter;", counter, "c();")
    callee = next(pou for pou in hand.program.pous if pou.name == "Counter")
    there = through(hand.at("c").type, hand.get("r"))
    call = CallBlock(there, callee, (), (), (), SPAN)
    assert hand.run(refer(hand, hand.at("c")), call, call).reason is Reason.DONE
    assert hand.memory[hand.offset("c")] == 2
    assert hand.run(Assign(hand.at("r"), const(ULINT, hand.program.layout.state_size - 1), SPAN), call) == NULL
