"""JUnit of the commands that find something: the totals are those of the cases, and what was not looked at is no success."""

from dataclasses import dataclass
from pathlib import Path

import pytest
from lxml import etree

from tests.cli.calling import scanbench

SOURCE = """
FUNCTION_BLOCK Ramp
VAR_INPUT target : INT; END_VAR VAR_OUTPUT speed : INT; END_VAR
  speed := speed + target;
END_FUNCTION_BLOCK
PROGRAM Main
VAR n, ix : INT; list : ARRAY[0..9] OF INT; ramp : Ramp; END_VAR
  n := n + 1;
  list[ix] := n;
  IF n < 0 THEN
    ramp(target := n);
  END_IF;
END_PROGRAM
"""


@dataclass(frozen=True, slots=True)
class Read:
    """Of each case of a report what came of it, and what a build server shows."""

    outcomes: dict[str, str]
    messages: dict[str, str]


@pytest.fixture
def program(tmp_path: Path) -> str:
    file = tmp_path / "main.st"
    file.write_text(SOURCE)
    return str(file)


@pytest.fixture
def report(tmp_path: Path) -> Path:
    return tmp_path / "report.xml"


def told(report: Path) -> Read:
    """The cases; the totals of the suite are theirs."""
    root = etree.parse(report).getroot()
    outcomes, messages = {}, {}
    for case in root.findall(".//testcase"):
        name, found = str(case.get("name")), [each for each in case if each.tag != "system-out"]
        outcomes[name] = str(found[0].tag) if found else "passed"
        messages[name] = str(found[0].get("message")) if found else ""
    said = {"tests": len(outcomes)} | {
        total: list(outcomes.values()).count(one)
        for total, one in (("failures", "failure"), ("errors", "error"), ("skipped", "skipped"))
    }
    for each in (root, root[0]):
        assert {name: int(str(each.get(name))) for name in said} == said
    return Read(outcomes, messages)


def recorded(program: str, path: Path, *arguments: str) -> str:
    scanbench("run", program, "--model", "CJ1M-CPU63", "--scans", "40", "--record", str(path), *arguments)
    return str(path)


def test_a_run(program: str, report: Path) -> None:
    for arguments, code, ran, taken in (
        ((), 0, "passed", "passed"),
        (("--set", "Main.ix=12@5"), 4, "failure", "passed"),
        (("--until", "Main.n > 500"), 2, "failure", "passed"),
        (("--model", "CJ1M-CPU63", "--mode", "RUN@3", "--set", "Main.n=7@5"), 2, "passed", "error"),
    ):
        said = scanbench("run", program, "--scans", "40", "--junit", str(report), *arguments)
        assert said.returncode == code, said.stderr
        assert list(told(report).outcomes.values()) == [ran, taken], arguments
    scanbench("run", program, "--scans", "40", "--junit", str(report), "--set", "Main.ix=12@5")
    assert told(report).messages["the program runs"].endswith("in scan 5")
    assert ":9:" in told(report).messages["the program runs"]


def test_a_verification(program: str, report: Path) -> None:
    for arguments, code, outcomes in (
        ((), 0, ["passed", "passed"]),
        (("--range", "Ramp"), 2, ["error", "skipped"]),  # it is never called
        (("--set", "Main.ix=12@5"), 4, ["error", "passed"]),  # scans 6 to 39 did not run
    ):
        said = scanbench("verify", program, "--scans", "..39", "--junit", str(report), *arguments)
        assert said.returncode == code, said.stderr
        assert list(told(report).outcomes.values()) == outcomes, arguments


def test_a_disturbed_verification(program: str, report: Path, tmp_path: Path) -> None:
    hit = str(tmp_path / "hit.scanrun")
    said = scanbench("verify", program, "--scans", "..39")
    assert said.returncode == 0
    for number in range(1, 30):  # the first one that the verification notices
        scanbench(
            "campaign",
            program,
            "--scans",
            "5..30",
            "--count",
            "30",
            "--kind",
            "flip",
            "--only",
            str(number),
            "--record",
            hit,
        )
        said = scanbench("verify", hit, "--junit", str(report))
        if said.returncode == 1:
            break
    (whole, same) = told(report).outcomes.items()
    assert (whole[1], same[1]) == ("passed", "failure")
    assert told(report).messages[same[0]] in said.stdout


def test_two_runs(program: str, report: Path, tmp_path: Path) -> None:
    one, other = (
        recorded(program, tmp_path / "a.scanrun"),
        recorded(program, tmp_path / "b.scanrun", "--set", "Main.n=7@9"),
    )
    assert scanbench("diff", one, one, "--junit", str(report)).returncode == 0
    assert list(told(report).outcomes.values()) == ["passed", "passed"]
    assert scanbench("diff", one, other, "--junit", str(report)).returncode == 1
    assert told(report).outcomes == {"the runs are the same": "failure", "all of both runs is compared": "passed"}
    assert told(report).messages["the runs are the same"].startswith("after scan 9: ")


def test_a_run_that_is_replayed(program: str, report: Path, tmp_path: Path) -> None:
    run = Path(recorded(program, tmp_path / "a.scanrun", "--set", "Main.n=7@9"))
    assert scanbench("replay", str(run), "--junit", str(report)).returncode == 0
    assert list(told(report).outcomes.values()) == ["passed", "passed"]
    content = bytearray(run.read_bytes())
    content[-40] ^= 1
    run.write_bytes(content)
    assert scanbench("replay", str(run), "--junit", str(report)).returncode == 4
    assert list(told(report).outcomes.values()) == ["passed", "error"]


def test_scenarios(program: str, report: Path, tmp_path: Path) -> None:
    texts = {
        "good": "project: .\nscans: 9\nexpect: [{after: 9, holds: Main.n = 9}]\n",
        "bad": "project: .\nscans: 9\nexpect: [{after: 9, holds: Main.n = 8}]\n",
        "empty": "project: .\nscans: 9\n",
    }
    files = [tmp_path / f"{name}.scenario.yaml" for name in texts]
    for file, text in zip(files, texts.values(), strict=True):
        file.write_text(text)
    assert scanbench("scenario", "run", *map(str, files), "--junit", str(report)).returncode == 1
    assert list(told(report).outcomes.values()) == ["passed", "failure", "skipped"]
    assert "Main.n" in told(report).messages[str(files[1])]


def test_a_check(program: str, report: Path) -> None:
    assert scanbench("check", program, "--junit", str(report)).returncode == 0
    assert told(report).outcomes == {program: "passed"}
    Path(program).write_text(SOURCE.replace("list[ix] := n;", "list[ix] := nothing;"))
    assert scanbench("check", program, "--junit", str(report)).returncode == 1
    assert told(report).outcomes == {program: "failure"}
    assert "nothing" in told(report).messages[program]


def test_a_report_without_a_place_is_refused_first(program: str, tmp_path: Path) -> None:
    nowhere = str(tmp_path / "none" / "report.xml")
    for command in (
        ("run", program, "--scans", "9"),
        ("verify", program),
        ("check", program),
        ("diff", program, program),
        ("replay", program),
    ):
        said = scanbench(*command, "--junit", nowhere)
        assert (said.returncode, "cannot be written" in said.stderr) == (2, True), said


def test_values_outside_of_subranges_are_told_with_the_variable_of_the_caller_and_the_calls(
    tmp_path: Path, report: Path
) -> None:
    program = tmp_path / "fill.st"
    program.write_text(
        "FUNCTION Put : INT\nVAR_INPUT x : INT; END_VAR\nVAR_IN_OUT l : INT (0..10); END_VAR\nl := x;\nEND_FUNCTION\n"
        "PROGRAM Main\nVAR level : INT (0..10); n : INT; END_VAR\nn := Put(12, level);\nEND_PROGRAM\n"
    )
    said = scanbench("run", str(program), "--scans", "3", "--junit", str(report))
    line = f"subrange: Main.level (here l) in Put was 12, outside of 0..10; called from Main {program}:8, 3 times, scans 0 to 2"
    assert line in said.stderr
    (text,) = (str(each.text) for each in etree.parse(report).getroot().iter("system-out"))
    assert text.endswith(line)
