"""Any command by one REST route, as on the WebSocket: done, or refused with what is wrong."""

from itertools import count

import pytest

from tests.web.server import Server
from tests.web.test_live import COUNT, MODEL

_NUMBERS = count()
WRONG: dict[str, tuple[dict[str, object], str]] = {
    "no type": ({"path": "Main.level"}, "type is missing"),
    "unknown type": ({"type": "burn"}, "there is no burn; there are write, force, release"),
    "unknown field": ({"type": "release", "path": None, "through": 1}, "release.through is unknown"),
    "missing field": ({"type": "write", "path": "Main.level"}, "write.value is missing"),
    "field of another command": (
        {"type": "generate", "errors": [{"id": "battery-error"}], "ids": []},
        "generate.ids is unknown",
    ),
    "value of another type": ({"type": "restart", "kind": "hot"}, "restart.kind has to be one of these: cold"),
    "too large a number": ({"type": "disturb", "kind": "late", "scans": 10**30}, "disturb.scans: "),
}


@pytest.fixture
def path(server: Server) -> str:
    return f"/api/instances/{server.instance(f'commands {next(_NUMBERS)}', MODEL, main=COUNT)}"


def test_a_command_by_its_type(server: Server, path: str) -> None:
    def done(type: str, **fields: object) -> None:
        reply = server.http.post(f"{path}/commands", json={"type": type, **fields})
        assert reply.status_code == 200, reply.text
        assert reply.json()["ok"], reply.text

    assert server.http.post(f"{path}/run", json={"action": "pause"}).json()["ok"]
    done("generate", errors=[{"id": "battery-error"}])
    done("force", path="Main.level", value="3")
    done("disturb", kind="flip", path="Main.level", bit=0, scan=1 << 40)
    done("arm", errors=[{"id": "plc-setup-error"}], start={"kind": "condition", "condition": "Main.level > 30000"})
    errors = {row["id"]: row["status"] for row in server.http.get(f"{path}/errors").json()}
    assert errors["battery-error"] == "generated"
    (force,) = server.http.get(f"{path}/forces").json()
    assert (force["path"], force["value"]) == ("Main.level", "3")
    assert [each["kind"] for each in server.http.get(f"{path}/disturbances").json()] == ["flip"]
    assert len(server.http.get(f"{path}/errors/armed").json()) == 1
    for type, fields in {"calm": {}, "disarm": {}, "release": {"path": None}, "recover": {"ids": None}}.items():
        done(type, **fields)
    assert server.http.get(f"{path}/forces").json() == server.http.get(f"{path}/disturbances").json() == []


def test_what_is_present_is_skipped_and_the_log_has_pages(server: Server, path: str) -> None:
    def post(type: str, *ids: str) -> int:
        body = {"type": type, "errors": [{"id": id} for id in ids]}
        return server.http.post(f"{path}/commands", json=body).status_code

    assert post("generate", "battery-error") == 200
    assert post("generate", "battery-error", "plc-setup-error") == 422
    assert post("generate_absent", "battery-error", "plc-setup-error") == 200
    page = server.http.get(f"{path}/log", params={"kind": "error", "count": 1}).json()
    assert (page["first"], page["total"], page["kept"]) == (1, 2, 1_000_000)
    assert [line["text"] for line in page["lines"]] == ["generated plc-setup-error (address=0), code 009B"]
    (first,) = server.http.get(f"{path}/log", params={"kind": "error", "first": 0, "count": 1}).json()["lines"]
    assert first["text"].startswith("generated battery-error")


def test_what_is_no_command_is_refused_by_name(server: Server, path: str) -> None:
    for wrong, (body, message) in WRONG.items():
        reply = server.http.post(f"{path}/commands", json=body)
        assert reply.status_code == 422, wrong
        assert reply.json()["message"].startswith(message), wrong


def test_what_the_plc_refuses_names_what_was_perhaps_meant(server: Server, path: str) -> None:
    reply = server.http.post(f"{path}/commands", json={"type": "write", "path": "Main.levle", "value": "1"})
    assert (reply.status_code, reply.json()["near"]) == (422, ["Main.level"]), reply.text


def test_the_socket_takes_the_same(server: Server, path: str) -> None:
    with server.browser(int(path.rpartition("/")[2])) as browser:
        disturbed = browser.ask(type="disturb", kind="flip", path="Main.level", bit=0, scan=1 << 40)
        assert disturbed["ok"], disturbed
        assert browser.ask(type="calm")["ok"]
        refused = browser.ask(type="burn")
        assert not refused["ok"]
        assert refused["message"].startswith("not a message of this server: there is no burn; there are watch, ")
