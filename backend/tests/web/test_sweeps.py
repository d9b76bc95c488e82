"""Sweeps on a server: states, progress, findings, cancel and resume, comparison, an opened cell."""

from tests.amounts import slow
from tests.web.server import Browser, Message, Server
from tests.web.test_simulator import MODEL, PROGRAM

CORRECTED = PROGRAM.replace("    ;\n", "    lamp := TRUE;\n")


def finished(browser: Browser, sweep: int) -> Message:
    """The end of a sweep, as everybody is told: waited for as long as it goes on."""
    told: list[Message] = []
    known = 0

    def goes_on() -> bool:
        every = [message["sweep"] for message in browser.messages if message["type"] == "sweep"]
        told[:] = [each for each in every if each["id"] == sweep]
        return len(told) > known or any(each["status"] != "running" for each in told)

    while not told or told[-1]["status"] == "running":
        browser.wait(goes_on)
        known = len(told)
    return told[-1]


def verdicts(server: Server, sweep: int, state: str) -> dict[str, str | None]:
    whole = server.http.get(f"/api/sweeps/{sweep}").json()
    return {cell["error"]: cell["verdict"] for cell in whole["cells"] if cell["state"] == state}


@slow
def test_a_sweep_from_two_states_names_what_is_forgotten(server: Server) -> None:
    instance = server.instance("swept", MODEL, main=PROGRAM)
    project = server.http.get(f"/api/instances/{instance}").json()["project"]["id"]
    with server.browser(instance) as browser, server.browser(instance, "Bob Noyce") as bob:
        browser.watch("Main.ready")
        kept = server.http.post(f"/api/instances/{instance}/states", json={"name": "Idle"})
        assert kept.status_code == 201, kept.text
        assert browser.ask(type="write", path="Main.ready", value="TRUE")["ok"]
        kept_too = server.http.post(f"/api/instances/{instance}/states", json={"name": "Ready"})
        assert server.http.post(f"/api/instances/{instance}/states", json={"name": "Idle"}).status_code == 409
        states = [kept.json()["id"], kept_too.json()["id"]]
        assert [each["name"] for each in server.http.get(f"/api/projects/{project}/states").json()] == ["Idle", "Ready"]

        begun = server.http.post(f"/api/instances/{instance}/sweeps", json={"states": states, "window": 50})
        assert begun.status_code == 201, begun.text
        sweep = begun.json()["id"]
        end = finished(bob, sweep)
        assert (end["status"], end["done"]) == ("done", end["total"]), end
        assert end["total"] == 2 * server.http.get(f"/api/models/{MODEL}").json()["error_count"]
        for state in ("Idle", "Ready"):
            found = verdicts(server, sweep, state)
            assert found["basic-io-error"] == "acted"
            assert found["battery-error"] == "no_effect"
            assert found["plc-setup-error"] == "never_read"
            assert found["io-bus-error"] == "stopped"

        rows = {row["id"]: row for row in server.http.get(f"/api/instances/{instance}/errors").json()}
        assert (rows["battery-error"]["swept"]["verdict"], rows["battery-error"]["reaction"]) == ("no_effect", None)
        assert (rows["basic-io-error"]["swept"]["verdict"], rows["basic-io-error"]["swept"]["scans"]) == ("acted", 1)

        # The past does not know what came later: neither a look alone, nor everybody's.
        own = server.http.post(f"/api/instances/{instance}/branch", json={"name": "alone", "scan": 3, "look": True})
        assert browser.ask(type="travel", scan=3)["ok"]
        assert not any(row["swept"] for row in server.http.get(f"/api/instances/{own.json()['id']}/errors").json())
        browser.wait(
            lambda: not any(row["swept"] for row in server.http.get(f"/api/instances/{instance}/errors").json())
        )
        assert browser.ask(type="travel", scan=None)["ok"]

        cell = {"error": "plc-setup-error", "state": "Idle"}
        told = server.http.post(f"/api/sweeps/{sweep}/reaction", json=cell).json()
        assert (told["verdict"], told["readers"], told["difference_count"]) == ("never_read", [], 0)
        accepted = server.http.post(f"/api/sweeps/{sweep}/accept", json={**cell, "reason": "no such unit is used"})
        assert accepted.status_code == 200, accepted.text
        reacted = {"error": "basic-io-error", "state": "Idle", "reason": "why not"}
        assert server.http.post(f"/api/sweeps/{sweep}/accept", json=reacted).status_code == 422
        whole = server.http.get(f"/api/sweeps/{sweep}").json()
        (mine,) = [each for each in whole["cells"] if each["accepted"]]
        assert mine["accepted"]["by"]

        opened = server.http.post(
            f"/api/sweeps/{sweep}/open", json={"error": "battery-error", "state": "Ready", "name": "looked at"}
        )
        assert opened.status_code == 201, opened.text
        look = server.http.get(f"/api/instances/{opened.json()['id']}/errors").json()
        assert {row["id"] for row in look if row["status"] == "generated"} == {"battery-error"}
        assert server.state(opened.json()["id"])["state"] == "paused"

        # A corrected program is better, and the states are carried over to it.
        text = server.http.get(f"/api/projects/{project}/files/main.st").json()
        saved = {"text": CORRECTED, "version": text["version"]}
        assert server.http.put(f"/api/projects/{project}/files/main.st", json=saved).status_code == 200
        built = server.http.post(f"/api/projects/{project}/build", json={"agreed": True}).json()
        assert built["ok"], built
        again = server.http.post(f"/api/instances/{instance}/sweeps", json={"states": states, "window": 50}).json()[
            "id"
        ]
        assert finished(browser, again)["status"] == "done"
        compared = server.http.get(f"/api/sweeps/{sweep}/compare/{again}").json()
        changed = {
            (each["error"], each["state"]): each["change"] for each in compared["changes"] if each["change"] != "same"
        }
        assert changed == {("battery-error", "Idle"): "better", ("battery-error", "Ready"): "better"}
        whole = server.http.get(f"/api/sweeps/{again}").json()
        assert [each["error"] for each in whole["cells"] if each["accepted"]] == ["plc-setup-error"]
        assert len(server.http.get(f"/api/projects/{project}/sweeps").json()) == 2
        assert server.http.delete(f"/api/sweeps/{sweep}").status_code == 204
        assert server.http.get(f"/api/sweeps/{sweep}").status_code == 404


@slow
def test_a_sweep_is_cancelled_and_resumed(server: Server) -> None:
    instance = server.instance("cancelled", MODEL, main=PROGRAM)
    with server.browser(instance) as browser:
        kept = server.http.post(f"/api/instances/{instance}/states", json={"name": "Kept"}).json()["id"]
        states = [kept, kept]  # once is enough
        begun = server.http.post(f"/api/instances/{instance}/sweeps", json={"window": 8_000, "states": states})
        assert begun.json()["states"] == ["Kept"]
        sweep = begun.json()["id"]
        second = server.http.post(f"/api/instances/{instance}/sweeps", json={})
        assert second.status_code == 422
        assert "runs" in second.json()["message"]
        browser.wait(lambda: _done(browser, sweep) >= 1)
        stopped = server.http.post(f"/api/sweeps/{sweep}/cancel").json()
        assert stopped["status"] == "cancelled"
        assert 0 < stopped["done"] < stopped["total"]
        first = {cell["error"] for cell in server.http.get(f"/api/sweeps/{sweep}").json()["cells"]}
        assert finished(browser, sweep)["status"] == "cancelled"
        assert server.http.delete(f"/api/states/{kept}").status_code == 204  # the sweep has its own
        browser.messages.clear()
        assert server.http.post(f"/api/sweeps/{sweep}/resume").status_code == 200
        end = finished(browser, sweep)
        assert (end["status"], end["done"]) == ("done", end["total"]), end
        told = [
            cell["error"] for message in browser.messages if message["type"] == "sweep" for cell in message["cells"]
        ]
        assert first.isdisjoint(told)
        assert server.http.post(f"/api/sweeps/{sweep}/resume").status_code == 422


def test_a_deleted_project_takes_its_sweep_along(server: Server) -> None:
    """Nothing of it goes on, and nothing is left on the disk."""
    ghost = server.instance("ghost", MODEL, main=PROGRAM)
    project = server.http.get(f"/api/instances/{ghost}").json()["project"]["id"]
    begun = server.http.post(f"/api/instances/{ghost}/sweeps", json={"window": 100_000}).json()
    assert server.http.delete(f"/api/instances/{ghost}").status_code == 204
    assert server.http.get(f"/api/sweeps/{begun['id']}").json()["status"] == "running"  # it outlives its PLC
    assert server.http.delete(f"/api/projects/{project}").status_code == 204
    assert server.http.get(f"/api/sweeps/{begun['id']}").status_code == 404
    assert not list(server.data.glob(f"states/sweep-{begun['id']}-*"))
    other = server.instance("other", MODEL, main=PROGRAM)
    with server.browser(other) as browser:
        wanted = {"errors": ["battery-error", "plc-setup-error"], "window": 20}
        sweep = server.http.post(f"/api/instances/{other}/sweeps", json=wanted).json()["id"]
        end = finished(browser, sweep)
        assert (end["done"], end["total"]) == (2, 2)
        assert verdicts(server, sweep, "Now") == {"battery-error": "no_effect", "plc-setup-error": "never_read"}


def test_what_cannot_be_swept_says_why(server: Server) -> None:
    instance = server.instance("unswept", MODEL, main=PROGRAM)
    base = f"/api/instances/{instance}"
    unknown = server.http.post(f"{base}/sweeps", json={"errors": ["batery-error"]})
    assert unknown.status_code == 422
    assert "battery-error" in unknown.text
    assert server.http.post(f"{base}/sweeps", json={"errors": []}).status_code == 422
    assert server.http.post(f"{base}/sweeps", json={"states": [4711]}).status_code == 422
    assert server.http.post(f"{base}/sweeps", json={"window": 0}).status_code == 422
    assert server.http.post(f"{base}/states", json={"name": " "}).status_code == 422
    assert server.http.post(f"{base}/states", json={"name": "later", "scan": 1 << 40}).status_code == 422
    assert server.http.get("/api/sweeps/4711").status_code == 404
    assert server.http.delete("/api/states/4711").status_code == 404


def _done(browser: Browser, sweep: int) -> int:
    told = [message["sweep"] for message in browser.messages if message["type"] == "sweep"]
    return max((int(each["done"]) for each in told if each["id"] == sweep), default=0)


UNITS = """PROGRAM Main
VAR three AT A418.03 : BOOL; five AT A418.05 : BOOL; lamp AT CIO 100.00 : BOOL; copy : BOOL; END_VAR
  lamp := three; copy := five;
END_PROGRAM
"""
ERROR = "special-io-unit-error"


def test_details_that_the_program_tells_apart_have_rows_of_their_own(server: Server) -> None:
    instance = server.instance("units", MODEL, main=UNITS)
    with server.browser(instance) as browser:
        begun = server.http.post(f"/api/instances/{instance}/sweeps", json={"errors": [ERROR, "battery-error"]}).json()
        end = finished(browser, begun["id"])
        assert (begun["total"], end["total"], end["done"]) == (2, 3, 3)
        whole = server.http.get(f"/api/sweeps/{begun['id']}").json()
        names = {error["id"]: error["name"] for error in whole["errors"]}
        assert names[f"{ERROR}:unit=3"] == "Special I/O Unit error (unit=3)"
        codes = {error["id"]: error["code"] for error in whole["errors"]}
        assert codes == {"battery-error": "00F7", f"{ERROR}:unit=3": "0303", f"{ERROR}:unit=5": "0305"}
        found = {cell["error"]: cell["verdict"] for cell in whole["cells"]}
        assert found == {
            "battery-error": "never_read", f"{ERROR}:unit=3": "acted", f"{ERROR}:unit=5": "stored",
        }  # fmt: skip
        rows = server.http.get(f"/api/instances/{instance}/errors").json()
        assert [(row["instance"], row["swept"]["verdict"]) for row in rows if row["id"] == ERROR] == [
            (f"{ERROR}:unit=3", "acted"), (f"{ERROR}:unit=5", "stored"),
        ]  # fmt: skip
        cell = {"error": f"{ERROR}:unit=5", "state": "Now"}
        record = server.http.get(f"/api/instances/{instance}/record").json()
        assert [(each["error"], each["verdict"], each["note"]) for each in record["sweeps"][0]["cells"]] == [
            ("battery-error", "never_read", ""), (f"{ERROR}:unit=3", "acted", ""), (f"{ERROR}:unit=5", "stored", ""),
        ]  # fmt: skip
        accepted = {**cell, "reason": "a spare one"}
        assert server.http.post(f"/api/sweeps/{begun['id']}/accept", json=accepted).status_code < 300
        opened = server.http.post(f"/api/sweeps/{begun['id']}/open", json={**cell, "name": "unit five"})
        assert opened.status_code == 201, opened.text
        history = server.http.get(f"/api/instances/{opened.json()['id']}/errors").json()
        present = [row["instance"] for row in history if row["id"] == ERROR and row["status"] == "generated"]
        assert present == [f"{ERROR}:unit=5"]


def test_a_version_that_was_only_swept_has_a_record(server: Server) -> None:
    instance = server.instance("only swept", MODEL, main=PROGRAM)
    project = server.http.get(f"/api/instances/{instance}").json()["project"]["id"]
    with server.browser(instance) as browser:
        begun = server.http.post(f"/api/instances/{instance}/sweeps", json={"errors": ["plc-setup-error"]}).json()
        assert begun["instance_id"] == instance
        finished(browser, begun["id"])
        file = f"/api/projects/{project}/files/main.st"
        assert server.http.put(file, json={"text": CORRECTED, "version": 1}).status_code == 200
        assert server.http.post(f"/api/projects/{project}/build", json={}).json()["ok"]
        browser.wait(lambda: server.state(instance)["program_version"] == 2)
    record = server.http.get(f"/api/instances/{instance}/record", params={"version": 1})
    assert record.status_code == 200, record.text
    assert record.json()["program_version"] == 1
    (swept,) = record.json()["sweeps"]
    assert [(cell["error"], cell["verdict"]) for cell in swept["cells"]] == [("plc-setup-error", "never_read")]

    assert server.http.delete(f"/api/instances/{instance}").status_code == 204
    (left,) = server.http.get(f"/api/projects/{project}/sweeps").json()
    assert (left["id"], left["instance_id"]) == (begun["id"], None)
