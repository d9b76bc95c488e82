"""Monitor ranges: how they are written, what they mean, and what is said of those that mean nothing."""

import pytest

from scanbench.program.program import Program
from scanbench.symbols.sites import sites_of
from scanbench.verify.contract import BadRange, Range
from scanbench.verify.ranges import Resolved, parse_range, resolve_range
from tests.runtime.bench import program

SOURCE = """\
FUNCTION_BLOCK Belt
VAR_INPUT go : BOOL; END_VAR VAR n : INT; END_VAR
  IF go THEN
    n := n + 1;
  END_IF;

  n := n
    + 2;
END_FUNCTION_BLOCK
PROGRAM Main
VAR belt : ARRAY[1..2] OF Belt; END_VAR
  belt[1]();
  belt[2]();
END_PROGRAM
"""


def resolved(text: str) -> Resolved:
    made: Program = program(SOURCE)
    return resolve_range(made, sites_of(made), parse_range(text))


@pytest.mark.parametrize(
    ("text", "range"),
    [
        ("", Range()),
        (" Belt ", Range(pou="Belt")),
        ("Belt:10-20", Range(pou="Belt", first=10, last=20)),
        ("Belt:10", Range(pou="Belt", first=10, last=10)),
        ("Belt.run:3-4", Range(pou="Belt.run", first=3, last=4)),
        ("main.st:3-4", Range(file="main.st", first=3, last=4)),
        ("lib/Belt.st", Range(file="lib/Belt.st")),
        ("Belt:3@Main.belt[2]", Range(pou="Belt", first=3, last=3, instance="Main.belt[2]")),
    ],
)
def test_ranges_are_read(text: str, range: Range) -> None:
    assert parse_range(text) == range


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("Belt:x", "`x` is no line"),
        ("Belt:0-3", "`0` is no line"),
        ("Belt:9-3", "line 3 is before line 9"),
        (":3", "names no POU"),
        ("@Main.belt[1]", "names no POU"),
    ],
)
def test_what_is_no_range(text: str, message: str) -> None:
    with pytest.raises(BadRange, match=message):
        parse_range(text)


@pytest.mark.parametrize(
    ("text", "title", "lines"),
    [
        ("", "the whole scan", []),
        ("belt", "Belt", [3, 4, 7]),
        ("Belt:3-4", "Belt, lines 3 to 4", [3, 4]),
        ("MAIN.ST:4", "Belt, line 4", [4]),
        ("main.st:12-20", "Main, lines 12 to 20", [12, 13]),
        ("Belt:4@main.belt[2]", "Belt, line 4, in Main.belt[2]", [4]),
    ],
)
def test_what_ranges_mean(text: str, title: str, lines: list[int]) -> None:
    found = resolved(text)
    sites = sites_of(program(SOURCE))
    assert (found.title.casefold(), found.note) == (title.casefold(), "")
    assert sorted(sites.statements[site].span.line for site in found.sites) == lines


def test_instances_are_listed() -> None:
    assert resolved("Belt").instances == ("Main.belt[1]", "Main.belt[2]")
    assert resolved("Belt@Main.belt[2]").instances == ("Main.belt[2]",)


@pytest.mark.parametrize(("text", "line"), [("Belt:6", 7), ("Belt:8", 7), ("Belt:5", 7), ("main.st:1", 3)])
def test_lines_without_a_statement_are_moved_and_that_is_said(text: str, line: int) -> None:
    found = resolved(text)
    sites = sites_of(program(SOURCE))
    assert {sites.statements[site].span.line for site in found.sites} == {line}
    assert f"line {line} was taken" in found.note


@pytest.mark.parametrize(
    ("text", "message", "near"),
    [
        ("Bellt", "no POU `Bellt` runs in this program. Did you mean `Belt`", ("Belt",)),
        ("main.st:3-12", "a range is in one POU, and these lines are in 2: Belt, Main", ("Belt", "Main")),
        ("mian.st:3", "no statement of `mian.st` runs in this program. Did you mean `main.st`", ("main.st",)),
        ("Belt@Main.belt[3]", "outside of 1..2", ()),
        ("main.st:400-401", "lines 400 to 401: the last statement of main.st ends in line 13", ()),
        ("Belt:15", "line 15: the last statement of main.st ends in line 13", ()),
        ("Belt@Main", "Main is no instance of Belt", ()),
        ("Belt@Main.blet", "has no member `blet`", ("Main.belt",)),
    ],
)
def test_what_there_is_instead(text: str, message: str, near: tuple[str, ...]) -> None:
    with pytest.raises(BadRange) as refused:
        resolved(text)
    assert message in str(refused.value)
    assert set(near) <= set(refused.value.near)


def test_lines_that_the_file_does_not_have() -> None:
    made = program(SOURCE)

    def asked(range: Range) -> Resolved:
        return resolve_range(made, sites_of(made), range, lambda file: 20)

    assert "line 13 was taken" in asked(Range(file="main.st", first=20, last=30)).note
    found = asked(Range(pou="Main", first=12, last=999))
    assert found.title.endswith(", lines 12 to 20")
    assert found.note == "main.st has 20 lines: the range ends with the last of them"
    assert asked(Range(pou="Main", first=12, last=20)).note == ""
    with pytest.raises(BadRange, match=r"main\.st has 20 lines: there are no lines 21 to 30"):
        asked(Range(file="main.st", first=21, last=30))
    with pytest.raises(BadRange, match=r"main\.st has 20 lines: there is no line 21"):
        asked(Range(pou="Belt", first=21, last=21))
    with pytest.raises(BadRange, match="lines 3 to 4 of what"):
        asked(Range(first=3, last=4))
