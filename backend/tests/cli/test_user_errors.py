"""A folder's own errors on the command line: checked, raised, recorded and replayed."""

from pathlib import Path

from typer.testing import CliRunner, Result

from scanbench.cli.commands import app

GOOD = (Path(__file__).parents[1] / "plcmodel" / "broken_user_errors" / "GOOD.xml").read_text("utf-8")
MAIN = """PROGRAM Main
VAR seen : INT; hot AT W10.00 : BOOL; END_VAR
  IF hot THEN seen := seen + 1; END_IF;
END_PROGRAM
"""


def scanbench(*arguments: object) -> Result:
    return CliRunner().invoke(app, [str(each) for each in arguments])


def folder(tmp_path: Path, errors: str) -> Path:
    (tmp_path / "main.st").write_text(MAIN)
    (tmp_path / "errors.xml").write_text(errors, "utf-8")
    (tmp_path / "project.json").write_text('{"model": "CJ1M-CPU63"}')
    return tmp_path


def test_they_are_raised_recorded_and_replayed(tmp_path: Path) -> None:
    project, record = folder(tmp_path, GOOD), tmp_path / "run.scanrun"
    ran = scanbench(
        "run", project, "--scans", 10, "--raise", "pump-hot:pump=south,degrees=7@5", "--engine", "both",
        "--print", "Main.seen", "--print", "A400", "--print", "W12", "--print", "W13", "--record", record,
    )  # fmt: skip
    assert ran.exit_code == 0, ran.output
    assert ran.stdout.splitlines()[:4] == ["Main.seen = 5", "A400 = 16#4103", "W12 = 16#0010", "W13 = 16#0700"]
    replayed = scanbench("replay", record)
    assert replayed.exit_code == 0, replayed.output


def test_what_is_wrong_with_them_is_told_like_a_compile_problem(tmp_path: Path) -> None:
    project = folder(tmp_path, GOOD.replace("W10.00", "W999.00"))
    checked = scanbench("check", project)
    assert checked.exit_code == 1
    assert f"{project / 'errors.xml'}:5:54: M003" in checked.stdout
    ran = scanbench("run", project, "--scans", 1)
    assert ran.exit_code == 1
    assert "errors.xml:5:54" in ran.stderr


def test_a_file_alone_has_none_unless_they_are_named(tmp_path: Path) -> None:
    project = folder(tmp_path, GOOD)
    ran = scanbench("run", project / "main.st", "--model", "CJ1M-CPU63", "--scans", 1, "--raise", "pump-hot")
    assert ran.exit_code == 2
    assert "knows no error 'pump-hot'" in ran.stderr
    both = scanbench("check", project / "main.st", project / "errors.xml", "--model", "CJ1M-CPU63")
    assert both.exit_code == 0, both.output
