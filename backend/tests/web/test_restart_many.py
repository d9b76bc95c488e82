"""Twelve PLCs that are driven in five ways, and three verifications: after a restart of the server they are as they were."""

import os
import signal
from collections.abc import Callable
from pathlib import Path

import pytest

from scanbench.client import Plc, connect
from tests.amounts import slow
from tests.web.dap.client import BrowserClient
from tests.web.server import PATIENCE_S, Server
from tests.web.test_restart import alive, until

SOURCE = "PROGRAM Main\nVAR n : DINT; twice : DINT; END_VAR\nn := n + 1;\ntwice := 2 * n;\nEND_PROGRAM\n"
LINE = 4


def pause(plc: Plc, _: Server) -> None:
    plc.pause()


def halt(plc: Plc, server: Server) -> None:
    """By a breakpoint of the page, which is there for everybody, also when nobody is at the PLC."""
    with server.browser(plc.id) as browser:
        BrowserClient(browser).ask("setBreakpoints", source={"path": "Main.st"}, breakpoints=[{"line": LINE}])
        until(lambda: plc.state["state"] == "halted")


def slow_down(plc: Plc, _: Server) -> None:
    plc.speed(0.25)


def speed_up(plc: Plc, _: Server) -> None:
    plc.speed(0)


def go_back(plc: Plc, _: Server) -> None:
    plc.travel(5)


DRIVEN: dict[str, Callable[[Plc, Server], None]] = {
    "paused": pause, "halted": halt, "slow": slow_down, "fast": speed_up, "past": go_back,
}  # fmt: skip
STAYS = ("paused", "halted", "past")


@slow
@pytest.mark.parametrize("kill", [signal.SIGTERM, signal.SIGKILL])
def test_twelve_plcs_and_three_verifications_come_back_as_they_were(tmp_path: Path, kill: signal.Signals) -> None:
    with Server(tmp_path) as server:
        made: list[tuple[str, Plc]] = []
        for number in range(12):
            way = list(DRIVEN)[number % len(DRIVEN)]
            made.append(
                (
                    way,
                    connect(server.address, user="Ann").plc(
                        server.instance(f"{way} {number}", "GENERIC-IEC", Main=SOURCE)
                    ),
                )
            )
        for way, plc in made:
            until(lambda: plc.state["scan"] > 20)  # noqa: B023 called at once
            DRIVEN[way](plc, server)
        verified = [(plc.id, plc.wait_for_verification(plc.begin_verification(first=0, last=4))) for _, plc in made[:3]]
        before = {plc.id: plc.state for _, plc in made}
        pids = [each["state"]["pid"] for each in server.http.get("/api/instances").json()]
        os.kill(server.process.pid, kill)
        server.process.wait(PATIENCE_S)
        until(lambda: not any(map(alive, pids)))

    with Server(tmp_path) as again:
        for way, old in made:
            plc, was = connect(again.address, user="Ann").plc(old.id), before[old.id]
            until(lambda: plc.state["state"] not in ("starting", "restarting"))  # noqa: B023
            now = plc.state
            assert (plc.id, now["state"], now["speed"]) == (plc.id, was["state"], was["speed"])
            if way in STAYS:
                assert (plc.id, now["scan"], now["past"]) == (plc.id, was["scan"], was["past"])
            else:
                assert now["scan"] >= was["scan"], plc.id
        for name, info in verified:
            plc = connect(again.address, user="Ann").plc(name)
            until(lambda: info in plc.verifications)  # noqa: B023
