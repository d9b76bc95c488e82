"""The extension for VS Code can be packed: `vsce` refuses links to what is not in the package, and warns without a licence."""

import io
import json
import re
import zipfile
from pathlib import Path
from xml.etree import ElementTree

from scanbench import __version__
from scanbench.cli.vsix import pack

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


def test_its_version_is_that_of_scanbench() -> None:
    assert json.loads((VSCODE / "package.json").read_text("utf-8"))["version"] == __version__
    assert f"## {__version__}" in (ROOT / "CHANGELOG.md").read_text("utf-8")


def test_the_file_that_is_installed_holds_all_of_it() -> None:
    content = pack(VSCODE)
    assert content == pack(VSCODE)
    package = json.loads((VSCODE / "package.json").read_text("utf-8"))
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        names = set(archive.namelist())
        manifest = ElementTree.fromstring(archive.read("extension.vsixmanifest"))
        types = ElementTree.fromstring(archive.read("[Content_Types].xml"))
    space = {"v": "http://schemas.microsoft.com/developer/vsx-schema/2011"}
    identity = manifest.find("v:Metadata/v:Identity", space)
    assert identity is not None
    assert (identity.get("Id"), identity.get("Publisher")) == ("scanbench", "scanbench")
    assert {each.get("Path") for each in manifest.iterfind("v:Assets/v:Asset", space)} <= names
    assert {f"extension/{each}" for each in package["files"] if each != "LICENSE"} <= names
    known = {each.get("Extension") for each in types}
    assert {Path(name).suffix for name in names} - {".xml"} <= known


def test_the_language_is_described() -> None:
    contributes = json.loads((VSCODE / "package.json").read_text("utf-8"))["contributes"]
    for each in (contributes["languages"][0]["configuration"], contributes["grammars"][0]["path"]):
        assert json.loads((VSCODE / each).read_text("utf-8"))
    words = json.loads((VSCODE / contributes["grammars"][0]["path"]).read_text("utf-8"))["repository"]["words"][
        "patterns"
    ]
    for text, coloured in (
        ("end_if;", True),
        ('  RUNG hold: "Holds" // until', True),
        ("END_NETWORK", True),
        ("TRANSITION second (PRIORITY := 2) FROM X1 TO X3 := TRUE;", True),
        ("INITIAL_STEP Idle:", True),
        ("rung[3] := 1;", False),
        ("step := transition;", False),
    ):
        assert any(re.search(each["match"], text) for each in words if "keyword.control" in each["name"]) == coloured
