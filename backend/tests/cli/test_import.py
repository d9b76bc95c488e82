"""`scanbench import`."""

from pathlib import Path

from tests.cli.calling import scanbench
from tests.syntax.l5x.test_project import controller, program, tag

LINE = Path(__file__).parent.parent / "syntax" / "plcopen" / "line.xml"


def test_the_pous_of_a_plcopen_file_become_files_that_run(tmp_path: Path) -> None:
    told = scanbench("import", str(LINE), str(tmp_path / "line"))
    assert (told.returncode, told.stdout) == (0, "5 files. POUs: 3 as they were, 0 nearly, 0 without their body.\n")
    assert scanbench("check", str(tmp_path / "line"), "--model", "GENERIC-IEC").returncode == 0
    again = scanbench("import", str(LINE), str(tmp_path / "line"))
    assert again.returncode == 2
    assert "give an empty folder" in again.stderr


def test_a_file_that_is_no_plcopen_file_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "half.xml"
    file.write_bytes(LINE.read_bytes()[:2000])
    told = scanbench("import", str(file), str(tmp_path / "out"))
    assert told.returncode == 2
    assert "this PLCopen file cannot be read: this is no XML" in told.stderr
    assert not (tmp_path / "out").exists()


def test_a_folder_becomes_a_plcopen_file_and_what_has_no_place_there_is_told(tmp_path: Path) -> None:
    scanbench("import", str(LINE), str(tmp_path / "line"))
    told = scanbench("export", str(tmp_path / "line"), str(tmp_path / "again.xml"))
    assert (told.returncode, told.stdout) == (0, "")
    assert scanbench("import", str(tmp_path / "again.xml"), str(tmp_path / "again")).returncode == 0
    for name in ("Latch.st", "Ramp.st", "Types.st", "Configuration.st"):
        assert (tmp_path / "again" / name).read_text() == (tmp_path / "line" / name).read_text()
    (tmp_path / "line" / "Own.st").write_text("FUNCTION_BLOCK Own EXTENDS Latch\nEND_FUNCTION_BLOCK\n")
    told = scanbench("export", str(tmp_path / "line"), str(tmp_path / "more.xml"))
    assert told.returncode == 1
    assert (
        told.stdout == "left out: Own, the whole of it: a function_block with EXTENDS, IMPLEMENTS or in a NAMESPACE\n"
    )


def test_a_file_of_iec_61131_10_goes_in_and_out(tmp_path: Path) -> None:
    told = scanbench("import", str(LINE.parent / "press.xml"), str(tmp_path / "press"))
    assert (told.returncode, told.stdout) == (0, "7 files. POUs: 4 as they were, 0 nearly, 0 without their body.\n")
    (tmp_path / "press" / "Configuration.st").unlink()
    (tmp_path / "press" / "Report.st").unlink()
    told = scanbench("export", str(tmp_path / "press"), str(tmp_path / "again.xml"), "--form", "iec61131-10")
    assert (told.returncode, told.stdout) == (0, "")
    assert scanbench("import", str(tmp_path / "again.xml"), str(tmp_path / "again")).returncode == 0
    assert (tmp_path / "again" / "Press.st").read_text() == (tmp_path / "press" / "Press.st").read_text()


def test_a_file_of_studio_5000_comes_with_its_library(tmp_path: Path) -> None:
    (tmp_path / "axis.L5X").write_bytes(
        controller("", program("P", "GSV(WallClockTime, , LocalDateTime, x);", tag("x", "DINT")))
    )
    told = scanbench("import", str(tmp_path / "axis.L5X"), str(tmp_path / "axis"))
    assert told.stderr == ""
    assert (tmp_path / "axis" / "libraries" / "Controller.st").exists()
