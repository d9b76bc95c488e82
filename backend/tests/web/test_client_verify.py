"""What a script asks about disturbances, campaigns, verifications, traces, and two runs."""

import json
import re
from itertools import count

import pytest

from scanbench.client import Plc, Refused, connect, verdict
from tests.web.server import Server

SOURCE = """\
PROGRAM Main
VAR n, doubled : INT; level : INT; high : BOOL; part : REAL; t : TIME; alarm : BOOL; END_VAR
n := n + 1;
doubled := level * 2;
high := level > 50;
part := INT_TO_REAL(n) / 2.0;
t := INT_TO_TIME(n);
alarm := doubled < 0;
END_PROGRAM
"""
DOUBLED = 4
_NUMBERS = count()


@pytest.fixture
def plc(server: Server) -> Plc:
    """A PLC of its own, paused before scan 20."""
    name = f"asked what differs {next(_NUMBERS)}"
    server.instance(name, "GENERIC-IEC", Main=SOURCE)
    found = connect(server.address, user="Ann").plc(name)
    found.pause()
    found.new_run()
    found.write("Main.level", 30)
    found.run(scans=20, speed=0)
    return found


def test_a_disturbance_is_listed_taken_back_and_found_by_a_verification(plc: Plc) -> None:
    plc.disturb("flip", "Main.level", bit=3, scan=1000)
    (waits,) = plc.disturbances
    assert (waits["kind"], waits["state"], waits["next_scan"], waits["by"]) == ("flip", "waiting", 1000, "Ann")
    plc.calm(waits["id"])
    assert plc.disturbances == []
    plc.disturb("result", "Main.doubled", site=f"Main.st:{DOUBLED}", bit=2, scan=22)
    plc.disturb("stuck", scan=500, scans=3)
    plc.calm()
    assert plc.disturbances == []
    plc.disturb("result", "Main.doubled", site=f"Main.st:{DOUBLED}", bit=2, scan=22)
    plc.run(scans=5)
    found = plc.wait_for_verification(plc.begin_verification(20, 24))
    assert (found["state"], found["compared"], found["skipped"], found["differing"]) == ("done", 5, 0, 1)
    assert (found["first_scan"], verdict(found)) == (22, "differs")
    assert found["first_difference"] is not None
    assert (found["first_difference"]["cause"], found["first_difference"]["name"]) == ("logic", "Main.doubled")
    with pytest.raises(Refused):
        plc.disturb("flip", "Main.nowhere")


def test_a_verification_says_what_was_compared(plc: Plc) -> None:
    number = plc.begin_verification(5, 14, file="Main.st", lines=(DOUBLED, DOUBLED + 1))
    found = plc.wait_for_verification(number)
    assert (found["compared"], found["skipped"], verdict(found)) == (10, 0, "same")
    rows = plc.verification_rows(number)
    assert {each["name"] for each in rows["columns"]} == {"Main.level", "Main.doubled", "Main.high"}
    assert (len(rows["rows"]), rows["count"]) == (10, 10)
    assert plc.verification_rows(number, differing=True)["rows"] == []
    assert len(plc.export_verification(number).splitlines()) > 10
    assert json.loads(plc.export_verification(number, "json"))
    assert b'tests="2"' in plc.export_verification(number, "junit")
    assert plc.keep_verification(number, "nightly")["info"]["compared"] == 10
    assert [each["id"] for each in plc.verifications] == [number]
    plc.delete_verification(number)
    with pytest.raises(Refused):
        plc.verification(number)


def test_what_was_not_compared_is_not_said_to_be_the_same(plc: Plc) -> None:
    beyond = plc.wait_for_verification(plc.begin_verification(10, 90))
    assert (beyond["last"], beyond["compared"]) == (19, 10)
    assert "what comes after it is not compared" in beyond["message"]
    waits = plc.verification(plc.begin_verification())
    assert (waits["compared"], verdict(waits)) == (0, "nothing compared")
    plc.run(scans=1)
    goes_on = plc.wait_for_scan(waits["id"], 20, timeout_s=60)
    assert (goes_on["compared"], verdict(goes_on)) == (1, "same in what was compared")


def test_a_live_verification_goes_along_until_it_is_stopped(plc: Plc) -> None:
    number = plc.begin_verification()
    plc.run(scans=6)
    assert plc.wait_for_scan(number, 25, timeout_s=60)["compared"] == 6
    plc.disturb("flip", "Main.level", bit=0, scan=28)
    plc.run(scans=4)
    assert plc.wait_for_scan(number, 29, timeout_s=60)["first_scan"] == 28
    assert plc.stop_verification(number)["state"] == "stopped"
    with pytest.raises(TimeoutError, match="0 scans compared"):
        plc.wait_for_verification(plc.begin_verification(), timeout_s=0)


def test_inputs_of_the_set_data_are_tried(plc: Plc) -> None:
    number = plc.begin_verification(5, 7, pou="Main", pace="scan")
    for scan in (5, 6):
        plc.go_on(number)
        plc.wait_for_scan(number, scan, timeout_s=60)
    plc.set_cells(number, [{"scan": 6, "call": 1, "column": "Main.level", "value": "60"}])
    five, six = plc.verification_rows(number)["rows"]
    assert (five["scan"], five["outputs"]["Main.doubled"]["set"]) == (5, None)
    edited = six["outputs"]["Main.doubled"]
    assert (six["scan"], edited["control"], edited["monitor"], edited["set"]) == (6, "3c00", "3c00", "7800")


def test_a_controllers_log_is_verified(plc: Plc) -> None:
    log = "Scan,Main.level,Main.doubled\n" + "".join(
        f"{scan},{scan},{2 * scan + (scan == 6)}\n" for scan in range(1, 9)
    )
    trace = plc.upload_trace(log.encode(), "line 3.csv")
    assert {each["path"]: each["role"] for each in trace["mapping"]["columns"]} == {
        "Main.level": "input", "Main.doubled": "output"
    }  # fmt: skip
    found = plc.wait_for_verification(plc.begin_trace_verification(trace))
    assert (found["source"], found["first_scan"], verdict(found)) == ("trace", 6, "differs")
    assert found["coverage"] is not None
    assert [each["path"] for each in found["coverage"]["outputs"]] == ["Main.doubled"]
    assert "Main.high" in found["coverage"]["unrecorded"]
    trace = plc.upload_trace(log.replace(",13\n", ",12\n").encode(), "line 3.csv")
    again = plc.wait_for_verification(plc.begin_trace_verification(trace))
    # the first scan is taken over; Main.high is not in the file, as the coverage says
    assert (again["differing"], again["skipped"], verdict(again)) == (0, 1, "same")
    assert json.loads(plc.export_verification(again["id"], "json"))["same"] is True
    broken = plc.upload_trace(b"Scan,Main.level\n1,x\n", "broken.csv")
    with pytest.raises(Refused, match="x"):
        plc.begin_trace_verification(broken)


def test_a_campaign_tells_who_noticed_what(plc: Plc) -> None:
    found = plc.wait_for_campaign(plc.begin_campaign(6, seed=3, first=5, last=10, window=5, alarms=["Main.alarm"]))
    number = found["state"]["id"]
    assert (found["state"]["done"], found["state"]["of"], found["state"]["message"]) == (6, 6, "")
    assert sum(each["count"] for each in found["state"]["outcomes"]) == 6
    assert [each["number"] for each in found["trials"]] == [1, 2, 3, 4, 5, 6]
    assert b"<testsuite" in plc.export_campaign(number, "junit")
    opened = plc.open_trial(number, 1)
    opened.travel(found["trials"][0]["scan"])
    opened.delete()
    plc.delete_campaign(number)
    with pytest.raises(Refused):
        plc.campaign(number)
    bad = plc.wait_for_campaign(plc.begin_campaign(1, first=5, last=6, alarms=["Main.nowhere"]))
    assert "nowhere" in bad["state"]["message"]


def test_a_trace_is_recorded_and_read(plc: Plc) -> None:
    signals = ["Main.n", "Main.high", "Main.part", "Main.t", "Main.n > 22"]
    number = plc.begin_trace("curves", signals, every=2)
    plc.run(scans=6)
    found = plc.samples(number)
    assert found.scans == [20, 22, 24]
    assert found.values == {
        "Main.n": [21, 23, 25], "Main.high": [False, False, False], "Main.part": [10.5, 11.5, 12.5],
        "Main.t": [21_000_000, 23_000_000, 25_000_000], "Main.n > 22": [False, True, True],
    }  # fmt: skip
    assert plc.samples(number, first=22, last=23).scans == [22]
    assert len(plc.trace_csv(number).splitlines()) == 4
    assert plc.stop_trace(number)["state"] == "stopped"
    kept = plc.keep_trace(number, "kept")
    assert plc.record_samples(kept["id"]) == found
    plc.start_trace(number)
    plc.run(scans=1)
    plc.delete_trace(number)
    assert plc.traces == []
    trigger = plc.begin_trace("high", ["Main.n"], trigger={"text": "Main.high"})
    assert plc.traces[0]["state"] == "armed"
    plc.delete_trace(trigger)


def test_scans_that_are_over_are_recorded(plc: Plc) -> None:
    made = plc.record_past(["Main.n"], 4)
    assert made["record"] is not None
    assert plc.record_samples(made["record"]).values == {"Main.n": [17, 18, 19, 20]}
    assert "nowhere" in plc.record_past(["Main.nowhere"], 4)["message"]


def test_what_would_have_come_of_other_values(plc: Plc) -> None:
    found = plc.what_if(
        5, vary="Main.level", tried=[1, "60..61"], condition="Main.level > 60", window=1, watch=["Main.level"]
    )
    assert [(each["values"][0]["value"], each["met"]) for each in found["tries"]] == [
        ("1", None),
        ("60", None),
        ("61", 5),
    ]
    found = plc.what_if(5, change=["Main.level"], condition="Main.level = 77", window=1)
    assert found["best"] is None
    assert "no change" in found["note"]
    with pytest.raises(Refused, match="which variable"):
        plc.what_if(5)


def test_two_runs_are_compared(plc: Plc) -> None:
    other = plc.branch("other", scan=10)
    other.write("Main.level", 60)
    other.run(scans=5)
    found = plc.compare(other)["result"]
    assert found is not None
    assert found["scan"] is not None
    assert plc.compare(other.id)["result"] == found
    assert "Main.level" in {each["path"] for each in plc.changes(12, 12, other=other)["changes"]}
    with pytest.raises(Refused, match="the same as itself"):
        plc.compare(plc)
    other.delete()


def test_a_run_is_replayed_without_an_error(server: Server) -> None:
    server.instance("replayed by a script", "CJ1M-CPU63", main=SOURCE)
    plc = connect(server.address, user="Ann").plc("replayed by a script")
    plc.pause()
    plc.new_run()
    plc.run(scans=5, speed=0)
    plc.raise_error("battery-error")
    plc.run(scans=5)
    made = plc.replay_with("without", scan=5, error="battery-error", leave_out=True)
    assert made["instance"] is not None, made["message"]
    other = connect(server.address).plc(made["instance"])
    assert ([each["id"] for each in plc.present], other.present) == (["battery-error"], [])
    assert re.search(r"battery-error", plc.scenario())
    other.delete()
