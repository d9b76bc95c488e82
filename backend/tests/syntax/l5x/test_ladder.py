"""Ladders of Logix: what their rungs compute."""

import pytest

from scanbench.syntax.l5x.known import Known
from scanbench.syntax.l5x.ladder import NotRead, structured
from scanbench.syntax.l5x.project import read_project
from tests.syntax.both_engines import BothEngines
from tests.syntax.l5x.test_foreign_exports import engines, routine
from tests.syntax.l5x.test_project import controller, tag


def ladder(*rungs: str, name: str = "Logic") -> str:
    lines = "".join(f"<Rung Type='N'><Text>\n<![CDATA[{each}]]>\n</Text></Rung>" for each in rungs)
    return routine(f"<RLLContent>{lines}</RLLContent>", "RLL", name)


def program(tags: dict[str, str], *rungs: str) -> BothEngines:
    declared = "".join(tag(name, each) for type, names in tags.items() for name in names.split() for each in (type,))
    made = read_project(
        controller(
            declared, f'<Program Name="P" MainRoutineName="Logic"><Routines>{ladder(*rungs)}</Routines></Program>'
        )
    )
    assert [each.notes for each in made.pous] == [[]]
    return engines(made.files)


def test_contacts_and_branches_are_power_from_the_left_to_the_right() -> None:
    plc = program(
        {"BOOL": "a b c run stop motor x y z q", "DINT": "n m"},
        "[XIC(a) XIO(b),XIC(motor)] XIO(stop) OTE(motor);",
        "XIC(a)OTU(a)OTL(q);",  # the latch gets the power of before the unlatch
        "XIC(c)[OTE(x),XIC(b)OTE(y),EQU(n,3)]MOV(7,m);",
        "[,XIC(b)]OTE(z);",
    )
    names = ("motor", "q", "a", "x", "y", "m", "z")
    plc.run(1, a="TRUE", c="TRUE")
    assert plc.values(*names) == ["TRUE", "TRUE", "FALSE", "TRUE", "FALSE", "7", "TRUE"]
    plc.run(1, b="TRUE", c="FALSE", stop="TRUE")
    assert plc.values("motor", "x", "y") == ["FALSE", "FALSE", "FALSE"]


def test_what_a_branch_sets_is_not_seen_by_the_power_of_before() -> None:
    plc = program({"BOOL": "a d", "DINT": "n"}, "XIC(a)[OTU(a),ADD(n,1,n)]OTE(d);")
    plc.run(1, a="TRUE")
    assert plc.values("a", "n", "d") == ["FALSE", "1", "TRUE"]


def test_one_shots_have_no_pulse_at_the_first_scan() -> None:
    plc = program(
        {"BOOL": "a s t u up down", "DINT": "n"}, "XIC(a)ONS(s)ADD(n,1,n);", "XIC(a)OSR(t,up);", "XIC(a)OSF(u,down);"
    )
    plc.run(2, a="TRUE")
    assert plc.values("n", "up", "down") == ["0", "FALSE", "FALSE"]
    plc.run(1, a="FALSE")
    assert plc.values("n", "up", "down") == ["0", "FALSE", "TRUE"]
    plc.run(1, a="TRUE")
    assert plc.values("n", "up", "down") == ["1", "TRUE", "FALSE"]
    plc.run(1)
    assert plc.values("n", "up", "down") == ["1", "FALSE", "FALSE"]


def test_counters_count_what_begins_after_the_first_scan() -> None:
    plc = program({"BOOL": "a r", "COUNTER": "c"}, "XIC(a)CTU(c,2,0);", "XIC(r)RES(c);")
    plc.run(1, a="TRUE")
    assert plc.values("c.ACC", "c.PRE", "c.CU", "c.DN") == ["0", "2", "TRUE", "FALSE"]
    for each in ("FALSE", "TRUE", "FALSE", "TRUE"):
        plc.run(1, a=each)
    assert plc.values("c.ACC", "c.DN") == ["2", "TRUE"]
    plc.run(1, a="FALSE", r="TRUE")
    assert plc.values("c.ACC", "c.DN") == ["0", "FALSE"]


def test_an_instruction_whose_logic_is_a_ladder_runs() -> None:
    parameters = "".join(
        f'<Parameter Name="{name}" TagType="Base" DataType="BOOL" Usage="{usage}" Required="{required}"/>'
        for name, usage, required in (
            ("EnableIn", "Input", "false"), ("EnableOut", "Output", "false"), ("I", "Input", "true"), ("O", "Output", "true"),
        )
    )  # fmt: skip
    instruction = (
        '<AddOnInstructionDefinitions><AddOnInstructionDefinition Name="A1"><Parameters>'
        f"{parameters}</Parameters><LocalTags><LocalTag Name='T' DataType='BOOL'/></LocalTags><Routines>"
        f"{ladder('XIC(I)ONS(T)OTE(O);')}{ladder('OTE(O);', name='EnableInFalse')}</Routines>"
        "</AddOnInstructionDefinition></AddOnInstructionDefinitions>"
    )
    main = f'<Program Name="P" MainRoutineName="Logic"><Routines>{ladder("XIC(go)A1(a,in,out);")}</Routines></Program>'
    made = read_project(
        controller(tag("a", "A1") + "".join(tag(each, "BOOL") for each in ("go", "in", "out")), main, instruction)
    )
    assert [each.notes for each in made.pous] == [
        [], ["the routine EnableInFalse runs at times that do not exist here (faults, prescan, postscan); nothing calls it"], [],
    ]  # fmt: skip
    plc = engines(made.files)
    plc.run(1, go="TRUE")
    plc.run(1, **{"in": "TRUE"})
    assert plc.values("out") == ["TRUE"]
    plc.run(1)
    assert plc.values("out") == ["FALSE"]


@pytest.mark.parametrize(
    ("rung", "what"),
    [
        ("XIC(a)JMP(end);", "JMP(end)"),
        ("XIC(a)TON(t,preset,0);", "TON(t,preset,0)"),
        ("XIC(a)TON(t", "("),
        ("[XIC(a)OTE(b)", "["),
        ("XIC(a))", ")"),
        ("XIC(a)DIV(n,2,r);", "DIV(n, 2, r)"),
        ("[" * 60, "["),
    ],
)
def test_what_is_not_read_is_named(rung: str, what: str) -> None:
    known = Known(types={"T": ("TIMER", []), "N": ("DINT", []), "R": ("REAL", [])})
    with pytest.raises(NotRead) as bad:
        structured([(rung, "")], "R", known)
    assert str(bad.value).replace(", ", ",") == what.replace(", ", ",")
