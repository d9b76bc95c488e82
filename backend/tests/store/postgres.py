"""A PostgreSQL server of the tests' own: a fresh cluster in a temporary directory, on a free port, gone afterwards."""

import getpass
import os
import pwd
import shutil
import signal
import socket
import subprocess
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from glob import glob
from pathlib import Path

import psycopg
from psycopg import sql

Command = list[str | Path]
PASSWORD = "only-for-this-run"


def binaries() -> Path:
    """The directory of initdb and postgres; an error that says what to install if there is none."""
    found = sorted(glob("/usr/lib/postgresql/*/bin/initdb"), key=lambda path: int(path.split("/")[4]))
    path = found[-1] if found else shutil.which("initdb")
    if path is None:
        raise RuntimeError("PostgreSQL's server is missing, and these tests need it: apt-get install postgresql")
    return Path(path).parent


class Server:
    """A running server; each `database()` is a fresh one."""

    def __init__(self, port: int) -> None:
        self._port = port
        self._made = 0

    def database(self) -> str:
        """Makes an empty database; its URL."""
        self._made += 1
        name = f"test_{self._made}"
        with self.connect() as connection:
            connection.execute(sql.SQL("CREATE DATABASE {}").format(sql.Identifier(name)))
        return f"postgresql+psycopg://bench:{PASSWORD}@127.0.0.1:{self._port}/{name}"

    def connect(self) -> psycopg.Connection:
        """A connection to the server itself."""
        return psycopg.connect(
            host="127.0.0.1", port=self._port, user="bench", password=PASSWORD, dbname="postgres", autocommit=True
        )


@contextmanager
def server() -> Iterator[Server]:
    """Starts one and stops it at the end."""
    bin_ = binaries()
    base = Path(tempfile.mkdtemp(prefix="scanbench-postgres-"))
    try:
        user = _unprivileged()
        base.chmod(0o755)
        home = base / "home"
        home.mkdir(mode=0o700)
        if user is not None:
            os.chown(home, user.pw_uid, user.pw_gid)
        password = base / "password"
        password.write_text(PASSWORD, encoding="utf-8")
        initdb: Command = [bin_ / "initdb", "-D", home / "data", "-U", "bench", "-E", "UTF8", "--locale=C", "--no-sync"]
        initdb += ["--auth-local=peer", "--auth-host=scram-sha-256", f"--pwfile={password}"]
        made = subprocess.run(_as(user, initdb), capture_output=True, text=True, cwd=base, check=False)
        if made.returncode != 0:
            raise RuntimeError(f"initdb failed: {made.stderr or made.stdout}")
        yield from _running(bin_, base, home, user)
    finally:
        shutil.rmtree(base, ignore_errors=True)


def _running(bin_: Path, base: Path, home: Path, user: pwd.struct_passwd | None) -> Iterator[Server]:
    port = _free_port()
    start: Command = [bin_ / "postgres", "-D", home / "data", "-p", str(port), "-h", "127.0.0.1", "-k", home]
    start += ["-c", "fsync=off", "-c", "full_page_writes=off", "-c", "max_connections=50"]
    log = base / "log"
    with log.open("wb") as output:
        process = subprocess.Popen(_as(user, start), stdout=output, stderr=output, cwd=base)
        try:
            running = Server(port)
            _wait(running, process, log)
            yield running
        finally:
            process.send_signal(signal.SIGINT)  # "fast shutdown"
            process.wait(30)


def _wait(running: Server, process: subprocess.Popen[bytes], log: Path) -> None:
    deadline = time.monotonic() + 60
    while True:
        try:
            running.connect().close()
            return
        except psycopg.OperationalError as error:
            if process.poll() is not None or time.monotonic() > deadline:
                raise RuntimeError(f"PostgreSQL did not start: {log.read_text(errors='replace')}") from error
            time.sleep(0.05)


def _unprivileged() -> pwd.struct_passwd | None:
    """PostgreSQL refuses to run as root; None: we are somebody else already."""
    if getpass.getuser() != "root" and os.geteuid() != 0:
        return None
    for name in ("postgres", "nobody"):
        try:
            return pwd.getpwnam(name)
        except KeyError:
            continue
    raise RuntimeError("the tests run as root and there is no user 'postgres' or 'nobody' for PostgreSQL to run as")


def _as(user: pwd.struct_passwd | None, command: Command) -> Command:
    if user is None:
        return command
    return ["setpriv", f"--reuid={user.pw_uid}", f"--regid={user.pw_gid}", "--clear-groups", *command]


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])
