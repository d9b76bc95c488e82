"""The house itself: every room says what it is for, licence and entry points are there."""

import os
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
PACKAGE = ROOT / "backend" / "scanbench"
ROOMS = sorted(path.parent for path in PACKAGE.glob("*/__init__.py"))
FOLDERS = [
    ROOT / name
    for name in ("backend", "backend/bench", "backend/tests", "docker", "e2e", "frontend", "models", "vscode")
]


@pytest.mark.parametrize("room", [*ROOMS, *FOLDERS], ids=lambda path: str(path.relative_to(ROOT)))
def test_every_room_has_a_short_readme(room: Path) -> None:
    readme = room / "README.md"
    assert readme.is_file(), (
        f"{room.relative_to(ROOT)} has no README.md: what lives here, how to add, what does not belong"
    )
    lines = readme.read_text(encoding="utf-8").splitlines()
    assert lines[0].startswith("# ")
    assert 4 <= len(lines) <= 60


def test_the_licence_is_apache() -> None:
    text = (ROOT / "LICENSE").read_text(encoding="utf-8")
    assert "Apache License" in text
    assert "Version 2.0" in text


@pytest.mark.parametrize("script", [".ci/run", ".ci/steps", "docker/start"])
def test_scripts_can_be_executed(script: str) -> None:
    assert os.access(ROOT / script, os.X_OK)


def test_the_integration_runs_what_everybody_runs() -> None:
    assert "make test" in (ROOT / ".ci" / "run").read_text(encoding="utf-8").splitlines()
