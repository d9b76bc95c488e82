"""One server a database: two would each run its PLCs, and each would see the other's half of what happens to them.

The claim is the system's or the database's own lock, so it ends with the process that holds it, however that ends.
"""

import fcntl
import os
from pathlib import Path
from typing import IO

from sqlalchemy import Connection, Engine, text

from scanbench.store.records import StoreError

SERVER_LOCK = 0x5CA9BF
"""Number of PostgreSQL's advisory lock that a server holds."""
_HOLDER = text(
    "SELECT a.application_name FROM pg_locks l JOIN pg_stat_activity a ON a.pid = l.pid "
    "WHERE l.locktype = 'advisory' AND l.granted AND l.classid = 0 AND l.objid = :lock AND l.objsubid = 1 "
    "AND l.database = (SELECT oid FROM pg_database WHERE datname = current_database())"
)
_NOTICED_S = 30
"""PostgreSQL asks so often whether the machine of a silent server is still there."""


class InUse(StoreError):
    """Another server holds the database; the message names it."""


class Claim:
    """Held until `release`, or the end of the process."""

    def __init__(self, engine: Engine, server: str) -> None:
        """`server` is what others are told who want the database too. `InUse` when there is one already."""
        self._file: IO[str] | None = None
        self._connection: Connection | None = None
        if engine.dialect.name == "postgresql":
            self._connection = _claim_postgres(engine, server)
        elif engine.url.database not in (None, "", ":memory:"):
            self._file = _claim_file(Path(f"{Path(str(engine.url.database)).resolve()}.server"), server)

    def release(self) -> None:
        """Somebody else may have the database."""
        if self._file is not None:
            self._file.close()
        if self._connection is not None:
            self._connection.invalidate()  # the lock belongs to the connection, which must not go back to the pool
            self._connection.close()


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


def _claim_postgres(engine: Engine, server: str) -> Connection:
    connection = engine.connect().execution_options(isolation_level="AUTOCOMMIT")
    try:
        connection.execute(
            text(
                "SELECT set_config('application_name', :name, false), set_config('tcp_keepalives_idle', :idle, false), "
                "set_config('tcp_keepalives_interval', '10', false), set_config('tcp_keepalives_count', '3', false)"
            ),
            {"name": server, "idle": str(_NOTICED_S)},
        )
        if connection.scalar(text("SELECT pg_try_advisory_lock(:lock)"), {"lock": SERVER_LOCK}):
            return connection
        raise InUse(_message(connection.scalar(_HOLDER, {"lock": SERVER_LOCK}) or ""))
    except BaseException:
        connection.close()
        raise


def _message(holder: str) -> str:
    who = f"another server ({holder})" if holder else "another server"
    return f"the database is used by {who}: stop that one, or give this one a database of its own (SCANBENCH_DATABASE)"
