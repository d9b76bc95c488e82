"""`scanbench check --report`: how many POUs are whole, and what the files are made of."""

from scanbench.check.build import check_sources
from scanbench.cli.check_report import report_files, report_json, report_lines
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


def test_pous_with_errors_are_counted_apart_from_constructs() -> None:
    checked = check_sources(TEXTS, MODELS["GENERIC-IEC"])
    reports = report_files(TEXTS, checked.problems)
    assert [(each.name, each.pous, each.clean) for each in reports] == [("Types.st", 0, 0), ("Main.st", 3, 1)]
    assert [each.errors for each in reports] == [1, 2]
    assert sum(each.refused.total() for each in reports) == 1
    lines = report_lines(reports)
    assert "1 of 3 POUs (33.3 %) have no error of their own" in lines
    assert "1 of 3 POUs (33.3 %) run: neither they nor what they use has an error" in lines
    assert not any("100" in line for line in lines)
    found = [(each["pous"], each["pous_without_errors"]) for each in report_json(reports)]
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
    reports = report_files(texts, check_sources(texts, MODELS["GENERIC-IEC"]).problems)
    assert [(each.name, each.pous, each.run) for each in reports] == [("Types.st", 0, 0), ("Blocks.st", 3, 1)]
    assert [each["pous_that_run"] for each in report_json(reports)] == [0, 1]
