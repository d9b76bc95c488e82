"""Everybody sees what is forced, and by whom: at once, and when they come later."""

from tests.web.server import Server
from tests.web.test_live import COUNT, MODEL


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
