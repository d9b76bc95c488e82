"""`scanbench dap`: the adapter on standard input and output, as editors start it."""

import asyncio
import logging
import os
import queue
import signal
import sys
import threading
from collections.abc import Callable, Coroutine, Sequence
from contextlib import suppress

from pydantic import ValidationError

from scanbench.host.zygote import zygote
from scanbench.web.dap import shapes
from scanbench.web.dap.answers import fault, refusal
from scanbench.web.dap.conversation import Conversation
from scanbench.web.dap.launching import Launcher
from scanbench.web.dap.remote import Remote
from scanbench.web.dap.shapes import Body
from scanbench.web.framing import BadFrame, Framing, framed, parsed
from scanbench.web.streams import own_streams
from scanbench.wire.events import User
from scanbench.wire.refused import Refused

log = logging.getLogger("scanbench")
_CHUNK = 1 << 16
_UNREAD = 20_000
"""Messages that wait for a client; one that reads none of so many is gone."""


def serve_stdio(author: str) -> None:
    """Speaks DAP until the client disconnects or closes the stream."""
    with suppress(KeyboardInterrupt):
        asyncio.run(_serve(*own_streams(), author))


async def _serve(incoming: int, outgoing: int, author: str) -> None:
    loop = asyncio.get_running_loop()
    chunks: asyncio.Queue[bytes] = asyncio.Queue()
    threading.Thread(target=_read, args=(incoming, loop, chunks), daemon=True).start()
    over = asyncio.Event()
    writer = Writer(outgoing, over.set)
    loop.add_signal_handler(signal.SIGTERM, over.set)  # as at the end of the stream: no process is left
    front = Front(writer.send, author, over.set)
    framing = Framing()
    ended = loop.create_task(over.wait())
    try:
        while not over.is_set():
            chunk = loop.create_task(chunks.get())
            await asyncio.wait((chunk, ended), return_when=asyncio.FIRST_COMPLETED)
            if not chunk.done():
                chunk.cancel()
                break
            if not chunk.result():
                break
            for body in framing.feed(chunk.result()):
                front.receive(parsed(body))
    except BadFrame as error:
        print(f"scanbench dap: {error}", file=sys.stderr)  # noqa: T201  # there is nobody else to tell
    finally:
        ended.cancel()
        await front.close()
        await asyncio.to_thread(writer.close)


def _read(stream: int, loop: asyncio.AbstractEventLoop, chunks: "asyncio.Queue[bytes]") -> None:
    """In a thread of its own: standard input may be a pipe, a socket, a file, a terminal."""
    with suppress(RuntimeError):  # the loop is over
        while True:
            try:
                data = os.read(stream, _CHUNK)
            except OSError:
                data = b""
            loop.call_soon_threadsafe(chunks.put_nowait, data)
            if not data:
                return


class Writer:
    """Writes in a thread of its own, so that a client that does not read keeps nobody."""

    def __init__(self, stream: int, on_full: Callable[[], None]) -> None:
        """`on_full` is called when the client does not read at all."""
        self._stream, self._on_full = stream, on_full
        self._queue: queue.SimpleQueue[bytes | None] = queue.SimpleQueue()
        self._thread = threading.Thread(target=self._work, daemon=True)
        self._thread.start()

    def send(self, message: Body) -> None:
        """Soon."""
        if self._queue.qsize() < _UNREAD:
            self._queue.put(framed(message))
        else:
            self._on_full()

    def close(self) -> None:
        """Writes the rest."""
        self._queue.put(None)
        self._thread.join(2)

    def _work(self) -> None:
        with suppress(OSError):
            while (data := self._queue.get()) is not None:
                rest = memoryview(data)
                while rest:
                    rest = rest[os.write(self._stream, rest) :]


class Front:
    """The client's only partner: first we, and with `attach` a server, to which everything goes on then."""

    def __init__(self, send: Callable[[Body], None], author: str, on_end: Callable[[], None]) -> None:
        self._out, self._author, self._on_end = send, author, on_end
        self._seq = 0
        self._conversation = Conversation(self._send, Launcher(author), User(author), on_end)
        self._initialize: Body = {}
        self._remote: Remote | None = None
        self._attaching: tuple[object, asyncio.Task[None]] | None = None
        """Number of the request, and what serves it."""
        self._waiting: list[object] | None = None
        self._tasks: set[asyncio.Task[None]] = set()
        self._last = ""

    def _send(self, message: Body) -> None:
        self._seq += 1
        self._out({**message, "seq": self._seq})

    def receive(self, message: object) -> None:
        """A message of the client's, to whoever serves it."""
        command = message.get("command") if isinstance(message, dict) else None
        self._last = command if isinstance(command, str) else self._last
        if self._waiting is not None:
            self._waiting.append(message)
            if self._attaching is not None and _ends(message, self._attaching[0]):
                self._attaching[1].cancel()
        elif self._remote is not None:
            self._waiting = [message]
            self._begin(self._forward())
        elif command == "attach" and isinstance(message, dict) and self._initialize:
            self._waiting = []
            self._begin_attach(message)
        else:
            if command == "initialize" and isinstance(message, dict) and not self._initialize:
                self._initialize = message
            self._conversation.receive(message)

    def _begin(self, work: Coroutine[None, None, None]) -> asyncio.Task[None]:
        task = asyncio.get_running_loop().create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)
        return task

    def _begin_attach(self, message: Body) -> None:
        def on_done(task: asyncio.Task[None]) -> None:
            if task.cancelled() and self._attaching is not None:  # perhaps before it had begun
                self._stay(message, "cancelled")

        task = self._begin(self._attach(message))
        self._attaching = message.get("seq"), task
        task.add_done_callback(on_done)

    async def _attach(self, message: Body) -> None:
        try:
            args = shapes.Attach.model_validate(message.get("arguments") or {})
            self._remote = await Remote.reach(args, args.user or self._author, self._send, self._on_remote_end)
        except Refused as error:
            self._stay(message, str(error), error.near)
        except ValidationError as error:
            self._stay(message, f"attach: {fault(error)}")
        except Exception as error:  # whatever happened, the client waits for an answer
            log.exception("attaching failed")
            self._stay(message, f"attach failed: {error}")
        else:
            self._attaching = None
            self._begin(asyncio.to_thread(zygote().close))  # nothing is launched any more
            await self._remote.begin(self._initialize)
            await self._remote.forward(message)
            await self._forward()

    def _stay(self, message: Body, text: str, near: Sequence[str] = ()) -> None:
        """There is no server: we serve what came meanwhile."""
        self._send(refusal(message.get("seq", 0), "attach", text, near))
        self._attaching = None
        waiting, self._waiting = self._waiting or [], None
        for each in waiting:
            self.receive(each)

    async def _forward(self) -> None:
        """What came meanwhile, in order."""
        assert self._remote is not None
        while self._waiting:
            await self._remote.forward(self._waiting.pop(0))
        self._waiting = None

    def _on_remote_end(self) -> None:
        if self._last != "disconnect":
            self._send({"type": "event", "event": "output", "body": {
                "category": "important", "output": "the server has closed the connection\n",
            }})  # fmt: skip
            self._send({"type": "event", "event": "terminated"})
        self._on_end()

    async def close(self) -> None:
        """The client is gone."""
        if self._waiting is not None:
            self._waiting.clear()
        for task in self._tasks:
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)
        if self._remote is not None:
            await self._remote.close()
        await self._conversation.close()


def _ends(message: object, attach: object) -> bool:
    """Whether the client does not want to wait for `attach` any more."""
    if not isinstance(message, dict):
        return False
    arguments = message.get("arguments")
    wanted = arguments.get("requestId") if isinstance(arguments, dict) else None
    return message.get("command") == "disconnect" or (message.get("command") == "cancel" and wanted == attach)
