"""`python -m bench comm`: FINS, Modbus and OPC UA clients at one virtual PLC of a real server.

Latencies are those of the clients, from request to answer, in milliseconds; the PLC runs scans of 10 ms. CPU is of one core, of the
PLC's process and of the server's. Late scans are those that begin after the next one was due: counted without clients, with them, and under a storm of broken frames, in one run.
"""

import argparse
import asyncio
import json
import random
import re
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import httpx

from bench.fins_clients import PER_SECOND, WORDS, Udp, fins, fins_from
from bench.opcua_clients import reads, subscribed

CLIENTS = 50
UA_CLIENTS, UA_NODES, UA_MS, UA_CHANGING = 10, 1000, 100, 100
"""So many clients subscribe to so many variables each, ten times a second; so many of them change with each scan."""
UA_READY_S = 25.0
"""So long until all of them have subscribed."""
_SOURCE = (
    "PROGRAM Main\nVAR n : DINT; level AT D100 : INT;\n"
    + "".join(f"  v{each} : INT;\n" for each in range(UA_NODES))
    + "END_VAR\n  n := n + 1;\n"
    + "".join(f"  v{each} := v{each} + 1;\n" for each in range(UA_CHANGING))
    + "END_PROGRAM\n"
)
_TICKS = 100
"""Of a second, in /proc."""


@dataclass(frozen=True, slots=True)
class Load:
    """What clients saw, and what it cost."""

    what: str
    requests: int
    per_second: float
    p50_ms: float
    p99_ms: float
    worst_ms: float
    host_percent: float
    server_percent: float
    others_percent: float
    """Of further processes of the server: that of OPC UA."""
    late_percent: float
    """Scans that began after the next one was due."""


class Bench:
    """A server with one PLC."""

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
        project = self.http.post("/api/projects", json={"name": "bench", "model": "CJ1M-CPU13"}).json()["id"]
        self.http.put(f"/api/projects/{project}/files/main.st", json={"text": _SOURCE, "version": 0})
        made = self.http.post("/api/instances", json={"project": project, "name": "bench"})
        self.instance = int(made.raise_for_status().json()["id"])
        while self.state["state"] != "running":
            time.sleep(0.1)

    @property
    def state(self) -> dict[str, Any]:
        return dict(self.http.get(f"/api/instances/{self.instance}").json()["state"])

    def switch_on(self, kind: str) -> int:
        wanted = {"on": True, "access": "write", "port": 0}
        told = self.http.put(f"/api/instances/{self.instance}/communication/{kind}", json=wanted).json()
        (address,) = (each["address"] for each in told["servers"] if each["kind"] == kind)
        return int(str(address).rpartition(":")[2])

    def new_pace(self) -> None:
        """Lateness is counted from here on."""
        self.http.post(f"/api/instances/{self.instance}/run", json={"action": "pause"}).raise_for_status()
        self.http.post(f"/api/instances/{self.instance}/run", json={"action": "continue"}).raise_for_status()

    def cpu(self) -> tuple[float, float, float]:
        """Seconds of the PLC's process, of the server's, and of the others that the server has: that of OPC UA most of all."""
        plc, server = self.state["pid"], self.process.pid
        children = Path(f"/proc/{server}/task").glob("*/children")
        others = {int(pid) for each in children for pid in each.read_text().split()} - {plc}
        return _cpu(plc), _cpu(server), sum(map(_cpu, others))

    def close(self) -> None:
        self.http.close()
        self.process.terminate()
        self.process.wait(30)


def _cpu(pid: int) -> float:
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / _TICKS


async def modbus(port: int, clients: int, seconds: float) -> list[float]:
    """The same by Modbus."""
    loop, took = asyncio.get_running_loop(), list[float]()

    async def one(number: int) -> None:
        reader, writer = await asyncio.open_connection("127.0.0.1", port)
        begin = loop.time() + number / clients / PER_SECOND
        for at in range(int(seconds * PER_SECOND)):
            await asyncio.sleep(begin + at / PER_SECOND - loop.time())
            asked = loop.time()
            writer.write(bytes((0, at % 256, 0, 0, 0, 6, 1, 3, 0, 100, 0, WORDS)))
            await reader.readexactly(9 + 2 * WORDS)
            took.append(loop.time() - asked)
        writer.close()

    await asyncio.gather(*(one(number) for number in range(clients)))
    return took


async def storm(port: int, frames: int) -> list[float]:
    """Broken frames as fast as the server answers: a request with bytes changed, some 64 at once."""
    loop, chance = asyncio.get_running_loop(), random.Random(7)
    transport, _ = await loop.create_datagram_endpoint(lambda: Udp(1), remote_addr=("127.0.0.1", port))
    whole = bytes.fromhex("8000020001000019000101018200640000030000")
    for at in range(frames):
        frame = bytearray(whole)
        for _ in range(chance.randrange(1, 5)):
            frame[chance.randrange(1, len(frame))] = chance.randrange(256)
        transport.sendto(bytes(frame[: chance.randrange(len(frame))]))
        if at % 64 == 0:
            await asyncio.sleep(0.002)
    transport.close()
    return []


def measure(bench: Bench, what: str, work: Any, seconds: float) -> Load:
    """Runs clients, or just waits."""
    bench.new_pace()
    before, begin = bench.cpu(), time.perf_counter()
    took = sorted(asyncio.run(work)) if work is not None else []
    if work is None:
        time.sleep(seconds)
    lasted, after, state = time.perf_counter() - begin, bench.cpu(), bench.state
    percent = [100 * (b - a) / lasted for a, b in zip(before, after, strict=True)]
    return _load(what, took, lasted, percent, state)


def measure_opcua(
    bench: Bench, what: str, work: Callable[..., list[float]], port: int, clients: int, nodes: int, seconds: float,
    beside: tuple[int, int] | None = None,
) -> list[Load]:  # fmt: skip
    """`beside`: port and number of clients of FINS at the same time, in a process of their own. Clients that have subscribed, or that read. A latency is from request to answer; of what is subscribed to, from when a value was
    read in the PLC to when the client has it."""
    begin = time.time() + UA_READY_S
    with ProcessPoolExecutor(clients + 1) as pool:
        others = None if beside is None else pool.submit(fins_from, *beside, begin, seconds)
        waiting = [
            pool.submit(work, port, nodes, UA_MS, begin + each * UA_MS / clients / 1000, seconds)
            for each in range(clients)
        ]
        time.sleep(begin - time.time())
        bench.new_pace()
        before, at = bench.cpu(), time.perf_counter()
        time.sleep(seconds)
        lasted, after, state = time.perf_counter() - at, bench.cpu(), bench.state
        took = sorted(each for one in waiting for each in one.result())
        asked = None if others is None else sorted(others.result())
    percent = [100 * (b - a) / lasted for a, b in zip(before, after, strict=True)]
    loads = [_load(what, took, lasted, percent, state)]
    return loads if asked is None else [*loads, _load("  FINS then", asked, lasted, percent, state)]


def _load(what: str, took: list[float], lasted: float, percent: list[float], state: dict[str, Any]) -> Load:
    p50, p99, worst = (1000 * took[min(len(took) - 1, int(q * len(took)))] if took else 0.0 for q in (0.5, 0.99, 1))
    return Load(
        what, len(took), len(took) / lasted, p50, p99, worst, percent[0], percent[1], percent[2], state["late_percent"]
    )


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m bench comm", description=__doc__)
    parser.add_argument("--clients", type=int, default=CLIENTS)
    parser.add_argument("--ua-clients", type=int, default=UA_CLIENTS, help="of OPC UA")
    parser.add_argument("--seconds", type=float, default=10)
    parser.add_argument("--storm", type=int, default=100_000, help="broken frames")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(Path(folder))
        try:
            port, other = bench.switch_on("fins"), bench.switch_on("modbus")
            ua = bench.switch_on("opcua")
            loads = [
                measure(bench, "no client", None, given.seconds),
                measure(bench, "FINS", fins(port, given.clients, given.seconds), given.seconds),
                measure(bench, "Modbus", modbus(other, min(16, given.clients), given.seconds), given.seconds),
                *measure_opcua(bench, "OPC UA reads", reads, ua, given.ua_clients, WORDS, given.seconds),
                *measure_opcua(bench, "OPC UA", subscribed, ua, given.ua_clients, UA_NODES, given.seconds),
                *measure_opcua(
                    bench,
                    "OPC UA, FINS",
                    subscribed,
                    ua,
                    given.ua_clients,
                    UA_NODES,
                    given.seconds,
                    (port, given.clients),
                ),
                measure(bench, "broken frames", storm(port, given.storm), given.seconds),
                measure(bench, "no client", None, given.seconds),
            ]
        finally:
            bench.close()
    if given.json:
        sys.stdout.write(json.dumps([asdict(each) for each in loads]) + "\n")
        return
    sys.stdout.write(
        "                requests       /s   p50 ms   p99 ms   worst   PLC %  server %  OPC UA %  late %\n"
    )
    for each in loads:
        sys.stdout.write(
            f"{each.what:14}  {each.requests:8}  {each.per_second:7.0f}  {each.p50_ms:7.2f}  {each.p99_ms:7.2f}  {each.worst_ms:6.1f}"
            f"  {each.host_percent:6.1f}  {each.server_percent:8.1f}  {each.others_percent:8.1f}  {each.late_percent:6.2f}\n"
        )


if __name__ == "__main__":
    main()
