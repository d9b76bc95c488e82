"""How tests call `scanbench`: in this process, where starting one takes longer than what is called; or as the command a user has."""

import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from typer.testing import CliRunner

from scanbench.cli.commands import app

SCANBENCH = Path(sys.executable).parent / "scanbench"


@dataclass
class Said:
    """What a command printed, and its exit code."""

    returncode: int
    stdout: str
    stderr: str


def scanbench(*args: str) -> Said:
    """In this process; what is no exit of the command is raised here."""
    result = CliRunner().invoke(app, args)
    if result.exception is not None and not isinstance(result.exception, SystemExit):
        raise result.exception
    return Said(result.exit_code, result.stdout, result.stderr)


def process(*args: str, command: tuple[str, ...] = (str(SCANBENCH),)) -> Said:
    """As the installed command; another one may be given."""
    done = subprocess.run([*command, *args], capture_output=True, text=True, timeout=120, check=False)
    return Said(done.returncode, done.stdout, done.stderr)
