"""TwinCAT's files: the tree of a plain text, with places in the XML."""

import pytest

from scanbench.check.build import check_sources
from scanbench.syntax.parse_file import MAX_SIZE, is_program_file
from tests.caseformat import MODELS
from tests.syntax.shown import complaints, read, show, well

MOTOR = """<?xml version="1.0" encoding="utf-8"?>
<TcPlcObject Version="1.1.0.1" ProductVersion="3.1.4024.0">
  <POU Name="FB_Motor" Id="{5c1a}" SpecialFunc="None">
    <Declaration><![CDATA[{attribute 'reflection'}
FUNCTION_BLOCK FB_Motor
VAR_INPUT
	Start : BOOL; // größer
END_VAR
VAR
	_speed : INT;
END_VAR
]]></Declaration>
    <Implementation>
      <ST><![CDATA[IF Start THEN
	_speed := _speed + 1;
END_IF
Reset();]]></ST>
    </Implementation>
    <Folder Name="Sub" Id="{a}" />
    <Action Name="Reset" Id="{a1}">
      <Implementation><ST><![CDATA[IF _speed > 100 THEN _speed := 0; END_IF]]></ST></Implementation>
    </Action>
    <Method Name="Stop" Id="{b}" FolderPath="Sub\\">
      <Declaration><![CDATA[METHOD PUBLIC Stop : BOOL
VAR_INPUT
	hard : BOOL;
END_VAR
]]></Declaration>
      <Implementation>
        <ST>IF hard AND _speed &lt;&gt; 0 THEN _speed := 0; END_IF
Stop := _speed &lt;= 0 &amp; _speed&gt;=-5;</ST>
      </Implementation>
    </Method>
    <Property Name="Speed" Id="{c}">
      <Declaration><![CDATA[PROPERTY PUBLIC Speed : INT]]></Declaration>
      <Get Name="Get" Id="{d}">
        <Declaration><![CDATA[VAR
END_VAR
]]></Declaration>
        <Implementation><ST><![CDATA[Speed := _speed;]]></ST></Implementation>
      </Get>
      <Set Name="Set" Id="{e}">
        <Declaration><![CDATA[]]></Declaration>
        <Implementation><ST><![CDATA[_speed := Speed;]]></ST></Implementation>
      </Set>
    </Property>
    <LineIds Name="FB_Motor"><LineId Id="1" Count="0" /></LineIds>
  </POU>
</TcPlcObject>
"""
LIST = '<TcPlcObject><GVL Name="GVL_Io"><Declaration><![CDATA[VAR_GLOBAL\n cnt : INT := 3;\nEND_VAR]]></Declaration></GVL></TcPlcObject>'
TYPE = '<TcPlcObject><DUT Name="E"><Declaration><![CDATA[TYPE E : (A, B) UINT; END_TYPE]]></Declaration></DUT></TcPlcObject>'
INTERFACE = """<TcPlcObject><Itf Name="I_Run"><Declaration><![CDATA[INTERFACE I_Run EXTENDS I_Base]]></Declaration>
<Method Name="run"><Declaration><![CDATA[METHOD run : BOOL]]></Declaration></Method>
<Property Name="p"><Declaration><![CDATA[PROPERTY p : INT]]></Declaration><Get Name="Get"><Declaration/></Get></Property>
</Itf></TcPlcObject>"""
MAIN = """PROGRAM Main
VAR m : FB_Motor; b : BOOL; v : INT; e : E; END_VAR
m(Start := TRUE); b := m.Stop(hard := FALSE); m.Speed := 7; v := m.Speed + GVL_Io.cnt + cnt; e := E.B;
END_PROGRAM"""


def test_a_block() -> None:
    (block,) = well(MOTOR, "FB_Motor.TcPOU").pous
    assert (block.kind, block.name, [each.keyword for each in block.sections]) == (
        "function_block",
        "FB_Motor",
        ["VAR_INPUT", "VAR"],
    )
    assert [(each.kind, each.name, show(each.result), each.access) for each in block.methods] == [
        ("method", "Reset", "None", "PUBLIC"),
        ("method", "Stop", "BOOL", "PUBLIC"),
        ("get", "Speed", "INT", "PUBLIC"),
        ("set", "Speed", "INT", "PUBLIC"),
    ]
    stop = show(block.methods[1].body)
    assert "(hard and (_speed <> 0))" in stop
    assert "le" in stop and "ge" in stop  # noqa: PT018


def test_places_are_those_of_the_xml() -> None:
    (block,) = well(MOTOR, "FB_Motor.TcPOU").pous
    lines = MOTOR.split("\n")
    for span, text in (
        (block.span, "FB_Motor"),
        (block.sections[0].variables[0].span, "Start"),
        (block.methods[0].span, "Reset"),
        (block.methods[0].body[0].span, "IF _speed > 100 THEN _speed := 0;"),  # type: ignore[index]
        (block.methods[3].body[0].span, "_speed := Speed"),  # type: ignore[index]
    ):
        assert lines[span.line - 1][span.column - 1 :].startswith(text)
        assert lines[span.end_line - 1][: span.end_column - 1].endswith(text)
    assert complaints(MOTOR.replace("_speed + 1", "_speed + ö ^ )"), "a.TcPOU")[0].startswith("S003 15:")


def test_lists_types_and_interfaces() -> None:
    assert well(LIST, "GVL_Io.TcGVL").globals[0].list_name == "GVL_Io"
    assert show(well(TYPE, "E.tcdut").types[0].type) == "Enum(values=[[A, None], [B, None]], base=UINT)"
    (interface,) = well(INTERFACE, "I_Run.TcIO").pous
    assert (interface.kind, [each.name for each in interface.extends]) == ("interface", ["I_Base"])
    assert [(each.kind, each.name) for each in interface.methods] == [("method", "run"), ("get", "p")]


def test_a_project_of_them_is_checked() -> None:
    files = {"FB_Motor.TcPOU": MOTOR, "GVL_Io.TcGVL": LIST, "E.TcDUT": TYPE, "main.st": MAIN}
    checked = check_sources(files, MODELS["GENERIC-IEC"])
    assert checked.problems == ()
    assert checked.program is not None


BROKEN = [
    ("", "S003 1:1 This is no well-formed XML: no element found. Export the file again."),
    ("<a>\n<b></a>", "S003 2:6 This is no well-formed XML: mismatched tag. Export the file again."),
    ("<!DOCTYPE x [<!ENTITY a 'b'>]><x>&a;</x>", "S003 1:1 This XML is not read: it has a DOCTYPE, which such files do not."),
    ("<a>" * 100_000, "S003 1:1 This XML is not read: its elements nest more than 400 deep."),
    ("<a/>", "S003 1:1 A file of TwinCAT has one of the elements POU, Itf, DUT, GVL in it, but this has none."),
    ("x\0y", "S003 1:1 This is no well-formed XML: syntax error. Export the file again."),
    ('<a><POU Name="x"/></a>', "S003 1:4 This POU has no Declaration, so nothing is known of it. Export the file again."),
    ('<a><POU Name="x"><Declaration>PROGRAM x</Declaration><Implementation><FBD/></Implementation></POU></a>', "X001 1:70 A body drawn in FBD is not read from a file of TwinCAT; in TwinCAT export this POU as PLCopen XML and import that, or write the body as Structured Text."),
    ('<a><POU Name="x"><Declaration>PROGRAM x</Declaration><Transition Name="t"/></POU></a>', "X001 1:54 This POU has no chart, so its transition is not read; remove it."),
]  # fmt: skip


@pytest.mark.parametrize(("text", "complaint"), BROKEN, ids=[str(number) for number, _ in enumerate(BROKEN)])
def test_broken_files(text: str, complaint: str) -> None:
    assert complaints(text, "a.TcPOU") == [complaint]


def test_every_cut_of_a_file_is_answered() -> None:
    for end in range(0, len(MOTOR), 7):
        problems = read(MOTOR[:end], "a.TcPOU")[1]
        assert problems
    for end in range(MOTOR.index("FUNCTION_BLOCK"), len(MOTOR), 11):
        read(MOTOR[:end] + MOTOR[end + 9 :], "a.TcPOU")


def test_names_of_files() -> None:
    assert all(map(is_program_file, ("a.st", "A.ST", "b.TcPOU", "c.TcGVL", "d.TcDUT", "e.TcIO", "f.iecst", "g.EXP")))
    assert not any(map(is_program_file, ("a.txt", "st", "a.st.bak", "TcPOU")))


def test_a_file_that_is_too_large_is_not_read() -> None:
    assert complaints(" " * (MAX_SIZE + 1)) == [
        f"S003 1:1 This file has more than {MAX_SIZE:,} characters; split it up."
    ]


def test_a_file_pasted_under_a_different_name_is_read_all_the_same() -> None:
    pasted = check_sources(
        {"pasted.st": MOTOR, "main.st": "PROGRAM Main\nVAR m : FB_Motor; END_VAR\nEND_PROGRAM"}, MODELS["GENERIC-IEC"]
    )
    named = check_sources(
        {"a.TcPOU": MOTOR, "main.st": "PROGRAM Main\nVAR m : FB_Motor; END_VAR\nEND_PROGRAM"}, MODELS["GENERIC-IEC"]
    )
    assert [each.message for each in pasted.problems] == [each.message for each in named.problems]
    assert pasted.program is not None


def test_a_text_goes_on_in_the_next_line() -> None:
    declaration = "PROGRAM P\nVAR s : STRING := 'one\n  two'; t : STRING; END_VAR"
    body = "t := 'it'; // don't\ns := 'a';"
    text = f'<TcPlcObject><POU Name="P"><Declaration><![CDATA[{declaration}]]></Declaration>'
    text += f"<Implementation><ST><![CDATA[{body}]]></ST></Implementation></POU></TcPlcObject>"
    file = well(text, "P.TcPOU")
    first = file.pous[0].sections[0].variables[0].initial
    assert "b'one\\n  two'" in repr(first)
    body_ = file.pous[0].body
    assert isinstance(body_, tuple)
    assert len(body_) == 2
    open_ = text.replace("'a';", "'a;")
    assert [each for each in complaints(open_, "P.TcPOU") if "never ends" in each]
    assert complaints(declaration + "\nEND_PROGRAM")  # in plain text a string ends in its line
