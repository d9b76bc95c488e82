"""What ARCHITECTURE.md and CONTRIBUTING.md name is there: each file, and each function, class or constant in it."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
PYTHON, PAGE = ROOT / "backend" / "scanbench", ROOT / "frontend" / "src"
NAMED = re.compile(r"`([\w/]+\.(?:py|tsx?))(?:::([\w.]+))?`")


def named() -> list[tuple[str, str]]:
    texts = [(ROOT / name).read_text("utf-8") for name in ("ARCHITECTURE.md", "CONTRIBUTING.md")]
    return sorted({(path, name) for text in texts for path, name in NAMED.findall(text)})


@pytest.mark.parametrize(("path", "name"), named(), ids=lambda part: part or "file")
def test_it_is_there(path: str, name: str) -> None:
    places = [folder / path for folder in (PYTHON, PAGE, ROOT, ROOT / "frontend")]
    file = next((place for place in places if place.is_file()), None)
    assert file is not None, f"{path} is no file"
    text = file.read_text("utf-8")
    for part in name.split(".") if name else ():
        assert re.search(rf"\b(?:def|class|function|const) {part}\b|^{part} = ", text, re.MULTILINE), (
            f"{path} has no {part}"
        )
