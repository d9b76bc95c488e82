import pytest

from scanbench.web.dap.paths import FolderPaths, ProjectPaths, ServerPaths
from scanbench.web.dap.shapes import Source
from scanbench.wire.refused import Refused

FILES = {"Main.st": "", "blocks/Valve.st": ""}


def files() -> dict[str, str]:
    return FILES


def test_a_browser_uses_the_names_of_the_project() -> None:
    paths = ProjectPaths(files)
    assert paths.source("blocks/Valve.st") == {"name": "Valve.st", "path": "blocks/Valve.st"}
    assert paths.file(Source(path="blocks/Valve.st")) == "blocks/Valve.st"


@pytest.mark.parametrize(
    ("root", "path"),
    [
        ("/home/ann/plant", "/home/ann/plant/blocks/Valve.st"),
        ("/home/ann/plant/", "/home/ann/plant/blocks/Valve.st"),
        (r"C:\plant", r"C:\plant\blocks\Valve.st"),
        (r"C:\plant", r"c:\plant\blocks\Valve.st"),
        (r"C:\plant", "c:/plant/blocks/Valve.st"),
        ("/", "/blocks/Valve.st"),
    ],
)
def test_files_below_a_folder(root: str, path: str) -> None:
    paths = FolderPaths(files, root)
    assert paths.file(Source(path=path)) == "blocks/Valve.st"
    again = paths.source("blocks/Valve.st")["path"]
    assert isinstance(again, str)
    assert paths.file(Source(path=again)) == "blocks/Valve.st"


def test_a_folder_may_have_two_names() -> None:
    paths = FolderPaths(files, "/tmp/link", "/mnt/real")
    assert paths.file(Source(path="/mnt/real/Main.st")) == "Main.st"
    assert paths.source("Main.st")["path"] == "/tmp/link/Main.st"


def test_a_file_elsewhere_is_none_of_the_program() -> None:
    with pytest.raises(Refused, match=r"/home/bob/Main\.st is no file of the program"):
        FolderPaths(files, "/home/ann").file(Source(path="/home/bob/Main.st"))
    with pytest.raises(Refused):
        FolderPaths(files, "/home/ann").file(Source(path="/home/annex/Main.st"))


def test_without_a_folder_files_come_by_number_or_by_the_end_of_their_path() -> None:
    paths = ServerPaths(files)
    source = paths.source("blocks/Valve.st")
    number = source["sourceReference"]
    assert isinstance(number, int)
    assert paths.file(Source(source_reference=number)) == "blocks/Valve.st"
    assert paths.file(Source(path=r"D:\somewhere\blocks\valve.st")) == "blocks/Valve.st"
    assert paths.file(Source(path="/x/Main.st")) == "Main.st"
    with pytest.raises(Refused):
        paths.file(Source(source_reference=77))
