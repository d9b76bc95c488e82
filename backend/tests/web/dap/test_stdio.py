"""`scanbench dap` on its streams: launch, attach, and clients that behave badly."""

import json
import os
import signal
from pathlib import Path

import pytest

from tests.amounts import slow
from tests.web.dap.client import PATIENCE_S, Closed, StdioClient
from tests.web.dap.test_socket import CALL_A, FIRST, PROGRAM
from tests.web.server import Server

TIMED = """PROGRAM Main
VAR
  t : TON;
END_VAR
t(IN := TRUE, PT := T#1h);
END_PROGRAM
"""


@pytest.fixture
def project(tmp_path: Path) -> Path:
    folder = tmp_path / "plant"
    (folder / "blocks").mkdir(parents=True)
    block, _, main = PROGRAM.partition("END_FUNCTION_BLOCK\n")
    (folder / "blocks" / "Counter.st").write_text(f"{block}END_FUNCTION_BLOCK\n")
    (folder / "Main.st").write_text("\n" * block.count("\n") + "\n" + main)
    (folder / "project.json").write_text(json.dumps({"name": "Plant", "model": "CJ1M-CPU63"}))
    return folder


def test_a_folder_is_launched_and_nothing_is_left_of_it(project: Path, tmp_path: Path) -> None:
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    with StdioClient(temporary=temporary) as client:
        client.launch(project, stopOnEntry=True, pace=0)
        assert client.event("stopped")["reason"] == "entry"
        assert client.stack()[0]["source"]["path"] == str(project / "Main.st")
        files = [each["path"] for each in client.ask("loadedSources")["sources"]]
        assert str(project / "blocks" / "Counter.st") in files
        assert client.value("A400") == "16#0000"  # the model that project.json names
        client.ask("disconnect")
        assert client.process.wait(PATIENCE_S) == 0
    assert list(temporary.iterdir()) == []


def test_a_client_that_dies_takes_the_plc_with_it(project: Path, tmp_path: Path) -> None:
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    with StdioClient(temporary=temporary) as client:
        client.launch(project, stopOnEntry=True)
        client.event("stopped")
    assert client.process.returncode == 0  # the stream ended
    assert list(temporary.iterdir()) == []


def test_an_editor_that_ends_the_adapter(project: Path, tmp_path: Path) -> None:
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    with StdioClient(temporary=temporary) as client:
        client.launch(project)
        client.process.send_signal(signal.SIGTERM)
        assert client.process.wait(PATIENCE_S) == 0
    assert list(temporary.iterdir()) == []


def test_arguments_are_checked(project: Path) -> None:
    with StdioClient() as client:
        assert "initialize" in client.refused("threads")
        client.ask("initialize", adapterID="scanbench")
        assert "launch" in client.refused("threads")
        assert "program" in client.refused("launch")
        assert "no model CJ9" in client.refused("launch", program=str(project), model="CJ9")
        assert "interval 3 apples" in client.refused("launch", program=str(project), interval="3 apples")
        assert "pace" in client.refused("launch", program=str(project), pace=0.001)
        assert "less than or equal to 1000" in client.refused("launch", program=str(project), pace=5000)
        assert "does not exist" in client.refused("launch", program=str(project / "no.st"))


@slow
def test_a_launch_can_be_cancelled_and_tried_again(project: Path) -> None:
    with StdioClient() as client:
        client.ask("initialize", adapterID="scanbench")
        seq = client.send("launch", program=str(project))
        client.event("initialized")
        client.ask("cancel", requestId=seq)
        assert client.response(seq)["message"] == "cancelled"
        assert "launch" in client.refused("threads")
        seq = client.send("launch", program=str(project), stopOnEntry=True)
        client.event("initialized")
        client.ask("configurationDone")
        assert client.response(seq)["success"]
        client.event("stopped")


@slow
def test_the_interval_counts(tmp_path: Path) -> None:
    (tmp_path / "main.st").write_text(TIMED)
    with StdioClient(cwd=tmp_path) as client:
        client.launch(Path("main.st"), interval="T#250ms", stopOnEntry=True)
        client.event("stopped")
        for _ in range(4):
            client.halt("scanbench/singleScan")
        assert client.value("Main.t.ET") == "T#750ms"


@slow
def test_no_debug_runs_through(project: Path) -> None:
    with StdioClient() as client:

        def breakpoints() -> None:
            source = {"path": str(project / "Main.st")}
            answer = client.ask("setBreakpoints", source=source, breakpoints=[{"line": FIRST}])
            assert answer["breakpoints"][0]["message"] == "launched without debugging"

        client.launch(project, breakpoints, noDebug=True, stopOnEntry=True, pace=0)
        first = int(client.value("Main.n"))
        while int(client.value("Main.n")) == first:
            pass
        assert not [each for each in client.messages if each.get("event") == "stopped"]


@slow
def test_bytes_that_are_no_messages_end_it() -> None:
    with StdioClient() as client:
        client.put_bytes(b"GET / HTTP/1.1\r\n\r\n")
        with pytest.raises(Closed):
            client.take()


def test_half_a_message_is_waited_for() -> None:
    with StdioClient() as client:
        message = json.dumps({"seq": 1, "type": "request", "command": "initialize", "arguments": {}}).encode()
        framed = b"Content-Length: %d\r\n\r\n%s" % (len(message), message)
        for at in range(0, len(framed), 7):
            client.put_bytes(framed[at : at + 7])
        assert client.response(1)["success"]


def test_attaching_to_a_server(server: Server) -> None:
    name = "attached by stdio"
    instance = server.instance(name, "GENERIC-IEC", Main=PROGRAM)
    with StdioClient("--user", "Grace") as client:
        client.ask("initialize", adapterID="scanbench")
        assert "token" in client.refused("attach", address=server.base, instance=name)
        assert "no instance nobody" in client.refused("attach", address=server.address, instance="nobody")
        assert "no Scanbench server" in client.refused("attach", address="127.0.0.1:1", token="x")
        client.ask("attach", address=server.address, instance=name, localRoot="/my/plant")
        client.event("initialized")
        client.ask("setBreakpoints", source={"path": "/my/plant/Main.st"}, breakpoints=[{"line": CALL_A}])
        with server.browser(instance) as browser:
            assert {user["name"] for user in browser.hello["users"]} >= {"Grace"}
            stopped = client.halt("configurationDone")
            assert stopped["reason"] == "breakpoint"
            assert client.stack()[0]["source"]["path"] == "/my/plant/Main.st"
        client.ask("disconnect")
        assert client.process.wait(PATIENCE_S) == 0
    assert server.state(instance)["state"] == "running"


@slow
def test_a_server_that_is_gone_ends_the_session(tmp_path: Path) -> None:
    with Server(tmp_path / "bench") as server:
        instance = server.instance("gone", "GENERIC-IEC", Main=PROGRAM)
        client = StdioClient()
        client.ask("initialize", adapterID="scanbench")
        client.ask("attach", address=server.base, token=server.token, instance=instance)
        client.ask("configurationDone")
        os.kill(server.process.pid, signal.SIGKILL)
        client.event("terminated")
        client.close()
