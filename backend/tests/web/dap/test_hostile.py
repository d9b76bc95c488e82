"""`scanbench dap` with clients that send nonsense or leave at a bad time, and with addresses at which there is no server."""

import os
import select
import socket
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.amounts import slow
from tests.web.dap.client import PATIENCE_S, StdioClient
from tests.web.dap.test_socket import CALL_A, FIRST, PROGRAM


@pytest.fixture
def program(tmp_path: Path) -> Path:
    file = tmp_path / "プラント" / "主 プログラム.st"
    file.parent.mkdir()
    file.write_text(PROGRAM)
    return file


def serving(answer: bytes | None) -> Iterator[str]:
    """The address of a service that gives this answer, or none at all."""
    with socket.create_server(("127.0.0.1", 0)) as server:
        held: list[socket.socket] = []

        def work() -> None:
            while True:
                try:
                    client, _ = server.accept()
                except OSError:
                    return
                held.append(client)
                if answer is not None:
                    client.recv(1000)
                    client.sendall(answer)
                    client.close()

        thread = threading.Thread(target=work, daemon=True)
        thread.start()
        yield f"127.0.0.1:{server.getsockname()[1]}"
        server.shutdown(socket.SHUT_RDWR)
        thread.join()
        for client in held:
            client.close()


@pytest.fixture
def silent() -> Iterator[str]:
    yield from serving(None)


@pytest.fixture
def mailer() -> Iterator[str]:
    yield from serving(b"220 mail.example ESMTP\r\n")


@pytest.fixture
def nested() -> Iterator[str]:
    yield from serving(b"HTTP/1.0 200 OK\r\n\r\n" + b"[" * 100_000)


def children(pid: int) -> list[int]:
    """Processes that live and have this parent."""
    found = []
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                state, parent = (entry / "stat").read_text().rpartition(")")[2].split()[:2]
            except OSError:
                continue
            if int(parent) == pid and state != "Z":
                found.append(int(entry.name))
    return found


def wait_until_ended(pids: list[int]) -> None:
    """Of processes that are none of ours."""
    for pid in pids:
        try:
            handle = os.pidfd_open(pid)
        except ProcessLookupError:
            continue
        poll = select.poll()
        poll.register(handle, select.POLLIN)
        assert poll.poll(PATIENCE_S * 1000), f"process {pid} goes on"
        os.close(handle)


def test_an_address_that_is_none_is_refused() -> None:
    with StdioClient() as client:
        client.ask("initialize", adapterID="scanbench")
        for address in ("127.0.0.1:abc", "127.0.0.1:99999", "[abc", ""):
            assert "write http://HOST:PORT" in client.refused("attach", address=f"http://{address}"), address
        assert "write http://HOST:PORT" in client.refused("attach", address="ftp://127.0.0.1")
        assert "no Scanbench server" in client.refused("attach", address="http://me:secret@127.0.0.1")


def test_a_tool_that_leaves_while_it_is_refused_gets_both_answers() -> None:
    with StdioClient() as client:
        client.ask("initialize", adapterID="scanbench")
        attach = client.send("attach", address="http://127.0.0.1:abc")
        gone = client.send("disconnect")
        answer = client.response(attach)
        assert not answer["success"]
        assert "write http://HOST:PORT" in answer["message"] or answer["message"] == "cancelled"  # whichever was first
        assert client.response(gone)["success"]
        assert client.process.wait(PATIENCE_S) == 0


@slow
def test_a_service_that_is_no_server_of_ours_is_refused(mailer: str, nested: str, program: Path) -> None:
    with StdioClient() as client:
        client.ask("initialize", adapterID="scanbench")
        assert "no Scanbench server" in client.refused("attach", address=mailer)
        assert "no Scanbench server" in client.refused("attach", address=nested)
        assert "token" in client.refused("attach", token=5)
        seq = client.send("launch", program=str(program), stopOnEntry=True)  # it may still have one of its own
        client.event("initialized")
        client.ask("configurationDone")
        assert client.response(seq)["success"]


@slow
def test_attaching_can_be_cancelled_while_nobody_answers(silent: str) -> None:
    with StdioClient() as client:
        client.ask("initialize", adapterID="scanbench")
        seq = client.send("attach", address=silent)
        cancel = client.send("cancel", requestId=seq)
        assert client.response(seq)["message"] == "cancelled"
        assert client.response(cancel)["success"]
        seq = client.send("attach", address=silent)
        gone = client.send("disconnect")
        assert client.response(seq)["message"] == "cancelled"
        assert client.response(gone)["success"]
        assert client.process.wait(PATIENCE_S) == 0


@slow
def test_nonsense_between_messages_is_answered(program: Path) -> None:
    with StdioClient() as client:
        client.launch(program, stopOnEntry=True)
        client.event("stopped")
        for nonsense in (b"", b"{", b"[1]", b"\xff\xfe", b"[" * 200_000):
            client.put_bytes(b"Content-Length: %d\r\n\r\n%s" % (len(nonsense), nonsense))
            assert "no JSON object" in client.response(0)["message"]
        assert "no Unicode" in client.refused("evaluate", expression="\ud800", context="watch")
        assert r"'\ud800'" in client.refused("\ud800")
        assert "変数" in client.refused("evaluate", expression="変数", context="watch")
        deep: dict[str, object] = {}
        for _ in range(900):
            deep = {"a": deep}
        client.put({"seq": 500, "type": "request", "command": "threads", "arguments": deep})
        assert client.response(500)["command"] == "threads"
        assert client.stack()[0]["source"] == {"name": program.name, "path": str(program)}


def test_a_launch_comes_once_at_a_time_and_can_be_left(program: Path, tmp_path: Path) -> None:
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    with StdioClient(temporary=temporary) as client:
        client.ask("initialize", adapterID="scanbench")
        first = client.send("launch", program=str(program))
        assert "already" in client.refused("launch", program=str(program))
        gone = client.send("disconnect")
        assert client.response(first)["message"] == "cancelled"
        assert client.response(gone)["success"]
        assert client.process.wait(PATIENCE_S) == 0
    assert list(temporary.iterdir()) == []


def test_no_process_is_left_when_the_stream_ends_at_a_halt(program: Path) -> None:
    with StdioClient() as client:
        client.launch(program, lambda: None, stopOnEntry=True)
        client.event("stopped")
        pids = children(client.process.pid)
        assert len(pids) >= 2  # the PLC, and where it came from
        assert client.process.stdin is not None
        client.process.stdin.close()
        assert client.process.wait(PATIENCE_S) == 0
        wait_until_ended(pids)


@slow
def test_thousands_of_breakpoints(tmp_path: Path) -> None:
    count = 2_500
    file = tmp_path / "Long.st"
    file.write_text("PROGRAM Main\nVAR n : INT; END_VAR\n" + "n := n + 1;\n" * count + "END_PROGRAM\n")
    with StdioClient() as client:
        found: list[dict[str, object]] = []

        def breakpoints() -> None:
            lines = [{"line": 3 + each, "condition": "n > 2000"} for each in range(count)]
            answer = client.ask("setBreakpoints", source={"path": str(file)}, breakpoints=lines)
            found.extend(answer["breakpoints"])

        client.launch(file, breakpoints, pace=0)
        assert all(each["verified"] for each in found)
        assert len({each["id"] for each in found}) == count
        assert client.event("stopped")["hitBreakpointIds"] == [found[2001]["id"]]
        assert client.stack()[0]["line"] == 3 + 2001


@slow
def test_what_was_built_is_kept_for_the_user_alone(program: Path, tmp_path: Path) -> None:
    cache = tmp_path / "cache"
    place: dict[str, object] = {"source": {"path": str(program)}, "breakpoints": [{"line": CALL_A}]}
    kept = []
    for _ in range(2):
        with StdioClient(cache=cache) as client:

            def breakpoints(client: StdioClient = client) -> None:
                client.ask("setBreakpoints", **place)

            client.launch(program, breakpoints, pace=0)
            assert client.event("stopped")["reason"] == "breakpoint"
            assert client.stack()[0]["line"] == CALL_A
            client.ask("disconnect")
        kept.append(sorted(each.name for each in (cache / "scanbench").glob("*.kept")))
    assert kept[0]
    assert kept[0] == kept[1]
    assert (cache / "scanbench").stat().st_mode & 0o077 == 0
    os.chmod(cache / "scanbench", 0o777)  # somebody else may put code there
    (cache / "scanbench" / kept[0][0]).unlink()
    with StdioClient(cache=cache) as client:
        client.launch(program, stopOnEntry=True)
        assert client.event("stopped")["reason"] == "entry"
        assert client.stack()[0]["line"] == FIRST
    assert not (cache / "scanbench" / kept[0][0]).exists()
