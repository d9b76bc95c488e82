"""`scanbench whatif`: what it prints, its exit codes, and the test that it writes."""

import json
from pathlib import Path

from tests.cli.calling import scanbench

SOURCE = """\
VAR_GLOBAL start AT CIO0.00 : BOOL; speed AT CIO1 : INT; motor AT CIO100.00 : BOOL; END_VAR
PROGRAM Main
  motor := start AND speed >= 37;
END_PROGRAM
"""


def run_of(folder: Path) -> str:
    (folder / "plc").mkdir()
    (folder / "plc" / "main.st").write_text(SOURCE)
    (folder / "plc" / "project.json").write_text('{"name": "Motor", "model": "CJ1M-CPU63"}')
    run = folder / "base.scanrun"
    made = scanbench(
        "run",
        str(folder / "plc"),
        "--model",
        "CJ1M-CPU63",
        "--scans",
        "50",
        "--set",
        "start=TRUE@5",
        "--record",
        str(run),
    )
    assert made.returncode == 0, made
    return str(run)


def test_values_are_tried_and_a_test_is_written(tmp_path: Path) -> None:
    run, test = run_of(tmp_path), tmp_path / "motor.scenario.yaml"
    asked = ("whatif", run, "--scan", "20", "--condition", "motor", "--scans", "3")
    tried = scanbench(*asked, "--vary", "speed=0..40/20,37", "--print", "speed")
    assert (tried.returncode, tried.stdout.splitlines()) == (
        0,
        [
            "as recorded: not met; speed = 0",
            "speed = 0: not met; outputs as recorded; speed = 0",
            "speed = 20: not met; outputs as recorded; speed = 20",
            "speed = 40: met after scan 20; an output differs from scan 20 on; speed = 40",
            "speed = 37: met after scan 20; an output differs from scan 20 on; speed = 37",
        ],
    )
    found = scanbench(*asked, "--change", "start", "--change", "speed", "--test", str(test), "--json")
    assert found.returncode == 0
    result = json.loads(found.stdout)
    assert result["tries"][result["best"]]["values"] == [{"path": "speed", "value": "37"}]
    played = scanbench("scenario", "run", str(test.rename(tmp_path / "plc" / test.name)))
    assert played.returncode == 0, played


def test_what_was_not_met_and_what_cannot_be_asked_have_their_codes(tmp_path: Path) -> None:
    run = run_of(tmp_path)
    assert scanbench("whatif", run, "--scan", "20", "--set", "speed=3", "--condition", "motor").returncode == 1
    wrong = scanbench("whatif", run, "--scan", "20", "--set", "sped=3")
    assert (wrong.returncode, "sped" in wrong.stderr) == (2, True)
    assert scanbench("whatif", str(tmp_path / "none.scanrun"), "--scan", "20", "--set", "speed=3").returncode == 2
