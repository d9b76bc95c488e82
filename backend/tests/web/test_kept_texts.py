"""What users wrote passes byte for byte, also to who reads Japanese and where it is full of sentences that Scanbench says itself."""

import json
from collections import defaultdict
from typing import cast

import pytest
from pydantic import TypeAdapter
from websockets.sync.client import ClientConnection, connect

from scanbench.translation.said import say
from scanbench.web.openapi import document
from scanbench.web.spoken_fields import PUBLIC, SHAPES, WIRE
from tests.web.server import Message, Server

JA = {"Accept-Language": "ja"}
SAID = "nothing was changed"
"""A sentence of the catalogue; `test_it_is_a_sentence` says so."""
TEXT = f"(* {SAID} *)\nPROGRAM Main\nVAR n : INT; (* switched on *) END_VAR\n(*\n{SAID}\n*)\nn := n + 1;\nEND_PROGRAM\n"
PANEL = json.dumps({"version": 1, "elements": [], "title": SAID, "message": SAID, "near": [SAID]})
ERRORS = {
    "id": "pump-hot", "group": [SAID], "code": "4101", "flag": "W10.00", "severity": "nonfatal", "priority": "300",
    "source": SAID, "texts": [{"language": "en", "name": SAID, "description": SAID}, {"language": "ja", "name": SAID, "description": SAID}],
    "details": [],
}  # fmt: skip


@pytest.fixture
def written(server: Server) -> tuple[int, int]:
    """An instance and its project, with that sentence wherever somebody may write."""
    instance = server.instance(SAID, "CJ1M-CPU63", Main=TEXT)
    project = int(server.http.get(f"/api/instances/{instance}").json()["project"]["id"])
    address = f"/api/projects/{project}"
    server.http.put(f"{address}/files/P.panel.json", json={"text": PANEL, "version": 0}).raise_for_status()
    server.http.put(f"{address}/user-errors", json={"version": 0, "errors": [ERRORS]}).raise_for_status()
    built = server.http.post(f"{address}/build", json={"agreed": True, "message": SAID}).raise_for_status().json()
    assert built["ok"], built
    version = server.http.get(f"{address}/versions").json()[0]["version"]
    server.http.patch(f"{address}/versions/{version}", json={"label": SAID, "message": SAID}).raise_for_status()
    server.http.put(f"{address}/files/{SAID}.st", json={"text": SAID, "version": 0}).raise_for_status()
    server.http.post(f"{address}/git").raise_for_status()
    server.http.post(f"{address}/git/commits", json={"message": SAID}).raise_for_status()
    watched = {"name": SAID, "shared": True, "groups": [SAID], "entries": [{"path": "Main.n", "group": SAID}]}
    answer = server.http.post(f"{address}/watch-lists", json=watched)
    assert answer.status_code == 201, answer.text
    return instance, project


def test_it_is_a_sentence() -> None:
    assert say(SAID, "ja") == "何も変更していません"


def test_every_route_that_answers_what_users_wrote(server: Server, written: tuple[int, int]) -> None:
    instance, project = written
    address = f"/api/projects/{project}"
    versions = server.http.get(f"{address}/versions").json()
    commits = server.http.get(f"{address}/git/commits").json()
    lists = server.http.get(f"{address}/watch-lists").json()
    version = server.state(instance)["program_version"]
    routes = [
        "/api/projects", address.replace(f"/{project}", ""), f"{address}/files", f"{address}/files/Main.st", f"{address}/files/P.panel.json",
        f"{address}/files/{SAID}.st", f"{address}/files/errors.xml", f"{address}/archive", f"{address}/user-errors", f"{address}/user-errors/export",
        f"{address}/versions", *(f"{address}/versions/{each['version']}" for each in versions), f"{address}/git", f"{address}/git/commits",
        *(f"{address}/git/commits/{each['commit']}" for each in commits), f"{address}/watch-lists",
        *(f"/api/watch-lists/{each['id']}" for each in lists), f"/api/instances/{instance}/program?version={version}", f"/api/instances/{instance}/model",
        "/api/models",
    ]  # fmt: skip
    for route in routes:
        english, japanese = server.http.get(route), server.http.get(route, headers=JA)
        assert english.status_code == 200, (route, english.text)
        assert japanese.content == english.content, route


def test_a_conflict_is_told_in_japanese_and_their_text_is_theirs(server: Server, written: tuple[int, int]) -> None:
    route = f"/api/projects/{written[1]}/files/{SAID}.st"
    late = {"text": "", "version": 0}
    english = server.http.put(route, json=late)
    japanese = server.http.put(route, json=late, headers=JA)
    assert english.status_code == japanese.status_code == 409
    assert japanese.json()["theirs"] == english.json()["theirs"]
    assert japanese.json()["theirs"]["text"] == SAID
    assert japanese.json()["message"] != english.json()["message"]


def test_archives_that_are_looked_into(server: Server, written: tuple[int, int]) -> None:
    content = server.http.get(f"/api/projects/{written[1]}/archive").content
    found = [server.http.post("/api/archives", content=content, headers=headers).content for headers in ({}, JA)]
    assert found[0] == found[1]
    assert SAID.encode() in found[0]


def test_drafts_and_people_on_the_socket(server: Server, written: tuple[int, int]) -> None:
    instance, _ = written
    told: dict[str, list[Message]] = {}
    for language in ("en", "ja"):
        with _socket(server, instance, language) as socket:
            socket.send(json.dumps({"type": "open_draft", "ref": 1, "path": f"{SAID}.st"}))
            told[language] = [_next(socket, "people"), _next(socket, "draft")]
    (english, draft), (japanese, same) = told["en"], told["ja"]
    assert same == draft
    assert draft["path"] == f"{SAID}.st"
    assert [each["name"] for each in japanese["people"]] == [each["name"] for each in english["people"]] == [SAID]


def test_what_is_typed_on_the_socket(server: Server, written: tuple[int, int]) -> None:
    instance, _ = written
    with (
        _socket(server, instance, "en") as english,
        _socket(server, instance, "ja") as japanese,
        _socket(server, instance, "en") as writer,
    ):
        for each in (english, japanese, writer):
            each.send(json.dumps({"type": "open_draft", "ref": 1, "path": "Main.st"}))
            _next(each, "draft")
        server.http.put(
            f"/api/projects/{written[1]}/files/Main.st", json={"text": f"{TEXT}(* {SAID} *)\n", "version": 1}
        ).raise_for_status()
        assert _next(english, "draft_edited") == _next(japanese, "draft_edited")


def test_shapes_are_told_apart() -> None:
    """What a shape is known by is what is sent, and nothing that is not listed looks the same."""
    schemas = cast(dict[str, dict[str, dict[str, dict[str, object]]]], document()["components"])["schemas"]
    sent = defaultdict(set)
    for name, schema in schemas.items():
        sent[frozenset(schema.get("properties", {}))].add(name)
    listed = {getattr(each, "PUBLIC", each.__name__) for each, _ in (*WIRE, *PUBLIC)}
    found = {name for keys in SHAPES for name in sent[keys]}
    assert found == listed
    for shape, name in (*WIRE, *PUBLIC):
        assert name in TypeAdapter(shape).json_schema()["properties"]


def _socket(server: Server, instance: int, language: str) -> ClientConnection:
    cookies = f"scanbench_token_{server.port}={server.token}; scanbench_language={language}"
    address = f"ws://127.0.0.1:{server.port}/api/instances/{instance}/socket?scanbench_user={SAID.replace(' ', '%20')}"
    return connect(address, additional_headers={"Cookie": cookies, "Origin": server.base}, max_queue=None)


def _next(socket: ClientConnection, kind: str) -> Message:
    while True:
        data = socket.recv(120)
        message: Message = {} if isinstance(data, bytes) else json.loads(data)
        if message.get("type") == kind:
            return message
