"""Ctrl-C while a command runs scans: what has run so far is told, and the exit code is 130."""

import json
import signal
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from scanbench.cli.commands import app
from scanbench.engines.engine import Engine, Pace, Stop
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.engine import NativeEngine
from scanbench.faults.reaction.sweep import Cell

ERRORS = import_module("scanbench.cli.errors")  # of the package, `errors` is the command
SOURCE = """PROGRAM Main
VAR n : DINT; battery AT A402.04 : BOOL; END_VAR
  n := n + 1;
END_PROGRAM
"""
FOREVER = "9000000000"


@pytest.fixture
def project(tmp_path: Path) -> Path:
    folder = tmp_path / "line"
    folder.mkdir()
    (folder / "main.st").write_text(SOURCE, "utf-8")
    (folder / "project.json").write_text('{"model": "CJ1M-CPU63"}', "utf-8")
    return folder


def call(*arguments: object) -> Result:
    return CliRunner().invoke(app, list(map(str, arguments)))


def interrupt(monkeypatch: pytest.MonkeyPatch, of: type[Engine], calls: int) -> None:
    """Ctrl-C in so many calls of the engine."""
    run, called = of.run, 0

    def run_on(self: Engine, scans: int, pace: Pace | None = None) -> Stop:
        nonlocal called
        called += 1
        if called == calls:
            signal.raise_signal(signal.SIGINT)
        return run(self, scans, pace)

    monkeypatch.setattr(of, "run", run_on)


@pytest.mark.parametrize(
    ("kind", "engine"), [("native", NativeEngine), ("reference", ReferenceEngine), ("both", NativeEngine)]
)
def test_a_run_ends_with_what_it_has(
    project: Path, monkeypatch: pytest.MonkeyPatch, kind: str, engine: type[Engine]
) -> None:
    interrupt(monkeypatch, engine, calls=2)
    said = call("run", project, "--scans", FOREVER, "--every", 7, "--print", "Main.n", "--engine", kind, "--json")
    assert said.exit_code == 130, said.output
    told = json.loads(said.stdout)
    assert 0 < told["scans"] < int(FOREVER)
    assert told["values"]["Main.n"] == told["scans"]
    assert f"interrupted after {told['scans']:,} scans" in said.stderr


def test_an_interrupted_run_keeps_its_recording(project: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    record = tmp_path / "a.scanrun"
    with monkeypatch.context() as patched:
        interrupt(patched, NativeEngine, calls=3)
        said = call("run", project, "--scans", FOREVER, "--record", record, "--json")
    assert said.exit_code == 130, said.output
    replayed = call("replay", record, "--json")
    assert replayed.exit_code == 0, replayed.output
    assert json.loads(replayed.stdout)["scan"] == json.loads(said.stdout)["scans"]


def test_a_replay_tells_how_far_it_was_the_same(project: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    record = tmp_path / "a.scanrun"
    assert call("run", project, "--scans", "100", "--record", record).exit_code == 0
    interrupt(monkeypatch, NativeEngine, calls=1)
    said = call("replay", record)
    assert said.exit_code == 130, said.output
    assert "interrupted: the same up to scan 0, in 1 checkpoint" in said.stderr
    assert said.stdout == ""


def test_a_verification_that_is_not_begun_says_so(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where scans are verified, what was verified so far is reported: `test_verify.py`."""
    interrupt(monkeypatch, NativeEngine, calls=1)
    said = call("verify", project, "--scans", f"0..{FOREVER}")
    assert said.exit_code == 130, said.output
    assert "interrupted before the first scan was verified" in said.stderr


def test_a_sweep_tells_the_errors_it_has_tried(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def two(*given: object, rules: object) -> Iterator[Cell]:
        yield Cell("battery-error", "Start", None, "so far")
        signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr(ERRORS, "sweep_side_by_side", two)
    said = call("errors", "sweep", project, "--json")
    assert said.exit_code == 130, said.output
    assert [each["id"] for each in json.loads(said.stdout)["results"]] == ["battery-error"]
    assert "interrupted after 1 of " in said.stderr
