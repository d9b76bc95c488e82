"""Traces through the whole server: made, triggered, read, kept, exported; and scans that are over, recorded afterwards."""

import csv
import io
import os
import signal
import struct
from dataclasses import dataclass

from tests.amounts import slow
from tests.web.server import Message, Server

MODEL = "CJ1M-CPU63"
SOURCE = """PROGRAM Main
VAR n : DINT; a : INT; on : BOOL; r : REAL; go : BOOL; b : Mixer; END_VAR
  n := n + 1; a := DINT_TO_INT(n MOD 100) - 50; on := n MOD 10 < 5; r := DINT_TO_REAL(a) / 4.0;
  IF go THEN b(level := a); END_IF;
END_PROGRAM
FUNCTION_BLOCK Mixer VAR_IN_OUT level : INT; END_VAR END_FUNCTION_BLOCK
"""


@dataclass
class Samples:
    decimated: bool
    first: int
    end: int
    generation: int
    scans: list[int]
    valid: list[int]
    values: list[list[int]]


def parse(data: bytes) -> Samples:
    kind, decimated, signals, rows, first, end, generation = struct.unpack_from("<BBHIQQQ", data)
    assert kind == 2
    words = struct.unpack_from(f"<{rows * (2 + signals)}Q", data, 32)
    columns = [list(words[start : start + rows]) for start in range(0, len(words), rows)] if rows else [[], []]
    return Samples(bool(decimated), first, end, generation, columns[0], columns[1], columns[2:])


def run(server: Server, instance: int, scans: int) -> int:
    """So many scans, as fast as possible; the scan that is next."""
    with server.browser(instance) as browser:
        end = int(browser.ask(type="run", action="continue", speed=0, scans=scans)["scan"]) + scans
        browser.wait(
            lambda: any(each["type"] == "state" and _paused_at(each["state"], end) for each in browser.messages)
        )
    return end


def _paused_at(state: Message, scan: int) -> bool:
    return bool(state["state"] == "paused" and state["scan"] >= scan)


def paused(server: Server, name: str) -> int:
    instance = server.instance(name, MODEL, main=SOURCE)
    with server.browser(instance) as browser:
        browser.ask(type="run", action="pause", speed=None)
        browser.wait_state("paused")
    return instance


def made(server: Server, instance: int, **fields: object) -> Message:
    body = {"name": "T", "signals": ["Main.n", "Main.a", "Main.on", "Main.r"], "scans": 1000, **fields}
    reply = server.http.post(f"/api/instances/{instance}/traces", json=body)
    assert reply.status_code == 201, reply.text
    trace: Message = reply.json()
    return trace


def samples(server: Server, instance: int, trace: int, **params: int) -> Samples:
    reply = server.http.get(f"/api/instances/{instance}/traces/{trace}/samples", params=params)
    assert reply.status_code == 200, reply.text
    return parse(reply.content)


def trace_of(server: Server, instance: int, id: int) -> Message:
    found: Message = next(
        each for each in server.http.get(f"/api/instances/{instance}/traces").json() if each["id"] == id
    )
    return found


def test_every_scan_is_there_whether_somebody_looks_or_not(server: Server) -> None:
    instance = paused(server, "trace all")
    trace = made(server, instance, scans=30_000)
    assert (trace["state"], trace["by"]) == ("recording", "Guest")
    assert [each["type"] for each in trace["signals"]] == ["DINT", "INT", "BOOL", "REAL"]
    start = int(server.state(instance)["scan"])
    end = run(server, instance, 25_000)
    found = samples(server, instance, trace["id"])
    assert found.scans == list(range(start, end))
    assert (found.first, found.end, found.decimated) == (start, end, False)
    assert found.values[0] == [scan + 1 for scan in found.scans]
    assert set(found.valid) == {15}
    few = samples(server, instance, trace["id"], points=200)
    assert few.decimated
    assert len(few.scans) <= 200
    part = samples(server, instance, trace["id"], first=start + 10, last=start + 12)
    assert part.scans == [start + 10, start + 11, start + 12]


def test_a_trigger_on_a_rising_edge(server: Server) -> None:
    instance = paused(server, "trace edge")
    trigger = {"text": "Main.n", "when": "rises", "value": "5000", "before": 70}
    trace = made(server, instance, scans=1000, trigger=trigger)
    assert trace["state"] == "armed"
    run(server, instance, 4000)
    assert trace_of(server, instance, trace["id"])["state"] == "armed"
    run(server, instance, 2000)
    done = trace_of(server, instance, trace["id"])
    assert (done["state"], done["triggered"], done["hits"], done["rows"]) == ("complete", 4999, 1, 1000)
    found = samples(server, instance, trace["id"])
    assert found.scans == list(range(4999 - 700, 4999 + 300))
    again = server.http.post(f"/api/instances/{instance}/traces/{trace['id']}/start").json()
    assert (again["state"], again["triggered"], again["rows"]) == ("armed", None, 0)


def test_another_program_keeps_what_it_still_knows(server: Server) -> None:
    instance = paused(server, "trace change")
    trace = made(server, instance, signals=["Main.n", "Main.r", "Main.n * 2"])
    run(server, instance, 100)
    project = server.http.get(f"/api/instances/{instance}").json()["project"]["id"]
    text = SOURCE.replace("r : REAL;", "").replace("r := DINT_TO_REAL(a) / 4.0;", "")
    assert server.http.put(f"/api/projects/{project}/files/main.st", json={"text": text, "version": 1}).is_success
    built = server.http.post(f"/api/projects/{project}/build", json={"agreed": True}).json()
    assert built["ok"], built
    run(server, instance, 100)
    after = trace_of(server, instance, trace["id"])
    assert after["state"] == "recording"
    assert [bool(each["message"]) for each in after["signals"]] == [False, True, False]
    found = samples(server, instance, trace["id"])
    assert found.scans == list(range(found.first, found.first + 200))
    assert found.valid == [7] * 100 + [5] * 100
    assert found.values[2] == [2 * n for n in found.values[0]]


def test_a_look_at_the_past_leaves_no_trace(server: Server) -> None:
    instance = paused(server, "trace past")
    trace = made(server, instance, scans=30_000)
    start = int(server.state(instance)["scan"])
    run(server, instance, 500)
    with server.browser(instance) as browser:
        assert browser.ask(type="travel", scan=start + 100)["ok"]
        assert len(samples(server, instance, trace["id"]).scans) == 500
        assert browser.ask(type="travel", scan=None)["ok"]
    end = run(server, instance, 100)
    assert samples(server, instance, trace["id"]).scans == list(range(start, end))


def test_single_scans_and_writes_are_recorded(server: Server) -> None:
    instance = paused(server, "trace halted")
    trace = made(server, instance, scans=30_000)
    start = int(server.state(instance)["scan"])
    with server.browser(instance) as browser:
        for _ in range(3):
            assert browser.ask(type="run", action="scan", speed=None)["ok"]
        wrote = browser.ask(type="write", path="Main.n", value="7000")
        assert wrote["ok"], wrote
    end = run(server, instance, 20)
    found = samples(server, instance, trace["id"])
    assert found.scans == list(range(start, end))
    assert found.values[0][3:5] == [7001, 7002]


def test_a_trace_outlives_the_process_of_its_plc(server: Server) -> None:
    instance = paused(server, "trace killed")
    trace = made(server, instance, trigger={"text": "Main.n", "when": "rises", "value": "900"}, scans=200)
    run(server, instance, 300)
    with server.browser(instance) as browser:
        os.kill(int(server.state(instance)["pid"]), signal.SIGKILL)
        browser.wait_state("restarting")
        browser.wait(lambda: any(_armed(each, trace["id"]) for each in browser.messages))
    run(server, instance, 1000)
    done = trace_of(server, instance, trace["id"])
    assert (done["state"], done["triggered"], done["by"]) == ("complete", 899, trace["by"])
    found = samples(server, instance, trace["id"])
    assert found.scans == list(range(799, 999))


def _armed(message: Message, trace: int) -> bool:
    told = message["traces"] if message["type"] == "traces" else []
    return any(each["id"] == trace and each["state"] == "armed" and not each["note"] for each in told)


def test_what_cannot_be_recorded_is_refused(server: Server) -> None:
    instance = paused(server, "trace refused")
    at = f"/api/instances/{instance}/traces"

    def refused(**fields: object) -> Message:
        reply = server.http.post(at, json={"name": "T", "signals": ["Main.n"], **fields})
        assert reply.status_code == 422, reply.text
        message: Message = reply.json()
        return message

    assert refused(signals=["Main.rr"])["near"]
    assert "MiB" in refused(scans=10_000_000, signals=["Main.n"] + [f"Main.n + {k}" for k in range(40)])["message"]
    assert (
        "BOOL" in refused(trigger={"text": "Main.n"})["message"]
        or "TRUE" in refused(trigger={"text": "Main.n"})["message"]
    )
    assert "twice" in refused(signals=["Main.n", "Main.n"])["message"]
    assert "at most 64" in refused(signals=[f"Main.n + {k}" for k in range(65)])["message"]
    for number in range(8):
        made(server, instance, name=f"T{number}")
    assert "8 traces" in refused()["message"]
    assert server.http.delete(f"{at}/3").status_code == 204
    assert made(server, instance)["id"] == 9
    assert server.http.post(f"{at}/3/start").status_code == 404


def test_csv_kept_and_read_again(server: Server) -> None:
    instance = paused(server, "trace kept")
    trace = made(server, instance, signals=["Main.a", "Main.r", "Main.b.level"])
    run(server, instance, 50)
    at = f"/api/instances/{instance}/traces/{trace['id']}"
    rows = list(csv.reader(io.StringIO(server.http.get(f"{at}/csv").text)))
    assert rows[0] == ["scan", "time [s]", "Main.a", "Main.r", "Main.b.level"]
    first = int(rows[1][0])
    a = (first + 1) % 100 - 50
    assert rows[1][2:] == [str(a), f"{a / 4:g}", ""]
    assert len(rows) == 51
    kept = server.http.post(f"{at}/keep", json={"name": "before"}).json()
    assert (kept["rows"], kept["origin"], kept["first"]) == (50, "trace", first)
    live = server.http.get(f"{at}/samples").content
    again = server.http.get(f"/api/trace-records/{kept['id']}/samples").content
    assert parse(again).values == parse(live).values
    assert server.http.get(f"/api/trace-records/{kept['id']}/csv").text == server.http.get(f"{at}/csv").text
    project = kept["project"]
    assert [each["id"] for each in server.http.get(f"/api/projects/{project}/trace-records").json()] == [kept["id"]]
    assert server.http.delete(f"/api/trace-records/{kept['id']}").status_code == 204
    assert server.http.get(f"/api/trace-records/{kept['id']}").status_code == 404


@slow
def test_a_large_trace_goes_out_page_by_page(server: Server) -> None:
    instance = paused(server, "trace large")
    trace = made(server, instance, scans=500_000)
    start = int(server.state(instance)["scan"])
    end = run(server, instance, 400_000)
    at = f"/api/instances/{instance}/traces/{trace['id']}"
    refused = server.http.get(f"{at}/samples")
    assert refused.status_code == 422
    assert "400,000 samples of 4 signals are too many at once" in refused.json()["message"]
    assert len(samples(server, instance, trace["id"], points=10_000_000).scans) < 400_000
    lines = server.http.get(f"{at}/csv").text.splitlines()
    assert [int(line.partition(",")[0]) for line in lines[1:]] == list(range(start, end))
    part = server.http.get(f"{at}/csv", params={"first": end - 200_000, "last": end - 11}).text.splitlines()
    assert part[1:] == lines[-200_000:-10]
    kept = server.http.post(f"{at}/keep", json={"name": "large"}).json()
    assert (kept["rows"], kept["first"], kept["end"]) == (400_000, start, end)
    record = f"/api/trace-records/{kept['id']}"
    assert server.http.get(f"{record}/csv").text.splitlines() == lines
    assert server.http.get(f"{record}/samples").status_code == 422
    outline = {"points": 500}
    assert (
        server.http.get(f"{record}/samples", params=outline).content[32:]
        == (server.http.get(f"{at}/samples", params=outline).content[32:])
    )


def test_scans_that_are_over_are_recorded_afterwards(server: Server) -> None:
    instance = paused(server, "retrospective")
    run(server, instance, 5000)
    with server.browser(instance) as browser:
        browser.ask(type="write", path="Main.n", value="100")
    end = run(server, instance, 5000)
    with server.browser(instance) as browser:
        body = {"signals": ["Main.n", "Main.on"], "scans": 6000}
        reply = server.http.post(f"/api/instances/{instance}/retrospectives", json=body)
        assert reply.status_code == 201, reply.text
        landed: list[Message] = []

        def over() -> bool:
            landed.extend(
                each
                for each in browser.messages
                if each["type"] == "retrospective" and (each["record"] or each["message"])
            )
            return bool(landed)

        browser.wait(over, timeout=60)
    assert landed[0]["message"] == "", landed
    record = landed[0]["record"]
    found = parse(server.http.get(f"/api/trace-records/{record}/samples").content)
    assert found.scans == list(range(end - 6000, end))
    assert found.values[0][-1] == 5100
    assert found.values[0][999:1001] == [end - 5000, 101]
    retrospectives = f"/api/instances/{instance}/retrospectives"
    replies = [server.http.post(retrospectives, json=body)]
    while replies[-1].status_code == 201:  # the third at the latest, unless one before it is over already
        replies.append(server.http.post(retrospectives, json=body))
    *under_way, third = replies
    assert third.status_code == 422
    assert "cancel" in third.json()["message"]
    answers = {server.http.delete(f"/api/retrospectives/{reply.json()['id']}").status_code for reply in under_way}
    assert answers <= {204, 422}  # 422: over by then
    late = server.http.post(f"/api/instances/{instance}/retrospectives", json={**body, "last": end + 5})
    assert late.status_code == 422
    assert "not over yet" in late.json()["message"]
