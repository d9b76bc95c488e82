"""The layer contracts can fail: a little house with one wrong import each is refused by the contract it breaks."""

import subprocess
import sys
from pathlib import Path
from shutil import copy

import pytest

BACKEND = Path(__file__).parents[2]
ROOMS = (
    "cli web server session comm jobs host wire reports history verify store taps faults debug recording runtime engines language check symbols"
    " program syntax plcmodel problems garbage public typed".split()
)
INNER = ["engines.interpreter", "engines.native", "runtime.clock"]


@pytest.fixture
def house(tmp_path: Path) -> Path:
    copy(BACKEND / "pyproject.toml", tmp_path)
    for name in ["", *ROOMS, *INNER]:
        room = tmp_path.joinpath("scanbench", *name.split("."))
        room.mkdir(parents=True, exist_ok=True)
        (room / "__init__.py").touch()
    return tmp_path


def lint(house: Path) -> tuple[int, str]:
    command = [str(Path(sys.executable).parent / "lint-imports"), "--no-logo", "--no-cache"]
    # The little house must win over the installed one.
    done = subprocess.run(
        command, cwd=house, capture_output=True, text=True, check=False, env={"PYTHONPATH": str(house)}
    )
    return done.returncode, done.stdout + done.stderr


def test_an_empty_house_keeps_every_contract(house: Path) -> None:
    code, said = lint(house)
    assert code == 0, said
    assert "0 broken" in said


@pytest.mark.parametrize(
    ("room", "line", "contract"),
    [
        ("problems", "import scanbench.check", "imports run downward"),
        ("runtime", "import scanbench.taps", "imports run downward"),
        ("engines", "import scanbench.runtime", "imports run downward"),
        ("taps", "import scanbench.faults", "imports run downward"),
        ("store", "import scanbench.verify", "imports run downward"),
        ("runtime", "import scanbench.recording", "imports run downward"),
        ("session", "import scanbench.comm", "imports run downward"),
        ("host", "import scanbench.jobs", "imports run downward"),
        ("syntax", "import scanbench.plcmodel", "imports run downward"),
        ("engines/native", "import scanbench.engines.interpreter", "share no code generation"),
        ("engines/native", "import llvmlite.binding", "llvmlite only in"),
        ("session", "from fastapi import FastAPI", "wire shapes only in web"),
        ("store", "import asyncio", "asyncio only in"),
        ("check", "from pathlib import Path", "read and write nothing"),
        ("check", "from lxml import etree", "XML only in"),
        ("session", "import sqlalchemy", "the database only in store"),
        ("check", "import time", "wall clock and randomness"),
        ("runtime", "import random", "wall clock and randomness"),
    ],
)
def test_a_wrong_import_breaks_its_contract(house: Path, room: str, line: str, contract: str) -> None:
    (house / "scanbench" / room / "__init__.py").write_text(f"{line}\n", encoding="utf-8")
    code, said = lint(house)
    assert code == 1, said
    assert "1 broken" in said
    broken = [text for text in said.splitlines() if text.endswith("BROKEN")]
    assert len(broken) == 1
    assert contract in broken[0]
