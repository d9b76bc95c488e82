"""What instructions of Logix compute in Structured Text that is read out of L5X, and which are stubs."""

from collections.abc import Sequence

import pytest

from scanbench.check.build import check_sources
from scanbench.check.libraries.catalogue import used_libraries
from scanbench.problems import Severity
from scanbench.syntax.l5x.known import Known
from scanbench.syntax.l5x.project import read_project
from scanbench.syntax.l5x.statements import statements
from tests.caseformat import MODELS
from tests.syntax.both_engines import BothEngines

MODEL = MODELS["GENERIC-IEC"]
TAGS = {
    "Bytes": "SINT[8]", "Words": "INT[4]", "Numbers": "DINT[4]", "Copies": "DINT[4]", "Level": "REAL", "Pair": "Pair", "Pairs": "Pair[3]",
    "One": "STRING", "Two": "STRING", "Flags": "DINT", "Index": "DINT", "Count": "DINT", "Small": "INT", "Same": "BOOL", "Less": "BOOL",
    "Bit": "BOOL", "First": "BOOL", "Clock": "DINT[7]", "Stamp": "LINT", "Halves": "DINT[2]", "Scan": "DINT", "Field": "FBD_BIT_FIELD_DISTRIBUTE",
    "Move": "FBD_MASKED_MOVE", "Flop": "FLIP_FLOP_D", "Range": "SCALE", "Limits": "HL_LIMIT", "Call": "MESSAGE", "Axis1": "AXIS_CIP_DRIVE",
    "Motion": "MOTION_INSTRUCTION", "Own": "Unit", "Speed": "DINT", "Order": "DINT", "Text": "STRING",
    "Short": "Str8", "Tiny": "Str3", "Long": "Str200", "Holder": "Holder", "Trio": "Trio",
}  # fmt: skip
TYPES = (
    '<DataType Name="Pair"><Members><Member Name="A" DataType="DINT" Dimension="0" Hidden="false"/>'
    '<Member Name="B" DataType="REAL" Dimension="0" Hidden="false"/></Members></DataType>'
)
TYPES += "".join(
    f'<DataType Name="Str{size}" Family="StringFamily"><Members><Member Name="LEN" DataType="DINT" Dimension="0" Hidden="false"/>'
    f'<Member Name="DATA" DataType="SINT" Dimension="{size}" Hidden="false"/></Members></DataType>'
    for size in (3, 8, 200)
)
TYPES += (
    '<DataType Name="Holder"><Members><Member Name="Label" DataType="Str8" Dimension="2" Hidden="false"/>'
    '<Member Name="Note" DataType="Str200" Dimension="0" Hidden="false"/></Members></DataType>'
)
TYPES += (
    '<DataType Name="Trio"><Members><Member Name="A" DataType="DINT" Dimension="0" Hidden="false"/>'
    '<Member Name="B" DataType="INT" Dimension="0" Hidden="false"/><Member Name="C" DataType="INT" Dimension="0" Hidden="false"/></Members></DataType>'
)
UNIT = """<AddOnInstructionDefinition Name="Unit"><Parameters>
<Parameter Name="On" TagType="Alias" DataType="BOOL" Usage="Input" AliasFor="Own.Run" Required="false"/>
<Parameter Name="Rate" TagType="Alias" DataType="DINT" Usage="Output" AliasFor="Own.Speed" Required="false"/>
</Parameters><LocalTags><LocalTag Name="Own" DataType="State"/></LocalTags>
<Routines><Routine Name="Logic" Type="ST"><STContent><Line Number="0"><![CDATA[IF Own.Run THEN Own.Speed := Own.Speed + 5; END_IF;]]></Line></STContent></Routine></Routines></AddOnInstructionDefinition>"""
STATE = (
    '<DataType Name="State"><Members><Member Name="Run" DataType="BOOL" Dimension="0" Hidden="false"/>'
    '<Member Name="Speed" DataType="DINT" Dimension="0" Hidden="false"/></Members></DataType>'
)


TEXTS = {
    "BytesAreCopied": """Numbers[0] := 16#01020304; Numbers[1] := 16#3FC00000;
COP(Numbers[0], Bytes[0], 8); COP(Numbers[1], Level, 1); COP(Bytes[1], Words[1], 100);
Pair.A := 7; Pair.B := 2.5; COP(Pair, Pairs[1], 1); COP(Pair, Copies[0], 2); COP(Copies[0], Copies[2], 9);""",
    "ElementsAreFilled": """FLL(-3, Numbers[1], 99); FLL(44, Bytes[0], 2); Pairs[0].A := 5; Pairs[1].A := 6; FLL(0, Pairs[1], 9); FLL(1, Level, 1);""",
    "TextsAreCompared": """One := 'Pump'; Two := 'Pumps'; Less := One < Two; Same := One = 'Pump'; Bit := Two <> One; COP(One.DATA[1], Bytes[0], 2);""",
    "TextsOfOwnTypes": """Short := 'Pump'; CONCAT(Short, '-12345', Short); FIND(Short, '-1', 1, Count); STOD(Short, Index);
MID(Short, 9, 3, Tiny); DTOS(-1234567890, Holder.Label[1]); Holder.Label[0] := ''; UPPER(Short, One); Holder.Note := 'spare';
IF Index < 0 THEN DELETE(Short, 4, 1, Short); ELSE Short := 'no'; END_IF; INSERT(Tiny, Short, 2, Two); SIZE(Holder.Note.DATA, 0, Speed);""",
    "LongTexts": """Long := 'ab'; FOR Index := 1 TO 6 DO CONCAT(Long, Long, Long); END_FOR; INSERT(Long, '-17', 101, Holder.Note); FIND(Holder.Note, '17', 1, Count);
STOD(Holder.Note, Speed); MID(Holder.Note, 4, 100, Short); UPPER(Short, Holder.Note); CONCAT(One, Holder.Note, One); Same := Short = Tiny; Bit := Long > Short; Less := Tiny = '';
Bytes[0] := 1; Bytes[2] := 2; COP(Bytes[0], Trio.B, 2);""",
    "ABitMay": """Index := 30; Flags.[Index + 1] := 1; Flags.[2] := NOT Same; Bit := Flags.[Index]; First := Flags.31 AND Flags.[Index + 1];""",
    "BytesChangePlaces": """Small := 16#1234; SWPB(Small, REVERSE, Small); Order := 16#01020304;
SWPB(Order, REVERSE, Numbers[0]); SWPB(Order, WORD, Numbers[1]); SWPB(Order, HIGH_LOW, Numbers[2]); SIZE(Numbers[0], 0, Count);
Field.Source := 16#F5; Field.SourceBit := 0; Field.Length := 4; Field.DestBit := 8; Field.Target := -1; BTDT(Field);
Move.Source := 16#55; Move.Mask := 16#F0; Move.Target := 16#0A; MVMT(Move);""",
    "ValuesAreScaled": """Range.In := 5; Range.InRawMax := 10; Range.InEUMin := -1; Range.InEUMax := 3; SCL(Range);
Limits.In := 7; Limits.HighLimit := 4; Limits.LowLimit := 1; HLL(Limits); Flop.D := 1; Flop.Clock := 1; DFF(Flop);
One := 'T=-12.5e1 C'; STOR(One, Level);""",
    "TheClockIs": """GSV(WallClockTime,,LocalDateTime,Clock[0]); GSV(WallClockTime, , CurrentValue, Stamp);
GSV(WALLCLOCKTIME,,CurrentValue,Halves[0]); IF S:FS THEN Count := Count + 1; END_IF;""",
    "AnAliasParameter": """Own.On := 1; Unit(Own); Unit(Own); Speed := Own.Rate;""",
    "WhatTheController": """GSV(Task, MainTask, LastScanTime, Scan); SSV(Program, THIS, MajorFaultRecord, Numbers[0]); IF S:MINOR THEN S:MINOR := 0; END_IF;
IF NOT Call.EN THEN MSG(Call); END_IF; MAM(Axis1, Motion, 0, Level, 5, Units per sec, 100, % of Maximum, Disabled, Programmed, 0, None, 0, 0);
IF Axis1.ServoActionStatus AND Motion.PC THEN RTOS(Level, Text); END_IF; UID(); Count := Count + 1; UIE();""",
}


def tag(name: str, type: str) -> str:
    plain, _, size = type.partition("[")
    dimensions = f' Dimensions="{size[:-1]}"' if size else ""
    return f'<Tag Name="{name}" TagType="Base" DataType="{plain}"{dimensions}/>'


def project() -> bytes:
    """A file with a program for each text, which has all these tags for itself."""
    tags = "".join(tag(name, type) for name, type in TAGS.items())
    programs = "".join(
        f'<Program Name="{name}" MainRoutineName="Main"><Tags>{tags}</Tags><Routines><Routine Name="Main" Type="ST"><STContent>'
        f'<Line Number="0"><![CDATA[{text}]]></Line></STContent></Routine></Routines></Program>'
        for name, text in TEXTS.items()
    )
    scheduled = "".join(f'<ScheduledProgram Name="{name}"/>' for name in TEXTS)
    return f"""<?xml version="1.0"?><RSLogix5000Content><Controller Name="C"><DataTypes>{TYPES}{STATE}</DataTypes>
<AddOnInstructionDefinitions>{UNIT}</AddOnInstructionDefinitions><Programs>{programs}</Programs>
<Tasks><Task Name="All" Type="CONTINUOUS"><ScheduledPrograms>{scheduled}</ScheduledPrograms></Task></Tasks>
</Controller></RSLogix5000Content>""".encode()


@pytest.fixture(scope="module")
def files() -> dict[str, str]:
    made = read_project(project()).files
    return made | {each.path: each.text for each in used_libraries(made, "rockwell")}


@pytest.fixture(scope="module")
def line(files: dict[str, str]) -> BothEngines:
    made = BothEngines(files, MODEL)
    made.run(3)
    return made


def values(line: BothEngines, program: str, *names: str) -> list[str]:
    return line.values(*(f"{program}_1.{name}" for name in names))


def test_bytes_are_copied_between_types_up_to_the_end_of_either(line: BothEngines) -> None:
    found = values(
        line,
        "BytesAreCopied",
        "Bytes[0]",
        "Bytes[3]",
        "Level",
        "Words[0]",
        "Words[1]",
        "Pairs[1].B",
        "Copies[0]",
        "Copies[2]",
        "Copies[3]",
    )
    assert found == ["4", "1", "1.5", "0", "515", "2.5", "7", "7", "1075838976"]


def test_elements_are_filled_up_to_the_end_and_structures_with_zero(line: BothEngines) -> None:
    assert values(line, "ElementsAreFilled", "Numbers[0]", "Numbers[1]", "Numbers[3]", "Bytes[1]", "Bytes[2]", "Pairs[0].A", "Pairs[1].A", "Level") == [
        "0", "-3", "-3", "44", "0", "5", "0", "1",
    ]  # fmt: skip


def test_texts_are_compared_by_their_characters(line: BothEngines) -> None:
    assert values(line, "TextsAreCompared", "Less", "Same", "Bit", "Bytes[0]") == ["TRUE", "TRUE", "TRUE", "117"]


def test_texts_of_own_types_are_taken_and_made_up_to_their_size(line: BothEngines) -> None:
    program = "TextsOfOwnTypes"
    assert values(line, program, "Count", "Index", "Speed") == ["5", "-123", "200"]
    assert text_in(line, program, "Short") == "-123"
    assert text_in(line, program, "Tiny") == "mp-"
    assert text_in(line, program, "Two") == "m-123p-"
    assert text_in(line, program, "Holder.Label[1]") == "-1234567"
    assert text_in(line, program, "Holder.Label[0]") == ""
    assert text_in(line, program, "Holder.Note") == "spare"
    assert text_in(line, program, "One") == "PUMP-123"
    assert values(line, program, "Short.DATA[4]") == ["0"]


def test_texts_of_more_than_82_characters_are_joined_and_texts_of_own_types_compared(line: BothEngines) -> None:
    program = "LongTexts"
    assert values(line, program, "Count", "Speed", "Same", "Bit", "Less") == ["102", "-17", "FALSE", "FALSE", "TRUE"]
    assert text_in(line, program, "Long") == "ab" * 64
    assert text_in(line, program, "Holder.Note") == "B-17"
    assert text_in(line, program, "One") == 3 * "B-17"
    assert values(line, program, "Trio.A", "Trio.B", "Trio.C") == ["0", "1", "2"]


def text_in(line: BothEngines, program: str, name: str) -> str:
    size = int(values(line, program, f"{name}.LEN")[0])
    return "".join(chr(int(each)) for each in values(line, program, *(f"{name}.DATA[{at}]" for at in range(size))))


def test_what_texts_and_copies_of_own_types_cannot_keep_stays_as_it_is() -> None:
    members: dict[str, dict[str, tuple[str, Sequence[int]]]] = {
        "STR9000": {"LEN": ("DINT", ()), "DATA": ("SINT", (9000,))},
        "PAIR": {"A": ("DINT", ()), "B": ("DINT", ())},
    }
    known = Known(types={"HUGE": ("STR9000", ()), "PAIR": ("PAIR", ()), "BYTES": ("SINT", (8,))}, members=members)
    told: list[str] = []
    written = statements("CONCAT(Huge, 'a', Huge); COP(Bytes[0], Pair.A, 3); SIZE(Pair.A, 0, n);", known, told)
    assert written == "Logix.CONCAT(Huge, Logix.TEXT('a'), Huge); COP(Bytes[0], Pair.A, 3); SIZE(Pair.A, 0, n);"
    assert len(told) == 2


def test_a_bit_may_be_chosen_by_a_tag(line: BothEngines) -> None:
    assert values(line, "ABitMay", "Flags", "Bit", "First") == ["-2147483644", "FALSE", "TRUE"]


def test_bytes_change_places_and_bits_are_put_together(line: BothEngines) -> None:
    assert values(line, "BytesChangePlaces", "Small", "Numbers[0]", "Numbers[1]", "Numbers[2]", "Count", "Field.Dest", "Move.Dest") == [
        "13330", "67305985", "50594050", "33620995", "4", "-2561", "90",
    ]  # fmt: skip


def test_values_are_scaled_limited_and_kept(line: BothEngines) -> None:
    assert values(line, "ValuesAreScaled", "Range.Out", "Limits.Out", "Limits.HighAlarm", "Flop.Q", "Flop.QNot", "Level") == [
        "1", "4", "TRUE", "TRUE", "FALSE", "-125",
    ]  # fmt: skip


def test_the_clock_is_that_of_the_virtual_plc_and_the_first_scan_is_told(line: BothEngines) -> None:
    found = values(line, "TheClockIs", "Clock[0]", "Clock[2]", "Clock[6]", "Stamp", "Halves[1]", "Count")
    assert found == ["2026", "1", "20000", "1767225600020000", "411464", "1"]


def test_an_alias_parameter_is_the_member_that_it_leads_to(line: BothEngines) -> None:
    assert values(line, "AnAliasParameter", "Speed", "Own.On") == ["30", "TRUE"]


def test_what_the_controller_would_do_is_a_stub_that_says_so(files: dict[str, str]) -> None:
    found = check_sources(files, MODEL).problems
    assert [each for each in found if each.severity is Severity.ERROR] == []
    told = " ".join(each.message for each in found if each.code == "W008")
    assert all(f"`{name}`" in told for name in ("GSV_Task_MainTask_LastScanTime", "MSG", "MAM", "RTOS"))
    assert "Stub_GSV_Task_MainTask_LastScanTime" in files["libraries/Controller.st"]
