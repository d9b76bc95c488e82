"""Why there is no WebSocket (any more), as the rest of the client says it."""

from collections.abc import Iterator
from contextlib import contextmanager

from websockets.exceptions import ConnectionClosed, InvalidHandshake

from scanbench.client.asking import Refused


@contextmanager
def said() -> Iterator[None]:
    """`Refused` where the server does not want the connection, `ConnectionResetError`, which is an `OSError`, where it ended."""
    try:
        yield
    except InvalidHandshake as error:
        raise Refused(f"the server does not open the connection: {error}") from error
    except ConnectionClosed as error:
        raise ConnectionResetError(f"the server has closed the connection: {error}") from error
