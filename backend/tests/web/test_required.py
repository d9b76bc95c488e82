"""Required reactions on a server: their file, their mistakes, sweeps, single raises, the test record."""

from scanbench.client import connect
from tests.web.server import Server
from tests.web.test_simulator import MODEL, PROGRAM
from tests.web.test_sweeps import finished

REQUIRED = "battery-error:\n  Main.lamp within 2 scans\nbasic-io-error in Nowhere: Main.lamp\nnonfatal: Main.lmp\n"


def test_what_a_project_requires_is_checked_in_sweeps_and_raises(server: Server) -> None:
    instance = server.instance("required", MODEL, main=PROGRAM)
    project = server.http.get(f"/api/instances/{instance}").json()["project"]["id"]
    path = f"/api/projects/{project}/files/required.reactions"
    assert server.http.put(path, json={"text": REQUIRED, "version": 0}).status_code == 200
    other = f"/api/projects/{project}/files/other.reactions"
    assert server.http.put(other, json={"text": "", "version": 0}).status_code == 422

    checked = server.http.post(f"/api/projects/{project}/check", json={"files": {}}).json()
    (problem,) = checked["problems"]
    assert (problem["file"], problem["line"], problem["column"]) == ("required.reactions", 4, 11)
    assert (problem["code"], problem["severity"]) == ("R001", "warning")
    text = REQUIRED.partition("nonfatal")[0] + "basic-io-error: Main.lamp = FALSE\n"
    assert server.http.put(path, json={"text": text, "version": 1}).status_code == 200
    assert server.http.post(f"/api/projects/{project}/build", json={}).json()["ok"]

    with server.browser(instance) as browser:
        errors = ["battery-error", "basic-io-error"]
        new = {"states": [], "window": 20, "errors": errors}
        sweep = server.http.post(f"/api/instances/{instance}/sweeps", json=new).json()["id"]
        assert finished(browser, sweep)["status"] == "done"
        messages = [message for message in browser.messages if message["type"] == "sweep"]
    whole = server.http.get(f"/api/sweeps/{sweep}").json()
    cells = {each["error"]: each for each in whole["cells"]}
    assert (cells["battery-error"]["required"], cells["battery-error"]["unmet"]) == (1, 1)
    live = {each["error"]: each for message in messages for each in message["cells"]}
    assert live["battery-error"]["unmet"] == 1
    rows = {row["id"]: row for row in server.http.get(f"/api/instances/{instance}/errors").json()}
    assert [rows[each]["swept"]["unmet"] for each in errors] == [1, 1]
    cell = {"error": "battery-error", "state": whole["states"][0]}
    (result,) = server.http.post(f"/api/sweeps/{sweep}/reaction", json=cell).json()["required"]
    assert (result["outcome"], result["scan"], result["values"]) == (
        "failed", 2, [{"path": "Main.lamp", "value": "FALSE"}],
    )  # fmt: skip

    red = {"error": "basic-io-error", "state": whole["states"][0], "reason": "no"}
    assert cells["basic-io-error"]["verdict"] == "acted"
    refused = server.http.post(f"/api/sweeps/{sweep}/accept", json=red)
    assert "change the program or required.reactions" in refused.text
    plc = connect(server.address, user="Ann").plc(instance)
    plc.raise_error("battery-error")
    plc.run(scans=210)
    with server.browser(instance) as browser:
        browser.wait(lambda: _known(server, instance))
    told = plc.reaction("battery-error")["required"]
    assert isinstance(told, list)
    assert [each["outcome"] for each in told if isinstance(each, dict)] == ["failed"]
    record = server.http.get(f"/api/instances/{instance}/record?format=xml").text
    assert 'Text="Main.lamp within 2 scans"' in record
    (row,) = [
        row for row in server.http.get(f"/api/instances/{instance}/errors").json() if row["id"] == "battery-error"
    ]
    assert row["reaction"]["unmet"] == 1


def _known(server: Server, instance: int) -> bool:
    rows = server.http.get(f"/api/instances/{instance}/errors").json()
    return any(row["reaction"] and row["reaction"]["state"] == "done" for row in rows)
