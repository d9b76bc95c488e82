"""A process that is killed while its PLC is halted: the PLC is halted again, for everybody who comes back to it."""

import os
import signal

from tests.amounts import slow
from tests.web.dap.client import SocketClient
from tests.web.server import Server

MODEL = "CJ1M-CPU63"
COUNT = "PROGRAM Main\nVAR n, k : DINT; END_VAR\nn := n + 1;\nk := k + n;\nEND_PROGRAM\n"


@slow
def test_it_stays_halted_before_the_scan_until_somebody_continues(server: Server) -> None:
    instance = server.instance("killed while halted", MODEL, main=COUNT)
    with server.browser(instance) as browser, SocketClient(server, instance) as tool:
        tool.ask("configurationDone")
        scan = tool.halt("pause", threadId=1)["scanbench"]["scan"]
        tool.halt("next", threadId=1)
        browser.wait_state("halted")
        before = server.state(instance)
        os.kill(before["pid"], signal.SIGKILL)
        again = tool.event("stopped")
        assert (again["reason"], again["scanbench"]["by"], again["scanbench"]["count"]) == ("pause", "", 0)
        assert "when its process ended" in again["text"]
        state = server.state(instance)
        assert (state["state"], state["scan"] >= scan, state["pid"] != before["pid"]) == ("halted", True, True)
        assert browser.ask(type="run", action="continue")["ok"]
        browser.wait_state("running")
