"""The host's end of the socket: one thread reads, writes and ticks; any thread posts.

Messages are packed in that thread, not in the caller's: the scan loop only appends to a queue.
"""

import os
import selectors
import socket
from collections import deque
from collections.abc import Callable

from scanbench.runtime.clock import monotonic_ns
from scanbench.wire.codec import Splitter, pack

BACKLOG_BYTES = 4 << 20
"""More than this unsent: the parent does not keep up, and is told no more than answers until it does."""
_LAST_WORDS_S = 2.0
_AT_ONCE = 256


class Link:
    """A two-way stream of messages over a local socket."""

    def __init__(self, sock: socket.socket) -> None:
        sock.setblocking(False)
        self._sock = sock
        self._wake = os.eventfd(0, os.EFD_NONBLOCK | os.EFD_CLOEXEC)
        self._queue: deque[object] = deque()
        self._unsent = bytearray()
        self._closing = False

    @property
    def backlogged(self) -> bool:
        """Whether the parent does not keep up."""
        return len(self._unsent) > BACKLOG_BYTES

    def post(self, message: object) -> None:
        """Sends a message, or what a callable makes of itself in the link's thread."""
        self._queue.append(message)
        os.eventfd_write(self._wake, 1)

    def close(self) -> None:
        """Sends what is queued, and ends `serve`."""
        self._closing = True
        os.eventfd_write(self._wake, 1)

    def last_words(self, message: object) -> None:
        """Sends a message at once, after what is half sent: from the thread of `serve`, which must not go on."""
        self._queue.clear()
        self._sock.settimeout(_LAST_WORDS_S)
        try:
            self._sock.sendall(self._unsent + pack(message))
        except OSError:  # nobody listens
            return

    def serve(
        self, on_message: Callable[[object], None], on_tick: Callable[[], None], tick_ns: Callable[[], int]
    ) -> None:
        """Reads and writes until the other end closes or `close` is called.

        `on_tick` comes `tick_ns()` after the last time; that is asked again whenever something was read or posted.
        """
        splitter = Splitter()
        last_tick = monotonic_ns()
        with selectors.DefaultSelector() as selector:
            selector.register(self._sock, selectors.EVENT_READ)
            selector.register(self._wake, selectors.EVENT_READ)
            while not (self._closing and not self._queue and not self._unsent):
                events = selectors.EVENT_READ | (selectors.EVENT_WRITE if self._unsent else 0)
                selector.modify(self._sock, events)
                wait_ns = 0 if self._queue and not self._unsent else last_tick + tick_ns() - monotonic_ns()
                for key, ready in selector.select(max(0, wait_ns) / 1e9):
                    if key.fileobj is self._sock and ready & selectors.EVENT_READ:
                        data = self._receive()
                        if not data:
                            return
                        for message in splitter.feed(data):
                            on_message(message)
                    elif key.fileobj == self._wake:
                        os.eventfd_read(self._wake)
                if monotonic_ns() >= last_tick + tick_ns():
                    last_tick = monotonic_ns()
                    on_tick()
                if not self._send():
                    return

    def _receive(self) -> bytes:
        try:
            return self._sock.recv(1 << 20)
        except ConnectionError:
            return b""

    def _send(self) -> bool:
        """Sends as much as goes without waiting; false when the other end is gone. Not all at once, as reading and ticks come
        first even when the loop posts without end. What a slow parent has yet to read stays messages, not bytes."""
        for _ in range(min(len(self._queue), _AT_ONCE)):
            if self.backlogged:
                break
            message = self._queue.popleft()
            self._unsent += pack(message() if callable(message) else message)
        try:
            while self._unsent:
                del self._unsent[: self._sock.send(memoryview(self._unsent)[: 1 << 20])]
        except BlockingIOError:
            return True
        except ConnectionError:
            return False
        return True
