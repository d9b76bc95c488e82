"""Whoever reads Japanese gets every sentence of Scanbench in Japanese: answers of the API, and what comes on a WebSocket, whatever room made it.
What users wrote passes as it is: `spoken_fields.py` lists what is said.

The language is what the page was told to speak (a cookie), else what the browser asks for (`Accept-Language`).
"""

import json

from starlette.datastructures import MutableHeaders
from starlette.requests import HTTPConnection
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from scanbench.translation.inside import in_shapes, wanted
from scanbench.web.dap.said import said as said_to_debugger
from scanbench.web.spoken_fields import DAP, SHAPES

LANGUAGE = "scanbench_language"
"""Cookie of the page: the language that was chosen there."""


def language_of(connection: HTTPConnection) -> str:
    """What the one who asks reads."""
    return wanted(connection.cookies.get(LANGUAGE) or connection.headers.get("accept-language", ""))


class Spoken:
    """ASGI middleware around the application and its guard: it says everything in the language of the reader."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        language = "en" if scope["type"] not in ("http", "websocket") else language_of(HTTPConnection(scope))
        if language == "en":
            await self._app(scope, receive, send)
        elif scope["type"] == "websocket":
            await self._app(scope, receive, _Socket(send, language).send)
        else:
            await self._app(scope, receive, _Answer(send, language).send)


class _Socket:
    """Messages of a WebSocket; frames of values are bytes, and pass."""

    def __init__(self, send: Send, language: str) -> None:
        self._send, self._language = send, language

    async def send(self, message: Message) -> None:
        text = message.get("text")
        if message["type"] == "websocket.send" and isinstance(text, str):
            message = {**message, "text": _said(text, self._language)}
        await self._send(message)


class _Answer:
    """One answer: JSON is held back until it is whole. A file to keep, and whatever is no JSON, passes as it is."""

    def __init__(self, send: Send, language: str) -> None:
        self._send, self._language = send, language
        self._start: Message | None = None
        self._body = b""

    async def send(self, message: Message) -> None:
        if message["type"] == "http.response.start":
            headers = MutableHeaders(scope=message)
            headers.add_vary_header("Accept-Language")
            if headers.get("content-type", "").startswith("application/json") and "content-disposition" not in headers:
                self._start = message
                return
        elif self._start is not None and message["type"] == "http.response.body":
            self._body += message.get("body", b"")
            if message.get("more_body", False):
                return
            start, self._start = self._start, None
            if not self._body:  # HEAD: its headers are about the body that is not sent
                await self._send(start)
                await self._send(message)
                return
            message = {**message, "body": _said(self._body.decode(), self._language).encode()}
            headers = MutableHeaders(scope=start)
            headers["content-language"] = self._language
            if "content-length" in headers:
                headers["content-length"] = str(len(message["body"]))
            await self._send(start)
        await self._send(message)


def _said(text: str, language: str) -> str:
    try:
        value = json.loads(text)
    except ValueError:
        return text
    if isinstance(value, dict) and value.keys() == DAP and isinstance(value["message"], dict):
        value["message"] = said_to_debugger(value["message"], language)
        said: object = value
    else:
        said = in_shapes(value, SHAPES, language)
    return json.dumps(said, ensure_ascii=False, separators=(",", ":"))
