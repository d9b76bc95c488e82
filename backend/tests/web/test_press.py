"""Push buttons: what somebody holds is let go when they are gone."""

from tests.web.server import Server

MODEL = "CJ1M-CPU63"
SOURCE = (
    "PROGRAM Main\nVAR start AT CIO 0.00 : BOOL; n : INT; END_VAR\n  IF start THEN n := n + 1; END_IF;\nEND_PROGRAM\n"
)


def test_a_push_button_is_let_go_by_hand_or_by_the_end_of_the_connection(server: Server) -> None:
    instance = server.instance("press", MODEL, main=SOURCE)
    value = f"/api/instances/{instance}/value?path=Main.start"

    def start() -> str:
        found: str = server.http.get(value).json()["value"]
        return found

    with server.browser(instance, "Jo") as jo:

        def present(count: int) -> None:
            jo.wait(lambda: any(each["type"] == "users" and len(each["users"]) == count for each in jo.messages))
            jo.messages.clear()

        with server.browser(instance, "Mika") as mika:
            present(2)
            assert mika.ask(type="press", path="Main.start", down=True)["ok"]
            assert start() == "TRUE"
            assert mika.ask(type="press", path="Main.start", down=False)["ok"]
            assert start() == "FALSE"
            assert mika.ask(type="press", path="Main.start", down=True)["ok"]
            assert not mika.ask(type="press", path="Main.nothing", down=True)["ok"]
        present(1)
        assert start() == "FALSE"
