"""In-outs by value: what a pragma may say, what stays a reference, and that only the copies differ."""

from dataclasses import replace
from pathlib import Path

import pytest

from scanbench.check.build import Checked, check_sources
from scanbench.check.incremental import Checks
from scanbench.engines.native.emit_program import emit_program
from scanbench.program.program import Program
from scanbench.program.types import Record
from scanbench.symbols.sites import Outcome, StatementSite, sites_of
from scanbench.symbols.symbols import resolve
from tests.caseformat import MODELS, project_of, read_cases

BY_REFERENCE = MODELS["GENERIC-IEC"]
BY_VALUE = replace(BY_REFERENCE, in_out="value")
BLOCK = """
FUNCTION_BLOCK Add {here}
VAR_IN_OUT x : INT; END_VAR
x := x + 1;
END_FUNCTION_BLOCK
PROGRAM Main
VAR add : Add; n : INT; END_VAR
add(x := n);
END_PROGRAM
"""
CASES = [
    case
    for path in sorted((Path(__file__).parent.parent / "cases").glob("*.case"))
    for case in read_cases(path)
    if "VAR_IN_OUT" in case.source
    and case.in_out != "value"
    and "to which nothing writes" not in case.name  # a copy would be written back to what may only be read
]


def checked(text: str, by_value: bool = False) -> Checked:
    return check_sources({"main.st": text}, BY_VALUE if by_value else BY_REFERENCE)


def built(text: str, by_value: bool = False) -> Program:
    found = checked(text, by_value)
    assert found.program is not None, found.problems
    return found.program


def is_copied(program: Program, block: str, name: str) -> bool:
    record = next(each.instance for each in program.pous if each.name == block)
    assert isinstance(record, Record)
    return record.members[name.upper()].copied


@pytest.mark.parametrize(
    ("pragma", "copied"),
    [
        ("{in_out 'value'}", True), ("{ IN_OUT := 'Value' }", True), ('{in_out "value"}', True),
        ("{in_out 'reference'}", False), ("(* {in_out 'value'} *)", False), ("{attribute 'in_out'}", False),
    ],
)  # fmt: skip
def test_a_pragma_before_or_in_the_head(pragma: str, copied: bool) -> None:
    model_says_otherwise = not copied
    for text in (
        BLOCK.replace("{here}", pragma),
        BLOCK.replace("{here}", "").replace("FUNCTION_BLOCK Add", f"{pragma}\n// about it\nFUNCTION_BLOCK Add"),
        BLOCK.replace("{here}", "").replace("FUNCTION_BLOCK Add", f"FUNCTION_BLOCK {pragma} Add"),
    ):
        assert is_copied(built(text), "Add", "x") == copied
        if "reference" in pragma:
            assert is_copied(built(text, model_says_otherwise), "Add", "x") is False


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        (BLOCK.replace("{here}", "{in_out 'copy'}"), 2, ["'value'", "'reference'", "'copy'"]),
        (BLOCK.replace("{here}", "{in_out value}"), 2, ["'value'"]),
        (BLOCK.replace("{here}", "{in_out 'value'}{in_out 'reference'}"), 2, ["One", "remove"]),
        (BLOCK.replace("{here}", "").replace("PROGRAM Main", "{in_out 'value'} PROGRAM Main"), 6, ["FUNCTION_BLOCK"]),
        (BLOCK.replace("{here}", "").replace("x := x", "{in_out 'value'} x := x"), 4, ["FUNCTION_BLOCK"]),
    ],
)
def test_a_pragma_that_means_nothing_is_told(text: str, line: int, words: list[str]) -> None:
    problems = checked(text).problems
    assert [(each.code, each.span.line) for each in problems] == [("S003", line)]
    assert all(word in problems[0].message for word in words)


def test_the_pragma_belongs_to_one_block() -> None:
    text = "{in_out 'value'}\nFUNCTION_BLOCK A VAR_IN_OUT x : INT; END_VAR END_FUNCTION_BLOCK\n"
    text += "FUNCTION_BLOCK B VAR_IN_OUT x : INT; END_VAR END_FUNCTION_BLOCK\n"
    text += "PROGRAM Main VAR a : A; b : B; n : INT; END_VAR a(x := n); b(x := n); END_PROGRAM"
    program = built(text)
    assert (is_copied(program, "A", "x"), is_copied(program, "B", "x")) == (True, False)
    heirs = "FUNCTION_BLOCK Heir EXTENDS A VAR_IN_OUT y : INT; END_VAR END_FUNCTION_BLOCK\n" + text.replace(
        "b : B", "b : B; h : Heir"
    )
    program = built(heirs.replace("a(x := n);", "h(x := n, y := n);"))
    assert (is_copied(program, "Heir", "x"), is_copied(program, "Heir", "y")) == (True, False)


def test_types_that_lead_back_to_the_block() -> None:
    """An instance is never copied, so a block may take what holds it; nor is what a structure of them holds."""
    text = """
TYPE Ring : STRUCT next : REF_TO Ring; node : Node; END_STRUCT; Plain : STRUCT a : INT; END_STRUCT; Many : ARRAY[1..2] OF Plain; END_TYPE
FUNCTION_BLOCK Node
VAR_IN_OUT ring : Ring; other : Late; plain : Plain; many : Many; END_VAR
END_FUNCTION_BLOCK
FUNCTION_BLOCK Late
VAR_IN_OUT node : Node; END_VAR
END_FUNCTION_BLOCK
PROGRAM Main
VAR ring : Ring; late : Late; plain : Plain; many : Many; node : Node; END_VAR
node(ring := ring, other := late, plain := plain, many := many); late(node := node);
END_PROGRAM
"""
    program = built(text, by_value=True)
    assert [is_copied(program, "Node", name) for name in ("ring", "other", "plain", "many")] == [
        False,
        False,
        True,
        True,
    ]
    assert not is_copied(program, "Late", "node")


@pytest.mark.parametrize("case", CASES, ids=[case.name for case in CASES])
def test_both_conventions_have_the_same_statements(case) -> None:  # type: ignore[no-untyped-def]
    """So positions in a scan, breakpoints and coverage do not depend on the convention."""
    found: list[tuple[tuple[StatementSite, ...], tuple[Outcome, ...]]] = []
    for convention in ("reference", "value"):
        model = replace(MODELS[case.model], in_out=convention)
        made = check_sources(project_of(case), model, case.interval_ns).program
        assert made is not None
        sites = sites_of(made)
        found.append((sites.statements, sites.outcomes))
    assert found[0] == found[1]


def test_an_edit_of_the_pragma_is_seen() -> None:
    checks = Checks()
    texts = [
        BLOCK.replace("{here}", ""),
        BLOCK.replace("{here}", "{in_out 'value'}"),
        BLOCK.replace("{here}", "").replace("FUNCTION_BLOCK Add", "{in_out 'value'} FUNCTION_BLOCK Add"),
        BLOCK.replace("{here}", "").replace("FUNCTION_BLOCK Add", "{in_out 'reference'} FUNCTION_BLOCK Add"),
        BLOCK.replace("{here}", "").replace("FUNCTION_BLOCK Add", "in_out 'reference'} FUNCTION_BLOCK Add"),
        BLOCK.replace("{here}", "")
        .replace("FUNCTION_BLOCK Add", "{in_out 'value'} FUNCTION_BLOCK Add")
        .replace("+ 1", "+ 2"),
        BLOCK.replace("{here}", "{in_out 'values'}"),
        BLOCK.replace("{here}", ""),
    ]
    for text in texts:
        expected = check_sources({"main.st": text}, BY_REFERENCE, 1_000_000)
        for found in (
            checks.diagnose({"main.st": text}, BY_REFERENCE, 1_000_000),
            checks.check({"main.st": text}, BY_REFERENCE, 1_000_000),
        ):
            assert found.problems == expected.problems
        assert found.program is not None or expected.program is None
        if found.program is not None and expected.program is not None:
            assert emit_program(found.program) == emit_program(expected.program)


def test_the_path_means_what_was_passed() -> None:
    program = built(BLOCK.replace("{here}", "{in_out 'value'}"))
    memory = bytearray(program.initial_image)
    symbol = resolve(program, "Main.add.x")
    assert symbol.locate(memory) is None
    copy = program.layout.copies.all[0]
    there = resolve(program, "Main.n").offset
    memory[copy.slot : copy.slot + 8] = there.to_bytes(8, "little")
    assert symbol.locate(memory) == (there, None)
    memory[copy.slot : copy.slot + 8] = copy.start.to_bytes(8, "little")  # a circle, as only a damaged file has it
    assert symbol.locate(memory) is None
