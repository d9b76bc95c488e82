"""What every answer tells the browser: to run nothing that is not this server's, to be in no other page, to keep no copy of the API.

Style attributes and style elements are allowed, as the editor, charts and reports are made of them; scripts are files of
this server only, and so are workers.
"""

from starlette.datastructures import MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

POLICY = "; ".join(
    (
        "default-src 'self'",
        "style-src 'self' 'unsafe-inline'",
        "img-src 'self' data: blob:",
        "font-src 'self' data:",
        "object-src 'none'",
        "base-uri 'none'",
        "form-action 'self'",
        "frame-ancestors 'none'",
    )
)
ALWAYS = {
    "Content-Security-Policy": POLICY,
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "same-origin",  # a link to a scan names what it is about
    "Cross-Origin-Opener-Policy": "same-origin",
}
"""For the HTTP server: it also answers where no application is asked, as with too many connections.

An answer with a policy of its own (a report) has both, and a browser allows what both allow.
"""
_OF_FILES = (200, 206, 304)


class NoStore:
    """ASGI middleware around everything, also around refusals and the answer to a bug."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Lets no copy of an answer be kept. Built files say themselves how long they may be."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return

        async def sending(message: Message) -> None:
            if message["type"] == "http.response.start":
                if scope["path"].startswith("/api") or message["status"] not in _OF_FILES:
                    MutableHeaders(scope=message)["Cache-Control"] = "no-store"
            await send(message)

        await self._app(scope, receive, sending)
