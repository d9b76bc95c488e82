"""How a request goes to a server and comes back, with nothing but Python's own library."""

import json
from collections.abc import Mapping
from urllib.error import HTTPError
from urllib.parse import parse_qs, quote, urlencode, urlsplit
from urllib.request import Request as HttpRequest
from urllib.request import urlopen

from scanbench.client.asking import Refused, Request

_TIMEOUT_S = 60


class Reach:
    """Where a server is, and who asks."""

    def __init__(self, address: str, token: str, user: str) -> None:
        """See `connect`."""
        self.address, self.token, self.user = address.rstrip("/"), token, user

    def send(self, request: Request) -> bytes:
        """The bytes of the answer. `Refused` when the server says no, `OSError` when there is none."""
        made = HttpRequest(self.address + request.path, method=request.method)
        made.add_header("Authorization", f"Bearer {self.token}")
        made.add_header("Cookie", f"scanbench_user={quote(self.user)}")
        if isinstance(request.body, bytes):
            made.data = request.body
        elif request.body is not None:
            made.add_header("Content-Type", "application/json")
            made.data = json.dumps(request.body).encode()
        try:
            with urlopen(made, timeout=_TIMEOUT_S) as answer:
                data: bytes = answer.read()
                return data
        except HTTPError as error:
            told = _told(error.read())
            if "message" not in told:
                raise
            near = told.get("near")
            raise Refused(str(told["message"]), tuple(map(str, near)) if isinstance(near, list) else ()) from None

    def socket(self, path: str) -> tuple[str, Mapping[str, str]]:
        """The address of a WebSocket, and the headers by which it knows who asks."""
        scheme, _, rest = self.address.partition("://")
        secure = "wss" if scheme == "https" else "ws"
        who = urlencode({"scanbench_user": self.user})
        return f"{secure}://{rest}{path}?{who}", {"Authorization": f"Bearer {self.token}"}


def reached(address: str, token: str, user: str) -> Reach:
    """A server by the address that it prints, which has the token in it."""
    parts = urlsplit(address if "//" in address else f"http://{address}")
    given = token or parse_qs(parts.query).get("token", [""])[0]
    return Reach(f"{parts.scheme}://{parts.netloc}", given, user)


def _told(data: bytes) -> dict[str, object]:
    try:
        told = json.loads(data)
    except ValueError:
        return {}
    return told if isinstance(told, dict) else {}
