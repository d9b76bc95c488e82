"""Opening a database: the engine, SQLite's settings, and the migrations, run at every opening."""

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from sqlite3 import Connection as SqliteConnection

from alembic import command
from alembic.config import Config
from alembic.util.exc import CommandError
from sqlalchemy import Connection, Engine, create_engine, event, text
from sqlalchemy.engine import make_url
from sqlalchemy.exc import ArgumentError, NoSuchModuleError, SQLAlchemyError
from sqlalchemy.pool import ConnectionPoolEntry

from scanbench.store.records import StoreError

MIGRATION_LOCK = 0x5CA9BE
"""Number of PostgreSQL's advisory lock: two servers that start at once migrate one after the other."""

WRITING = {"scanbench_writing": True}


def database_url(data: Path) -> str:
    """SCANBENCH_DATABASE, or a SQLite file in the data directory."""
    named = os.environ.get("SCANBENCH_DATABASE")
    return named or f"sqlite:///{(data / 'scanbench.db').absolute()}"


def open_database(url: str, claim: Callable[[Engine], None] = lambda _: None) -> Engine:
    """An engine on a database that has today's tables. `claim` comes first: the tables of another server stay as they are."""
    try:
        address = make_url(url)
        if address.drivername in ("postgres", "postgresql"):
            address = address.set(drivername="postgresql+psycopg")
        if address.get_backend_name() not in ("sqlite", "postgresql"):
            raise ArgumentError(f"{address.get_backend_name()!r} is not supported")
        engine = create_engine(address, pool_pre_ping=address.get_backend_name() != "sqlite")
    except (ArgumentError, NoSuchModuleError, ImportError) as error:
        hint = "use sqlite:////path/to/file or postgresql+psycopg://user:password@host/name"
        raise StoreError(f"the address of the database cannot be used ({error}): {hint}") from error
    if engine.dialect.name == "sqlite":
        _prepare_sqlite(engine)
    try:
        claim(engine)
        _migrate(engine)
    except (SQLAlchemyError, OSError) as error:
        engine.dispose()
        reason = str(getattr(error, "orig", None) or error).strip()
        raise StoreError(f"the database {address.render_as_string()} cannot be opened: {reason}") from error
    except CommandError as error:
        engine.dispose()
        message = f"the database {address.render_as_string()} was written by another version of Scanbench: {error}"
        raise StoreError(f"{message}. Use that version, or another database") from error
    except StoreError:
        engine.dispose()
        raise
    return engine


@contextmanager
def writing(engine: Engine) -> Iterator[Connection]:
    """A transaction that writes: all or nothing."""
    with engine.connect().execution_options(**WRITING) as connection, connection.begin():
        yield connection


def _prepare_sqlite(engine: Engine) -> None:
    @event.listens_for(engine, "connect")
    def on_connect(connection: SqliteConnection, _entry: ConnectionPoolEntry) -> None:
        connection.isolation_level = None  # transactions begin below, and never implicitly
        for setting in ("busy_timeout = 30000", "journal_mode = WAL", "synchronous = NORMAL", "foreign_keys = ON"):
            connection.execute(f"PRAGMA {setting}")

    @event.listens_for(engine, "begin")
    def on_begin(connection: Connection) -> None:
        # A transaction that reads first and then writes fails at once while a second one writes; IMMEDIATE waits.
        immediate = connection.get_execution_options().get("scanbench_writing", False)
        connection.exec_driver_sql("BEGIN IMMEDIATE" if immediate else "BEGIN")


def _migrate(engine: Engine) -> None:
    config = Config()
    config.set_main_option("script_location", str(Path(__file__).parent / "migrations").replace("%", "%%"))
    with writing(engine) as connection:
        if engine.dialect.name == "postgresql":
            connection.execute(text("SELECT pg_advisory_xact_lock(:lock)"), {"lock": MIGRATION_LOCK})
        config.attributes["connection"] = connection
        command.upgrade(config, "head")
