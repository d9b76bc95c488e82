"""Sequential function charts that are wrong: each problem with its code, its line, and what it says to do."""

import pytest

from scanbench.check.build import check_sources
from scanbench.problems import Problem, Severity
from tests.caseformat import MODELS

MODEL = MODELS["GENERIC-IEC"]
HEAD = "PROGRAM Main\nVAR x : INT; b, c : BOOL; END_VAR\n"
AB = "INITIAL_STEP One:\nEND_STEP\nSTEP Two:\nEND_STEP\nTRANSITION FROM One TO Two := b; END_TRANSITION\n"


def problems(body: str) -> list[Problem]:
    return list(check_sources({"a.st": f"{HEAD}{body}\nEND_PROGRAM\n"}, MODEL).problems)


def with_action(text: str) -> str:
    return AB.replace("One:\n", f"One:\n{text}\n")


WRONG = [
    ("STEP One:\nEND_STEP", "T010", 3, "there is none"),
    (AB + "INITIAL_STEP C1:\nEND_STEP", "D001", 8, "`One` is the initial step already"),
    (AB + "TRANSITION FROM Two TO Gone := c; END_TRANSITION", "T001", 8, "There is no step `Gone`"),
    (
        AB + "TRANSITION FROM Two TO One : RUNG\n< [c] JMP gone | [c] >\nEND_RUNG END_TRANSITION",
        "T010",
        9,
        "a jump or RETURN in it",
    ),
    (
        AB + "TRANSITION FROM Two TO One : RUNG\n< [c] RETURN | [c] >\nEND_RUNG END_TRANSITION",
        "T010",
        9,
        "a jump or RETURN in it",
    ),
    ("INITIAL_STEP One:\nb(N, x);\nEND_STEP", "T002", 4, "The indicator of an action is BOOL"),
    (AB + "STEP C1:\nEND_STEP", "W001", 8, "Nothing leads to the step `C1`"),
    (AB + "STEP One:\nEND_STEP", "D001", 8, "`One`"),
    (with_action("b(L);"), "S003", 4, "L needs a duration: `b(L, T#1s)`"),
    (with_action("b(N, T#1s);"), "S003", 4, "N takes no duration"),
    (with_action("b(Q);"), "S003", 4, "`Q` is no qualifier"),
    (with_action("b(L, T#1s);\nb(D, T#2s);"), "T010", 5, "`b` has two durations at once"),
    (with_action("b(SD, T#1s);\nb(SL, T#2s);"), "T010", 5, "SD and SL"),
    (with_action("x(N);"), "T002", 4, "`x` is INT"),
    (with_action("gone(N);"), "T001", 4, "`gone` is no action and no variable; write ACTION gone: ... END_ACTION"),
    (with_action("b(N)"), "S003", 4, "`;` expected after an action"),
    (AB.replace(":= b", ":= x"), "T006", 7, "A condition is BOOL"),
    (AB.replace(":= b;", "; "), "S003", 7, "`:=` and the condition of the transition expected"),
    (AB.replace("END_TRANSITION", ""), "S003", 9, "END_TRANSITION expected"),
    (AB + "b := c;", "S003", 8, "STEP, INITIAL_STEP, TRANSITION or ACTION expected"),
    (with_action("Act(N);") + "ACTION Act: One.X := TRUE; END_ACTION", "T003", 9, "`X` is an output"),
    (
        AB + "TRANSITION FROM Two TO One : RUNG\n[b] -> #a\nEND_RUNG END_TRANSITION",
        "T010",
        8,
        "A condition is the power",
    ),
]


@pytest.mark.parametrize(("body", "code", "line", "text"), WRONG, ids=[each[3] for each in WRONG])
def test_what_is_wrong(body: str, code: str, line: int, text: str) -> None:
    found = problems(body)
    assert (code, line) in [(each.code, each.span.line) for each in found], "\n".join(map(str, found))
    assert any(text in each.message for each in found if each.code == code), "\n".join(map(str, found))
    assert len(found) <= 2, "\n".join(map(str, found))


def test_step_is_a_name_elsewhere() -> None:
    text = "PROGRAM Main\nVAR step, transition : INT; END_VAR\nstep := transition;\nEND_PROGRAM\n"
    assert check_sources({"a.st": text}, MODEL).problems == ()


def test_two_durations_of_steps_that_are_never_active_together_are_right() -> None:
    chart = AB.replace("One:\n", "One:\nc(L, T#1s);\n").replace("Two:\n", "Two:\nc(L, T#2s);\n")
    assert [each for each in problems(chart) if each.severity is Severity.ERROR] == []


@pytest.mark.parametrize("condition", [":= ;", ";", ":"])
def test_nothing_is_said_of_steps_while_a_transition_cannot_be_read(condition: str) -> None:
    assert [each.code for each in problems(AB.replace(":= b;", condition))] == ["S003"]


def test_two_durations_of_simultaneous_steps_are_refused() -> None:
    chart = (
        "INITIAL_STEP S:\nEND_STEP\nSTEP One:\nc(L, T#1s);\nEND_STEP\nSTEP Two:\nc(L, T#2s);\nEND_STEP\n"
        "TRANSITION FROM S TO (One, Two) := b; END_TRANSITION\n"
    )
    assert [(each.code, each.span.line) for each in problems(chart)] == [("T010", 9)]


def test_a_function_has_no_chart() -> None:
    text = f"FUNCTION F : BOOL\nVAR_INPUT b : BOOL; END_VAR\n{AB}END_FUNCTION\nPROGRAM Main\nEND_PROGRAM\n"
    found = check_sources({"a.st": text}, MODEL).problems
    assert [(each.code, each.span.line) for each in found] == [("T010", 3)]
