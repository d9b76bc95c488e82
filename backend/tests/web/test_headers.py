"""What every answer tells the browser, also where the application was not asked or had a bug."""

import asyncio
import socket
from collections.abc import Callable, Coroutine

import httpx
import pytest
import uvicorn

from scanbench.web.app import bare_app
from scanbench.web.headers import NoStore
from scanbench.web.serve import http_config
from tests.web.server import PATIENCE_S


class _Announced(uvicorn.Server):
    """uvicorn's own, without our end of all children."""

    def __init__(self, config: uvicorn.Config) -> None:
        super().__init__(config)
        self.ready = asyncio.Event()

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup(sockets)
        self.ready.set()


async def _served(most: int, ask: Callable[[int], Coroutine[None, None, httpx.Response]]) -> httpx.Response:
    app = bare_app()

    @app.get("/api/bug")
    async def on_bug() -> None:
        raise AssertionError

    app.router.routes.insert(0, app.router.routes.pop())  # before the route of the page
    with socket.create_server(("127.0.0.1", 0)) as listening:
        server = _Announced(http_config(NoStore(app), "127.0.0.1", 0, most))
        serving = asyncio.create_task(server.serve([listening]))
        await server.ready.wait()
        try:
            return await ask(listening.getsockname()[1])
        finally:
            server.should_exit = True
            await serving


def asked(path: str, status: int) -> Callable[[int], Coroutine[None, None, httpx.Response]]:
    async def ask(port: int) -> httpx.Response:
        async with httpx.AsyncClient(base_url=f"http://127.0.0.1:{port}", timeout=PATIENCE_S) as client:
            answer = await client.get(path)
        assert answer.status_code == status
        return answer

    return ask


@pytest.mark.parametrize(
    ("most", "ask", "kept"),
    [
        (9, asked("/api/openapi.json", 200), "no-store"),
        (9, asked("/api/bug", 500), "no-store"),
        (0, asked("/api", 503), None),  # uvicorn's own
    ],
)
def test_every_answer_has_the_headers(
    most: int, ask: Callable[[int], Coroutine[None, None, httpx.Response]], kept: str | None
) -> None:
    headers = asyncio.run(_served(most, ask)).headers
    policy = headers["Content-Security-Policy"].split("; ")
    assert "default-src 'self'" in policy
    assert "frame-ancestors 'none'" in policy
    assert not any(each.startswith("script-src") for each in policy)
    assert headers["X-Content-Type-Options"] == "nosniff"
    assert headers["X-Frame-Options"] == "DENY"
    assert headers["Referrer-Policy"] == "same-origin"
    assert headers["Cross-Origin-Opener-Policy"] == "same-origin"
    assert headers.get("Cache-Control") == kept
