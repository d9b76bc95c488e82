"""A project goes out as one file, and comes in again as a project."""

import io
import zipfile
from pathlib import Path

import httpx
import pytest

from scanbench.web.messages_projects import ExchangeFile
from tests.web.server import Server

MAIN = "PROGRAM Main\nVAR n : INT; END_VAR\nn := n + 1;\nEND_PROGRAM\n"


def test_a_project_goes_out_and_comes_in_again(server: Server) -> None:
    project = server.project("Füllen", "CJ1M-CPU63", Main=MAIN)
    panel = {"text": '{"version": 1, "elements": []}', "version": 0}
    assert server.http.put(f"/api/projects/{project}/files/Belt.panel.json", json=panel).status_code == 200
    reply = server.http.get(f"/api/projects/{project}/archive")
    assert reply.status_code == 200, reply.text
    assert "F%C3%BCllen.zip" in reply.headers["content-disposition"]
    found = server.http.post("/api/archives", content=reply.content).json()
    files = ["Main.st", "Belt.panel.json"]
    assert found == {"name": "Füllen", "model": "CJ1M-CPU63", "files": files, "left_out": [], "notes": []}
    made = server.http.post(
        "/api/archives/projects", params={"name": "again", "model": found["model"]}, content=reply.content
    )
    assert made.status_code == 201, made.text
    again = made.json()["id"]
    assert server.http.get(f"/api/projects/{again}/files/Main.st").json()["text"] == MAIN
    assert server.http.get(f"/api/projects/{again}/files/Belt.panel.json").json()["text"] == panel["text"]
    assert server.http.post(f"/api/projects/{again}/build", json={}).json()["ok"]


def test_a_program_goes_out_in_both_forms_of_xml_with_what_they_leave_out(server: Server) -> None:
    chart = "PROGRAM Chart\nINITIAL_STEP A: END_STEP\nTRANSITION FROM A TO A := TRUE; END_TRANSITION\nEND_PROGRAM\n"
    project = server.project("Out", "GENERIC-IEC", Main=MAIN, Chart=chart)

    def written(form: str) -> ExchangeFile:
        reply = server.http.get(f"/api/projects/{project}/plcopen", params={"form": form})
        assert reply.status_code == 200, reply.text
        return ExchangeFile(**reply.json())

    whole, part = written("tc6"), written("iec61131-10")
    assert (whole.name, whole.left_out) == ("Out.xml", [])
    assert part.left_out == ["Chart, the whole of it: a chart, whose form in IEC 61131-10 is not known here"]
    assert server.http.post("/api/archives", content=whole.text.encode()).json()["files"] == ["Chart.st", "Main.st"]
    assert server.http.post("/api/archives", content=part.text.encode()).json()["files"] == ["Main.st"]


def test_a_plcopen_file_becomes_a_project_that_runs(server: Server) -> None:
    line = (Path(__file__).parent.parent / "syntax" / "plcopen" / "line.xml").read_bytes()
    found = server.http.post("/api/archives", content=line).json()
    assert (found["name"], len(found["files"]), found["notes"]) == ("Line", 5, [])
    project = _taken(server, "Line", line)
    assert server.http.post(f"/api/projects/{project}/build", json={}).json()["ok"]


def test_what_was_left_out_of_an_imported_project_can_be_read_later(server: Server) -> None:
    line = (Path(__file__).parent.parent / "syntax" / "l5x" / "line.L5X").read_bytes()
    project = _taken(server, "Logix", line)
    told = server.http.get(f"/api/projects/{project}/files/ImportNotes.st").json()["text"]
    assert "// MainProgram.Drawn: the routine Drawn is written in FBD; it is left out\n" in told
    problems = server.http.post(f"/api/projects/{project}/check", json={"files": {}}).json()["problems"]
    assert [each for each in problems if each["file"] == "ImportNotes.st"] == []


def test_an_imported_project_has_the_dialect_of_its_files_and_a_packed_one_its_own(server: Server) -> None:
    pou = '<TcPlcObject><POU Name="Main"><Declaration><![CDATA[PROGRAM Main\nVAR w : WORD; END_VAR]]></Declaration>'
    pou += "<Implementation><ST><![CDATA[w := w + 1;]]></ST></Implementation></POU></TcPlcObject>"
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w") as archive:
        archive.writestr("Main.TcPOU", pou)
    first = _taken(server, "tc", made.getvalue())
    assert server.http.get(f"/api/projects/{first}/dialect").json() == {"dialect": "twincat"}
    problems = server.http.post(f"/api/projects/{first}/check", json={"files": {}}).json()["problems"]
    assert [(each["code"], each["severity"]) for each in problems] == [("W006", "warning")]
    assert server.http.put(f"/api/projects/{first}/dialect", json={"dialect": "iec"}).json() == {"dialect": "iec"}
    problems = server.http.post(f"/api/projects/{first}/check", json={"files": {}}).json()["problems"]
    assert [(each["code"], each["severity"]) for each in problems] == [("T002", "error")]
    again = _taken(server, "tc again", server.http.get(f"/api/projects/{first}/archive").content)
    assert server.http.get(f"/api/projects/{again}/dialect").json() == {"dialect": "iec"}
    assert server.http.put(f"/api/projects/{first}/dialect", json={"dialect": "basic"}).status_code == 422


def test_the_policies_of_subranges_are_read_and_written_beside_the_dialect(server: Server) -> None:
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w") as archive:
        archive.writestr("Main.st", "PROGRAM Main\nVAR x : INT (0..10); y : INT; END_VAR\nx := y;\nEND_PROGRAM\n")
    at = f"/api/projects/{_taken(server, 'subranges', made.getvalue())}"
    assert server.http.get(f"{at}/subranges").json() == {"policies": {}}
    server.http.put(f"{at}/dialect", json={"dialect": "codesys"})
    wanted = {"policies": {"*": "report", "Main.x": "trap"}}
    assert server.http.put(f"{at}/subranges", json=wanted).json() == wanted
    assert server.http.get(f"{at}/subranges").json() == wanted
    assert server.http.get(f"{at}/dialect").json() == {"dialect": "codesys"}
    assert server.http.post(f"{at}/check", json={"files": {}}).json()["problems"] == []
    for wrong in (
        {"nope": "trap"},
        {"Main.z": "trap"},
        {"no name": "trap"},
        {"Main.x": "trap", "MAIN.X": "off"},
        {"*": "explode"},
    ):
        refused = server.http.put(f"{at}/subranges", json={"policies": wrong})
        assert refused.status_code == 422
        assert refused.json()["message"]
    assert server.http.get(f"{at}/subranges").json() == wanted
    assert server.http.put(f"{at}/subranges", json={"policies": {}}).json() == {"policies": {}}


def test_an_imported_project_gets_the_libraries_that_it_uses_and_more_on_request(server: Server) -> None:
    text = "PROGRAM Main\nVAR s : Tc2_System.T_MaxString; b : BOOL; END_VAR\nTestAndSet(b);\nEND_PROGRAM\n"
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w") as archive:
        archive.writestr("Main.st", text)
    project = _taken(server, "with libraries", made.getvalue())

    def of_project() -> dict[str, tuple[bool, bool]]:
        found = server.http.get(f"/api/projects/{project}/libraries").json()
        return {each["name"]: (each["added"], each["used"]) for each in found}

    assert of_project()["Tc2_System"] == (True, False)
    assert (
        server.http.get(f"/api/projects/{project}/files/libraries/Tc2_System.st")
        .json()["text"]
        .startswith("(* Tc2_System")
    )
    assert server.http.post(f"/api/projects/{project}/libraries/util").json()["path"] == "libraries/Util.st"
    assert server.http.post(f"/api/projects/{project}/libraries/util").status_code == 409
    assert server.http.post(f"/api/projects/{project}/libraries/nothing").status_code == 404
    assert of_project()["Util"] == (True, False)
    report = server.http.get(f"/api/projects/{project}/report")
    assert report.headers["content-type"].startswith("text/html")
    assert "1 of 1 POUs (100.0 %) run" in report.text
    assert "default-src 'none'" in report.headers["content-security-policy"]


def _taken(server: Server, name: str, content: bytes) -> int:
    params = {"name": name, "model": "GENERIC-IEC"}
    reply = server.http.post("/api/archives/projects", params=params, content=content)
    assert reply.status_code == 201, reply.text
    project: int = reply.json()["id"]
    return project


@pytest.mark.parametrize(
    ("params", "content", "why"),
    [
        ({"name": "x", "model": "CJ1M-CPU63"}, b"nonsense", "neither a zip file nor XML"),
        ({"name": " ", "model": "CJ1M-CPU63"}, b"", "1 to 100 characters"),
    ],
)
def test_what_cannot_be_taken_makes_no_project(
    server: Server, params: dict[str, str], content: bytes, why: str
) -> None:
    before = server.http.get("/api/projects").json()
    reply: httpx.Response = server.http.post("/api/archives/projects", params=params, content=content)
    assert reply.status_code == 422
    assert why in reply.json()["message"]
    assert server.http.get("/api/projects").json() == before


def test_a_project_begins_with_a_template(server: Server) -> None:
    known = {each["id"]: each for each in server.http.get("/api/templates").json()}
    assert {"error-handler", "instruction-list", "sequence", "conveyor", "dosing", "filling"} == set(known)
    for each in known.values():
        new = {"name": f"from {each['id']}", "model": each["model"], "template": each["id"]}
        made = server.http.post("/api/projects", json=new)
        assert made.status_code == 201, made.text
        address = f"/api/projects/{made.json()['id']}"
        assert {file["path"] for file in server.http.get(f"{address}/files").json()} == set(each["files"])
        assert server.http.post(f"{address}/build", json={}).json()["ok"]
    unknown = server.http.post("/api/projects", json={"name": "x", "model": "GENERIC-IEC", "template": "no such"})
    assert (unknown.status_code, "sequence" in unknown.json()["near"]) == (422, True)
