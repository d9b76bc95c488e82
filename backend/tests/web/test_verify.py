"""Verification through the whole house: REST and WebSocket, session, a job process, both engines."""

from typing import cast

import pytest

from scanbench.client import verdict
from scanbench.client.shapes.verification import VerificationInfo
from tests.web.server import PATIENCE_S, Browser, Message, Server

MODEL = "CJ1M-CPU63"
PROGRAM = """\
PROGRAM Main
VAR
  n : DINT; level : INT := 100; doubled : INT; one : Ramp; two : Ramp; sum : INT; kept AT D120 : INT; text : STRING[12];
END_VAR
  n := n + 1;
  doubled := level * 2;
  one(target := 600);
  two(target := 40);
  sum := one.speed + two.speed;
  kept := kept;
  IF doubled > 200 THEN text := 'high'; ELSE text := 'low'; END_IF;
END_PROGRAM
FUNCTION_BLOCK Ramp
VAR_INPUT target : INT; END_VAR
VAR_OUTPUT speed : INT; END_VAR
  speed := LIMIT(speed - 25, target, speed + 25);
END_FUNCTION_BLOCK
"""


def begin(server: Server, instance: int, **wanted: object) -> Message:
    reply = server.http.post(f"/api/instances/{instance}/verifications", json=wanted)
    assert reply.status_code == 201, reply.text
    found: Message = reply.json()
    return found


def info(server: Server, instance: int, id: int) -> Message:
    found: list[Message] = server.http.get(f"/api/instances/{instance}/verifications").json()
    return next(each for each in found if each["id"] == id)


def rows(server: Server, id: int, **query: object) -> Message:
    reply = server.http.get(f"/api/verifications/{id}/rows", params={"count": 500, **query})  # type: ignore[dict-item]
    assert reply.status_code == 200, reply.text
    found: Message = reply.json()
    return found


def ended(
    browser: Browser, server: Server, instance: int, id: int, state: str = "done", patience_s: float = PATIENCE_S
) -> Message:
    found: list[Message] = []

    def over() -> bool:
        found[:] = [info(server, instance, id)]
        assert found[0]["state"] in (state, "failed") or found[0]["state"] in ("verifying", "waiting", "starting")
        return bool(found[0]["state"] == state or found[0]["state"] == "failed")

    browser.wait(over, patience_s)
    assert found[0]["state"] == state, found[0]
    return found[0]


def paused(browser: Browser) -> int:
    done = browser.ask(type="run", action="pause")
    assert done["ok"], done
    return int(done["scan"])


def scans(browser: Browser, count: int) -> None:
    for _ in range(count):
        assert browser.ask(type="run", action="scan")["ok"]


def number(text: str) -> int:
    return int.from_bytes(bytes.fromhex(text), "little", signed=True)


def disturb(server: Server, instance: int, **wanted: object) -> Message:
    reply = server.http.post(f"/api/instances/{instance}/disturbances", json=wanted)
    assert reply.status_code == 200, reply.text
    done: Message = reply.json()
    assert done["ok"], done
    return done


def test_live_and_nothing_differs(server: Server) -> None:
    instance = server.instance("verified live", MODEL, main=PROGRAM)
    with server.browser(instance) as browser:
        browser.wait_state("running")
        begun = begin(server, instance, range={"pou": "Ramp"})
        assert (begun["title"], begun["source"]) == ("Ramp", "live")
        browser.wait(lambda: info(server, instance, begun["id"])["compared"] > 50)
        paused(browser)
        status = info(server, instance, begun["id"])
        assert (status["differing"], status["skipped"]) == (0, 0)
        assert any(message["type"] == "verifications" for message in browser.messages)
        page = rows(server, begun["id"])
        first = page["rows"][0]["scan"]
        calls = [(row["scan"], row["call"], row["instance"]) for row in page["rows"][:4]]
        assert calls == [
            (first, 1, "Main.one"), (first, 2, "Main.two"), (first + 1, 1, "Main.one"), (first + 1, 2, "Main.two"),
        ]  # fmt: skip
        speed = page["rows"][0]["outputs"]["speed"]
        assert speed["control"] == speed["monitor"]
        assert {column["name"] for column in page["columns"]} >= {"speed", "target"}
        assert server.http.delete(f"/api/verifications/{begun['id']}").status_code == 204
        assert server.http.get(f"/api/verifications/{begun['id']}/rows").status_code == 404


def test_a_flipped_bit_is_found_and_set_data_says_that_it_was_the_input(server: Server) -> None:
    instance = server.instance("flipped", MODEL, main=PROGRAM)
    with server.browser(instance) as browser:
        scan = paused(browser)
        disturb(server, instance, kind="flip", path="Main.level", bit=6, scan=scan + 3)
        assert server.http.get(f"/api/instances/{instance}/disturbances").json()[0]["next_scan"] == scan + 3
        scans(browser, 6)
        begun = begin(server, instance, range={"file": "main.st", "first": 6, "last": 6}, first=scan)
        status = ended(browser, server, instance, begun["id"])
        assert (status["compared"], status["differing"], status["first_scan"]) == (6, 1, scan + 3)
        found = status["first_difference"]
        assert (found["cause"], found["name"]) == ("input", "Main.level")
        assert (number(found["control"]), number(found["monitor"])) == (100 ^ 64, 100)
        (row,) = rows(server, begun["id"], differing=True)["rows"]
        assert "level" in row["disturbances"][0] or "Main.level" in row["disturbances"][0]
        assert (
            row["outputs"]["Main.doubled"]["control"] == row["outputs"]["Main.doubled"]["monitor"]
        )  # the logic is right

        cell = {"scan": scan + 3, "call": row["call"], "column": "Main.level", "value": "100"}
        path = f"/api/verifications/{begun['id']}"
        done = server.http.post(f"{path}/cells", json={"cells": [cell]})
        assert done.status_code == 200, done.text
        (row,) = rows(server, begun["id"], differing=True)["rows"]
        assert number(row["outputs"]["Main.doubled"]["set"]) == 200
        assert number(row["outputs"]["Main.doubled"]["control"]) == (100 ^ 64) * 2
        refused = server.http.post(f"{path}/cells", json={"cells": [{**cell, "value": "many"}]})
        assert refused.status_code == 422
        assert "INT" in refused.json()["message"]
        uses = server.http.get(f"{path}/uses", params={"scan": scan + 3, "call": row["call"]}).json()
        assert [(use["name"], use["written"]) for use in uses] == [("Main.level", False), ("Main.doubled", True)]
        assert server.http.patch(path, json={"memory": "set"}).json()["memory"] == "set"


def test_scan_by_scan_the_plc_waits(server: Server) -> None:
    instance = server.instance("by scan", MODEL, main=PROGRAM)
    with server.browser(instance) as browser:
        browser.wait_state("running")
        begun = begin(server, instance, pace="scan")
        scan = int(begun["first"])
        browser.wait_state("paused")
        scan = paused(browser)
        for _ in range(3):
            reply = server.http.patch(f"/api/verifications/{begun['id']}", json={"action": "go_on"})
            assert reply.status_code == 200, reply.text
        browser.wait(lambda: info(server, instance, begun["id"])["scan"] == scan + 2)
        assert paused(browser) == scan + 3
        assert info(server, instance, begun["id"])["skipped"] == 0
        server.http.patch(f"/api/verifications/{begun['id']}", json={"auto": True})
        browser.wait(lambda: (info(server, instance, begun["id"])["scan"] or 0) > scan + 10)
        free = server.http.patch(f"/api/verifications/{begun['id']}", json={"pace": "free"}).json()
        browser.wait_state("running")  # it had only waited for the verification
        browser.wait(lambda: info(server, instance, begun["id"])["compared"] > free["compared"] + 50)
        stopped = server.http.patch(f"/api/verifications/{begun['id']}", json={"action": "stop"}).json()
        assert stopped["state"] == "stopped"


def test_step_by_step_both_sides_stop(server: Server) -> None:
    instance = server.instance("by step", MODEL, main=PROGRAM)
    with server.browser(instance) as browser:
        paused(browser)
        begun = begin(server, instance, pace="step")
        for step in range(1, 5):
            reply = server.http.patch(f"/api/verifications/{begun['id']}", json={"action": "go_on"})
            assert reply.status_code == 200, reply.text
            browser.wait(lambda want=step: info(server, instance, begun["id"])["rows"] == want, 30)  # type: ignore[misc]
        found = rows(server, begun["id"])["rows"]
        assert [row["kind"] for row in found] == ["step"] * 4
        assert [row["place"] and row["place"]["line"] for row in found] == [None, 5, 6, 7]
        assert [row["next"]["line"] for row in found] == [5, 6, 7, 16]
        assert not any(row["differences"] for row in found)


def test_step_by_step_both_sides_stop_in_the_range_only(server: Server) -> None:
    instance = server.instance("by step in a range", MODEL, main=PROGRAM)
    with server.browser(instance) as browser:
        paused(browser)
        begun = begin(server, instance, pace="step", range={"pou": "Main", "first": 7, "last": 7})
        for step in range(3):
            reply = server.http.patch(f"/api/verifications/{begun['id']}", json={"action": "go_on"})
            assert reply.status_code == 200, reply.text
            browser.wait(lambda want=step: info(server, instance, begun["id"])["rows"] > want, 30)  # type: ignore[misc]
            browser.wait(lambda: info(server, instance, begun["id"])["state"] == "waiting")
        found = rows(server, begun["id"])["rows"]
        steps = [row for row in found if row["kind"] == "step"]
        places = [(row["place"] and row["place"]["line"], row["next"] and row["next"]["line"]) for row in steps]
        assert places == [(None, 7), (7, 16), (16, None), (None, 7)]
        assert [row["kind"] for row in found] == ["step", "step", "step", "pass", "step"]


def test_a_plc_goes_on_when_stepping_is_stopped_on_the_way(server: Server) -> None:
    instance = server.instance("stopped on the way", MODEL, main=PROGRAM)
    with server.browser(instance) as browser:
        for _ in range(4):  # between two statements, or before one
            browser.wait_state("running")
            begun = begin(server, instance, pace="step")
            assert server.http.patch(f"/api/verifications/{begun['id']}", json={"auto": True}).status_code == 200
            browser.wait(lambda id=begun["id"]: info(server, instance, id)["rows"] > 2, 30)  # type: ignore[misc]
            assert server.http.patch(f"/api/verifications/{begun['id']}", json={"action": "stop"}).status_code == 200
            stopped = server.state(instance)["scan"]
            browser.wait(lambda scan=stopped: server.state(instance)["scan"] > scan + 20, 30)  # type: ignore[misc]


UNREACHED = """\
PROGRAM Main
VAR n : INT; one : Ramp; END_VAR
  n := n + 1;
  IF n < 0 THEN one(target := n); END_IF;
END_PROGRAM
FUNCTION_BLOCK Ramp
VAR_INPUT target : INT; END_VAR VAR_OUTPUT speed : INT; END_VAR
  speed := target;
END_FUNCTION_BLOCK
"""


def test_of_a_range_that_never_ran_nothing_is_said(server: Server) -> None:
    instance = server.instance("never runs", MODEL, main=UNREACHED)
    with server.browser(instance) as browser:
        scan = paused(browser)
        scans(browser, 3)
        begun = begin(server, instance, first=scan, last=scan + 9, range={"pou": "Ramp"})
        over = ended(browser, server, instance, begun["id"])
        assert (over["compared"], over["not_run"], over["not_reached"], over["differing"]) == (3, 3, 7, 0)
        assert verdict(cast(VerificationInfo, over)) == "nothing compared"
        path = f"/api/verifications/{begun['id']}/export"
        exported = server.http.get(path, params={"format": "json"}).json()
        assert (exported["same"], exported["not_reached"]) == (None, 7)
        assert 'errors="1"' in server.http.get(path, params={"format": "junit"}).text
        whole = ended(browser, server, instance, begin(server, instance, first=scan, last=scan + 2)["id"])
        assert (whole["compared"], whole["not_run"], whole["not_reached"]) == (3, 0, 0)
        assert verdict(cast(VerificationInfo, whole)) == "same"


def test_kept_and_exported(server: Server) -> None:
    instance = server.instance("kept verification", MODEL, main=PROGRAM)
    with server.browser(instance) as browser:
        scan = paused(browser)
        scans(browser, 3)
        begun = begin(server, instance, first=scan)
        ended(browser, server, instance, begun["id"])
        path = f"/api/verifications/{begun['id']}"
        kept = server.http.post(f"{path}/keep", json={"name": "three scans"})
        assert kept.status_code == 201, kept.text
        record = kept.json()
        csv = server.http.get(f"{path}/export", params={"format": "csv"})
        assert csv.text.count("\n") >= 4
        assert "Main.doubled" in csv.text or "doubled" in csv.text
        assert server.http.get(f"{path}/export", params={"format": "json"}).json()
        assert "<html" in server.http.get(f"{path}/export", params={"format": "html"}).text
        server.http.delete(path)
        again = server.http.get(f"/api/verification-records/{record['id']}").json()
        assert (again["name"], again["info"]["compared"]) == ("three scans", 3)
        assert len(server.http.get(f"/api/verification-records/{record['id']}/rows").json()["rows"]) == 3
        assert server.http.get(f"/api/verification-records/{record['id']}/export").status_code == 200
        project = record["project"]
        assert [each["id"] for each in server.http.get(f"/api/projects/{project}/verification-records").json()] == [
            record["id"]
        ]
        assert server.http.delete(f"/api/verification-records/{record['id']}").status_code == 204
        assert server.http.get(f"/api/verification-records/{record['id']}").status_code == 404


def test_a_record_has_its_own_rows_when_it_gets_the_number_of_one_that_went(server: Server) -> None:
    instance = server.instance("kept again", MODEL, main=PROGRAM)
    with server.browser(instance) as browser:
        scan = paused(browser)
        scans(browser, 3)
        for last in (scan + 2, scan):
            id = begin(server, instance, first=scan, last=last)["id"]
            compared = ended(browser, server, instance, id)["compared"]
            record = server.http.post(f"/api/verifications/{id}/keep", json={"name": "again"}).json()["id"]
            page = server.http.get(f"/api/verification-records/{record}/rows").json()["rows"]
            assert [row["scan"] for row in page] == list(range(scan, last + 1))
            assert compared == len(page)
            assert server.http.delete(f"/api/verification-records/{record}").status_code == 204


def test_what_cannot_be_verified_says_why(server: Server) -> None:
    instance = server.instance("unverifiable", MODEL, main=PROGRAM)
    path = f"/api/instances/{instance}/verifications"
    with server.browser(instance) as browser:
        scans(browser, 5 if paused(browser) < 5 else 0)
        scan = paused(browser)
        for wanted, words in (
            ({"range": {"pou": "Rampp"}}, "Ramp"),
            ({"range": {"file": "mian.st", "first": 4, "last": 6}}, "main.st"),
            ({"range": {"file": "main.st", "first": 6, "last": 5}}, "none"),
            ({"first": scan + 10}, "not over yet"),
            ({"first": 3, "last": 1}, "none"),
        ):
            refused = server.http.post(path, json=wanted)
            assert refused.status_code == 422, refused.text
            assert words in str(refused.json()), refused.json()
        assert server.http.get(path).json() == []


def test_a_trace_of_a_real_controller(server: Server) -> None:
    instance = server.instance("real", MODEL, main=PROGRAM)
    project = server.http.get(f"/api/instances/{instance}").json()["project"]["id"]
    lines = ["Scan,Main.level,Main.doubled", *(f"{scan},{scan + 90},{2 * (scan + 90)}" for scan in range(1, 9))]
    lines[5] = "5,95,191"
    sent = server.http.post(f"/api/projects/{project}/traces", params={"name": "real.csv"}, content="\n".join(lines))
    assert sent.status_code == 201, sent.text
    trace = sent.json()
    assert (trace["rows"], trace["problems"]) == (8, [])
    roles = {"Main.level": "input", "Main.doubled": "output"}
    mapping = trace["mapping"]
    for column in mapping["columns"]:
        column["role"] = roles.get(column["column"], "ignore")
    checked = server.http.post(
        f"/api/instances/{instance}/trace-check", json={"file": trace["file"], "mapping": mapping}
    ).json()
    assert checked["ok"], checked
    assert (checked["first"], checked["last"], checked["missing"]) == (1, 8, 0)
    saved = server.http.post(f"/api/projects/{project}/trace-mappings", json={"name": "line 3", "mapping": mapping})
    assert saved.status_code == 201, saved.text
    with server.browser(instance) as browser:
        begun = server.http.post(
            f"/api/instances/{instance}/trace-verifications", json={"file": trace["file"], "mapping": mapping}
        )
        assert begun.status_code == 201, begun.text
        status = ended(browser, server, instance, begun.json()["id"])
        assert (status["source"], status["compared"], status["differing"], status["first_scan"]) == ("trace", 7, 1, 5)
        assert (status["skipped"], status["stretches"]) == (1, [[1, 1]])  # it begins in the middle of a run
        assert "taken over" in status["message"]
        assert number(status["first_difference"]["control"]) == 191
    again = server.http.post(
        f"/api/projects/{project}/traces", params={"name": "real2.csv"}, content="\n".join(lines)
    ).json()
    assert again["mapping"] == mapping  # the saved one fits
    names = {each["name"] for each in server.http.get(f"/api/projects/{project}/trace-mappings").json()}
    assert names == {"line 3", "Last import"}
    columns = [{"column": "B7", "path": "Main.level", "role": "input"}]
    server.http.post(f"/api/projects/{project}/trace-mappings", json={"name": "B", "mapping": {"columns": columns}})
    other = server.http.post(
        f"/api/projects/{project}/traces", params={"name": "b.csv"}, content="Scan,B7,PLC.doubled\n1,2,4\n"
    ).json()
    assert {each["column"]: each["path"] for each in other["mapping"]["columns"]} == {
        "B7": "Main.level",  # as it was mapped before
        "PLC.doubled": "Main.doubled",
    }
    assert {each["column"]: each["score"] for each in other["guesses"]}["PLC.doubled"] < 1
    broken = server.http.post(
        f"/api/projects/{project}/traces", params={"name": "bad.csv"}, content="Scan,Main.level\n1,2\n1,x\n2"
    ).json()
    assert broken["problems"]


def test_what_a_fast_plc_has_skipped_is_counted(server: Server) -> None:
    instance = server.instance("too fast", MODEL, main=PROGRAM)
    with server.browser(instance) as browser:
        paused(browser)
        begun = begin(server, instance)
        first = begun["first"]
        assert browser.ask(type="run", action="continue", speed=0)["ok"]
        browser.wait(lambda: info(server, instance, begun["id"])["skipped"] > 1000)
        last = paused(browser)
        browser.wait(lambda: info(server, instance, begun["id"])["scan"] == last - 1)
        status = info(server, instance, begun["id"])
        assert status["compared"] + status["skipped"] == last - first
        assert status["differing"] == 0
        verified = {row["scan"] for row in rows(server, begun["id"])["rows"]}
        for low, high in status["stretches"]:
            assert not verified & set(range(low, min(high, low + 10_000) + 1))


def test_it_ends_with_its_run_and_lets_the_plc_go(server: Server) -> None:
    instance = server.instance("run over", MODEL, main=PROGRAM)
    with server.browser(instance) as browser:
        browser.wait_state("running")
        begun = begin(server, instance, pace="scan")
        browser.wait_state("paused")
        assert server.http.delete(f"/api/verifications/{begun['id']}").status_code == 204
        browser.wait_state("running")  # it had only waited for the verification
        begun = begin(server, instance)
        browser.wait(lambda: info(server, instance, begun["id"])["compared"] > 5)
        assert browser.ask(type="new_run")["ok"]
        status = ended(browser, server, instance, begun["id"], "failed")
        assert "new run" in status["message"]
        assert server.http.get(f"/api/verifications/{begun['id']}/rows").status_code == 200
        browser.wait(lambda: server.state(instance)["state"] == "running")
        begun = begin(server, instance, pace="scan")
        paused(browser)
        scans(browser, 2)
        assert browser.ask(type="travel", scan=1)["ok"]
        refused = server.http.patch(f"/api/verifications/{begun['id']}", json={"action": "go_on"})
        assert refused.status_code == 422
        assert "past" in refused.json()["message"]


INDEXED = """\
PROGRAM Main
VAR ix, n : INT; arr : ARRAY[0..9] OF INT; END_VAR
  ix := (ix + 1) MOD 10;
  arr[ix] := arr[ix] + 1;
  n := n + 1;
END_PROGRAM
"""


@pytest.mark.parametrize("pace", ["free", "scan", "step"])
def test_the_run_time_error_of_the_plc_is_the_difference(server: Server, pace: str) -> None:
    instance = server.instance(f"traps {pace}", MODEL, main=INDEXED)
    with server.browser(instance) as browser:
        scans(browser, 2 if paused(browser) < 2 else 0)
        scan = paused(browser)
        begun = begin(server, instance, pace=pace)
        path = f"/api/verifications/{begun['id']}"
        for bit in (5, 6):  # 32 or 64 and more: outside whatever the index is
            disturb(server, instance, kind="result", site="main.st:3", bit=bit, scan=scan + 1)
        if pace == "free":
            browser.ask(type="run", action="continue")
        else:
            assert server.http.patch(path, json={"auto": True, "action": "go_on"}).status_code == 200
        browser.wait_state("trapped")
        browser.wait(lambda: "run-time error" in info(server, instance, begun["id"])["message"])
        browser.wait(lambda: info(server, instance, begun["id"])["state"] == "waiting")  # it may have a step to say yet
        status = info(server, instance, begun["id"])
        assert (status["scan"], status["first_scan"]) == (scan + 1, scan + 1)
        told = [each for row in rows(server, begun["id"], differing=True)["rows"] for each in row["differences"]]
        assert [each["cause"] for each in told].count("trap") == 1
        assert not [each["name"] for each in told if "header" in each["name"]]
        refused = server.http.patch(path, json={"pace": "scan", "action": "go_on"})
        assert (refused.status_code, "run-time error" in refused.text) == (422, True)
        past = begin(server, instance, first=scan, last=scan + 9)
        over = ended(browser, server, instance, past["id"])
        assert (over["last"], over["compared"], over["first_scan"]) == (scan + 1, 2, scan + 1)
        assert f"{scan + 1} is the last that is over" in over["message"].replace(",", "")
        only = begin(server, instance, first=scan + 1)
        assert ended(browser, server, instance, only["id"])["compared"] == 1
        # what follows in the scan after a restart is compared, and nothing twice
        before = info(server, instance, begun["id"])
        assert server.http.patch(path, json={"pace": "free"}).status_code == 200
        assert browser.ask(type="restart", kind="cold")["ok"]
        paused(browser)
        scans(browser, 2)
        last = paused(browser)
        browser.wait(lambda: info(server, instance, begun["id"])["scan"] == last - 1)
        status = info(server, instance, begun["id"])
        assert status["compared"] == before["compared"] + last - scan - 2
        assert status["differing"] == before["differing"]
        again = [row for row in rows(server, begun["id"])["rows"] if row["scan"] == scan + 1 and row["kind"] == "scan"]
        assert len(again) == 2
