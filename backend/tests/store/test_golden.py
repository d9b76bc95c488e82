"""Golden databases: what a released version kept is read by every later one, and says the same. See docs/formats.md."""

import json
import shutil
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest

from scanbench.store.tables import Base
from tests.store.said import missing, said

GOLDEN = Path(__file__).with_name("golden")
FILES = sorted(GOLDEN.glob("*.sql"), key=lambda path: [int(part) for part in path.stem.split(".")])
RELEASES = [path.stem for path in FILES]


def opened(path: Path, data: Path) -> Path:
    """A data directory with this golden database."""
    if (beside := path.with_suffix("")).is_dir():
        shutil.copytree(beside, data)
    with closing(sqlite3.connect(data / "scanbench.db")) as connection:
        connection.executescript(path.read_text("utf-8"))
    return data


@pytest.mark.parametrize("path", FILES, ids=RELEASES)
def test_a_golden_database_says_what_it_said(path: Path, tmp_path: Path) -> None:
    told = json.loads((GOLDEN / f"{path.stem}.json").read_text("utf-8"))
    assert missing(told, said(opened(path, tmp_path / "data"))) == []


def test_each_table_of_the_newest_has_rows(tmp_path: Path) -> None:
    """A table that comes with a later release comes with a golden database of that one."""
    data = opened(FILES[-1], tmp_path / "data")
    with closing(sqlite3.connect(data / "scanbench.db")) as connection:
        made = {name for (name,) in connection.execute("SELECT name FROM sqlite_master WHERE type = 'table'")}
        counts = {name: connection.execute(f"SELECT count(*) FROM {name}").fetchone()[0] for name in made}
    assert made == set(Base.metadata.tables) | {"alembic_version"}
    assert [name for name, count in counts.items() if not count] == []


def test_what_is_not_said_any_more_is_found() -> None:
    """Also what is said besides: that is new, and may be."""
    then = {"a": [{"b": 1, "c": "x"}], "d": None}
    assert missing(then, {"a": [{"b": 1, "c": "x", "new": 2}], "d": None, "e": 3}) == []
    assert missing(then, {"a": [{"b": 2, "c": "x"}], "d": None}) == [".a[0].b: 1 is now 2"]
    assert missing(then, {"a": [], "d": 1}) == [".a: [{'b': 1, 'c': 'x'}] is now []", ".d: None is now 1"]
