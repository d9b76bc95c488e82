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
    assert [rows[each]["swept"]["unmet"] for each in errors] == [1, 2]
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
    assert [each["outcome"] for each in told] == ["failed"]
    record = server.http.get(f"/api/instances/{instance}/record?format=xml").text
    assert 'Text="Main.lamp within 2 scans"' in record
    (row,) = [
        row for row in server.http.get(f"/api/instances/{instance}/errors").json() if row["id"] == "battery-error"
    ]
    assert row["reaction"]["unmet"] == 1


UNTRIED = (
    "special-io-unit-error:unit=3: Main.lamp\nbattery-error in Idel: at least acted\nbattery-error in Idle: Main.lamp\n"
    "batery-error: Main.lamp\n"
)


def test_what_could_not_be_tried_is_a_finding_everywhere(server: Server) -> None:
    """Not fitted, a state that there is not, an error that the model does not know: in the sweep, its summary and the record."""
    instance = server.instance("untried", MODEL, main=PROGRAM)
    project = server.http.get(f"/api/instances/{instance}").json()["project"]["id"]
    for name, text in {"required.reactions": UNTRIED, "hardware.json": '{"version": 1, "fitted": []}'}.items():
        saved = server.http.put(f"/api/projects/{project}/files/{name}", json={"text": text, "version": 0})
        assert saved.status_code == 200, saved.text
    assert server.http.post(f"/api/projects/{project}/build", json={}).json()["ok"]
    server.http.post(f"/api/instances/{instance}/states", json={"name": "Idle"})
    with server.browser(instance) as browser:
        new = {"states": [], "window": 5, "errors": ["battery-error", "special-io-unit-error"]}
        sweep = server.http.post(f"/api/instances/{instance}/sweeps", json=new).json()["id"]
        over = finished(browser, sweep)
    whole = server.http.get(f"/api/sweeps/{sweep}").json()
    cells = {each["error"]: each for each in whole["cells"]}
    unit = cells["special-io-unit-error:unit=3"]
    assert (unit["verdict"], unit["required"], unit["unmet"]) == (None, 1, 1)
    (untried,) = unit["untried"]
    assert (untried["text"], untried["reason"], untried["note"]) == ("Main.lamp", "not_raised", unit["note"])
    cell = {"error": "battery-error", "state": "Now"}
    wrong, other = server.http.post(f"/api/sweeps/{sweep}/reaction", json=cell).json()["required"]
    assert (wrong["reason"], wrong["note"]) == ("no_state", "there is no state `Idel`. Did you mean `Idle`?")
    assert other["reason"] == "other_state"
    assert (cells["battery-error"]["required"], cells["battery-error"]["unmet"]) == (2, 1)
    assert over["unmet"] == whole["unmet"] == 2
    assert [each["line"] for each in whole["problems"]] == [4]
    assert "Did you mean `battery-error`" in whole["problems"][0]["message"]

    record = server.http.get(f"/api/instances/{instance}/record").json()
    assert {each["id"]: each["unmet"] for each in record["errors"] if each["unmet"]} == {
        "battery-error": 1, "special-io-unit-error:unit=3": 1,
    }  # fmt: skip
    assert [each["line"] for each in record["sweeps"][0]["problems"]] == [4]
    page = server.http.get(f"/api/instances/{instance}/record?format=html").text
    findings = page.partition("<h2>Findings</h2>")[2].partition("<h2>")[0]
    assert findings.count("not tried") == 2
    assert "Main.lamp: " in findings
    xml = server.http.get(f"/api/instances/{instance}/record?format=xml").text
    assert 'Reason="not_raised"' in xml
    brought = server.http.post(f"/api/projects/{project}/records", content=xml.encode())
    assert brought.status_code == 201, brought.text


def _known(server: Server, instance: int) -> bool:
    rows = server.http.get(f"/api/instances/{instance}/errors").json()
    return any(row["reaction"] and row["reaction"]["state"] == "done" for row in rows)
