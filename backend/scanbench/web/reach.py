"""What routes share: how they reach the workbench, and a file that is the body of a request."""

from typing import Annotated

from fastapi import Depends, Request, WebSocket

from scanbench.plcmodel.document import SIZE_LIMIT
from scanbench.server.workbench import Workbench
from scanbench.wire.refused import Refused


def _bench(request: Request) -> Workbench:
    bench = request.app.state.bench
    assert isinstance(bench, Workbench)
    return bench


def _socket_bench(socket: WebSocket) -> Workbench:
    bench = socket.app.state.bench
    assert isinstance(bench, Workbench)
    return bench


Bench = Annotated[Workbench, Depends(_bench)]
SocketBench = Annotated[Workbench, Depends(_socket_bench)]


async def file_body(request: Request, limit: int) -> bytes:
    """The file that is the body; one that is too large is not read to its end."""
    body = bytearray()
    async for chunk in request.stream():
        body += chunk
        if len(body) > limit:
            raise Refused(f"nothing was imported: the file is larger than {limit >> 20} MiB")
    return bytes(body)


async def xml_body(request: Request) -> str:
    """The XML file that is the body."""
    body = await file_body(request, SIZE_LIMIT)
    try:
        return body.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise Refused(f"nothing was imported: byte {error.start} is not UTF-8: save the file as UTF-8") from error
