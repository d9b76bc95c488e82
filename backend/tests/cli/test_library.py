"""`scanbench library`, and the libraries and names that `check` and `run` find for a project of TwinCAT."""

from pathlib import Path

import pytest

from tests.cli.calling import scanbench

PROJECT = """<Project><PropertyGroup><Name>Line</Name><Title>Line</Title></PropertyGroup><ItemGroup>
{compiled}</ItemGroup><ItemGroup>
<PlaceholderReference Include="Tc2_System"><Namespace>Tc2_System</Namespace></PlaceholderReference>
<LibraryReference Include="Parts,*,somebody"><Namespace>Parts</Namespace></LibraryReference>
</ItemGroup></Project>"""


def exported(declaration: str, body: str) -> str:
    name = declaration.split()[1]
    return (
        f'<TcPlcObject><POU Name="{name}"><Declaration><![CDATA[{declaration}]]></Declaration>'
        f"<Implementation><ST><![CDATA[{body}]]></ST></Implementation></POU></TcPlcObject>"
    )


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """Two projects of TwinCAT in one folder: a line, and the library Parts that it uses."""
    files = {
        "line/Line.plcproj": PROJECT.format(compiled='<Compile Include="POUs\\MAIN.TcPOU" />'),
        "line/POUs/MAIN.TcPOU": exported(
            "PROGRAM MAIN\nVAR n : INT; s : Tc2_System.T_MaxString; d : DINT; END_VAR",
            "n := Parts.Twice(n + 1);\nd := ADSLOGSTR(ADSLOG_MSGTYPE_LOG, s, s);",
        ),
        "line/POUs/Old.TcPOU": exported("PROGRAM Old\nVAR x : NoSuchType; END_VAR", ""),
        "parts/Parts.plcproj": "<Project><PropertyGroup><Name>Parts</Name></PropertyGroup><ItemGroup>"
        '<Compile Include="Twice.TcPOU" /></ItemGroup></Project>',
        "parts/Twice.TcPOU": exported("FUNCTION Twice : INT\nVAR_INPUT x : INT; END_VAR", "Twice := 2 * x;"),
    }
    for path, text in files.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text)
    return tmp_path


def test_a_twincat_project_is_checked_and_run_with_the_libraries_that_it_uses(project: Path) -> None:
    found = scanbench("check", str(project), "--dialect", "twincat")
    assert found.returncode == 0, found
    assert [line for line in found.stdout.splitlines() if "W006" not in line] == [
        f"{project}/line/POUs/MAIN.TcPOU:3:6: W008 warning: `ADSLOGSTR` is a stub, without a real body: `Stub_ADSLOGSTR` is "
        f"its result. Set that in the watch table, by a force or by a stimulus, or write a body in {project}/libraries/Tc2_System.st."
    ]
    options = ("--dialect", "twincat", "--scans", "3", "--print", "MAIN.n", "--print", "MAIN.d")
    ran = scanbench("run", str(project), *options, "--set", "Stub_ADSLOGSTR=7")
    assert (ran.returncode, ran.stdout.split()) == (0, ["MAIN.n", "=", "14", "MAIN.d", "=", "7"]), ran


def test_what_the_project_file_defines_chooses_what_is_compiled(project: Path) -> None:
    body = "n := n + 1;\n{IF defined (Heater)} n := n + 10; {ELSE} n := NoSuchVariable; {END_IF}"
    (project / "line/POUs/MAIN.TcPOU").write_text(exported("PROGRAM MAIN\nVAR n : INT; END_VAR", body))
    file = project / "line/Line.plcproj"
    file.write_text(file.read_text().replace("<Title>", "<CompilerDefines>Fast, HEATER</CompilerDefines><Title>"))
    options = ("--dialect", "twincat", "--scans", "2", "--print", "MAIN.n")
    ran = scanbench("run", str(project), *options)
    assert (ran.returncode, ran.stdout.split()) == (0, ["MAIN.n", "=", "22"]), ran
    (project / "language.json").write_text('{"version": 3, "dialect": "twincat", "defines": ["Fast"]}')
    file.write_text(file.read_text().replace("HEATER", "Slow"))
    assert scanbench("check", str(project)).returncode == 1


def test_the_report_says_which_libraries_are_missing(project: Path) -> None:
    found = scanbench("check", str(project / "line"), "--dialect", "twincat", "--report")
    assert "Parts" in found.stdout.partition("missing libraries")[2]
    page = project / "report.html"
    scanbench("check", str(project / "line"), "--dialect", "twincat", "--html", str(page))
    assert "Missing, so that their names are not known: Parts." in page.read_text()
    nowhere = scanbench("check", str(project / "line"), "--html", str(project / "no" / "report.html"))
    assert (nowhere.returncode, "cannot be written" in nowhere.stderr) == (2, True)


def test_libraries_are_listed_shown_and_added(tmp_path: Path) -> None:
    assert "Util" in scanbench("library", "list").stdout
    shown = scanbench("library", "show", "tc2_system").stdout
    assert "function        ADSLOGSTR  stub" in shown
    assert "type            T_MaxString" in shown
    assert "FUNCTION EXTRACT" in scanbench("library", "show", "Util", "--text").stdout
    assert scanbench("library", "add", "Util", str(tmp_path)).stdout.strip() == str(tmp_path / "libraries/Util.st")
    again = scanbench("library", "add", "Util", str(tmp_path))
    assert (again.returncode, "is there already" in again.stderr) == (2, True)
    unknown = scanbench("library", "show", "Utils")
    assert (unknown.returncode, "there is no library Utils" in unknown.stderr) == (2, True)


TASK = """<TcPlcObject><Task Name="{name}" Id="{{1}}"><!--CycleTime in micro seconds.--><CycleTime>{cycle}</CycleTime>
<Priority>{priority}</Priority>{calls}</Task></TcPlcObject>"""


def test_programs_of_a_twincat_project_run_as_often_as_its_tasks_say(project: Path) -> None:
    file = project / "line/Line.plcproj"
    names = ("MAIN.TcPOU", "Slow.TcPOU", "Idle.TcPOU")
    compiled = "".join(f'<Compile Include="POUs\\{each}" />' for each in names)
    compiled += '<Compile Include="PlcTask.TcTTO" /><Compile Include="SlowTask.TcTTO" />'
    file.write_text(PROJECT.format(compiled=compiled))
    for name in ("MAIN", "Slow", "Idle"):
        text = exported(f"PROGRAM {name}\nVAR n : INT; END_VAR", "n := n + 1;")
        (project / f"line/POUs/{name}.TcPOU").write_text(text)
    call = "<PouCall><Name>{0}</Name></PouCall>".format
    fast = TASK.format(name="PlcTask", cycle=2000, priority=20, calls=call("MAIN") + call("NotThere"))
    (project / "line/PlcTask.TcTTO").write_text(fast)
    (project / "line/SlowTask.TcTTO").write_text(
        TASK.format(name="SlowTask", cycle=10000, priority=21, calls=call("Slow"))
    )
    options = ("--dialect", "twincat", "--scans", "10", "--print", "MAIN.n", "--print", "Slow.n", "--print", "Idle.n")
    ran = scanbench("run", str(project / "line"), *options)
    assert ran.returncode == 0, ran
    assert ran.stdout.split() == ["MAIN.n", "=", "10", "Slow.n", "=", "2", "Idle.n", "=", "0"]
    assert "0.02 s of PLC time" in ran.stderr


def test_a_project_runs_with_placeholders_for_a_library_that_nobody_has(project: Path) -> None:
    main = exported(
        "PROGRAM MAIN\nVAR belt : Parts.FB_Belt; n : INT; END_VAR",
        "belt(bRun := n < 3, nSpeed => n);\nn := n + Parts.F_Twice(n);",
    )
    (project / "line/POUs/MAIN.TcPOU").write_text(main)
    options = ("--dialect", "twincat", "--scans", "2", "--print", "MAIN.n")
    ran = scanbench("run", str(project / "line"), *options, "--set", "Stub_F_Twice=7", "--set", "MAIN.belt.nSpeed=5")
    assert (ran.returncode, ran.stdout.split()) == (0, ["MAIN.n", "=", "12"]), ran
    found = scanbench("check", str(project / "line"), "--dialect", "twincat", "--report")
    assert "1 of these 1 use placeholders" in found.stdout
    assert found.returncode == 0


def test_projects_that_are_no_program_together_are_reported_one_by_one(project: Path) -> None:
    (project / "parts/Parts.plcproj").write_text(
        "<Project><PropertyGroup><Name>Parts</Name></PropertyGroup><ItemGroup>"
        '<Compile Include="Twice.TcPOU" /><Compile Include="MAIN.TcPOU" /></ItemGroup></Project>'
    )
    (project / "parts/MAIN.TcPOU").write_text(exported("PROGRAM MAIN\nVAR n : INT; END_VAR", "n := Twice(4);"))
    found = scanbench("check", str(project), "--dialect", "twincat", "--report")
    assert "3 of 3 POUs (100.0 %) run" in found.stdout, found
    assert found.returncode == 0
    (project / "parts/Twice.TcPOU").write_text(
        exported("FUNCTION Twice : INT\nVAR_INPUT x : INT; END_VAR", "Twice := y;")
    )
    wrong = scanbench("check", str(project), "--dialect", "twincat")
    assert [line for line in wrong.stdout.splitlines() if " W0" not in line] == [
        f"{project}/parts/Twice.TcPOU:2:82: T001 `y` is not declared."
    ]


def test_files_with_signs_that_msbuild_escapes_are_read_and_missing_ones_are_said_once(project: Path) -> None:
    file = project / "line/Line.plcproj"
    listed = '<Compile Include="POUs\\MAIN.TcPOU" /><Compile Include="Sub%20%28Base%29\\F_One.TcPOU" />'
    gone = '<Compile Include="DUTs\\ST_Gone%27s.TcDUT" />'
    file.write_text(PROJECT.format(compiled=listed + gone).replace("Parts,*,somebody", "Tc2_Standard"))
    (project / "line/Sub (Base)").mkdir()
    (project / "line/Sub (Base)/F_One.TcPOU").write_text(exported("FUNCTION F_One : INT", "F_One := 1;"))
    (project / "line/POUs/MAIN.TcPOU").write_text(
        exported("PROGRAM MAIN\nVAR n : INT; e : (First, Last) := First; s : ST_Gone; END_VAR",
                 "n := n + F_One();\nIF e = First THEN e := Last; s.count := n; END_IF")
    )  # fmt: skip
    found = scanbench("check", str(project / "line"), "--report")
    assert (found.returncode, "2 of 2 POUs (100.0 %) run" in found.stdout) == (0, True), found
    assert found.stderr.count("DUTs/ST_Gone's.TcDUT") == 1
    assert "lists a file that is not there" in found.stderr
    assert "files that the project lists and that are missing: DUTs/ST_Gone's.TcDUT" in found.stdout
    ran = scanbench("run", str(project / "line"), "--scans", "3", "--print", "MAIN.n", "--print", "MAIN.s.count")
    assert (ran.returncode, ran.stdout.split()) == (0, ["MAIN.n", "=", "3", "MAIN.s.count", "=", "1"]), ran


def test_a_library_to_which_a_project_does_not_refer_gives_no_names_where_one_is_missing(project: Path) -> None:
    file = project / "line/Line.plcproj"
    compiled = PROJECT.format(compiled='<Compile Include="POUs\\MAIN.TcPOU" />')
    main = exported("PROGRAM MAIN\nVAR c : E_PMLCommand; s : T_MaxString; END_VAR", "c := E_PMLCommand.Abort;")
    (project / "line/POUs/MAIN.TcPOU").write_text(main)
    file.write_text(compiled.replace("Parts,*,somebody", "Tc3_PackML_V3"))
    found = scanbench("check", str(project / "line"))
    assert (found.returncode, "`E_PMLCommand` is a placeholder" in found.stdout) == (0, True), found
    file.write_text(compiled.replace("Parts,*,somebody", "Tc3_PackML_V2"))
    known = scanbench("check", str(project / "line"))
    assert (known.returncode, "has no value `Abort`" in known.stdout) == (1, True), known
