"""Nobody waits for a project's own errors, however many they are: the work on them is not done on the event loop."""

import asyncio
from collections.abc import Callable
from datetime import UTC, datetime
from types import SimpleNamespace
from typing import cast

import pytest
from starlette.requests import Request

from scanbench.plcmodel.model import Model
from scanbench.server import user_errors
from scanbench.server.workbench import Workbench
from scanbench.store.records import FileRow, NotFound
from scanbench.web import messages_user_errors as wire
from scanbench.web.routes import user_errors as routes
from tests.caseformat import MODELS


class _Projects:
    """One project, in memory."""

    def __init__(self) -> None:
        self.text: str | None = None

    async def get(self, _id: int) -> SimpleNamespace:
        return SimpleNamespace(model="CJ1M-CPU63")

    def model(self, name: str) -> Model:
        return MODELS[name]

    async def file(self, _id: int, path: str) -> FileRow:
        if self.text is None:
            raise NotFound("there is none")
        return FileRow(path, self.text, 1, "ada", datetime(2026, 11, 21, tzinfo=UTC))

    async def save(self, id: int, path: str, text: str, _version: int, _author: str) -> FileRow:
        self.text = text
        return await self.file(id, path)


def test_the_work_is_done_in_threads(monkeypatch: pytest.MonkeyPatch) -> None:
    held: list[str] = []

    def noted(name: str, work: Callable[..., object]) -> Callable[..., object]:
        def call(*arguments: object) -> object:
            if asyncio._get_running_loop() is not None:
                held.append(name)
            return work(*arguments)

        return call

    for room, names in (
        (user_errors, ("_read", "_checked", "_together", "check_drafts", "write_catalogue")),
        (routes, ("_drafts", "_shown")),
    ):
        for name in names:
            monkeypatch.setattr(room, name, noted(name, getattr(room, name)))
    bench = cast(Workbench, SimpleNamespace(projects=_Projects()))

    async def body() -> dict[str, object]:
        return {"type": "http.request", "body": await exported(), "more_body": False}

    async def exported() -> bytes:
        return bytes((await routes.on_export_user_errors(bench, 1)).body)

    async def story() -> None:
        request = Request({"type": "http", "method": "POST", "path": "/", "query_string": b"", "headers": []}, body)
        await exported()
        await routes.on_check_user_errors(bench, 1, wire.UserErrorsDraft(errors=[]))
        await routes.on_save_user_errors(bench, request, 1, wire.SaveUserErrors(errors=[], version=0))
        await routes.on_user_errors(bench, 1)
        for how in ("replace", "add"):
            request = Request(request.scope, body)
            await routes.on_import_user_errors(bench, request, 1, 1, "replace" if how == "replace" else "add")

    asyncio.run(story())
    assert held == []
