"""`kill -9` of a PLC's process under load: what was acknowledged is there again, each time.

Three rounds here; `SCANBENCH_KILLS=300 pytest tests/web/test_kills.py` proves more.
"""

import os
import random
import signal
import threading
from collections import defaultdict
from time import monotonic

import httpx

from tests.web.server import Server
from tests.web.test_restart import until

ROUNDS = int(os.environ.get("SCANBENCH_KILLS", "3"))
SOURCE = "PROGRAM Main\nVAR n : DINT; END_VAR\n  n := n + 1;\nEND_PROGRAM\n"
WORDS = 12


class Load:
    """Somebody who enters commands of one kind, one after the other, and notes what was acknowledged."""

    def __init__(self, server: Server, instance: int, what: str, area: str) -> None:
        self._server, self._address, self._area = server, f"/api/instances/{instance}/{what}", area
        self._number = 0
        self._over = threading.Event()
        self.acknowledged: dict[str, int] = {}
        self.open: dict[str, set[int]] = defaultdict(set)
        """Of those behind the last that was acknowledged: sent, and nobody knows what became of them."""
        self.count = threading.Semaphore(0)
        self._thread = threading.Thread(target=self._run)

    def start(self) -> None:
        self._over.clear()
        self._thread = threading.Thread(target=self._run)
        self._thread.start()

    def stop(self) -> None:
        self._over.set()
        self._thread.join()

    def _run(self) -> None:
        with httpx.Client(base_url=self._server.base, headers=self._server.http.headers, timeout=60) as http:
            while not self._over.is_set():
                self._number += 1
                path, value = f"{self._area}{self._number % WORDS}", self._number % 60_000
                self.open[path].add(value)
                reply = http.post(self._address, json={"path": path, "value": str(value)})
                if reply.status_code == 200:
                    assert reply.json()["ok"]
                    self.acknowledged[path] = value
                    self.open[path].clear()
                    self.count.release()
                else:
                    assert reply.status_code in (422, 503), reply.text

    def right(self, path: str, value: int | None) -> bool:
        """Whether this is what may be there: the last that was acknowledged, or one behind it."""
        return value == self.acknowledged.get(path) or value in self.open[path]


def test_a_killed_plc_has_all_that_was_acknowledged(server: Server) -> None:
    instance = server.instance("mortal under load", "CJ1M-CPU63", main=SOURCE)
    chance = random.Random(os.environ.get("SCANBENCH_KILLS_SEED", "22"))
    writes, forces = Load(server, instance, "write", "D"), Load(server, instance, "force", "W")
    loads = (writes, forces)
    until(lambda: server.state(instance)["state"] == "running", 30)
    for number in range(ROUNDS):
        if number % 3 == 2:  # four deaths in a row, each soon after the start, and it is given up
            server.http.patch(f"/api/instances/{instance}", json={"power": False})
            server.http.patch(f"/api/instances/{instance}", json={"power": True})
            until(lambda: server.state(instance)["state"] == "running", 30)
        for load in loads:
            load.start()
        for _ in range(chance.randrange(1, 60)):
            assert chance.choice(loads).count.acquire(timeout=60)
        pid = server.state(instance)["pid"]
        os.kill(pid, signal.SIGKILL)
        for load in loads:
            load.stop()
        _runs(server, instance, pid)
        told = {each["path"]: each for each in server.http.get(f"/api/instances/{instance}/forces").json()}
        wrong = []
        for path in forces.open:
            value = _value(server, instance, path)
            shown = _number(told[path]["value"]) if path in told else None
            if not forces.right(path, value) or not forces.right(path, shown):
                wrong.append((path, value, shown, forces.acknowledged.get(path), forces.open[path]))
        for path in writes.open:
            value = _value(server, instance, path)
            if not writes.right(path, value):
                wrong.append((path, value, None, writes.acknowledged.get(path), writes.open[path]))
        assert not wrong, f"round {number}: {wrong}"
        for load in loads:  # what is open now is known from here on
            for path in load.open:
                found = _value(server, instance, path)
                if load.open[path] and found in load.open[path]:
                    load.acknowledged[path] = found
                load.open[path].clear()
        if ROUNDS > 10 and number % 10 == 9:
            print(f"{number + 1} rounds, {writes._number + forces._number} commands", flush=True)


def _runs(server: Server, instance: int, before: int) -> None:
    """Waits for its next life, without a pause: what is told of it has to be right from the first moment on."""
    end = monotonic() + 60
    while (state := server.state(instance))["state"] != "running" or state["pid"] in (None, before):
        assert monotonic() < end, state
        assert state["state"] != "failed", state


def _value(server: Server, instance: int, path: str) -> int:
    reply = server.http.get(f"/api/instances/{instance}/value", params={"path": path})
    assert reply.status_code == 200, reply.text
    return _number(reply.json()["value"])


def _number(text: str) -> int:
    return int(text[3:], 16) if text.startswith("16#") else int(text)
