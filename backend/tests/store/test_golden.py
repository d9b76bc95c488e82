"""Golden databases: what a released version kept is read by every later one, and says the same. See docs/formats.md."""

import json
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest
from sqlalchemy import JSON

from scanbench.store.tables import Base
from tests.store.golden_data import FILES, GOLDEN, newest, opened
from tests.store.said import missing, said

RELEASES = [path.stem for path in FILES]


@pytest.mark.parametrize("path", FILES, ids=RELEASES)
def test_a_golden_database_says_what_it_said(path: Path, tmp_path: Path) -> None:
    told = json.loads((GOLDEN / f"{path.stem}.json").read_text("utf-8"))
    assert missing(told, said(opened(path, tmp_path / "data"))) == []


def test_each_table_of_the_newest_has_rows(tmp_path: Path) -> None:
    """A table that comes with a later release comes with a golden database of that one."""
    data = opened(newest(), tmp_path / "data")
    with closing(sqlite3.connect(data / "scanbench.db")) as connection:
        made = {name for (name,) in connection.execute("SELECT name FROM sqlite_master WHERE type = 'table'")}
        counts = {name: connection.execute(f"SELECT count(*) FROM {name}").fetchone()[0] for name in made}
    assert made == set(Base.metadata.tables) | {"alembic_version"}
    assert [name for name, count in counts.items() if not count] == []


def newer(value: object) -> object:
    """With more fields in each object, as a newer version may keep it."""
    if isinstance(value, dict):
        return {**{name: newer(each) for name, each in value.items()}, "of a newer version": {"more": 1}}
    return [newer(each) for each in value] if isinstance(value, list) else value


def test_fields_that_a_newer_version_keeps_are_left_alone(tmp_path: Path) -> None:
    data = opened(newest(), tmp_path / "data")
    told = said(data)
    columns = [(table.name, column.name) for table in Base.metadata.tables.values() for column in table.columns
               if isinstance(column.type, JSON) and (table.name, column.name) != ("program_version", "sources")]  # fmt: skip
    with closing(sqlite3.connect(data / "scanbench.db")) as connection, connection:
        for table, column in columns:
            of = f"FROM {table} WHERE {column} IS NOT NULL"
            for row, kept in connection.execute(f"SELECT rowid, {column} {of}").fetchall():
                changed = json.dumps(newer(json.loads(kept)))
                connection.execute(f"UPDATE {table} SET {column} = ? WHERE rowid = ?", (changed, row))
    assert len(columns) >= 10
    assert missing(told, said(data)) == []


def test_what_is_not_said_any_more_is_found() -> None:
    """Also what is said besides: that is new, and may be."""
    then = {"a": [{"b": 1, "c": "x"}], "d": None}
    assert missing(then, {"a": [{"b": 1, "c": "x", "new": 2}], "d": None, "e": 3}) == []
    assert missing(then, {"a": [{"b": 2, "c": "x"}], "d": None}) == [".a[0].b: 1 is now 2"]
    assert missing(then, {"a": [], "d": 1}) == [".a: [{'b': 1, 'c': 'x'}] is now []", ".d: None is now 1"]
    assert missing(then, {"a": [{"b": 1}]}) == [".a[0].c: 'x' is gone", ".d: None is gone"]
