"""Lock files: exact, with hashes, and without the address of any registry."""

import json
import re
from pathlib import Path
from typing import cast

import pytest

ROOT = Path(__file__).parents[3]
PYTHON_LOCKS = sorted((ROOT / "backend").glob("*.lock"))
NODE_LOCKS = [path for path in ROOT.glob("**/package-lock.json") if "node_modules" not in path.parts]


def names(text: str) -> set[str]:
    found = re.findall(r"^([A-Za-z0-9][A-Za-z0-9._-]*)", text, re.MULTILINE)
    return {re.sub(r"[-_.]+", "-", name).lower() for name in found}


@pytest.mark.parametrize("path", PYTHON_LOCKS, ids=lambda path: path.name)
def test_python_locks_are_exact_and_carry_no_address(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    assert "://" not in text
    assert not re.search(r"^\s*--(?!hash=sha256:)", text, re.MULTILINE)
    entries = [entry for entry in re.split(r"\n(?=[a-zA-Z0-9])", text) if entry[0].isalnum()]
    assert entries
    for entry in entries:
        assert re.match(r"[a-z0-9.-]+==[^\s]+ ", entry), entry.splitlines()[0]
        assert "--hash=sha256:" in entry, entry.splitlines()[0]
    wanted = path.with_suffix(".in").read_text(encoding="utf-8")
    assert names(wanted) <= names(text), "run `make lock`"


def test_every_dependency_says_why() -> None:
    for path in sorted((ROOT / "backend").glob("*.in")):
        for line in path.read_text(encoding="utf-8").splitlines():
            if line and line[0].isalpha():
                assert re.search(r"\s# \w", line), f"{path.name}: {line}"


def test_the_node_roots_are_locked() -> None:
    assert {str(path.parent.relative_to(ROOT)) for path in NODE_LOCKS} >= {"frontend", "e2e"}


@pytest.mark.parametrize("path", NODE_LOCKS, ids=lambda path: str(path.parent.relative_to(ROOT)))
def test_node_locks_carry_no_address(path: Path) -> None:
    assert "omit-lockfile-registry-resolved=true" in (path.parent / ".npmrc").read_text(encoding="utf-8")
    for name, entry in packages(path).items():
        assert "resolved" not in entry, name
        assert not name or entry.get("link") or "integrity" in entry, name


@pytest.mark.parametrize("path", NODE_LOCKS, ids=lambda path: str(path.parent.relative_to(ROOT)))
def test_node_locks_are_complete_for_every_platform(path: Path) -> None:
    """npm leaves out the optional part for another platform that its registry does not have; `npm ci` then refuses."""
    locked = packages(path)
    for name, entry in locked.items():
        optional = entry.get("optionalDependencies", {})
        assert isinstance(optional, dict)
        for part in optional:
            assert any(key.endswith(f"node_modules/{part}") for key in locked), f"{part}, wanted by {name}"


def packages(path: Path) -> dict[str, dict[str, object]]:
    lock = json.loads(path.read_text(encoding="utf-8"))
    return cast("dict[str, dict[str, object]]", lock["packages"])
