"""Logs with columns that lack values: what was not compared, or not given, is no proof, for the exit code and for build servers alike."""

from pathlib import Path

import pytest
from lxml import etree

from tests.cli.calling import scanbench

SOURCE = """PROGRAM Main
VAR start, stop : BOOL; motor : BOOL; n : INT; END_VAR
  motor := start AND NOT stop;
  n := n + 1;
END_PROGRAM
"""
ALL, GIVEN = "the whole scan: all scans are compared", "the whole scan: all inputs have values"
LATER = "the whole scan: all scans after the first are compared"
MOTOR, N = "output Main.motor", "output Main.n"
WHOLE = ("0,0,0,0,1", "1,1,0,1,2", "2,1,0,1,3")


@pytest.mark.parametrize(
    ("rows", "code", "wrong"),
    [
        (WHOLE, 0, {}),
        (("10,0,0,0,11", "11,1,0,1,12"), 0, {}),
        (("0,,,0,1", "1,,,0,2", "2,,,0,3"), 4, {GIVEN: "error"}),
        (("0,,,0,1", "1,1,0,1,2"), 4, {GIVEN: "error"}),
        (("0,0,,0,1", "1,1,,1,2"), 4, {GIVEN: "error"}),
        (("0,0,0,,1", "1,1,0,,2"), 4, {MOTOR: "error"}),
        (("0,0,0,0,1", "1,1,0,,2", "2,1,0,1,3"), 4, {MOTOR: "error"}),
        (("0,,,0,1", "1,,,0,7"), 1, {GIVEN: "error", "the whole scan: no difference": "failure", N: "failure"}),
        ((*WHOLE, "3,1,0,0,4"), 1, {"the whole scan: no difference": "failure", MOTOR: "failure"}),
    ],
)
def test_what_has_no_value_is_no_proof(rows: tuple[str, ...], code: int, wrong: dict[str, str], tmp_path: Path) -> None:
    source, trace, junit = tmp_path / "main.st", tmp_path / "x.csv", tmp_path / "x.xml"
    source.write_text(SOURCE)
    trace.write_text("\n".join(("scan,start,stop,motor,n", *rows, "")))
    ran = scanbench("verify", str(source), "--trace", str(trace), "--junit", str(junit))
    assert ran.returncode == code, ran
    cases = {each.get("name"): [one.tag for one in each] for each in etree.parse(junit).getroot().iter("testcase")}
    found = {name: tags[0] for name, tags in cases.items() if tags and tags[0] != "system-out"}
    assert found == wrong
    assert (LATER if rows[0].startswith("10") else ALL) in cases
    assert ("no difference in what was compared" in ran.stdout) == (
        (MOTOR in wrong and code == 4) or rows[0][:2] == "10"
    )
    assert ("1 inputs" in ran.stdout, "1 row differ:" in ran.stdout) == (False, False)
