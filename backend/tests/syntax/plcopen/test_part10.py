"""A file of IEC 61131-10 as a project: ladder sections as Sysmac Studio writes them, a diagram whose order Bachmann's tool gives; what cannot
be read is told."""

from contextlib import suppress
from pathlib import Path

import pytest

from scanbench.syntax.plcopen.document import is_plcopen
from scanbench.syntax.plcopen.project import read_project
from scanbench.syntax.plcopen.write import Form, write_project
from scanbench.syntax.xml_tree import BadXml
from tests.caseformat import MODELS
from tests.syntax.both_engines import BothEngines

HERE = Path(__file__).parent
PRESS, LOOP = (HERE / "press.xml").read_bytes(), (HERE / "loop.xml").read_bytes()


def test_all_of_a_project_is_kept() -> None:
    assert is_plcopen(PRESS)
    made = read_project(PRESS)
    assert made.name == "Press"
    assert [(each.pou, each.language, each.notes) for each in made.pous] == [
        ("Count", "ST", []), ("Scaled", "ST", []), ("Press", "LD", []), ("Report", "ST", []),
    ]  # fmt: skip
    assert made.pous[2].line == 46
    assert (
        "RUNG 'The press closes until it$'s stopped'\n    < [start] | [closed] > [/stop] (closed)\n"
        in made.files["Press.st"]
    )
    assert "RUNG late:\n    (/done)\n" in made.files["Press.st"]
    assert "RUNG\n    [n >= INT#2] (S high)\n" in made.files["Press.st"]
    assert "Phase : DINT (Waiting := 0, Closing := 1, Holding := 5);\n" in made.files["Types.st"]
    assert "    marks : ARRAY[0..3, 1..2] OF INT;\n" in made.files["Types.st"]
    assert "    start : BOOL; // two hands (ECAT://node#[1,2]/Input1)\n" in made.files["Configuration.st"]
    assert '"dialect": "omron"' in made.files["language.json"]


def test_sections_and_rungs_run_in_the_order_that_they_give() -> None:
    press = BothEngines(read_project(PRESS).files, MODELS["GENERIC-IEC"])
    shown = ("press.closed", "press.n", "press.high", "press.done", "report.force")
    press.run(start="TRUE")
    assert press.values(*shown) == ["TRUE", "1", "FALSE", "FALSE", "2.9"]
    press.run(2, start="FALSE")
    assert press.values(*shown)[:3] == ["TRUE", "1", "FALSE"]
    press.run(press__stop="TRUE")
    press.run(press__stop="FALSE", start="TRUE", level="10")
    assert press.values(*shown) == ["TRUE", "2", "TRUE", "FALSE", "3.5"]


def test_it_is_written_as_it_was_read() -> None:
    files = {name: text for name, text in read_project(PRESS).files.items() if name.endswith(".st")}
    globals = files.pop("Configuration.st")
    files["Configuration.st"] = (
        f"CONFIGURATION Line\n{globals}RESOURCE PLC ON PLC\nTASK Fast(INTERVAL := T#10ms, PRIORITY := 1);\n"
        "PROGRAM press WITH Fast : Press;\nEND_RESOURCE\nEND_CONFIGURATION\n"
    )
    written = write_project("Press", files, Form.PART10)
    assert written.left_out == []
    again = read_project(written.data).files
    assert {name: again[name] for name in ("Count.st", "Press.st", "Report.st")} == {
        name: files[name] for name in ("Count.st", "Press.st", "Report.st")
    }
    assert all(
        line in again["Configuration.st"] for line in files["Configuration.st"].splitlines() if "ECAT" not in line
    )
    assert again["Types.st"].replace(" // in kN", "") == files["Types.st"].replace(" // in kN", "")


def test_a_given_order_holds_where_a_box_then_reads_the_value_of_the_scan_before() -> None:
    made = read_project(LOOP)
    assert [(each.pou, each.language, each.notes) for each in made.pous] == [("Filter", "FBD", [])]
    main = (
        "PROGRAM Main\nVAR filter : Filter; go : BOOL; raw : INT; END_VAR\nfilter(go := go, raw := raw);\nEND_PROGRAM\n"
    )
    filter = BothEngines(made.files | {"Main.st": main}, MODELS["GENERIC-IEC"])
    shown = ("main.filter.sum", "main.filter.late", "main.filter.latched")
    filter.run(main__raw="4")
    assert filter.values(*shown) == ["8", "0", "TRUE"]
    filter.run(main__raw="5")
    assert filter.values(*shown) == ["10", "8", "TRUE"]
    filter.run(main__raw="6", main__go="TRUE")
    assert filter.values(*shown)[1] == "10"


def test_methods_bases_and_namespaces_are_kept() -> None:
    text = b"""<Project xmlns="www.iec.ch/public/TC65SC65BWG7TF10" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance">
<Types><GlobalNamespace><NamespaceDecl name="Parts">
<FunctionBlock name="Base"><Vars><Variable name="n"><Type><TypeName>INT</TypeName></Type></Variable></Vars>
<Method name="Next" accessSpecifier="public"><ResultType><TypeName>INT</TypeName></ResultType>
<Parameters><InputVars><Variable name="by"><Type><TypeName>INT</TypeName></Type></Variable></InputVars></Parameters>
<MainBody><BodyContent xsi:type="ST"><ST>n := n + by; Next := n;</ST></BodyContent></MainBody></Method></FunctionBlock>
<FunctionBlock name="Own"><Extends><TypeName>Base</TypeName></Extends></FunctionBlock>
</NamespaceDecl>
<Program name="Main"><Vars>
<Variable name="own"><Type><TypeName>Parts.Own</TypeName></Type></Variable>
<Variable name="m"><Type><TypeName>INT</TypeName></Type></Variable>
<Variable name="list"><Type><InstantlyDefinedType xsi:type="ArrayTypeSpec"><BaseType><TypeName>INT</TypeName></BaseType>
<DimensionSpec dimensionNumber="1"><IndexRange lower="1" upper="4"/></DimensionSpec></InstantlyDefinedType></Type>
<InitialValue><ArrayValue><Value repetitionValue="3"><SimpleValue value="7"/></Value><Value><SimpleValue value="9"/></Value></ArrayValue>
</InitialValue></Variable></Vars>
<MainBody><BodyContent xsi:type="ST"><ST>m := own.Next(by := list[4]);</ST></BodyContent></MainBody></Program>
</GlobalNamespace></Types>
<Instances><Configuration name="C"><Resource name="R" resourceTypeName="">
<Task xsi:type="StandardTask" name="Fast" interval="T#10ms" priority="1"/>
<ProgramInstance name="one" typeName="Main" associatedTaskName="Fast"/></Resource></Configuration></Instances></Project>"""
    made = read_project(text)
    assert list(made.files) == ["Parts.Base.st", "Parts.Own.st", "Main.st", "Configuration.st"]
    assert [each.notes for each in made.pous] == [[], [], []]
    main = BothEngines(made.files, MODELS["GENERIC-IEC"])
    main.run(3)
    assert main.values("one.m", "one.list[3]") == ["27", "7"]


def test_what_is_not_read_is_told_by_name() -> None:
    contact = b'<LdObject xsi:type="Contact" edge="rising" operand="closed">'
    assert PRESS.count(contact) == 1
    made = read_project(PRESS.replace(contact, contact.replace(b'"Contact"', b'"smcext:InlineST"')))
    assert made.pous[2].refused
    assert "InlineST in line 80 is left out: it is not read" in made.pous[2].notes
    chart = PRESS.replace(b'<BodyContent xsi:type="ST"><ST>force', b'<BodyContent xsi:type="SFC"><ST>force')
    assert [(each.refused, each.notes) for each in read_project(chart).pous][3] == (
        True, ["a body in SFC in line 131 is left out: it is not read"],
    )  # fmt: skip


def test_declarations_that_are_not_read_are_told() -> None:
    text = b"""<Project xmlns="www.iec.ch/public/TC65SC65BWG7TF10"><Types><GlobalNamespace>
<Interface name="Runs"/>
<FunctionBlock name="Motor"><Implements><TypeName>Runs</TypeName></Implements>
<Property name="Speed"/></FunctionBlock></GlobalNamespace></Types></Project>"""
    assert [(each.pou, each.notes) for each in read_project(text).pous] == [
        ("Motor", ["Property Speed in line 4 is left out: it is not read"]),
        ("Interface Runs", ["Interface Runs in line 2 is left out: it is not read"]),
    ]


def test_numbers_that_are_none_break_nothing() -> None:
    for value in (b"inf", b"nan", b"x", "²".encode()):
        made = read_project(LOOP.replace(b'priorityInNetwork="0"', b'priorityInNetwork="' + value + b'"'))
        assert [each.notes for each in made.pous] == [[]]


@pytest.mark.parametrize("title", ['"Two hands"', "'it$'s $$5'", '"say $"go$""'])
@pytest.mark.parametrize("form", Form)
def test_titles_of_networks_go_out_and_in(title: str, form: Form) -> None:
    body = f"RUNG late: {title}\n    [a] (a)\nEND_RUNG\nRUNG {title}\n    [/a] (a)\nEND_RUNG\n"
    written = write_project("T", {"Main.st": f"PROGRAM Main\nVAR a : BOOL; END_VAR\n{body}END_PROGRAM\n"}, form)
    wanted = {'"Two hands"': "'Two hands'", '"say $"go$""': "'say \"go\"'"}.get(title, title)
    assert read_project(written.data).files["Main.st"].count(wanted) == 2


@pytest.mark.parametrize("form", Form)
def test_a_long_network_and_enumerations_stay_whole(form: Form) -> None:
    contacts = " ".join(f"[a{number}]" for number in range(60))
    variables = ", ".join(f"a{number}" for number in range(60))
    types = "TYPE\nMode : (off, on := 5);\nOther : UINT (aa, bb);\nEND_TYPE\n"
    rungs = f"RUNG\n    {contacts} (a0)\nEND_RUNG\nRUNG\n    [a1] (a2)\nEND_RUNG\n"
    main = f"PROGRAM Main\nVAR {variables} : BOOL; m : Mode; END_VAR\n{rungs}END_PROGRAM\n"
    written = write_project("Long", {"Types.st": types, "Main.st": main}, form)
    assert written.left_out == []
    files = read_project(written.data).files
    assert rungs in files["Main.st"]
    assert files["Types.st"] == types


@pytest.mark.parametrize("cut", range(300, len(PRESS), 700))
def test_a_damaged_file_is_refused_or_read_and_breaks_nothing(cut: int) -> None:
    with pytest.raises(BadXml):
        read_project(PRESS[:cut])
    made = PRESS[:cut] + PRESS[cut + 40 :]
    with suppress(BadXml):
        read_project(made)
