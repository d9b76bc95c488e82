"""10,000 watched values at 20 Hz: what share of a core the server and its host take, and how long a write of one browser
takes until a second one shows it.

`python -m bench.watch [--values N] [--browsers N] [--seconds N] [--writes N]`. The browsers run in a process of
their own and are not counted: in the field they are other machines.
"""

import argparse
import json
import os
import struct
import subprocess
import sys
import tempfile
import threading
import time
import urllib.request
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress
from dataclasses import asdict, dataclass
from pathlib import Path

from websockets.exceptions import ConnectionClosed
from websockets.sync.client import ClientConnection, connect

_SERVER = """
import sys
from pathlib import Path
from scanbench.web.serve import serve
serve("127.0.0.1", 0, Path(sys.argv[1]), lambda line: print(line, flush=True))
"""
_TICKS = os.sysconf("SC_CLK_TCK")
_HEAD = 24
"""Bytes before the ids of a frame."""
_PATIENCE_S = 30.0


@dataclass(frozen=True, slots=True)
class WatchFigures:
    """What was measured. Shares are of one core."""

    values: int
    browsers: int
    frames_per_second: float
    values_per_frame: float
    bytes_per_second: float
    web_share: float
    host_share: float
    seen_p50_ms: float
    """From the moment at which one browser sends a write to the one at which a second browser has the frame with its value."""
    seen_p99_ms: float

    @property
    def share(self) -> float:
        """Web and host processes together."""
        return self.web_share + self.host_share


def run_watch_bench(values: int = 10_000, browsers: int = 1, seconds: float = 8, writes: int = 300) -> WatchFigures:
    """Starts a server, an instance whose values all change in every scan, and browsers that watch them."""
    with tempfile.TemporaryDirectory() as data, _server(Path(data)) as (address, pid):
        base, _, token = address.partition("/?token=")
        instance, host_pid = _instance(base, token, values)
        client = [sys.executable, "-m", "bench.watch", "--client", base, token, str(instance)]
        numbers = [str(values), str(browsers), str(seconds), str(writes)]
        with subprocess.Popen([*client, *numbers], stdout=subprocess.PIPE, text=True) as watchers:
            assert watchers.stdout is not None
            watchers.stdout.readline()  # all watch, and the first snapshot has come
            start, web, host = time.monotonic(), _cpu(pid), _cpu(host_pid)
            received = json.loads(watchers.stdout.readline())
            span, web, host = time.monotonic() - start, _cpu(pid) - web, _cpu(host_pid) - host
            seen = json.loads(watchers.stdout.readline())
        frames = received["frames"] / browsers
        return WatchFigures(
            values, browsers, frames / span, received["values"] / max(1, received["frames"]),
            received["bytes"] / span, web / span, host / span, seen["p50"], seen["p99"],
        )  # fmt: skip


@contextmanager
def _server(data: Path) -> Iterator[tuple[str, int]]:
    script = data / "server.py"
    script.write_text(f"if __name__ == '__main__':\n{_indented(_SERVER)}")
    with subprocess.Popen([sys.executable, str(script), str(data)], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        line = process.stdout.readline()
        try:
            yield line[line.index("http://") :].strip(), process.pid
        finally:
            process.terminate()


def _indented(text: str) -> str:
    return "".join(f"    {line}\n" for line in text.strip().splitlines())


def _instance(base: str, token: str, values: int) -> tuple[int, int]:
    """An instance of a program that changes an array of DINT in every scan."""
    source = (
        f"PROGRAM Main\nVAR\n  v : ARRAY[1..{values}] OF DINT; i, written : DINT;\nEND_VAR\n"
        f"  FOR i := 1 TO {values} DO v[i] := v[i] + i; END_FOR;\nEND_PROGRAM\n"
    )

    def call(method: str, path: str, body: object = None) -> dict[str, object]:
        request = urllib.request.Request(
            f"{base}/api{path}", None if body is None else json.dumps(body).encode(), method=method,
            headers={"Authorization": f"Bearer {token}", "Content-Type": "application/json"},
        )  # fmt: skip
        with urllib.request.urlopen(request) as reply:
            answer = json.loads(reply.read())
        assert isinstance(answer, dict)
        return answer

    project = call("POST", "/projects", {"name": "watch bench", "model": "GENERIC-IEC"})["id"]
    call("PUT", f"/projects/{project}/files/main.st", {"text": source, "version": 0})
    made = call("POST", "/instances", {"project": project, "name": "watch bench"})
    instance = made["id"]
    assert isinstance(instance, int)
    while True:
        state = call("GET", f"/instances/{instance}")["state"]
        assert isinstance(state, dict)
        if state["state"] == "running":
            return instance, int(state["pid"])
        time.sleep(0.1)


def _cpu(pid: int) -> float:
    """CPU seconds of a process so far."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / _TICKS


def _client(base: str, token: str, instance: int, values: int, browsers: int, seconds: float, writes: int) -> None:
    """The browsers: watch everything, count what comes; then one writes and a second one waits to see it."""
    ready = threading.Barrier(browsers + 1)
    address = f"{base.replace('http', 'ws')}/api/instances/{instance}/socket?token={token}"
    with ThreadPoolExecutor(browsers) as pool:
        browsing = [pool.submit(_browse, address, values, seconds, ready) for _ in range(browsers)]
        ready.wait()
        sys.stdout.write("ready\n")
        sys.stdout.flush()
        results = [each.result() for each in browsing]
    frames, count, size = (sum(column) for column in zip(*results, strict=True))
    sys.stdout.write(json.dumps({"frames": frames, "values": count, "bytes": size}) + "\n")
    sys.stdout.flush()
    waits = sorted(_writes(address, writes))
    figures = {"p50": waits[len(waits) // 2] * 1e3, "p99": waits[len(waits) * 99 // 100] * 1e3}
    sys.stdout.write(json.dumps(figures) + "\n")


def _browse(address: str, values: int, seconds: float, ready: threading.Barrier) -> tuple[int, int, int]:
    with connect(address, compression=None, max_size=None) as socket:
        paths = [f"Main.v[{number}]" for number in range(1, values + 1)]
        socket.send(json.dumps({"type": "watch", "ref": 1, "paths": paths}))
        while not isinstance(socket.recv(), bytes):
            pass
        ready.wait()
        frames = count = size = 0
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            data = socket.recv()
            if isinstance(data, bytes):
                frames += 1
                count += struct.unpack_from("<I", data, 4)[0]
                size += len(data)
        return frames, count, size


def _writes(address: str, count: int) -> Iterator[float]:
    """Seconds from each write to the frame with its value, at moments that have nothing to do with the frames' own."""
    with (
        connect(address, compression=None, max_size=None) as writer,
        connect(address, compression=None, max_size=None) as reader,
    ):
        reader.send(json.dumps({"type": "watch", "ref": 1, "paths": ["Main.written"]}))
        id = _id_in(reader)
        draining = threading.Thread(target=_drain, args=(writer,), daemon=True)
        draining.start()
        for number in range(1, count + 1):
            time.sleep(0.037 + number % 7 * 0.011)
            start = time.monotonic()
            writer.send(json.dumps({"type": "write", "ref": number, "path": "Main.written", "value": str(number)}))
            while _value(reader.recv(_PATIENCE_S), id) != number:
                pass
            yield time.monotonic() - start


def _id_in(socket: ClientConnection) -> int:
    """The id of the one path that was asked for."""
    while True:
        data = socket.recv(_PATIENCE_S)
        message = {} if isinstance(data, bytes) else json.loads(data)
        if message.get("type") == "watching":
            id = message["items"][0]["id"]
            assert isinstance(id, int)
            return id


def _drain(socket: ClientConnection) -> None:
    with suppress(ConnectionClosed):
        while True:
            socket.recv()


def _value(data: str | bytes, id: int) -> int | None:
    """The value of this id in a frame."""
    if not isinstance(data, bytes):
        return None
    count = struct.unpack_from("<I", data, 4)[0]
    ids = struct.unpack_from(f"<{count}I", data, _HEAD)
    if id not in ids:
        return None
    return int(struct.unpack_from("<Q", data, _HEAD + (count + count % 2) * 4 + 8 * ids.index(id))[0])


def main(arguments: list[str]) -> int:
    """Measures, and prints one object."""
    if arguments[:1] == ["--client"]:
        base, token, instance, values, browsers, seconds, writes = arguments[1:]
        _client(base, token, int(instance), int(values), int(browsers), float(seconds), int(writes))
        return 0
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--values", type=int, default=10_000)
    parser.add_argument("--browsers", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=8)
    parser.add_argument("--writes", type=int, default=300)
    given = parser.parse_args(arguments)
    figures = run_watch_bench(given.values, given.browsers, given.seconds, given.writes)
    sys.stdout.write(json.dumps({**asdict(figures), "share": figures.share}, indent=1) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
