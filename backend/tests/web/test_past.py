"""Questions about the past through the whole house."""

from pathlib import Path

from tests.cli.calling import scanbench
from tests.web.server import Message, Server
from tests.web.test_verify import MODEL, paused, scans

PROGRAM = """\
PROGRAM Main
VAR
  n : DINT; level : INT; seen : INT; lamp : BOOL; basic AT A402.12 : BOOL; setup AT A402.10 : BOOL; errors : INT;
END_VAR
  n := n + 1;
  IF n = 3 THEN seen := 7; END_IF;
  IF basic THEN errors := errors + 1; lamp := TRUE; END_IF;
END_PROGRAM
"""


def test_who_wrote_it_and_what_changed(server: Server) -> None:
    instance = server.instance("asked", MODEL, main=PROGRAM)
    path = f"/api/instances/{instance}"
    with server.browser(instance) as browser:
        paused(browser)
        browser.ask(type="new_run")
        browser.wait(lambda: server.state(instance)["scan"] == 0 and server.state(instance)["state"] == "paused")
        scans(browser, 6)
        assert browser.ask(type="write", path="Main.level", value="5")["ok"]
        scans(browser, 2)
        found = server.http.get(f"{path}/last-write", params={"path": "Main.seen"})
        assert found.status_code == 200, found.text
        writer: Message = found.json()
        assert (writer["by"], writer["scan"], writer["shown"]) == ("program", 2, "7")
        assert (writer["place"]["file"], writer["place"]["line"]) == ("main.st", 6)
        writer = server.http.get(f"{path}/last-write", params={"path": "Main.level"}).json()
        assert (writer["by"], writer["scan"], writer["author"]) == ("command", 6, "Ada Lovelace")
        writer = server.http.get(f"{path}/last-write", params={"path": "Main.lamp"}).json()
        assert writer["by"] == "start"
        refused = server.http.get(f"{path}/last-write", params={"path": "Main.levle"})
        assert refused.status_code == 422
        assert "Main.level" in refused.json()["near"]

        changes = server.http.get(f"{path}/changes", params={"first": 1, "last": 8}).json()
        told = {each["path"]: (each["before_shown"], each["after_shown"]) for each in changes["changes"]}
        assert told == {"Main.n": ("1", "8"), "Main.level": ("0", "5"), "Main.seen": ("0", "7")}
        assert [(each["scan"], each["author"]) for each in changes["entries"]] == [(6, "Ada Lovelace")]
        assert server.http.get(f"{path}/changes", params={"first": 1, "last": 800}).status_code == 422


def test_the_text_of_a_version_is_what_ran(server: Server) -> None:
    instance = server.instance("told", MODEL, main=PROGRAM)
    project = server.http.get(f"/api/instances/{instance}").json()["project"]["id"]
    newer = PROGRAM.replace("level : INT;", "level : INT; extra : INT;")
    file = server.http.get(f"/api/projects/{project}/files/main.st").json()
    saved = {"text": newer, "version": file["version"]}
    assert server.http.put(f"/api/projects/{project}/files/main.st", json=saved).status_code == 200
    with server.browser(instance) as browser:
        paused(browser)
        built = server.http.post(f"/api/projects/{project}/build", json={"agreed": True}).json()
        assert built["ok"], built
        version = built["project"]["version"]
        path = f"/api/instances/{instance}/program"
        told = [server.http.get(path, params={"version": each}).json() for each in (version - 1, version)]
        assert [each["files"]["main.st"] for each in told] == [PROGRAM, newer]
        assert [each["pous"][0]["name"] for each in told] == ["Main", "Main"]
        assert server.http.get(path, params={"version": version + 1}).status_code == 404


def test_a_replay_with_another_error_is_compared(server: Server) -> None:
    instance = server.instance("what if", MODEL, main=PROGRAM)
    path = f"/api/instances/{instance}"
    with server.browser(instance) as browser:
        scan = paused(browser)
        scans(browser, 3)
        raised = server.http.post(f"{path}/errors/generate", json={"errors": [{"id": "basic-io-error"}]}).json()
        assert raised["ok"], raised
        scans(browser, 5)
        wanted = {"name": "one later", "scan": raised["scan"], "error": "basic-io-error", "by": 1}
        begun = server.http.post(f"{path}/reruns", json=wanted)
        assert begun.status_code == 201, begun.text
        browser.wait(
            lambda: any(m["type"] == "rerun" and (m["instance"] or m["message"]) for m in browser.messages), 30
        )
        told = next(m for m in browser.messages if m["type"] == "rerun" and (m["instance"] or m["message"]))
        assert told["instance"], told
        server.made.append(told["instance"])
        begun = server.http.post(f"{path}/comparisons", json={"other": told["instance"]})
        assert begun.status_code == 201, begun.text

        def over() -> bool:
            first: Message = server.http.get(f"{path}/comparisons").json()[0]
            return bool(first["result"] or first["message"])

        browser.wait(over)
        result = server.http.get(f"{path}/comparisons").json()[0]["result"]
        assert (result["scan"], result["cause"]) == (scan + 3, "command")
        assert any(each["path"] == "Main.errors" for each in result["changes"]["changes"])
        refused = server.http.post(f"{path}/reruns", json={**wanted, "error": "no-such-error"})
        assert refused.status_code in (201, 422)
        assert server.http.post(f"{path}/comparisons", json={"other": instance}).status_code == 422


def test_what_people_did_becomes_a_test(server: Server, tmp_path: Path) -> None:
    source = (
        "VAR_GLOBAL start AT CIO 0.00 : BOOL; motor AT CIO 100.00 : BOOL; END_VAR\n"
        "PROGRAM Main\nVAR n : INT; END_VAR\n  n := n + 1; motor := start;\nEND_PROGRAM\n"
    )
    instance = server.instance("scenario", "CJ1M-CPU63", main=source)
    path = f"/api/instances/{instance}"
    server.http.post(f"{path}/write", json={"path": "start", "value": "TRUE"}).raise_for_status()
    server.http.post(f"{path}/errors/generate", json={"errors": [{"id": "battery-error"}]}).raise_for_status()
    scan = server.http.post(f"{path}/run", json={"action": "pause"}).raise_for_status().json()["scan"] + 1
    server.http.post(f"{path}/run", json={"action": "scan"}).raise_for_status()
    text = server.http.get(f"{path}/scenario?scan={scan}").raise_for_status().text
    assert "do: write start=TRUE}" in text
    assert "do: raise battery-error}" in text
    assert f"- {{after: {scan}, holds: motor = TRUE}}" in text
    (tmp_path / "main.st").write_text(source)
    (tmp_path / "project.json").write_text('{"model": "CJ1M-CPU63"}')
    file = tmp_path / "it.scenario.yaml"
    file.write_text(text)
    said = scanbench("scenario", "run", str(file))
    assert said.stdout == f"{file}: as expected\n", said.stderr
    later = server.http.get(f"{path}/scenario?scan={scan + 1000}")
    assert later.status_code == 422
