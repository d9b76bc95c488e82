"""Deaths and restarts: of the server, of a PLC that dies again and again; and browsers that do not keep up."""

import json
import os
import signal
import socket
import sqlite3
import struct
import time
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

import pytest
from websockets.sync.client import connect

from tests.amounts import slow
from tests.web.server import PATIENCE_S, Server

SOURCE = "PROGRAM Main\nVAR n : DINT; basic AT A402.12 : BOOL; END_VAR\n  n := n + 1;\nEND_PROGRAM\n"


def alive(pid: int) -> bool:
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):
        return False


def kept(data: Path, instance: int) -> list[str]:
    """What the database has in its history of errors."""
    with closing(sqlite3.connect(data / "scanbench.db")) as database:
        found = database.execute("SELECT status FROM error_history WHERE instance_id = ?", (instance,))
        return [str(status) for (status,) in found]


def until(condition: Callable[[], bool], timeout: float = PATIENCE_S) -> None:
    end = time.monotonic() + timeout
    while not condition():
        assert time.monotonic() < end, "not in time"
        time.sleep(0.02)


@pytest.mark.parametrize("kill", [pytest.param(signal.SIGTERM, marks=slow), signal.SIGKILL])
def test_a_restarted_server_goes_on_with_every_run(tmp_path: Path, kill: signal.Signals) -> None:
    with Server(tmp_path) as server:
        instance = server.instance("kept", "CJ1M-CPU63", main=SOURCE)
        with server.browser(instance) as browser:
            assert browser.ask(type="generate", errors=[{"id": "basic-io-error", "details": {"slot": "3"}}])["ok"]
            browser.wait_for("errors")
            browser.watch("Main.n")
            browser.wait(lambda: (browser.number("Main.n") or 0) > 100)
            count = browser.number("Main.n") or 0
        paused = server.instance("paused", "CJ1M-CPU63", main=SOURCE)
        drive = f"/api/instances/{paused}/run"
        server.http.post(drive, json={"action": "pause", "speed": 0})
        scan = server.http.post(drive, json={"action": "scan"}).json()["scan"]
        paths = verified(server, paused, instance)
        before = [server.http.get(path).json() for path in paths]
        until(lambda: kept(tmp_path, instance) == ["generated"])  # history is written in the background
        pids = [each["state"]["pid"] for each in server.http.get("/api/instances").json()]
        assert len(pids) == 5  # the samples and these
        assert all(map(alive, pids))
        os.kill(server.process.pid, kill)
        server.process.wait(PATIENCE_S)
        until(lambda: not any(map(alive, pids)))

    with Server(tmp_path) as again:
        names = [each["name"] for each in again.http.get("/api/instances").json()]
        assert names == ["line-1", "line-2", "line-3", "kept", "paused"]
        rows = {row["id"]: row for row in again.http.get(f"/api/instances/{instance}/errors").json()}
        row = rows["basic-io-error"]
        assert (row["status"], row["count"], row["by"]) == ("generated", 1, "Ada Lovelace")  # it is still present
        assert "slot=3" in row["details"]
        with again.browser(instance) as browser:
            assert any("basic-io-error" in line["text"] for line in browser.hello["log"])
            browser.watch("Main.n", "Main.basic")
            known = [browser.hello["timeline"], *(m for m in browser.messages if m["type"] == "timeline")]
            assert any("basic-io-error" in mark["text"] for each in known for mark in each["marks"])
            browser.wait(lambda: (browser.number("Main.n") or 0) >= count)
            assert browser.number("Main.basic") == 1
        with again.browser(paused) as browser:
            state = browser.hello["instance"]["state"]
            if state["state"] == "starting":
                state = browser.wait_state("paused")
            assert (state["state"], state["scan"], state["speed"]) == ("paused", scan, 0)
            browser.wait(lambda: [again.http.get(path).json() for path in paths] == before)


def verified(server: Server, paused: int, running: int) -> list[str]:
    """Verifications, a campaign and a comparison that are over, or wait: where to ask what came of them."""
    url = f"/api/instances/{paused}"
    for wanted in ({"first": 0}, {"first": 0, "last": 0, "range": {"pou": "Main"}}, {}):
        assert server.http.post(f"{url}/verifications", json=wanted).status_code == 201
    long = server.http.post(f"/api/instances/{running}/verifications", json={"first": 0, "last": 50}).json()
    campaign = server.http.post(f"{url}/campaigns", json={"count": 3, "seed": 7, "window": 1})
    assert campaign.status_code == 201, campaign.text
    infos = [*server.http.get(f"{url}/verifications").json(), long]
    paths = [
        path for each in infos for path in (f"/api/verifications/{each['id']}", f"/api/verifications/{each['id']}/rows")
    ]
    compared = server.http.post(f"{url}/comparisons", json={"other": running})
    assert compared.status_code == 201, compared.text
    paths += [f"/api/campaigns/{campaign.json()['id']}", f"/api/comparisons/{compared.json()['id']}"]

    def over() -> bool:
        states = [server.http.get(path).json().get("state") for path in paths[:-2:2]]
        tried, compared = (server.http.get(path).json() for path in paths[-2:])
        return states == ["done", "done", "verifying", "done"] and tried["state"]["over"] and bool(compared["result"])

    until(over)
    return paths


def children(pid: int) -> list[int]:
    found = [int(each) for each in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]
    threads = [path for path in Path(f"/proc/{pid}/task").iterdir() if path.name != str(pid)]
    return found + [int(each) for path in threads for each in (path / "children").read_text().split()]


@slow
def test_a_server_ends_with_all_its_children_also_frozen_ones(tmp_path: Path) -> None:
    with Server(tmp_path) as server:
        instance = server.instance("frozen", "CJ1M-CPU63", main=SOURCE)
        until(lambda: server.state(instance)["state"] == "running")
        pids = children(server.process.pid)
        assert len(pids) >= 5  # the samples and this one, the checker, the zygote
        for pid in pids:
            os.kill(pid, signal.SIGSTOP)
        server.process.terminate()
        assert server.process.wait(PATIENCE_S) == -signal.SIGTERM  # uvicorn ends in order, and then by the signal
        until(lambda: not any(map(alive, pids)))


def test_a_plc_that_dies_again_and_again_is_given_up_and_can_be_revived(server: Server) -> None:
    instance = server.instance("mortal", "CJ1M-CPU63", main=SOURCE)
    with server.browser(instance) as browser:
        for _ in range(5):
            until(lambda: server.state(instance)["state"] == "running")
            os.kill(server.state(instance)["pid"], signal.SIGKILL)
            until(lambda: server.state(instance)["state"] != "running")
        failed = browser.wait_state("failed")
        assert "not started again" in failed["message"]
        refused = browser.ask(type="write", path="Main.n", value="1")
        assert not refused["ok"]
        assert "failed" in refused["message"]
        assert browser.ask(type="new_run")["ok"]
        browser.wait_state("running")
        browser.watch("Main.n")
        browser.wait(lambda: (browser.number("Main.n") or 0) > 5)


@slow
def test_a_slow_browser_gets_a_snapshot_and_the_others_do_not_wait(server: Server) -> None:
    count = 20_000
    source = (
        f"PROGRAM Main\nVAR v : ARRAY[1..{count}] OF DINT; i : DINT; n : DINT; END_VAR\n"
        f"  n := n + 1;\n  FOR i := 1 TO {count} DO v[i] := n; END_FOR;\nEND_PROGRAM\n"
    )
    instance = server.instance("slow", "GENERIC-IEC", main=source)
    sock = socket.create_connection(("127.0.0.1", server.port))
    sock.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 65536)
    address = f"ws://127.0.0.1:{server.port}/api/instances/{instance}/socket?token={server.token}"
    with (
        connect(address, sock=sock, max_queue=1, max_size=None, compression=None) as slow,
        server.browser(instance) as quick,
    ):
        paths = [f"Main.v[{index}]" for index in range(1, count + 1)]
        slow.send(json.dumps({"type": "watch", "ref": 1, "paths": paths}))
        quick.watch("Main.n")
        quick.wait(lambda: (quick.number("Main.n") or 0) > 0)
        first, frames = quick.number("Main.n") or 0, quick.frames
        # the slow one reads nothing all this time
        quick.wait(lambda: quick.frames > frames + 20 and (quick.number("Main.n") or 0) > first + 300)
        seen: list[tuple[int, int, int]] = []
        # What was on its way when it stopped reading may be a snapshot too, an old one.
        while not (seen and seen[-1][0] and seen[-1][2] > first + 300):
            data = slow.recv(PATIENCE_S)
            if isinstance(data, bytes):
                _, full, _, values, scan, _ = struct.unpack_from("<BBHIQq", data)
                seen.append((full, values, scan))
        assert seen[-1][1] == count + 1  # with the other's path: a frame is made once for all
        assert len(seen) < 70
