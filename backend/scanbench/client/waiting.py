"""The client that waits: each method returns when there is a result."""

from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from threading import Event
from types import TracebackType
from typing import Self, TypeVar

from websockets.sync.client import ClientConnection
from websockets.sync.client import connect as connect_socket

from scanbench.client.asking import Hear, Pause, Request, Say, Step, Steps, Waiting
from scanbench.client.closed import said
from scanbench.client.requests.base import Value
from scanbench.client.requests.debugging import DebugRequests
from scanbench.client.requests.plc import PlcRequests
from scanbench.client.requests.server import ServerRequests
from scanbench.client.requests.watching import Frame, WatchRequests
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


class _Talks(_Asks):
    """By a WebSocket that is open inside of a `with`."""

    def __init__(self, reach: Reach, path: str) -> None:
        self._reach, self._path = reach, path
        self._connection: ClientConnection | None = None
        self._opened = ExitStack()

    def _begin(self) -> Steps[None]:
        raise NotImplementedError

    def __enter__(self) -> Self:
        address, headers = self._reach.socket(self._path)
        with ExitStack() as opened:
            # without a limit, as a full queue keeps a connection from closing
            with said():
                connecting = connect_socket(address, additional_headers=headers, max_size=None, max_queue=None)
                self._connection = opened.enter_context(connecting)
            self._do(self._begin())
            self._opened = opened.pop_all()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._opened.close()

    def _take(self, step: Step) -> bytes | str:
        assert self._connection is not None, "open it in a `with`"
        with said():
            match step:
                case Say(text):
                    self._connection.send(text)
                    return b""
                case Hear(timeout_s):
                    return self._connection.recv(timeout_s)
        return super()._take(step)


class Watch(WatchRequests, _Talks):
    """Watched values; see `Plc.watch`."""

    def __init__(self, reach: Reach, path: str, paths: Sequence[str]) -> None:
        _Talks.__init__(self, reach, path)
        WatchRequests.__init__(self, paths)

    def __iter__(self) -> Self:
        return self

    def __next__(self) -> Frame:
        return self._do(self._next(None))


class Debugger(DebugRequests, _Talks):
    """A debug session; see `Plc.debug`."""

    def __init__(self, reach: Reach, path: str) -> None:
        _Talks.__init__(self, reach, path)
        DebugRequests.__init__(self)


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

    def watch(self, *paths: str) -> Watch:
        """Values as they change: `with plc.watch("Main.level", "D100") as frames: for frame in frames: ...`. `Refused`, at the `with`,
        where one of the paths is none."""
        return Watch(self._reach, f"{self._base}/socket", paths)

    def debug(self) -> Debugger:
        """Breakpoints and steps: `with plc.debug() as debugger: ...`."""
        return Debugger(self._reach, f"{self._base}/dap")


def connect(address: str, token: str = "", user: str = "script") -> Server:
    """A server by the address that it prints, which has the token in it. `user` is the name in the journal."""
    return Server(reached(address, token, user))
