"""A server that ends or is killed: PLCs in all states, and verifications, come back as they were.

The same in small, for each make test: `tests/host/test_driven.py`, `tests/web/test_restart.py`.
"""

import os
import signal
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.amounts import slow
from tests.web.dap.client import SocketClient
from tests.web.server import PATIENCE_S, Message, Server
from tests.web.test_restart import alive, until

MODEL = "CJ1M-CPU63"
SOURCE = """\
FUNCTION_BLOCK Part
VAR n : DINT; END_VAR
  n := n + 1;
  n := n + 1;
END_FUNCTION_BLOCK
PROGRAM Main
VAR n, zero : DINT; part : Part; END_VAR
  n := n + 1;
  part();
  n := n / (1 - zero);
END_PROGRAM
"""
LASTING = ("state", "mode", "speed", "past", "target", "forces", "program_version")
"""What a PLC that runs has again, though its scans went on."""
STILL = (*LASTING, "scan", "trap")


class Plc:
    """One of them, and how it is brought into its state."""

    def __init__(self, server: Server, name: str, make: "Callable[[Plc], None]", still: bool) -> None:
        self.server, self.still = server, still
        self.id = server.instance(name, MODEL, main=SOURCE)
        until(lambda: self.state["state"] == "running")
        make(self)

    @property
    def state(self) -> Message:
        return self.server.state(self.id)

    def post(self, route: str, **body: object) -> Any:
        reply = self.server.http.post(f"/api/instances/{self.id}/{route}", json=body)
        assert reply.status_code in (200, 201), reply.text
        return reply.json()

    def run(self, action: str, **more: object) -> int:
        return int(self.post("run", action=action, **more)["scan"])

    def looks(self) -> dict[str, object]:
        state = self.state
        found = {name: state[name] for name in (STILL if self.still else LASTING)}
        halt = state["halt"]
        found["halt"] = halt and {
            name: value for name, value in halt.items() if name not in ("number", "text", "reason", "by")
        }
        return found


def paused(plc: Plc) -> None:
    plc.run("pause")


def paused_by_hand(plc: Plc) -> None:
    plc.run("pause", speed=0)
    for _ in range(3):
        plc.run("scan")


def slow_one(plc: Plc) -> None:
    plc.run("speed", speed=0.1)


def slow_paused(plc: Plc) -> None:
    plc.run("pause", speed=0.25)


def fast(plc: Plc) -> None:
    plc.run("speed", speed=0)


def tenfold(plc: Plc) -> None:
    plc.run("speed", speed=10)


def with_target(plc: Plc) -> None:
    plc.run("pause", speed=0.01)
    plc.run("continue", scans=10_000)


def halted(plc: Plc) -> None:
    """Inside of a block that is called."""
    with SocketClient(plc.server, plc.id) as tool:
        tool.ask("configurationDone")
        tool.halt("pause", threadId=1)
        for _ in range(3):
            tool.halt("stepIn", threadId=1)
        with plc.server.browser(plc.id) as browser:  # so that nobody lets it go on as the tool leaves
            browser.wait(lambda: plc.state["state"] == "halted")
            tool.ask("disconnect", terminateDebuggee=False, suspendDebuggee=True)


def past(plc: Plc) -> None:
    scan = paused_scan(plc)
    plc.post("travel", scan=scan - 3)


def past_of_one_that_runs(plc: Plc) -> None:
    until(lambda: plc.state["scan"] > 20)
    plc.post("travel", scan=12)


def trapped(plc: Plc) -> None:
    plc.post("write", path="Main.zero", value="1")
    until(lambda: plc.state["state"] == "trapped")


def stopped(plc: Plc) -> None:
    plc.post("mode", mode="PROGRAM")


def forced(plc: Plc) -> None:
    plc.post("force", path="D10", value="7")
    plc.run("pause")


def paused_scan(plc: Plc) -> int:
    until(lambda: plc.state["scan"] > 20)
    return plc.run("pause")


KINDS: tuple[tuple[Callable[[Plc], None], bool], ...] = (
    (paused_by_hand, True), (halted, True), (past, True), (fast, False),
    (slow_one, False), (past_of_one_that_runs, True), (trapped, True), (paused, True), (slow_paused, True), (tenfold, False),
    (with_target, False), (stopped, False), (forced, True),
)  # fmt: skip


def verified(plc: Plc, running: Plc) -> list[str]:
    """Three verifications: where to ask what came of them."""
    wanted = ((plc, {"first": 0}), (plc, {"pace": "scan"}), (running, {"first": 0, "last": 30}))
    ids = [each.post("verifications", **body)["id"] for each, body in wanted]
    paths = [path for id in ids for path in (f"/api/verifications/{id}", f"/api/verifications/{id}/rows")]
    until(lambda: [plc.server.http.get(path).json()["state"] for path in paths[::2]] == ["done", "waiting", "done"])
    return paths


@slow
@pytest.mark.parametrize("kill", [signal.SIGTERM, signal.SIGKILL])
def test_all_come_back_as_they_were(tmp_path: Path, kill: signal.Signals) -> None:
    with Server(tmp_path) as server:
        plcs = [Plc(server, make.__name__.replace("_", " "), make, still) for make, still in KINDS]
        paths = verified(plcs[0], plcs[3])
        results = [server.http.get(path).json() for path in paths]
        looks = [plc.looks() for plc in plcs]
        end(server, kill)
    for _ in range(2):
        with Server(tmp_path) as again:
            for plc, before in zip(plcs, looks, strict=True):
                plc.server = again
                until(lambda plc=plc, before=before: plc.looks() == before, 30)  # type: ignore[misc]
            until(lambda: [again.http.get(path).json() for path in paths] == results, 30)
            end(again, kill)


def end(server: Server, kill: signal.Signals) -> None:
    """The server, and with it its PLCs."""
    pids = [each["state"]["pid"] for each in server.http.get("/api/instances").json()]
    os.kill(server.process.pid, kill)
    server.process.wait(PATIENCE_S)
    until(lambda: not any(map(alive, pids)))
