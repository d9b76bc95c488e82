"""The client of `asyncio`: the same methods, as coroutine functions; the same properties, which are awaited."""

import asyncio
from collections.abc import AsyncIterator, Sequence
from contextlib import AsyncExitStack, asynccontextmanager
from types import TracebackType
from typing import Self, TypeVar

from websockets.asyncio.client import ClientConnection
from websockets.asyncio.client import connect as connect_socket

from scanbench.client.asking import Awaited, Hear, Pause, Request, Say, Step, Steps
from scanbench.client.closed import said
from scanbench.client.requests.base import Value
from scanbench.client.requests.debugging import DebugRequests
from scanbench.client.requests.plc import PlcRequests
from scanbench.client.requests.server import ServerRequests
from scanbench.client.requests.watching import Frame, WatchRequests
from scanbench.client.transport import Reach, reached

T = TypeVar("T")


class _Asks(Awaited):
    _reach: Reach

    async def _do(self, steps: Steps[T]) -> T:
        try:
            step = next(steps)
            while True:
                try:
                    came = await self._take(step)
                except Exception as error:
                    step = steps.throw(error)
                else:
                    step = steps.send(came)
        except StopIteration as end:
            result: T = end.value
            return result

    async def _take(self, step: Step) -> bytes | str:
        match step:
            case Request():
                return await asyncio.to_thread(self._reach.send, step)
            case Pause(seconds):
                await asyncio.sleep(seconds)
                return b""
        raise AssertionError(step)


class _Talks(_Asks):
    """By a WebSocket that is open inside of an `async with`."""

    def __init__(self, reach: Reach, path: str) -> None:
        self._reach, self._path = reach, path
        self._connection: ClientConnection | None = None
        self._opened = AsyncExitStack()

    def _begin(self) -> Steps[None]:
        raise NotImplementedError

    async def __aenter__(self) -> Self:
        address, headers = self._reach.socket(self._path)
        async with AsyncExitStack() as opened:
            connecting = connect_socket(address, additional_headers=headers, max_size=None, max_queue=None)
            with said():
                self._connection = await opened.enter_async_context(connecting)
            await self._do(self._begin())
            self._opened = opened.pop_all()
        return self

    async def __aexit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        await self._opened.aclose()

    async def _take(self, step: Step) -> bytes | str:
        assert self._connection is not None, "open it in an `async with`"
        with said():
            match step:
                case Say(text):
                    await self._connection.send(text)
                    return b""
                case Hear(timeout_s):
                    async with asyncio.timeout(timeout_s):
                        return await self._connection.recv()
        return await super()._take(step)


class Watch(WatchRequests, _Talks):
    """Watched values; see `Plc.watch`."""

    def __init__(self, reach: Reach, path: str, paths: Sequence[str]) -> None:
        _Talks.__init__(self, reach, path)
        WatchRequests.__init__(self, paths)

    def __aiter__(self) -> Self:
        return self

    async def __anext__(self) -> Frame:
        return await self._do(self._next(None))


class Debugger(DebugRequests, _Talks):
    """A debug session; see `Plc.debug`."""

    def __init__(self, reach: Reach, path: str) -> None:
        _Talks.__init__(self, reach, path)
        DebugRequests.__init__(self)


class Server(ServerRequests["Plc"], _Asks):
    """A running server; see `connect_async`."""

    def _of(self, id: int) -> "Plc":
        return Plc(self._reach, id)


class Plc(PlcRequests["Plc"], _Asks):
    """One virtual PLC of a server, as `await server.plc(...)` gives it."""

    def _other(self, id: int) -> "Plc":
        return Plc(self._reach, id)

    @asynccontextmanager
    async def forced(self, path: str, value: Value, site: str = "") -> AsyncIterator[None]:
        """Forced inside of an `async with`."""
        await self.force(path, value, site)
        try:
            yield
        finally:
            await self.release(path)

    def watch(self, *paths: str) -> Watch:
        """Values as they change: `async with plc.watch("Main.level") as frames: async for frame in frames: ...`. `Refused`, at the `async
        with`, where one of the paths is none."""
        return Watch(self._reach, f"{self._base}/socket", paths)

    def debug(self) -> Debugger:
        """Breakpoints and steps: `async with plc.debug() as debugger: ...`."""
        return Debugger(self._reach, f"{self._base}/dap")


def connect_async(address: str, token: str = "", user: str = "script") -> Server:
    """A server by the address that it prints, for `asyncio`: `plc = await connect_async(address).plc("line-1")`. Requests run in threads, so
    that one that is cancelled may still be carried out."""
    return Server(reached(address, token, user))
