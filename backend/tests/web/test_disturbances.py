"""Disturbances of a live PLC: journaled, found by verification, and replayed elsewhere byte for byte."""

import json
from pathlib import Path

from tests.cli.calling import scanbench
from tests.web.server import Message, Server
from tests.web.test_verify import MODEL, begin, disturb, ended, paused, rows, scans

PROGRAM = """\
PROGRAM Main
VAR
  n : DINT; start AT CIO 0.00 : BOOL; motor AT CIO 100.00 : BOOL; doubled : DINT; seen : INT;
END_VAR
  n := n + 1;
  doubled := n * 2;
  motor := start;
  IF start THEN seen := seen + 1; END_IF;
END_PROGRAM
"""


def test_every_kind_is_found_and_replayed(server: Server, tmp_path: Path) -> None:
    instance = server.instance("disturbed", MODEL, main=PROGRAM)
    path = f"/api/instances/{instance}/disturbances"
    with server.browser(instance) as browser:
        scan = paused(browser)
        disturb(server, instance, kind="result", site="main.st:6", bit=4, scan=scan + 2)
        disturb(server, instance, kind="stuck", path="CIO0.00", scan=scan + 4, scans=3)
        disturb(server, instance, kind="flip", path="Main.seen", bit=0, scan=scan + 9)
        scans(browser, 5)
        written = browser.ask(type="write", path="Main.start", value="TRUE")  # while the input is stuck
        assert written["ok"], written
        scans(browser, 1)
        standing = server.http.get(path).json()
        assert [each["state"] for each in standing if each["kind"] == "stuck"] == ["active"]
        assert any(message["type"] == "disturbances" for message in browser.messages)
        scans(browser, 6)
        assert server.http.get(path).json() == []
        begun = begin(server, instance, first=scan)
        status = ended(browser, server, instance, begun["id"])
        assert status["compared"] == 12
        found: dict[int, Message] = {
            row["scan"] - scan: row for row in rows(server, begun["id"], differing=True)["rows"]
        }
        first = found[2]["differences"][0]
        assert (first["cause"], first["name"]) == ("logic", "Main.doubled")
        assert found[2]["differences"][0]["place"]["line"] == 6
        assert any(each["cause"] == "input" and "start" in each["name"].lower() for each in found[5]["differences"])
        assert [(each["cause"], each["name"]) for each in found[9]["differences"]] == [("input", "Main.seen")]
        assert all(row["disturbances"] for row in found.values())
        refused = server.http.post(path, json={"kind": "flip", "path": "Main.nn"})
        assert refused.status_code == 422, refused.text
        assert "Main.n" in refused.json()["near"]
    file = tmp_path / "disturbed.scanrun"
    file.write_bytes(server.http.get(f"/api/instances/{instance}/export").content)
    for engine in ("native", "reference"):
        replayed = scanbench("replay", str(file), "--json", "--engine", engine)
        assert replayed.returncode == 0, replayed.stderr
        assert json.loads(replayed.stdout)["scan"] == scan + 12
    verified = scanbench("verify", str(file), "--json")
    assert verified.returncode == 1, verified.stderr


def test_a_probability_and_taking_it_back(server: Server) -> None:
    instance = server.instance("by chance", MODEL, main=PROGRAM)
    path = f"/api/instances/{instance}/disturbances"
    with server.browser(instance) as browser:
        paused(browser)
        disturb(server, instance, kind="flip", path="Main.seen", probability=0.5, seed=7)
        disturb(server, instance, kind="result", site="main.st:6", probability=0.25, seed=7)
        assert browser.ask(type="run", action="continue", speed=0, scans=200)["ok"]
        browser.wait(lambda: server.state(instance)["state"] == "paused")
        fired = [each["fired"] for each in server.http.get(path).json()]
        assert 60 < fired[0] < 140
        assert 20 < fired[1] < 80
        one = server.http.get(path).json()[0]["id"]
        assert server.http.delete(f"{path}/{one}").json()["ok"]
        assert [each["kind"] for each in server.http.get(path).json()] == ["result"]
        assert server.http.delete(path).json()["ok"]
        assert server.http.get(path).json() == []
