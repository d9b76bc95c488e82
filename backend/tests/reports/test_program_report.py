"""`scanbench check --report`: how many POUs are whole, and what the files are made of."""

from scanbench.check.build import check_sources
from scanbench.reports.program_page import program_page
from scanbench.reports.program_report import ProgramReport, program_report, report_json, report_lines
from tests.caseformat import MODELS

TEXTS = {
    "Types.st": "TYPE T : STRUCT a : NOWHERE; END_STRUCT END_TYPE\n",
    "Main.st": """FUNCTION_BLOCK Good
VAR n : INT; END_VAR
n := n + 1;
END_FUNCTION_BLOCK
FUNCTION_BLOCK Bad
VAR n : INT; END_VAR
n := missing;
n := other;
END_FUNCTION_BLOCK
PROGRAM Main
VAR p : POINTER TO INT; END_VAR
p := __NEW(INT);
END_PROGRAM
""",
}


def files_of(report: ProgramReport) -> list[dict[str, object]]:
    files = report_json(report)["files"]
    assert isinstance(files, list)
    return files


def test_pous_with_errors_are_counted_apart_from_constructs() -> None:
    checked = check_sources(TEXTS, MODELS["GENERIC-IEC"])
    report = program_report(TEXTS, checked.problems, ["Parts"])
    reports = report.files
    assert [(each.name, each.pous, each.clean) for each in reports] == [("Types.st", 0, 0), ("Main.st", 3, 1)]
    assert [each.errors for each in reports] == [1, 2]
    assert sum(each.refused.total() for each in reports) == 1
    lines = report_lines(report)
    assert "1 of 3 POUs (33.3 %) have no error of their own" in lines
    assert "1 of 3 POUs (33.3 %) run: neither they nor what they use has an error" in lines
    assert not any("100" in line for line in lines)
    assert "missing libraries: Parts" in lines
    assert any("T001 `_` is not declared." in line and line.startswith("     1       2") for line in lines), lines
    found = [(each["pous"], each["pous_without_errors"]) for each in files_of(report)]
    assert found == [(0, 0), (3, 1)]


def test_a_pou_runs_where_nothing_that_it_uses_has_an_error() -> None:
    texts = {
        "Types.st": "TYPE Broken : STRUCT a : NOWHERE; END_STRUCT END_TYPE\nTYPE Fine : INT; END_TYPE\n",
        "Blocks.st": """FUNCTION_BLOCK Inner
VAR b : Broken; END_VAR
END_FUNCTION_BLOCK
FUNCTION_BLOCK Outer
VAR i : Inner; END_VAR
i();
END_FUNCTION_BLOCK
FUNCTION_BLOCK Other
VAR f : Fine; END_VAR
f := 1;
END_FUNCTION_BLOCK
""",
    }
    report = program_report(texts, check_sources(texts, MODELS["GENERIC-IEC"]).problems)
    reports = report.files
    assert [(each.name, each.pous, each.run) for each in reports] == [("Types.st", 0, 0), ("Blocks.st", 3, 1)]
    assert [each["pous_that_run"] for each in files_of(report)] == [0, 1]
    assert [(each.pou, str(each.place)) for each in report.waiting] == [
        ("Inner", "Types.st:1:26"),
        ("Outer", "Types.st:1:26"),
    ]
    assert "  Outer: Types.st:1:26" in report_lines(report)
    assert "Outer" in program_page(report, "Line")


def test_pous_that_use_a_stub_by_whatever_way_are_told_apart_and_libraries_are_not_counted() -> None:
    texts = {
        "libraries/Drive.st": """VAR_GLOBAL Stub_Heat : INT; END_VAR
FUNCTION Heat : INT
{stub}
Heat := Stub_Heat;
END_FUNCTION
""",
        "Main.st": """FUNCTION Hot : BOOL
Hot := Heat() > 80;
END_FUNCTION
PROGRAM Main
VAR hot : BOOL; n : INT; END_VAR
hot := Hot();
n := <script>;
END_PROGRAM
PROGRAM Plain
END_PROGRAM
""",
    }
    problems = check_sources(texts, MODELS["GENERIC-IEC"]).problems
    report = program_report(texts, problems)
    assert [(each.name, each.pous, each.run, each.stubbed) for each in report.files] == [("Main.st", 3, 2, 1)]
    assert report.libraries == ("Drive",)
    assert [each.code for each in report.stubs] == ["W008"]
    page = program_page(report, "Line <1>")
    assert "Line &lt;1&gt;" in page
    assert "1 of these 2 use stubs" in page
    assert "<script>" not in page


def test_a_file_that_declares_nothing_stops_no_report() -> None:
    files = {"a.st": "(* nothing *)\n", "b.st": "PROGRAM Main\nEND_PROGRAM\n"}
    checked = check_sources(files, MODELS["GENERIC-IEC"])
    report = program_report(files, checked.problems)
    assert [each.pous for each in report.files] == [0, 1]


def test_a_library_without_a_program_stops_nothing_and_names_are_left_out_where_they_differ() -> None:
    fine = {"Blocks.scl": 'FUNCTION_BLOCK "Good"\nVAR n : INT; END_VAR\nBEGIN\n#n := 1;\nEND_FUNCTION_BLOCK\n'}
    problems = check_sources(fine, MODELS["GENERIC-IEC"]).problems
    assert [(each.code, "There is no ORGANIZATION_BLOCK" in each.message) for each in problems] == [("D011", True)]
    assert program_report(fine, problems).causes == ()
    record = "TYPE T : STRUCT a : INT; END_STRUCT END_TYPE\n"
    wrong = {"Main.st": record + "PROGRAM Main\nVAR t : T; END_VAR\nt.b := 1;\nt.c := 1;\nEND_PROGRAM\n"}
    causes = program_report(wrong, check_sources(wrong, MODELS["GENERIC-IEC"]).problems).causes
    assert [each.message for each in causes] == ["`T` has no member `_`."]


def test_what_is_said_of_several_stubs_is_said_once_and_both_kinds_are_counted_in_the_column() -> None:
    texts = {
        "libraries/Drive.st": """VAR_GLOBAL Stub_Heat, Stub_Cool : INT; END_VAR
FUNCTION Heat : INT
{stub}
Heat := Stub_Heat;
END_FUNCTION
FUNCTION Cool : INT
{stub}
Cool := Stub_Cool;
END_FUNCTION
""",
        "libraries/Placeholders.st": "TYPE Recipe : STRUCT n : INT; END_STRUCT END_TYPE\n",
        "Main.st": """PROGRAM Main
VAR n : INT; END_VAR
n := Heat() + Cool() + Heat();
END_PROGRAM
PROGRAM Plain
VAR r : Recipe; END_VAR
r.n := 1;
END_PROGRAM
""",
    }
    report = program_report(texts, check_sources(texts, MODELS["GENERIC-IEC"]).problems)
    assert [(each.run, each.stubbed, each.placeheld, each.aided) for each in report.files] == [(2, 1, 1, 2)]
    lines = report_lines(report)
    assert lines[1].split()[1:4] == ["2", "2", "2"]
    assert sum("without a real body" in line for line in lines) == 1
    assert {"    Heat (Main.st:3:6)", "    Cool (Main.st:3:15)"} < set(lines)
    assert any("`Recipe` is a placeholder" in line and "Main.st:6:9" in line for line in lines)
