"""Configurations."""

from tests.syntax.shown import complaints, show, well

TEXT = """CONFIGURATION c
VAR_GLOBAL a : INT; END_VAR
RESOURCE one ON PLC
  VAR_GLOBAL b : INT; END_VAR
  TASK slow(INTERVAL := T#100ms, PRIORITY := 2);
  TASK event(SINGLE := start, PRIORITY := 0);
  PROGRAM RETAIN main WITH slow : Lib.Main(in1 := a, in2 := 5, out => b, block WITH event);
  PROGRAM retain : Main;
END_RESOURCE
RESOURCE two
  PROGRAM x : Main;
END_RESOURCE;
VAR_ACCESS
  shown : one.main.v : INT READ_WRITE; quiet : two.x.arr[3].y : BOOL READ_ONLY; bare : one.%IX1.1 : BOOL;
END_VAR
VAR_CONFIG
  one.main.fb.located AT %IX1.0 : BOOL := TRUE; one.main.fb : TON := (PT := T#5s); two.x.arr[1] : INT := 5;
END_VAR
END_CONFIGURATION
"""


def test_configuration() -> None:
    (configuration,) = well(TEXT).configurations
    assert (configuration.name, configuration.tasks, configuration.programs) == ("c", (), ())
    one, two = configuration.resources
    assert (one.name, two.name, len(configuration.globals), len(one.globals)) == ("one", "two", 1, 1)
    assert [show(each) for each in one.tasks] == [
        "TaskDeclaration(name=slow, interval=TIME#100000000, priority=2)",
        "TaskDeclaration(name=event, priority=0, single=start)",
    ]
    assert [show(each) for each in (*one.programs, *two.programs)] == [
        "ProgramDeclaration(name=main, task=slow, type=Lib.Main, connections=[Argument(name=in1, value=a), "
        "Argument(name=in2, value=5), Argument(name=out, output=True, value=b)], block_tasks=[[block, event]], retain=True)",
        "ProgramDeclaration(name=retain, type=Main)",
        "ProgramDeclaration(name=x, type=Main)",
    ]
    assert [show(each) for each in configuration.accesses] == [
        "AccessDeclaration(name=shown, path=one.main.v, type=INT, writable=True)",
        "AccessDeclaration(name=quiet, path=two.x.arr[3].y, type=BOOL)",
        "AccessDeclaration(name=bare, path=one.%IX1.1, type=BOOL)",
    ]
    assert [show(each) for each in configuration.settings] == [
        "Variable(name=one.main.fb.located, type=BOOL, initial=1, address=%IX1.0)",
        "Variable(name=one.main.fb, type=TON, initial=StructInit(members=[[PT, TIME#5000000000]]))",
        "Variable(name=two.x.arr[1], type=INT, initial=5)",
    ]


def test_without_a_resource() -> None:
    (configuration,) = well(
        "CONFIGURATION c TASK t(INTERVAL := T#1s); PROGRAM p WITH t : q; END_CONFIGURATION"
    ).configurations
    assert (configuration.tasks[0].name, configuration.programs[0].task, configuration.resources) == ("t", "t", ())


def test_broken_configurations() -> None:
    for text, complaint in (
        ("TASK t(INTERVALL := T#1s);", "X001 2:8 INTERVALL of a task is not supported."),
        ("TASK t(PRIORITY := 1, PRIORITY := 2);", "D001 2:23 PRIORITY of this task is given twice."),
        ("TASK t;", "S003 2:7 `(` expected after the name of the task, found `;`."),
        ("PROGRAM p WITH t;", "S003 2:17 `:` expected after the program instance, then its type, found `;`."),
        ("PROGRAM p : q(5);", "S003 2:15 `input := value`, `output => variable` or `instance WITH task` expected, found `5`."),
        ("x := 1;", "S003 2:1 RESOURCE, TASK, PROGRAM, VAR_GLOBAL or END_CONFIGURATION expected, found `x`."),
        ("RESOURCE r ON P\nRESOURCE s ON P\nEND_RESOURCE", "S003 3:1 RESOURCE, TASK, PROGRAM, VAR_GLOBAL or END_RESOURCE expected, found `RESOURCE`."),
    ):  # fmt: skip
        found = complaints(f"CONFIGURATION c\n{text}\nPROGRAM fine : q;\nEND_CONFIGURATION\nPROGRAM q\nEND_PROGRAM")
        assert found[0] == complaint
