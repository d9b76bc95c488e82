"""A language server on a WebSocket, with a process of its own: what the browser's editor talks to."""

import asyncio
import itertools
import json
import os
import select
from types import TracebackType
from typing import Any, Self

import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

from scanbench.web.socket.lsp import Deadline
from tests.web.server import PATIENCE_S, Server
from tests.web.test_restart import children

MAIN = "PROGRAM Main\nVAR inc : Inc; n : INT; END_VAR\ninc();\nn := inc.n;\nEND_PROGRAM\n"
BLOCK = "FUNCTION_BLOCK Inc\nVAR_OUTPUT n : INT; END_VAR\nn := n + 1;\nEND_FUNCTION_BLOCK\n"


class Editor:
    """The client of a browser, as far as these tests need it."""

    def __init__(self, server: Server, project: int) -> None:
        address = f"ws://127.0.0.1:{server.port}/api/projects/{project}/lsp"
        headers = {"Cookie": f"scanbench_token_{server.port}={server.token}", "Origin": server.base}
        self._connection = connect(address, additional_headers=headers, max_queue=None)
        self.socket = self._connection.__enter__()
        self._ids = itertools.count(1)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._connection.__exit__(kind, error, trace)

    def begin(self, **wanted: object) -> None:
        self.ask("initialize", processId=None, rootUri=None, capabilities={}, initializationOptions=wanted)
        self.tell("initialized")

    def ask(self, method: str, **params: Any) -> Any:
        id = next(self._ids)
        self.socket.send(json.dumps({"jsonrpc": "2.0", "id": id, "method": method, "params": params}))
        while True:
            message = self.take()
            if message.get("id") == id:
                return message["result"]

    def tell(self, method: str, **params: Any) -> None:
        self.socket.send(json.dumps({"jsonrpc": "2.0", "method": method, "params": params}))

    def take(self) -> dict[str, Any]:
        message: dict[str, Any] = json.loads(self.socket.recv(PATIENCE_S))
        return message

    def problems(self, uri: str) -> list[dict[str, Any]]:
        """The next list of problems of a file."""
        while True:
            message = self.take()
            if message.get("method") == "textDocument/publishDiagnostics" and message["params"]["uri"] == uri:
                found: list[dict[str, Any]] = message["params"]["diagnostics"]
                return found


def test_a_browser_edits_a_file_beside_those_that_are_saved(server: Server) -> None:
    project = server.project("lsp", "GENERIC-IEC", Main=MAIN, Inc=BLOCK)
    with Editor(server, project) as editor:
        edited(server, project, editor)


def test_a_browser_chooses_what_symbols_it_wants_and_not_the_project(server: Server) -> None:
    text = "PROGRAM Main\nVAR n : INT; END_VAR\nIF n > 1 THEN\n  n := 0;\nEND_IF;\nEND_PROGRAM\n"
    project = server.project("symbols", "GENERIC-IEC", Main=text)
    with Editor(server, project) as editor:
        editor.begin(statements=True, files={}, model="NONE")
        (main,) = editor.ask("textDocument/documentSymbol", textDocument={"uri": "scanbench:/Main.st"})
        assert [each["name"] for each in main["children"]] == ["VAR", "IF n > 1"]


def edited(server: Server, project: int, editor: Editor) -> None:
    editor.begin()
    uri = "scanbench:/Main.st"
    document = {"uri": uri, "languageId": "st", "version": 1, "text": MAIN}
    editor.tell("textDocument/didOpen", textDocument=document)
    where = {"textDocument": {"uri": uri}, "position": {"line": 3, "character": 9}}
    (found,) = editor.ask("textDocument/definition", **where)
    assert (found["uri"], found["range"]["start"]["line"]) == ("scanbench:/Inc.st", 1)
    # somebody saves the block without its output, and the browser says that files have changed
    reply = server.http.put(
        f"/api/projects/{project}/files/Inc.st", json={"text": BLOCK.replace("n :", "m :"), "version": 1}
    )
    assert reply.status_code == 200, reply.text
    editor.tell("workspace/didChangeWatchedFiles", changes=[])
    while not editor.problems(uri):
        pass
    assert editor.ask("textDocument/definition", **where) == []


def test_the_process_ends_with_its_connection(server: Server) -> None:
    project = server.project("lsp2", "GENERIC-IEC", Main="PROGRAM Main\nEND_PROGRAM\n")
    before = children(server.process.pid)
    with Editor(server, project) as editor:
        editor.begin()
        (own,) = set(children(server.process.pid)) - set(before)
        ended = os.pidfd_open(own)
    assert select.select([ended], [], [], PATIENCE_S)[0]
    os.close(ended)


@pytest.mark.parametrize("text", ["nonsense", "[]", '{"jsonrpc": "2.0", "method": "exit"}'])
def test_who_does_not_speak_the_protocol_is_left(server: Server, text: str) -> None:
    with Editor(server, server.project(f"lsp {len(text)}", "GENERIC-IEC")) as editor:
        editor.socket.send(text)
        with pytest.raises(ConnectionClosed):
            editor.socket.recv(PATIENCE_S)


def test_of_a_project_that_is_not_there_the_reason_is_told(server: Server) -> None:
    with pytest.raises(InvalidStatus, match="403"):
        Editor(server, 4711)


def test_a_process_that_says_nothing_after_a_question_is_ended() -> None:
    async def silent() -> None:
        killed = asyncio.Event()
        deadline = Deadline(killed.set, 0)
        deadline.asked()
        await killed.wait()

    async def heard() -> None:
        killed = asyncio.Event()
        deadline = Deadline(killed.set, 0)
        deadline.asked()
        deadline.heard()
        later = asyncio.Event()
        asyncio.get_running_loop().call_later(0, later.set)
        await later.wait()
        assert not killed.is_set()

    asyncio.run(silent())
    asyncio.run(heard())
