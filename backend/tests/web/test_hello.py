"""The first message of a connection tells what is so then: what changed while it was made is told to it by nothing else."""

import asyncio
import json
from pathlib import Path

from fastapi import WebSocket
from starlette.types import Message

from scanbench.server.workbench import Workbench
from scanbench.store.store import Store
from scanbench.web.socket.socket import Client
from scanbench.wire.events import User


def test_what_changes_while_a_browser_connects_is_in_its_hello(tmp_path: Path) -> None:
    store = Store(f"sqlite:///{tmp_path / 'bench.db'}")
    project = store.projects.create("line", "GENERIC-IEC").id
    store.files.save(project, "main.st", "PROGRAM Main\nEND_PROGRAM\n", 0, "Ada")
    store.builds.accept(project, {"main.st": "PROGRAM Main\nEND_PROGRAM\n"}, "Ada")
    id = store.instances.create(project, "line-1").id
    store.instances.change(id, powered=False)  # so that no process is needed
    said: list[str] = []

    async def connect() -> None:
        bench = Workbench(store, tmp_path)
        await bench.start()
        session = bench.session(id)
        told = asyncio.Event()
        steps = iter(("websocket.connect", "websocket.disconnect"))

        async def receive() -> Message:
            step = next(steps)
            if step == "websocket.disconnect":
                await told.wait()
            return {"type": step, "code": 1000}

        async def send(message: Message) -> None:
            if message["type"] == "websocket.accept":
                await bench.change_instance(id, "Bob", "line-2", None, None)
            else:
                said.append(message["text"])
                told.set()

        scope = {"type": "websocket", "path": "/", "headers": [], "query_string": b""}
        client = Client(WebSocket(scope, receive, send), session, User("Ada"), bench.projects.drafts, bench.people)
        try:
            await client.serve(await bench.projects.get(project), bench.verifications.of)
        finally:
            await bench.close()

    asyncio.run(connect())
    store.close()
    hello = json.loads(said[0])
    assert (hello["type"], hello["instance"]["name"]) == ("hello", "line-2")
