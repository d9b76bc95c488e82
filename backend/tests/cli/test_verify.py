"""`scanbench verify`: projects, run files and traces, what it says of a difference, and every way to get the call wrong."""

import json
from importlib import import_module
from importlib.resources import files
from pathlib import Path

import pytest

from scanbench.verify.contract import ScanVerified
from scanbench.verify.verifier import Verifier
from tests.cli.calling import scanbench
from tests.verify.planted import Fault, planted
from tests.verify.vendor_files import FILES, LINE, clean
from tests.verify.vendor_files import faulty as faulty_trace

VERIFY = import_module("scanbench.cli.verify")  # of the package, `verify` is the command
SAMPLE = str(files("scanbench").joinpath("samples/conveyor"))
SOURCE = """FUNCTION_BLOCK Ramp
VAR_INPUT target : INT; END_VAR
VAR_OUTPUT speed : INT; END_VAR
  IF speed < target THEN
    speed := speed + 25;
  END_IF;
END_FUNCTION_BLOCK

PROGRAM Main
VAR n : INT; wanted AT D10 : INT; belt : ARRAY[1..2] OF Ramp; out AT D100 : INT; END_VAR
  n := n + 1;
  belt[1](target := wanted);
  belt[2](target := wanted / 2);
  out := belt[1].speed + belt[2].speed;
END_PROGRAM
"""
SUM = Fault("main.st", 14, "add", "sub")


@pytest.fixture
def project(tmp_path: Path) -> Path:
    folder = tmp_path / "line"
    folder.mkdir()
    (folder / "main.st").write_text(SOURCE, "utf-8")
    (folder / "project.json").write_text('{"model": "CJ1M-CPU63"}', "utf-8")
    return folder


@pytest.fixture
def run(project: Path, tmp_path: Path) -> str:
    path = str(tmp_path / "a.scanrun")
    ran = scanbench("run", str(project), "--scans", "60", "--set", "Main.wanted=100@5", "--record", path)
    assert ran.returncode == 0, ran.stderr
    return path


def faulty(monkeypatch: pytest.MonkeyPatch) -> None:
    """Native code with a fault, in both of its flavours."""
    monkeypatch.setattr(VERIFY, "on", lambda code: planted(SUM, debug=True))


def test_the_sample_has_no_difference() -> None:
    result = scanbench("verify", SAMPLE, "--scans", "0..299", "--set", "start=TRUE@5", "--raise", "battery-error@200")
    assert (result.returncode, result.stderr) == (0, ""), result
    assert "conveyor on CJ1M-CPU63, the whole scan: scans 0 to 299, 300 compared: no difference" in result.stdout


def test_a_run_file_and_a_stretch_of_it(run: str) -> None:
    whole = json.loads(scanbench("verify", run, "--json").stdout)
    assert (whole["first"], whole["last"], whole["compared"], whole["same"]) == (0, 59, 60, True)
    assert (whole["source"], whole["model"], whole["interval_ns"]) == ("past", "CJ1M-CPU63", 10_000_000)
    some = scanbench("verify", run, "--scans", "10..19", "--range", "Ramp", "--json")
    assert some.returncode == 0, some.stderr
    told = json.loads(some.stdout)
    assert (told["first"], told["last"], told["compared"], told["range"]) == (10, 19, 10, "Ramp")
    assert {each["name"] for each in told["columns"]} == {"speed", "target"}
    assert {each["instance"] for each in told["rows"]} == {"Main.belt[1]", "Main.belt[2]"}
    one = json.loads(scanbench("verify", run, "--range", "Ramp@Main.belt[2]", "--scans", "50..", "--json").stdout)
    assert {each["instance"] for each in one["rows"]} == {"Main.belt[2]"}
    assert scanbench("verify", run, "--engine", "reference", "--scans", "..9").returncode == 0


def test_a_difference_names_all_there_is_to_know(run: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    faulty(monkeypatch)
    page = tmp_path / "page.html"
    result = scanbench("verify", run, "--range", "Main:14", "--html", str(page))
    assert result.returncode == 1, result
    block = result.stdout.split("\n\n")[0].splitlines()
    assert block[0].startswith("scan 5: ")
    said = {line.split(None, 1)[0]: line.split(None, 1)[1] for line in block[1:]}
    assert said["instance"] == "Main"
    assert said["line"] == "main.st:14: out := belt[1].speed + belt[2].speed;"
    assert (said["was"], said["is"]) == ("0", "50 in the reference")
    assert said["cause"].startswith("logic: ")
    assert "task" in said
    assert "rows differ" in result.stdout
    text = page.read_text("utf-8")
    assert "Differences found" in text
    assert "main.st:14" in text


def test_a_difference_as_json(run: str, monkeypatch: pytest.MonkeyPatch) -> None:
    faulty(monkeypatch)
    result = scanbench("verify", run, "--json", "--scans", "0..20")
    assert result.returncode == 1
    told = json.loads(result.stdout)
    first = told["differences"][0]
    assert (told["same"], first["scan"], first["was"], first["is"], first["cause"]) == (False, 5, "0", "50", "logic")
    assert (first["place"]["file"], first["place"]["line"], first["place"]["instance"]) == ("main.st", 14, "Main")
    assert told["differing_rows"] >= 1


def test_an_interrupted_call_says_how_far_it_came(run: str, monkeypatch: pytest.MonkeyPatch) -> None:
    verify = Verifier.verify

    def interrupted(self: Verifier, scan: int) -> ScanVerified:
        if scan == 7:
            raise KeyboardInterrupt
        return verify(self, scan)

    monkeypatch.setattr(Verifier, "verify", interrupted)
    result = scanbench("verify", run)
    assert result.returncode == 130
    assert "interrupted after 7 scans" in result.stderr
    assert "scans 0 to 6, 7 compared: no difference" in result.stdout


TRACE = "scan,wanted,out\r\n" + "".join(f"{scan},100,{out}\r\n" for scan, out in enumerate((50, 100, 125, 150, 150)))


def test_a_trace_is_taken_by_the_names_of_its_columns(project: Path, tmp_path: Path) -> None:
    trace = tmp_path / "press.csv"
    trace.write_text(TRACE)
    result = scanbench("verify", str(project), "--trace", str(trace))
    assert result.returncode == 0, result
    assert "wanted is Main.wanted (input); out is Main.out (output)" in result.stderr
    assert "5 compared: no difference" in result.stdout
    trace.write_text(TRACE.replace("3,100,150", "3,100,151"))
    result = scanbench("verify", str(project), "--trace", str(trace), "--json")
    assert result.returncode == 1, result
    told = json.loads(result.stdout)
    assert (told["source"], told["trace"]) == ("trace", "press.csv")
    (first,) = told["differences"]
    assert (first["scan"], first["variable"], first["was"], first["is"]) == (3, "Main.out", "151", "150")


def test_an_input_without_a_column_is_named_and_the_verdict_depends_on_it(tmp_path: Path) -> None:
    source, trace, page = tmp_path / "main.st", tmp_path / "x.csv", tmp_path / "x.html"
    source.write_text(
        "PROGRAM Main VAR start AT %IX0.0 : BOOL; raw AT %IW2 : INT; motor AT %QX0.0 : BOOL; n, r : INT; END_VAR "
        "VAR CONSTANT k : INT := 3; END_VAR n := n + k; motor := start; r := raw * k; END_PROGRAM"
    )
    trace.write_text("scan,motor\n0,0\n1,0\n")
    result = scanbench("verify", str(source), "--trace", str(trace), "--html", str(page))
    assert result.returncode == 4, result  # a verdict with a condition is none that a script may rely on
    assert json.loads(scanbench("verify", str(source), "--trace", str(trace), "--json").stdout)["same"] is None
    assert "No difference in what was compared" in page.read_text("utf-8")
    took = "read by the program, and without a value in the file: the reference took the start values of: Main.start, Main.raw\n"
    assert took in result.stdout
    assert "2 compared: no difference, if 2 inputs had the start value where the file has no value" in result.stdout
    assert "This holds if the inputs had their start values where the file has no value of them." in page.read_text(
        "utf-8"
    )
    trace.write_text("scan,motor,start,raw\n0,0,0,0\n1,0,0,0\n")
    result = scanbench("verify", str(source), "--trace", str(trace))
    assert (result.returncode, result.stdout.endswith("2 compared: no difference\n")) == (0, True)


def test_a_scan_that_could_not_be_compared_is_in_the_exit_code(project: Path) -> None:
    stopped = ("verify", str(project), "--scans", "0..9", "--mode", "PROGRAM@4", "--mode", "MONITOR@6")
    result = scanbench(*stopped)
    assert (result.returncode, "8 compared, 2 not compared (4 to 5)" in result.stdout) == (4, True), result
    assert json.loads(scanbench(*stopped, "--json").stdout)["same"] is None
    assert scanbench("verify", str(project), "--scans", "0..9").returncode == 0


def test_what_a_trace_does_not_have_is_not_said_to_be_the_same(project: Path, tmp_path: Path) -> None:
    trace, mapping = tmp_path / "press.csv", tmp_path / "press.json"
    trace.write_text("scan,wanted,out\r\n4,100,50\r\n9,100,75\r\n20,100,\r\n21,100,\r\n")
    columns = [
        {"column": name, "path": f"Main.{name}", "role": role}
        for name, role in (("wanted", "input"), ("out", "output"))
    ]
    mapping.write_text(json.dumps({"axis": "scan", "unit": "scan", "gaps": "skip", "columns": columns}))
    given = ("verify", str(project), "--trace", str(trace), "--map", str(mapping))
    result = scanbench(*given)
    assert result.returncode == 2, result
    assert "0 compared, 18 not compared (4 to 21): nothing was compared" in result.stdout
    told = json.loads(scanbench(*given, "--json").stdout)
    assert (told["compared"], told["skipped"], told["skipped_stretches"]) == (0, 18, [[4, 21]])
    assert told["same"] is None
    further = scanbench(*given, "--scans", "4..90")
    assert (further.returncode, "scan 90 is none of them" in further.stderr) == (2, True)


def test_a_trace_of_a_run_files_program_with_a_mapping(run: str, tmp_path: Path) -> None:
    trace, mapping = tmp_path / "press.csv", tmp_path / "press.json"
    trace.write_text(TRACE.replace("wanted", "Soll").replace("out", "Ist"))
    columns = [{"column": "Soll", "path": "D10", "role": "input"}, {"column": "Ist", "path": "D100", "role": "output"}]
    mapping.write_text(json.dumps({"axis": "scan", "unit": "scan", "gaps": "refuse", "columns": columns}))
    given = ("verify", run, "--trace", str(trace), "--map", str(mapping))
    result = scanbench(*given)
    assert (result.returncode, result.stderr) == (0, ""), result
    mapping.write_text("{")
    broken = scanbench(*given)
    assert broken.returncode == 2
    assert f"{mapping}: The mapping is not JSON" in broken.stderr


def test_a_file_of_a_vendors_tool_and_what_of_it_was_compared(tmp_path: Path) -> None:
    (tmp_path / "main.st").write_text(LINE, "utf-8")
    trace = tmp_path / "scope.csv"
    trace.write_bytes(FILES["twincat.csv"](clean()))
    given = ("verify", str(tmp_path / "main.st"), "--model", "CJ1M-CPU63", "--trace", str(trace))
    result = scanbench(*given)
    assert result.returncode == 0, result
    assert "scope.csv is read as: TwinCAT Scope." in result.stderr
    assert "  Main.motor: 119 compared\n" in result.stdout
    assert "not compared, as the file has no column of them: Main.belt.run" in result.stdout
    page = tmp_path / "report.html"
    trace.write_bytes(FILES["twincat.csv"](faulty_trace("motor")))
    told = json.loads(scanbench(*given, "--json", "--html", str(page)).stdout)
    counted = {each["variable"]: each["differing"] for each in told["coverage"]["outputs"]}
    assert (told["same"], counted["Main.motor"], counted["Main.valve"]) == (False, 2, 0)
    assert told["coverage"]["inputs"] == ["Main.start", "Main.stop", "Main.raw", "Main.setpoint"]
    assert "What was compared" in page.read_text("utf-8")


def test_a_trace_that_cannot_be_used_is_refused_with_row_and_column(project: Path, tmp_path: Path) -> None:
    trace = tmp_path / "press.csv"
    trace.write_text(TRACE.replace("2,100,125", "2,x,125"))
    result = scanbench("verify", str(project), "--trace", str(trace))
    assert (result.returncode, result.stdout) == (2, "")
    assert f"{trace}:4: column wanted: " in result.stderr
    missing = scanbench("verify", str(project), "--trace", str(tmp_path / "none.csv"))
    assert missing.returncode == 2
    assert "none.csv does not exist" in missing.stderr


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--range", "Rampe"), "Did you mean"),
        (("--range", "Main:20-10"), "line 10 is before line 20"),
        (("--range", "Main:x"), "no line"),
        (("--scans", "12"), "write A..B"),
        (("--scans", "9..3"), "scan 3 is before scan 9"),
        (("--scans", "60..61"), "has scans 0 to 59: scan 60 is none of them"),
        (("--scans", "0..60"), "scan 60 is none of them"),
        (("--map", "x.json"), "name the trace with --trace"),
        (("--set", "Main.n=1"), "a recorded run is taken as it is"),
        (("--model", "GENERIC-IEC"), "a.scanrun was recorded on a model of its own"),
        (("--html", "/nowhere/x.html"), "cannot be written"),
    ],
)
def test_wrong_usage(run: str, options: tuple[str, ...], message: str) -> None:
    result = scanbench("verify", run, *options)
    assert (result.returncode, result.stdout) == (2, ""), result
    assert message in result.stderr


def test_files_that_cannot_be_used(project: Path, run: str, tmp_path: Path) -> None:
    bad = tmp_path / "b.scanrun"
    bad.write_bytes(b"something else")
    result = scanbench("verify", str(bad))
    assert result.returncode == 2
    assert "b.scanrun is not a run file" in result.stderr
    assert scanbench("verify", str(tmp_path / "none.scanrun")).returncode == 2
    assert scanbench("verify", str(tmp_path / "none")).returncode == 2
    (project / "main.st").write_text("PROGRAM Main x := 1; END_PROGRAM")
    broken = scanbench("verify", str(project))
    assert broken.returncode == 2
    assert "does not compile" in broken.stderr
    assert "main.st:1:" in broken.stderr


def test_a_refused_command_is_no_run_to_verify(project: Path) -> None:
    result = scanbench("verify", str(project), "--set", "Main.n=100000@3")
    assert (result.returncode, result.stdout) == (2, "")
    assert "100000 is outside of INT" in result.stderr


def test_a_run_that_traps_is_verified_up_to_there(project: Path) -> None:
    (project / "main.st").write_text(
        "PROGRAM Main\nVAR n : INT; a : ARRAY[0..9] OF INT; END_VAR\n  n := n + 1;\n  a[n] := 1 / (7 - n);\nEND_PROGRAM\n"
    )
    result = scanbench("verify", str(project), "--json")
    assert result.returncode == 4, result
    told = json.loads(result.stdout)
    assert "trap" in told["note"]
    assert told["same"] is None, "not all that was asked for was compared"
    assert (told["last"], told["not_reached"]) == (6, 993)
    text = scanbench("verify", str(project)).stdout
    assert "scan 6: ended by a run-time error" in text
    assert "scans 0 to 6, 7 compared, 993 that were asked for did not run: no difference in what was compared" in text


def test_a_range_that_never_runs_is_not_compared(project: Path) -> None:
    (project / "never.st").write_text(
        "FUNCTION_BLOCK Never\nVAR n : INT; END_VAR\nn := n + 1;\nEND_FUNCTION_BLOCK\n"
        "PROGRAM Other\nVAR f : Never; on : BOOL; END_VAR\nIF on THEN f(); END_IF;\nEND_PROGRAM\n"
    )
    result = scanbench("verify", str(project), "--range", "Never", "--scans", "..9", "--json")
    assert result.returncode == 2, result
    assert "Never did not run in any of these scans" in result.stderr
    assert json.loads(result.stdout)["same"] is None
    text = scanbench("verify", str(project), "--range", "Never", "--scans", "..9").stdout
    assert "0 compared: nothing was compared" in text


def test_a_command_after_the_last_scan_is_refused(project: Path) -> None:
    result = scanbench("verify", str(project), "--scans", "0..5", "--set", "Main.wanted=1@9")
    assert (result.returncode, result.stdout) == (2, "")
    assert "--set Main.wanted=1@9: there are only 6 scans" in result.stderr
