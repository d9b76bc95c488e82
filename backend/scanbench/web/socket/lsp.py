"""LSP on a WebSocket of its own, for editors in browsers: each text is one message. What answers is a process of its own, forked for this
connection, which ends with it; this end frames its messages, and tells the process the files of the project."""

import asyncio
import json
from collections.abc import Callable
from contextlib import suppress
from typing import Any

from fastapi import APIRouter, WebSocket, WebSocketDisconnect

from scanbench.host.zygote import LANGUAGE, NoProcess
from scanbench.jobs.channel import connect
from scanbench.server.workbench import Workbench
from scanbench.store.records import NotFound
from scanbench.web.framing import BadFrame, Framing, framed
from scanbench.web.lsp.options import LISTS, STATEMENTS
from scanbench.web.messages_base import Id
from scanbench.web.reach import SocketBench

router = APIRouter(prefix="/api", tags=["projects"])
CHANGED = "workspace/didChangeWatchedFiles"
"""What a browser says when files of the project were saved, made or deleted, by anybody."""
LONGEST_S = 120.0
"""A process that answers nothing for so long after a question, or takes nothing in, is ended: the editor begins another."""
_CHUNK = 1 << 16


@router.websocket("/projects/{project}/lsp")
async def on_lsp(bench: SocketBench, socket: WebSocket, project: Id) -> None:
    """A language server for this project, for one editor."""
    try:
        told = await _project(bench, project)
        process, reader, writer = await connect(None, LANGUAGE)
    except NotFound as error:
        await socket.close(1008, str(error))
        return
    except NoProcess as error:
        await socket.close(1013, str(error))
        return
    deadline = Deadline(process.kill, LONGEST_S)
    answers = asyncio.get_running_loop().create_task(_answers(reader, socket, deadline))
    try:
        await socket.accept()
        while True:
            message = json.loads(await socket.receive_text())
            if not isinstance(message, dict):
                break
            if message.get("method") == "initialize" and isinstance(message.get("params"), dict):
                message["params"]["initializationOptions"] = told | _wanted(message["params"])
            elif message.get("method") == CHANGED:
                files = list((await bench.projects.sources(project)).items())
                message = {"jsonrpc": "2.0", "method": "scanbench/files", "params": {"files": files}}
            if "id" in message:
                deadline.asked()
            writer.write(framed(message))
            async with asyncio.timeout(LONGEST_S):
                await writer.drain()
    except (WebSocketDisconnect, RuntimeError, KeyError, ValueError, ConnectionError, TimeoutError, NotFound):
        pass  # gone, or it does not speak the protocol, or the project is no more
    finally:
        deadline.heard()
        answers.cancel()
        await asyncio.gather(answers, return_exceptions=True)
        writer.close()
        process.kill()
        await asyncio.to_thread(process.wait)


def _wanted(params: dict[str, Any]) -> dict[str, object]:
    """What a browser may choose: the project is not of its choice."""
    theirs = params.get("initializationOptions")
    return {each: True for each in (STATEMENTS, LISTS) if isinstance(theirs, dict) and theirs.get(each) is True}


class Deadline:
    """Ends a process that says nothing for so long after a question."""

    def __init__(self, kill: Callable[[], None], seconds: float) -> None:
        self._kill, self._seconds = kill, seconds
        self._timer: asyncio.TimerHandle | None = None

    def asked(self) -> None:
        if self._timer is None:
            self._timer = asyncio.get_running_loop().call_later(self._seconds, self._kill)

    def heard(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None


async def _project(bench: Workbench, project: int) -> dict[str, Any]:
    """What the process is told of a project."""
    row = await bench.projects.get(project)
    return {"model": row.model, "files": await bench.projects.sources(project)}


async def _answers(reader: asyncio.StreamReader, socket: WebSocket, deadline: Deadline) -> None:
    """Sends what the process says; when it ends, so does the connection."""
    framing = Framing()
    with suppress(WebSocketDisconnect, RuntimeError):
        with suppress(BadFrame, ConnectionError):
            while data := await reader.read(_CHUNK):
                deadline.heard()
                for body in framing.feed(data):
                    await socket.send_text(body.decode())
        await socket.close(1011, "the language server has ended")
