"""What if, by REST: on the run of a PLC that goes on."""

import httpx
import pytest

from tests.amounts import slow
from tests.web.server import Server
from tests.web.test_verify import MODEL, paused, scans

PROGRAM = """\
VAR_GLOBAL go AT CIO0.00 : BOOL; lamp AT CIO100.00 : BOOL; END_VAR
PROGRAM Main
VAR n : INT; END_VAR
  n := n + 1;
  lamp := go AND n > 5;
END_PROGRAM
"""


@slow
def test_the_smallest_change_is_asked_for(server: Server) -> None:
    instance = server.instance("what if", MODEL, main=PROGRAM)
    with server.browser(instance) as browser:
        paused(browser)
        scans(browser, 30)
        wanted = {
            "scan": 10,
            "search": True,
            "candidates": ["go", "Main.n"],
            "condition": "lamp",
            "window": 3,
            "watch": ["Main.n"],
        }
        reply = server.http.post(f"/api/instances/{instance}/what-if", json=wanted)
        assert reply.status_code == 200, reply.text
        found = reply.json()
        assert (found["recorded"]["met"], found["recorded"]["shown"]) == (None, ["13"])
        assert found["tries"][found["best"]]["values"] == [{"path": "go", "value": "TRUE"}]
        assert "force go=TRUE" in found["scenario"]
        many = {"scan": 1, "vary": "Main.n", "tried": ["0..199"], "window": 2400}
        for _ in range(4):  # who goes away takes no place: three may be asked at a time
            with pytest.raises(httpx.ReadTimeout):
                server.http.post(f"/api/instances/{instance}/what-if", json=many, timeout=0.2)
        browser.wait(lambda: server.http.post(f"/api/instances/{instance}/what-if", json=wanted).status_code == 200, 30)
        refused = server.http.post(f"/api/instances/{instance}/what-if", json={**wanted, "condition": "lmp"})
        assert (refused.status_code, "lamp" in refused.json()["near"]) == (422, True)
