"""`scanbench errors present` and `log` of a recorded run, as it was at a scan."""

import json
from pathlib import Path

import pytest

from tests.cli.calling import scanbench

SOURCE = """\
PROGRAM Main
VAR n : INT; END_VAR
  n := n + 1;
  IF n = 3 THEN FAL(N := 42, S := 'PUMP HOT'); MSG(3, 'TANK FULL'); END_IF;
  IF n = 9 THEN FALS(7); END_IF;
END_PROGRAM
"""


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> str:
    folder = tmp_path_factory.mktemp("device")
    (folder / "main.st").write_text(SOURCE)
    file = folder / "run.scanrun"
    scanbench("run", str(folder / "main.st"), "--model", "CJ1M-CPU63", "--scans", "20", "--record", str(file))
    return str(file)


def words(text: str) -> list[str]:
    return [" ".join(line.split()) for line in text.splitlines()]


def test_what_is_present_at_the_end_and_at_a_scan(run: str) -> None:
    end = scanbench("errors", "present", "--run", run)
    assert (end.returncode, words(end.stdout)[1:]) == (
        1,
        [
            "C107 fatal fals FALS error FALS number: 7",
            "412A nonfatal fal FAL error FAL number: 42 PUMP HOT",
            "MSG 3: TANK FULL",
        ],
    )
    early = scanbench("errors", "present", "--run", run, "--scan", "2")
    assert (early.returncode, early.stdout) == (0, "no error is present\n")
    middle = json.loads(scanbench("errors", "present", "--run", run, "--scan", "4", "--json").stdout)
    assert (middle["scan"], middle["code"], [each["text"] for each in middle["errors"]]) == (4, "412A", ["PUMP HOT"])


def test_the_log(run: str) -> None:
    assert [line.split()[2] for line in words(scanbench("errors", "log", "--run", run).stdout)[1:]] == ["C107", "412A"]
    assert scanbench("errors", "log", "--run", run, "--scan", "1").stdout == "the error log is empty\n"


def test_a_model_without_a_log_says_so(tmp_path: Path) -> None:
    (tmp_path / "main.st").write_text("PROGRAM Main\nVAR n : INT; END_VAR\nn := n + 1;\nEND_PROGRAM\n")
    file = str(tmp_path / "run.scanrun")
    scanbench("run", str(tmp_path / "main.st"), "--model", "NJ501-1300", "--scans", "2", "--record", file)
    assert scanbench("errors", "log", "--run", file).stdout == "this model has no error log in its memory\n"


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ((), "name a PLC"),
        (("line-1", "--run", "x"), "not both"),
        (("line-1", "--scan", "3"), "--scan goes with --run"),
        (("line-1", "--server", "http://127.0.0.1:1"), "does not answer"),
        (("--run", "nowhere.scanrun"), "nowhere.scanrun"),
    ],
)
def test_wrong_usage(options: tuple[str, ...], said: str) -> None:
    result = scanbench("errors", "present", *options)
    assert result.returncode == 2
    assert said in result.stderr


def test_a_scan_that_is_not_in_the_run(run: str) -> None:
    result = scanbench("errors", "present", "--run", run, "--scan", "99")
    assert result.returncode == 2
    assert "scan 99 is none of them" in result.stderr
