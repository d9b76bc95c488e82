"""`attach` of `scanbench dap`: everything goes on to the WebSocket of a server, and comes back from there."""

import asyncio
import http.client
import json
import urllib.error
import urllib.request
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from urllib.parse import parse_qs, quote, urlsplit

from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import WebSocketException

from scanbench.web.auth import USER
from scanbench.web.dap import shapes
from scanbench.web.dap.shapes import Body
from scanbench.web.framing import LARGEST
from scanbench.wire.refused import Refused

DEFAULT_ADDRESS = "http://127.0.0.1:8700"
_WAIT_S = 10


@dataclass(frozen=True, slots=True)
class Server:
    """Where a server is, and what opens it."""

    base: str
    token: str

    @staticmethod
    def of(args: shapes.Attach) -> "Server":
        """From the address as the server prints it, or host and port alone."""
        address = args.address or DEFAULT_ADDRESS
        hint = "write http://HOST:PORT, as the server prints it"
        try:
            parts = urlsplit(address if "://" in address else f"http://{address}")
            _ = parts.port  # is looked at only now
        except ValueError as error:
            raise Refused(f"address {address!r}: {error}; {hint}") from error
        if parts.scheme not in ("http", "https") or not parts.hostname:
            raise Refused(f"address {address!r}: {hint}")
        token = args.token or next(iter(parse_qs(parts.query).get("token", [])), "")
        return Server(f"{parts.scheme}://{parts.netloc}", token)

    @property
    def headers(self) -> dict[str, str]:
        """What shows that one may."""
        return {"Authorization": f"Bearer {self.token}"} if self.token else {}

    def instances(self) -> dict[int, str]:
        """The names of its PLCs, by number."""
        request = urllib.request.Request(f"{self.base}/api", headers=self.headers)
        try:
            with urllib.request.urlopen(request, timeout=_WAIT_S) as reply:
                app = json.load(reply)
            return {each["id"]: each["name"] for each in app["instances"]}
        except urllib.error.HTTPError as error:
            hint = "the token is missing or wrong: it is in the address that the server printed"
            raise Refused(hint if error.code == 401 else f"{self.base} answers {error.code}") from error
        except (OSError, ValueError, KeyError, TypeError, RecursionError, http.client.HTTPException) as error:
            reason = getattr(error, "reason", None) or error
            raise Refused(f"there is no Scanbench server at {self.base} ({reason})") from error


def choose(instances: dict[int, str], wanted: int | str | None) -> int:
    """The PLC that is meant: by number or name, or the only one."""
    shown = ", ".join(f"{name} ({id})" for id, name in instances.items()) or "none"
    if wanted is None:
        if len(instances) == 1:
            return next(iter(instances))
        raise Refused(f"say which `instance`; there are {shown}")
    named = [id for id, name in instances.items() if name == wanted or str(id) == str(wanted)]
    if not named:
        raise Refused(f"there is no instance {wanted}; there are {shown}", tuple(instances.values()))
    return named[0]


class Remote:
    """A conversation that a server has with our client; we pass on."""

    def __init__(self, connection: ClientConnection, send: Callable[[Body], None], on_end: Callable[[], None]) -> None:
        self._connection, self._send, self._on_end = connection, send, on_end
        self._initialize = 0
        self._task: asyncio.Task[None] | None = None

    @staticmethod
    async def reach(
        args: shapes.Attach, author: str, send: Callable[[Body], None], on_end: Callable[[], None]
    ) -> "Remote":
        """Connects; `Refused` says why it cannot."""
        server = Server.of(args)
        instance = choose(await asyncio.to_thread(server.instances), args.instance)
        address = f"ws{server.base.removeprefix('http')}/api/instances/{instance}/dap?{USER}={quote(author)}"
        try:
            connection = await connect(
                address, additional_headers=server.headers, max_size=LARGEST, open_timeout=_WAIT_S, compression=None
            )
        except (OSError, ValueError, WebSocketException) as error:
            raise Refused(f"{server.base} cannot be attached to: {error}") from error
        return Remote(connection, send, on_end)

    async def begin(self, initialize: Body) -> None:
        """The server has to hear what the client has said so far; its answer is known."""
        seq = initialize.get("seq")
        self._initialize = seq if isinstance(seq, int) else 0
        await self.forward(initialize)
        self._task = asyncio.get_running_loop().create_task(self._read())

    async def forward(self, message: object) -> None:
        """From the client to the server."""
        with suppress(WebSocketException):  # `_read` says so
            await self._connection.send(json.dumps(message))

    async def _read(self) -> None:
        try:
            async for text in self._connection:
                message = json.loads(text)
                if not isinstance(message, dict):
                    break  # no server of ours
                if message.get("command") != "initialize" or message.get("request_seq") != self._initialize:
                    self._send(message)
        except (WebSocketException, ValueError, RecursionError):
            pass
        self._on_end()

    async def close(self) -> None:
        """The client is gone."""
        if self._task is not None:
            self._task.cancel()
            await asyncio.gather(self._task, return_exceptions=True)
        await self._connection.close()
