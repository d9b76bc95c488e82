"""Faults with a shape on a PLC of its own process: it may die on the way, its program may change, a line may be waited for."""

import os
import signal

from tests.web.server import Browser, Message, Server

SOURCE = """PROGRAM Main
VAR n : DINT; battery AT A402.04 : BOOL; seen : DINT; go : BOOL; step : DINT; END_VAR
  n := n + 1;
  IF battery THEN
    seen := seen + 1;
  END_IF;
  IF go THEN
    step := step + 1;
  END_IF;
END_PROGRAM
"""
BATTERY = [{"id": "battery-error", "details": {}}]


def marks(server: Server, instance: int) -> list[tuple[int, str]]:
    """Those of the run, as somebody who comes gets them."""
    with server.browser(instance) as browser:
        known = [browser.hello["timeline"], *(m for m in browser.messages if m["type"] == "timeline")]
        return [
            (mark["scan"], mark["text"])
            for each in known
            for mark in each["marks"]
            if mark["kind"] in ("error", "recover")
        ]


def armed(browser: Browser) -> list[Message]:
    found = [message["faults"] for message in browser.messages if message["type"] == "armed"]
    return found[-1] if found else []


def test_a_plc_that_dies_goes_on_with_the_same_steps(server: Server) -> None:
    instance = server.instance("dying", "CJ1M-CPU63", main=SOURCE)
    with server.browser(instance) as browser:
        browser.watch("Main.seen")
        shape = {"kind": "intermittent", "scans": 5, "period": 20, "times": 12}
        assert browser.ask(type="arm", errors=BATTERY, shape=shape)["ok"]
        browser.wait(lambda: (browser.number("Main.seen") or 0) >= 12)
        browser.wait(lambda: bool(armed(browser)))
        os.kill(server.state(instance)["pid"], signal.SIGKILL)
        browser.wait(lambda: server.state(instance)["restarts"] == 1)
        browser.wait(lambda: (browser.number("Main.seen") or 0) >= 60)
        browser.wait(lambda: armed(browser) == [])
    found = marks(server, instance)
    begin = found[0][0]
    assert found[0][1].startswith("armed 1: battery-error, now, 5 scans of every 20, 12 times")
    steps = [(begin + 20 * k, "generated battery-error, code 00F7") for k in range(12)]
    steps += [(begin + 20 * k + 5, "recovered battery-error") for k in range(12)]
    assert found[1:] == sorted(steps)


def test_a_line_is_reached_also_after_an_edit_that_was_only_checked(server: Server) -> None:
    instance = server.instance("armed lines", "CJ1M-CPU63", main=SOURCE)
    with server.browser(instance) as browser:
        browser.watch("Main.n", "Main.step", "Main.seen")
        project = next(each for each in server.http.get("/api/projects").json() if each["name"] == "armed lines")["id"]
        edited = SOURCE.replace("  n := n", "\n\n  seen := seen;\n  n := n")
        reply = server.http.put(f"/api/projects/{project}/files/main.st", json={"text": edited, "version": 1})
        assert reply.status_code == 200, reply.text
        assert browser.ask(type="mode", mode="RUN")["ok"]
        assert not server.http.post(f"/api/projects/{project}/build", json={}).json()["ok"]  # checked, and never runs
        assert browser.ask(type="mode", mode="MONITOR")["ok"]
        start = {"kind": "line", "file": "main.st", "line": 9}
        refused = browser.ask(type="arm", errors=BATTERY, start=start)
        assert not refused["ok"]
        assert "no statement begins at main.st:9; the nearest is at main.st:8" in refused["message"]
        shape = {"kind": "for", "scans": 3}
        assert browser.ask(type="arm", errors=BATTERY, start={**start, "line": 8}, shape=shape)["ok"]
        count = browser.number("Main.n") or 0
        browser.wait(lambda: (browser.number("Main.n") or 0) > count + 30)
        assert browser.number("Main.seen") == 0
        assert browser.ask(type="write", path="Main.go", value="TRUE")["ok"]
        browser.wait(lambda: browser.number("Main.seen") == 3)
        browser.wait(lambda: armed(browser) == [])
    told = marks(server, instance)
    assert [text.split(",")[0] for _, text in told] == [
        "armed 1: battery-error",
        "generated battery-error",
        "recovered battery-error",
    ]
    assert told[2][0] == told[1][0] + 3


def test_the_past_shows_what_was_armed_and_a_branch_goes_on_with_it(server: Server) -> None:
    instance = server.instance("armed branches", "CJ1M-CPU63", main=SOURCE)
    with server.browser(instance) as browser:
        browser.watch("Main.seen")
        begin = browser.ask(type="run", action="pause")["scan"]
        start, shape = (
            {"kind": "scan", "scan": begin + 40},
            {"kind": "intermittent", "scans": 4, "period": 10, "times": 3},
        )
        assert browser.ask(type="arm", errors=BATTERY, start=start, shape=shape)["ok"]
        assert browser.ask(type="run", action="continue", speed=0, scans=100)["ok"]
        browser.wait(lambda: server.state(instance)["scan"] == begin + 100)
        browser.wait(lambda: armed(browser) == [])
        assert browser.ask(type="travel", scan=begin + 42)["ok"]
        browser.wait(lambda: browser.number("Main.seen") == 2)
        browser.wait(lambda: [fault["next_scan"] for fault in armed(browser)] == [begin + 44])
        assert "this is the past" in browser.ask(type="arm", errors=BATTERY)["message"]
        reply = server.http.post(f"/api/instances/{instance}/errors/preview", json={"errors": BATTERY}).json()
        assert not reply["ok"]
        assert "this is the past" in reply["message"]
        reply = server.http.post(f"/api/instances/{instance}/branch", json={"name": "armed twig", "scan": begin + 42})
        assert reply.status_code == 201, reply.text
        twig = reply.json()["id"]
    with server.browser(twig) as browser:
        browser.watch("Main.seen")
        assert browser.ask(type="run", action="continue", speed=0, scans=58)["ok"]
        browser.wait(lambda: server.state(twig)["scan"] == begin + 100)
        browser.wait(lambda: browser.number("Main.seen") == 12)
    assert marks(server, twig)[1:] == marks(server, instance)[1:]
