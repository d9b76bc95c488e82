"""Responses as DAP has them, and what is told of a request that cannot be served."""

from collections.abc import Sequence

from pydantic import ValidationError

from scanbench.web.dap.shapes import Body


def response(seq: object, command: str, body: Body | None = None) -> Body:
    """The answer to the request `seq`."""
    message: Body = {"type": "response", "request_seq": seq, "command": command, "success": True}
    return message | {"body": body} if body else message


def refusal(seq: object, command: str, text: str, near: Sequence[str] = ()) -> Body:
    """The answer to the request `seq` that is not served; `text` says why."""
    error: Body = {"id": 1, "format": text, "showUser": True}
    return response(seq, command) | {"success": False, "message": text, "body": {"error": error, "near": list(near)}}


def fault(error: ValidationError) -> str:
    """What is wrong in a request, and where."""
    first = error.errors()[0]
    place = ".".join(map(str, first["loc"]))
    return f"{place}: {first['msg']}" if place else first["msg"]
