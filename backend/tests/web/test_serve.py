"""Starting, and what the frontend's types are made of."""

import json
import socket
from pathlib import Path

import pytest

from scanbench.web import messages, openapi
from scanbench.web.serve import CannotServe, serve


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


def test_every_message_is_in_the_openapi_document(tmp_path: Path) -> None:
    assert openapi.main([str(tmp_path / "openapi.json")]) == 0
    schemas = json.loads((tmp_path / "openapi.json").read_text())["components"]["schemas"]
    shapes = {
        name
        for name, each in vars(messages).items()
        if isinstance(each, type) and issubclass(each, messages.Wire) and each is not messages.Wire
    }
    assert shapes <= set(schemas)
    assert {"write", "run"} <= set(schemas["ClientMessage"]["discriminator"]["mapping"])
    assert {"hello", "written"} <= set(schemas["ServerMessage"]["discriminator"]["mapping"])
    assert openapi.main([]) == 2
