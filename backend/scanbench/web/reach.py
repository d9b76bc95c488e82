"""How a route reaches the workbench."""

from typing import Annotated

from fastapi import Depends, Request, WebSocket

from scanbench.session.workbench import Workbench


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
