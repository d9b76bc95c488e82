"""The command itself: completion in the shell, and where it runs."""

import sys

import pytest
from typer.testing import CliRunner

from scanbench.cli import main
from scanbench.cli.commands import app


@pytest.mark.parametrize(
    ("typed", "offered"),
    [
        ("ver", ["verify"]),
        ("errors ", ["list", "sweep", "compare", "present", "log", "clear"]),
        ("run --sc", ["--scans"]),
        ("run --engine n", ["native"]),
    ],
)
def test_the_shell_completes_commands_options_and_values(typed: str, offered: list[str]) -> None:
    words = ["scanbench", *typed.split(" ")]
    environment = {
        "_SCANBENCH_COMPLETE": "complete_bash",
        "COMP_WORDS": " ".join(words),
        "COMP_CWORD": str(len(words) - 1),
    }
    said = CliRunner().invoke(app, [], env=environment, prog_name="scanbench")
    assert said.stdout.split() == offered


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_it_shows_what_a_shell_has_to_load(monkeypatch: pytest.MonkeyPatch, shell: str) -> None:
    monkeypatch.setattr("shellingham.detect_shell", lambda: (shell, f"/bin/{shell}"))
    said = CliRunner().invoke(app, ["--show-completion"], prog_name="scanbench")
    assert said.exit_code == 0, said.output
    assert "_SCANBENCH_COMPLETE" in said.stdout


def test_elsewhere_it_says_where_it_runs(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr(sys, "platform", "darwin")
    monkeypatch.setattr(sys, "argv", ["scanbench", "check", "main.st"])
    with pytest.raises(SystemExit) as ended:
        main()
    assert ended.value.code == 2
    assert "runs on Linux" in capsys.readouterr().err
