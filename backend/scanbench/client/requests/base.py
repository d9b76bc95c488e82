"""How requests are asked, and how one waits for what takes longer."""

import json
from collections.abc import Callable, Mapping
from typing import TypeVar, cast
from urllib.parse import urlencode

from scanbench.client.asking import Pause, Request, Steps
from scanbench.client.shapes.running import CommandResult
from scanbench.runtime.clock import monotonic_ns

T = TypeVar("T")
Value = str | int | float | bool
LOOK_S = 0.02
"""So often it is looked whether something is over."""


class Asks:
    """Requests of one PLC, below its address; a path that begins with `/` is one of the server."""

    _base: str

    def _get(self, shape: type[T], path: str, /, **query: Value | None) -> Steps[T]:
        data = yield Request("GET", self._at(path, query))
        return cast(T, json.loads(data))

    def _fetch(self, path: str, /, **query: Value | None) -> Steps[bytes]:
        return cast(bytes, (yield Request("GET", self._at(path, query))))

    def _send(self, shape: type[T], method: str, path: str, body: object = None, /, **query: Value | None) -> Steps[T]:
        data = yield Request(method, self._at(path, query), body)
        return cast(T, json.loads(data) if data else None)

    def _command(self, what: str, body: Mapping[str, object]) -> Steps[str]:
        return (yield from self._send(CommandResult, "POST", what, body))["message"]

    def _at(self, path: str, query: Mapping[str, Value | None]) -> str:
        address = path if path.startswith("/") else f"{self._base}/{path}".rstrip("/")
        given = {name: typed(value).lower() if isinstance(value, bool) else value for name, value in query.items()}
        asked = urlencode({name: value for name, value in given.items() if value is not None})
        return f"{address}?{asked}" if asked else address


def typed(value: Value) -> str:
    """A value as it is typed in the watch table."""
    if isinstance(value, bool):
        return "TRUE" if value else "FALSE"
    return str(value)


def waited(
    look: Callable[[], Steps[T]], goes_on: Callable[[T], bool], timeout_s: float, late: Callable[[T], str]
) -> Steps[T]:
    """What `look` finds when it does not go on any more. `TimeoutError`, with what `late` says, when it still does by then."""
    end = monotonic_ns() + int(timeout_s * 1e9)
    while goes_on(found := (yield from look())):
        if monotonic_ns() > end:
            raise TimeoutError(late(found))
        yield Pause(LOOK_S)
    return found
