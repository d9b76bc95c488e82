"""Golden databases as data directories."""

import shutil
import sqlite3
from contextlib import closing
from pathlib import Path

GOLDEN = Path(__file__).with_name("golden")
FILES = sorted(GOLDEN.glob("*.sql"), key=lambda path: [int(part) for part in path.stem.split(".")])


def newest() -> Path:
    """That of the last release."""
    return FILES[-1]


def opened(path: Path, data: Path) -> Path:
    """A data directory with this golden database."""
    shutil.copytree(path.with_suffix(""), data)
    with closing(sqlite3.connect(data / "scanbench.db")) as connection:
        connection.executescript(path.read_text("utf-8"))
    return data
