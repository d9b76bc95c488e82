"""`scanbench diff`: two recorded runs."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from scanbench.cli.commands import app

SOURCE = """
FUNCTION_BLOCK Belt
VAR_INPUT load : INT; END_VAR
VAR_OUTPUT speed : INT; END_VAR
VAR last : INT; END_VAR
  IF load <> last THEN
    speed := LIMIT(0, 600 - load, 600);
    last := load;
  END_IF;
END_FUNCTION_BLOCK
PROGRAM Main
VAR n : DINT; load : INT := 64; belt : ARRAY[1..3] OF Belt; END_VAR
  n := n + 1;
  belt[3](load := load);
END_PROGRAM
"""


@pytest.fixture
def program(tmp_path: Path) -> str:
    file = tmp_path / "main.st"
    file.write_text(SOURCE)
    return str(file)


def call(*arguments: str) -> Result:
    return CliRunner().invoke(app, list(arguments))


def record(program: str, path: Path, *arguments: str) -> str:
    ran = call("run", program, "--model", "CJ1M-CPU63", "--scans", "2000", "--record", str(path), *arguments)
    assert ran.exit_code == 0, ran.output
    return str(path)


def test_the_same(program: str, tmp_path: Path) -> None:
    one = record(program, tmp_path / "a.scanrun", "--set", "Main.load=7@100")
    other = record(program, tmp_path / "b.scanrun", "--set", "Main.load=7@100")
    found = call("diff", one, other)
    assert found.exit_code == 0, found.output
    assert found.stdout.startswith("The same in all 2,000 scans that both have")
    assert call("diff", one, one).exit_code == 0


def test_the_first_difference_is_named(program: str, tmp_path: Path) -> None:
    one = record(program, tmp_path / "a.scanrun", "--set", "Main.load=7@100")
    other = record(program, tmp_path / "b.scanrun", "--set", "Main.load=7@100", "--set", "Main.load=90@1283")
    found = call("diff", one, other)
    assert found.exit_code == 1, found.output
    text = found.stdout
    for part in (
        "After scan 1283 Main.belt[3].load is 7 in A and 90 in B",
        "scan       1283",
        "task       Main",
        "instance   Main",
        "line       main.st:14",
        "belt[3](load := load);",
        "Main.belt[3].speed  593  510",
        "B  scan 1283",
        "Main.load := 90",
        "They differ after scans 1283 to 1999",
    ):
        assert part in text, text
    data = json.loads(call("diff", one, other, "--json").stdout)
    assert (data["scan"], data["cause"], data["compared"]) == (1283, "command", 2000)
    assert data["place"]["line"] == 14
    assert {each["path"]: (each["a"], each["b"]) for each in data["changes"]}["Main.belt[3].speed"] == ("593", "510")
    assert data["entries"][0]["run"] == "B"
    assert data["marks"] == [{"first": 1283, "last": 1999}]
    assert data["count"] == len(data["changes"]) == 4


def test_another_program(program: str, tmp_path: Path) -> None:
    one = record(program, tmp_path / "a.scanrun")
    Path(program).write_text(SOURCE.replace("600 - load", "600 + load").replace("n : DINT;", "more, n : DINT;"))
    other = record(program, tmp_path / "b.scanrun")
    found = call("diff", one, other)
    assert found.exit_code == 1, found.output
    assert (
        "After scan 0 Main.belt[3].speed is 536 in A and 600 in B, written at main.st:7 in Main.belt[3]" in found.stdout
    )
    assert "different programs run" in found.stdout


def test_files_that_cannot_be_compared(program: str, tmp_path: Path) -> None:
    one = record(program, tmp_path / "a.scanrun")
    missing = call("diff", one, str(tmp_path / "none.scanrun"))
    assert missing.exit_code == 2
    assert "none.scanrun does not exist" in missing.stderr
    none = call("diff", program, one)
    assert none.exit_code == 2
    assert "main.st is not a run file" in none.stderr
    Path(program).write_text("PROGRAM Main VAR n : INT; END_VAR n := n + 1; END_PROGRAM")
    other = str(tmp_path / "c.scanrun")
    assert call("run", program, "--model", "GENERIC-IEC", "--scans", "10", "--record", other).exit_code == 0
    models = call("diff", one, other)
    assert models.exit_code == 2
    assert "CJ1M-CPU63" in models.stderr
    assert "GENERIC-IEC" in models.stderr


def _short(folder: Path, name: str, source: str, *arguments: str) -> str:
    file = folder / f"{name}.st"
    file.write_text(source)
    path = str(folder / f"{name}.scanrun")
    ran = call("run", str(file), "--model", "GENERIC-IEC", "--scans", "10", "--record", path, *arguments)
    assert ran.exit_code == 0, ran.output
    return path


def test_the_same_only_in_what_both_have(tmp_path: Path) -> None:
    source = "PROGRAM Main VAR a, total : INT; END_VAR a := a + 1; total := a * 2; END_PROGRAM"
    one = _short(tmp_path, "one", source)
    found = call("diff", one, _short(tmp_path, "two", source.replace("total", "sum")))
    assert found.exit_code == 4, found.output
    assert found.stdout.startswith("In what both have they are the same in all 10 scans")
    assert "Main.sum: only in B" in found.stdout
    assert "Main.total: only in A" in found.stdout
    slow = _short(tmp_path, "slow", source, "--interval", "20ms")
    found = call("diff", one, slow, "--json")
    data = json.loads(found.stdout)
    assert (found.exit_code, data["same"]) == (4, "partly")
    assert data["left"] == [{"path": "", "reason": "a scan lasts 10 ms in A and 20 ms in B"}]


def test_nothing_in_common(tmp_path: Path) -> None:
    source = "PROGRAM Main VAR a : INT; END_VAR a := a + 1; END_PROGRAM"
    one = _short(tmp_path, "one", source)
    found = call("diff", one, _short(tmp_path, "two", source.replace("Main", "Other")))
    assert found.exit_code == 2, found.output
    assert "no variable in common" in found.stdout
