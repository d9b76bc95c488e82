"""Exports with a file for each object: the layouts that scripts of CODESYS write, each as a project of its own."""

import pytest

from scanbench.check.build import check_sources
from scanbench.check.incremental import Checks
from scanbench.debug.frames import stack
from scanbench.language.complete import complete
from scanbench.language.navigate import named_at
from scanbench.language.reading import Readings
from scanbench.problems import Severity
from scanbench.reports.program_report import program_report
from scanbench.syntax.language_file import guess_dialect, with_dialect, with_dialect_by_format
from scanbench.syntax.objects import is_export
from tests.caseformat import MODELS
from tests.debug.scenes import checked, halted
from tests.syntax.both_engines import BothEngines

ONE = "// === IMPLEMENTATION ==="
TWO = "// --- implementation ---"
SCRIBE = "// --- BEGIN IMPLEMENTATION ---"
MAIN = """PROGRAM PLC_PRG
VAR
    tank : FB_Tank; view : I_Level; level : DINT; top : DINT; filled : BOOL; name : DINT;
END_VAR

{mark}
tank(inflow := 3);
IF tank.level > 5 THEN
    tank.Drain();
END_IF
filled := tank.Fill(amount := 2);
tank.Limit := 40;
view := tank;
level := view.Shown;
top := tank.Limit + GVL.offset;
name := offset;
"""
TANK = """FUNCTION_BLOCK FB_Tank EXTENDS FB_Base IMPLEMENTS I_Level
VAR_INPUT
    inflow : DINT;
END_VAR
VAR
    _limit : DINT := 10;
END_VAR

{mark}
SUPER^();
level := level + inflow;
"""
BASE = (
    "FUNCTION_BLOCK FB_Base\nVAR_OUTPUT\n    level : DINT;\n    calls : DINT;\nEND_VAR\n\n{mark}\ncalls := calls + 1;"
)
FILL = "METHOD PUBLIC Fill : BOOL\nVAR_INPUT\n    amount : DINT;\nEND_VAR\n\n{mark}\nlevel := level + amount;\nFill := level > _limit;"
LIST = "VAR_GLOBAL\n    offset : DINT := 7;\nEND_VAR"
ITSELF = "INTERFACE I_Level"

FIRST = {
    "App/PLC_PRG.st": MAIN.format(mark=ONE),
    "App/Tanks/FB_Base.st": BASE.format(mark=ONE),
    "App/Tanks/FB_Tank.st": TANK.format(mark=ONE),
    "App/Tanks/FB_Tank.Fill.st": FILL.format(mark=ONE),
    "App/Tanks/FB_Tank.Drain.st": f"//% cds-text-sync.kind=action\n\n{ONE}\nlevel := 0;",
    "App/Tanks/FB_Tank.Limit.st": (
        f"PROPERTY Limit : DINT\n\n{ONE}\n// === GET ===\nVAR\nEND_VAR\n\n{ONE}\nLimit := _limit;\n\n"
        f"// === SET ===\nVAR\n    most : DINT := 30;\nEND_VAR\n\n{ONE}\n_limit := MIN(Limit, most);"
    ),
    "App/Tanks/FB_Tank.Shown.st": f"PROPERTY Shown : DINT\n\n{ONE}\n// === GET ===\nShown := level;",
    "App/I_Level.st": ITSELF,
    "App/I_Level.Shown.st": "PROPERTY Shown : DINT\n\n" + f"{ONE}\n// === GET ===\nVAR\nEND_VAR",
    "App/GVL.st": LIST,
}
SECOND = {
    "App/PLC_PRG.st": MAIN.format(mark=TWO),
    "App/FB_Base.st": BASE.format(mark=TWO),
    "App/FB_Tank.st": TANK.format(mark=TWO),
    "App/FB_Tank.Fill.st": FILL.format(mark=TWO),
    "App/FB_Tank.Drain.st": "level := 0;",
    "App/FB_Tank.Limit.st": "PROPERTY Limit : DINT",
    "App/FB_Tank.Limit.Get.st": f"VAR\nEND_VAR\n\n{TWO}\n\nLimit := _limit;\n",
    "App/FB_Tank.Limit.Set.st": f"VAR\n    most : DINT := 30;\nEND_VAR\n\n{TWO}\n\n_limit := MIN(Limit, most);\n",
    "App/FB_Tank.Shown.st": "PROPERTY Shown : DINT",
    "App/FB_Tank.Shown.Get.st": f"{TWO}\n\nShown := level;\n",
    "App/I_Level.st": ITSELF,
    "App/I_Level.Shown.st": "PROPERTY Shown : DINT",
    "App/GVL.st": LIST,
}
THIRD = {
    "application/PLC_PRG.st": MAIN.format(mark=SCRIBE),
    "application/src/FB_Base.st": BASE.format(mark=SCRIBE),
    "application/src/FB_Tank.st": TANK.format(mark=SCRIBE),
    "application/src/FB_Tank.Fill.st": FILL.format(mark=SCRIBE),
    "application/src/FB_Tank.Drain.st": f"METHOD Drain\n\n{SCRIBE}\n\nlevel := 0;\n",
    "application/src/FB_Tank.Limit.st": (
        "PROPERTY Limit : DINT\nGET\nLimit := _limit;\nEND_GET\nSET\nVAR most : DINT := 30; END_VAR\n"
        "_limit := MIN(Limit, most);\nEND_SET\nEND_PROPERTY"
    ),
    "application/src/FB_Tank.Shown.st": f"PROPERTY Shown : DINT\n\n{SCRIBE}\n\nShown := level;\n",
    "application/I_Level.st": "INTERFACE I_Level\nPROPERTY Shown : DINT\nGET\nEND_GET\nEND_PROPERTY\nEND_INTERFACE",
    "application/GVL.gvl.st": LIST,
}
LAYOUTS = {"marks with equal signs": FIRST, "halves in files": SECOND, "marks with BEGIN": THIRD}
each_layout = pytest.mark.parametrize("files", LAYOUTS.values(), ids=LAYOUTS)
MODEL = MODELS["GENERIC-IEC"]


@each_layout
def test_a_project_of_objects_runs(files: dict[str, str]) -> None:
    project = with_dialect(files, "codesys")
    found = check_sources(project, MODEL)
    assert [str(each) for each in found.problems] == []
    engines = BothEngines(project, MODEL)
    names = ("level", "top", "filled", "tank.calls", "name")
    computed = []
    for _ in range(3):  # 3 + 2; 5 + 3, drained, + 2; 2 + 3 + 2
        engines.run()
        computed.append(engines.values(*(f"PLC_PRG.{each}" for each in names)))
    assert computed == [["5", "37", "FALSE", "1", "7"], ["2", "37", "FALSE", "2", "7"], ["7", "37", "FALSE", "3", "7"]]


@each_layout
def test_places_are_those_of_the_file_that_they_are_in(files: dict[str, str]) -> None:
    wrong = {name: text.replace("Limit := _limit;", "Limit := _limt;") for name, text in files.items()}
    found = check_sources(with_dialect(wrong, "codesys"), MODEL)
    (problem,) = (each for each in found.problems if each.severity is Severity.ERROR)
    text = wrong[problem.span.file].split("\n")[problem.span.line - 1]
    assert text[problem.span.column - 1 : problem.span.end_column - 1] == "_limt"
    methods = {each.name: each.file for each in found.pous if each.kind in ("method", "action")}
    assert methods["FB_Tank.Fill"].endswith("FB_Tank.Fill.st")
    assert methods["FB_Tank.Drain"].endswith("FB_Tank.Drain.st")


@each_layout
def test_the_report_counts_its_pous(files: dict[str, str]) -> None:
    project = with_dialect(files, "codesys")
    report = program_report(project, check_sources(project, MODEL).problems)
    assert (sum(each.pous for each in report.files), sum(each.run for each in report.files)) == (4, 4)
    wrong = {name: text.replace("level + amount", "level + amont") for name, text in project.items()}
    report = program_report(wrong, check_sources(wrong, MODEL).problems)
    runs = {each.name.rpartition("/")[2]: each.run for each in report.files if each.pous}
    assert runs == {"PLC_PRG.st": 0, "FB_Base.st": 1, "FB_Tank.st": 0, "I_Level.st": 1}


@each_layout
def test_an_edit_of_a_member_is_seen(files: dict[str, str]) -> None:
    checks, project = Checks(), with_dialect(files, "codesys")
    assert checks.check(project, MODEL, 10_000_000).program is not None
    wrong = {name: text.replace("level + amount", "level + amont") for name, text in project.items()}
    (problem,) = checks.check(wrong, MODEL, 10_000_000).problems
    assert problem.span.file.endswith("FB_Tank.Fill.st")
    assert checks.check(project, MODEL, 10_000_000).problems == ()


@each_layout
def test_a_breakpoint_halts_in_the_file_of_a_member(files: dict[str, str]) -> None:
    program = checked(with_dialect(files, "codesys"))
    for name, line_of in (("FB_Tank.Fill.st", "Fill := level"), ("PLC_PRG.st", "top := tank")):
        file = next(each for each in files if each.endswith(name))
        line = files[file][: files[file].index(line_of)].count("\n") + 1
        frame = stack(halted(program, line, file=file))[0]
        assert (frame.file, frame.line) == (file, line)


@each_layout
def test_a_call_leads_to_the_file_of_a_member(files: dict[str, str]) -> None:
    reading = Readings(MODEL).read(with_dialect(files, "codesys"))
    main = next(each for each in files if each.endswith("PLC_PRG.st"))
    found = [named_at(reading, main, files[main].index(name) + 1) for name in ("Fill(", "Drain(", "Limit :=")]
    ends = [{each.span.file.rpartition("/")[2] for each in reading.declared(it.symbol)} for it in found if it]
    assert [min(each) for each in ends] == ["FB_Tank.Fill.st", "FB_Tank.Drain.st", min(ends[2])]
    assert "FB_Tank.Limit.st" in ends[2]


@each_layout
def test_completion_in_a_member_offers_what_its_block_has(files: dict[str, str]) -> None:
    reading = Readings(MODEL).read(with_dialect(files, "codesys"))
    for name, text, own in (
        ("FB_Tank.st", "level := level + inflow", {"inflow", "_limit", "level"}),
        ("FB_Tank.Fill.st", "Fill := level", {"amount", "_limit", "level"}),
        ("FB_Tank.Drain.st", "level := 0", {"_limit", "level", "inflow"}),
    ):
        file = next(each for each in files if each.endswith(name))
        offered = {each.label for each in complete(reading, file, files[file].index(text))}
        assert own <= offered, name


@each_layout
def test_it_is_codesys(files: dict[str, str]) -> None:
    assert is_export(files)
    assert guess_dialect(files) == "codesys"
    assert '"codesys"' in with_dialect_by_format(files)["language.json"]


def test_what_is_missing_is_said() -> None:
    project = with_dialect(SECOND, "codesys")
    del project["App/FB_Tank.Limit.st"]
    messages = [each.message for each in check_sources(project, MODEL).problems if each.code == "D002"]
    assert any("`App" not in each and "`FB_Tank.Limit.st` is missing" in each for each in messages)
    project = with_dialect(SECOND, "codesys") | {"App/Other.Run.st": f"METHOD Run\n{TWO}\n;"}
    (problem,) = check_sources(project, MODEL).problems
    assert (problem.severity, problem.span.file) == (Severity.WARNING, "App/Other.Run.st")
    assert "No file has the POU `Other`" in problem.message
    del project["App/Other.Run.st"], project["App/FB_Tank.Shown.Get.st"]
    assert any("`FB_Tank.Shown.Get.st` is missing" in each.message for each in check_sources(project, MODEL).problems)


def test_an_interface_whose_accessors_are_known_has_these() -> None:
    files = SECOND | {"App/I_Level.Shown.Get.st": "", "App/I_Level.Shown.Set.st": ""}
    found = [each.message for each in check_sources(with_dialect(files, "codesys"), MODEL).problems]
    assert ["`SET of I_Level.Shown`" in each for each in found] == [True]


def test_what_is_left_out_of_the_build_is_left_out() -> None:
    out = f"//% cds-text-sync.exclude_from_build=true\n\nFUNCTION_BLOCK Old\nVAR a : NOWHERE; END_VAR\n{ONE}\nb := ;"
    assert check_sources(with_dialect(FIRST | {"App/Old.st": out}, "codesys"), MODEL).problems == ()


def test_a_text_that_closes_its_pous_is_no_export() -> None:
    text = f"PROGRAM Main\nVAR n : INT; END_VAR\n{ONE}\nn := 1;\nEND_PROGRAM\n"
    assert not is_export({"Main.st": text})
    unclosed = check_sources({"Main.st": "PROGRAM Main\nVAR n : INT; END_VAR\nn := 1;\n"}, MODEL)
    assert ["`END_PROGRAM` expected" in each.message for each in unclosed.problems] == [True]


def test_two_blocks_of_one_name_in_two_applications_keep_their_own_members() -> None:
    files = {
        "A/FB.st": f"FUNCTION_BLOCK FB\n{ONE}\n;",
        "B/FB.st": f"FUNCTION_BLOCK FB\n{ONE}\n;",
        "A/FB.Run.st": f"METHOD Run\n{ONE}\n;",
        "B/FB.Go.st": f"METHOD Go\n{ONE}\n;",
    }
    found = {(each.name, each.file) for each in check_sources(files, MODEL).pous if each.kind == "method"}
    assert found == {("FB.Run", "A/FB.Run.st"), ("FB.Go", "B/FB.Go.st")}


def test_texts_that_were_copied_out_of_an_editor_are_closed_where_they_end() -> None:
    copied = {
        "F_Inc.st": "FUNCTION F_Inc : INT\nVAR_INPUT a : INT; END_VAR\n\nF_Inc := a + 1;\n",
        "Main.st": "// runs\nPROGRAM Main\nVAR n : INT; END_VAR\nIF n = 0 OR_ELSE n = 1 THEN n := F_Inc(n); END_IF",
    }
    assert guess_dialect(copied) == "codesys"
    project = with_dialect_by_format(copied)
    assert [each for each in check_sources(project, MODEL).problems if each.severity is Severity.ERROR] == []
    engines = BothEngines(project, MODEL)
    engines.run()
    engines.run()
    assert engines.values("Main.n") == ["2"]
    one = {"F_Inc.st": copied["F_Inc.st"]}
    assert [each.code for each in check_sources(with_dialect(one, "twincat"), MODEL).problems] == ["D011"]
    assert ["`END_FUNCTION` expected" in each.message for each in check_sources(one, MODEL).problems] == [True]
    closed = with_dialect(copied | {"Other.st": "FUNCTION Other : INT\nOther := 1;\nEND_FUNCTION\n"}, "codesys")
    assert sum("expected to close" in each.message for each in check_sources(closed, MODEL).problems) == 2
