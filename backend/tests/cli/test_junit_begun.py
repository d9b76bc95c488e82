"""A command that is refused leaves no report of the last time, whichever it is."""

from pathlib import Path

import pytest
from lxml import etree

from tests.cli.calling import scanbench

GOOD = "PROGRAM Main VAR n : INT; arr : ARRAY[1..3] OF INT; END_VAR n := n + 1; END_PROGRAM"


@pytest.fixture
def junit(tmp_path: Path) -> Path:
    """The green report of a run."""
    (tmp_path / "main.st").write_text(GOOD)
    (tmp_path / "bad.st").write_text("PROGRAM Main n := ; END_PROGRAM")
    file = tmp_path / "x.xml"
    ran = scanbench("run", str(tmp_path / "main.st"), "--scans", "3", "--junit", str(file))
    assert ran.returncode == 0, ran
    assert errors(file) == 0
    return file


def errors(file: Path) -> int:
    return int(etree.parse(file).getroot().get("errors", "0"))


@pytest.mark.parametrize(
    "args",
    [
        ("run", "main.st", "--set", "Main.arr[9]=3@1"),
        ("run", "bad.st"),
        ("run", "main.st", "--scans", "many"),
        ("run", "none.st"),
        ("verify", "bad.st"),
        ("campaign", "bad.st"),
        ("errors", "sweep", "bad.st"),
        ("scenario", "run", "none.scenario.yaml"),
        ("replay", "none.scanrun"),
        ("diff", "none.scanrun", "main.st"),
        ("check", "none.st"),
    ],
)
def test_a_refused_command_leaves_no_green_report(args: tuple[str, ...], junit: Path, tmp_path: Path) -> None:
    given = [str(tmp_path / each) if each.endswith((".st", ".yaml", ".scanrun")) else each for each in args]
    ran = scanbench(*given, f"--junit={junit}")
    assert ran.returncode not in (0, 3, 4), ran
    assert errors(junit) == 1


def test_what_is_no_report_is_left_alone(junit: Path, tmp_path: Path) -> None:
    scanbench("check", "--junit", str(tmp_path / "main.st"))
    assert (tmp_path / "main.st").read_text() == GOOD
    scanbench("run", "--junit", str(junit), "--help")
    assert errors(junit) == 0
