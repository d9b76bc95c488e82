"""Starts the server: binds, prints the address with its token when it is ready, serves until Ctrl-C."""

import gc
import os
import socket
from collections.abc import Callable
from contextlib import closing, suppress
from pathlib import Path

import uvicorn
from starlette.types import ASGIApp

from scanbench.engines.lifeline import end_children
from scanbench.plcmodel.load import NoModels
from scanbench.server.workbench import Workbench
from scanbench.store.database import database_url
from scanbench.store.records import StoreError
from scanbench.store.store import Store
from scanbench.web.app import Config, create_app
from scanbench.web.auth import Gate, known_hosts
from scanbench.web.claim import InUse, claimed
from scanbench.web.handles import most_connections, raised_limit
from scanbench.web.headers import ALWAYS
from scanbench.web.kept_guests import kept_guests
from scanbench.web.kept_token import kept_token
from scanbench.web.public_url import PublicUrl

DEFAULT_PORT = 8700


class CannotServe(Exception):
    """The address cannot be used; the message says why, and what to do."""


def serve(
    host: str, port: int | None, data_dir: Path, announce: Callable[[str], None], token: str | None = None,
    public: PublicUrl | None = None,
) -> None:  # fmt: skip
    """Serves until it is told to stop. `port` None: 8700, or a free one if that is taken; 0: any free one.

    `public` is the address that people open, where it is not the one that the server listens on.
    """
    with _bind(host, port, announce) as sock:
        try:
            data_dir.mkdir(0o700, parents=True, exist_ok=True)
            with claimed(data_dir), closing(Store(database_url(data_dir), _name(data_dir))) as store:
                port = sock.getsockname()[1]
                gate = Gate(token or kept_token(data_dir), port, known_hosts([host]), kept_guests(data_dir), public)
                bench = Workbench(store, data_dir)
                bench.communication.protect(gate.token)
                _run(sock, host, bench, gate, announce)
        except (InUse, StoreError, NoModels) as error:
            raise CannotServe(str(error)) from error


def _name(data_dir: Path) -> str:
    """The name by which other servers report this one; PostgreSQL keeps 63 bytes of it."""
    return f"{socket.gethostname()}, process {os.getpid()}, --data {data_dir.resolve()}"


def _run(sock: socket.socket, host: str, bench: Workbench, gate: Gate, announce: Callable[[str], None]) -> None:
    why: list[StoreError | OSError] = []

    def no_start(error: StoreError | OSError) -> None:
        why.append(error)
        server.should_exit = True

    app = create_app(Config(bench, gate, no_start))
    config = http_config(app, host, gate.port, most_connections(raised_limit()))
    server = _Server(config, lambda: announce(f"Scanbench is ready: {shown_address(host, gate)}/?token={gate.token}"))
    # uvicorn ends everything in order at Ctrl-C, and then raises it again.
    with suppress(KeyboardInterrupt):
        server.run([sock])
    if why:
        raise why[0]


def http_config(app: ASGIApp, host: str, port: int, most: int) -> uvicorn.Config:
    """How the application is served; beyond `most` connections the answer is 503, with a line in the log."""
    return uvicorn.Config(
        app,
        host=host,
        port=port,
        loop="uvloop",
        ws="websockets-sansio",
        ws_per_message_deflate=False,
        ws_max_size=4 << 20,
        log_level="warning",
        lifespan="on",
        server_header=False,
        timeout_graceful_shutdown=3,
        limit_concurrency=most,
        headers=list(ALWAYS.items()),
    )


def shown_address(host: str, gate: Gate) -> str:
    """What people open."""
    if gate.public is not None:
        return gate.public.origin
    shown = "localhost" if host in ("0.0.0.0", "::") else f"[{host}]" if ":" in host else host
    return f"http://{shown}:{gate.port}"


class _Server(uvicorn.Server):
    """Says when it is ready, and ends all its processes."""

    def __init__(self, config: uvicorn.Config, ready: Callable[[], None]) -> None:
        super().__init__(config)
        self._ready = ready

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """As uvicorn does; then tells."""
        await super().startup(sockets)
        gc.freeze()  # what was imported stays: no search for garbage holds the loop up for it
        if self.started and not self.should_exit:
            self._ready()

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        """As uvicorn does, which ends the PLCs; then ends what is left, such as helpers of Python's own."""
        await super().shutdown(sockets)
        end_children()


def _bind(host: str, port: int | None, announce: Callable[[str], None]) -> socket.socket:
    try:
        return _listening(host, DEFAULT_PORT if port is None else port)
    except OSError as error:
        if port is not None:
            raise CannotServe(f"{host}:{port} cannot be used ({error.strerror}): choose a different --port") from error
        announce(f"port {DEFAULT_PORT} is taken: using a free one")
    try:
        return _listening(host, 0)
    except OSError as error:
        raise CannotServe(f"{host} cannot be used ({error.strerror}): choose a different --host") from error


def _listening(host: str, port: int) -> socket.socket:
    found = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE)
    family, kind, protocol, _, address = found[0]
    sock = socket.socket(family, kind, protocol)
    sock.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        sock.bind(address)
    except OSError:
        sock.close()
        raise
    return sock
