"""`scanbench model`: what it prints, and its exit codes."""

import json
from pathlib import Path

from scanbench.plcmodel.load import model_directory
from tests.cli.calling import scanbench

BROKEN = Path(__file__).parents[1] / "plcmodel" / "broken"


def test_a_right_file_is_summed_up() -> None:
    result = scanbench("model", "check", str(model_directory() / "omron" / "CJ1M-CPU63.xml"))
    assert result.returncode == 0, result.stderr
    assert "CJ1M-CPU63 (omron): Omron SYSMAC CJ1M CPU Unit" in result.stdout
    assert "A A0 A447 read read write yes" in " ".join(result.stdout.split())
    assert "instructions  3: FAL, FALS, MSG" in result.stdout
    assert "errors        33: 11 fatal, 22 nonfatal" in result.stdout
    assert " facts (" in result.stdout


def test_a_wrong_file_is_told_with_its_place() -> None:
    file = str(BROKEN / "no-such-bit.xml")
    result = scanbench("model", "check", str(model_directory() / "generic" / "GENERIC-IEC.xml"), file)
    assert result.returncode == 1
    assert result.stdout.splitlines()[-1].startswith(f"{file}:28:")
    assert "M003 'S1.16': bit 16 does not exist" in result.stdout
    assert "GENERIC-IEC (generic)" in result.stdout


def test_wrong_usage(tmp_path: Path) -> None:
    for path, says in ((tmp_path / "nothing.xml", "does not exist"), (tmp_path, "is a folder")):
        result = scanbench("model", "check", str(path))
        assert result.returncode == 2
        assert says in result.stderr


def test_the_list() -> None:
    result = scanbench("model", "list")
    assert result.returncode == 0, result.stderr
    for name in ("GENERIC-IEC", "CJ1M-CPU63", "CJ2M-CPU33", "Q03UD", "NJ501-1300"):
        assert f"\n{name} " in result.stdout


def test_the_facts_of_a_model() -> None:
    result = scanbench("model", "facts", "cj1m-cpu13", "--error", "basic-io-error")
    assert result.returncode == 0, result.stderr
    lines = [line.split() for line in result.stdout.splitlines()]
    assert ["error", "basic-io-error", "flag", "A402.12", "yes", "ELIB", "page", "on", "A408.08-15;"] in [
        line[:9] for line in lines
    ]
    assert result.stdout.splitlines()[-1].startswith("CJ1M-CPU13: ")
    told = json.loads(scanbench("model", "facts", "CJ1M-CPU13", "--unverified", "--json").stdout)
    assert not any(fact["verified"] for fact in told["list"])
    assert len(told["list"]) == told["facts"] - told["verified"]
    wrong = scanbench("model", "facts", "CJ1M-CPU13", "--error", "battery")
    assert (wrong.returncode, "has no error battery" in wrong.stderr) == (2, True)
