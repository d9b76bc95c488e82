"""One server a database: two would each run its PLCs, and each would see the other's half of what happens to them.

The claim is the system's or the database's own lock, so it ends with the process that holds it, however that ends.
PostgreSQL's is that of a connection and ends with it: so it is looked after, and taken again, unless another server was
faster. Then this one writes nothing more.
"""

import fcntl
import logging
import os
import threading
from pathlib import Path
from typing import IO

from sqlalchemy import Connection, Engine, text
from sqlalchemy.exc import DBAPIError, SQLAlchemyError

from scanbench.store.records import StoreError

log = logging.getLogger("scanbench")
SERVER_LOCK = 0x5CA9BF
"""Number of PostgreSQL's advisory lock that a server holds."""
_HOLDER = text(
    "SELECT a.pid, a.application_name FROM pg_locks l JOIN pg_stat_activity a ON a.pid = l.pid "
    "WHERE l.locktype = 'advisory' AND l.granted AND l.classid = 0 AND l.objid = :lock AND l.objsubid = 1 "
    "AND l.database = (SELECT oid FROM pg_database WHERE datname = current_database())"
)
_NOTICED_S = 30
"""PostgreSQL asks so often whether the machine of a silent server is still there."""
LOOKED_S = 5.0
"""How often the server asks whether it still has its claim; it asks before it writes, too."""


class InUse(StoreError):
    """Another server holds the database; the message names it."""

    def __init__(self, message: str, holder: str = "", backend: int = 0) -> None:
        """`backend` is the number of its connection in PostgreSQL."""
        super().__init__(message)
        self.holder, self.backend = holder, backend


class Claim:
    """Held until `release`, or the end of the process."""

    def __init__(self, engine: Engine, server: str) -> None:
        """`server` is what others are told who want the database too. `InUse` when there is one already."""
        self._file: IO[str] | None = None
        self._postgres: _PostgresClaim | None = None
        if engine.dialect.name == "postgresql":
            self._postgres = _PostgresClaim(engine, server)
        elif engine.url.database not in (None, "", ":memory:"):
            self._file = _claim_file(Path(f"{Path(str(engine.url.database)).resolve()}.server"), server)

    def hold(self) -> None:
        """Before something is written: takes the claim again if it was lost. `InUse` when another server has it, for good."""
        if self._postgres is not None:
            self._postgres.hold()

    def release(self) -> None:
        """Somebody else may have the database."""
        if self._file is not None:
            self._file.close()
        if self._postgres is not None:
            self._postgres.release()


def _claim_file(path: Path, server: str) -> IO[str]:
    file = os.fdopen(os.open(path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600), "r+", encoding="utf-8")
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError as error:
        with file:
            raise InUse(_message(file.read())) from error
    file.truncate(0)
    file.write(server)
    file.flush()
    return file


class _PostgresClaim:
    """A connection that holds the lock, and a thread that looks after it."""

    def __init__(self, engine: Engine, server: str) -> None:
        self._engine, self._server = engine, server
        self._connection: Connection | None
        self._connection, self._backend = self._claimed()
        self._lost: InUse | None = None
        self._alone, self._over = threading.Lock(), threading.Event()
        threading.Thread(target=self._look, name="claim", daemon=True).start()

    def hold(self) -> None:
        with self._alone:
            if self._lost is not None:
                raise self._lost
            try:
                if self._connection is not None:
                    self._connection.execute(text("SELECT 1"))
                    return
            except DBAPIError:
                self._let_go()
            self._claim_again()

    def release(self) -> None:
        self._over.set()
        with self._alone:
            self._let_go()

    def _let_go(self) -> None:
        if self._connection is not None:
            self._connection.invalidate()  # the lock belongs to the connection, which must not go back to the pool
            self._connection.close()
            self._connection = None

    def _claim_again(self) -> None:
        try:
            self._connection, self._backend = self._claimed()
        except InUse as error:
            if error.backend == self._backend:  # our own, whose end PostgreSQL has not noticed yet
                raise StoreError(f"the connection to the database was lost, and is not free yet: {error}") from error
            message = f"the connection to the database was lost, and another server took the database: {error.holder}. "
            self._lost = InUse(
                message + "Nothing is written here any more: stop one of the two servers, then start this one again"
            )
            log.critical("%s", self._lost)
            raise self._lost from error
        log.warning("the connection that claims the database was lost: it is claimed again")

    def _look(self) -> None:
        while not self._over.wait(LOOKED_S):
            try:
                if not self._over.is_set():
                    self.hold()
            except InUse:
                return
            except (SQLAlchemyError, StoreError):
                continue  # whoever writes is told

    def _claimed(self) -> tuple[Connection, int]:
        """The connection, and its number in PostgreSQL."""
        connection = self._engine.connect().execution_options(isolation_level="AUTOCOMMIT")
        try:
            connection.execute(
                text(
                    "SELECT set_config('application_name', :name, false), set_config('tcp_keepalives_idle', :idle, false), "
                    "set_config('tcp_keepalives_interval', '10', false), set_config('tcp_keepalives_count', '3', false)"
                ),
                {"name": self._server, "idle": str(_NOTICED_S)},
            )
            if connection.scalar(text("SELECT pg_try_advisory_lock(:lock)"), {"lock": SERVER_LOCK}):
                return connection, connection.scalar(text("SELECT pg_backend_pid()")) or 0
            backend, holder = connection.execute(_HOLDER, {"lock": SERVER_LOCK}).first() or (0, "")
            raise InUse(_message(holder), holder, backend)
        except BaseException:
            connection.close()
            raise


def _message(holder: str) -> str:
    who = f"another server ({holder})" if holder else "another server"
    return f"the database is used by {who}: stop that one, or give this one a database of its own (SCANBENCH_DATABASE)"
