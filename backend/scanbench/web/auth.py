"""Who may speak to this server: token, Host and Origin, checked before any route is reached.

The token is in the address printed at the start; opening it sets a cookie. Whoever comes without it gets a page with
a field for it. Host must be an address or a name of this machine, or that of the public address that was given, so that
no foreign name can be pointed here (DNS rebinding); Origin must be the page this server gave out.
"""

import hmac
import ipaddress
import re
import socket
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from urllib.parse import parse_qs, parse_qsl, quote, unquote, urlencode, urlsplit

from starlette.datastructures import Headers
from starlette.requests import HTTPConnection
from starlette.responses import HTMLResponse, JSONResponse, RedirectResponse, Response
from starlette.types import ASGIApp, Receive, Scope, Send
from starlette.websockets import WebSocketClose

from scanbench.web.pages import sign_in_page
from scanbench.web.public_url import PublicUrl
from scanbench.wire.events import User

USER = "scanbench_user"
_SAFE = {"GET", "HEAD", "OPTIONS"}
_NAME_LENGTH = 40
_REMEMBERED = 365 * 86400
"""Seconds for which a browser keeps its cookies: a link that arrives tomorrow opens as well."""
_PASTED = re.compile(r"[?&]token=([^&#\s]+)")


@dataclass(slots=True)
class Gate:
    """What is checked against, and names for guests."""

    token: str
    port: int
    hosts: frozenset[str]
    next_guest: Callable[[], str]
    """A name for somebody who gave none; never the same twice."""
    public: PublicUrl | None = None
    """The address at which people reach the server, if it differs from its own."""

    @property
    def cookie(self) -> str:
        """The cookie's name: servers on other ports of the same host have their own."""
        return f"scanbench_token_{self.port}"


def known_hosts(names: Iterable[str]) -> frozenset[str]:
    """Names under which this server may be asked for, besides addresses."""
    return frozenset({"localhost", socket.gethostname().lower(), *(name.lower() for name in names)})


def user_of(connection: HTTPConnection) -> User:
    """Who it is, by query or cookie."""
    name = connection.query_params.get(USER) or unquote(connection.cookies.get(USER, ""))
    plain = "".join(letter for letter in name if letter.isprintable()).strip()
    return User(plain[:_NAME_LENGTH] or "Guest")


class Guard:
    """ASGI middleware around everything."""

    def __init__(self, app: ASGIApp, gate: Gate) -> None:
        self._app, self._gate = app, gate

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Lets a request through, or answers it."""
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        reason = self._foreign(scope)
        if reason is not None:
            await _refuse(scope, receive, send, 403, reason)
            return
        connection = HTTPConnection(scope)
        if scope["path"].startswith("/api"):
            if not self._knows_token(connection):
                await _refuse(
                    scope, receive, send, 401, "the token is missing or wrong: open the address that was printed"
                )
                return
            if len(connection.query_params.get(USER, "")) > _NAME_LENGTH:
                await _refuse(scope, receive, send, 400, f"{USER} has more than {_NAME_LENGTH} characters")
                return
        elif scope["type"] == "http" and is_page(scope["path"]):
            page = self._entrance(connection)
            if page is not None:
                await page(scope, receive, send)
                return
        await self._app(scope, receive, send)

    def _foreign(self, scope: Scope) -> str | None:
        """Why this comes from a page that is not ours, or None."""
        headers = Headers(scope=scope)
        host = headers.get("host", "")
        if not self._is_ours(host, scope):
            return (
                f"Host {host!r} is not an address of this server: use the address that was printed when it started, or start "
                "the server with --public-url and the address that people open (SCANBENCH_PUBLIC_URL)"
            )
        origin = headers.get("origin")
        must_match = scope["type"] == "websocket" or scope["method"] not in _SAFE
        if origin is not None and must_match and not self._is_our_page(origin, host):
            return f"Origin {origin!r} is not a page of this server"
        if must_match and headers.get("sec-fetch-site", "same-origin") not in ("same-origin", "none"):
            return "the request comes from a different site"
        return None

    def _is_our_page(self, origin: str, host: str) -> bool:
        if (
            self._gate.public is not None and origin.lower() == self._gate.public.origin
        ):  # a proxy may pass on a Host of its own
            return True
        return urlsplit(origin).netloc.lower() == host.lower()

    def _is_ours(self, host: str, scope: Scope) -> bool:
        try:
            name = urlsplit(f"//{host}").hostname or ""
        except ValueError:
            return False
        if name in self._gate.hosts or (self._gate.public is not None and name == self._gate.public.host):
            return True
        address = _address(name)
        if address is None:
            return False
        own = scope.get("server")
        return not address.is_global or (own is not None and address == _address(own[0]))

    def _knows_token(self, connection: HTTPConnection) -> bool:
        kind, _, bearer = connection.headers.get("authorization", "").partition(" ")
        given = (
            connection.cookies.get(self._gate.cookie),
            _key_in(connection.query_params.get("token", "")),
            bearer.strip() if kind.lower() == "bearer" else None,
        )
        right = self._gate.token.encode()
        return any(text is not None and hmac.compare_digest(text.encode(), right) for text in given)

    def _entrance(self, connection: HTTPConnection) -> Response | None:
        """The page itself: a token in the address moves into a cookie; without one there is an explanation."""
        if not self._knows_token(connection):
            typed = connection.query_params.get("token")
            languages = connection.headers.get("accept-language", "")
            page = sign_in_page(
                _path(connection), _query_without(connection, "token"), typed=typed, languages=languages
            )
            return HTMLResponse(page, 401)
        query = parse_qs(connection.url.query)
        named = USER in connection.cookies and USER not in query
        if "token" not in query and named:
            return None
        response = RedirectResponse(_without_token(connection), 303)
        # lax: a link to a scan also opens from a chat or a report; nothing is ever changed by GET
        response.set_cookie(
            self._gate.cookie, self._gate.token, httponly=True, samesite="lax", path="/", max_age=_REMEMBERED
        )
        if not named:
            name = user_of(connection).name if USER in query else self._gate.next_guest()
            response.set_cookie(USER, quote(name), samesite="lax", path="/", max_age=_REMEMBERED)
        return response


def _address(text: str) -> ipaddress.IPv4Address | ipaddress.IPv6Address | None:
    try:
        address = ipaddress.ip_address(text)
    except ValueError:
        return None
    mapped = address.ipv4_mapped if isinstance(address, ipaddress.IPv6Address) else None
    return address if mapped is None else mapped


def is_page(path: str) -> bool:
    """Whether the page is served at this path: at the root, and at the address of each instance and scan."""
    return path == "/" or path.startswith("/i/")


def _key_in(typed: str) -> str:
    """The token in what somebody typed: people paste the whole address that was printed."""
    found = _PASTED.search(typed)
    return found[1] if found else typed.strip()


def _path(connection: HTTPConnection) -> str:
    return quote(connection.url.path) if connection.url.path.startswith("/i/") else "/"


def _query_without(connection: HTTPConnection, *names: str) -> list[tuple[str, str]]:
    return [(name, value) for name, value in parse_qsl(connection.url.query) if name not in names]


def _without_token(connection: HTTPConnection) -> str:
    """The same address, but for what has moved into cookies."""
    kept = _query_without(connection, "token", USER)
    return f"{_path(connection)}?{urlencode(kept)}" if kept else _path(connection)


async def _refuse(scope: Scope, receive: Receive, send: Send, status: int, message: str) -> None:
    if scope["type"] == "websocket":
        await WebSocketClose(1008, message)(scope, receive, send)
    else:
        await JSONResponse({"message": message, "near": []}, status)(scope, receive, send)
