"""The working tree of a project over REST."""

from tests.web.server import Server

MAIN = "PROGRAM Main\nVAR n : INT; END_VAR\nn := n + 1;\nEND_PROGRAM\n"


def test_a_project_is_committed_by_who_asks(server: Server) -> None:
    project = server.project("under git", "GENERIC-IEC", Main=MAIN)
    address = f"/api/projects/{project}/git"
    assert server.http.get(address).json()["folder"] == ""
    early = server.http.get(f"{address}/commits")
    assert (early.status_code, early.json()["message"]) == (422, "this project is not under git yet: begin that first")
    begun = server.http.post(address)
    assert begun.status_code == 201, begun.text
    assert {"path": "Main.st", "kind": "new"} in begun.json()["changes"]
    made = server.http.post(f"{address}/commits", json={"message": "first"}, params={"scanbench_user": "Jo"})
    assert made.status_code == 201, made.text
    assert (made.json()["author"], made.json()["message"]) == ("Jo", "first")
    assert [each["commit"] for each in server.http.get(f"{address}/commits").json()] == [made.json()["commit"]]
    found = server.http.get(f"{address}/commits/{made.json()['commit']}").json()
    assert found["files"] == {"Main.st": MAIN}
    assert server.http.get(f"{address}/commits/1234567").status_code == 404
    for path in ("a\0b.st", "", "a" * 256):
        odd = server.http.get(f"{address}/commits", params={"path": path})
        assert (odd.status_code, "the path" in odd.json()["message"]) == (422, True), odd.text
    assert server.http.get(address).json()["changes"] == []
    folder = server.data / "projects" / str(project)
    assert (folder / "Main.st").read_text() == MAIN
    assert server.http.delete(f"/api/projects/{project}").status_code == 204
    assert not folder.exists()
