"""Time of a virtual PLC through the whole house: targets, restarts, the past, branches, run files, online change."""

import json
import os
import signal
import subprocess
import sys
from base64 import b64decode, b64encode
from pathlib import Path

from scanbench.server.draft import Draft
from tests.amounts import slow
from tests.web.server import Browser, Message, Server

MODEL = "CJ1M-CPU63"
COUNT = """
PROGRAM Main
VAR
  n : DINT; level : INT; kept AT D100 : INT; work AT W10 : INT; start AT CIO 0.00 : BOOL; first AT A200.11 : BOOL;
  firsts : INT;
END_VAR
VAR RETAIN total : DINT; END_VAR
  n := n + 1;
  total := total + 1;
  IF first THEN firsts := firsts + 1; END_IF;
END_PROGRAM
"""


def still(browser: Browser) -> int:
    """Pauses the PLC; gives its next scan."""
    browser.messages.clear()
    done = browser.ask(type="run", action="pause")
    assert done["ok"], done
    return int(done["scan"])


def shown(browser: Browser, path: str, value: int) -> None:
    browser.wait(lambda: browser.number(path) == value)


def paused_with(browser: Browser, why: str) -> None:
    """Waits for this pause: a state that was told before it may come late."""
    browser.wait(lambda: any(
        each["type"] == "state" and each["state"]["state"] == "paused" and why in each["state"]["message"]
        for each in browser.messages
    ))  # fmt: skip


def test_a_run_stops_where_it_was_asked_to(server: Server) -> None:
    instance = server.instance("targets", MODEL, main=COUNT)
    with server.browser(instance) as browser:
        browser.watch("Main.n")
        scan = still(browser)
        assert browser.ask(type="run", action="continue", speed=0, scans=12_345)["ok"]
        shown(browser, "Main.n", scan + 12_345)
        paused_with(browser, "asked for")
        done = browser.ask(type="run", action="continue", until="Main.n >= 50000 AND NOT Main.start")
        assert done["ok"], done
        shown(browser, "Main.n", 50_000)
        paused_with(browser, "Main.n >= 50000")
        refused = browser.ask(type="run", action="continue", until="Main.m > 3")
        assert not refused["ok"]
        assert "no member `m`" in refused["message"]
        assert not browser.ask(type="run", action="continue", until="Main.n + 3")["ok"]
        assert browser.ask(type="run", action="scan")["ok"]
        shown(browser, "Main.n", 50_001)


def test_restarts_keep_what_they_should(server: Server) -> None:
    instance = server.instance("restarts", MODEL, main=COUNT)
    paths = ("Main.n", "Main.total", "Main.kept", "Main.work", "Main.firsts")
    with server.browser(instance) as browser:
        browser.watch(*paths)
        for path in ("Main.kept", "Main.work"):
            assert browser.ask(type="write", path=path, value="77")["ok"]
        browser.wait(lambda: (browser.number("Main.n") or 0) > 20 and browser.number("Main.kept") == 77)
        scan = still(browser)
        shown(browser, "Main.n", scan)
        for kind in ("warm", "power"):
            total = browser.number("Main.total") or 0
            assert browser.ask(type="restart", kind=kind)["ok"]
            shown(browser, "Main.n", 0)
            state = browser.ask(type="run", action="pause")
            assert state["scan"] == scan  # the run goes on counting
            assert [browser.number(path) for path in paths] == [0, total, 77, 0, 0], kind
            assert browser.ask(type="run", action="scan")["ok"]
            shown(browser, "Main.firsts", 1)  # the first cycle flag
            shown(browser, "Main.total", total + 1)
            scan += 1
        assert browser.ask(type="restart", kind="cold")["ok"]
        shown(browser, "Main.n", 0)
        assert [browser.number(path) for path in paths] == [0, 0, 0, 0, 0]
        assert browser.ask(type="new_run")["ok"]
        browser.wait(lambda: any(m["type"] == "timeline" and m["fresh"] for m in browser.messages))
        assert server.state(instance)["scan"] < 5  # it is paused, as it was


def test_everybody_sees_the_past_and_it_cannot_be_changed(server: Server) -> None:
    instance = server.instance("past", MODEL, main=COUNT)
    with server.browser(instance) as ada, server.browser(instance, "Grace Hopper") as grace:
        for browser in (ada, grace):
            browser.watch("Main.n", "Main.level")
        assert ada.ask(type="write", path="Main.level", value="5")["ok"]
        ada.wait(lambda: (ada.number("Main.n") or 0) > 100)
        scan = still(ada)
        assert ada.ask(type="force", path="Main.level", value="9")["ok"]
        assert grace.ask(type="travel", scan=40)["ok"]
        for browser in (ada, grace):
            shown(browser, "Main.n", 40)
            state = browser.wait_state("past")
            assert (state["scan"], state["past"]) == (40, {"live_scan": scan, "by": "Grace Hopper"})
        ada.wait(lambda: any(m["type"] == "forces" and not m["forces"] for m in ada.messages))  # none held then
        for wish in (
            {"type": "write", "path": "Main.level", "value": "1"},
            {"type": "mode", "mode": "RUN"},
            {"type": "run", "action": "continue"},
            {"type": "restart", "kind": "cold"},
        ):
            refused = ada.ask(**wish)
            assert not refused["ok"]
            assert "the past" in refused["message"]
        assert ada.ask(type="run", action="scan")["ok"]
        shown(ada, "Main.n", 41)
        assert "scan" in ada.ask(type="travel", scan=scan + 10)["message"]
        assert ada.ask(type="travel", scan=None)["ok"]
        shown(ada, "Main.n", scan)
        shown(grace, "Main.level", 9)
        assert ada.ask(type="run", action="continue")["ok"]
        grace.wait(lambda: (grace.number("Main.n") or 0) > scan)


def test_a_branch_begins_in_the_past_of_another(server: Server) -> None:
    instance = server.instance("trunk", MODEL, main=COUNT)
    with server.browser(instance) as browser:
        browser.watch("Main.n")
        browser.wait(lambda: (browser.number("Main.n") or 0) > 80)
        reply = server.http.post(f"/api/instances/{instance}/branch", json={"name": "twig", "scan": 50})
        assert reply.status_code == 201, reply.text
        late = server.http.post(f"/api/instances/{instance}/branch", json={"name": "later", "scan": 1 << 40})
        assert late.status_code == 422, late.text
        assert "has not come yet" in late.json()["message"]
        assert "later" not in [each["name"] for each in server.http.get("/api/instances").json()]
        clone = server.http.post(f"/api/instances/{instance}/branch", json={"name": "clone"})
        assert clone.status_code == 201, clone.text
    with server.browser(reply.json()["id"]) as browser:
        browser.watch("Main.n")
        shown(browser, "Main.n", 50)
        assert browser.ask(type="travel", scan=20)["ok"]  # its past is the same
        shown(browser, "Main.n", 20)
        assert browser.ask(type="travel", scan=None)["ok"]
        assert browser.ask(type="run", action="scan")["ok"]
        shown(browser, "Main.n", 51)


def test_a_run_goes_out_and_comes_in(server: Server) -> None:
    instance = server.instance("leaving", MODEL, main=COUNT)
    with server.browser(instance) as browser:
        browser.watch("Main.n")
        assert browser.ask(type="write", path="Main.level", value="33")["ok"]
        browser.wait(lambda: (browser.number("Main.n") or 0) > 30)
        scan = still(browser)
    data = server.http.get(f"/api/instances/{instance}/export")
    assert data.status_code == 200
    assert "leaving.scanrun" in data.headers["content-disposition"]
    reply = server.http.post("/api/instances/import", params={"name": "arriving"}, content=data.content)
    assert reply.status_code == 201, reply.text
    assert reply.json()["project"]["name"] == "arriving"
    assert reply.json()["damage"] == ""
    spoilt = data.content[:-12] + bytes([data.content[-12] ^ 1]) + data.content[-11:]
    damaged = server.http.post("/api/instances/import", params={"name": "spoilt"}, content=spoilt)
    assert damaged.status_code == 201, damaged.text
    assert "the file is damaged at byte" in damaged.json()["damage"]
    with server.browser(damaged.json()["id"]) as browser:
        told = [browser.hello["timeline"]]
        browser.wait(
            lambda: any(
                "is damaged at byte" in each["info"]["damage"]
                for each in (*told, *(m for m in browser.messages if m["type"] == "timeline"))
            )
        )
    with server.browser(reply.json()["id"]) as browser:
        browser.watch("Main.n", "Main.level")
        shown(browser, "Main.n", scan)
        shown(browser, "Main.level", 33)
        known = [browser.hello["timeline"], *(m for m in browser.messages if m["type"] == "timeline")]
        assert any("Main.level" in mark["text"] for each in known for mark in each["marks"])
    for broken in (b"", b"no run file", data.content[:40]):
        refused = server.http.post("/api/instances/import", params={"name": "broken"}, content=broken)
        assert refused.status_code == 422, refused.text
        assert refused.json()["message"]
    assert "broken" not in [each["name"] for each in server.http.get("/api/projects").json()]


def test_off_and_on_again_goes_on(server: Server) -> None:
    instance = server.instance("switched", MODEL, main=COUNT)
    with server.browser(instance) as browser:
        browser.watch("Main.n")
        browser.wait(lambda: (browser.number("Main.n") or 0) > 30)
        off = server.http.patch(f"/api/instances/{instance}", json={"power": False})
        assert off.json()["state"]["state"] == "off", off.text
        refused = browser.ask(type="write", path="Main.level", value="1")
        assert "Switch it on" in refused["message"]
        scan = server.state(instance)["scan"]
        changed = server.http.patch(
            f"/api/instances/{instance}",
            json={"power": True, "name": "switched on", "limits": {"memory_mib": 256, "cpu_percent": 50}},
        ).json()
        assert (changed["name"], changed["limits"]["memory_mib"]) == ("switched on", 256)
        browser.wait(lambda: (browser.number("Main.n") or 0) > scan + 10)

        def load() -> Message:
            found: Message = {each["id"]: each["load"] for each in server.http.get("/api/instances").json()}[instance]
            return found

        browser.wait(lambda: load()["memory_bytes"] > 1 << 20 and load()["run_bytes"] > 0)


def test_online_change_asks_before_it_forgets(server: Server) -> None:
    instance = server.instance("changing", MODEL, main=COUNT)
    project = next(each for each in server.http.get("/api/projects").json() if each["name"] == "changing")["id"]

    def save(text: str, version: int) -> None:
        saved = server.http.put(f"/api/projects/{project}/files/main.st", json={"text": text, "version": version})
        assert saved.status_code == 200, saved.text

    def build(**how: bool) -> Message:
        reply: Message = server.http.post(f"/api/projects/{project}/build", json=how).json()
        return reply

    with server.browser(instance) as browser:
        browser.watch("Main.n", "Main.level")
        assert browser.ask(type="write", path="Main.level", value="5")["ok"]
        browser.wait(lambda: (browser.number("Main.n") or 0) > 30)
        save(COUNT.replace("level : INT", "level : DINT"), 1)
        asked = build()
        assert (asked["ok"], asked["needs_agreement"]) == (False, True)
        change = asked["changes"][0]
        assert change["lost"][0]["path"] == "Main.level"
        assert "INT to DINT" in change["lost"][0]["reason"]
        assert server.state(instance)["program_version"] == 1
        changed_at = server.state(instance)["scan"]
        assert build(agreed=True)["ok"]
        browser.wait(lambda: browser.number("Main.level") == 0)
        assert (browser.number("Main.n") or 0) >= 30  # it went on
        assert server.state(instance)["program_version"] == 2

        browser.wait(lambda: (browser.number("Main.n") or 0) > changed_at + 60)
        assert browser.ask(type="travel", scan=changed_at - 5)["ok"]  # back across the change
        shown(browser, "Main.level", 5)
        assert server.state(instance)["program_version"] == 1
        assert browser.ask(type="travel", scan=None)["ok"]
        assert browser.ask(type="roll_back")["ok"]
        browser.wait(lambda: server.state(instance)["program_version"] == 1)
        assert browser.ask(type="mode", mode="RUN")["ok"]
        refused = build(agreed=True)
        assert not refused["ok"]
        assert "RUN" in str(refused["message"])


def test_killed_in_the_past_of_a_changed_run(server: Server) -> None:
    """Everything is in the run file: also what was done between two checkpoints."""
    instance = server.instance("killed at work", MODEL, main=COUNT)
    with server.browser(instance) as browser:
        browser.watch("Main.n", "Main.level")
        for value in range(1, 6):
            assert browser.ask(type="write", path="Main.level", value=str(value))["ok"]
        # so that scan 2 is past, however fast the writes were
        browser.wait(lambda: (browser.number("Main.n") or 0) > 3)
        scan = still(browser)
        assert browser.ask(type="travel", scan=2)["ok"]
        killed = server.state(instance)["pid"]
        os.kill(killed, signal.SIGKILL)
        browser.wait(lambda: server.state(instance)["pid"] not in (None, 0, killed))  # it was in the past before, too
        browser.wait(lambda: server.state(instance)["state"] == "past")
        assert server.state(instance)["scan"] == 2, "it shows what it showed"
        assert browser.ask(type="travel", scan=None)["ok"]
        state = browser.wait_state("paused")
        assert (state["scan"], state["past"]) == (scan, None)
        shown(browser, "Main.level", 5)


@slow
def test_a_million_scans_come_out_the_same_though_it_was_killed(server: Server, tmp_path: Path) -> None:
    """What three hosts ran, each killed before the next, another process replays to the same bytes."""
    instance = server.instance("a million", MODEL, main=COUNT)
    with server.browser(instance) as browser:
        browser.watch("Main.n", "Main.level")
        first = still(browser)
        for part in (1, 2):
            assert browser.ask(type="write", path="Main.level", value=str(part))["ok"]
            assert browser.ask(type="run", action="continue", speed=0)["ok"]
            browser.wait(lambda low=first + part * 200_000: (browser.number("Main.n") or 0) > low)  # type: ignore[misc]
            pid = server.state(instance)["pid"]
            os.kill(pid, signal.SIGKILL)
            browser.wait(lambda was=pid: server.state(instance)["pid"] not in (None, was))  # type: ignore[misc]
            assert browser.ask(type="run", action="pause")["ok"]
        done = browser.ask(type="run", action="pause")
        assert done["scan"] >= first + 400_000
        if done["scan"] < 1_000_000:
            assert browser.ask(type="run", action="continue", scans=1_000_000 - done["scan"])["ok"]
            shown(browser, "Main.n", 1_000_000)
    file = tmp_path / "million.scanrun"
    file.write_bytes(server.http.get(f"/api/instances/{instance}/export").content)
    command = [str(Path(sys.executable).parent / "scanbench"), "replay", str(file), "--json"]
    replayed = [subprocess.run(command, capture_output=True, text=True, check=True) for _ in range(2)]
    found = [json.loads(each.stdout) for each in replayed]
    assert found[0] == found[1]
    assert found[0]["scan"] >= 1_000_000
    assert found[0]["checkpoints"] > 1


def test_two_people_begin_a_new_run_and_one_switches_off(server: Server) -> None:
    """Whatever order they come in, there is one process or none, as the last one wanted."""
    instance = server.instance("contested", MODEL, main=COUNT)
    with server.browser(instance) as ada, server.browser(instance, "Grace Hopper") as grace:
        ada.watch("Main.n")
        ada.wait(lambda: (ada.number("Main.n") or 0) > 5)
        for browser in (ada, grace):
            browser.socket.send(json.dumps({"type": "new_run", "ref": 77}))
        for browser in (ada, grace):
            assert browser.wait_for("done", ref=77)["ok"]
        ada.wait(lambda: server.state(instance)["state"] == "running")
        scan = ada.ask(type="run", action="pause")["scan"]
        assert server.state(instance)["pid"] is not None
        assert ada.ask(type="run", action="pause")["scan"] == scan  # nobody else runs it
        grace.socket.send(json.dumps({"type": "new_run", "ref": 78}))
        off = server.http.patch(f"/api/instances/{instance}", json={"power": False})
        assert off.status_code == 200, off.text
        grace.wait_for("done", ref=78)
        ada.wait(lambda: server.state(instance)["state"] == "off")
        assert server.state(instance)["pid"] is None


def test_a_branch_has_the_errors_of_its_past(server: Server) -> None:
    instance = server.instance("faulty", MODEL, main=COUNT)
    with server.browser(instance) as browser:
        assert browser.ask(type="generate", errors=[{"id": "battery-error"}])["ok"]
        scan = browser.ask(type="run", action="pause")["scan"]
    branch = server.http.post(f"/api/instances/{instance}/branch", json={"name": "heir", "scan": scan}).json()["id"]

    def row() -> Message:
        rows = server.http.get(f"/api/instances/{branch}/errors").json()
        found: Message = next(each for each in rows if each["id"] == "battery-error")
        return found

    with server.browser(branch) as browser:
        browser.wait(lambda: bool(row()["status"] == "generated"))
        assert (row()["by"], row()["origin"]) == ("Ada Lovelace", "simulator")
        assert browser.ask(type="recover", ids=None)["ok"]
        browser.wait(lambda: bool(row()["status"] == "cleared"))


def test_a_target_outlives_the_process(server: Server) -> None:
    instance = server.instance("targeted", MODEL, main=COUNT)
    with server.browser(instance) as browser:
        browser.watch("Main.n")
        scan = still(browser)
        assert browser.ask(type="run", action="continue", scans=120)["ok"]
        browser.wait(lambda: (browser.number("Main.n") or 0) > scan + 5)
        pid = server.state(instance)["pid"]
        os.kill(pid, signal.SIGKILL)
        browser.messages.clear()
        state = browser.wait_state("paused")
        assert state["scan"] == scan + 120


def test_numbers_without_meaning_are_refused(server: Server) -> None:
    instance = server.instance("numbers", MODEL, main=COUNT)
    with server.browser(instance) as browser:
        for scan in (10**30, -1, 1 << 63):
            refused = browser.ask(type="travel", scan=scan)
            assert not refused["ok"]
            reply = server.http.post(f"/api/instances/{instance}/branch", json={"name": "nowhere", "scan": scan})
            assert reply.status_code == 422
        assert browser.ask(type="run", action="pause")["ok"]
    assert "nowhere" not in [each["name"] for each in server.http.get("/api/instances").json()]


def test_the_past_has_the_errors_of_then(server: Server) -> None:
    instance = server.instance("erring", MODEL, main=COUNT)

    def status() -> str:
        rows = server.http.get(f"/api/instances/{instance}/errors").json()
        return str(next(each["status"] for each in rows if each["id"] == "battery-error"))

    with server.browser(instance) as browser:
        raised = browser.ask(type="generate", errors=[{"id": "battery-error"}])["scan"]
        browser.wait(lambda: server.state(instance)["scan"] > raised + 10)
        assert browser.ask(type="recover", ids=None)["ok"]
        assert browser.ask(type="run", action="pause")["ok"]
        assert status() == "cleared"
        assert browser.ask(type="travel", scan=raised + 5)["ok"]
        browser.wait(lambda: status() == "generated")
        assert browser.ask(type="travel", scan=None)["ok"]
        browser.wait(lambda: status() == "cleared")


def test_a_build_says_what_nobody_saved(server: Server) -> None:
    instance = server.instance("unsaved", MODEL, main=COUNT)
    project = next(each for each in server.http.get("/api/projects").json() if each["name"] == "unsaved")["id"]
    with server.browser(instance) as ada:
        assert ada.ask(type="open_draft", path="main.st")["ok"]
        opened = ada.wait_for("draft", path="main.st")
        draft = Draft(opened["draft"], [b64decode(opened["update"])])
        update = b64encode(draft.become(f"{COUNT}// more\n")).decode()
        assert ada.ask(type="edit_draft", path="main.st", draft=draft.key, update=update)["ok"]
    built = server.http.post(f"/api/projects/{project}/build").json()
    assert built["ok"]
    assert built["message"].endswith("; not built, as nobody saved it: what was edited in main.st")
    server.http.put(f"/api/projects/{project}/files/main.st", json={"text": f"{COUNT}// more\n", "version": 1})
    assert "not built" not in server.http.post(f"/api/projects/{project}/build").json()["message"]


def test_a_build_of_what_runs_changes_nothing(server: Server) -> None:
    instance = server.instance("unchanged", MODEL, main=COUNT)
    other = server.instance("bystanding", MODEL, main=COUNT)
    assert other
    project = next(each for each in server.http.get("/api/projects").json() if each["name"] == "unchanged")["id"]
    with server.browser(instance) as browser:
        browser.wait(lambda: server.state(instance)["state"] == "running")
        same = server.http.post(f"/api/projects/{project}/build").json()
        assert same["ok"]
        assert "nothing to build" in same["message"]
        assert same["project"]["version"] == 1
        assert server.state(instance)["previous_version"] is None
        clone = server.http.post(f"/api/instances/{instance}/branch", json={"name": "left alone"}).json()["id"]
        text = COUNT.replace("n := n + 1", "n := n + 2")
        server.http.put(f"/api/projects/{project}/files/main.st", json={"text": text, "version": 1})
        built = server.http.post(f"/api/projects/{project}/build", json={"instances": [instance]}).json()
        assert built["ok"], built
        browser.wait(lambda: server.state(instance)["program_version"] == 2)
        assert server.state(clone)["program_version"] == 1
        browser.wait(lambda: server.state(instance)["previous_version"] == 1)
