"""The extension for VS Code can be packed: `vsce` refuses links to what is not in the package, and warns without a licence."""

import json
import re
from pathlib import Path

ROOT = Path(__file__).parents[3]
VSCODE = ROOT / "vscode"


def test_its_page_has_no_links_to_other_folders() -> None:
    links = re.findall(r"\]\(([^)]+)\)", (VSCODE / "README.md").read_text("utf-8"))
    assert [link for link in links if not link.startswith("https://")] == []


def test_what_goes_into_it_is_there() -> None:
    package = json.loads((VSCODE / "package.json").read_text("utf-8"))
    assert (VSCODE / "LICENSE").read_text() == (ROOT / "LICENSE").read_text()
    assert all((VSCODE / name).is_file() for name in package["files"])
    assert str(Path(package["main"])) in package["files"]
