"""Everybody sees what is forced, and by whom: at once, and when they come later."""

from tests.web.server import Server
from tests.web.test_live import COUNT, MODEL

STEPS = "PROGRAM Main VAR n, level : INT; END_VAR n := n + 1; level := n; END_PROGRAM"


def test_forces_are_told_to_everybody(server: Server) -> None:
    instance = server.instance("forces", MODEL, main=COUNT)
    with server.browser(instance) as ada, server.browser(instance, "Aiko Sato") as aiko:
        ada.wait_state("running")
        assert ada.ask(type="force", path="Main.level", value="3")["ok"]
        (force,) = aiko.wait_for("forces")["forces"]
        assert (force["path"], force["value"], force["author"]) == ("Main.level", "3", "Ada Lovelace")
        assert force["after"] == "3"
        with server.browser(instance, "Late Comer") as late:
            assert [force["path"] for force in late.hello["forces"]] == ["Main.level"]
        assert aiko.ask(type="release", path="main.LEVEL")["ok"]
        ada.wait_for("forces", forces=[])


def test_forces_are_read_as_the_last_scan_left_them(server: Server) -> None:
    instance = server.instance("forces now", MODEL, main=STEPS)
    path = f"/api/instances/{instance}"
    with server.browser(instance) as ada:
        assert ada.ask(type="run", action="pause")["ok"]
        assert ada.ask(type="force", path="Main.level", value="3")["ok"]
        for _ in range(20):
            assert ada.ask(type="run", action="scan")["ok"]
            n = server.http.get(f"{path}/value", params={"path": "Main.n"}).json()["value"]
            (force,) = server.http.get(f"{path}/forces").json()
            assert force["after_program"] == n
        assert ada.ask(type="force", path="Main.n", value="100")["ok"]
        assert [each["path"] for each in server.http.get(f"{path}/forces").json()] == ["Main.level", "Main.n"]
