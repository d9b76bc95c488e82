"""Files, checks, builds: REST, and what the people at the PLC see of it."""

from tests.web.server import Server

ONE = "PROGRAM Main\nVAR\n  n : DINT; kept : INT; changed : INT;\nEND_VAR\n  n := n + 1;\nEND_PROGRAM\n"
TWO = "PROGRAM Main\nVAR\n  kept : INT; more : DINT; n : DINT; changed : REAL;\nEND_VAR\n  n := n + 1; more := -n;\nEND_PROGRAM\n"
BAD = "PROGRAM Main\nVAR\n  n : DINT;\nEND_VAR\n  n := n + ;\n  m := 1;\nEND_PROGRAM\n"


def test_check_finds_problems_with_places_and_stores_nothing(server: Server) -> None:
    project = server.project("checked", "GENERIC-IEC", main=ONE)
    result = server.http.post(f"/api/projects/{project}/check", json={"files": {"main.st": BAD}}).json()
    places = [(each["severity"], each["file"], each["line"]) for each in result["problems"]]
    assert ("error", "main.st", 5) in places
    assert ("error", "main.st", 6) in places
    assert [(each["name"], each["kind"]) for each in result["pous"]] == [("Main", "program")]
    assert server.http.get(f"/api/projects/{project}/files/main.st").json()["text"] == ONE


def test_a_conflict_shows_theirs(server: Server) -> None:
    project = server.project("conflict", "GENERIC-IEC", main=ONE)
    address = f"/api/projects/{project}/files/main.st"
    file = server.http.put(address, json={"text": TWO, "version": 1}).json()
    assert file.pop("saved")
    assert file == {"path": "main.st", "version": 2, "author": "Guest"}
    late = server.http.put(address, json={"text": BAD, "version": 1})
    assert late.status_code == 409
    assert late.json()["theirs"].items() >= {**file, "text": TWO}.items()
    assert server.http.get(address).json()["text"] == TWO


def test_build_swaps_and_keeps_values_and_errors_refuse_it(server: Server) -> None:
    project = server.project("built", "GENERIC-IEC", main=ONE)
    instance = server.http.post("/api/instances", json={"project": project, "name": "built"}).json()["id"]
    address = f"/api/projects/{project}/files/main.st"
    with server.browser(instance) as browser:
        browser.watch("Main.n", "Main.kept", "Main.changed")
        browser.ask(type="write", path="Main.kept", value="5")
        browser.ask(type="write", path="Main.changed", value="6")
        browser.wait(lambda: (browser.number("Main.n") or 0) > 30)

        server.http.put(address, json={"text": BAD, "version": 1})
        assert browser.wait_for("saved")["file"].items() >= {"path": "main.st", "version": 2, "author": "Guest"}.items()
        refused = server.http.post(f"/api/projects/{project}/build").json()
        assert not refused["ok"]
        assert "main.st:5" in refused["message"]
        assert not browser.wait_for("built")["result"]["ok"]
        n = browser.number("Main.n") or 0
        browser.wait(lambda: (browser.number("Main.n") or 0) > n + 10)  # the old program goes on
        assert server.state(instance)["program_version"] == 1

        server.http.put(address, json={"text": TWO, "version": 2})
        asked = server.http.post(f"/api/projects/{project}/build").json()
        assert (asked["ok"], asked["needs_agreement"]) == (False, True)  # Main.changed is a REAL now
        built = server.http.post(f"/api/projects/{project}/build", json={"agreed": True}).json()
        assert built["ok"], built
        assert "2 variables kept" in built["message"]
        assert built["project"]["version"] == 2
        moved = browser.wait_for("watching", ref=None)
        changed = next(item for item in moved["items"] if item["path"] == "Main.changed")
        assert changed["symbol"]["type"] == "REAL"
        browser.watch("Main.more")
        browser.wait(lambda: (browser.number("Main.more") or 0) < -n)
        assert browser.number("Main.kept") == 5
        assert browser.number("Main.changed") == 0
        assert server.state(instance)["program_version"] == 2


def test_versions_keep_who_built_what(server: Server) -> None:
    project = server.project("versions", "GENERIC-IEC", main=ONE)
    address = f"/api/projects/{project}"
    assert server.http.get(f"{address}/versions").json() == []
    assert server.http.post(f"{address}/build", json={}).json()["ok"]
    server.http.put(f"{address}/files/main.st", json={"text": TWO, "version": 1})
    assert server.http.post(f"{address}/build", json={}).json()["ok"]
    found = server.http.get(f"{address}/versions").json()
    assert [(each["version"], each["author"]) for each in found] == [(2, "Guest"), (1, "Guest")]
    assert server.http.get(f"{address}/versions/1").json() == {"version": 1, "files": {"main.st": ONE}}
    assert server.http.get(f"{address}/versions/3").status_code == 404


def test_a_version_has_a_message_and_a_label(server: Server) -> None:
    project = server.project("labels", "GENERIC-IEC", main=ONE)
    address = f"/api/projects/{project}"
    assert server.http.post(f"{address}/build", json={"message": "counts"}).json()["ok"]
    labelled = server.http.patch(f"{address}/versions/1", json={"label": "FAT 1"}).json()
    assert (labelled["label"], labelled["message"]) == ("FAT 1", "counts")
    assert server.http.patch(f"{address}/versions/1", json={"message": ""}).json()["label"] == "FAT 1"
    assert [(each["label"], each["message"]) for each in server.http.get(f"{address}/versions").json()] == [
        ("FAT 1", "")
    ]
    assert server.http.patch(f"{address}/versions/2", json={"label": "x"}).status_code == 404


def test_a_deletion_is_told_with_its_author(server: Server) -> None:
    project = server.project("deleted", "GENERIC-IEC", main=ONE, other=TWO.replace("Main", "Other"))
    instance = server.http.post("/api/instances", json={"project": project, "name": "deleted"}).json()["id"]
    address = f"/api/projects/{project}/files/other.st"
    with server.browser(instance) as browser:
        assert server.http.delete(address, params={"scanbench_user": "Jo"}).status_code == 204
        told = browser.wait_for("deleted")
        assert (told["path"], told["author"]) == ("other.st", "Jo")
        assert [each["path"] for each in server.http.get(f"/api/projects/{project}/files").json()] == ["main.st"]
        late = server.http.put(address, json={"text": ONE, "version": 1})
        assert late.status_code == 409
        assert late.json()["theirs"] == {"path": "other.st", "version": 0, "author": "", "text": "", "saved": ""}


def test_a_trapped_plc_runs_again_with_the_corrected_program(server: Server) -> None:
    source = "PROGRAM Main\nVAR d : INT; q : INT; END_VAR\n  q := 1 / d;\nEND_PROGRAM\n"
    project = server.project("corrected", "GENERIC-IEC", main=source)
    instance = server.http.post("/api/instances", json={"project": project, "name": "corrected"}).json()["id"]
    with server.browser(instance) as browser:
        if browser.hello["instance"]["state"]["state"] != "trapped":
            browser.wait_state("trapped")
        right = {"text": source.replace("d : INT", "d : INT := 1"), "version": 1}
        server.http.put(f"/api/projects/{project}/files/main.st", json=right)
        assert server.http.post(f"/api/projects/{project}/build").json()["ok"]
        browser.wait_state("running")


def test_symbols_and_completion(server: Server) -> None:
    app = server.http.get("/api").json()
    line = next(each["id"] for each in app["instances"] if each["name"] == "line-1")
    roots = [each["name"] for each in server.http.get(f"/api/instances/{line}/symbols").json()]
    assert "Main" in roots
    assert "motor" in roots
    below = server.http.get(f"/api/instances/{line}/symbols", params={"path": "Main.buffer"}).json()
    assert {"level", "limit"} <= {each["name"] for each in below}
    found = server.http.get(f"/api/instances/{line}/complete", params={"text": "main.bel"}).json()
    assert [each["path"] for each in found] == ["Main.belt"]
    raw = server.http.get(f"/api/instances/{line}/complete", params={"text": "D100"}).json()
    assert raw[0]["address"] == "D100"
    missing = server.http.get(f"/api/instances/{line}/symbols", params={"path": "Main.bufer"})
    assert missing.status_code == 422
    assert missing.json()["near"] == ["Main.buffer"]


def test_refusals_say_what_to_do(server: Server) -> None:
    http = server.http
    unknown = http.post("/api/projects", json={"name": "x", "model": "CJ9"})
    assert unknown.status_code == 422
    assert "CJ1M-CPU63" in unknown.json()["near"]
    assert http.get("/api/projects/999/files").status_code == 404
    assert http.get("/api/instances/999").status_code == 404
    assert http.post("/api/projects", json={"nam": "x"}).status_code == 422
    project = server.project("taken", "GENERIC-IEC", main=BAD)
    assert http.post("/api/projects", json={"name": "taken", "model": "GENERIC-IEC"}).status_code == 409
    unrunnable = http.post("/api/instances", json={"project": project, "name": "unrunnable"})
    assert unrunnable.status_code == 422
    assert "main.st:5" in unrunnable.json()["message"]
    bad_path = http.put(f"/api/projects/{project}/files/../x", json={"text": "", "version": 0})
    assert bad_path.status_code in (404, 405, 422)
    assert http.put(f"/api/projects/{project}/files/notes.txt", json={"text": "", "version": 0}).status_code == 422


def test_deleting(server: Server) -> None:
    instance = server.instance("gone", "GENERIC-IEC", main=ONE)
    project = server.http.get(f"/api/instances/{instance}").json()["project"]["id"]
    assert server.http.delete(f"/api/projects/{project}").status_code == 422
    assert server.http.delete(f"/api/instances/{instance}").status_code == 204
    assert server.http.get(f"/api/instances/{instance}").status_code == 404
    assert server.http.delete(f"/api/projects/{project}/files/main.st").status_code == 204
    assert server.http.delete(f"/api/projects/{project}").status_code == 204


def test_models(server: Server) -> None:
    names = [each["name"] for each in server.http.get("/api/models").json()]
    assert {"CJ1M-CPU63", "GENERIC-IEC"} <= set(names)
    model = server.http.get("/api/models/CJ1M-CPU63").json()
    assert model["code_word"] == "A400"
    areas = [(each["name"], each["first"], each["tool"]) for each in model["areas"]]
    assert ("A", "A0", "read") in areas
    assert ("A", "A448", "write") in areas


def test_files_of_vendors_are_program_files(server: Server) -> None:
    project = server.project(
        "vendor", "GENERIC-IEC", main="PROGRAM Main\nVAR x : INT; END_VAR\nx := IO.cnt + z;\nEND_PROGRAM"
    )
    address = f"/api/projects/{project}/files"
    text = '<TcPlcObject><GVL Name="IO"><Declaration><![CDATA[VAR_GLOBAL\ncnt : INT; END_VAR]]></Declaration></GVL></TcPlcObject>'
    assert server.http.put(f"{address}/IO.TcGVL", json={"text": text, "version": 0}).status_code == 200
    refused = server.http.put(f"{address}/notes.txt", json={"text": "", "version": 0})
    assert refused.status_code >= 400
    assert "name it like motor.st, or .iecst, .exp, .tcpou" in refused.text
    result = server.http.post(f"/api/projects/{project}/check", json={"files": {}}).json()
    assert [(each["file"], each["line"], each["code"]) for each in result["problems"]] == [("main.st", 3, "T001")]
    assert ("IO.TcGVL", "cnt") in [(each["file"], each["name"]) for each in result["pous"]]


def test_a_new_project_says_what_a_watch_list_begins_with(server: Server) -> None:
    made = server.http.post("/api/projects", json={"name": "watched", "model": "GENERIC-IEC", "watch": ["Main.n"]})
    assert made.status_code == 201, made.text
    assert made.json()["watch"] == ["Main.n"]
    found = server.http.get("/api/projects").json()
    assert [each["watch"] for each in found if each["name"] == "watched"] == [["Main.n"]]


def test_an_operator_panel_is_a_file_of_the_project_and_no_part_of_its_program(server: Server) -> None:
    project = server.project("panels", "CJ1M-CPU63", main=ONE)
    address = f"/api/projects/{project}"
    assert server.http.post(f"{address}/build", json={}).json()["ok"]
    panel = f"{address}/files/Belt.panel.json"
    assert server.http.put(panel, json={"text": '{"version": 1, "elements": []}', "version": 0}).status_code == 200
    again = server.http.post(f"{address}/build", json={}).json()
    assert (again["ok"], again["project"]["version"]) == (True, 1)
    assert server.http.post(f"{address}/check", json={"files": {}}).json()["problems"] == []
    for text, why in (("{", "no JSON text: Expecting property name"), ("[]", "has to be a JSON object")):
        refused = server.http.put(panel, json={"text": text, "version": 1})
        assert refused.status_code == 422
        assert why in refused.json()["message"]


def test_the_terminals_of_a_plc(server: Server) -> None:
    project = server.project(
        "rack", "CJ1M-CPU63", main="PROGRAM Main\nVAR start AT CIO 0.03 : BOOL; END_VAR\nEND_PROGRAM\n"
    )
    hardware = '{"version": 1, "fitted": [{"kind": "basic-io-unit", "rack": 0, "slot": 2, "words": "CIO 0", "name": "Photo eyes"}]}'
    server.http.put(f"/api/projects/{project}/files/hardware.json", json={"text": hardware, "version": 0})
    instance = server.http.post("/api/instances", json={"project": project, "name": "rack"}).json()["id"]
    server.made.append(instance)
    channels = server.http.get(f"/api/instances/{instance}/rack").json()
    assert [(each["address"], each["side"], len(each["terminals"])) for each in channels] == [
        ("CIO0", "input", 16),
        ("CIO100", "output", 16),
    ]
    assert [(each["path"], each["address"]) for each in channels[0]["terminals"]][2:4] == [
        ("CIO0.02", "CIO0.02"),
        ("Main.start", "CIO0.03"),
    ]
    unit = {"kind": "basic-io-unit", "number": None, "rack": 0, "slot": 2, "name": "Photo eyes"}
    assert [each["unit"] for each in channels] == [unit, None]


def test_the_numbers_that_a_program_raises_errors_with_are_found_when_asked_for(server: Server) -> None:
    project = server.project(
        "raising", "CJ1M-CPU13", main="PROGRAM Main\nFAL(N := 42, S := 'PUMP HOT');\nEND_PROGRAM\n"
    )
    address = f"/api/projects/{project}/check"
    assert server.http.post(address, json={"files": {}}).json().get("numbers") is None
    found = {"kind": "fal", "number": 42, "text": "PUMP HOT", "file": "main.st", "line": 2}
    assert server.http.post(address, json={"files": {}, "numbers": True}).json()["numbers"] == [found]
    broken = {"files": {"hardware.json": "{"}, "numbers": True}
    assert server.http.post(address, json=broken).json()["numbers"] == [found]
    edited = {"files": {"main.st": "PROGRAM Main\nFAL(;\nEND_PROGRAM\n"}, "numbers": True}
    assert server.http.post(address, json=edited).json().get("numbers") is None
