"""A database that is open, and what all repositories need."""

from collections.abc import Iterator
from contextlib import contextmanager

from sqlalchemy import Engine
from sqlalchemy.exc import DataError, InterfaceError, OperationalError
from sqlalchemy.orm import Session

from scanbench.store.claim import Claim
from scanbench.store.database import WRITING, open_database
from scanbench.store.records import NotFound, NotStorable, StoreError
from scanbench.store.tables import Instance, Project


class Database:
    """Reads and writes in transactions. Safe to use from several threads and processes."""

    def __init__(self, url: str, server: str | None = None) -> None:
        """Opens it, and brings its tables up to date; `StoreError` says why it cannot.

        A `server` claims it for itself, under this name; `InUse` when another one has.
        """
        self._claim: Claim | None = None

        def claim(engine: Engine) -> None:
            if server is not None:
                self._claim = Claim(engine, server)

        try:
            self._engine = open_database(url, claim)
        except BaseException:
            self._release()
            raise
        self._writer = self._engine.execution_options(**WRITING)

    def close(self) -> None:
        """Gives the connections back, and the claim."""
        self._release()
        self._engine.dispose()

    def _release(self) -> None:
        if self._claim is not None:
            self._claim.release()
            self._claim = None

    @contextmanager
    def reading(self) -> Iterator[Session]:
        """A transaction that changes nothing."""
        with _explained(), Session(self._engine) as session:
            yield session

    @contextmanager
    def writing(self) -> Iterator[Session]:
        """A transaction: all of it is kept at its end, or nothing."""
        with _explained():
            if self._claim is not None:
                self._claim.hold()
            with Session(self._writer) as session, session.begin():
                yield session


class Repository:
    """Methods over some tables of a database, each one transaction."""

    def __init__(self, database: Database) -> None:
        self._database = database


@contextmanager
def _explained() -> Iterator[None]:
    """What the database itself refuses, in our words."""
    try:
        yield
    except (OperationalError, InterfaceError) as error:
        raise StoreError(f"the database cannot be used now: {error.orig}; nothing was changed") from error
    except DataError as error:
        raise NotStorable(f"no database keeps this: {error.orig}") from error
    except OverflowError as error:  # sqlite3's own, with a number of more than 64 bits
        raise NotStorable(f"no database keeps this: {error}") from error


def check(what: str, text: str, limit: int | None = None) -> None:
    """The two databases differ in what they refuse; so it is refused here, with words."""
    if "\x00" in text:
        raise NotStorable(f"{what} contains a NUL character: remove it")
    if limit is not None and not 0 < len(text) <= limit:
        raise NotStorable(f"{what} has {len(text)} characters, 1 to {limit} are possible")


def the_project(session: Session, id: int, lock: bool = False) -> Project:
    """The project of this number, or `NotFound`. `lock`: until the end of the transaction nobody else gets it so."""
    found = session.get(Project, id, with_for_update=True if lock else None)
    if found is None:
        raise NotFound(f"there is no project {id}")
    return found


def the_instance(session: Session, id: int, lock: bool = False) -> Instance:
    """`lock`: until the end of the transaction nobody else changes what hangs on this instance."""
    found = session.get(Instance, id, with_for_update=True if lock else None)
    if found is None:
        raise NotFound(f"there is no instance {id}")
    return found
