"""Who reads Japanese is told everything in Japanese: by REST, on the WebSocket, by the language server and the debugger."""

import asyncio
import json
from collections.abc import MutableMapping
from pathlib import Path

import httpx
import pytest
from lsprotocol import types
from pytest_lsp import LanguageClient
from starlette.types import Message, Receive, Scope, Send
from websockets.sync.client import connect

from scanbench.web.spoken import Spoken
from tests.lsp.client import conversation, opened
from tests.web.dap.client import StdioClient
from tests.web.server import Server

JA = {"Accept-Language": "ja-JP,ja;q=0.9,en;q=0.8"}


def test_a_refusal(server: Server) -> None:
    english = server.http.get("/api/instances/99999")
    japanese = server.http.get("/api/instances/99999", headers=JA)
    assert english.json()["message"] == "there is no instance 99999"
    assert japanese.json()["message"] == "インスタンス 99999 はありません"
    assert japanese.status_code == english.status_code == 404
    assert japanese.headers["content-language"] == "ja"
    assert "Accept-Language" in japanese.headers["vary"]


async def _served(method: str) -> dict[bytes, bytes]:
    """The headers of an answer whose length the application gave, though it has no body."""
    sent: list[MutableMapping[str, object]] = []

    async def app(_scope: Scope, _receive: Receive, send: Send) -> None:
        headers = [(b"content-type", b"application/json"), (b"content-length", b"42")]
        await send({"type": "http.response.start", "status": 200, "headers": headers})
        await send({"type": "http.response.body", "body": b""})

    async def receive() -> Message:
        return {"type": "http.request"}

    async def send(message: Message) -> None:
        sent.append(message)

    scope = {"type": "http", "method": method, "headers": [(b"accept-language", b"ja")]}
    await Spoken(app)(scope, receive, send)
    headers = sent[0]["headers"]
    assert isinstance(headers, list)
    assert len(sent) == 2
    return dict(headers)


def test_the_length_of_what_is_not_sent_stays() -> None:
    assert asyncio.run(_served("HEAD"))[b"content-length"] == b"42"


def test_what_the_page_was_told_to_speak_counts_more(server: Server) -> None:
    asked = {**JA, "Cookie": "scanbench_language=en"}
    assert server.http.get("/api/instances/99999", headers=asked).json()["message"] == "there is no instance 99999"
    asked = {"Accept-Language": "en", "Cookie": "scanbench_language=ja"}
    assert "ありません" in server.http.get("/api/instances/99999", headers=asked).json()["message"]


def test_without_the_token_too(server: Server) -> None:
    told = httpx.get(f"{server.base}/api", headers=JA)
    assert told.json()["message"] == "トークンがないか、正しくありません。表示されたアドレスを開いてください"


def test_problems_of_a_check(server: Server) -> None:
    project = server.project("spoken", "GENERIC-IEC")
    text = "PROGRAM Main\nVAR valve : INT; END_VAR\nvalvo := 1;\nEND_PROGRAM\n"
    found = server.http.post(f"/api/projects/{project}/check", json={"files": {"Main.st": text}}, headers=JA).json()
    assert [(each["code"], each["message"]) for each in found["problems"]] == [
        ("T001", "`valvo` は宣言されていません。`valve` ではありませんか。")
    ]


@pytest.mark.parametrize("what", ["files", "export"])
def test_what_is_kept_stays_as_it_is(server: Server, what: str) -> None:
    """A text of somebody's, or a file to keep, is nothing that Scanbench says."""
    project = server.project(f"kept {what}", "GENERIC-IEC", Main="(* nothing was changed *)")
    path = f"/api/projects/{project}/files/Main.st" if what == "files" else f"/api/projects/{project}/archive"
    assert server.http.get(path, headers=JA).content == server.http.get(path).content


def test_events(server: Server) -> None:
    instance = server.instance(
        "spoken", "GENERIC-IEC", Main="PROGRAM Main\nVAR n : INT; END_VAR\nn := n + 1;\nEND_PROGRAM\n"
    )
    cookies = f"scanbench_token_{server.port}={server.token}; scanbench_language=ja"
    address = f"ws://127.0.0.1:{server.port}/api/instances/{instance}/socket"
    with connect(address, additional_headers={"Cookie": cookies, "Origin": server.base}) as socket:
        socket.send(json.dumps({"type": "force", "ref": 1, "path": "Main.n", "value": "many"}))
        socket.send(json.dumps({"type": "force", "ref": 2, "path": "Main.n", "value": "7"}))
        done: dict[int, str] = {}
        logged: list[str] = []
        while 2 not in done or not logged:
            message = json.loads(socket.recv())
            if message["type"] == "done":
                done[message["ref"]] = message["message"]
            if message["type"] == "log":
                logged += [line["text"] for line in message["lines"]]
    assert done[1] == "Main.n: `many` は INT ではありません。-32768 ～ 32767 の整数か、16#FF のように書いてください"
    assert done[2] == "Main.n を 7 に強制しました"
    assert "Main.n を 7 に強制しました" in logged


def test_the_language_server(tmp_path: Path) -> None:
    (tmp_path / "main.st").write_text("PROGRAM Main\nVAR valve : INT; END_VAR\nvalvo := 1;\nEND_PROGRAM\n", "utf-8")

    async def talk(client: LanguageClient) -> None:
        doc = opened(client, tmp_path / "main.st")
        await client.wait_for_notification(types.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)
        assert [each.message for each in client.diagnostics[doc.uri]] == [
            "`valvo` は宣言されていません。`valve` ではありませんか。"
        ]

    conversation(tmp_path, talk, locale="ja")


def test_the_debugger(tmp_path: Path) -> None:
    with StdioClient(temporary=tmp_path) as client:
        assert client.refused("threads") == "there is no PLC yet: send `initialize` first"
        client.ask("initialize", adapterID="scanbench", locale="ja")
        assert client.refused("threads") == "PLC がまだありません: 先に `launch` または `attach` を送ってください"
