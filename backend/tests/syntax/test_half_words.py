"""Drawn bodies that are half written: one mistake is not told many times, and each message says what was meant."""

import pytest

from scanbench.check.build import check_sources
from tests.caseformat import MODELS

HEAD = "PROGRAM Main\nVAR a, b, q : BOOL; n : INT; t : TON; END_VAR\n"
END = "END_PROGRAM\n"
STEPS = "INITIAL_STEP One:\nq(N);\nEND_STEP\nSTEP Two:\nq(N);\nEND_STEP\nSTEP Three:\nEND_STEP\nSTEP Four:\nEND_STEP\nSTEP Five:\nEND_STEP\n"
ACTION = "ACTION Act:\nn := n + 1;\nEND_ACTION\n"
TRANSITIONS = (
    "TRANSITION FROM One TO Two := a; END_TRANSITION\nTRANSITION FROM Two TO Three := a; END_TRANSITION\n"
    "TRANSITION FROM Three TO Four := a; END_TRANSITION\nTRANSITION FROM Four TO Five := a; END_TRANSITION\n"
    "TRANSITION FROM Five TO One := a; END_TRANSITION\n"
)
NETWORK = "NETWORK\n#x = AND(a, b);\nq := #x;\nt(IN := #x, PT := T#1s, Q => q);\nEND_NETWORK\n"
RUNGS = "RUNG\n[a] [/b] t(IN := ~, PT := T#1s).Q (q)\nEND_RUNG\nRUNG\n[a] < [b] | [/b] > (S q)\nEND_RUNG\n"


def said(body: str) -> list[str]:
    return [each.message for each in check_sources({"a.st": HEAD + body}, MODELS["GENERIC-IEC"]).problems]


@pytest.mark.parametrize(
    ("written", "meant", "rest"),
    [
        ("NETWO", "NETWORK", NETWORK.removeprefix("NETWORK")),
        ("NETWROK", "NETWORK", NETWORK.removeprefix("NETWORK")),
        ("RUN", "RUNG", RUNGS.removeprefix("RUNG")),
        ("INITIA", "INITIAL_STEP", (STEPS + ACTION + TRANSITIONS).removeprefix("INITIAL_STEP")),
        ("NETWO", "NETWORK", "\n"),
        ("INITIA", "INITIAL_STEP", "\n"),
        ("RUN", "RUNG", "\n"),
    ],
)
def test_a_half_first_word_is_told_once(written: str, meant: str, rest: str) -> None:
    assert said(written + rest + END) == [f"`{written}` begins no part of a body. Did you mean `{meant}`?"]


def test_a_half_transition_after_an_action_is_told_once() -> None:
    text = STEPS + ACTION + TRANSITIONS.replace("TRANSITION", "TRANSITIO", 1)
    assert said(text + END) == ["`TRANSITIO` begins no part of a body. Did you mean `TRANSITION`?"]


@pytest.mark.parametrize("body", ["run := TRUE;", "run\n:= TRUE;", "stepp(IN := a);", "networ\n(IN := a);"])
def test_names_like_these_words_are_names(body: str) -> None:
    text = f"PROGRAM Main\nVAR run, a : BOOL; stepp, networ : TON; END_VAR\n{body}\n{END}"
    assert check_sources({"a.st": text}, MODELS["GENERIC-IEC"]).problems == ()


def test_a_chart_without_a_transition_is_told_once() -> None:
    assert [each[:30] for each in said(STEPS + END)] == ["This chart has no transition, "]
    assert said(STEPS) == ["`END_PROGRAM` expected to close PROGRAM Main, but the file ends here."]


def test_steps_after_one_that_nothing_leads_to_are_not_told_as_well() -> None:
    text = STEPS + TRANSITIONS.replace("TRANSITION FROM One TO Two := a; END_TRANSITION\n", "")
    assert said(text + END) == ["Nothing leads to the step `Two`; it is never active."]


@pytest.mark.parametrize(
    ("cut", "first"),
    [
        ("ACTION Act:\nn := n + 1;\n", "`END_ACTION` expected to close ACTION Act, found `TRANSITION`."),
        ("ACTION Act:\n", "`END_ACTION` expected to close ACTION Act, found `TRANSITION`."),
        ("ACTION\n", "the name of the ACTION expected, found `TRANSITION`."),
    ],
)
def test_a_half_action_does_not_take_the_transitions(cut: str, first: str) -> None:
    assert said(STEPS + cut + TRANSITIONS + END) == [first]


@pytest.mark.parametrize("cut", ["[", "[a", "[P", "[a] (", "[a] (q", "[a] < [", "[a] t(", "[a] n := ADD(", "[a] n := "])
def test_a_rung_that_is_cut_is_told_once(cut: str) -> None:
    found = said(f"RUNG\n{cut}\nEND_RUNG\n{RUNGS}{END}")
    assert len(found) == 1
    assert "expected" in found[0]


@pytest.mark.parametrize("body", [STEPS + ACTION + TRANSITIONS, NETWORK + RUNGS])
def test_a_text_that_ends_anywhere_has_three_messages_at_most(body: str) -> None:
    many = [(body[:at][-20:], found) for at in range(0, len(body), 3) if len(found := said(body[:at])) > 3]
    assert many == []


def test_the_part_after_an_action_is_of_the_language_of_the_first() -> None:
    assert len(said("n := 1;\nACTION Act:\nn := 2;\nEND_ACTION\n" + STEPS + END)) > 0
    found = said(STEPS + TRANSITIONS + ACTION + "n := 1;\n" + END)
    assert found == ["STEP, INITIAL_STEP, TRANSITION or ACTION expected: this body is a chart, found `n`."]


def test_power_is_no_operand() -> None:
    found = said("RUNG\n[a] t(IN := NOT ~, PT := T#1s).Q (q)\nEND_RUNG\n" + END)
    assert [each[:44] for each in found] == ["`~` is the power itself and stands alone: se"]


def test_a_loop_without_its_type_and_an_action_named_like_its_step() -> None:
    assert "write `#n : INT = ...`" in said("NETWORK\n#n = ADD(#n, 1);\nEND_NETWORK\n" + END)[0]
    found = said("INITIAL_STEP Fill:\nFill(N);\nEND_STEP\nACTION Fill: n := n + 1; END_ACTION\n" + END)
    assert found[0] == "`Fill` is a step, so an action has a different name; rename one."


def test_a_chart_in_a_method_says_what_to_write() -> None:
    found = said("METHOD Sub\nINITIAL_STEP T1:\nEND_STEP\nEND_METHOD\n" + END)
    assert [each[:45] for each in found] == ["A METHOD keeps nothing between two calls, so "]


def test_q_of_an_action_that_two_charts_control_says_which_is_meant() -> None:
    chart = "INITIAL_STEP {0}:\nFill(N);\nEND_STEP\nTRANSITION FROM {0} TO {0} := TRUE; END_TRANSITION\n"
    one, two = chart.format("S"), f"ACTION Sub:\n{chart.format('T1')}END_ACTION\n"
    alone, both = (
        said(f"{each}ACTION Fill: IF Fill.Q THEN n := n + 1; END_IF; END_ACTION\n{END}") for each in (two, one + two)
    )
    assert alone == []
    assert [each[:45] for each in both] == ["Two charts of this POU control `Fill`, each w"]
