"""Live PLCs through the whole house: browser's wire, web, session, host process, native engine."""

import os
import signal

from tests.amounts import slow
from tests.web.server import Browser, Server

COUNT = """
PROGRAM Main
VAR
  n : DINT; start AT CIO 0.00 : BOOL; motor AT CIO 100.00 : BOOL; basic AT A402.12 : BOOL; lamp : BOOL;
  text : STRING[20] := 'idle'; level : INT := 7; user : Adder; divisor : INT := 1; quotient : INT; index : INT;
  list : ARRAY[0..3] OF INT; loop : BOOL;
END_VAR
  n := n + 1;
  motor := start;
  IF basic THEN lamp := TRUE; END_IF;
  IF start THEN text := 'started'; END_IF;
  user(total := level);
  quotient := 100 / divisor;
  list[index] := 1;
  WHILE loop DO lamp := lamp; END_WHILE;
END_PROGRAM
FUNCTION_BLOCK Adder
VAR_IN_OUT total : INT; END_VAR
VAR calls : DINT; END_VAR
  calls := calls + 1;
END_FUNCTION_BLOCK
"""
MODEL = "CJ1M-CPU63"


def test_first_start_runs_the_sample(server: Server) -> None:
    app = server.http.get("/api").json()
    conveyor = next(each for each in app["instances"] if each["name"] == "line-1")
    assert conveyor["project"]["name"] == "Conveyor"
    with server.browser(conveyor["id"]) as browser:
        first = browser.wait_state("running")["scan"]
        browser.wait(lambda: any(m["type"] == "state" and m["state"]["scan"] > first + 20 for m in browser.messages))


@slow
def test_a_silent_plc_is_alive(server: Server) -> None:
    instance = server.instance("silent", MODEL, main=COUNT)
    with server.browser(instance) as browser:
        browser.wait_state("running")
        assert browser.ask(type="run", action="pause")["ok"]
        browser.wait_for("alive")
        browser.wait_for("alive")


def test_watch_write_and_refusals(server: Server) -> None:
    instance = server.instance("watching", MODEL, main=COUNT)
    with server.browser(instance) as browser:
        answer = browser.watch("Main.n", "Main.start", "motor", "Main.motor", "Main.text", "Main.user", "D100")
        items = {item["path"]: item for item in answer["items"]}
        assert items["motor"]["id"] is None
        assert items["motor"]["refusal"]["near"] == ["Main.motor"]
        assert items["Main.user"]["id"] is None
        assert items["Main.user"]["symbol"]["expandable"]
        assert items["Main.start"]["symbol"]["address"].replace(" ", "") == "CIO0.00"
        browser.wait(lambda: browser.number("Main.n") is not None)
        before = browser.number("Main.n") or 0
        browser.wait(lambda: (browser.number("Main.n") or 0) > before + 10)
        assert browser.texts[browser.ids["Main.text"]] == "idle"

        done = browser.ask(type="write", path="Main.start", value="TRUE")
        assert done["ok"], done
        browser.wait(lambda: browser.number("Main.motor") == 1)
        browser.wait(lambda: browser.texts[browser.ids["Main.text"]] == "started")
        written = browser.wait_for("written")
        assert (written["path"], written["author"], written["forced"]) == ("Main.start", "Ada Lovelace", False)

        refused = browser.ask(type="write", path="A402.12", value="TRUE")
        assert not refused["ok"]
        assert "read-only" in refused["message"]
        refused = browser.ask(type="write", path="Main.n", value="many")
        assert not refused["ok"]
        assert "DINT" in refused["message"]
        refused = browser.ask(type="write", path="Main.nn", value="1")
        assert refused["near"] == ["Main.n"]


def test_in_outs_are_followed(server: Server) -> None:
    instance = server.instance("inout", MODEL, main=COUNT)
    with server.browser(instance) as browser:
        browser.watch("Main.user.total", "Main.level")
        browser.wait(lambda: browser.number("Main.user.total") == 7)
        assert browser.ask(type="write", path="Main.user.total", value="9")["ok"]
        browser.wait(lambda: browser.number("Main.level") == 9 == browser.number("Main.user.total"))


def test_force_holds_and_release_ends_it(server: Server) -> None:
    instance = server.instance("force", MODEL, main=COUNT)
    with server.browser(instance) as browser:
        browser.watch("Main.motor")
        assert browser.ask(type="force", path="Main.motor", value="TRUE")["ok"]
        browser.wait(lambda: browser.number("Main.motor") == 1)
        browser.wait(lambda: any(m["type"] == "state" and m["state"]["forces"] == 1 for m in browser.messages))
        assert browser.ask(type="release", path="Main.motor")["ok"]
        browser.wait(lambda: browser.number("Main.motor") == 0)
        again = browser.ask(type="release", path="Main.motor")
        assert not again["ok"]
        assert browser.ask(type="mode", mode="RUN")["ok"]
        refused = browser.ask(type="force", path="Main.motor", value="TRUE")
        assert "MONITOR" in refused["message"]


def test_two_people_see_the_same(server: Server) -> None:
    instance = server.instance("pair", MODEL, main=COUNT)
    with server.browser(instance) as ada, server.browser(instance, "Grace Hopper") as grace:
        ada.wait(lambda: any(m["type"] == "users" and len(m["users"]) == 2 for m in ada.messages))
        for browser in (ada, grace):
            browser.watch("Main.basic", "Main.lamp", "A400")
        done = ada.ask(type="generate", errors=[{"id": "basic-io-error", "details": {"rack": "1", "slot": "3"}}])
        assert done["ok"], done
        for browser in (ada, grace):
            browser.wait(lambda b=browser: b.number("Main.basic") == 1 == b.number("Main.lamp"))  # type: ignore[misc]
            browser.wait(lambda b=browser: b.number("A400") == 0x9A)  # type: ignore[misc]
            row = browser.wait_for("errors")["rows"][0]
            assert (row["id"], row["status"], row["by"], row["count"]) == (
                "basic-io-error", "generated", "Ada Lovelace", 1
            )  # fmt: skip
        refused = grace.ask(type="generate", errors=[{"id": "basic-io-error", "details": {"rack": "1", "slot": "3"}}])
        assert "already generated by Ada Lovelace" in refused["message"]
        assert grace.ask(type="recover", ids=None)["ok"]
        ada.wait(lambda: ada.number("Main.basic") == 0 and ada.number("A400") == 0)
        assert ada.wait_for("errors")["rows"][0]["status"] == "cleared"
    row = next(r for r in server.http.get(f"/api/instances/{instance}/errors").json() if r["id"] == "basic-io-error")
    assert (row["status"], row["count"]) == ("cleared", 1)


def test_a_fatal_error_stops_the_program_until_mode_change(server: Server) -> None:
    instance = server.instance("fatal", MODEL, main=COUNT)
    with server.browser(instance) as browser:
        browser.watch("A400", "A401.15", "A403.05", "Main.n")
        errors = [{"id": "memory-error", "details": {"location": "io-table-checksum"}}]
        assert browser.ask(type="generate", errors=errors)["ok"]
        browser.wait(lambda: (browser.number("A400") or 0) & 0xFFFF == 0x80F4)
        browser.wait(lambda: browser.number("A401.15") == 1 == browser.number("A403.05"))
        state = browser.wait_state("fatal")
        assert "80F4" in state["message"]
        refused = browser.ask(type="mode", mode="MONITOR")
        assert not refused["ok"] or "already" in refused["message"]
        assert browser.ask(type="recover", ids=["memory-error"])["ok"]
        stopped = browser.wait_state("stopped")
        assert stopped["mode"] == "PROGRAM"
        assert browser.ask(type="mode", mode="MONITOR")["ok"]
        browser.wait_state("running")


def test_pause_scan_continue_and_speed(server: Server) -> None:
    instance = server.instance("pace", MODEL, main=COUNT)
    with server.browser(instance) as browser:
        browser.watch("Main.n")
        assert browser.ask(type="run", action="pause")["ok"]
        paused = browser.wait_state("paused")["scan"]
        assert browser.ask(type="run", action="scan")["ok"]
        browser.wait(lambda: browser.number("Main.n") == paused + 1)
        assert browser.ask(type="write", path="Main.level", value="8")[
            "ok"
        ]  # taken between two scans, had another one come
        assert server.state(instance)["scan"] == paused + 1
        assert browser.ask(type="run", action="continue", speed=0)["ok"]
        browser.wait(lambda: (browser.number("Main.n") or 0) > paused + 50_000)
        assert browser.ask(type="run", action="continue", speed=10)["ok"]
        browser.wait(lambda: bool(server.state(instance)["speed"] == 10))
        first = server.state(instance)["scan"]
        browser.wait(lambda: server.state(instance)["scan"] > first + 100)
        refused = browser.ask(type="run", action="continue", speed=-1)
        assert not refused["ok"]


def test_restart_is_a_cold_start(server: Server) -> None:
    instance = server.instance("restart", MODEL, main=COUNT)
    with server.browser(instance) as browser:
        browser.watch("Main.n", "Main.lamp")
        assert browser.ask(type="generate", errors=[{"id": "interrupt-task-error"}, {"id": "basic-io-error"}])["ok"]
        browser.wait(lambda: browser.number("Main.lamp") == 1)
        browser.wait(lambda: (browser.number("Main.n") or 0) > 50)
        browser.messages.clear()
        assert browser.ask(type="restart", kind="cold")["ok"]
        browser.wait(lambda: (browser.number("Main.n") or 0) < 50)
        browser.wait(lambda: _status(browser, "interrupt-task-error") == "cleared")
        browser.wait(lambda: _status(browser, "basic-io-error") == "generated")  # its cause outlives the restart


def _status(browser: Browser, error: str) -> str | None:
    """What was told last of this error."""
    rows = [row for message in browser.messages if message["type"] == "errors" for row in message["rows"]]
    found = [str(row["status"]) for row in rows if row["id"] == error]
    return found[-1] if found else None


def test_kill_is_shown_and_values_continue(server: Server) -> None:
    instance = server.instance("killed", MODEL, main=COUNT)
    with server.browser(instance) as browser:
        browser.watch("Main.n", "Main.level", "A400")
        assert browser.ask(type="write", path="Main.level", value="42")["ok"]
        assert browser.ask(type="generate", errors=[{"id": "battery-error"}])["ok"]
        browser.wait(lambda: (browser.number("Main.n") or 0) > 250)  # past the first checkpoint of running scans
        browser.ask(type="write", path="Main.level", value="43")
        state = server.state(instance)
        before, pid = browser.number("Main.n") or 0, state["pid"]
        browser.messages.clear()
        os.kill(pid, signal.SIGKILL)
        restarting = browser.wait_state("restarting")
        assert restarting["restarts"] == 1
        after = browser.wait_state("running")
        assert after["pid"] not in (None, pid)
        assert after["scan"] >= before - 50
        browser.wait(lambda: (browser.number("Main.n") or 0) > before + 20)
        assert browser.number("Main.level") == 43
        assert browser.number("A400") == 0xF7
        browser.wait(lambda: any(m["type"] == "watching" and m["ref"] is None for m in browser.messages))
        assert not browser.ask(type="generate", errors=[{"id": "battery-error"}])["ok"]  # it is still present


def test_a_trap_names_file_and_line_and_others_live(server: Server) -> None:
    other = server.instance("bystander", MODEL, main=COUNT)
    for name, path, value, kind, text in (
        ("division", "Main.divisor", "0", "division", "quotient :="),
        ("bounds", "Main.index", "9", "bounds", "list[index]"),
        ("endless", "Main.loop", "TRUE", "loop", "WHILE"),
    ):
        instance = server.instance(name, MODEL, main=COUNT)
        with server.browser(instance) as browser:
            assert browser.ask(type="write", path=path, value=value)["ok"]
            state = browser.wait_state("trapped")
            line = next(number for number, each in enumerate(COUNT.splitlines(), 1) if text in each)
            assert (state["trap"]["kind"], state["trap"]["file"], state["trap"]["line"]) == (kind, "main.st", line)
            assert f"main.st:{line}" in state["message"]
            refused = browser.ask(type="run", action="continue")
            assert not refused["ok"]
            assert browser.ask(type="restart", kind="cold")["ok"]
            browser.wait_state("running")
    with server.browser(other) as browser:
        browser.watch("Main.n")
        browser.wait(lambda: (browser.number("Main.n") or 0) > 0)
        before = browser.number("Main.n") or 0
        browser.wait(lambda: (browser.number("Main.n") or 0) > before)
        assert server.state(other)["state"] == "running"


def test_killed_while_trapped_it_is_trapped_again(server: Server) -> None:
    instance = server.instance("trapkill", MODEL, main=COUNT)
    with server.browser(instance) as browser:
        assert browser.ask(type="write", path="Main.divisor", value="0")["ok"]
        first = browser.wait_state("trapped")
        os.kill(server.state(instance)["pid"], signal.SIGKILL)
        browser.wait_state("restarting")
        second = browser.wait_state("trapped")
        assert second["trap"] == first["trap"]
        assert second["scan"] == first["scan"]
