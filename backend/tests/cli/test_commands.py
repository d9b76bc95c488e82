"""The command line: what it prints, and its exit codes. One call of each kind is made as a process, too."""

import json
import sys
from importlib.resources import files
from pathlib import Path

import pytest

from scanbench.server.archive import pack
from tests.cli.calling import SCANBENCH, process, scanbench

SAMPLE = str(files("scanbench").joinpath("samples/conveyor"))

COUNT = """PROGRAM Main
VAR n : INT; z : INT := 3; a : ARRAY[1..2] OF INT; s : STRING := 'hi'; t : TIME; r : REAL; w : WORD := 16#FF; b : BOOL; END_VAR
n := n + 1;
t := T#1s500ms;
a[2] := n;
r := 0.1;
b := n = 3;
END_PROGRAM
"""


@pytest.fixture
def count(tmp_path: Path) -> str:
    path = tmp_path / "count.st"
    path.write_text(COUNT, "utf-8")
    return str(path)


def test_check_prints_file_line_column_code_and_message(tmp_path: Path) -> None:
    path = tmp_path / "bad.st"
    path.write_text("PROGRAM Main\nVAR x : INT; END_VAR\n  x := y;\nEND_PROGRAM\n", "utf-8")
    for call in (scanbench, process):
        result = call("check", str(path))
        assert result.returncode == 1
        assert result.stdout.startswith(f"{path}:3:8: T001 ")


def test_check_json(tmp_path: Path) -> None:
    (tmp_path / "bad.st").write_text("PROGRAM Main\nx := 1;\nEND_PROGRAM\n", "utf-8")
    result = scanbench("check", str(tmp_path), "--format", "json")
    found = json.loads(result.stdout)
    assert result.returncode == 1
    assert [(each["line"], each["column"], each["code"]) for each in found["problems"]] == [(2, 1, "T001")]


def test_a_folder_gives_every_program_file_in_it(tmp_path: Path) -> None:
    (tmp_path / "Fast.TcPOU").write_text(
        '<TcPlcObject>\n<POU Name="Fast"><Declaration><![CDATA[PROGRAM Fast\nVAR x : INT; END_VAR]]></Declaration>'
        "<Implementation><ST><![CDATA[\nx := y;]]></ST></Implementation></POU></TcPlcObject>",
        "utf-8",
    )
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub" / "old.EXP").write_text("VAR_GLOBAL x : INT; END_VAR", "utf-8")
    (tmp_path / "notes.txt").write_text("no program", "utf-8")
    result = scanbench("check", str(tmp_path))
    assert result.stdout.startswith(f"{tmp_path}/Fast.TcPOU:4:6: T001 ")
    assert result.returncode == 1


@pytest.mark.parametrize(
    "text",
    [
        "\ufeffPROGRAM Main\r\nVAR x : INT; END_VAR\r\nx := 1;\r\nEND_PROGRAM\r\n".encode(),
        "PROGRAM Main (* gr\xf6\xdfe *) END_PROGRAM".encode("latin-1"),
        "\ufeffPROGRAM Main\r\nVAR gr\xf6\xdfe : INT; END_VAR\r\ngr\xf6\xdfe := 1;\r\nEND_PROGRAM\r\n".encode(
            "utf-16-le"
        ),
    ],
)
def test_check_reads_what_vendors_write(tmp_path: Path, text: bytes) -> None:
    (tmp_path / "a.st").write_bytes(text)
    assert scanbench("check", str(tmp_path)).returncode == 0


def test_a_file_of_twincat_in_utf_16_is_read(tmp_path: Path) -> None:
    text = (
        '<?xml version="1.0" encoding="utf-16"?>\r\n<TcPlcObject Version="1.1.0.1"><POU Name="Main" Id="{1}"><Declaration>'
        "<![CDATA[PROGRAM Main\r\nVAR n : INT; END_VAR]]></Declaration><Implementation><ST><![CDATA[n := 1;]]></ST></Implementation>"
        "</POU></TcPlcObject>"
    )
    (tmp_path / "Main.TcPOU").write_bytes(text.encode("utf-16"))
    result = scanbench("check", str(tmp_path))
    assert result.returncode == 0, result.stdout


def test_check_of_nothing_is_wrong_usage(tmp_path: Path) -> None:
    assert scanbench("check", str(tmp_path / "none.st")).returncode == 2
    assert scanbench("check", str(tmp_path)).returncode == 2
    assert scanbench("check").returncode == 2
    assert process("check").returncode == 2


def test_the_sample_has_no_problems() -> None:
    for call in (scanbench, process):
        result = call("check", SAMPLE)
        assert (result.returncode, result.stdout) == (0, "")


@pytest.mark.parametrize("engine", ["native", "reference", "both"])
def test_the_sample_runs_alike_on_every_engine(engine: str) -> None:
    call = process if engine == "native" else scanbench
    result = call(
        "run", SAMPLE, "--scans", "400", "--engine", engine, "--json", "--hash", "--every", "100",
        "--set", "start=TRUE@5", "--raise", "basic-io-error:rack=1,slot=2@200", "--clear", "all@300", "--set", "reset=TRUE@350",
        "--print", "motor", "--print", "lamp", "--print", "A402.12", "--print", "A400", "--print", "Main.parts.total",
    )  # fmt: skip
    assert result.returncode == 0, result.stderr
    shown = json.loads(result.stdout)
    assert shown["scans"] == 400
    assert shown["time_ns"] == 4_000_000_000
    assert shown["rows"][1] == {
        "scan": 200, "time_ns": 2_000_000_000,
        "values": {"motor": True, "lamp": False, "A402.12": False, "A400": 0, "Main.parts.total": 3},
    }  # fmt: skip
    assert shown["rows"][2]["values"]["A400"] == 0x9A
    assert shown["rows"][2]["values"] | {"A400": 0} == {
        "motor": False,
        "lamp": True,
        "A402.12": True,
        "A400": 0,
        "Main.parts.total": 3,
    }
    assert shown["values"]["lamp"] is False
    assert len(shown["hash"]) == 64
    HASHES.add(shown["hash"])
    assert len(HASHES) == 1


HASHES: set[str] = set()


def test_values_as_json(count: str) -> None:
    result = scanbench(
        "run",
        count,
        "--scans",
        "3",
        "--json",
        *(
            arg
            for path in ("Main.n", "Main.a", "Main.a[2]", "Main.s", "Main.t", "Main.r", "Main.w", "Main.b", "%MW3")
            for arg in ("--print", path)
        ),
    )
    assert json.loads(result.stdout)["values"] == {
        "Main.n": 3, "Main.a": [0, 3], "Main.a[2]": 3, "Main.s": "hi", "Main.t": 1_500_000_000,
        "Main.r": 0.10000000149011612, "Main.w": 255, "Main.b": True, "%MW3": 0,
    }  # fmt: skip


def test_values_as_text_are_written_as_in_a_program(tmp_path: Path) -> None:
    path = tmp_path / "main.st"
    path.write_text(
        "TYPE Part : STRUCT id : INT := 7; name : STRING := 'nut'; END_STRUCT; END_TYPE\n"
        "PROGRAM Main VAR b : BOOL; w : WORD; a : ARRAY[1..2] OF BOOL; p : Part; END_VAR\n"
        "b := NOT b; w := 16#FF; a[2] := b; END_PROGRAM\n"
    )
    paths = ("Main.b", "Main.w", "Main.a", "Main.p")
    prints = [argument for each in paths for argument in ("--print", each)]
    said = scanbench("run", str(path), "--scans", "1", "--every", "1", *prints)
    shown = {"Main.b": "TRUE", "Main.w": "16#00FF", "Main.a": "[FALSE, TRUE]", "Main.p": "(id := 7, name := 'nut')"}
    row = "1: " + ", ".join(f"{each} = {value}" for each, value in shown.items())
    assert said.stdout.splitlines() == [row, *(f"{each} = {value}" for each, value in shown.items())]
    assert said.stderr == "1 scans, 0.01 s of PLC time\n"


def test_a_command_applies_before_the_scan_it_names(count: str) -> None:
    shown = scanbench("run", count, "--scans", "5", "--set", "Main.n=100@3", "--every", "1", "--print", "Main.n")
    assert shown.stdout.splitlines()[:5] == [
        f"{scan}: Main.n = {value}" for scan, value in ((1, 1), (2, 2), (3, 3), (4, 101), (5, 102))
    ]


def test_a_force_holds_against_the_program(count: str) -> None:
    shown = scanbench(
        "run", count, "--scans", "9", "--force", "Main.n=7@2", "--print", "Main.n", "--print", "Main.a[2]"
    )
    assert shown.stdout.splitlines() == ["Main.n = 7", "Main.a[2] = 8"]


def test_a_program_that_does_not_compile(tmp_path: Path) -> None:
    (tmp_path / "a.st").write_text("PROGRAM Main\nx := 1;\nEND_PROGRAM", "utf-8")
    result = scanbench("run", str(tmp_path / "a.st"), "--scans", "1", "--json")
    assert result.returncode == 1
    assert json.loads(result.stdout)["problems"][0]["code"] == "T001"


TRAPS = [
    *((engine, "division", "x := 1 / x;") for engine in ("native", "reference", "both")),
    *((engine, "bounds", "a[x + 9] := 1;") for engine in ("native", "reference", "both")),
    # ten million rounds take Python a while; the cases run endless loops on both engines with a smaller budget
    ("native", "loop", "WHILE TRUE DO x := 0; END_WHILE;"),
]


@pytest.mark.parametrize(("engine", "kind", "statement"), TRAPS)
def test_a_trap_names_file_and_line(tmp_path: Path, engine: str, kind: str, statement: str) -> None:
    path = tmp_path / "a.st"
    path.write_text(f"PROGRAM Main\nVAR x : INT; a : ARRAY[1..3] OF INT; END_VAR\n{statement}\nEND_PROGRAM", "utf-8")
    call = process if (engine, kind) == ("native", "division") else scanbench
    result = call("run", str(path), "--scans", "3", "--engine", engine, "--json")
    trap = json.loads(result.stdout)["trap"]
    assert result.returncode == 4
    assert (trap["kind"], trap["file"], trap["line"]) == (kind, str(path), 3)
    assert f"{path}:3" in result.stderr


@pytest.mark.parametrize(
    ("args", "message"),
    [
        (["--set", "Main.nn=1"], "Main.n"),
        (["--set", "Main.n"], "PATH=VALUE"),
        (["--set", "Main.n=abc"], "integer"),
        (["--print", "Nowhere"], "Nowhere"),
        (["--model", "CJ9"], "no model"),
        (["--raise", "batery-error", "--model", "CJ1M-CPU63"], "battery-error"),
        (["--interval", "soon"], "--interval"),
    ],
)
def test_wrong_usage_says_what_to_do(count: str, args: list[str], message: str) -> None:
    result = scanbench("run", count, "--scans", "1", *args)
    assert result.returncode == 2
    assert message in result.stderr


def test_what_the_model_protects_is_refused(count: str) -> None:
    result = scanbench("run", count, "--scans", "1", "--model", "CJ1M-CPU63", "--set", "A402.12=TRUE")
    assert result.returncode == 2
    assert "read-only" in result.stderr


def test_the_example_of_the_error_catalogue(count: str) -> None:
    result = scanbench(
        "run", count, "--scans", "3", "--model", "CJ1M-CPU63", "--raise", "memory-error:io-table-checksum@1", "--json",
        "--print", "A400", "--print", "A401.15", "--print", "A403.05", "--print", "Main.n",
    )  # fmt: skip
    assert json.loads(result.stdout)["values"] == {"A400": 0x80F4, "A401.15": True, "A403.05": True, "Main.n": 1}


def test_help_documents_every_command() -> None:
    shown = process("--help").stdout
    assert all(command in shown for command in ("serve", "check", "run", "verify"))
    assert "--raise" in scanbench("run", "--help").stdout


def test_values_are_keyed_by_the_path_as_it_was_asked_for(count: str) -> None:
    result = scanbench("run", count, "--scans", "2", "--json", "--print", "main.N", "--print", "main.a[ 2 ]")
    assert json.loads(result.stdout)["values"] == {"main.N": 2, "main.a[ 2 ]": 2}


def test_refusals_are_in_the_json(count: str) -> None:
    result = scanbench("run", count, "--scans", "1", "--model", "CJ1M-CPU63", "--set", "A402.12=TRUE", "--json")
    assert json.loads(result.stdout)["refused"][0]["scan"] == 0


def test_without_models_it_says_where_it_looked(count: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("SCANBENCH_MODELS", str(tmp_path / "none"))
    result = process("check", count)
    assert result.returncode == 2
    assert "Traceback" not in result.stderr


def test_violations_are_printed_with_their_places_and_not_by_the_hundred(tmp_path: Path) -> None:
    path = tmp_path / "many.st"
    path.write_text(
        "FUNCTION_BLOCK Valve\nVAR_INPUT want : INT; END_VAR\nVAR open : INT (0..10); END_VAR\nopen := want;\n"
        "END_FUNCTION_BLOCK\nPROGRAM Main\nVAR v : ARRAY[1..30] OF Valve; i : INT; END_VAR\n"
        "FOR i := 1 TO 30 DO v[i](want := 99); END_FOR;\nEND_PROGRAM\n",
        "utf-8",
    )
    text = scanbench("run", str(path), "--scans", "2").stderr.splitlines()
    left = f"{path}:4:9: subrange: open in Main.v[1] was 99, outside of 0..10; called from Main {path}:8, 2 times"
    assert text[0].startswith(left)
    assert text[20].startswith("subrange: 10 more places, 60 violations in all")
    found = json.loads(scanbench("run", str(path), "--scans", "2", "--json").stdout)
    assert (len(found["violations"]), found["violations_dropped"]) == (30, 0)
    (call,) = found["violations"][0]["calls"]
    assert (call["instance"], call["line"], found["violations"][0]["calls_cut"]) == ("Main", 8, False)


@pytest.mark.parametrize(
    "command", [(str(SCANBENCH),), (sys.executable, "-m", "scanbench")], ids=["installed", "module"]
)
def test_the_command_can_be_called_in_both_ways(command: tuple[str, ...]) -> None:
    said = process("check", "-h", command=command)
    assert said.returncode == 0, said.stderr
    assert "check [OPTIONS]" in said.stdout


def test_a_packed_project_runs_like_its_folder(tmp_path: Path) -> None:
    (tmp_path / "Main.st").write_text(COUNT, "utf-8")
    (tmp_path / "project.json").write_text('{"name": "Line", "model": "CJ1M-CPU63"}', "utf-8")
    packed = tmp_path / "line.zip"
    packed.write_bytes(pack("Line", "CJ1M-CPU63", [], {"Main.st": COUNT}))
    (folder, archive) = (scanbench("run", str(path), "--scans", "5", "--hash") for path in (tmp_path, packed))
    assert archive.returncode == folder.returncode == 0, archive.stderr
    assert archive.stdout == folder.stdout
    assert scanbench("check", str(packed)).returncode == 0
    refused = scanbench("format", str(packed))
    assert (refused.returncode, "unpack it" in refused.stderr) == (2, True)
