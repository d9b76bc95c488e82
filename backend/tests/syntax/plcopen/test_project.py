"""A PLCopen file as a project: its five languages run as the drawings say, and what cannot be read is told."""

from pathlib import Path

import pytest

from scanbench.check.build import check_sources
from scanbench.syntax.plcopen.document import is_plcopen
from scanbench.syntax.plcopen.project import read_project
from scanbench.syntax.xml_tree import BadXml
from tests.caseformat import MODELS
from tests.syntax.both_engines import BothEngines

LINE = (Path(__file__).parent / "line.xml").read_bytes()
CIRCLE = b"""<project xmlns="http://www.plcopen.org/xml/tc6_0201"><types><pous><pou name="Main" pouType="program"><interface/><body><SFC>
<step localId="1" name="A" initialStep="true"><connectionPointIn><connection refLocalId="4"/></connectionPointIn></step>

<transition localId="2"><connectionPointIn><connection refLocalId="1"/></connectionPointIn><condition><inline><ST><p>TRUE</p></ST></inline></condition></transition>
<selectionConvergence localId="3"><connectionPointIn><connection refLocalId="2"/><connection refLocalId="4"/></connectionPointIn></selectionConvergence>
<selectionConvergence localId="4"><connectionPointIn><connection refLocalId="3"/></connectionPointIn></selectionConvergence>
</SFC></body></pou></pous></types></project>
"""
LD = LINE[LINE.index(b"<body><LD>") : LINE.index(b"</LD></body>")]


def test_all_of_a_project_is_kept() -> None:
    made = read_project(LINE)
    assert made.name == "Line"
    assert list(made.files) == ["Types.st", "Latch.st", "Ramp.st", "Main.st", "Configuration.st"]
    assert [(each.pou, each.language, each.notes) for each in made.pous] == [
        ("Latch", "LD", []), ("Ramp", "FBD", []), ("Main", "SFC", []),
    ]  # fmt: skip
    assert "    < [start] | [motor] > [/stop] (motor)\n" in made.files["Latch.st"]
    assert "    [motor] jam(IN := ~, PT := T#20ms, ET => seen).Q (S late)\n" in made.files["Latch.st"]
    assert "TRANSITION FROM Wait TO (Left, Right) := go; END_TRANSITION\n" in made.files["Main.st"]


def test_it_runs_on_both_engines_as_it_is_drawn() -> None:
    line = BothEngines(read_project(LINE).files, MODELS["GENERIC-IEC"])
    assert line.problems == ()

    def run(**inputs: str) -> list[str]:
        line.run(1, **{f"main__{name}": value for name, value in inputs.items()})
        names = ("lamp", "speed", "latch.motor", "latch.late", "Wait.X", "Right.X")
        return line.values(*(f"main.{name}" for name in names))

    assert run(go="TRUE") == ["FALSE", "0", "FALSE", "FALSE", "FALSE", "TRUE"]
    assert run() == ["TRUE", "40", "TRUE", "FALSE", "FALSE", "TRUE"]
    run()
    assert run() == ["TRUE", "40", "TRUE", "TRUE", "FALSE", "TRUE"]
    assert run(go="FALSE") == ["TRUE", "40", "TRUE", "TRUE", "TRUE", "FALSE"]
    assert run() == ["FALSE", "40", "TRUE", "TRUE", "TRUE", "FALSE"]


def test_a_ladder_with_values_between_boxes_becomes_a_block_diagram_and_says_so() -> None:
    drawn = LD.replace(b'<connection refLocalId="8"/>', b'<connection refLocalId="12"/>').replace(
        b"<outVariable", b'<block localId="12" typeName="ADD"><position x="100" y="145"/><inputVariables><variable formalParameter="IN1">'
        b'<connectionPointIn><connection refLocalId="8"/></connectionPointIn></variable><variable formalParameter="IN2">'
        b'<connectionPointIn><connection refLocalId="8"/></connectionPointIn></variable></inputVariables><inOutVariables/>'
        b'<outputVariables><variable formalParameter="OUT"><connectionPointOut/></variable></outputVariables></block><outVariable', 1,
    )  # fmt: skip
    made = read_project(LINE.replace(LD, drawn))
    assert made.pous[0].notes == ["the network of line 29 is a function block diagram here"]
    assert "#w2 = ADD(IN1 := T#20ms, IN2 := T#20ms);" in made.files["Latch.st"]
    assert check_sources(made.files, MODELS["GENERIC-IEC"]).problems == ()


def test_what_codesys_keeps_in_data_of_its_own_is_read_or_told() -> None:
    lists = (
        b'<addData><data name="http://www.3s-software.com/plcopenxml/globalvars" handleUnknown="implementation"><globalVars name="GVL">'
        b'<variable name="limit"><type><INT/></type><initialValue><simpleValue value="7"/></initialValue></variable></globalVars></data></addData>'
    )
    method = b'<addData><data name="http://www.3s-software.com/plcopenxml/method" handleUnknown="implementation"><Method name="Reset"/></data></addData>'
    data = LINE.replace(b'productName="by hand"', b'productName="CODESYS"').replace(
        b"</instances>", b"</instances>" + lists
    )
    data = data.replace(b"speed := Ramp(speed, 40)", b"speed := Ramp(speed, GVL.limit)").replace(
        b"</LD></body>", b"</LD></body>" + method
    )
    made = read_project(data)
    assert made.pous[0].notes == ["its methods and properties are left out: Reset"]
    assert '"codesys"' in made.files["language.json"]
    checked = check_sources(made.files, MODELS["GENERIC-IEC"])
    assert checked.problems == ()


@pytest.mark.parametrize("version", [b"tc6.xsd", b"tc6_0200", b"tc6_0201"])
def test_the_versions_are_known(version: bytes) -> None:
    data = LINE.replace(b"tc6_0201", version)
    assert is_plcopen(data)
    assert len(read_project(data).files) == 5


@pytest.mark.parametrize(
    ("data", "why"),
    [
        (LINE[:2000], "this is no XML: "),
        (LINE.replace(b"<project ", b"<other ").replace(b"</project>", b"</other>"), "begins with <other>"),
        (LINE.replace(b"<project ", b'<!DOCTYPE project [<!ENTITY a "b">]><project ', 1), "DOCTYPE"),
    ],
)
def test_what_is_none_is_refused(data: bytes, why: str) -> None:
    with pytest.raises(BadXml, match=why):
        read_project(data)


@pytest.mark.parametrize("cut", range(0, len(LINE), 997))
def test_no_part_that_is_missing_breaks_it(cut: int) -> None:
    """A stretch of elements is gone: it is read all the same, or refused with words."""
    end = LINE.find(b">", cut + 300)
    begin = LINE.find(b"<", cut)
    try:
        made = read_project(LINE[:begin] + LINE[end + 1 :])
    except BadXml:
        return
    check_sources(made.files, MODELS["GENERIC-IEC"])


def test_two_pous_of_one_name_are_both_kept() -> None:
    second = b'<pou name="MAIN" pouType="program"><interface/><body><ST><p>;</p></ST></body></pou></pous>'
    made = read_project(LINE.replace(b"</pous>", second))
    assert list(made.files) == ["Types.st", "Latch.st", "Ramp.st", "Main.st", "MAIN_2.st", "Configuration.st"]
    assert "TRANSITION" in made.files["Main.st"]
    assert made.pous[-1].notes == ["something of this name comes before it: this is in MAIN_2.st"]
    assert any("MAIN" in each.message for each in check_sources(made.files, MODELS["GENERIC-IEC"]).problems)


def test_lines_of_a_chart_that_lead_in_a_circle_are_followed_once() -> None:
    made = read_project(CIRCLE)
    assert "TRANSITION FROM A TO A := TRUE; END_TRANSITION\n" in made.files["Main.st"]
    assert [each.notes for each in made.pous] == [
        ["from the transition of line 4 lines lead in a circle without a step; they are followed once"]
    ]
