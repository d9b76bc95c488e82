"""Errors that a project defines itself: written by REST, built, raised, and known to replays, exports and imports."""

from pathlib import Path
from typing import Any

from tests.web.server import Server

MODEL = "CJ1M-CPU63"
SOURCE = """PROGRAM Main
VAR n, seen : INT; hot AT W10.00 : BOOL; END_VAR
  n := n + 1;
  IF hot THEN seen := seen + 1; END_IF;
END_PROGRAM
"""
BROKEN = Path(__file__).parents[1] / "plcmodel" / "broken_user_errors"
PUMP: dict[str, Any] = {
    "id": "pump-hot", "group": ["Pumps"], "code": "4101", "flag": "W10.00", "severity": "nonfatal", "priority": "300",
    "texts": [{"language": "en", "name": "Pump hot"}, {"language": "ja", "name": "ポンプ過熱"}],
    "details": [
        {"name": "pump", "control": "List", "addresses": [
            {"id": "north", "type": "Bit", "address": "W12.03"},
            {"id": "south", "type": "Bit", "address": "W12.04", "value": "2", "adds": "true"},
        ]},
    ],
}  # fmt: skip


def save(server: Server, project: int, version: int, *errors: dict[str, Any]) -> Any:
    address = f"/api/projects/{project}/user-errors"
    return server.http.put(address, json={"version": version, "errors": list(errors)})


def build(server: Server, project: int) -> dict[str, Any]:
    found: dict[str, Any] = server.http.post(f"/api/projects/{project}/build", json={"agreed": True}).json()
    return found


def catalogue_of(server: Server, instance: int) -> list[dict[str, Any]]:
    groups: list[dict[str, Any]] = server.http.get(f"/api/instances/{instance}/model").json()["catalogue"]
    return groups


def test_from_the_form_to_the_memory_and_to_another_bench(server: Server) -> None:
    instance = server.instance("pumps", MODEL, main=SOURCE)
    project = server.http.get(f"/api/instances/{instance}").json()["project"]["id"]
    assert server.http.get(f"/api/projects/{project}/user-errors").json() == {
        "version": 0, "errors": [], "groups": [], "problems": [], "readable": True,
    }  # fmt: skip
    saved = save(server, project, 0, PUMP)
    assert saved.status_code == 200, saved.text
    assert saved.json()["version"] == 1
    assert saved.json()["errors"][0]["details"][0]["addresses"][1]["value"] == "2"
    with server.browser(instance) as browser:
        browser.watch("A400", "W10", "W12", "Main.seen")
        refused = browser.ask(type="generate", errors=[{"id": "pump-hot"}])
        assert not refused["ok"]  # saved is not built
        assert build(server, project)["ok"]
        assert catalogue_of(server, instance)[-1]["name"] == "User-defined"
        done = browser.ask(type="generate", errors=[{"id": "pump-hot", "details": {"pump": "south"}}])
        assert done["ok"], done
        browser.wait(lambda: (browser.number("A400"), browser.number("W10"), browser.number("W12")) == (0x4103, 1, 16))
        browser.wait(lambda: (browser.number("Main.seen") or 0) > 3)
        (row,) = [row for row in server.http.get(f"/api/instances/{instance}/errors").json() if row["id"] == "pump-hot"]
        assert (row["status"], row["code"], row["name"]) == ("generated", "4103", "Pump hot")

        # what is present must stay what it is: nothing is swapped, the old program goes on
        assert save(server, project, 1, {**PUMP, "flag": "W10.01"}).status_code == 200
        outcome = build(server, project)
        assert not outcome["ok"]
        assert "pump-hot is generated, and the new program's catalogue has it otherwise" in outcome["message"]
        assert save(server, project, 2).status_code == 200
        outcome = build(server, project)
        assert "does not have it: recover pump-hot first" in outcome["message"]
        assert browser.ask(type="recover", ids=["pump-hot"])["ok"]
        assert build(server, project)["ok"]
        assert catalogue_of(server, instance)[-1]["name"] != "User-defined"
        assert browser.ask(type="travel", scan=5)["ok"]
        assert browser.ask(type="travel", scan=None)["ok"]

    export = server.http.get(f"/api/instances/{instance}/export").content
    there = server.http.post("/api/instances/import?name=pumps%20there", content=export)
    assert there.status_code == 201, there.text
    copied = there.json()["project"]["id"]
    assert server.http.get(f"/api/projects/{copied}/user-errors").json()["errors"] == []  # as at its end


def test_a_run_that_is_exported_while_it_is_present(server: Server) -> None:
    project = server.project("exported pumps", MODEL, main=SOURCE)
    assert save(server, project, 0, PUMP).status_code == 200
    instance = server.http.post("/api/instances", json={"project": project, "name": "exported pumps"}).json()["id"]
    with server.browser(instance) as browser:
        assert browser.ask(type="generate", errors=[{"id": "pump-hot"}])["ok"]
    export = server.http.get(f"/api/instances/{instance}/export").content
    there = server.http.post("/api/instances/import?name=imported%20pumps", content=export).json()
    assert [each["id"] for each in catalogue_of(server, there["id"])[-1]["groups"][0]["errors"]] == ["pump-hot"]
    with server.browser(there["id"]) as browser:
        browser.watch("A400", "W10")
        browser.wait(lambda: (browser.number("A400"), browser.number("W10")) == (0x4101, 1))
        assert browser.ask(type="recover", ids=None)["ok"]
        browser.wait(lambda: (browser.number("A400"), browser.number("W10")) == (0, 0))
    text = server.http.get(f"/api/projects/{there['project']['id']}/user-errors/export").text
    assert 'Id="pump-hot"' in text


def test_problems_at_fields_conflicts_and_refusals(server: Server) -> None:
    project = server.project("wrong errors", MODEL, main=SOURCE)
    address = f"/api/projects/{project}/user-errors"
    wrong = {**PUMP, "flag": "W999.00", "code": "12"}
    checked = server.http.post(f"{address}/check", json={"errors": [PUMP, wrong]}).json()["problems"]
    assert {each["path"] for each in checked} == {"errors.1.id"}
    checked = server.http.post(f"{address}/check", json={"errors": [wrong]}).json()["problems"]
    assert {each["path"] for each in checked} == {"errors.0.flag", "errors.0.code"}
    refused = save(server, project, 0, wrong)
    assert refused.status_code == 422
    assert "nothing was saved" in refused.json()["message"]
    assert server.http.get(address).json()["version"] == 0
    assert save(server, project, 0, PUMP).status_code == 200
    late = save(server, project, 0, PUMP)
    assert late.status_code == 409
    assert late.json()["theirs"]["path"] == "errors.xml"
    # the same file by the way of all files: what is wrong with it is a problem of the build
    text = server.http.get(f"/api/projects/{project}/files/errors.xml").json()["text"]
    broken = text.replace("W10.00", "W999.00")
    server.http.put(f"/api/projects/{project}/files/errors.xml", json={"text": broken, "version": 1})
    problems = build(server, project)["problems"]
    assert [(each["file"], each["code"]) for each in problems] == [("errors.xml", "M003")]
    assert problems[0]["line"] == text[: text.index("W10.00")].count("\n") + 1
    shown = server.http.get(address).json()
    assert (shown["readable"], shown["problems"][0]["path"]) == (True, "errors.0.flag")
    server.http.put(f"/api/projects/{project}/files/errors.xml", json={"text": "<UserErrors>", "version": 2})
    shown = server.http.get(address).json()
    assert (shown["readable"], shown["errors"], shown["problems"][0]["line"]) == (False, [], 1)


def test_import_is_whole_or_nothing(server: Server) -> None:
    project = server.project("imported errors", MODEL, main=SOURCE)
    address = f"/api/projects/{project}/user-errors"
    for path in sorted(BROKEN.glob("*.xml")):
        if path.stem == "GOOD":
            continue
        refused = server.http.post(f"{address}/import?version=0", content=path.read_bytes())
        assert refused.status_code == 422, path
        assert "nothing was imported: line " in refused.json()["message"], path
    for body, says in ((b"<a>\xff\xfe", "byte 3 is not UTF-8"), (b" " * 5_000_000, "the file is larger than 4 MiB")):
        refused = server.http.post(f"{address}/import?version=0", content=body)
        assert refused.status_code == 422
        assert refused.json()["message"].startswith(f"nothing was imported: {says}")
    assert server.http.get(address).json()["version"] == 0
    good = (BROKEN / "GOOD.xml").read_bytes()
    taken = server.http.post(f"{address}/import?version=0", content=good)
    assert taken.status_code == 200, taken.text
    assert [each["id"] for each in taken.json()["errors"]] == ["pump-hot"]
    assert server.http.post(f"{address}/import?version=0", content=good).status_code == 409
    twice = server.http.post(f"{address}/import?version=1&how=add", content=good)
    assert twice.status_code == 422
    assert "together with yours" in twice.json()["message"]
    other = good.replace(b'Id="pump-hot"', b'Id="pump-cold"').replace(b'"W10.00"', b'"W10.01"')
    both = server.http.post(f"{address}/import?version=1&how=add", content=other).json()
    assert [each["id"] for each in both["errors"]] == ["pump-hot", "pump-cold"]
    exported = server.http.get(f"{address}/export")
    assert exported.headers["content-disposition"] == 'attachment; filename="errors.xml"'
    again = server.http.post(f"{address}/import?version=2", content=exported.content).json()
    assert again["errors"] == both["errors"]
