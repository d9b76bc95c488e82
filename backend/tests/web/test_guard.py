"""Who is let through by which address, and which answers a browser may keep: without a server."""

import asyncio

import httpx
import pytest
from starlette.responses import PlainTextResponse
from starlette.types import Receive, Scope, Send

from scanbench.web.auth import Gate, Guard
from scanbench.web.headers import NoStore
from scanbench.web.public_url import BadPublicUrl, PublicUrl, parse_public_url
from scanbench.web.serve import shown_address

OWN = "203.0.113.9"
"""Where connections arrive."""
PUBLIC = "https://bench.example.com"


async def _let_through(scope: Scope, receive: Receive, send: Send) -> None:
    await PlainTextResponse("here")(scope, receive, send)


def ask(
    host: str, method: str = "GET", path: str = "/api", public: PublicUrl | None = None, own: str = OWN, **headers: str
) -> httpx.Response:
    gate = Gate("key", 8700, frozenset({"localhost"}), lambda: "Guest 1", public)
    transport = httpx.ASGITransport(NoStore(Guard(_let_through, gate)))

    async def asked() -> httpx.Response:
        async with httpx.AsyncClient(transport=transport, base_url=f"http://{own}:8700") as client:
            given = {"Host": host, "Authorization": "Bearer key"} | headers
            return await client.request(method, path, headers=given)

    return asyncio.run(asked())


@pytest.mark.parametrize(
    "host",
    ["localhost", "LOCALHOST:8700", "127.0.0.1:80", "[::1]:8700", "192.168.7.4", "10.0.0.1", "100.64.3.3", "8.8.4.4"],
)
def test_own_addresses_are_let_through(host: str) -> None:
    assert ask(host, own="8.8.4.4").status_code == 200


@pytest.mark.parametrize(
    "host", ["8.8.8.8", "8.8.8.8:8700", "[2001:4860:4860::8888]", "[::ffff:8.8.8.8]", "bench.example.com"]
)
def test_other_addresses_are_refused_and_the_way_out_is_named(host: str) -> None:
    refused = ask(host)
    assert refused.status_code == 403
    assert "--public-url" in refused.json()["message"]


@pytest.mark.parametrize(
    "host", ["bench.example.com", "BENCH.example.com:443", "127.0.0.1:8765", "localhost:8765", "172.18.0.3:8765"]
)
def test_the_public_address_is_let_through(host: str) -> None:
    """Whether the proxy passes on the Host of the browser, or puts in one of its own."""
    public = parse_public_url(PUBLIC)
    assert ask(host, public=public).status_code == 200
    assert ask(host, "POST", public=public, Origin=PUBLIC).status_code == 200
    assert ask(host, "POST", public=public, Origin="https://evil.example").status_code == 403
    assert ask("evil.example", "POST", public=public, Origin=PUBLIC).status_code == 403


@pytest.mark.parametrize(
    ("text", "origin", "host"),
    [
        ("https://Bench.Example.com/", "https://bench.example.com", "bench.example.com"),
        ("https://B\u00fccher.example", "https://xn--bcher-kva.example", "xn--bcher-kva.example"),
        ("https://bench.example.com:443", "https://bench.example.com", "bench.example.com"),
        ("http://bench.example.com:8080", "http://bench.example.com:8080", "bench.example.com"),
        ("http://[2001:DB8::7]:8700", "http://[2001:db8::7]:8700", "2001:db8::7"),
    ],
)
def test_public_addresses(text: str, origin: str, host: str) -> None:
    assert parse_public_url(text) == PublicUrl(origin, host)


@pytest.mark.parametrize(
    "text",
    [
        "bench.example.com",
        "ftp://bench",
        "https://",
        "https://bench:port",
        "https://bench/scan",
        "http://a@b",
        "https://[",
    ],
)
def test_what_is_no_public_address_says_how_to_write_one(text: str) -> None:
    with pytest.raises(BadPublicUrl, match=r"write it like https://bench\.example\.com"):
        parse_public_url(text)


def test_the_printed_address_is_the_public_one() -> None:
    gate = Gate("key", 8700, frozenset(), lambda: "Guest 1")
    assert [shown_address(host, gate) for host in ("0.0.0.0", "10.0.0.1", "::1")] == [
        "http://localhost:8700", "http://10.0.0.1:8700", "http://[::1]:8700"
    ]  # fmt: skip
    gate.public = parse_public_url(PUBLIC)
    assert shown_address("0.0.0.0", gate) == PUBLIC


@pytest.mark.parametrize(
    ("path", "status", "kept"), [("/api", 200, "no-store"), ("/api", 401, "no-store"), ("/", 401, "no-store"),
                                 ("/?token=key", 303, "no-store"), ("/assets/main.js", 200, None)]
)  # fmt: skip
def test_what_may_be_kept(path: str, status: int, kept: str | None) -> None:
    answer = ask("localhost", path=path, Authorization="none" if status in (401, 303) else "Bearer key")
    assert answer.status_code == status
    assert answer.headers.get("Cache-Control") == kept
