"""Starting, and what the frontend's types are made of."""

import asyncio
import errno
import json
import os
import socket
from pathlib import Path
from typing import get_args

import httpx
import pytest

from scanbench.public import Public
from scanbench.server.workbench import Workbench
from scanbench.store.records import StoreError
from scanbench.web import (
    messages,
    messages_client,
    messages_commands,
    messages_errors,
    messages_models,
    messages_records,
    messages_user_errors,
    openapi,
)
from scanbench.web.app import bare_app
from scanbench.web.claim import InUse, claimed
from scanbench.web.handles import most_connections
from scanbench.web.kept_guests import kept_guests
from scanbench.web.messages_base import Wire
from scanbench.web.serve import CannotServe, serve
from scanbench.wire.commands import COMMANDS


def test_a_taken_port_is_named(tmp_path: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        with pytest.raises(CannotServe, match=f"127.0.0.1:{port}.*--port"):
            serve("127.0.0.1", port, tmp_path, lambda _: None)


def test_missing_models_and_bad_databases_are_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SCANBENCH_DATABASE", "oracle://x")
    with pytest.raises(CannotServe, match="sqlite:"):
        serve("127.0.0.1", 0, tmp_path, lambda _: None)
    monkeypatch.delenv("SCANBENCH_DATABASE")
    monkeypatch.setenv("SCANBENCH_MODELS", str(tmp_path / "nowhere"))
    with pytest.raises(CannotServe, match="SCANBENCH_MODELS"):
        serve("127.0.0.1", 0, tmp_path, lambda _: None)


@pytest.mark.parametrize(
    "error", [StoreError("the database cannot be used now: full"), OSError(errno.ENOSPC, "No space left on device")]
)
def test_what_fails_once_the_server_runs_ends_it_without_a_traceback(
    error: StoreError | OSError, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    """As on a disk that has room for the database, but not for what is in it."""
    closed: list[str] = []

    async def start(_bench: Workbench) -> None:
        raise error

    async def close(_bench: Workbench) -> None:
        closed.append("closed")

    monkeypatch.setattr(Workbench, "start", start)
    monkeypatch.setattr(Workbench, "close", close)
    monkeypatch.setattr("scanbench.web.serve.end_children", lambda: None)  # those of other tests
    with pytest.raises(CannotServe if isinstance(error, StoreError) else OSError) as told:
        serve("127.0.0.1", 0, tmp_path, closed.append)
    assert str(told.value) == str(error)
    assert closed == ["closed"], "it never said that it is ready"
    assert capfd.readouterr().err == ""


def test_every_message_is_in_the_openapi_document(tmp_path: Path) -> None:
    assert openapi.main([str(tmp_path / "openapi.json")]) == 0
    schemas = json.loads((tmp_path / "openapi.json").read_text())["components"]["schemas"]
    shapes = {
        name
        for file in (
            messages,
            messages_client,
            messages_errors,
            messages_models,
            messages_records,
            messages_user_errors,
        )
        for name, each in vars(file).items()
        if isinstance(each, type) and issubclass(each, Wire) and each is not Wire
    }
    shapes |= {each.__name__ for each in get_args(messages_commands.Command)}
    assert shapes <= set(schemas)
    assert {getattr(each, "PUBLIC", each.__name__) for each in Public.__subclasses__()} <= set(schemas)
    assert {*COMMANDS, "run"} <= set(schemas["ClientMessage"]["discriminator"]["mapping"])
    assert set(COMMANDS) == set(schemas["PlcCommand"]["discriminator"]["mapping"])
    assert {"hello", "written"} <= set(schemas["ServerMessage"]["discriminator"]["mapping"])
    assert openapi.main([]) == 2


def test_a_data_directory_belongs_to_one_server(tmp_path: Path) -> None:
    with claimed(tmp_path), pytest.raises(InUse, match="a different --data"), claimed(tmp_path):
        pass
    with claimed(tmp_path):
        pass


def test_connections_are_refused_before_handles_run_out() -> None:
    assert [most_connections(handles) for handles in (64, 1024, 65_536)] == [32, 768, 65_280]


def test_guests_go_on_counting_after_a_restart(tmp_path: Path) -> None:
    assert [kept_guests(tmp_path)(), kept_guests(tmp_path)()] == ["Guest 1", "Guest 2"]


def test_guests_have_names_where_nothing_can_be_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    next_guest = kept_guests(tmp_path)
    assert next_guest() == "Guest 1"

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr("scanbench.web.kept_guests._keep", full)
        assert [next_guest(), next_guest()] == ["Guest 2", "Guest 3"]
    assert next_guest() == "Guest 4"
    assert kept_guests(tmp_path)() == "Guest 5"


@pytest.mark.parametrize(("number", "status"), [(errno.ENOSPC, 507), (errno.EIO, 500)])
def test_a_request_that_finds_no_room_is_told_so(number: int, status: int) -> None:
    app = bare_app()

    @app.get("/api/writes")
    async def on_write() -> None:
        raise OSError(number, os.strerror(number))

    app.router.routes.insert(0, app.router.routes.pop())  # before the route of the page

    async def asked() -> httpx.Response:
        transport = httpx.ASGITransport(app, raise_app_exceptions=False)
        async with httpx.AsyncClient(transport=transport, base_url="http://localhost") as client:
            return await client.get("/api/writes")

    reply = asyncio.run(asked())
    assert reply.status_code == status
    assert status == 500 or reply.json()["message"].startswith("no space: the disk is full")
