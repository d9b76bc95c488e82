"""Token, Host, Origin."""

import httpx
import pytest
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

from tests.web.server import Server


def test_without_the_token_nothing_is_told(server: Server) -> None:
    assert httpx.get(f"{server.base}/api").status_code == 401
    assert httpx.get(f"{server.base}/api", params={"token": "wrong"}).status_code == 401
    assert httpx.get(f"{server.base}/api", headers={b"Authorization": "Bearer ü".encode()}).status_code == 401
    page = httpx.get(server.base)
    assert page.status_code == 401
    assert "token" in page.text


def test_opening_the_printed_address_sets_the_cookie(server: Server) -> None:
    with httpx.Client(follow_redirects=True) as browser:
        page = browser.get(server.address)
        assert page.status_code in (200, 503)  # 503: the frontend is not built
        assert "token" not in str(page.url)
        assert browser.get(f"{server.base}/api").json()["you"]["name"].startswith("Guest ")


@pytest.mark.parametrize("host", ["evil.example", "evil.example:80", "localhost.evil.example"])
def test_foreign_names_are_refused(server: Server, host: str) -> None:
    reply = server.http.get("/api", headers={"Host": host})
    assert reply.status_code == 403
    assert "Host" in reply.json()["message"]


def test_foreign_pages_cannot_change_anything(server: Server) -> None:
    new = {"name": "foreign", "model": "GENERIC-IEC"}
    for headers in ({"Origin": "http://evil.example"}, {"Origin": "null"}, {"Sec-Fetch-Site": "cross-site"}):
        assert server.http.post("/api/projects", json=new, headers=headers).status_code == 403


@pytest.mark.parametrize(
    ("token", "origin", "status"),
    [("wrong", None, 403), (None, "http://evil.example", 403), (None, "null", 403), ("wrong", "own", 403)],
)
def test_sockets_are_refused(server: Server, token: str | None, origin: str | None, status: int) -> None:
    address = f"ws://127.0.0.1:{server.port}/api/instances/1/socket?token={token or server.token}"
    headers = {} if origin is None else {"Origin": server.base if origin == "own" else origin}
    with pytest.raises(InvalidStatus) as refused:
        connect(address, additional_headers=headers)
    assert refused.value.response.status_code == status


def test_nonsense_on_a_socket_is_answered(server: Server) -> None:
    with server.browser(1) as browser:
        for text in ("{", "[]", '{"type": "launch"}', '{"type": "write", "ref": 1}'):
            browser.socket.send(text)
            answer = browser.wait_for("done", ref=1 if "ref" in text else -1)
            assert not answer["ok"]
            assert "not a message" in answer["message"]


def test_a_link_to_a_scan_keeps_where_it_leads(server: Server) -> None:
    """Also for somebody who opens it with the token, and for one whose browser comes from another site."""
    with httpx.Client(follow_redirects=True) as browser:
        page = browser.get(f"{server.base}/i/1/scan/40", params={"panel": "verify", "token": server.token})
        assert page.status_code in (200, 503)
        assert str(page.url) == f"{server.base}/i/1/scan/40?panel=verify"
        again = browser.get(f"{server.base}/i/1/scan/41", headers={"Sec-Fetch-Site": "cross-site"})
        assert again.status_code in (200, 503)
    assert httpx.get(f"{server.base}/i/1/scan/40").status_code == 401
    with httpx.Client() as browser:
        reply = browser.get(f"{server.base}//evil.example/i/", params={"token": server.token})
        assert not reply.headers.get("location", "").startswith("//")
