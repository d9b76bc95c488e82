"""The server of `bench comm`, and what its processes take."""

import re
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import httpx

_TICKS = 100
"""Of a second, in /proc."""


@dataclass(frozen=True, slots=True)
class Used:
    """Seconds of a core."""

    plc: float
    server: float
    others: float
    """Of the other processes that the server has: that of OPC UA most of all."""
    machine: float
    """Of all cores, whoever used them."""


class Bench:
    """A server, with a PLC on which the load is, and as many more as are wanted."""

    def __init__(self, folder: Path) -> None:
        self.process = subprocess.Popen(
            [sys.executable, "-m", "scanbench", "serve", "--port", "0", "--data", str(folder)],
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
        )  # fmt: skip
        assert self.process.stdout is not None
        found = None
        while found is None:
            line = self.process.stdout.readline()
            if not line:
                raise SystemExit("the server did not start")
            found = re.search(r"(http://[\w.:]+)/\?token=(\S+)", line)
        self.http = httpx.Client(base_url=found[1], headers={"Authorization": f"Bearer {found[2]}"}, timeout=60)
        for each in self.http.get("/api/instances").json():
            self.http.patch(f"/api/instances/{each['id']}", json={"power": False})

    def plc(self, model: str, source: str) -> "Plc":
        """One more PLC, which runs."""
        project = self.http.post("/api/projects", json={"name": f"bench {model}", "model": model}).json()["id"]
        self.http.put(f"/api/projects/{project}/files/main.st", json={"text": source, "version": 0})
        made = self.http.post("/api/instances", json={"project": project, "name": f"bench {model}"})
        plc = Plc(self, int(made.raise_for_status().json()["id"]))
        while plc.state["state"] != "running":
            time.sleep(0.1)
        return plc

    def close(self) -> None:
        self.http.close()
        self.process.terminate()
        self.process.wait(30)


class Plc:
    """One PLC of the server."""

    def __init__(self, bench: Bench, instance: int) -> None:
        self._bench, self._instance = bench, instance

    @property
    def state(self) -> dict[str, Any]:
        return dict(self._bench.http.get(f"/api/instances/{self._instance}").json()["state"])

    def switch_on(self, kind: str) -> int:
        wanted = {"on": True, "access": "write", "port": 0}
        told = self._bench.http.put(f"/api/instances/{self._instance}/communication/{kind}", json=wanted).json()
        (address,) = (each["address"] for each in told["servers"] if each["kind"] == kind)
        return int(str(address).rpartition(":")[2])

    def switch_off(self) -> None:
        self._bench.http.patch(f"/api/instances/{self._instance}", json={"power": False}).raise_for_status()

    def new_pace(self) -> None:
        """Lateness is counted from here on."""
        for action in ("pause", "continue"):
            self._bench.http.post(f"/api/instances/{self._instance}/run", json={"action": action}).raise_for_status()

    def used(self) -> Used:
        """What was used until now."""
        plc, server = self.state["pid"], self._bench.process.pid
        children = Path(f"/proc/{server}/task").glob("*/children")
        others = {int(pid) for each in children for pid in each.read_text().split()} - {plc}
        busy = list(map(int, Path("/proc/stat").read_text().splitlines()[0].split()[1:9]))
        idle = busy[3] + busy[4]
        return Used(_cpu(plc), _cpu(server), sum(map(_cpu, others)), (sum(busy) - idle) / _TICKS)


def _cpu(pid: int) -> float:
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / _TICKS
