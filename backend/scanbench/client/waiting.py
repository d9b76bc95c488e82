"""The client that waits: each method returns when there is a result."""

from collections.abc import Iterator
from contextlib import contextmanager
from threading import Event
from typing import TypeVar

from scanbench.client.asking import Pause, Request, Step, Steps, Waiting
from scanbench.client.requests.base import Value
from scanbench.client.requests.plc import PlcRequests
from scanbench.client.requests.server import ServerRequests
from scanbench.client.transport import Reach, reached

T = TypeVar("T")


class _Asks(Waiting):
    _reach: Reach

    def _do(self, steps: Steps[T]) -> T:
        try:
            step = next(steps)
            while True:
                try:
                    came = self._take(step)
                except Exception as error:
                    step = steps.throw(error)
                else:
                    step = steps.send(came)
        except StopIteration as end:
            result: T = end.value
            return result

    def _take(self, step: Step) -> bytes | str:
        match step:
            case Request():
                return self._reach.send(step)
            case Pause(seconds):
                Event().wait(seconds)
                return b""
        raise AssertionError(step)


class Server(ServerRequests["Plc"], _Asks):
    """A running server; see `connect`."""

    def _of(self, id: int) -> "Plc":
        return Plc(self._reach, id)


class Plc(PlcRequests["Plc"], _Asks):
    """One virtual PLC of a server, as `Server.plc` gives it."""

    def _other(self, id: int) -> "Plc":
        return Plc(self._reach, id)

    @contextmanager
    def forced(self, path: str, value: Value, site: str = "") -> Iterator[None]:
        """Forced inside of a `with`."""
        self.force(path, value, site)
        try:
            yield
        finally:
            self.release(path)


def connect(address: str, token: str = "", user: str = "script") -> Server:
    """A server by the address that it prints, which has the token in it. `user` is the name in the journal."""
    return Server(reached(address, token, user))
