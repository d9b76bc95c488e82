"""DAP on a WebSocket of its own, for tools that attach: each text is one message."""

import asyncio
import json
from contextlib import suppress

from fastapi import APIRouter, WebSocket, WebSocketDisconnect

from scanbench.store.records import NotFound
from scanbench.web.auth import user_of
from scanbench.web.dap.attaching import ForTool
from scanbench.web.dap.conversation import Conversation
from scanbench.web.dap.shapes import Body
from scanbench.web.messages_base import Id
from scanbench.web.reach import SocketBench
from scanbench.web.socket.waiting import Waiting

router = APIRouter(prefix="/api", tags=["debug"])


@router.websocket("/instances/{instance}/dap")
async def on_dap(bench: SocketBench, socket: WebSocket, instance: Id) -> None:
    """A debug session of its own at this PLC."""
    try:
        session = bench.session(instance)
    except NotFound as error:
        await socket.close(1008, str(error))
        return
    await socket.accept()
    user = user_of(socket)
    outbox = Outbox(socket)
    conversation = Conversation(outbox.send, ForTool(session, user.name), user, outbox.end)
    writer = asyncio.get_running_loop().create_task(outbox.write())
    try:
        while True:
            text = await socket.receive_text()
            try:
                message = json.loads(text)
            except (ValueError, RecursionError):
                message = text
            conversation.receive(message)
    except (WebSocketDisconnect, RuntimeError, KeyError):
        pass  # gone, or it sent bytes where only text is understood
    except asyncio.CancelledError:
        if not outbox.over:
            raise
    finally:
        writer.cancel()
        await asyncio.gather(writer, return_exceptions=True)
        await conversation.close()


class Outbox:
    """What is to be sent, in order."""

    def __init__(self, socket: WebSocket) -> None:
        self._socket = socket
        self._texts = Waiting()
        self._wake = asyncio.Event()
        self._ended = False

    @property
    def over(self) -> bool:
        """Whether so much waits that the connection ends: its client does not read."""
        return self._texts.over

    def send(self, message: Body) -> None:
        """Soon."""
        self._texts.add(json.dumps(message))
        self._wake.set()

    def end(self) -> None:
        """After what is to be sent, the connection is closed."""
        self._ended = True
        self._wake.set()

    async def write(self) -> None:
        """Sends as it comes."""
        with suppress(WebSocketDisconnect, RuntimeError):
            while True:
                await self._wake.wait()
                self._wake.clear()
                while self._texts:
                    await self._socket.send_text(self._texts.take())
                if self._ended:
                    await self._socket.close()
                    return
