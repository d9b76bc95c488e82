"""A project as one file: what goes out comes in again, and what other tools pack is understood."""

import io
import zipfile
from collections.abc import Mapping
from xml.etree import ElementTree

import pytest

from scanbench.server.archive import pack, unpack
from scanbench.server.twincat_project import read_twincat_project
from scanbench.syntax.language_file import LANGUAGE_FILE, language_text
from scanbench.wire.refused import Refused

MAIN = "PROGRAM Main\nEND_PROGRAM\n"
FILES = {"Main.st": MAIN, "lib/Über.st": "FUNCTION_BLOCK F\nEND_FUNCTION_BLOCK\n", "plant/inputs.csv": "scan,x\n0,1\n"}
POU = '<?xml version="1.0" encoding="utf-8"?><TcPlcObject><POU Name="MAIN"></POU></TcPlcObject>'


def zipped(files: Mapping[str, str]) -> bytes:
    """An archive."""
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w") as archive:
        for name, text in files.items():
            archive.writestr(name, text)
    return made.getvalue()


def test_what_goes_out_comes_in_again_and_is_always_the_same() -> None:
    made = pack("Line 1", "CJ1M-CPU63", ["Main.x"], FILES)
    assert made == pack("Line 1", "CJ1M-CPU63", ["Main.x"], FILES)
    found = unpack(made)
    assert (found.name, found.model, found.watch, found.files) == ("Line 1", "CJ1M-CPU63", ("Main.x",), FILES)
    assert found.left_out == ()


def test_a_folder_that_was_packed_whole_loses_its_name() -> None:
    found = unpack(zipped({"plant1/Main.st": MAIN, "plant1/lib/F.st": MAIN, "plant1/notes.txt": "x", "readme": "y"}))
    assert list(found.files) == ["Main.st", "lib/F.st"]
    assert found.left_out == ("readme", "notes.txt")
    assert list(unpack(zipped({"plant/tank.st": MAIN})).files) == ["plant/tank.st"]


def test_of_a_twincat_project_the_compiled_files_are_taken() -> None:
    project = (
        '<Project><ItemGroup><Compile Include="POUs\\MAIN.TcPOU"><SubType>Code</SubType></Compile>'
        '<Compile Include="POUs\\A &amp; B.TcPOU"/></ItemGroup></Project>'
    )
    files = {
        "S/P/P.plcproj": project,
        "S/P/POUs/MAIN.TcPOU": POU,
        "S/P/POUs/A & B.TcPOU": "\ufeff" + POU,
        "S/P/POUs/Old.TcPOU": POU,
        "S/S.tsproj": "<x/>",
    }
    found = unpack(zipped(files))
    assert found.files == {"POUs/A & B.TcPOU": POU, "POUs/MAIN.TcPOU": POU}
    assert found.left_out == ("S/S.tsproj", "POUs/Old.TcPOU")


@pytest.mark.parametrize(
    ("data", "why"),
    [
        (b"PK\x03\x04 nonsense", "no zip file"),
        (zipped({"notes.txt": "x"}), "no program file"),
        (zipped({"/etc/Main.st": MAIN}), "no program file"),
        (zipped({"../Main.st": MAIN}), "no program file"),
        (zipped({"Main.st": MAIN, "project.json": "{"}), "project.json cannot be read"),
        (zipped({"Main.st": MAIN, "./a/../Main.st": MAIN}), "same name"),
        (zipped({"Main.st": MAIN, "project.json": "[" * 100_000}), "project.json cannot be read"),
        (zipped({"P.PLCPROJ": '<Compile Include="..\\S\\a.TcPOU"/>', "B.TcPOU": POU}), "not in this archive"),
        (zipped({"a/A.plcproj": "", "b/B.plcproj": "", "a/A.TcPOU": POU}), "several projects"),
    ],
)
def test_what_cannot_be_taken_says_why(data: bytes, why: str) -> None:
    with pytest.raises(Refused, match=why):
        unpack(data)


def test_what_leads_out_and_what_a_mac_adds_is_told() -> None:
    found = unpack(zipped({"p/main.st": MAIN, "__MACOSX/p/._main.st": "x", "/etc/main.st": MAIN, "C:\\x.st": MAIN}))
    assert list(found.files) == ["main.st"]
    assert found.left_out == ("__MACOSX/p/._main.st", "/etc/main.st", "C:\\x.st")


def test_windows_does_not_tell_names_apart_by_capitals() -> None:
    project = '<!-- <Compile Include="Old.TcPOU"/> --><Compile Include="POUs\\MAIN.TcPOU"/>'
    found = unpack(zipped({"P.plcproj": project, "POUs/Main.TcPOU": POU, "Old.TcPOU": POU}))
    assert (list(found.files), found.left_out) == (["POUs/Main.TcPOU"], ("Old.TcPOU",))


def test_what_unpacks_to_too_much_is_refused() -> None:
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("Main.st", b" " * (65 << 20))
    with pytest.raises(Refused, match="more than"):
        unpack(made.getvalue())


def test_files_of_twincat_go_out_with_their_project_file_and_come_in_from_it() -> None:
    files = {
        "POUs/MAIN.TcPOU": POU,
        "POUs/R&D/Fb.TcPOU": POU,
        "POUs/50 % (old);'s/G.TcPOU": POU,
        "DUTs/T.TcDUT": POU,
        "Extra.st": MAIN,
        "Operation.panel.json": "{}",
    }
    made = pack("Line <1>", "GENERIC-IEC", [], files)
    assert unpack(made).files == {path: text for path, text in sorted(files.items()) if path != "Operation.panel.json"}
    with zipfile.ZipFile(io.BytesIO(made)) as archive:
        project = archive.read("Line _1_.plcproj").decode()
        without = {each: archive.read(each).decode() for each in archive.namelist() if each != "project.json"}
    root = ElementTree.fromstring(project)
    space = {"m": "http://schemas.microsoft.com/developer/msbuild/2003"}
    listed = {each.get("Include") for each in root.iterfind("m:ItemGroup/m:Compile", space)}
    escaped = "POUs\\50 %25 %28old%29%3B%27s"
    assert listed == {
        "POUs\\MAIN.TcPOU",
        "POUs\\R&D\\Fb.TcPOU",
        f"{escaped}\\G.TcPOU",
        "DUTs\\T.TcDUT",
    }
    assert {each.get("Include") for each in root.iterfind("m:ItemGroup/m:Folder", space)} == {
        "POUs",
        "POUs\\R&D",
        escaped,
        "DUTs",
    }
    assert "CompilerDefines" not in project
    defining = {**files, LANGUAGE_FILE: language_text("twincat", defines=["Heater", "Fast"])}
    with zipfile.ZipFile(io.BytesIO(pack("Line", "GENERIC-IEC", [], defining))) as archive:
        assert read_twincat_project(archive.read("Line.plcproj").decode()).defines == ("Fast", "Heater")
    # what another tool takes by the project file: the files of TwinCAT, each found
    found = unpack(zipped(without))
    assert set(found.files) == {path for path in files if path.endswith((".TcPOU", ".TcDUT"))}
    assert found.left_out == ("Extra.st",)
