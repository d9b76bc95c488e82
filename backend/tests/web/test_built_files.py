"""How the built page goes over the wire."""

import asyncio
import gzip
from collections.abc import Callable
from pathlib import Path

import httpx
import pytest

from scanbench.web.app import bare_app

_SCRIPT = "export const page = 1;\n" * 1000


Get = Callable[..., httpx.Response]


@pytest.fixture
def get(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Get:
    """Asks the application for a path, without a server."""
    assets = tmp_path / "assets"
    assets.mkdir()
    (assets / "index-1a2b.js").write_text(_SCRIPT)
    (assets / "index-1a2b.js.gz").write_bytes(gzip.compress(_SCRIPT.encode()))
    (assets / "page-3c4d.js").write_text(_SCRIPT)
    (assets / "page-3c4d.js.gz").write_bytes(gzip.compress(_SCRIPT.encode()))
    (assets / "page-3c4d.js.br").write_bytes(b"brotli")
    (tmp_path / "index.html").write_text("<!doctype html>")
    (tmp_path / "icon.svg").write_text("<svg/>")
    monkeypatch.setenv("SCANBENCH_FRONTEND", str(tmp_path))
    app = bare_app()

    async def ask(path: str, headers: dict[str, str]) -> httpx.Response:
        async with httpx.AsyncClient(transport=httpx.ASGITransport(app), base_url="http://localhost") as client:
            return await client.get(path, headers=headers)

    def get(path: str, **headers: str) -> httpx.Response:
        return asyncio.run(ask(path, {name.replace("_", "-"): value for name, value in headers.items()}))

    return get


def test_a_file_goes_compressed_and_is_kept_for_good(get: Get) -> None:
    reply = get("/assets/index-1a2b.js", accept_encoding="br, gzip")
    assert reply.text == _SCRIPT
    assert reply.headers["content-encoding"] == "gzip"
    assert int(reply.headers["content-length"]) < len(_SCRIPT) / 10
    assert reply.headers["content-type"].startswith("text/javascript")
    assert "immutable" in reply.headers["cache-control"]
    assert reply.headers["vary"] == "Accept-Encoding"
    again = get("/assets/index-1a2b.js", accept_encoding="gzip", if_none_match=reply.headers["etag"])
    assert again.status_code == 304


def test_a_browser_that_takes_brotli_gets_it(get: Get) -> None:
    reply = get("/assets/page-3c4d.js", accept_encoding="gzip, deflate, br, zstd")
    assert (reply.headers["content-encoding"], reply.content) == ("br", b"brotli")
    assert reply.headers["content-type"].startswith("text/javascript")
    assert get("/assets/page-3c4d.js", accept_encoding="gzip, br;q=0").headers["content-encoding"] == "gzip"


@pytest.mark.parametrize("takes", ["identity", "br", "gzip;q=0", ""])
def test_who_takes_nothing_compressed_gets_the_file_as_it_is(get: Get, takes: str) -> None:
    reply = get("/assets/index-1a2b.js", accept_encoding=takes)
    assert reply.text == _SCRIPT
    assert "content-encoding" not in reply.headers
    assert reply.headers["vary"] == "Accept-Encoding"


@pytest.mark.parametrize("path", ["/", "/i/1/scan/40", "/index.html", "/icon.svg"])
def test_what_keeps_its_name_is_asked_for_again(get: Get, path: str) -> None:
    assert get(path).headers["cache-control"] == "no-cache"


def test_what_is_not_there_is_not_kept(get: Get) -> None:
    reply = get("/assets/index-old.js")
    assert reply.status_code == 404
    assert "immutable" not in reply.headers.get("cache-control", "")
