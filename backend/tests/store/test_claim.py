"""Two servers, one database."""

import subprocess
import sys

import pytest
from sqlalchemy.engine import make_url

from scanbench.store.claim import SERVER_LOCK, InUse
from scanbench.store.records import StoreError
from scanbench.store.store import Store

from .postgres import Server


def test_the_second_server_is_refused_and_told_who_is_there(url: str) -> None:
    first = Store(url, "desk, process 7")
    with pytest.raises(InUse, match=r"another server \(desk, process 7\).*SCANBENCH_DATABASE"):
        Store(url, "lab, process 8")
    Store(url).close()  # a migration, say: it runs no PLC
    first.projects.all()
    first.close()
    Store(url, "lab, process 8").close()


_SERVER = """
import os, signal, sys
from scanbench.store.records import StoreError
from scanbench.store.store import Store
store = Store(sys.argv[1], "killed")
print("claimed", flush=True)
sys.stdin.read()
"""


def test_a_killed_server_leaves_no_claim(url: str) -> None:
    command = [sys.executable, "-c", _SERVER, url]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as server:
        assert server.stdout is not None
        assert server.stdout.readline() == "claimed\n"
        with pytest.raises(InUse, match="killed"):
            Store(url, "successor")
        server.kill()
        server.wait()
    successor = None
    while successor is None:  # PostgreSQL notices the end of a connection a moment later
        try:
            successor = Store(url, "successor")
        except InUse:
            continue
    successor.close()


_BACKEND = """
SELECT pid FROM pg_locks WHERE locktype = 'advisory' AND granted AND objid = %s
AND database = (SELECT oid FROM pg_database WHERE datname = %s)
"""


def _cut(postgres: Server, url: str) -> None:
    """Ends the connection that holds the claim."""
    with postgres.connect() as connection:
        held = connection.execute(_BACKEND, (SERVER_LOCK, make_url(url).database)).fetchone()
        assert held is not None
        assert connection.execute("SELECT pg_terminate_backend(%s, 60000)", held).fetchone() == (True,)


def _unreachable(_claim: object) -> None:
    raise StoreError("no answer")


def test_a_claim_whose_connection_ended_is_taken_again_before_a_write(
    postgres: Server, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("scanbench.store.claim.LOOKED_S", 3600)
    url = postgres.database()
    first = Store(url, "desk, process 7")
    _cut(postgres, url)
    with monkeypatch.context() as down:
        down.setattr("scanbench.store.claim._PostgresClaim._claimed", _unreachable)
        for _ in range(2):
            with pytest.raises(StoreError, match="no answer"):
                first.projects.create("p", "CJ1M-CPU63")
    first.projects.create("p", "CJ1M-CPU63")
    with pytest.raises(InUse, match="desk, process 7"):
        Store(url, "lab, process 8")
    first.close()


def test_a_silent_server_notices_that_its_claim_is_lost(postgres: Server, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("scanbench.store.claim.LOOKED_S", 0.01)
    url = postgres.database()
    first = Store(url, "desk, process 7")
    _cut(postgres, url)
    held = None
    with postgres.connect() as connection:
        while held is None:
            held = connection.execute(_BACKEND, (SERVER_LOCK, make_url(url).database)).fetchone()
    first.close()


def test_nothing_is_written_any_more_if_a_second_server_was_faster(
    postgres: Server, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setattr("scanbench.store.claim.LOOKED_S", 3600)
    url = postgres.database()
    first = Store(url, "desk, process 7")
    _cut(postgres, url)
    second = Store(url, "lab, process 8")
    for _ in range(2):
        with pytest.raises(InUse, match=r"another server took the database: lab, process 8\. Nothing is written here"):
            first.projects.create("p", "CJ1M-CPU63")
    assert first.projects.all() == []
    second.close()
    with pytest.raises(InUse):  # what it knows may be old
        first.projects.create("p", "CJ1M-CPU63")
    first.close()
    assert [record.levelname for record in caplog.records] == ["CRITICAL"]
