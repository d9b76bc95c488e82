"""Errors that nobody injects, through the whole server: FAL, FALS and a run-time error, in state, history and log."""

from tests.web.server import Server

MODEL = "CJ1M-CPU63"
SOURCE = """PROGRAM Main
VAR n : INT; mild, severe : INT; divisor : INT := 1; END_VAR
  n := n + 1;
  IF mild <> 0 THEN FAL(mild); END_IF;
  IF severe <> 0 THEN
    FALS(severe);
  END_IF;
  n := n / divisor;
END_PROGRAM
"""


def row(server: Server, instance: int, id: str) -> dict[str, object]:
    found: dict[str, object] = next(
        each for each in server.http.get(f"/api/instances/{instance}/errors").json() if each["id"] == id
    )
    return found


def test_what_the_program_and_the_plc_raise(server: Server) -> None:
    instance = server.instance("own errors", MODEL, main=SOURCE)
    with server.browser(instance) as browser:
        browser.watch("A400", "Main.n")
        assert browser.ask(type="write", path="Main.mild", value="7")["ok"]
        browser.wait(lambda: (browser.number("A400") or 0) & 0xFFFF == 0x4107)
        browser.wait(lambda: row(server, instance, "fal")["status"] == "generated")
        first = row(server, instance, "fal")
        assert (first["origin"], first["by"], first["count"], first["code"]) == ("program", "program", 1, "4107")

        assert browser.ask(type="write", path="Main.severe", value="2")["ok"]
        state = browser.wait_state("fatal")
        assert "C102" in state["message"]
        assert "main.st:6" in state["message"]
        assert not browser.ask(type="mode", mode="RUN")["ok"]
        assert browser.ask(type="recover", ids=["fals", "fal"])["ok"]
        browser.wait_state("stopped")
        for name in ("mild", "severe"):
            assert browser.ask(type="write", path=f"Main.{name}", value="0")["ok"]
        assert browser.ask(type="mode", mode="MONITOR")["ok"]
        browser.wait_state("running")

        assert browser.ask(type="write", path="Main.divisor", value="0")["ok"]
        state = browser.wait_state("trapped")
        assert "80F0" in state["message"]
        assert state["trap"]["line"] == 8
        browser.wait(lambda: row(server, instance, "program-error")["status"] == "generated")
        assert row(server, instance, "program-error")["origin"] == "plc"
        assert browser.ask(type="restart", kind="power")["ok"]
        browser.wait_state("running")
        browser.wait(lambda: row(server, instance, "program-error")["status"] == "cleared")
