"""A file of Studio 5000 as a project: what its Structured Text computes, and what cannot be read is told."""

from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scanbench.check.libraries.catalogue import used_libraries
from scanbench.syntax.l5x.known import Known, Parameter, Passed
from scanbench.syntax.l5x.project import is_l5x, read_project
from scanbench.syntax.l5x.statements import passed_of, statements
from scanbench.syntax.xml_tree import BadXml
from tests.amounts import amount
from tests.caseformat import MODELS
from tests.syntax.both_engines import BothEngines

LINE = (Path(__file__).parent / "line.L5X").read_bytes()


def test_all_of_a_project_is_kept() -> None:
    made = read_project(LINE)
    assert is_l5x(LINE)
    assert made.name == "Line"
    assert list(made.files) == [
        "Scale.st", "MainProgram.st", "Types.st", "Tags.st", "Configuration.st", "language.json",
    ]  # fmt: skip
    assert [(each.pou, each.language, each.refused) for each in made.pous] == [
        ("Scale.Logic", "ST", False), ("MainProgram.MainRoutine", "LD", False), ("MainProgram.Calc", "ST", False),
        ("MainProgram.Strings", "ST", False), ("MainProgram.Drawn", "FBD", True),
    ]  # fmt: skip
    assert [each.notes for each in made.pous if each.notes] == [
        ["`[:=]` is `:=` here: the variable keeps its value over a restart"],
        ["the routine Drawn is written in FBD; it is left out"],
    ]
    tags = made.files["Tags.st"]
    assert "    Motors : ARRAY[0..1] OF Motor := [(Speed := 7, Samples := [0.0, 2.5, 0.0, 1.0e+002])];\n" in tags
    assert "VAR_GLOBAL CONSTANT\n    Mask : DINT := -16;\n" in tags
    assert "    Local_1_I : AB_1769_IQ16_I_0;\n" in tags


def test_it_runs_on_both_engines_with_the_values_of_logix() -> None:
    files = read_project(LINE).files
    files |= {each.path: each.text for each in used_libraries(files, "rockwell")}
    line = BothEngines(files, MODELS["GENERIC-IEC"])
    line.run(7)

    def value(name: str) -> str:
        return line.values(name)[0]

    main = "MainProgram_1"
    assert {name: value(f"{main}.{name}") for name in ("Half", "Reading", "Logged[1]", "Masked", "Calc")} == {
        "Half": "4", "Reading": "10.5", "Logged[1]": "10", "Masked": "0", "Calc": "46666",
    }  # fmt: skip
    assert (value(f"{main}.Delay.DN"), value("Motors[1].Run"), value(f"{main}.Copy[0].Speed")) == ("TRUE", "TRUE", "7")
    assert (value(f"{main}.Text.LEN"), value(f"{main}.Where")) == ("5", "4")


@settings(max_examples=amount(2000, 200), deadline=None)
@given(st.lists(st.sampled_from([*"ab1.:=[](),;'$/*\\\n#T", "Valve(", "JSR(", "(*", "*)"])).map("".join))
def test_any_text_is_written(text: str) -> None:
    told: list[str] = []
    written = statements(text, KNOWN, told)
    assert statements(text, KNOWN, told) == written


KNOWN = Known(
    aliases={"DOOR": "Local:1:I.Data.3", "GATE": "Door", "ROUND": "Round"},
    routines={"FILL": "Fill"},
    types={"A": ("DINT", [9]), "B": ("DINT", [4]), "W": ("INT", []), "BITS": ("BOOL", [32])},
    instructions={"VALVE": [Parameter("Open", "Input"), Parameter("Moved", "Output"), Parameter("Log", "InOut")]},
)


@pytest.mark.parametrize(
    ("logix", "here"),
    [
        ("x := gate; // of the Door", "x := Local_1_I.Data.%X3; // of the Door"),
        ("Round := 1;", "Round := 1;"),
        ("a.Door := b.3;", "a.Door := b.%X3;"),
        ("x := 5.3 + 16#FF_00 + y[2].7;", "x := 5.3 + 16#FF_00 + y[2].%X7;"),
        ("IF(a)THEN JSR(Fill); END_IF;", "IF(a)THEN Fill(); END_IF;"),
        (
            "Valve(V[i, 2], (a AND b), Done, (* where *) Logs);",
            "V[i, 2](Open := (a AND b), Moved => Done, Log := Logs);",
        ),
        ("TONR(t1); Other(1, 2);", "Logix.TONR(t1); Other(1, 2);"),
        ("d := 2#19 + 8#9;", "d := 2#19 + 8#9;"),
        ("d := ---- 2 ** 2;", "d := -(-(-(-( 2 ** 2))));"),
        (
            "COP(a[2], b, 4);",
            "Logix.COP(ADR(a[2]), ADR(b[0]), MIN(MIN(4, 4) * SIZEOF(b[0]), (9 - (2)) * SIZEOF(a[2])));",
        ),
        (
            "COP(a[0], b[i + 1], n);",
            "Logix.COP(ADR(a[0]), ADR(b[i + 1]), MIN(MIN(n, 4 - (i + 1)) * SIZEOF(b[i + 1]), (9) * SIZEOF(a[0])));",
        ),
        ("CASE x OF 1..5: y := 10; 7: y := -x; END_CASE;", "CASE x OF 1..5: y := 10; 7: y := -x; END_CASE;"),
        ("d := -i ** 2 - x[1] ** 2;", "d := -(i ** 2) - x[1] ** 2;"),
        ("d := -2.0 ** -n.a[3] * -4;", "d := -(2.0 ** -n.a[3]) * -4;"),
        ("d := 16#FFFF_FFFF AND 16#7FFF_FFFF;", "d := DWORD_TO_DINT(16#FFFF_FFFF) AND 16#7FFF_FFFF;"),
        ("var := 'a$'b'; type.of := 1;", "var_ := Logix.TEXT('a$'b'); type_.of_ := 1;"),
        ("#region one\nx := 1; /* b.3 */\n#endregion", "//#region one\nx := 1; /* b.3 */\n//#endregion"),
        ("TONR(", "Logix.TONR("),
        ("Valve(", "()"),
        ("JSR(", "()"),
        ("\\Other.Count := 1;", "Other.Count := 1;"),
    ],
)
def test_statements_are_written_as_the_standard_has_them(logix: str, here: str) -> None:
    told: list[str] = []
    assert statements(logix, KNOWN, told) == here
    assert told == []


def test_what_a_statement_cannot_keep_is_told() -> None:
    told: list[str] = []
    kept = "JSR(Fill, 1, a); RET(z); COP(bits[0], a[0], 1); COP(bits[0], bits[1], 1);"
    assert statements(f"x [:=] 1; {kept}", KNOWN, told) == f"x := 1; {kept}"
    assert told == [
        "`[:=]` is `:=` here: the variable keeps its value over a restart",
        "JSR has parameters, which are not read: the statement stays as it is, and is refused",
        "RET has parameters, which are not read: the statement stays as it is, and is refused",
        "COP(bits[0], a[0], 1) copies between different types, whose bytes are different here: the statement stays as it is, and is refused",
        "COP(bits[0], bits[1], 1) copies between different types, whose bytes are different here: the statement stays as it is, and is refused",
    ]


def controller(tags: str = "", programs: str = "", more: str = "") -> bytes:
    return (
        f'<RSLogix5000Content><Controller Name="C"><Tags>{tags}</Tags>{more}<Programs>{programs}</Programs></Controller></RSLogix5000Content>'
    ).encode()


def tag(name: str, type: str, data: str = "", more: str = "") -> str:
    return f'<Tag Name="{name}" DataType="{type}" {more}>{data}</Tag>'


def program(name: str, text: str, tags: str = "", more: str = "") -> str:
    return (
        f'<Program Name="{name}" MainRoutineName="M" {more}><Tags>{tags}</Tags><Routines><Routine Name="M" Type="ST"><STContent>'
        f"<Line>{text}</Line></STContent></Routine></Routines></Program>"
    )


def decorated(type: str, value: str) -> str:
    return f'<Data Format="Decorated"><DataValue DataType="{type}" Value="{value}"/></Data>'


def test_start_values_in_all_their_forms() -> None:
    texts = '<Data Format="String" Length="2"><![CDATA[\'A1\']]></Data>'
    made = read_project(
        controller(
            tag("s", "STRING", texts)
            + tag("ascii", "DINT", decorated("DINT", "'$00$00$00A'"))
            + tag("inf", "REAL", decorated("REAL", "1.#INF"))
            + tag("long", "DINT", decorated("DINT", "9" * 5000))
            + tag("alarm", "ALARM", '<Data Format="Alarm"/>')
            + tag("odd", "DINT", more='Dimensions="²"')
        )
    )
    text = made.files["Tags.st"]
    assert "s : Logix.STRING82 := (LEN := 2, DATA := [65, 49]);" in text
    assert "ascii : DINT := 65;" in text
    assert "inf : REAL;" in text
    assert "odd : DINT;" in text
    assert [note.split(" is not read")[0] for note in made.pous[-1].notes] == [
        "the start value of inf", "the start value of long", "the start value of alarm",
    ]  # fmt: skip


def test_aliases_of_the_controller_and_tags_of_the_program() -> None:
    tags = tag("v", "DINT", more='TagType="Alias" AliasFor="raw"') + tag(
        "w", "DINT", more='TagType="Alias" AliasFor="q"'
    )
    tags += tag("raw", "DINT") + tag("q", "DINT")
    made = read_project(controller(tags, program("P", "v := 5; w := 7;", tag("v", "DINT") + tag("q", "DINT"))))
    assert "v := 5; w := 7;" in made.files["P.st"]
    assert made.pous[-1].notes == ["the alias W leads to q, of which the program has one of its own; it is left out"]


def test_what_does_not_run_there_does_not_run_here() -> None:
    tasks = "<Tasks>" + "".join(
        f'<Task Name="{name}" Type="{type}" Rate="20" Priority="5" {more}><ScheduledPrograms><ScheduledProgram Name="{of}"/></ScheduledPrograms></Task>'
        for name, type, more, of in (
            ("T", "PERIODIC", "", "A"), ("E", "EVENT", "", "B"), ("I", "PERIODIC", 'InhibitTask="true"', "B"), ("C", "CONTINUOUS", "", "D"),
        )
    ) + "</Tasks>"  # fmt: skip
    programs = program("A", "") + program("B", "") + program("D", "", more='Disabled="true"')
    made = read_project(controller("", programs, tasks))
    assert made.files["Configuration.st"].splitlines()[2:-2] == [
        "TASK T(INTERVAL := T#20ms, PRIORITY := 5);", "PROGRAM A_1 WITH T : A;",
    ]  # fmt: skip
    assert [note.split(" ")[0] for note in made.pous[-1].notes] == ["D", "E", "I"]


def test_calls_within_calls_without_end_are_left_out_and_told() -> None:
    made = read_project(controller("", program("P", f"x := {'JSR(' * 90}{'-' * 90}a ** 2;")))
    assert [(each.refused, each.notes) for each in made.pous] == [
        (True, ["the routine M has calls within calls, too many to be read; it is left out"])
    ]


def test_files_of_one_name_are_all_kept() -> None:
    made = read_project(controller(tag("x", "DINT"), program("Tags", "x := 1;") + program("tags", "x := 2;")))
    assert {"Tags.st", "tags_2.st", "Tags_3.st"} <= set(made.files)


@pytest.mark.parametrize(
    ("damage", "message"),
    [
        (LINE[:300], "this is no XML"),
        (b"<RSLogix5000Content/>", ""),
        (LINE.replace(b"<RSLogix5000Content ", b'<!DOCTYPE a [<!ENTITY b "c">]><RSLogix5000Content '), "has a DOCTYPE"),
        (LINE.replace(b"RSLogix5000Content", b"Content"), "begins with <Content>, not with <RSLogix5000Content>"),
    ],
)
def test_what_is_no_project_is_refused_with_a_reason(damage: bytes, message: str) -> None:
    if message:
        with pytest.raises(BadXml, match=message):
            read_project(damage)
    else:
        assert read_project(damage).files == {}


def routine(name: str, text: str) -> str:
    return f'<Routine Name="{name}" Type="ST"><STContent><Line>{text}</Line></STContent></Routine>'


def test_routines_are_given_values_and_give_some_back() -> None:
    tags = "".join(f'<Tag Name="{each}" TagType="Base" DataType="DINT"/>' for each in "a b x y sum less".split())
    main = routine("M", "a := a + 5; JSR(Both, 2, a, 3, sum, less); IF sum > 100 THEN JSR(Again, 1, a + 1); END_IF;")
    both = routine("Both", "// of two\nSBR(x, y); RET(x + y, x - y);")
    again = routine("Again", "SBR(x); IF x = 0 THEN RET(); END_IF; b := x;")
    made = read_project(
        controller(
            "",
            f'<Program Name="P" MainRoutineName="M"><Tags>{tags}</Tags><Routines>{main}{both}{again}</Routines></Program>',
        )
    )
    assert [each.notes for each in made.pous] == [[], [], []]
    assert "x := a; y := 3; Both(); sum := x + y; less := x - y;" in made.files["P.st"]
    plc = BothEngines(
        {each: text for each, text in made.files.items() if each != "Configuration.st"}, MODELS["GENERIC-IEC"]
    )
    plc.run(20)
    values = {name: plc.values(f"P.{name}")[0] for name in ("a", "b", "sum", "less")}
    assert values == {"a": "100", "b": "101", "sum": "103", "less": "97"}


def test_tags_of_other_programs_are_read_and_written() -> None:
    tasks = '<Tasks><Task Name="T" Type="PERIODIC" Rate="10" Priority="5"><ScheduledPrograms>' + "".join(
        f'<ScheduledProgram Name="{name}"/>' for name in "AB"
    ) + "</ScheduledPrograms></Task></Tasks>"  # fmt: skip
    a = program("A", "seen := \\B.count; \\B.limit := seen + 10;", tag("seen", "DINT"))
    b = program(
        "B",
        "count := count + 1; full := count > limit;",
        tag("count", "DINT") + tag("limit", "DINT") + tag("full", "BOOL"),
    )
    plc = BothEngines(read_project(controller("", a + b, tasks)).files, MODELS["GENERIC-IEC"])
    plc.run(3)
    assert plc.values("A_1.seen", "B_1.count", "B_1.limit", "B_1.full") == ["2", "3", "12", "FALSE"]


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("x := 1;", Passed()),
        ("SBR(a, b); x := a; RET(x);", Passed(("a", "b"), ("x",))),
        ("IF a THEN RET(x); END_IF; RET(x);", Passed((), ("x",))),
        ("x := 1; SBR(a);", None),
        ("IF a THEN RET(x); END_IF;", None),
        ("IF a THEN RET(y); END_IF; RET(x);", None),
        ("SBR(f(a));", None),
    ],
)
def test_what_a_routine_is_given_and_gives_back(text: str, found: Passed | None) -> None:
    assert passed_of(text) == found


def test_values_that_depend_on_each_other_are_not_passed() -> None:
    known = Known(routines={"FILL": "Fill"}, passed={"FILL": Passed(("a", "b"), ())})
    told: list[str] = []
    assert statements("JSR(Fill, 2, b, a);", known, told) == "JSR(Fill, 2, b, a);"
    assert len(told) == 1


def test_an_add_on_instruction_takes_arrays_of_any_size() -> None:
    def parameter(name: str, type: str, usage: str, dimensions: str = "") -> str:
        sizes = f' Dimensions="{dimensions}"' if dimensions else ""
        return f'<Parameter Name="{name}" TagType="Base" DataType="{type}" Usage="{usage}"{sizes} Required="true"/>'

    text = (
        "SIZE(List, 0, n); List[n - 1] := List[0] + n; FOR i := 0 TO n - 1 DO Total := Total + List[i]; END_FOR; "
        "COP(List[1], Copy[0], 9); FLL(7, Copy[1], 99); SIZE(Grid, 1, Wide);"
    )
    shift = (
        '<AddOnInstructionDefinition Name="Shift"><Parameters>'
        + parameter("List", "DINT", "InOut", "1")
        + parameter("Copy", "DINT", "InOut", "1")
        + parameter("Grid", "INT", "InOut", "1 1")
        + parameter("Total", "DINT", "Output")
        + parameter("Wide", "DINT", "Output")
        + '</Parameters><LocalTags><LocalTag Name="n" DataType="SINT"/><LocalTag Name="i" DataType="INT"/></LocalTags><Routines>'
        + routine("Logic", text)
        + "</Routines></AddOnInstructionDefinition>"
    )
    tags = "".join(
        f'<Tag Name="{name}" TagType="Base" DataType="{type}"{sizes}/>'
        for name, type, sizes in (
            ("Few", "DINT", ' Dimensions="2"'),
            ("Many", "DINT", ' Dimensions="5"'),
            ("Plan", "INT", ' Dimensions="2 3"'),
            ("One", "Shift", ""),
            ("Two", "Shift", ""),
            ("a", "DINT", ""),
            ("b", "DINT", ""),
            ("w", "DINT", ""),
        )
    )
    main = routine("M", "Many[0] := 3; Shift(One, Few, Many, Plan, a, w); Shift(Two, Many, Few, Plan, b, w);")
    made = read_project(
        controller(
            "",
            f'<Program Name="P" MainRoutineName="M"><Tags>{tags}</Tags><Routines>{main}</Routines></Program>',
            f"<AddOnInstructionDefinitions>{shift}</AddOnInstructionDefinitions>",
        )
    )
    assert [each.notes for each in made.pous] == [[], []]
    files = {name: each for name, each in made.files.items() if name != "Configuration.st"}
    plc = BothEngines(
        {**files, **{each.path: each.text for each in used_libraries(files, "rockwell")}}, MODELS["GENERIC-IEC"]
    )
    plc.run(1)
    assert plc.values("P.a", "P.b", "P.w") == ["2", "30", "3"]
    assert plc.values(*(f"P.Many[{i}]" for i in range(5))) == ["2", "7", "7", "7", "7"]
    assert plc.values("P.Few[0]", "P.Few[1]") == ["7", "7"]
