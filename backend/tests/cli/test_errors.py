"""`scanbench errors`: what it lists, what a sweep says, and every way to get the call wrong."""

import json
from importlib import import_module
from importlib.resources import files
from pathlib import Path
from xml.etree import ElementTree

import pytest

from scanbench.wire.host import Sources
from tests.cli.calling import scanbench

ERRORS = import_module("scanbench.cli.errors")  # of the package, `errors` is the command
SAMPLE = str(files("scanbench").joinpath("samples/conveyor"))
SOURCE = """PROGRAM Main
VAR
  battery AT A402.04 : BOOL; inner AT A402.08 : BOOL; lamp AT CIO 100.00 : BOOL; on : BOOL; n : DINT;
END_VAR
  n := n + 1;
  IF on THEN lamp := battery; END_IF;
  IF inner THEN ; END_IF;
END_PROGRAM
"""
FEW = ("--only", "battery-error", "--only", "inner-board-error", "--only", "basic-io-error", "--only", "memory-error")


@pytest.fixture
def project(tmp_path: Path) -> Path:
    folder = tmp_path / "line"
    folder.mkdir()
    (folder / "main.st").write_text(SOURCE, "utf-8")
    (folder / "project.json").write_text('{"model": "CJ1M-CPU63"}', "utf-8")
    return folder


def states(project: Path, told: object) -> str:
    path = project.parent / "states.json"
    path.write_text(told if isinstance(told, str) else json.dumps(told), "utf-8")
    return str(path)


def test_list_names_every_error_of_a_model() -> None:
    told = json.loads(scanbench("errors", "list", "--model", "cj1m-cpu63", "--json").stdout)
    assert told["model"] == "CJ1M-CPU63"
    (memory,) = (each for each in told["errors"] if each["id"] == "memory-error")
    assert (memory["code"], memory["flag"], memory["severity"]) == ("80F1", "A401.15", "fatal")
    text = scanbench("errors", "list", "--model", "CJ1M-CPU63").stdout.splitlines()
    assert len(text) == 1 + len(told["errors"])
    assert scanbench("errors", "list", SAMPLE, "--json").stdout == json.dumps(told, ensure_ascii=False) + "\n"


def test_a_sweep_names_what_is_forgotten_and_what_is_read_in_vain(project: Path) -> None:
    result = scanbench("errors", "sweep", str(project), *FEW, "--states",
                       states(project, [{"name": "On", "scans": 30, "do": ["5: Main.on=TRUE"]}, {"name": "Off"}]), "--json")  # fmt: skip
    assert result.returncode == 1, result.stderr
    told = json.loads(result.stdout)
    cells = {(each["id"], each["state"]): each for each in told["results"]}
    assert told["states"] == [{"name": "On", "scan": 30}, {"name": "Off", "scan": 100}]
    verdicts = {key: each["verdict"] for key, each in cells.items()}
    assert verdicts == {
        ("battery-error", "On"): "acted", ("battery-error", "Off"): "not_reached",
        ("inner-board-error", "On"): "no_effect", ("inner-board-error", "Off"): "no_effect",
        ("basic-io-error", "On"): "never_read", ("basic-io-error", "Off"): "never_read",
        ("memory-error", "On"): "stopped", ("memory-error", "Off"): "stopped",
    }  # fmt: skip
    assert cells["battery-error", "On"]["readers"] == ["main.st:6"]
    (unreached,) = cells["battery-error", "Off"]["unreached"]
    assert (unreached["line"], unreached["why"], unreached["at"]) == (6, "condition", "main.st:6")
    assert [each["path"] for each in cells["battery-error", "On"]["differences"]] == ["Main.lamp"]
    assert cells["inner-board-error", "On"]["readers"] == ["main.st:7"]
    assert sorted(told["unhandled"]) == ["basic-io-error", "battery-error", "inner-board-error"]


def test_a_pair_is_tried_in_both_orders(project: Path) -> None:
    source = SOURCE.replace("lamp := battery", "lamp := battery AND inner")
    (project / "main.st").write_text(source.replace("on : BOOL", "on : BOOL := TRUE"), "utf-8")
    pair = ("--only", "battery-error", "--only", "inner-board-error")
    result = scanbench(
        "errors", "sweep", str(project), *pair, "--while", "battery-error", "--while", "inner-board-error", "--json"
    )
    assert result.returncode == 1, result.stderr
    told = json.loads(result.stdout)
    found = {(each["id"], each["state"]): each["verdict"] for each in told["results"]}
    assert found["inner-board-error", "battery-error present"] == "acted"
    assert found["battery-error", "inner-board-error present"] == "acted"
    assert found["battery-error", "Start"] == "no_effect"


def test_a_state_knows_what_outlives_a_restart(project: Path) -> None:
    (project / "main.st").write_text(SOURCE.replace("on : BOOL", "on : BOOL := TRUE"), "utf-8")
    told = [{"name": "Power was off", "scans": 30, "do": ["5: raise battery-error", "10: restart power"]}]
    result = scanbench("errors", "sweep", str(project), "--only", "battery-error", "--states", states(project, told), "--json")  # fmt: skip
    (cell,) = json.loads(result.stdout)["results"]
    assert "is present in this state already" in cell["note"]


def test_a_copy_of_error_memory_fails_a_build(project: Path) -> None:
    """`d := A400` reads every error, and does nothing about any."""
    copy = "PROGRAM Main\nVAR code AT A400 : WORD; d AT D100 : WORD; END_VAR\n  d := code;\nEND_PROGRAM\n"
    (project / "main.st").write_text(copy, "utf-8")
    result = scanbench("errors", "sweep", str(project), *FEW, "--severity", "nonfatal", "--window", "30", "--json")
    assert result.returncode == 1
    found = {each["id"]: (each["verdict"], each["scans"]) for each in json.loads(result.stdout)["results"]}
    assert found.pop("memory-error") == ("stopped", None)
    assert set(found.values()) == {("displayed", None)}
    junit = project.parent / "junit.xml"
    text = scanbench("errors", "sweep", str(project), *FEW, "--window", "30", "--junit", str(junit))
    assert "displayed in Main.d, which only tools read" in text.stdout
    failures = {each.get("type") for each in ElementTree.parse(junit).iter("failure")}
    assert failures == {"displayed"}


@pytest.mark.parametrize(
    ("options", "told", "code"),
    [
        (("--require", "acted"), None, 1),
        (("--require", "displayed"), None, 0),
        (("--require", "none"), None, 0),
        ((), {"battery-error": "displayed"}, 0),
        ((), {"battery-error": "none"}, 0),
        (("--require", "displayed"), {"battery-error": "acted"}, 1),
    ],
)
def test_what_is_required_decides_the_exit_code(
    project: Path, options: tuple[str, ...], told: dict[str, str] | None, code: int
) -> None:
    copy = "PROGRAM Main\nVAR battery AT A402.04 : BOOL; d AT D100.00 : BOOL; END_VAR\n  d := battery;\nEND_PROGRAM\n"
    (project / "main.st").write_text(copy, "utf-8")
    if told is not None:
        (project.parent / "required.json").write_text(json.dumps(told), "utf-8")
        options = (*options, "--requirements", str(project.parent / "required.json"))
    junit = project.parent / "junit.xml"
    one = ("--only", "battery-error", "--window", "20", "--junit", str(junit))
    result = scanbench("errors", "sweep", str(project), *one, *options)
    assert result.returncode == code, result.stderr
    messages = [each.get("message") for each in ElementTree.parse(junit).iter("failure")]
    assert messages == (["nonfatal error: displayed; required: acted"] if code else [])


@pytest.mark.parametrize(
    ("told", "says"),
    [
        ([], "it has to be one object"),
        ({"battery-eror": "acted"}, "battery-error"),
        ({"battery-error": "fine"}, 'battery-error: "fine" is no grade; there are acted, decided, displayed'),
    ],
)
def test_a_file_of_requirements_with_a_typing_error(project: Path, told: object, says: str) -> None:
    path = project.parent / "required.json"
    path.write_text(json.dumps(told), "utf-8")
    result = scanbench("errors", "sweep", str(project), "--requirements", str(path))
    assert result.returncode == 2
    assert f"--requirements {path}: " in result.stderr
    assert says in result.stderr


def test_json_means_an_error_however_its_details_are_written(project: Path) -> None:
    path = project.parent / "required.json"
    told = {"special-io-unit-error:unit=00": "none", "special-io-unit-error:unit=77": "none"}
    path.write_text(json.dumps(told), "utf-8")
    call = ("errors", "sweep", str(project), "--only", "special-io-unit-error", "--window", "5")
    assert scanbench(*call).returncode == 1
    result = scanbench(*call, "--requirements", str(path))
    assert result.returncode == 0, result.stdout
    assert "--requirements names special-io-unit-error:unit=77, which this sweep does not raise" in result.stderr


def test_what_could_not_be_tried_is_a_finding(project: Path) -> None:
    """Hardware that is not there, a state that is misspelled, an error that the model does not know."""
    (project / "hardware.json").write_text('{"version": 1, "fitted": []}', "utf-8")
    (project / "required.reactions").write_text(
        "special-io-unit-error:unit=3: at least acted\nspecial-io-unit-error in Strat:\n  Main.lamp\nbatery-error: Main.lamp\n",
        "utf-8",
    )
    junit, page = project.parent / "junit.xml", project.parent / "page.html"
    call = ("errors", "sweep", str(project), "--only", "special-io-unit-error", "--window", "5")
    result = scanbench(*call, "--junit", str(junit), "--html", str(page))
    assert result.returncode == 1
    assert "requirements: 3 not tried" in result.stdout
    assert "Did you mean `Start`?" in result.stdout
    assert "3 requirements of required.reactions could not be tried: each is a finding" in result.stderr
    failures = [str(each.get("message")) for each in ElementTree.parse(junit).iter("failure")]
    assert failures[0] == "nonfatal error: not raised; not tried: at least acted; not tried: Main.lamp"
    assert failures[1] == "nonfatal error: not raised; not tried: Main.lamp"
    assert failures[2].startswith("not tried: CJ1M-CPU63 knows no error 'batery-error'. Did you mean `battery-error`")
    assert len(failures) == 3
    assert page.read_text("utf-8").count("not tried") == 4
    told = json.loads(scanbench(*call, "--json").stdout)
    assert [each["line"] for each in told["problems"]] == [4]
    assert [each["reason"] for each in told["results"][0]["required"]] == ["not_raised", "no_state"]
    assert told["unhandled"] == ["special-io-unit-error:unit=3", "special-io-unit-error"]
    (project / "required.reactions").write_text("battery-error: Main.lamp\n", "utf-8")
    assert scanbench(*call).returncode == 0


def test_both_engines_say_the_same(project: Path) -> None:
    native, reference = (
        scanbench("errors", "sweep", str(project), *FEW, "--json", "--window", "30", "--engine", engine).stdout
        for engine in ("native", "reference")
    )
    assert native == reference
    assert json.loads(native)["window"] == 30


def test_the_severity_decides_what_counts(project: Path) -> None:
    assert scanbench("errors", "sweep", str(project), *FEW).returncode == 1
    assert scanbench("errors", "sweep", str(project), *FEW, "--severity", "fatal").returncode == 0
    assert scanbench("errors", "sweep", str(project), "--only", "memory-error").returncode == 0
    assert (
        scanbench("errors", "sweep", str(project), *FEW, "--severity", "fatal", "--severity", "nonfatal").returncode
        == 1
    )


def test_reports(project: Path) -> None:
    junit, page = project.parent / "junit.xml", project.parent / "page.html"
    result = scanbench("errors", "sweep", str(project), *FEW, "--junit", str(junit), "--html", str(page))
    assert "battery-error" in result.stdout
    assert "3 never read" not in result.stderr
    suite = ElementTree.fromstring(junit.read_text("utf-8"))
    assert (suite.get("tests"), suite.get("failures")) == ("4", "3")
    assert "main.st:7" in page.read_text("utf-8")


def test_a_report_that_cannot_be_written_is_refused_before_the_sweep(
    project: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def never(*_: object) -> None:
        raise AssertionError("swept")

    monkeypatch.setattr(ERRORS, "sweep_side_by_side", never)
    good = project.parent / "good.xml"
    for option in ("--junit", "--html"):
        other = "--html" if option == "--junit" else "--junit"
        for bad in (project, project / "none" / "x"):
            result = scanbench("errors", "sweep", str(project), *FEW, option, str(bad), other, str(good))
            assert (result.returncode, result.stdout) == (2, "")
            assert f"{bad} cannot be written: " in result.stderr
            assert good.exists() == (other == "--junit")  # the report of a command that came to nothing
            good.unlink(missing_ok=True)


def test_a_sweep_is_told_although_its_report_cannot_be_kept(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The disk may fill up meanwhile."""
    monkeypatch.setattr(ERRORS, "must_be_writable", lambda *paths: None)
    result = scanbench("errors", "sweep", str(project), *FEW, "--junit", str(project))
    assert result.returncode == 2
    assert "memory-error" in result.stdout


def test_what_could_not_be_raised_is_said(project: Path) -> None:
    given = states(project, [{"name": "There", "do": ["5: raise battery-error"]}, {"name": "Else"}])
    for json_too in ((), ("--json",)):
        result = scanbench("errors", "sweep", str(project), *FEW, "--states", given, *json_too)
        assert "scanbench: 1 of 8 cases: the error could not be raised" in result.stderr
    fine = scanbench("errors", "sweep", str(project), *FEW)
    assert "could not be raised" not in fine.stderr


def test_the_program_of_a_run_that_does_not_compile_any_more(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The first error is named, not a warning that comes before it."""
    run = project.parent / "on.scanrun"
    assert scanbench("run", str(project), "--scans", "50", "--record", str(run)).returncode == 0
    kept = Sources("CJ1M-CPU63", {"main.st": SOURCE.replace("n : DINT;", "n : DINT; m : INT;").replace("inner THEN", "inned THEN")}, 10_000_000, 1)  # fmt: skip
    monkeypatch.setattr("scanbench.host.run_files.sources_in", lambda program: kept)
    given = states(project, [{"name": "A", "run": "on.scanrun"}])
    result = scanbench("errors", "sweep", str(project), *FEW, "--states", given)
    assert result.returncode == 2
    assert "state A: of the run's own program: the program cannot be built: main.st:7:6: " in result.stderr, (
        result.stderr
    )


def test_the_whole_catalogue_of_the_sample() -> None:
    result = scanbench("errors", "sweep", SAMPLE, "--json")
    told = json.loads(result.stdout)
    listed = json.loads(scanbench("errors", "list", SAMPLE, "--json").stdout)["errors"]
    assert [each["id"] for each in told["results"]] == [each["id"] for each in listed]
    verdicts = {each["id"]: each["verdict"] for each in told["results"]}
    assert verdicts["basic-io-error"] == "acted"
    assert verdicts["battery-error"] == "never_read"
    assert verdicts["memory-error"] == "stopped"
    assert result.returncode == 1


def test_the_filling_sample_and_the_place_that_it_forgot(tmp_path: Path) -> None:
    filling = str(files("scanbench").joinpath("samples/filling"))
    running = tmp_path / "states.json"
    running.write_text('[{"name": "Pouring", "scans": 200, "do": ["5: start=TRUE", "9: start=FALSE"]}]', "utf-8")
    some = (
        "basic-io-error",
        "special-io-unit-error",
        "cpu-bus-unit-error",
        "battery-error",
        "cpu-bus-unit-setting-error",
    )
    only = [word for each in some for word in ("--only", each)]
    result = scanbench("errors", "sweep", filling, *only, "--states", str(running), "--json")
    assert result.returncode == 1, result.stderr
    told = {each["id"]: each for each in json.loads(result.stdout)["results"]}
    assert {id: each["verdict"] for id, each in told.items()} == {
        "basic-io-error:rack=0,slot=0": "acted", "basic-io-error:rack=0,slot=1": "acted",
        "special-io-unit-error:unit=0": "acted", "cpu-bus-unit-error:unit=2": "acted", "battery-error": "acted",
        "cpu-bus-unit-setting-error:unit=2": "stored",
    }  # fmt: skip
    assert all(each["outcome"] == "passed" for cell in told.values() for each in cell["required"])
    assert len(told["basic-io-error:rack=0,slot=1"]["required"]) == 5
    (forgotten,) = (
        each for each in told["cpu-bus-unit-setting-error:unit=2"]["differences"] if "Alarm" in each["path"]
    )
    assert forgotten["path"] == "Main.alarms.settingAlarm"


def test_a_state_after_a_restart_and_a_fault_with_a_shape(project: Path) -> None:
    given = states(
        project, [{"name": "Again", "do": ["5: Main.on=TRUE", "7: raise battery-error for 3", "20: restart cold"]}]
    )
    result = scanbench("errors", "sweep", str(project), "--only", "battery-error", "--states", given, "--json")
    assert not result.stderr
    assert [each["verdict"] for each in json.loads(result.stdout)["results"]] == [
        "not_reached"
    ]  # it is off again, and the error is gone


def test_a_state_from_a_recorded_run(project: Path) -> None:
    run = project.parent / "on.scanrun"
    assert (
        scanbench("run", str(project), "--scans", "50", "--set", "Main.on=TRUE@20", "--record", str(run)).returncode
        == 0
    )
    (project / "main.st").write_text(SOURCE.replace("n : DINT", "n : DINT; more : INT"), "utf-8")  # carried over
    given = states(
        project,
        [{"name": "Before", "run": "on.scanrun", "scan": 20}, {"name": "After", "run": "on.scanrun", "scan": 25},
         {"name": "End", "run": "on.scanrun"}],
    )  # fmt: skip
    result = scanbench("errors", "sweep", str(project), "--only", "battery-error", "--states", given, "--json")
    told = json.loads(result.stdout)
    assert [each["scan"] for each in told["states"]] == [20, 25, 50]
    assert [each["verdict"] for each in told["results"]] == ["acted", "acted", "acted"]
    assert not result.stderr
    run.write_bytes(run.read_bytes()[:-5])
    given = states(project, [{"name": "Before", "run": "on.scanrun", "scan": 20}])
    result = scanbench("errors", "sweep", str(project), "--only", "battery-error", "--states", given)
    assert "on.scanrun: note: " in result.stderr  # something of the run is not there, and the state is


@pytest.mark.parametrize(
    ("told", "words"),
    [
        ("{", "it is no JSON"),
        ([], "a list of states"),
        ({"name": "x"}, "a list of states"),
        ([3], "state 1 is 3"),
        ([{"scans": 3}], "state 1 has no name"),
        ([{"name": "A"}, {"name": "A"}], "state 2: there are two states 'A'"),
        ([{"name": "A", "scan": 3}], "Did you mean `scans`?"),
        ([{"name": "A", "scans": -1}], "`scans` has to be a number of scans"),
        ([{"name": "A", "scans": True}], "`scans` has to be a number of scans"),
        ([{"name": "A", "do": "x"}], "`do` has to be a list of texts"),
        ([{"name": "A", "do": ["Main.on=TRUE"]}], "cannot be read"),
        ([{"name": "A", "do": ["5: Main.off=TRUE"]}], "has no member `off`"),
        ([{"name": "A", "do": ["5: Main.on=MAYBE"]}], "is not a BOOL"),
        ([{"name": "A", "do": ["5: Main.on"]}], "write PATH=VALUE, or one of force"),
        ([{"name": "A", "do": ["5: raise batery-error"]}], "Did you mean `battery-error`"),
        ([{"name": "A", "do": ["5: mode SLOW"]}], "there are PROGRAM"),
        ([{"name": "A", "do": ["500: Main.on=TRUE"]}], "comes after its 100 scans"),
        ([{"name": "A", "do": ["5: A400=3"]}], "refused before scan 5"),
        ([{"name": "A", "do": ["5: mode PROGRAM"]}], "the program does not run there"),
        ([{"name": "A", "do": ["5: raise memory-error"]}], "the program does not run there"),
        ([{"name": "A", "run": 3}], "`run` has to be the name of a run file"),
        ([{"name": "A", "run": "none.scanrun"}], "none.scanrun cannot be read"),
        ([{"name": "A", "run": "states.json"}], "states.json is not a run file"),
        ([{"name": "A", "run": "x", "do": []}], "has 'do', which is nothing here"),
    ],
)
def test_states_that_cannot_be(project: Path, told: object, words: str) -> None:
    result = scanbench("errors", "sweep", str(project), "--only", "battery-error", "--states", states(project, told))
    assert result.returncode == 2, result.stdout
    assert words in result.stderr
    assert "Traceback" not in result.stderr


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("errors", "sweep", "no-such-folder"), "does not exist"),
        (("errors", "sweep", SAMPLE, "--only", "batery-error"), "Did you mean `battery-error`"),
        (("errors", "sweep", SAMPLE, "--model", "CJ1M-CPU6"), "Did you mean `CJ1M-CPU63`?"),
        (("errors", "sweep", SAMPLE, "--window", "0"), "--window"),
        (("errors", "sweep", SAMPLE, "--severity", "bad"), "--severity"),
        (("errors", "sweep", SAMPLE, "--states", "none.json"), "cannot be read"),
        (("errors", "sweep", SAMPLE, "--only", "battery-error", "--junit", "/no/such/folder/x"), "cannot be written"),
        (("errors", "list", "--model", "nothing"), "there is no model nothing"),
        (("errors", "compare", "a.json", "b.json"), "a.json does not exist"),
    ],
)
def test_wrong_usage(arguments: tuple[str, ...], words: str) -> None:
    result = scanbench(*arguments)
    assert result.returncode == 2
    assert words in result.stderr
    assert "Traceback" not in result.stderr


def test_a_program_with_errors(project: Path) -> None:
    (project / "main.st").write_text("PROGRAM Main\n  x := 1;\nEND_PROGRAM\n", "utf-8")
    result = scanbench("errors", "sweep", str(project), "--json")
    assert result.returncode == 1
    assert json.loads(result.stdout)["problems"]
    assert "main.st:2" in result.stderr


def test_two_sweeps_compared(project: Path) -> None:
    before, after = project.parent / "before.json", project.parent / "after.json"
    before.write_text(scanbench("errors", "sweep", str(project), *FEW, "--json").stdout, "utf-8")
    (project / "main.st").write_text(SOURCE.replace("IF inner THEN ;", "IF inner THEN on := TRUE;"), "utf-8")
    after.write_text(scanbench("errors", "sweep", str(project), *FEW, "--json").stdout, "utf-8")
    better = scanbench("errors", "compare", str(before), str(after))
    assert better.returncode == 0
    assert "inner-board-error  Start  read, no effect  decided  better" in better.stdout
    worse = scanbench("errors", "compare", str(after), str(before), "--json")
    assert worse.returncode == 1
    changes = {each["error"]: each["change"] for each in json.loads(worse.stdout)["changes"]}
    assert changes["inner-board-error"] == "worse"
    assert changes["memory-error"] == "same"
    told = json.loads(after.read_text("utf-8"))
    assert json.loads(worse.stdout)["apart"] == []
    told |= {"model": "CJ2M-CPU3x", "window": 7, "states": [{**each, "scan": 99} for each in told["states"]]}
    after.write_text(json.dumps(told), "utf-8")
    apart = scanbench("errors", "compare", str(before), str(after))
    assert apart.returncode == 4
    assert apart.stdout.count("not made alike: ") >= 3
    assert "watched for" in apart.stdout
    assert "the state Start was at scan" in apart.stdout
    after.write_text(json.dumps({**told, "results": []}), "utf-8")
    nothing = scanbench("errors", "compare", str(after), str(after))
    assert (nothing.returncode, nothing.stdout) == (2, "")
    assert "neither sweep has an error" in nothing.stderr
    page = project / "page.html"
    page.write_text("<!doctype html>")
    for other in (page, project / "project.json"):
        refused = scanbench("errors", "compare", str(before), str(other))
        assert refused.returncode == 2
        assert f"{other} is not a sweep's JSON (made with errors sweep --json)\n" in refused.stderr


OWN = """<UserErrors>
  <ErrorGroup>
    <Name>Pumps</Name>
    <Error Id="pump-hot" ErrorCode="C001" ErrorFlag="W10.00" Severity="nonfatal" Priority="50" Source="the project" Verified="no">
      <Name>Pump too hot</Name><Description>The pump is too hot</Description>
    </Error>
  </ErrorGroup>
</UserErrors>
"""


def test_the_projects_own_errors_are_swept_too(project: Path) -> None:
    (project / "errors.xml").write_text(OWN, "utf-8")
    source = SOURCE.replace("n : DINT;", "n : DINT; hot AT W10.00 : BOOL;").replace(
        "IF inner THEN ;", "IF hot THEN lamp := TRUE;"
    )
    (project / "main.st").write_text(source, "utf-8")
    (own,) = (
        each
        for each in json.loads(scanbench("errors", "list", str(project), "--json").stdout)["errors"]
        if each["user"]
    )
    assert (own["id"], own["code"]) == ("pump-hot", "C001")
    result = scanbench("errors", "sweep", str(project), "--only", "pump-hot", "--json")
    assert result.returncode == 0, result.stderr
    assert [(each["id"], each["verdict"]) for each in json.loads(result.stdout)["results"]] == [("pump-hot", "acted")]
    (project / "errors.xml").write_text(OWN.replace(' ErrorFlag="W10.00"', ""), "utf-8")
    for command in ("list", "sweep"):
        broken = scanbench("errors", command, str(project))
        assert broken.returncode == 1
        assert broken.stderr.startswith("errors.xml:4:5: M002 ")


REQUIRED = """battery-error:
  lamp within 2 scans
  after recovery: lamp = FALSE within 2 scans
  Main.n > 0
inner-board-error: at least no_effect
basic-io-error: at least none
memory-error: lamp
"""


def required(project: Path, text: str = REQUIRED) -> tuple[str, ...]:
    """A project whose globals have names everywhere, and what it requires."""
    source = SOURCE.replace("PROGRAM Main\nVAR", "VAR_GLOBAL\n  lamp AT CIO 100.00 : BOOL;\nEND_VAR\nPROGRAM Main\nVAR")
    (project / "main.st").write_text(source.replace("lamp AT CIO 100.00 : BOOL; on", "on"), "utf-8")
    (project / "required.reactions").write_text(text, "utf-8")
    return ("errors", "sweep", str(project), *FEW, "--window", "20")


def test_required_reactions_are_red_until_the_program_is_corrected(project: Path) -> None:
    junit, page = project.parent / "junit.xml", project.parent / "page.html"
    call = (*required(project), "--junit", str(junit), "--html", str(page))
    red = scanbench(*call)
    assert red.returncode == 1
    assert "lamp within 2 scans" in red.stdout
    assert "scan 2: lamp = FALSE" in red.stdout
    assert "requirements: 4 passed, 1 failed, 1 not checked" in red.stdout
    (message,) = (each.get("message") for each in ElementTree.parse(junit).iter("failure"))
    assert message == "nonfatal error: not reached; required: decided; failed: lamp within 2 scans"
    assert "Required reactions" in page.read_text("utf-8")
    corrected = (
        (project / "main.st").read_text("utf-8").replace("IF on THEN lamp := battery; END_IF;", "lamp := battery;")
    )
    (project / "main.st").write_text(corrected, "utf-8")
    green = scanbench(*call)
    assert green.returncode == 0, green.stdout
    assert "requirements: 5 passed, 1 not checked" in green.stdout
    assert not list(ElementTree.parse(junit).iter("failure"))


def test_json_has_what_is_required_and_both_engines_agree(project: Path) -> None:
    call = (*required(project), "--json")
    native = scanbench(*call)
    assert native.stdout == scanbench(*call, "--engine", "reference").stdout
    told = {each["id"]: each for each in json.loads(native.stdout)["results"]}
    (lamp, *_) = told["battery-error"]["required"]
    assert (lamp["text"], lamp["line"], lamp["outcome"], lamp["scan"]) == ("lamp within 2 scans", 2, "failed", 2)
    assert lamp["values"] == [{"path": "lamp", "value": "FALSE"}]
    assert [each["reason"] for each in told["memory-error"]["required"]] == ["stopped"]
    assert [(each["outcome"], each["reason"]) for each in told["basic-io-error"]["required"]] == [
        ("passed", ""),
    ]


def test_a_requirement_with_a_wrong_name_is_not_checked_and_never_passed(project: Path) -> None:
    call = required(project, "basic-io-error: at least none\nbattery-error:\n  at least none\n  lmp within 2 scans\n")
    result = scanbench(*call, "--only", "battery-error")
    assert result.returncode == 1
    assert "required.reactions:4:3: R001" in result.stderr
    assert "Did you mean `lamp`?" in result.stderr
    assert "1 not checked" in result.stdout
    check = scanbench("check", str(project))
    assert check.returncode == 0
    assert "required.reactions:4:3: R001 warning: " in check.stdout


def test_a_file_of_the_command_line_replaces_that_of_the_project(project: Path) -> None:
    call = required(project)
    path = project.parent / "night.reactions"
    path.write_text("all: at least none\nbattery-error: NOT lamp\n", "utf-8")
    result = scanbench(*call, "--requirements", str(path))
    assert (result.returncode, "requirements: 5 passed" in result.stdout) == (0, True), result.stdout
