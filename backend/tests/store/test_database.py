"""Opening, migrating, and many at once."""

import multiprocessing
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path

import pytest
from alembic.autogenerate import compare_metadata
from alembic.migration import MigrationContext
from sqlalchemy import text

from scanbench.store.__main__ import main
from scanbench.store.database import database_url, open_database, writing
from scanbench.store.records import Conflict, StoreError
from scanbench.store.store import Store
from scanbench.store.tables import Base


def test_the_migrations_make_exactly_the_tables(url: str) -> None:
    engine = open_database(url)
    with engine.connect() as connection:
        context = MigrationContext.configure(connection, opts={"compare_type": True})
        assert compare_metadata(context, Base.metadata) == []
    engine.dispose()


def test_a_second_opening_finds_everything(url: str) -> None:
    first = Store(url)
    project = first.projects.create("conveyor", "CJ1M-CPU63")
    first.files.save(project.id, "main.st", "text", 0, "ada")
    first.close()
    second = Store(url)
    assert second.projects.all() == [project]
    assert second.files.sources(project.id) == {"main.st": "text"}
    second.close()


def _open_and_count(url: str) -> int:
    store = Store(url)
    count = len(store.projects.all())
    store.close()
    return count


def test_servers_that_start_at_once_migrate_once(url: str) -> None:
    with ProcessPoolExecutor(4, multiprocessing.get_context("spawn")) as pool:
        assert list(pool.map(_open_and_count, [url] * 4)) == [0] * 4


def test_of_savers_at_once_exactly_one_wins_each_round(url: str) -> None:
    stores = [Store(url) for _ in range(4)]
    project = stores[0].projects.create("conveyor", "CJ1M-CPU63").id

    def save(number: int, version: int) -> bool:
        try:
            stores[number].files.save(project, "main.st", f"{number} from {version}", version, f"author {number}")
        except Conflict:
            return False
        return True

    with ThreadPoolExecutor(4) as pool:
        for version in range(12):
            won = list(pool.map(save, range(4), [version] * 4))
            assert won.count(True) == 1
            kept = stores[0].files.get(project, "main.st")
            assert kept.version == version + 1
            assert (kept.text, kept.author) == (f"{won.index(True)} from {version}", f"author {won.index(True)}")
    for store in stores:
        store.close()


def test_builds_at_once_all_get_a_number_of_their_own(url: str) -> None:
    stores = [Store(url) for _ in range(4)]
    project = stores[0].projects.create("conveyor", "CJ1M-CPU63").id
    with ThreadPoolExecutor(4) as pool:
        versions = list(pool.map(lambda n: stores[n % 4].builds.accept(project, {"n": str(n)}, "ada"), range(20)))
    assert sorted(versions) == list(range(1, 21))
    for number, version in enumerate(versions):
        build = stores[0].builds.get(project, version)
        assert build is not None
        assert build.sources == {"n": str(number)}
    for store in stores:
        store.close()


def test_a_newer_database_is_refused_with_advice(url: str) -> None:
    engine = open_database(url)
    with writing(engine) as connection:
        connection.execute(text("UPDATE alembic_version SET version_num = '9999'"))
    engine.dispose()
    with pytest.raises(StoreError, match=r"another version of Scanbench.*9999"):
        Store(url)


@pytest.mark.parametrize(
    ("url", "says"),
    [
        ("nonsense", "use sqlite:////path"),
        ("mysql://a:b@c/d", "'mysql' is not supported"),
        ("sqlite:////nowhere/at/all.db", "unable to open database file"),
        ("postgresql://bench:secret@127.0.0.1:1/x", "Connection refused"),
    ],
)
def test_an_address_that_cannot_be_used(url: str, says: str) -> None:
    with pytest.raises(StoreError, match=says) as refused:
        Store(url)
    assert "secret" not in str(refused.value)


def test_a_file_that_is_no_database(tmp_path: Path) -> None:
    path = tmp_path / "bench.db"
    path.write_text("this is not a database, " * 100, encoding="utf-8")
    with pytest.raises(StoreError, match="file is not a database"):
        Store(f"sqlite:///{path}")


def test_the_address_comes_from_the_environment_or_the_data_directory(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.delenv("SCANBENCH_DATABASE", raising=False)
    assert database_url(tmp_path) == f"sqlite:///{tmp_path}/scanbench.db"
    monkeypatch.setenv("SCANBENCH_DATABASE", "postgresql://db/x")
    assert database_url(tmp_path) == "postgresql://db/x"


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str]) -> Callable[[str], tuple[int, str, str]]:
    def call(url: str) -> tuple[int, str, str]:
        code = main([url])
        out, err = capsys.readouterr()
        return code, out, err

    return call


def test_the_command_that_only_migrates(url: str, run: Callable[[str], tuple[int, str, str]]) -> None:
    assert run(url) == (0, "the database is up to date, projects: 0\n", "")
    code, _, err = run("sqlite:////nowhere/at/all.db")
    assert code == 1
    assert "cannot be opened" in err
