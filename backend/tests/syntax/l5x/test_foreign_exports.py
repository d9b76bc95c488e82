"""What exports of other tools, and public projects, have in their files."""

from pathlib import Path

import pytest

from scanbench.check.libraries.catalogue import used_libraries
from scanbench.reports.program_report import program_report
from scanbench.syntax.l5x.project import read_project
from tests.caseformat import MODELS
from tests.cli.calling import scanbench
from tests.syntax.both_engines import BothEngines
from tests.syntax.l5x.test_project import controller, tag

DINT = tag("n", "DINT") + tag("m", "DINT")


def routine(content: str, type: str = "ST", name: str = "Logic") -> str:
    return f'<Routine Name="{name}" Type="{type}">{content}</Routine>'


def program(content: str) -> str:
    return f'<Program Name="P" MainRoutineName="Logic"><Routines>{routine(content)}</Routines></Program>'


def body(made: dict[str, str], file: str = "P.st") -> str:
    """The statements of a program without tags of its own."""
    return made[file].removeprefix("PROGRAM P\n").removesuffix("END_PROGRAM\n")


def engines(files: dict[str, str]) -> BothEngines:
    """Those of a project with the libraries that it uses."""
    return BothEngines(
        files | {each.path: each.text for each in used_libraries(files, "rockwell")}, MODELS["GENERIC-IEC"]
    )


@pytest.mark.parametrize(
    ("content", "lines"),
    [
        ("<STContent><![CDATA[n := 1;\n\nm := 2;]]></STContent>", ["n := 1;", "", "m := 2;"]),
        ("<STContent>\n<![CDATA[n := 1;\n  m := 2;\n]]>\n</STContent>", ["n := 1;", "  m := 2;"]),
        (
            "<STContent>\n<Line Number='0'>\n<![CDATA[]]>\n</Line>\n<Line Number='1'>\n<![CDATA[  n := 1;]]>\n</Line>\n"
            "<Line Number='2'>\n<![CDATA[]]>\n</Line>\n<Line Number='3'>\n<![CDATA[m := 2;]]>\n</Line>\n</STContent>",
            ["", "  n := 1;", "", "m := 2;"],
        ),
        ("<STContent><Line>n := 1;</Line><![CDATA[m := 2;]]></STContent>", ["n := 1;", "m := 2;"]),
    ],
)
def test_every_text_of_a_routine_is_read_and_its_lines_are_those_of_studio(content: str, lines: list[str]) -> None:
    made = read_project(controller(DINT, program(content)))
    assert body(made.files).rstrip("\n").split("\n") == lines
    assert [each.notes for each in made.pous] == [[]]


def test_a_routine_that_is_edited_online_says_which_text_is_read() -> None:
    edits = "".join(
        f'<STContent OnlineEditType="{kind}"><Line>n := {value};</Line></STContent>'
        for kind, value in (("Original", 1), ("PendingEdits", 2))
    )
    made = read_project(controller(DINT, program(edits)))
    assert body(made.files) == "n := 1;\n"
    assert [each.notes for each in made.pous] == [
        ["the routine Logic has edits that are not accepted yet: its text before them is read"]
    ]


ALIASES = """<AddOnInstructionDefinitions><AddOnInstructionDefinition Name="A1"><Parameters>
<Parameter Name="Al" TagType="Alias" Usage="Input" AliasFor="L" Required="true"/>
<Parameter Name="Preset" TagType="Alias" Usage="Input" AliasFor="T.PRE"/>
<Parameter Name="Bit" TagType="Alias" Usage="Output" AliasFor="W[1].3"/>
<Parameter Name="All" TagType="Alias" Usage="Output" AliasFor="W"/>
<Parameter Name="Odd" TagType="Alias" Usage="Output" AliasFor="U.Unknown"/></Parameters><LocalTags>
<LocalTag Name="L" DataType="BOOL"/><LocalTag Name="T" DataType="FBD_TIMER"/><LocalTag Name="W" DataType="INT" Dimensions="2"/>
<LocalTag Name="U" DataType="DINT"/>
</LocalTags><Routines><Routine Name="Logic" Type="ST"><STContent><Line>IF Al THEN Bit := Preset = 7; U := All[1]; END_IF;</Line></STContent>
</Routine></Routines></AddOnInstructionDefinition></AddOnInstructionDefinitions>"""


def test_an_alias_parameter_has_the_type_of_what_it_is_written_for() -> None:
    made = read_project(
        controller(
            tag("a", "A1") + tag("n", "DINT"),
            program("<STContent><Line>a.Preset := 7; A1(a, 1); n := a.All[1];</Line></STContent>"),
            ALIASES,
        )
    )
    text = made.files["A1.st"]
    declared = ("Al : BOOL;", "Preset : DINT;", "Bit : BOOL;", "All : ARRAY[0..1] OF INT;")
    assert [each for each in declared if each not in text] == []
    assert "Odd" not in text
    assert made.pous[-1].notes == [
        "the parameter Odd is an alias for U.Unknown, whose type the file does not show; it is left out"
    ]
    plc = engines(made.files)
    plc.run(1)
    assert plc.values("a.Bit", "n", "a.U") == ["TRUE", "8", "8"]


def test_what_has_no_statements_of_its_own_does_not_count_as_running() -> None:
    drawn = routine("<FBDContent/>", "FBD")
    instruction = (
        f'<AddOnInstructionDefinitions><AddOnInstructionDefinition Name="A1"><Routines>{drawn}</Routines>'
        "</AddOnInstructionDefinition></AddOnInstructionDefinitions>"
    )
    made = read_project(controller(tag("a", "A1"), program("<STContent><Line>A1(a);</Line></STContent>"), instruction))
    plc = BothEngines(made.files, MODELS["GENERIC-IEC"])
    files = {each.name: (each.pous, each.run, each.stubbed) for each in program_report(made.files, plc.problems).files}
    assert (files["A1.st"], files["P.st"]) == ((1, 0, 0), (1, 1, 1))
    assert next(each.message for each in plc.problems if each.code == "W008").startswith("`A1` is a stub")


def test_structures_with_a_process_alarm() -> None:
    made = read_project(controller(tag("x", "ALARM"), program("<STContent><Line>x.HLimit := 5.0;</Line></STContent>")))
    plc = engines(made.files)
    plc.run(1)
    assert plc.values("x.HLimit", "x.HHLimit", "x.EnableIn") == ["5", "3.4028235e+38", "TRUE"]


@pytest.mark.parametrize(
    ("call", "said"),
    [
        ("TON(t, 5000, 0)", "In Structured Text call TONR, TOFR or RTOR with a tag of type FBD_TIMER."),
        ("CTU(t, 999999)", "In Structured Text call CTUD with a tag of type FBD_COUNTER."),
        ("ONS(t)", "In Structured Text call OSRI or OSFI with a tag of type FBD_ONESHOT."),
    ],
)
def test_instructions_of_ladders_say_what_structured_text_has(tmp_path: Path, call: str, said: str) -> None:
    (tmp_path / "a.st").write_text(f"PROGRAM P\nVAR\n  t : DINT;\nEND_VAR\n{call};\nEND_PROGRAM\n")
    told = scanbench("check", str(tmp_path / "a.st"), "--dialect", "rockwell")
    assert said in told.stdout
    assert "declare an instance" not in told.stdout


def test_a_folder_with_a_file_of_studio_alone_names_the_import(tmp_path: Path) -> None:
    (tmp_path / "line.L5X").write_bytes(controller(DINT, ""))
    told = scanbench("check", "--report", str(tmp_path))
    assert told.returncode == 2
    assert f"`scanbench import {tmp_path / 'line.L5X'} DIR`" in told.stderr
