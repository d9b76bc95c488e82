"""A DAP client of our own, over a WebSocket or over the streams of `scanbench dap`."""

import json
import os
import queue
import subprocess
import sys
import tempfile
import threading
import time
from abc import ABC, abstractmethod
from collections.abc import Callable
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from tests.web.server import Browser, Server

COMMAND = str(Path(sys.executable).parent / "scanbench")
Message = dict[str, Any]
PATIENCE_S = 120


class Closed(Exception):
    """The adapter has closed the connection."""


class Client(ABC):
    """Requests out, and everything that came so far."""

    def __init__(self) -> None:
        self.seq = 0
        self.messages: list[Message] = []

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    @abstractmethod
    def close(self) -> None: ...

    @abstractmethod
    def put(self, message: Message) -> None: ...

    @abstractmethod
    def take(self) -> Message: ...

    def send(self, command: str, **arguments: object) -> int:
        self.seq += 1
        self.put({"seq": self.seq, "type": "request", "command": command, "arguments": arguments})
        return self.seq

    def wait(self, condition: Callable[[Message], bool]) -> Message:
        """The first message for which it holds, which is taken out."""
        for message in self.messages:
            if condition(message):
                self.messages.remove(message)
                return message
        while True:
            message = self.take()
            if condition(message):
                return message
            self.messages.append(message)

    def response(self, seq: int) -> Message:
        return self.wait(lambda message: message["type"] == "response" and message["request_seq"] == seq)

    def event(self, name: str) -> Message:
        body: Message = self.wait(lambda each: each["type"] == "event" and each["event"] == name).get("body", {})
        return body

    def ask(self, command: str, **arguments: object) -> Message:
        """The body of the answer."""
        answer = self.response(self.send(command, **arguments))
        assert answer["success"], answer
        body: Message = answer.get("body", {})
        return body

    def refused(self, command: str, **arguments: object) -> str:
        answer = self.response(self.send(command, **arguments))
        assert not answer["success"], answer
        assert answer["body"]["error"]["format"] == answer["message"]
        return str(answer["message"])

    def until(self, condition: Callable[[], bool]) -> None:
        """Waits for what comes without being told."""
        end = time.monotonic() + PATIENCE_S
        while not condition():
            assert time.monotonic() < end
            time.sleep(0.05)

    def halt(self, command: str, **arguments: object) -> Message:
        """Asks, and waits for the halt that comes of it."""
        self.messages = [each for each in self.messages if each.get("event") != "stopped"]
        self.ask(command, **arguments)
        return self.event("stopped")

    def stack(self) -> list[Message]:
        frames: list[Message] = self.ask("stackTrace", threadId=1)["stackFrames"]
        return frames

    def value(self, expression: str, frame: int | None = None) -> str:
        where = {} if frame is None else {"frameId": frame}
        return str(self.ask("evaluate", expression=expression, context="watch", **where)["result"])


class SocketClient(Client):
    """As a tool that attaches."""

    def __init__(self, server: Server, instance: int, user: str = "Tool", **attach: object) -> None:
        super().__init__()
        address = f"ws://127.0.0.1:{server.port}/api/instances/{instance}/dap?scanbench_user={user}"
        self._connection = connect(address, additional_headers={"Authorization": f"Bearer {server.token}"})
        self.socket = self._connection.__enter__()
        self.ask("initialize", adapterID="scanbench", clientID="test")
        self.ask("attach", **attach)
        self.event("initialized")

    def close(self) -> None:
        self._connection.__exit__(None, None, None)

    def put(self, message: Message) -> None:
        self.socket.send(json.dumps(message))

    def take(self) -> Message:
        try:
            message: Message = json.loads(self.socket.recv(PATIENCE_S))
        except ConnectionClosed as error:
            raise Closed from error
        return message


class BrowserClient(Client):
    """In the envelope of a browser's socket."""

    def __init__(self, browser: Browser) -> None:
        super().__init__()
        self.browser = browser
        self.ask("initialize", adapterID="scanbench", clientID="browser")
        self.event("initialized")

    def close(self) -> None:
        pass

    def put(self, message: Message) -> None:
        self.browser.socket.send(json.dumps({"type": "dap", "message": message}))

    def take(self) -> Message:
        message: Message = self.browser.wait_for("dap", PATIENCE_S)["message"]
        return message


class StdioClient(Client):
    """`scanbench dap`, as an editor starts it."""

    def __init__(
        self, *arguments: str, cwd: Path | None = None, temporary: Path | None = None, cache: Path | None = None
    ) -> None:
        super().__init__()
        cache = cache or Path(tempfile.gettempdir()) / f"scanbench-tests-{os.getuid()}"  # not the user's own
        environment = os.environ | {"XDG_CACHE_HOME": str(cache)}
        environment |= {} if temporary is None else {"TMPDIR": str(temporary)}
        self.process = subprocess.Popen(
            [COMMAND, "dap", *arguments], stdin=subprocess.PIPE, stdout=subprocess.PIPE, cwd=cwd, env=environment
        )  # fmt: skip
        self._came: queue.Queue[Message | None] = queue.Queue()
        threading.Thread(target=self._read, daemon=True).start()

    def close(self) -> None:
        assert self.process.stdin is not None
        assert self.process.stdout is not None
        if not self.process.stdin.closed:
            self.process.stdin.close()
        self.process.wait(PATIENCE_S)
        self.process.stdout.close()

    def put(self, message: Message) -> None:
        data = json.dumps(message).encode()
        self.put_bytes(b"Content-Length: %d\r\n\r\n%s" % (len(data), data))

    def put_bytes(self, data: bytes) -> None:
        assert self.process.stdin is not None
        self.process.stdin.write(data)
        self.process.stdin.flush()

    def take(self) -> Message:
        message = self._came.get(timeout=PATIENCE_S)
        if message is None:
            raise Closed
        return message

    def _read(self) -> None:
        stream = self.process.stdout
        assert stream is not None
        while header := stream.readline():
            length = int(header.partition(b":")[2])
            assert stream.readline() == b"\r\n"
            self._came.put(json.loads(stream.read(length)))
        self._came.put(None)

    def launch(self, program: Path, breakpoints: Callable[[], None] = lambda: None, **arguments: object) -> None:
        """Initialises and launches; sets breakpoints in between."""
        self.ask("initialize", adapterID="scanbench")
        seq = self.send("launch", program=str(program), **arguments)
        self.event("initialized")
        breakpoints()
        self.ask("configurationDone")
        answer = self.response(seq)
        assert answer["success"], answer
