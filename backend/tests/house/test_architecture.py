"""What ARCHITECTURE.md, CONTRIBUTING.md and the READMEs of the rooms name is there: each file, and each function, class or constant in it."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
PYTHON, PAGE = ROOT / "backend" / "scanbench", ROOT / "frontend" / "src"
NAMED = re.compile(r"`([\w/]+\.(?:py|tsx?))(?:::([\w.]+))?`")
PLACES = (PYTHON, PAGE, ROOT, ROOT / "frontend", ROOT / "backend")
ROOMS = sorted(path.parent for path in PYTHON.rglob("README.md"))
EXAMPLE = "0009_what.py"
"""The name of a file that somebody would add."""


def named_in(page: Path) -> list[tuple[str, str]]:
    return sorted(set(NAMED.findall(page.read_text("utf-8"))))


def named() -> list[tuple[str, str]]:
    return sorted({each for page in ("ARCHITECTURE.md", "CONTRIBUTING.md") for each in named_in(ROOT / page)})


@pytest.mark.parametrize(("path", "name"), named(), ids=lambda part: part or "file")
def test_it_is_there(path: str, name: str) -> None:
    has(next((folder / path for folder in PLACES if (folder / path).is_file()), None), path, name)


@pytest.mark.parametrize("room", ROOMS, ids=lambda room: str(room.relative_to(PYTHON)))
def test_what_a_room_names_is_in_it_or_in_the_house(room: Path) -> None:
    folders = (room, *(each for each in room.rglob("*") if each.is_dir()), *PLACES)
    for path, name in named_in(room / "README.md"):
        if path != EXAMPLE:
            has(next((folder / path for folder in folders if (folder / path).is_file()), None), path, name)


def has(file: Path | None, path: str, name: str) -> None:
    assert file is not None, f"{path} is no file"
    text = file.read_text("utf-8")
    for part in name.split(".") if name else ():
        assert re.search(rf"\b(?:def|class|function|const) {part}\b|^{part} = |^{part}: ", text, re.MULTILINE), (
            f"{path} has no {part}"
        )
