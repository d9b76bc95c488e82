"""Drawings that read differently when a part of them is lost or moved: written and read again they compute the same, or they are refused."""

import re
from random import Random

import pytest

from scanbench.server.samples import templates
from scanbench.syntax.parse_file import is_in_plant
from scanbench.syntax.plcopen.project import read_project
from scanbench.syntax.plcopen.write import Form, write_project
from tests.caseformat import MODELS
from tests.syntax.both_engines import BothEngines

SCANS = 40
SPLIT = """FUNCTION Split : INT
VAR_INPUT x : INT; END_VAR
VAR_OUTPUT out, lo : INT; END_VAR
out := x / 10; lo := x MOD 10; Split := x;
END_FUNCTION
"""
KEPT = {
    "a negated output": "t(IN := a, PT := T#10ms, NOT Q => q);",
    "a negated output of a box that EN keeps from being called": "t(EN := b, IN := a, PT := T#10ms, NOT Q => q);",
    "a jump before the last line": "JMP fin IF a;\n n := ADD(n, 1);",
    "a jump whose condition is written by a later line": "JMP fin IF NOT a;\n a := b;\n n := ADD(n, 1);",
    "two jumps": "JMP other IF a;\n JMP fin IF b;\n m := ADD(m, 1);",
    "a jump without a condition": "n := ADD(n, 1);\n JMP fin;\n n := ADD(n, 2);",
    "a return before the last line": "RETURN IF R_EDGE a;\n n := ADD(n, 1);",
    "a jump by the output of a box": "#x = AND(a, b);\n JMP fin IF #x;\n a := #x;\n n := ADD(n, 1);",
    "a wire of a box with EN": "#s = ADD(EN := a, IN1 := m, IN2 := 1);\n n := #s;",
    "a variable at a box with EN": "n := ADD(EN := a, IN1 := n, IN2 := 1);",
    "a variable at an output of a block with EN": "c(EN := a, CU := b, PV := 2, CV => n);",
}
RUNGS = {
    "several contacts at a box with EN": "[a] c(EN := ~, CU := < [b] >, R := < [n > 7] | [N b] [a] >, PV := 2).Q (q)",
    "power at a pin, contacts at EN": "[b] c(EN := < [/a] >, CU := ~, R := FALSE, PV := 2).ENO (q)",
    "a function with outputs": "[a] m := Split(EN := ~, x := n, out => n, lo => m).ENO (q)",
    "a function without power": "[a] n := ADD(EN := ~, IN1 := n, IN2 := 1)",
    "a jump after its branches": "< [a] (q) | [b] JMP fin >",
    "a jump beside a coil": "[a] < JMP fin | (q) >",
}
REFUSED = {
    "a return before another branch": "< [a] RETURN | [b] > (q)",
    "a jump before another branch": "< [a] JMP fin | [b] (q) >",
}
AFTER = """NETWORK
    n := ADD(n, 3);
END_NETWORK
NETWORK other:
    m := ADD(m, n);
END_NETWORK
NETWORK fin:
END_NETWORK
"""
RUNGS_AFTER = "RUNG other:\n    [/q] (S q)\nEND_RUNG\nRUNG fin:\nEND_RUNG\n"
DECLARED = "VAR a, b, q : BOOL; n, m : INT; t : TON; c : CTU; END_VAR"


def source_of(body: str) -> str:
    return f"PROGRAM Main\n{DECLARED}\n{body}END_PROGRAM\n{SPLIT}"


def same(source: str, form: Form) -> str:
    """The text that comes back; it has computed what the first one does."""
    written = write_project("Own", {"Main.st": source}, form)
    assert written.left_out == []
    files = read_project(written.data).files
    both = [BothEngines(each, MODELS["GENERIC-IEC"]) for each in ({"Main.st": source}, files)]
    random, names = Random(1), ("main.a", "main.b", "main.q", "main.n", "main.m", "main.c.CV", "main.t.Q")
    for scan in range(SCANS):
        sets = {name: str(random.random() < 0.5).upper() for name in ("main__a", "main__b") if random.random() < 0.6}
        for each in both:
            each.run(1, **sets)
        wanted, found = (dict(zip(names, each.values(*names), strict=True)) for each in both)
        assert found == wanted, f"scan {scan}\n{files['Main.st']}"
    return files["Main.st"]


@pytest.mark.parametrize("form", Form)
@pytest.mark.parametrize("name", KEPT)
def test_networks_compute_the_same(name: str, form: Form) -> None:
    same(source_of(f"NETWORK\n {KEPT[name]}\nEND_NETWORK\n{AFTER}"), form)


@pytest.mark.parametrize("form", Form)
@pytest.mark.parametrize("name", RUNGS)
def test_rungs_compute_the_same_and_stay_rungs(name: str, form: Form) -> None:
    again = same(source_of(f"RUNG\n    {RUNGS[name]}\nEND_RUNG\n{RUNGS_AFTER}"), form)
    assert "NETWORK" not in again


@pytest.mark.parametrize("form", Form)
def test_a_link_that_other_branches_run_before_is_no_rung_but_computes_the_same(form: Form) -> None:
    same(source_of(f"RUNG\n    < [a] -> #w | [b] (a) | #w (b) (q) >\nEND_RUNG\n{RUNGS_AFTER}"), form)


@pytest.mark.parametrize("form", Form)
@pytest.mark.parametrize("name", REFUSED)
def test_what_would_move_is_refused_by_its_place(name: str, form: Form) -> None:
    source = source_of(f"RUNG first:\n    [a] (b)\nEND_RUNG\nRUNG\n    {REFUSED[name]}\nEND_RUNG\n{RUNGS_AFTER}")
    (said,) = write_project("Own", {"Main.st": source}, form).left_out
    assert said.startswith("Main, the whole of it: ")
    assert "Main.st, line 6" in said


@pytest.mark.parametrize("form", Form)
def test_rungs_and_networks_of_one_body_stay_together(form: Form) -> None:
    rung = "RUNG\n    [a] (b)\nEND_RUNG\n"
    network = "NETWORK\n    n := ADD(EN := a, IN1 := n, IN2 := 1);\n    #x = AND(b, a);\n    q := #x;\nEND_NETWORK\n"
    same(source_of(f"{rung}{network}{RUNGS_AFTER}{network.replace('#x', '#y')}"), form)


@pytest.mark.parametrize("form", Form)
def test_labels_of_empty_networks_stay(form: Form) -> None:
    body = "RUNG\n    [a] JMP two\nEND_RUNG\nRUNG one:\nEND_RUNG\nRUNG two:\nEND_RUNG\nRUNG three:\n    [/q] (q)\nEND_RUNG\nRUNG four:\nEND_RUNG\n"
    again = same(source_of(body), form)
    assert body in again


BUTTONS = (
    "start",
    "stop",
    "ack",
    "guardOpen",
    "inPlace",
    "nozzleUp",
    "nozzleDown",
    "capperUp",
    "capperDown",
    "tight",
    "bottle",
)


def test_a_machine_of_ladders_and_a_chart_has_the_same_memory_after_200_scans() -> None:
    machine = next(each for each in templates() if each.id == "filling")
    files = {name: text for name, text in machine.files.items() if not is_in_plant(name)}
    written = write_project("Filling", files)
    assert written.left_out == []
    both = [BothEngines(each, MODELS[machine.model]) for each in (files, read_project(written.data).files)]
    begun = both[0].image()
    assert both[1].image() == begun
    random = Random(18)
    for _ in range(200):
        sets = {
            name: str(name != "guardOpen" and random.random() < 0.8).upper()
            for name in BUTTONS
            if random.random() < 0.3
        }
        for each in both:
            each.run(1, **sets)
    assert both[0].values("valve", "bottlesDone") != ["FALSE", "0"], "it did nothing"
    assert both[0].image() == both[1].image()


@pytest.mark.parametrize("rung", ["[a] [/b]", "< [a] | [b] >", "[a] < [/b] | [P a] >", "[P b]", "< [a] (done) | [b] >"])
def test_the_rung_of_a_transition_stays_one(rung: str) -> None:
    source = source_of(
        f"INITIAL_STEP One:\nEND_STEP\nSTEP Two:\n    q(N);\nEND_STEP\nTRANSITION FROM One TO Two : RUNG\n    {rung.replace('done', 'q')}\n"
        "END_RUNG END_TRANSITION\nTRANSITION FROM Two TO One := b; END_TRANSITION\n"
    )
    assert "TRANSITION FROM One TO Two : RUNG\n" in same(source, Form.TC6)


def test_a_body_of_a_transition_as_a_rung_is_read() -> None:
    """As other tools write it: a named transition, or a body within the chart."""
    source = source_of(
        "INITIAL_STEP One:\nEND_STEP\nSTEP Two:\nEND_STEP\nTRANSITION FROM One TO Two := a; END_TRANSITION\n"
        "TRANSITION FROM Two TO One := b; END_TRANSITION\n"
    )
    data = write_project("Own", {"Main.st": source}).data.decode()
    st = re.search(r"<inline name=\"[^\"]*\">\s*<ST>.*?</ST>\s*</inline>", data, re.DOTALL)
    assert st is not None
    drawn = (
        '<inline name=""><LD><leftPowerRail localId="1"><connectionPointOut formalParameter=""/></leftPowerRail><contact localId="2">'
        '<connectionPointIn><connection refLocalId="1"/></connectionPointIn><connectionPointOut/><variable>b</variable></contact></LD></inline>'
    )
    main = read_project(data.replace(st.group(), drawn, 1).encode()).files["Main.st"]
    assert "TRANSITION FROM One TO Two : RUNG\n    [b]\nEND_RUNG END_TRANSITION\n" in main
