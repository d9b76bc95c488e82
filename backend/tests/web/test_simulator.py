"""The error simulator through the whole house: what it writes, who may not, two people, faults with a shape, reactions."""

import json
from functools import partial

import pytest

from tests.amounts import slow
from tests.web.server import Browser, Message, Server

MODEL = "CJ1M-CPU63"
PROGRAM = """
PROGRAM Main
VAR
  n : DINT; lamp AT CIO 100.00 : BOOL; ready AT CIO 0.00 : BOOL;
  basic AT A402.12 : BOOL; battery AT A402.04 : BOOL; setting AT A402.10 : BOOL;
  since : DINT;
END_VAR
  n := n + 1;
  IF basic THEN
    lamp := TRUE;
    since := n;
  END_IF;
  IF battery THEN
    ;
  END_IF;
END_PROGRAM
"""
WRITES = """
PROGRAM Main
VAR flag AT A402.12 : BOOL; END_VAR
  flag := TRUE;
END_PROGRAM
"""
CHECKSUM = {"id": "memory-error", "details": {"location": "io-table-checksum"}}


def row_of(browser: Browser, id: str, **fields: object) -> Message:
    """The row of an error as soon as it is like this."""
    found: list[Message] = []

    def here() -> bool:
        for message in browser.messages:
            if message["type"] == "errors":
                found.extend(row for row in message["rows"] if row["id"] == id)
        return any(all(row[name] == value for name, value in fields.items()) for row in found)

    browser.wait(here)
    return found[-1]


def reaction_of(browser: Browser, id: str) -> Message:
    """What is known of the reaction, once it is."""
    found: list[Message] = []

    def here() -> bool:
        for message in browser.messages:
            if message["type"] == "errors":
                found.extend(row["reaction"] for row in message["rows"] if row["id"] == id and row["reaction"])
        return any(each["state"] != "recording" for each in found)

    browser.wait(here)
    return next(each for each in found if each["state"] != "recording")


def words(browser: Browser) -> tuple[int | None, ...]:
    found = (browser.number(word) for word in ("A400", "A401", "A402", "A403"))
    return tuple(None if number is None else number & 0xFFFF for number in found)


def test_the_example_of_the_format_to_the_bit(server: Server) -> None:
    """Memory error, code 80F1, flag A401.15, I/O table checksum A403.05 adds 3."""
    instance = server.instance("example", MODEL, main=PROGRAM)
    with server.browser(instance) as browser:
        browser.watch("A400", "A401", "A402", "A403", "A401.15", "A403.05")
        browser.wait(lambda: words(browser) == (0, 0, 0, 0))
        preview = server.http.post(f"/api/instances/{instance}/errors/preview", json={"errors": [CHECKSUM]})
        assert preview.status_code == 200, preview.text
        writes = {write["address"]: (write["before"], write["after"]) for write in preview.json()["writes"]}
        assert writes["A400"] == ("0000", "80F4")
        assert writes["A401.15"] == ("0", "1")
        assert writes["A403.05"] == ("0", "1")
        assert words(browser) == (0, 0, 0, 0)
        done = browser.ask(type="generate", errors=[CHECKSUM])
        assert done["ok"], done
        browser.wait(lambda: words(browser) == (0x80F4, 0x8000, 0, 0x0020))
        assert browser.wait_state("fatal")
        assert browser.ask(type="recover", ids=["memory-error"])["ok"]
        browser.wait(lambda: words(browser) == (0, 0, 0, 0))


def test_error_memory_is_read_only_but_for_the_simulator(server: Server) -> None:
    """Through REST, the WebSocket and the program itself."""
    instance = server.instance("readonly", MODEL, main=PROGRAM)
    base = f"/api/instances/{instance}"
    with server.browser(instance) as browser:
        browser.watch("A400", "A401", "A402", "A403")
        for path, value in (("A402.12", "TRUE"), ("A400", "16#80F1"), ("Main.basic", "TRUE")):
            by_socket = browser.ask(type="write", path=path, value=value)
            assert not by_socket["ok"]
            assert "read-only" in by_socket["message"], by_socket
            by_rest = server.http.post(f"{base}/write", json={"path": path, "value": value})
            assert by_rest.status_code == 422
            assert "read-only" in by_rest.json()["message"]
            assert not browser.ask(type="force", path=path, value=value)["ok"]
        assert server.http.post(f"{base}/write", json={"path": "Main.ready", "value": "TRUE"}).status_code == 200
        raised = server.http.post(f"{base}/errors/generate", json={"errors": [{"id": "basic-io-error"}]})
        assert raised.status_code == 200, raised.text
        browser.wait(lambda: words(browser)[0] == 0x009A)
        assert not browser.ask(type="write", path="A402.12", value="FALSE")["ok"]
        assert server.http.post(f"{base}/errors/recover", json={}).status_code == 200
        browser.wait(lambda: words(browser)[:3] == (0, 0, 0))
    project = server.project("readonly by program", MODEL, main=WRITES)
    built = server.http.post(f"/api/projects/{project}/build", json={})
    assert not built.json()["ok"]
    assert "read-only" in built.text or "only read" in built.text, built.text


def test_two_people_raise_the_same_error(server: Server) -> None:
    instance = server.instance("two", MODEL, main=PROGRAM)
    slot = {"id": "basic-io-error", "details": {"slot": "3"}}
    with server.browser(instance, "Ada Lovelace") as ada, server.browser(instance, "Bob Noyce") as bob:
        assert ada.ask(type="generate", errors=[{"id": "basic-io-error"}])["ok"]
        assert row_of(bob, "basic-io-error", status="generated")["by"] == "Ada Lovelace"
        refused = bob.ask(type="generate", errors=[slot])
        assert not refused["ok"]
        assert "already generated by Ada Lovelace" in refused["message"]
        # All or nothing: what came with it was not raised either.
        assert not bob.ask(type="generate", errors=[{"id": "battery-error"}, slot])["ok"]
        rows = {row["id"]: row for row in server.http.get(f"/api/instances/{instance}/errors").json()}
        assert rows["battery-error"]["status"] == "never"
        assert bob.ask(type="generate", errors=[slot], again=True)["ok"]
        assert "slot=3" in row_of(ada, "basic-io-error", by="Bob Noyce")["details"]


def test_how_the_program_reacts_is_found_out_by_itself(server: Server) -> None:
    instance = server.instance("reactions", MODEL, main=PROGRAM)
    with server.browser(instance) as browser:
        assert browser.ask(type="run", action="speed", speed=20)["ok"]
        ids = ["basic-io-error", "battery-error", "plc-setup-error"]
        verdicts = {}
        for id in ids:
            browser.messages.clear()
            done = browser.ask(type="generate", errors=[{"id": id}])
            assert done["ok"], done
            assert row_of(browser, id, status="generated")["reaction"]["state"] == "recording"
            found = reaction_of(browser, id)
            assert found["state"] == "done", found
            verdicts[id] = found["verdict"]
            assert browser.ask(type="recover", ids=[id])["ok"]
        assert verdicts == dict(zip(ids, ["acted", "no_effect", "never_read"], strict=True))
        told = server.http.get(f"/api/instances/{instance}/errors/basic-io-error/reaction").json()
        assert told["first_effect"] == 1
        assert [(reader["file"], reader["line"]) for reader in told["readers"] if reader["what"] == "flag"] == [
            ("main.st", 9)
        ]
        assert told["differences"][0]["output"]
        assert told["differences"][0]["path"] == "Main.lamp"
        assert {line["line"] for line in told["lines"]} == {10, 11}
        never = server.http.get(f"/api/instances/{instance}/errors/plc-setup-error/reaction").json()
        assert never["differences"] == []
        assert never["readers"] == []
        assert browser.ask(type="generate", errors=[{"id": "basic-io-error"}])["ok"]
        browser.messages.clear()
        other = [{"id": "basic-io-error", "details": {"slot": "2"}}]
        assert browser.ask(type="generate", errors=other, again=True)["ok"]
        assert reaction_of(browser, "basic-io-error")["verdict"] == "decided"  # the lamp is on already
        assert browser.ask(type="recover", ids=None)["ok"]
        # A fatal error ends at once: the PLC stopped, as the model says.
        assert browser.ask(type="generate", errors=[{"id": "io-bus-error"}])["ok"]
        assert reaction_of(browser, "io-bus-error")["verdict"] == "stopped"


@slow
def test_a_reaction_that_was_being_recorded_is_found_after_a_restart_of_the_server(
    tmp_path_factory: pytest.TempPathFactory,
) -> None:
    data = tmp_path_factory.mktemp("again")
    with Server(data) as server:
        instance = server.instance("again", MODEL, main=PROGRAM)
        with server.browser(instance) as browser:
            assert browser.ask(type="generate", errors=[{"id": "basic-io-error"}])["ok"]
            row_of(browser, "basic-io-error", status="generated")
    with Server(data) as server, server.browser(instance) as browser:
        rows = {row["id"]: row for row in browser.hello["errors"]}
        found = rows["basic-io-error"]["reaction"]
        if found["state"] == "recording":
            found = reaction_of(browser, "basic-io-error")
        assert found["verdict"] == "acted"


def test_a_fault_with_a_shape_comes_and_goes(server: Server) -> None:
    instance = server.instance("shapes", MODEL, main=PROGRAM)
    with server.browser(instance) as browser:
        browser.watch("Main.since", "A402")
        armed = browser.ask(
            type="arm", errors=[{"id": "basic-io-error"}], start={"kind": "condition", "condition": "Main.ready"},
            shape={"kind": "for", "scans": 3},
        )  # fmt: skip
        assert armed["ok"], armed
        (fault,) = browser.wait_for("armed")["faults"]
        assert (fault["state"], fault["by"], fault["errors"]) == (
            "waiting", "Ada Lovelace", ["basic-io-error:rack=0,slot=0"],
        )  # fmt: skip
        assert browser.ask(type="write", path="Main.ready", value="TRUE")["ok"]
        row = row_of(browser, "basic-io-error", status="cleared")
        assert row["recovered_scan"] - row["generated_scan"] == 3
        assert row["by"] == "Ada Lovelace"
        browser.wait_for("armed", faults=[])
        refused = browser.ask(
            type="arm", errors=[{"id": "basic-io-error"}], start={"kind": "line", "file": "main.st", "line": 4}
        )
        assert not refused["ok"]
        assert "main.st" in refused["message"]
        assert browser.ask(
            type="arm", errors=[{"id": "basic-io-error"}], shape={"kind": "intermittent", "scans": 2, "period": 10}
        )["ok"]
        browser.wait(lambda: any(fault["raised"] > 2 for fault in _last_armed(browser)))
        # of its first time, while it comes and goes; the lamp is on already
        assert reaction_of(browser, "basic-io-error")["verdict"] == "decided"
        assert browser.ask(type="disarm", ids=None)["ok"]
        browser.wait(lambda: _last_armed(browser) == [])
        rows = {row["id"]: row for row in server.http.get(f"/api/instances/{instance}/errors").json()}
        assert rows["basic-io-error"]["status"] == "cleared"


def _last_armed(browser: Browser) -> list[Message]:
    told = [message["faults"] for message in browser.messages if message["type"] == "armed"]
    faults: list[Message] = told[-1] if told else [{"raised": 0}]
    return faults


def test_a_tool_clears_as_on_the_device(server: Server) -> None:
    """What somebody raised at the simulator has a cause that is still there: a tool cannot clear it."""
    instance = server.instance(
        "cleared",
        MODEL,
        main="PROGRAM Main\nVAR n : INT; END_VAR\n  n := n + 1;\n  IF n = 3 THEN FAL(7); END_IF;\nEND_PROGRAM\n",
    )
    base = f"/api/instances/{instance}/errors"
    with server.browser(instance) as browser:
        row_of(browser, "fal", status="generated", origin="program")
        assert server.http.post(f"{base}/generate", json={"errors": [{"id": "basic-io-error"}]}).status_code == 200
        assert server.http.post(f"{base}/clear", json={"what": "all"}).status_code == 200
        row_of(browser, "fal", status="cleared", recovered_way="tool")
        held = server.http.post(f"{base}/clear", json={})
        assert held.status_code == 422
        assert "will not clear" in held.json()["message"]
        assert server.http.post(f"{base}/clear", json={"what": 0x4107}).status_code == 422
        assert server.http.post(f"{base}/log/clear").status_code == 200


def test_a_build_that_takes_a_unit_out_tells_that_these_are_all_rows(server: Server) -> None:
    """A browser that has the rows of before would count the unit that is not there any more."""
    instance = server.instance("units", MODEL, main=PROGRAM)
    project = server.http.get(f"/api/instances/{instance}").json()["project"]["id"]
    units = [{"kind": "special-io-unit", "number": number} for number in (3, 20)]
    with server.browser(instance) as browser:
        for version, fitted in enumerate((units, units[:1])):
            text = json.dumps({"version": 1, "fitted": fitted})
            saved = server.http.put(
                f"/api/projects/{project}/files/hardware.json", json={"text": text, "version": version}
            )
            assert saved.is_success, saved.text
            assert server.http.post(f"/api/projects/{project}/build", json={}).json()["ok"]
            expected = {f"special-io-unit-error:unit={each['number']}" for each in fitted}
            browser.wait(partial(_has_units, browser, expected))


def _has_units(browser: Browser, expected: set[str]) -> bool:
    return _special(browser) == expected


def _special(browser: Browser) -> set[str]:
    """The units that the last message with all rows knows."""
    whole = [each["rows"] for each in browser.messages if each["type"] == "errors" and each["whole"]]
    return {row["instance"] for row in whole[-1] if row["id"] == "special-io-unit-error"} if whole else set()


def test_arming_a_fault_leaves_the_window_of_another_error_alone(server: Server) -> None:
    instance = server.instance("two windows", MODEL, main=PROGRAM)
    with server.browser(instance) as browser:
        assert browser.ask(type="generate", errors=[{"id": "plc-setup-error"}])["ok"]
        assert browser.ask(type="arm", errors=[{"id": "battery-error"}], start={"kind": "scan", "scan": 1_000_000_000})[
            "ok"
        ]
        assert reaction_of(browser, "plc-setup-error")["state"] == "done"
        told = server.http.get(f"/api/instances/{instance}/errors/plc-setup-error/reaction").json()
        assert (told["verdict"], told["window"]) == ("never_read", 200)
