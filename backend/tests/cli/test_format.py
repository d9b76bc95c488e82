"""`scanbench format`."""

from pathlib import Path

import pytest

from tests.cli.calling import scanbench

UGLY = "program Main\nvar x:int; end_var\nx:=1;\nend_program\n"
GOOD = "PROGRAM Main\nVAR x : INT; END_VAR\n  x := 1;\nEND_PROGRAM\n"


def test_files_are_laid_out_in_place_and_then_nothing_is_left_to_do(tmp_path: Path) -> None:
    file = tmp_path / "main.st"
    file.write_text(UGLY)
    beside = {
        "required.reactions": "battery-error:\n  lamp\n",
        "language.json": '{"dialect": "iec"}',
        "hardware.json": "{}",
    }
    for name, text in beside.items():
        (tmp_path / name).write_text(text)
    checked = scanbench("format", "--check", str(tmp_path))
    assert (checked.returncode, checked.stdout) == (1, f"{file}\n")
    assert file.read_text() == UGLY
    assert scanbench("format", str(tmp_path)).stdout == f"{file}\n"
    assert file.read_text() == GOOD
    again = scanbench("format", "--check", str(tmp_path))
    assert (again.returncode, again.stdout, again.stderr) == (0, "", "")
    assert {name: (tmp_path / name).read_text() for name in beside} == beside


def test_a_file_that_cannot_be_read_stays_as_it_is(tmp_path: Path) -> None:
    file = tmp_path / "main.st"
    file.write_text("PROGRAM Main\nx := ;\nEND_PROGRAM\n")
    told = scanbench("format", str(file))
    assert told.returncode == 2
    assert "left as it is" in told.stderr
    assert file.read_text() == "PROGRAM Main\nx := ;\nEND_PROGRAM\n"


@pytest.mark.parametrize(
    ("encoding", "mark"),
    [
        ("utf-8", ""),
        ("utf-8", "\ufeff"),
        ("utf-16-le", "\ufeff"),
        ("utf-16-be", "\ufeff"),
        ("utf-16-le", ""),
        ("cp1252", ""),
    ],
)
def test_a_file_keeps_its_encoding_and_its_line_ends(tmp_path: Path, encoding: str, mark: str) -> None:
    file = tmp_path / "main.st"
    before, after = (f"{mark}// \xe9 \xdf\n{text}".replace("\n", "\r\n").encode(encoding) for text in (UGLY, GOOD))
    file.write_bytes(before)
    assert scanbench("format", str(file)).returncode == 0
    assert file.read_bytes() == after
