"""The first message of a connection tells what is so then: what changed while it was made is told to it by nothing else."""

import asyncio
import json
from pathlib import Path

from fastapi import WebSocket
from starlette.types import Message

from scanbench.server.workbench import Workbench
from scanbench.store.store import Store
from scanbench.web import translate
from scanbench.web.socket.socket import Client
from scanbench.wire.events import User


def bench_with_plc(path: Path) -> tuple[Store, int, int]:
    """A store with a project and a PLC of it that is off, so that no process is needed."""
    store = Store(f"sqlite:///{path / 'bench.db'}")
    project = store.projects.create("line", "GENERIC-IEC").id
    store.files.save(project, "main.st", "PROGRAM Main\nEND_PROGRAM\n", 0, "Ada")
    store.builds.accept(project, {"main.st": "PROGRAM Main\nEND_PROGRAM\n"}, "Ada")
    id = store.instances.create(project, "line-1").id
    store.instances.change(id, powered=False)
    return store, project, id


def test_who_is_at_a_plc_is_told_by_whom_it_is_deleted(tmp_path: Path) -> None:
    store, project, id = bench_with_plc(tmp_path)
    said: list[dict[str, object]] = []
    users: list[str] = []

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
                return
            said.append(json.loads(message["text"]))
            if said[-1]["type"] == "hello":
                row = await bench.projects.get(project)
                users.extend(user.name for user in translate.instance(session, row).users)
                await bench.delete_instance(id, "Bob")
            elif said[-1]["type"] == "instance_deleted":
                told.set()

        scope = {"type": "websocket", "path": "/", "headers": [], "query_string": b""}
        client = Client(WebSocket(scope, receive, send), session, User("Ada"), bench.projects.drafts, bench.people)
        try:
            await client.serve(await bench.projects.get(project), bench.verifications.of)
        finally:
            await bench.close()

    asyncio.run(connect())
    store.close()
    assert users == ["Ada"]
    assert {"type": "instance_deleted", "author": "Bob"} in said


def test_what_changes_while_a_browser_connects_is_in_its_hello(tmp_path: Path) -> None:
    store, project, id = bench_with_plc(tmp_path)
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
