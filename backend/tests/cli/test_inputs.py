"""What is said of a file that cannot be read: the same by every command."""

from pathlib import Path

import pytest
from typer.testing import CliRunner

from scanbench.cli.commands import app


@pytest.mark.parametrize(
    "command",
    ["replay {}", "check {}", "run {} --scans 1", "verify {}", "diff {} {}", "errors compare {} {}", "errors sweep {}"],
)
def test_a_file_that_is_not_there(command: str, tmp_path: Path) -> None:
    path = tmp_path / "missing.scanrun"
    result = CliRunner().invoke(app, command.format(path, path).split())
    assert result.exit_code == 2
    assert result.stderr == f"scanbench: {path} does not exist\n"


@pytest.mark.parametrize("command", ["replay {}", "errors compare {} {}"])
def test_a_folder_in_the_place_of_a_file(command: str, tmp_path: Path) -> None:
    result = CliRunner().invoke(app, command.format(tmp_path, tmp_path).split())
    assert result.exit_code == 2
    assert result.stderr == f"scanbench: {tmp_path} cannot be read: Is a directory\n"
