"""Two servers, one database."""

import subprocess
import sys

import pytest

from scanbench.store.claim import InUse
from scanbench.store.store import Store


def test_the_second_server_is_refused_and_told_who_is_there(url: str) -> None:
    first = Store(url, "desk, process 7")
    with pytest.raises(InUse, match=r"another server \(desk, process 7\).*SCANBENCH_DATABASE"):
        Store(url, "lab, process 8")
    Store(url).close()  # a migration, say: it runs no PLC
    first.projects()
    first.close()
    Store(url, "lab, process 8").close()


_SERVER = """
import os, signal, sys
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
