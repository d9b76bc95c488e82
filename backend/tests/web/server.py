"""A real server in a process of its own, and a browser's half of the wire."""

import atexit
import json
import struct
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from pathlib import Path
from shutil import rmtree
from types import TracebackType
from typing import Any, Self

import httpx
from websockets.sync.client import ClientConnection, connect

_MAIN = """
import sys
from pathlib import Path
from scanbench.web.serve import serve
if __name__ == "__main__":
    serve("127.0.0.1", 0, Path(sys.argv[1]), lambda line: print(line, flush=True))
"""

Message = dict[str, Any]

PATIENCE_S = 120
"""Only what hangs takes so long, also on a loaded machine."""
_LOOK_S = 0.2


@cache
def _what_is_built() -> Path:
    """Programs and code that all servers of these tests keep: each of them runs the samples."""
    directory = Path(tempfile.mkdtemp(prefix="scanbench-built-"))
    atexit.register(rmtree, directory, ignore_errors=True)
    return directory


class Server:
    """`scanbench serve` without the command line."""

    def __init__(self, data: Path) -> None:
        self.data = data
        self.made: list[int] = []
        """Instances that `instance` made and nobody switched off."""
        script = data / "serve_main.py"
        data.mkdir(parents=True, exist_ok=True)
        if not (data / "cache").exists():
            (data / "cache").symlink_to(_what_is_built())
        script.write_text(_MAIN)
        self.process = subprocess.Popen([sys.executable, str(script), str(data)], stdout=subprocess.PIPE, text=True)
        assert self.process.stdout is not None
        line = self.process.stdout.readline()
        assert "http://" in line, line
        self.address = line[line.index("http://") :].strip()
        self.base, _, self.token = self.address.partition("/?token=")
        self.port = int(self.base.rpartition(":")[2])
        self.http = httpx.Client(
            base_url=self.base, headers={"Authorization": f"Bearer {self.token}"}, timeout=PATIENCE_S
        )

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.http.close()
        self.process.terminate()
        self.process.wait(PATIENCE_S)
        assert self.process.stdout is not None
        self.process.stdout.close()

    def instance(self, name: str, model: str, **files: str) -> int:
        """A project of its own with these files, and an instance that runs it."""
        name = self._free(name)
        project = self.project(name, model, **files)
        reply = self.http.post("/api/instances", json={"project": project, "name": name})
        assert reply.status_code == 201, reply.text
        self.made.append(int(reply.json()["id"]))
        return self.made[-1]

    def _free(self, name: str) -> str:
        """The name, or the next one that no project has: which tests share a server is chance."""
        taken = {each["name"] for each in self.http.get("/api/projects").json()}
        return next(each for each in (name, *(f"{name} {n}" for n in range(2, 99))) if each not in taken)

    def project(self, name: str, model: str, **files: str) -> int:
        reply = self.http.post("/api/projects", json={"name": self._free(name), "model": model})
        assert reply.status_code == 201, reply.text
        id = int(reply.json()["id"])
        for file, text in files.items():
            saved = self.http.put(f"/api/projects/{id}/files/{file}.st", json={"text": text, "version": 0})
            assert saved.status_code == 200, saved.text
        return id

    def state(self, instance: int) -> Message:
        reply = self.http.get(f"/api/instances/{instance}").json()
        state: Message = reply["state"]
        return state

    def browser(self, instance: int, user: str = "Ada Lovelace") -> "Browser":
        return Browser(self, instance, user)


class Browser:
    """One WebSocket, with what has come so far."""

    def __init__(self, server: Server, instance: int, user: str) -> None:
        address = (
            f"ws://127.0.0.1:{server.port}/api/instances/{instance}/socket?scanbench_user={user.replace(' ', '%20')}"
        )
        headers = {"Cookie": f"scanbench_token_{server.port}={server.token}"}
        # without a limit, as a full queue keeps a connection from closing for 10 s
        self._connection = connect(address, additional_headers={**headers, "Origin": server.base}, max_queue=None)
        self.socket: ClientConnection = self._connection.__enter__()
        self.messages: list[Message] = []
        self.values: dict[int, bytes] = {}
        self.texts: dict[int, str] = {}
        self.frames = 0
        self.ids: dict[str, int] = {}
        self.sizes: dict[str, int] = {}
        self._ref = 0
        self.hello = self.wait_for("hello")

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._connection.__exit__(kind, error, trace)

    def take(self, timeout: float = PATIENCE_S) -> None:
        """The next message or frame."""
        data = self.socket.recv(timeout)
        if isinstance(data, bytes):
            self._take_frame(data)
        else:
            message: Message = json.loads(data)
            if message["type"] == "watching":
                for item in message["items"]:
                    if item["id"] is not None:
                        self.ids[item["path"]] = item["id"]
                        self.sizes[item["path"]] = item["symbol"]["size"]
            self.messages.append(message)

    def wait(self, condition: Callable[[], bool], timeout: float = PATIENCE_S) -> None:
        """Takes what comes until the condition holds; one that asks the server may come true while nobody says anything here."""
        end = time.monotonic() + timeout
        while not condition():
            assert time.monotonic() < end, f"not within {timeout} s; last messages: {self.messages[-5:]}"
            with suppress(TimeoutError):
                self.take(_LOOK_S)

    def wait_for(self, kind: str, timeout: float = PATIENCE_S, **fields: object) -> Message:
        """The first message of this kind with these fields, which is taken out."""
        found: list[Message] = []

        def here() -> bool:
            for message in self.messages:
                if message["type"] == kind and all(message.get(name) == value for name, value in fields.items()):
                    found.append(message)
                    self.messages.remove(message)
                    return True
            return False

        self.wait(here, timeout)
        return found[0]

    def ask(self, answer: str = "done", **message: object) -> Message:
        """Sends a message with a ref of its own; its answer."""
        self._ref += 1
        self.socket.send(json.dumps({**message, "ref": self._ref}))
        return self.wait_for(answer, ref=self._ref)

    def watch(self, *paths: str) -> Message:
        return self.ask("watching", type="watch", paths=list(paths))

    def number(self, path: str) -> int | None:
        data = self.values.get(self.ids[path])
        return None if data is None else int.from_bytes(data[: self.sizes[path]], "little", signed=True)

    def wait_state(self, state: str, timeout: float = PATIENCE_S) -> Message:
        found: list[Message] = []

        def here() -> bool:
            states = [message["state"] for message in self.messages if message["type"] == "state"]
            found[:] = [each for each in states if each["state"] == state]
            return bool(found)

        self.wait(here, timeout)
        self.messages = [message for message in self.messages if message["type"] != "state"]
        return found[-1]

    def _take_frame(self, data: bytes) -> None:
        kind, _full, _, count, _scan, _time = struct.unpack_from("<BBHIQq", data)
        assert kind == 1
        at = 24
        ids = struct.unpack_from(f"<{count}I", data, at)
        at += 4 * (count + count % 2)
        for id in ids:
            self.values[id] = data[at : at + 8]
            at += 8
        (strings,) = struct.unpack_from("<I", data, at)
        at += 4
        for _ in range(strings):
            id, length = struct.unpack_from("<II", data, at)
            self.texts[id] = data[at + 8 : at + 8 + length].decode("latin-1")
            at += 8 + length
        assert at == len(data)
        self.frames += 1
