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
        told = ada.wait_for("forces", forces=[])
        assert told["ended"] == [{"path": "Main.level", "by": "Aiko Sato"}]


def test_who_ended_a_force_is_told_but_not_of_one_that_does_not_hold_in_the_past(server: Server) -> None:
    instance = server.instance("forces ended", MODEL, main=STEPS)
    with server.browser(instance) as ada, server.browser(instance, "Aiko Sato") as aiko:
        assert ada.ask(type="run", action="pause")["ok"]
        assert ada.ask(type="run", action="scan")["ok"]
        for path in ("Main.level", "Main.n"):
            assert ada.ask(type="force", path=path, value="3")["ok"]
        ada.wait(lambda: any(m["type"] == "forces" and len(m["forces"]) == 2 for m in ada.messages))
        assert ada.ask(type="travel", scan=0)["ok"]
        assert ada.wait_for("forces", forces=[])["ended"] == []
        assert ada.ask(type="travel", scan=None)["ok"]
        assert aiko.ask(type="release", path="Main.n")["ok"]
        ada.wait_for("forces", ended=[{"path": "Main.n", "by": "Aiko Sato"}])
        assert ada.ask(type="release", path=None)["ok"]
        aiko.wait_for("forces", ended=[{"path": "Main.level", "by": "Ada Lovelace"}])


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
