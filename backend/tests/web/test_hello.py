"""The first message of a connection tells what is so then: what changed while it was made is told to it by nothing else."""

import asyncio
import json
from collections.abc import Awaitable, Callable
from pathlib import Path

from fastapi import WebSocket
from starlette.types import Message

from scanbench.server.workbench import Workbench
from scanbench.store.store import Store
from scanbench.web import translate
from scanbench.web.socket.socket import Client
from scanbench.wire.events import User

Act = Callable[[Workbench], Awaitable[object]]
Said = dict[str, object]


def bench_with_plc(path: Path) -> tuple[Store, int, int]:
    """A store with a project and a PLC of it that is off, so that no process is needed."""
    store = Store(f"sqlite:///{path / 'bench.db'}")
    project = store.projects.create("line", "GENERIC-IEC").id
    store.files.save(project, "main.st", "PROGRAM Main\nEND_PROGRAM\n", 0, "Ada")
    store.builds.accept(project, {"main.st": "PROGRAM Main\nEND_PROGRAM\n"}, "Ada")
    id = store.instances.create(project, "line-1").id
    store.instances.change(id, powered=False)
    return store, project, id


async def nothing(_bench: Workbench) -> None:
    """Nothing is done at this step of a connection."""


async def connect(
    path: Path, store: Store, project: int, id: int, ends: str, accepted: Act = nothing, greeted: Act = nothing
) -> list[Said]:
    """All that Ada's browser is told, up to and with the message of type `ends`; what is done when her connection is accepted, and greeted."""
    bench = Workbench(store, path)
    await bench.start()
    told = asyncio.Event()
    said: list[Said] = []
    steps = iter(("websocket.connect", "websocket.disconnect"))

    async def receive() -> Message:
        step = next(steps)
        if step == "websocket.disconnect":
            await told.wait()
        return {"type": step, "code": 1000}

    async def send(message: Message) -> None:
        if message["type"] == "websocket.accept":
            await accepted(bench)
            return
        said.append(json.loads(message["text"]))
        if said[-1]["type"] == ends:
            told.set()
        if said[-1]["type"] == "hello":
            await greeted(bench)

    scope = {"type": "websocket", "path": "/", "headers": [], "query_string": b""}
    client = Client(
        WebSocket(scope, receive, send), bench.session(id), User("Ada"), bench.projects.drafts, bench.people
    )
    try:
        await client.serve(await bench.projects.get(project), bench.verifications.of)
    finally:
        await bench.close()
    return said


def test_who_is_at_a_plc_is_told_by_whom_it_is_deleted(tmp_path: Path) -> None:
    store, project, id = bench_with_plc(tmp_path)
    users: list[str] = []

    async def look_and_delete(bench: Workbench) -> None:
        row = await bench.projects.get(project)
        users.extend(user.name for user in translate.instance(bench.session(id), row).users)
        await bench.delete_instance(id, "Bob")

    said = asyncio.run(connect(tmp_path, store, project, id, "instance_deleted", greeted=look_and_delete))
    store.close()
    assert users == ["Ada"]
    assert {"type": "instance_deleted", "author": "Bob"} in said


def test_what_changes_while_a_browser_connects_is_in_its_hello(tmp_path: Path) -> None:
    store, project, id = bench_with_plc(tmp_path)

    async def rename(bench: Workbench) -> None:
        await bench.change_instance(id, "Bob", "line-2", None, None)

    first = asyncio.run(connect(tmp_path, store, project, id, "hello", accepted=rename))[0]
    store.close()
    assert first["type"] == "hello"
    assert isinstance(first["instance"], dict)
    assert first["instance"]["name"] == "line-2"
