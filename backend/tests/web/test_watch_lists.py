"""Watch lists through the whole server: who sees them, who is told, and who was first."""

from tests.web.server import Message, Server

MODEL = "CJ1M-CPU63"
SOURCE = "PROGRAM Main\nVAR n : INT; END_VAR\n  n := n + 1;\nEND_PROGRAM\n"


def entry(path: str, group: str = "", format: str = "default") -> Message:
    return {"path": path, "group": group, "format": format}


def test_a_shared_list_reaches_everybody_and_a_private_one_nobody_else(server: Server) -> None:
    instance = server.instance("watch lists", MODEL, main=SOURCE)
    project = server.http.get(f"/api/instances/{instance}").json()["project"]["id"]
    at, mika, jo = f"/api/projects/{project}/watch-lists", {"scanbench_user": "Mika"}, {"scanbench_user": "Jo"}
    with server.browser(instance, "Jo") as browser:
        new = {"name": "Belt 3", "shared": True, "groups": ["g"], "entries": [entry("Main.n", "g", "hex")]}
        made = server.http.post(at, json=new, params=mika)
        assert made.status_code == 201, made.text
        shared = made.json()
        assert (shared["version"], shared["author"], shared["count"]) == (1, "Mika", 1)
        told = browser.wait_for("watch_list")
        assert (told["id"], told["version"], told["author"]) == (shared["id"], 1, "Mika")
        browser.messages.clear()
        own = server.http.post(at, json={**new, "name": "Mine", "shared": False}, params=mika).json()
        assert [each["name"] for each in server.http.get(at, params=mika).json()] == ["Belt 3", "Mine"]
        assert [each["name"] for each in server.http.get(at, params=jo).json()] == ["Belt 3"]
        for method, body in (("GET", None), ("PUT", {**new, "version": 1}), ("DELETE", None)):
            refused = server.http.request(method, f"/api/watch-lists/{own['id']}", json=body, params=jo)
            assert refused.status_code == 404, refused.text
        at_one = f"/api/watch-lists/{shared['id']}"
        saved = server.http.put(at_one, json={**new, "entries": [], "version": 1}, params=jo)
        assert saved.json()["version"] == 2
        told = browser.wait_for("watch_list")
        assert (told["id"], told["version"], told["author"]) == (shared["id"], 2, "Jo")

        late = server.http.put(at_one, json={**new, "version": 1}, params=mika)
        assert late.status_code == 409
        assert "was saved by Jo in the meantime" in late.json()["message"]
        assert late.json()["theirs"] == server.http.get(at_one).json() == saved.json()
        hidden = server.http.put(at_one, json={**new, "shared": False, "version": 2}, params=mika)
        assert hidden.status_code == 422
        assert "Duplicate it" in hidden.json()["message"]
        twice = server.http.post(at, json=new, params=mika)
        assert twice.status_code == 409
        assert "choose another name" in twice.json()["message"]
        browser.messages.clear()
        assert server.http.delete(at_one, params=mika).status_code == 204
        assert browser.wait_for("watch_list")["version"] == 0
        assert server.http.get(at_one, params=mika).status_code == 404


def test_what_is_no_list_is_refused(server: Server) -> None:
    project = server.project("no watch lists", MODEL, main=SOURCE)
    at = f"/api/projects/{project}/watch-lists"
    for body, says in (
        ({"name": "", "shared": True}, "name"),
        ({"name": "x", "shared": True, "entries": [{"path": "D1", "format": "octal"}]}, "format"),
        ({"name": "x", "shared": True, "entries": [{"path": ""}]}, "path"),
        ({"name": "x", "shared": True, "entries": [{"path": " "}]}, "path"),
    ):
        refused = server.http.post(at, json=body)
        assert refused.status_code == 422
        assert says in refused.json()["message"]
    assert server.http.get("/api/projects/99999/watch-lists").status_code == 404
