"""A check after an edit finds what a check of the whole finds; and it does not look at what did not change."""

import random
import re
from collections.abc import Mapping
from functools import cache

import pytest

from bench.large import large
from scanbench.check.build import Checked, Checker, check_sources
from scanbench.check.incremental import Checks
from scanbench.engines.native.emit_program import emit_program
from scanbench.program.program import Program
from scanbench.syntax import tree
from tests.amounts import nightly, some
from tests.caseformat import MODELS

MODEL = MODELS["GENERIC-IEC"]
INTERVAL_NS = 1_000_000

BLOCKS = """\
(* FUNCTION_BLOCK in a comment *)
TYPE Level : INT (0..100) := 3; END_TYPE
VAR_GLOBAL total : DINT; limit : Level; END_VAR
FUNCTION_BLOCK Ramp
VAR_INPUT up : BOOL; step : INT; END_VAR
VAR_OUTPUT v : INT; END_VAR
VAR t : TON; list : ARRAY[0..4] OF INT; END_VAR
  t(IN := up, PT := T#10ms);
  IF t.Q THEN v := v + step; END_IF;
  list[v MOD 5] := v;
END_FUNCTION_BLOCK

{attribute 'qualified_only'}
FUNCTION Half : INT
VAR_INPUT v : INT; END_VAR
  Half := v / 2;
END_FUNCTION
"""
MAIN = """\
PROGRAM Main
VAR r : ARRAY[1..2] OF Ramp; k : INT; s : STRING[20]; END_VAR
  FOR k := 1 TO 2 DO r[k](up := total < 90, step := k); END_FOR;
  limit := Half(r[1].v);
  s := CONCAT(s, 'x');
  total := total + 1;
END_PROGRAM
"""
FILES = {"blocks.st": BLOCKS, "main.st": MAIN}


def code(program: Program | None) -> str:
    """Everything that runs: offsets, numbers of sites, calls."""
    return emit_program(program) if program is not None else ""


@cache
def fresh(files: tuple[tuple[str, str], ...]) -> tuple[Checked, str]:
    """A check of the whole, and its code: of the files before the edit, once for all tests."""
    checked = check_sources(dict(files), MODEL, INTERVAL_NS)
    return checked, code(checked.program)


def agree(found: Checked, files: Mapping[str, str]) -> None:
    expected, expected_code = fresh(tuple(files.items()))
    assert found.problems == expected.problems
    assert found.pous == expected.pous
    assert code(found.program) == expected_code
    if found.program is not None and expected.program is not None:
        assert found.program.traps == expected.program.traps
        assert found.program.checks == expected.program.checks
        assert found.program.initial_image == expected.program.initial_image


@pytest.fixture
def rechecked(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Names of the POUs whose body alone was checked again."""
    names: list[str] = []
    recheck = Checker.recheck

    def watched(self: Checker, *args: object) -> None:
        names.append(args[0].name)  # type: ignore[attr-defined]
        recheck(self, *args)  # type: ignore[arg-type]

    monkeypatch.setattr(Checker, "recheck", watched)
    return names


BODIES = [
    ("v := v + step;", "v := v - step;"),
    ("v := v + step;", "v := v + step;\n  v := v MOD 7;\n  list[v] := 3;"),
    ("v := v + step;", "v := v + stop;"),
    ("v := v + step;", "v := v + ;"),
    ("list[v MOD 5] := v;", ""),
    ("Half := v / 2;", "Half := v / v; Half := Half / 3;"),
    ("t(IN := up, PT := T#10ms);", "t(IN := up, PT := T#20ms); IF Half(3) > 1 THEN limit := 99; END_IF;"),
    ("limit := Half(r[1].v);", "(* only this *) // and this"),
    ("s := CONCAT(s, 'x');", "s := 'it''s $' fine'; s := CONCAT(CONCAT(s, 'a'), CONCAT('b', s));"),
    ("total := total + 1;", "total := total + LEN(s); total := ABS(total);"),
]


@pytest.mark.parametrize(("old", "new"), BODIES)
def test_a_changed_body(old: str, new: str, rechecked: list[str]) -> None:
    checks = Checks()
    agree(checks.check(FILES, MODEL, INTERVAL_NS), FILES)
    edited = {name: text.replace(old, new) for name, text in FILES.items()}
    assert edited != FILES
    agree(checks.check(edited, MODEL, INTERVAL_NS), edited)
    agree(checks.check(FILES, MODEL, INTERVAL_NS), FILES)
    assert len(rechecked) == 2


DECLARATIONS = [
    ("VAR_OUTPUT v : INT;", "VAR_OUTPUT v : DINT;"),
    ("step : INT;", "step : INT; more : BOOL;"),
    ("FUNCTION Half : INT", "FUNCTION Half : DINT"),
    ("FUNCTION Half", "FUNCTION Third"),
    ("total : DINT;", "total : LINT;"),
    ("INT (0..100)", "INT (0..50)"),
    ("END_FUNCTION\n", "END_FUNCTION\nFUNCTION Half : INT\nEND_FUNCTION\n"),
    ("END_FUNCTION_BLOCK", "END_FUNCTION"),
    ("END_FUNCTION_BLOCK", ""),
    ("v := v + step;", "v := v + step; END_FUNCTION_BLOCK FUNCTION_BLOCK Other"),
    ("v := v + step;", "(* v := v + step;"),
    ("v := v + step;", "{ v := v + step;"),
    ("v := v + step;", "v := 'v + step;"),
    ("Half := v / 2;", "Half := v / 2; ENO := v > 3;"),
    ("t : TON;", "t : TON; u : TOF;"),
    ("(* FUNCTION_BLOCK in a comment *)", "(* FUNCTION_BLOCK in a comment"),
    ("PROGRAM Main", "NAMESPACE N END_NAMESPACE PROGRAM Main"),
]


@pytest.mark.parametrize(("old", "new"), DECLARATIONS)
def test_anything_else(old: str, new: str) -> None:
    checks = Checks()
    checks.check(FILES, MODEL, INTERVAL_NS)
    edited = {name: text.replace(old, new, 1) for name, text in FILES.items()}
    agree(checks.check(edited, MODEL, INTERVAL_NS), edited)
    agree(checks.check(FILES, MODEL, INTERVAL_NS), FILES)


SEEN = """\
TYPE Pair : STRUCT a, b : Ramp; END_STRUCT; END_TYPE
TYPE Pairs : ARRAY[1..2] OF Pair; END_TYPE
VAR_GLOBAL both : Pairs; END_VAR
FUNCTION_BLOCK Far
VAR_OUTPUT n : INT; END_VAR
  n := both[1].a.v;
END_FUNCTION_BLOCK
FUNCTION_BLOCK Near
VAR_INPUT n : INT; END_VAR
VAR f : Far; k : INT; END_VAR
  f(); k := f.n + unknown;
END_FUNCTION_BLOCK
"""


@nightly
@pytest.mark.parametrize(("old", "new"), some(DECLARATIONS + BODIES, 3))
def test_problems_alone(old: str, new: str) -> None:
    checks = Checks()
    files = FILES | {"seen.st": SEEN}
    for more in (files, files | {"seen.st": SEEN.replace(" + unknown", "")}):
        edited = {name: text.replace(old, new, 1) for name, text in more.items()}
        for texts in (more, edited, more):
            found, (expected, _) = checks.diagnose(texts, MODEL, INTERVAL_NS), fresh(tuple(texts.items()))
            assert (found.problems, found.pous, found.checks) == (expected.problems, expected.pous, expected.checks)
        agree(checks.check(edited, MODEL, INTERVAL_NS), edited)


def test_only_bodies_that_see_a_declaration_are_checked_for_problems(monkeypatch: pytest.MonkeyPatch) -> None:
    names: list[str] = []
    check_body = Checker.check_body

    def watched(self: Checker, declaration: tree.PouDeclaration) -> None:
        names.append(declaration.name)
        check_body(self, declaration)

    monkeypatch.setattr(Checker, "check_body", watched)
    checks = Checks()
    files = FILES | {"seen.st": SEEN}
    checks.diagnose(files, MODEL, INTERVAL_NS)
    names.clear()
    edited = files | {"blocks.st": BLOCKS.replace("VAR_OUTPUT v : INT;", "VAR_OUTPUT v : STRING;")}
    found = checks.diagnose(edited, MODEL, INTERVAL_NS)
    assert [name for name in names if name not in ("TON", "CONCAT", "LEN", "__System")] == ["Ramp", "Main", "Far"]
    assert any(problem.span.file == "seen.st" and problem.span.line == 6 for problem in found.problems)


PROVEN = """\
VAR_GLOBAL small : INT (0..9); END_VAR
FUNCTION_BLOCK First
VAR k : INT (0..5); b2 : BOOL; END_VAR
  k := 3;
  small := k;
END_FUNCTION_BLOCK
FUNCTION_BLOCK Second
VAR k : INT (0..5); n : INT; f : First; END_VAR
  n := n + k;
  n := n - k;
  k := n;
  small := k;
{wrong}
END_FUNCTION_BLOCK
PROGRAM Main
VAR s : Second; f : First; END_VAR
  s(); f();
END_PROGRAM
"""


@pytest.mark.parametrize("wrong", ["", "  f.b3 := TRUE;", "  n := f.b2;", "  k := SIZEOF(f);"])
def test_places_told_in_words_and_near_matches(wrong: str) -> None:
    """A check is needless because of a line; a wrong name is near to one that comes and goes."""
    text = PROVEN.replace("{wrong}", wrong)
    assert wrong or any("line 9" in site.needless for site in check_sources({"a.st": text}, MODEL, INTERVAL_NS).checks)
    whole, problems = Checks(), Checks()
    for edited in (
        text, text.replace("  k := 3;", "  k := 3;\n\n"), text.replace("b2 : BOOL;", "b2 : BOOL;\n  b4 : BOOL;"), text,
        text.replace("b2 : BOOL;", "b7 : BOOL;"), text.replace("b2 : BOOL;", "b2 : LREAL; bb : STRING;"), text,
        text.replace("  k := 3;", "  k := 4;"), text.replace("b2 : BOOL;", "b3 : BOOL;"),
    ):  # fmt: skip
        files = {"a.st": edited}
        agree(whole.check(files, MODEL, INTERVAL_NS), files)
        found, expected = problems.diagnose(files, MODEL, INTERVAL_NS), check_sources(files, MODEL, INTERVAL_NS)
        assert (found.problems, found.pous, found.checks) == (expected.problems, expected.pous, expected.checks)


def test_files_that_come_go_and_change_places() -> None:
    checks = Checks()
    for files in (
        FILES, {"main.st": MAIN, "blocks.st": BLOCKS}, FILES | {"more.st": "PROGRAM Idle\nEND_PROGRAM\n"}, {"main.st": MAIN},
        FILES, {"all.st": BLOCKS + MAIN},
    ):  # fmt: skip
        agree(checks.check(files, MODEL, INTERVAL_NS), files)


def test_a_different_model_or_interval_is_a_different_program() -> None:
    checks = Checks()
    first = checks.check(FILES, MODEL, INTERVAL_NS).program
    second = checks.check(FILES, MODEL, 2 * INTERVAL_NS).program
    third = checks.check(FILES, MODELS["CJ1M-CPU63"], INTERVAL_NS).program
    assert first is not None
    assert second is not None
    assert third is not None
    assert (first.interval_ns, second.interval_ns) == (INTERVAL_NS, 2 * INTERVAL_NS)
    assert third.layout.model.name == "CJ1M-CPU63"


def test_several_projects_in_turn(rechecked: list[str]) -> None:
    checks = Checks(2)
    other = {"other.st": MAIN.replace("r[k]", "(*no*) r[k]") + BLOCKS}
    for round in range(3):
        text = f"total := total + {round + 2};"
        for files in (FILES, other):
            edited = {name: each.replace("total := total + 1;", text) for name, each in files.items()}
            agree(checks.check(edited, MODEL, INTERVAL_NS), edited)
    assert rechecked == ["Main"] * 4


def test_errors_of_other_pous_stay_and_move() -> None:
    checks = Checks()
    broken = FILES | {"main.st": MAIN.replace("total := total + 1;", "total := unknown;\n total := ;")}
    agree(checks.check(broken, MODEL, INTERVAL_NS), broken)
    moved = broken | {"blocks.st": BLOCKS.replace("v := v + step;", "\n\n v := nothing;\n")}
    agree(checks.check(moved, MODEL, INTERVAL_NS), moved)
    both = {"all.st": moved["blocks.st"] + moved["main.st"]}
    agree(checks.check(both, MODEL, INTERVAL_NS), both)
    lower = {"all.st": both["all.st"].replace("v := nothing;", "v := 1;\n\n")}
    agree(checks.check(lower, MODEL, INTERVAL_NS), lower)


def test_a_large_file_edited_here_and_there(rechecked: list[str]) -> None:
    text = "\n".join(large("big10k").splitlines()[: 82 * 6])
    text = (
        text[: text.rindex("END_FUNCTION_BLOCK")]
        + "END_FUNCTION_BLOCK\nPROGRAM Main\nVAR u : Unit3; END_VAR\nu();\nEND_PROGRAM\n"
    )
    checks, chance = Checks(), random.Random(7)
    checks.check({"big.st": text}, MODEL, INTERVAL_NS)
    statements = [match.start() for match in re.finditer(r"\n  (?=[a-z]\w* := )", text)]
    for _ in range(12):
        at = chance.choice(statements)
        added = chance.choice(
            ["\n  b0 := b1;", "\n\n", "\n  integ := 1.5", "\n  b1 := alarm OR b2; (* so *)\n", "\n  i := j;"]
        )
        edited = {"big.st": text[:at] + added + text[at:]}
        agree(checks.check(edited, MODEL, INTERVAL_NS), edited)
    assert len(rechecked) > 8


def test_running_programs_keep_their_places() -> None:
    """What a program says of a trap does not move when the text is edited."""
    checks = Checks()
    program = checks.check(FILES, MODEL, INTERVAL_NS).program
    assert program is not None
    before = [str(site.span) for site in program.traps]
    edited = FILES | {"blocks.st": BLOCKS.replace("v := v + step;", "\n\n\n v := v;")}
    checks.check(edited, MODEL, INTERVAL_NS)
    assert [str(site.span) for site in program.traps] == before


def test_a_look_at_a_subrange_variable_reaches_where_it_is_written() -> None:
    """`SUBRANGE_ERROR(limit)` in one body makes the other one keep what it writes to `limit`; and no longer, when it is gone."""
    checks = Checks()
    blocks = BLOCKS.replace("Half := v / 2;", "Half := v / 2; IF total = 0 THEN limit := v; END_IF;")
    looking = blocks.replace("list[v MOD 5] := v;", "list[v MOD 5] := v; IF SUBRANGE_ERROR(limit) THEN v := 0; END_IF;")
    for text in (blocks, looking, blocks):
        files = {**FILES, "blocks.st": text}
        agree(checks.check(files, MODEL, INTERVAL_NS), files)
        assert checks.diagnose(files, MODEL, INTERVAL_NS).problems == ()
