"""What is written as PLCopen XML and read again runs as before: the cases of all graphical languages, and a project as a whole."""

import re
from dataclasses import replace
from pathlib import Path

import pytest
from lxml import etree

from scanbench.check.build import check_sources
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.server.samples import templates
from scanbench.syntax.plcopen.project import read_project
from scanbench.syntax.plcopen.write import Form, write_project
from tests.caseformat import MODELS, Case, read_cases, run_case

LINE = (Path(__file__).parent / "line.xml").read_bytes()
CASES = Path(__file__).parent.parent.parent / "cases"
ALL = [case for path in sorted(CASES.glob("*.case")) for case in read_cases(path)]
DRAWN = re.compile(r"^ *(RUNG|NETWORK|INITIAL_STEP)\b", re.MULTILINE)
GRAPHICAL = [case for case in ALL if DRAWN.search(case.source) and not case.files and case.violations is None]
"""Those that name no line of their text."""
SCHEMA = etree.XMLSchema(etree.parse(Path(__file__).parent / "tc6_xml_v201.xsd"))
"""As PLCopen published it for TC6 2.01; this copy is that of the package plcopen 1.0.1."""
NOT_WRITTEN = {
    "charts/edges and loops of actions remember, each instance for itself; an address is an action",
    "charts/an heir that has an ACTION again, or a body, in a chart of its own with the same actions",
    "diagrams/a loop with a number, and its type",
    "diagrams/jumps of a diagram, rungs beside it, and a wire that a box sets",
    "diagrams/types that a wire says, EN on a wire, and a subrange",
    "diagrams/networks have wires of their own, with types of their own",
    "diagrams/a loop through an output of a block",
    "diagrams/a loop through an output of a different type than BOOL",
    "diagrams/outputs of a FUNCTION and a method go to wires",
    "ladder/a jump forward is taken at the end of its rung",
    "ladder/a rung that is switched off",
    "ladder/a method in rungs, and a block that inherits rungs with edges",
}
"""Cases with something that PLCopen's TC6 has no form for: it is left out, and told."""


def again(case: Case, form: Form = Form.TC6) -> tuple[Case, list[str]]:
    written = write_project("Case", {"case.st": case.source}, form)
    files = read_project(written.data).files
    return replace(case, source="".join(files.values())), written.left_out


@pytest.mark.parametrize("form", Form)
@pytest.mark.parametrize("case", GRAPHICAL, ids=[each.name for each in GRAPHICAL])
def test_a_case_runs_as_before_or_is_told(case: Case, form: Form) -> None:
    made, left = again(case, form)
    if form is Form.TC6:
        assert bool(left) == (case.name in NOT_WRITTEN), left
    if not left:
        run_case(made, [ReferenceEngine])


def test_inputs_that_are_given_by_their_place_have_names() -> None:
    text = (
        "FUNCTION Half : INT\nVAR_INPUT whole, plus : INT; END_VAR\nHalf := whole / 2 + plus;\nEND_FUNCTION\n"
        "PROGRAM Main\nVAR n : INT; END_VAR\nNETWORK\n    n := Half(n, 1);\nEND_NETWORK\nEND_PROGRAM\n"
    )
    files = read_project(write_project("Half", {"Main.st": text}).data).files
    assert "    n := Half(whole := n, plus := 1);\n" in files["Main.st"]


def test_a_return_before_a_branch_that_is_read_as_a_rung_of_its_own_is_told_in_any_rung() -> None:
    rung = "RUNG\n    < [a] -> #s | [a] | k(CU := ~, R := < [a] >, PV := 2) > RETURN\nEND_RUNG\n"
    head = "PROGRAM Main\nVAR a : BOOL; k : CTU; END_VAR\n"
    for before in ("", "RUNG\n    [a]\nEND_RUNG\n"):
        left = write_project("Two", {"Main.st": f"{head}{before}{rung}END_PROGRAM\n"}).left_out
        assert len(left) == 1
        assert "a jump or RETURN before other branches" in left[0]


@pytest.mark.parametrize("form", Form)
def test_global_variables_go_into_a_configuration_which_runs_nothing_of_its_own(form: Form) -> None:
    main = "PROGRAM Main\nVAR_EXTERNAL n : INT; END_VAR\nn := n + 1;\nEND_PROGRAM\n"
    written = write_project("Own", {"Globals.st": "VAR_GLOBAL\n    n : INT := 4;\nEND_VAR\n", "Main.st": main}, form)
    assert written.left_out == []
    files = read_project(written.data).files
    assert files["Configuration.st"] == "VAR_GLOBAL\n    n : INT := 4;\nEND_VAR\n"
    assert check_sources(files, MODELS["GENERIC-IEC"]).problems == ()


def test_a_project_is_the_same_text_again() -> None:
    files = {name: text for name, text in read_project(LINE).files.items() if name != "Main.st"}
    written = write_project("Line", files)
    assert written.left_out == []
    assert read_project(written.data).files == files
    assert write_project("Line", files).data == written.data
    other = write_project("Line", files, Form.PART10)
    assert other.left_out == []
    assert read_project(other.data).files == files


def test_files_are_as_the_schema_says() -> None:
    files = {"this test's own": LINE} | {
        f"{case.name} {number}": write_project("Case", {"case.st": case.source}).data for number, case in enumerate(ALL)
    }
    files |= {each.id: write_project(each.name, each.files).data for each in templates()}
    wrong = {name: why for name, data in files.items() if (why := against_the_schema(data))}
    assert wrong == {}


def against_the_schema(data: bytes) -> str:
    """The first thing that the schema does not allow; empty for none."""
    try:
        SCHEMA.assertValid(etree.fromstring(data))
    except etree.DocumentInvalid as why:
        return str(why)
    return ""


@pytest.mark.parametrize(
    ("body", "why"),
    [
        ("INITIAL_STEP A:\nEND_STEP\nTRANSITION FROM B TO A := x; END_TRANSITION\n", "a transition of the step B"),
        ("INITIAL_STEP A:\nEND_STEP\nTRANSITION FROM A TO B := x; END_TRANSITION\n", "a transition of the step B"),
        ("NETWORK\n    x := #Q;\nEND_NETWORK\n", "the wire #Q"),
    ],
)
@pytest.mark.parametrize("form", Form)
def test_what_is_half_written_is_left_out_and_told(body: str, why: str, form: Form) -> None:
    source = f"PROGRAM Main\nVAR x : BOOL; END_VAR\n{body}END_PROGRAM\n"
    (said,) = write_project("Half", {"main.st": source}, form).left_out
    assert said.startswith(f"Main, the whole of it: {why}, which ")


@pytest.mark.parametrize("path", ["plant/Machine.st", "line/Plant/Machine.st", "line\\plant\\tank\\Machine.st"])
def test_what_drives_the_inputs_is_no_part_of_the_program(path: str) -> None:
    files = {"line/Main.st": "PROGRAM Main\nEND_PROGRAM\n", path: "PROGRAM Machine\nEND_PROGRAM\n"}
    assert "Machine" not in write_project("Line", files).data.decode()
