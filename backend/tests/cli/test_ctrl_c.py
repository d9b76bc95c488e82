"""Ctrl-C as the terminal sends it: the command ends at once, without a traceback, and no process is left."""

import os
import signal
import subprocess
import sys
import threading
from pathlib import Path

import pytest

from scanbench.cli.interrupt import leaving

COMMAND = [sys.executable, "-c"]
AT_ONCE = """
import signal, sys
from scanbench.cli import main
sys.argv = ["scanbench", *sys.argv[1:]]
"""
IN_A_BUILD = (
    AT_ONCE
    + """
import threading
from scanbench.engines.native import engine

def compiling(*args):
    print("compiling", file=sys.stderr, flush=True)
    threading.Event().wait()

engine.NativeEngine.__init__ = compiling
main()
"""
)
"""A build that never ends, as LLVM does not look at signals."""
IN_AN_IMPORT = (
    AT_ONCE
    + """
import builtins
real = builtins.__import__

def slow(name, *rest, **more):
    if name in ("scanbench.check.build", "scanbench.web.framing", "scanbench.web.public_url"):  # what the commands import
        print("importing", file=sys.stderr, flush=True)
        signal.pause()
    return real(name, *rest, **more)

builtins.__import__ = slow
main()
"""
)


def interrupted(script: str, *args: str, cwd: Path) -> tuple[int, str]:
    """Exit code and what it said, of a command that gets Ctrl-C, as does everything it started, once it has said a line."""
    with subprocess.Popen(
        [*COMMAND, script, *args], cwd=cwd, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        text=True, start_new_session=True,
    ) as process:  # fmt: skip
        assert process.stderr is not None
        process.stderr.readline()  # the debug adapter keeps its standard output for itself
        os.killpg(process.pid, signal.SIGINT)
        said, told = process.communicate()  # until nobody has the streams any more: no child is left
        return process.returncode, said + told


@pytest.fixture
def project(tmp_path: Path) -> Path:
    (tmp_path / "main.st").write_text("PROGRAM Main VAR n : INT; END_VAR n := n + 1; END_PROGRAM\n")
    return tmp_path


def test_while_a_program_is_compiled(project: Path) -> None:
    code, said = interrupted(
        IN_A_BUILD, "run", "main.st", "--scans", "9000000000", "--record", "a.scanrun", cwd=project
    )
    assert (code, said) == (130, "")
    assert not (project / "a.scanrun").exists(), "of a run that did not begin no file is left"


@pytest.mark.parametrize("command", ["run", "verify", "errors", "dap", "lsp", "serve"])
def test_while_a_command_is_loaded(project: Path, command: str) -> None:
    code, said = interrupted(IN_AN_IMPORT, command, cwd=project)
    assert (code, said) == (130, "")


def test_what_is_made_apart_comes_back_as_it_is() -> None:
    here = threading.current_thread()

    def other(value: int) -> tuple[int, bool]:
        return value, threading.current_thread() is here

    def broken() -> None:
        raise LookupError("what was raised there")

    assert leaving(other)(7) == (7, False)
    with pytest.raises(LookupError, match="what was raised there"):
        leaving(broken)()
