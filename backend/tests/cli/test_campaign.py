"""`scanbench campaign`: exit codes, JSON and JUnit, and one of its disturbances once more."""

import json
from pathlib import Path

import pytest
from lxml import etree
from typer.testing import CliRunner, Result

from scanbench.cli.commands import app

SOURCE = """
VAR_GLOBAL lamp AT CIO100.00 : BOOL; END_VAR
PROGRAM Main
VAR n, half : INT; alarm : BOOL; END_VAR
  n := (n + 1) MOD 100;
  half := n / 2;
  IF half > n THEN alarm := TRUE; END_IF;
  lamp := n > 50;
END_PROGRAM
"""
FEW = ("--count", "12", "--seed", "4", "--scans", "10..80", "--window", "20")


@pytest.fixture
def program(tmp_path: Path) -> str:
    file = tmp_path / "main.st"
    file.write_text(SOURCE)
    return str(file)


def campaign(*arguments: str) -> Result:
    return CliRunner().invoke(app, ["campaign", *arguments])


def test_what_came_of_each_is_told_in_every_form(program: str, tmp_path: Path) -> None:
    junit = tmp_path / "campaign.xml"
    ran = campaign(program, "--model", "CJ1M-CPU63", *FEW, "--alarm", "Main.alarm", "--json", "--junit", str(junit))
    assert ran.exit_code == 0, ran.output
    told = json.loads(ran.stdout)
    assert (told["format"], told["seed"], told["first"], told["last"], len(told["trials"])) == (1, 4, 10, 80, 12)
    assert sum(told["outcomes"].values()) == 12
    assert told["findings"] == []
    cases = etree.parse(str(junit)).findall(".//testcase")
    assert [each.get("name") for each in cases] == [f"{each['number']}: {each['text']}" for each in told["trials"]]
    required = campaign(
        program, "--model", "CJ1M-CPU63", *FEW, "--require", "program", "--json", "--junit", str(junit)
    )  # fmt: skip
    silent = [each["number"] for each in told["trials"] if each["silent"]]
    assert silent
    assert json.loads(required.stdout)["findings"] == silent
    assert required.exit_code == 1
    assert len(etree.parse(str(junit)).findall(".//failure")) == len(silent)


def test_one_is_tried_again_and_its_run_kept(program: str, tmp_path: Path) -> None:
    whole = json.loads(campaign(program, "--model", "CJ1M-CPU63", *FEW, "--json").stdout)["trials"]
    hit = next(each for each in whole if each["verification"])
    kept = tmp_path / "hit.scanrun"
    again = campaign(program, "--model", "CJ1M-CPU63", *FEW, "--only", str(hit["number"]), "--record", str(kept))
    assert again.exit_code == 0, again.output
    assert hit["verification"] in again.output
    verified = CliRunner().invoke(app, ["verify", str(kept), "--scans", f"{hit['scan']}..{hit['scan']}"])
    assert verified.exit_code == 1, verified.output
    assert hit["verification"] in verified.output


def test_a_recorded_run_is_disturbed_too(program: str, tmp_path: Path) -> None:
    record = str(tmp_path / "a.scanrun")
    ran = CliRunner().invoke(app, ["run", program, "--model", "CJ1M-CPU63", "--scans", "120", "--record", record])
    assert ran.exit_code == 0, ran.output
    of_run = json.loads(campaign(record, *FEW, "--json").stdout)["trials"]
    assert of_run == json.loads(campaign(program, "--model", "CJ1M-CPU63", *FEW, "--json").stdout)["trials"]


def test_what_makes_no_sense_is_refused(program: str, tmp_path: Path) -> None:
    for arguments, message in (
        (("--scans", "x"), "write A..B"),
        (("--count", "0"), "number of disturbances is 0"),
        (("--alarm", "Main.nowhere"), "nowhere"),
        (("--record", str(tmp_path / "x.scanrun")), "name its number with --only"),
        (("--only", "999"), "there is no disturbance 999"),
    ):
        refused = campaign(program, "--model", "CJ1M-CPU63", *arguments)
        assert refused.exit_code == 2, (arguments, refused.output)
        assert message in refused.output
