"""The layout of a text: the same program, formatted once is formatted for good, and comments stay."""

from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bench.large import UNITS, large
from scanbench.check.build import check_sources
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.language.format import edits, formatted
from scanbench.plcmodel.model import Model
from scanbench.program.layout import Layout
from tests.amounts import amount, nightly, slow, some
from tests.caseformat import MODELS, read_cases
from tests.check.test_no_crash import WORDS
from tests.language.reading import FILE
from tests.programs import generate

CASES = Path(__file__).parent.parent / "cases"
SAMPLES = Path(__file__).parents[2] / "scanbench" / "samples"
GENERIC = MODELS["GENERIC-IEC"]


def keeps(text: str, model: Model, scans: int, name: str = FILE, **others: str) -> str | None:
    """The formatted text, of which this is shown; None where the text cannot be read."""
    made = formatted(name, text)
    if made is None:
        return None
    assert formatted(name, made) == made
    before = check_sources({name: text, **others}, model).program
    after = check_sources({name: made, **others}, model).program
    assert (before is None) == (after is None)
    if before is not None and after is not None:
        memory = bytearray(before.initial_image), bytearray(after.initial_image)
        for image in memory:  # so that a loop without end is not gone round 50 million times
            image[Layout.BUDGET_LIMIT : Layout.BUDGET_LIMIT + 8] = (200_000).to_bytes(8, "little")
        ends = [ReferenceEngine(each, image).run(scans) for each, image in zip((before, after), memory, strict=True)]
        assert ends[0].reason == ends[1].reason
        assert memory[0] == memory[1]
    return made


@nightly
@pytest.mark.parametrize("topic", some(sorted(path.stem for path in CASES.glob("*.case")), 4, 1))
def test_a_formatted_case_does_the_same(topic: str) -> None:
    for case in read_cases(CASES / f"{topic}.case"):
        keeps(case.source, MODELS[case.model], amount(200, 3), **case.files)


@pytest.mark.parametrize("path", sorted(SAMPLES.rglob("*.st")), ids=lambda path: path.stem)
def test_samples_are_formatted(path: Path) -> None:
    text = path.read_text("utf-8")
    assert keeps(text, GENERIC, 1) == text


@slow
@pytest.mark.parametrize("name", sorted(UNITS))
def test_a_large_program_does_the_same(name: str) -> None:
    assert keeps(large(name), GENERIC, 200) is not None


@nightly
def test_random_programs_do_the_same() -> None:
    for seed in range(amount(200, 8)):
        keeps(generate(seed), GENERIC, 2)


@settings(max_examples=amount(400, 60), deadline=None, derandomize=True)
@given(st.lists(st.sampled_from([*WORDS, "\n", "\n  ", "// c\n"]), max_size=60).map(" ".join))
def test_what_is_half_written_is_left_or_keeps_its_tokens(text: str) -> None:
    made = formatted(FILE, text)
    assert made is None or formatted(FILE, made) == made


UGLY = """\
program Main
var x:int:=-1; (* one *)
  longer   :   ARRAY [0 .. 9] of Int ;// two
     y AT %MW4:INT(0..9);
end_var


if x>3 and(y<>-2)  then   // why
x:=x+1 ;
    y := LIMIT( 0,x ,
             9 );
else
case x of
1,2: y:=- x;
3:
y:=0;
x := 2;
else
x:=0;
end_case
end_if;
for x:=0 to 9 by 2 do longer [x]:=0; end_for;
end_program
"""
GOOD = """\
PROGRAM Main
VAR x : INT := -1; (* one *)
  longer         : ARRAY [0..9] OF INT; // two
  y      AT %MW4 : INT(0..9);
END_VAR

  IF x > 3 AND (y <> -2) THEN // why
    x := x + 1;
    y := LIMIT(0, x,
             9);
  ELSE
    CASE x OF
      1, 2: y := -x;
      3:
        y := 0;
        x := 2;
    ELSE
      x := 0;
    END_CASE
  END_IF;
  FOR x := 0 TO 9 BY 2 DO longer [x] := 0; END_FOR;
END_PROGRAM
"""


def test_an_ugly_text_becomes_a_good_one() -> None:
    assert formatted(FILE, UGLY) == GOOD


@pytest.mark.parametrize("text", ["PROGRAM Main\nx := ;\nEND_PROGRAM\n", "PROGRAM Main\n(* never\n", "IF"])
def test_a_text_that_cannot_be_read_stays_as_it_is(text: str) -> None:
    assert formatted(FILE, text) is None


def test_try_has_its_parts_at_its_own_level() -> None:
    text = "PROGRAM p\n__try\na:=1;\nIF a=1 THEN\nb:=2;END_IF\n__catch ( e )\nb:=3;\n__finally\nc:=4;\n__endtry\nd:=5;\nEND_PROGRAM\n"
    assert formatted("a.st", text) == (
        "PROGRAM p\n  __TRY\n    a := 1;\n    IF a = 1 THEN\n      b := 2; END_IF\n  __CATCH (e)\n    b := 3;\n  __FINALLY\n"
        "    c := 4;\n  __ENDTRY\n  d := 5;\nEND_PROGRAM\n"
    )


def test_il_keeps_its_columns() -> None:
    text = "PROGRAM Main\nVAR a,b : INT; END_VAR\n        LD    a\n  go:   ADD   b\n        ST    a\nEND_PROGRAM\n"
    assert formatted(FILE, text) == text.replace("a,b", "a, b")


def test_rungs_stay_as_they_are_written() -> None:
    body = 'RUNG hold:  "Two  blanks"\n    // and a comment\n  < [a]\n  | [/ b]   t(IN := ~,PT:=T#1s).Q\n  > (S a)\nEND_RUNG\n'
    text = f"PROGRAM Main\nVAR a,b : BOOL; t : TON; END_VAR\n{body}END_PROGRAM\n"
    assert formatted(FILE, text) == text.replace("a,b", "a, b")


@pytest.mark.parametrize(("first", "last"), [(0, None), (2, 4), (7, 9)])
def test_the_edits_of_some_lines_leave_the_others(first: int, last: int | None) -> None:
    text = UGLY.replace("else\ncase", "else\n\n\n\ncase")
    made = formatted(FILE, text)
    assert made is not None
    lines = text.split("\n")
    for each in reversed(edits(text, made, first, last)):
        assert first <= each.first
        assert last is None or each.after - 1 <= last
        lines[each.first : each.after] = each.lines
    if last is None:
        assert "\n".join(lines) == made
    else:
        assert lines[:first] == text.split("\n")[:first]
        assert lines != text.split("\n")


def test_line_ends_stay() -> None:
    text = "program Main\r\nvar x:int; end_var\r\nx:=1; // a\r\nend_program\r\n"
    made = formatted(FILE, text)
    assert made == "PROGRAM Main\r\nVAR x : INT; END_VAR\r\n  x := 1; // a\r\nEND_PROGRAM\r\n"
    assert [each.lines for each in edits(made, made.replace("x := 1", "x :=1"))] == [("  x :=1; // a\r",)]


def test_what_is_one_operator_elsewhere_stays_together() -> None:
    body = "  a S= b;\n  a R= b;\n  r REF= a;\n  FOR by := 1 TO by BY by DO\n    a := b;\n  END_FOR;\n"
    text = f"PROGRAM Main\nVAR a, b : BOOL; r : REFERENCE TO BOOL REF= b; by : INT; END_VAR\n{body}END_PROGRAM\n"
    assert formatted(FILE, text) == text
