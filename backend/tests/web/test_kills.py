"""`kill -9` under load, of a PLC's process and of the server: what was acknowledged is there again, each time.

A few rounds here. More: `SCANBENCH_KILLS=300 pytest -s tests/web/test_kills.py` kills the process 300 times and the server 30 times.
"""

import os
import random
import signal
import threading
from collections import defaultdict
from collections.abc import Sequence
from pathlib import Path
from time import monotonic

import httpx

from tests.web.server import Server

ROUNDS = int(os.environ.get("SCANBENCH_KILLS", "3"))
SOURCE = "PROGRAM Main\nVAR n : DINT; END_VAR\n  n := n + 1;\nEND_PROGRAM\n"
WORDS = 12
PATIENCE_S = 60


class Load:
    """Somebody who enters commands of one kind, one after the other, and notes what was acknowledged."""

    def __init__(self, instance: int, what: str, area: str) -> None:
        self._address, self._area = f"/api/instances/{instance}/{what}", area
        self.sent = 0
        self._over = threading.Event()
        self.acknowledged: dict[str, int] = {}
        self.open: dict[str, set[int]] = defaultdict(set)
        """Sent after the last that was acknowledged, and nobody knows what became of them."""
        self.count = threading.Semaphore(0)
        self._thread: threading.Thread | None = None

    def start(self, server: Server) -> None:
        self._over.clear()
        self._thread = threading.Thread(target=self._run, args=(server,))
        self._thread.start()

    def stop(self) -> None:
        assert self._thread is not None
        self._over.set()
        self._thread.join()

    def _run(self, server: Server) -> None:
        with httpx.Client(base_url=server.base, headers=server.http.headers, timeout=PATIENCE_S) as http:
            while not self._over.is_set():
                self.sent += 1
                path, value = f"{self._area}{self.sent % WORDS}", self.sent % 60_000
                self.open[path].add(value)
                try:
                    reply = http.post(self._address, json={"path": path, "value": str(value)})
                except httpx.TransportError:  # the server was killed
                    return
                if reply.status_code == 200:
                    assert reply.json()["ok"]
                    self.acknowledged[path] = value
                    self.open[path].clear()
                    self.count.release()
                else:
                    assert reply.status_code in (422, 503), reply.text

    def right(self, path: str, value: int | None) -> bool:
        """Whether this is what may be there: the last that was acknowledged, or one sent after it."""
        return value == self.acknowledged.get(path, 0) or value in self.open[path]

    def settle(self, path: str, value: int) -> None:
        """What is there now is known from here on."""
        if self.open[path]:
            self.acknowledged[path] = value
            self.open[path].clear()


class Story:
    """A PLC under load that is killed again and again."""

    def __init__(self, server: Server) -> None:
        self.instance = server.instance("mortal under load", "CJ1M-CPU63", main=SOURCE)
        self.writes, self.forces = Load(self.instance, "write", "D"), Load(self.instance, "force", "W")
        self._loads: Sequence[Load] = (self.writes, self.forces)
        self._chance = random.Random(os.environ.get("SCANBENCH_KILLS_SEED", "22"))

    def busy(self, server: Server) -> int:
        """Works for a while; the process to kill."""
        for load in self._loads:
            load.start(server)
        for _ in range(self._chance.randrange(1, 60)):
            assert self._chance.choice(self._loads).count.acquire(timeout=PATIENCE_S)
        pid = server.state(self.instance)["pid"]
        assert isinstance(pid, int)
        return pid

    def idle(self) -> None:
        for load in self._loads:
            load.stop()

    def runs(self, server: Server, before: int | None) -> None:
        """Waits for its next life, without a pause: what is told of it has to be right from the first moment on."""
        end = monotonic() + PATIENCE_S
        while (state := server.state(self.instance))["state"] != "running" or state["pid"] in (None, before):
            assert monotonic() < end, state
            assert state["state"] != "failed", state

    def look(self, server: Server, number: int) -> None:
        """Everything that was acknowledged is there."""
        listed = server.http.get(f"/api/instances/{self.instance}/forces").json()
        told = {each["path"]: _number(each["value"]) for each in listed}
        wrong = []
        for load in self._loads:
            for path in load.open:
                value = _value(server, self.instance, path)
                shown = value if load is self.writes else told.get(path, 0)
                if not load.right(path, value) or not load.right(path, shown):
                    wrong.append(f"{path} is {value}, shown {shown}, not {load.acknowledged.get(path)}")
                load.settle(path, value)
        assert not wrong, f"round {number}: {', '.join(wrong)}"
        if number % 10 == 9:
            print(f"{number + 1} rounds, {self.writes.sent + self.forces.sent} commands", flush=True)


def test_a_killed_plc_has_all_that_was_acknowledged(server: Server) -> None:
    story = Story(server)
    story.runs(server, None)
    for number in range(ROUNDS):
        if number % 3 == 2:  # after four deaths in a row, each soon after the start, it is given up
            for power in (False, True):
                server.http.patch(f"/api/instances/{story.instance}", json={"power": power})
            story.runs(server, None)
        pid = story.busy(server)
        os.kill(pid, signal.SIGKILL)
        story.idle()
        story.runs(server, pid)
        story.look(server, number)


if ROUNDS >= 10:

    def test_a_killed_server_has_all_that_was_acknowledged(tmp_path: Path) -> None:
        server = Server(tmp_path)
        try:
            story = Story(server)
            story.runs(server, None)
            for number in range(ROUNDS // 10):
                pid = story.busy(server)
                server.process.kill()
                story.idle()
                server.__exit__(None, None, None)
                server = Server(tmp_path)
                story.runs(server, pid)
                story.look(server, number)
        finally:
            server.__exit__(None, None, None)


def _value(server: Server, instance: int, path: str) -> int:
    reply = server.http.get(f"/api/instances/{instance}/value", params={"path": path})
    assert reply.status_code == 200, reply.text
    return _number(reply.json()["value"])


def _number(text: str) -> int:
    return int(text[3:], 16) if text.startswith("16#") else int(text)
