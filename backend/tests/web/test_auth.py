"""Token, Host, Origin."""

import re
from html import unescape

import httpx
import pytest
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

from tests.web.server import PATIENCE_S, Server


def test_without_the_token_nothing_is_told(server: Server) -> None:
    assert httpx.get(f"{server.base}/api", timeout=PATIENCE_S).status_code == 401
    assert httpx.get(f"{server.base}/api", params={"token": "wrong"}, timeout=PATIENCE_S).status_code == 401
    assert (
        httpx.get(f"{server.base}/api", headers={b"Authorization": "Bearer ü".encode()}, timeout=PATIENCE_S).status_code
        == 401
    )


def test_opening_the_printed_address_sets_the_cookie(server: Server) -> None:
    with httpx.Client(follow_redirects=True, timeout=PATIENCE_S) as browser:
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
    with httpx.Client(follow_redirects=True, timeout=PATIENCE_S) as browser:
        page = browser.get(f"{server.base}/i/1/scan/40", params={"panel": "verify", "token": server.token})
        assert page.status_code in (200, 503)
        assert str(page.url) == f"{server.base}/i/1/scan/40?panel=verify"
        again = browser.get(f"{server.base}/i/1/scan/41", headers={"Sec-Fetch-Site": "cross-site"})
        assert again.status_code in (200, 503)
    assert httpx.get(f"{server.base}/i/1/scan/40", timeout=PATIENCE_S).status_code == 401
    with httpx.Client(timeout=PATIENCE_S) as browser:
        reply = browser.get(f"{server.base}//evil.example/i/", params={"token": server.token})
        assert not reply.headers.get("location", "").startswith("//")


def _form(page: httpx.Response) -> tuple[str, dict[str, str]]:
    """Where the form leads, and what it sends besides the token."""
    assert page.status_code == 401
    action = re.search(r'<form method="get" action="([^"]*)"', page.text)
    hidden = re.findall(r'<input type="hidden" name="([^"]*)" value="([^"]*)"', page.text)
    assert action is not None
    assert 'name="token"' in page.text
    return unescape(action[1]), {unescape(name): unescape(value) for name, value in hidden}


def test_without_the_token_there_is_a_field_for_it_that_leads_on(server: Server) -> None:
    with httpx.Client(base_url=server.base, follow_redirects=True, timeout=PATIENCE_S) as browser:
        action, kept = _form(browser.get("/i/1/scan/40", params={"panel": "verify", "scanbench_user": 'Ada "L"'}))
        assert (action, kept) == ("/i/1/scan/40", {"panel": "verify", "scanbench_user": 'Ada "L"'})
        wrong = browser.get(action, params={**kept, "token": "wrong"})
        assert _form(wrong) == (action, kept), "the wrong token must not be sent again"
        assert '<p role="alert">This is not the token' in wrong.text
        for blank in ("", "  "):
            again = browser.get(action, params={**kept, "token": blank})
            assert _form(again) == (action, kept)
            assert '<p role="alert">Enter the token' in again.text
        page = browser.get(action, params={**kept, "token": server.address})  # the whole address is as good
        assert page.status_code in (200, 503)
        assert str(page.url) == f"{server.base}/i/1/scan/40?panel=verify"
        assert browser.get("/api").json()["you"]["name"] == 'Ada "L"'
        assert all(cookie.expires for cookie in browser.cookies.jar), "a browser that was closed has to ask again"
    assert "トークン" in httpx.get(server.base, headers={"Accept-Language": "ja,en;q=0.5"}, timeout=PATIENCE_S).text


def test_a_name_that_is_too_long_is_refused_not_cut(server: Server) -> None:
    answer = server.http.get("/api", params={"scanbench_user": "x" * 41})
    assert (answer.status_code, answer.json()["message"]) == (400, "scanbench_user has more than 40 characters")
    assert server.http.get("/api", params={"scanbench_user": "x" * 40}).json()["you"]["name"] == "x" * 40


def test_the_field_for_the_token_cannot_be_made_to_say_something_else(server: Server) -> None:
    page = httpx.get(f'{server.base}/i/"><script>1</script>', params={'"><script>': '"><script>'}, timeout=PATIENCE_S)
    assert page.status_code == 401
    assert page.text.count("<script") == page.text.count('<script src="/theme.js"></script>') == 1
