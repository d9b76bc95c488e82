"""What use says of the names of a library that nobody has."""

from scanbench.check.build import check_sources
from scanbench.check.dialect_table import dialect_in
from scanbench.check.libraries.catalogue import used_libraries
from scanbench.check.placeholders.placeholders import PATH, placeholders
from scanbench.check.placeholders.quoted import module_tags, quoted_names, seldom_declared
from scanbench.problems import Problem, Severity
from scanbench.reports.program_report import pou_lines, program_report, whole_of
from scanbench.syntax.language_file import LANGUAGE_FILE, language_text
from tests.caseformat import MODELS

MACHINE = """TYPE ST_Recipe : STRUCT speed : REAL; count : INT; END_STRUCT END_TYPE
INTERFACE I_Listener
METHOD Heard : BOOL
VAR_INPUT what : I_Event; END_VAR
END_METHOD
END_INTERFACE
FUNCTION_BLOCK FB_Belt EXTENDS FB_Device IMPLEMENTS I_Listener
VAR_INPUT wanted : REAL; END_VAR
VAR drive : FB_Drive(3); status : E_Status; END_VAR
drive(enable := bEnabled, speed := wanted, recipe := recipe, done => done);
IF drive.status.bReady AND NOT done THEN status := E_Status.Running; ELSE status := E_Status.Waiting; END_IF
CASE status OF
  E_Status.Running: n := n + drive.cycles;
  E_Status.Waiting: n := F_Next(n, ADR(recipe));
END_CASE
LogMessage('belt', n);
END_FUNCTION_BLOCK
PROGRAM MAIN
VAR belt : FB_Belt; i : INT; lists : ARRAY[1..Param_Parts.MAX_PARTS] OF REAL; END_VAR
belt(wanted := GVL_Parts.rSpeed);
FOR i := 1 TO Param_Parts.MAX_PARTS DO lists[i] := lists[i] + GVL_Parts.rSpeed; END_FOR
GVL_Parts.stState.nCount := GVL_Parts.stState.nCount + 1;
IF Parts.FB_Thing.SIZE > 2 THEN ; END_IF
END_PROGRAM
"""
METHODS = """METHOD Heard : BOOL
VAR_INPUT what : I_Event; END_VAR
Heard := what <> 0;
END_METHOD
END_FUNCTION_BLOCK
PROGRAM MAIN"""


def checked(machine: str) -> tuple[str, dict[str, str], tuple[Problem, ...]]:
    """The text of the placeholders, all files, and what is told of them."""
    sources = {"machine.st": machine, LANGUAGE_FILE: language_text("twincat", ["Parts"])}
    found = placeholders(sources, ["Parts"], dialect_in(sources).prefixes)
    assert found is not None
    text, names = found
    sources |= {PATH: text, LANGUAGE_FILE: language_text("twincat", ["Parts", *names])}
    return text, sources, check_sources(sources, MODELS["GENERIC-IEC"]).problems


def test_use_says_what_a_library_declares() -> None:
    machine = MACHINE.replace("IF Parts.FB_Thing.SIZE > 2 THEN ; END_IF\n", "")
    machine = machine.replace("VAR drive", "VAR recipe : ST_Recipe; done : BOOL; n : DINT; drive")
    machine = machine.replace("END_FUNCTION_BLOCK\nPROGRAM MAIN", METHODS)
    text, sources, problems = checked(machine)
    assert [each for each in problems if each.severity is Severity.ERROR] == []
    one = " ".join(text.split())
    assert (
        "FUNCTION_BLOCK FB_Drive {stub} VAR_INPUT enable : BOOL; speed : REAL; recipe : ST_Recipe; END_VAR VAR_OUTPUT done : BOOL; status : FB_Drive_status_Placeholder; cycles : DINT; END_VAR"
        in one
    )
    assert "FUNCTION_BLOCK FB_Device {stub} VAR_INPUT bEnabled : BOOL; END_VAR" in one
    assert "METHOD PUBLIC FB_init : BOOL VAR_INPUT bInitRetains, bInCopyCode : BOOL; in1 : DINT; END_VAR" in one
    assert "FUNCTION F_Next : DINT {stub} VAR_INPUT in1 : DINT; END_VAR VAR_INPUT in2 : PVOID; END_VAR" in one
    assert "{attribute 'qualified_only'} E_Status : (Running, Waiting);" in one
    assert "INTERFACE I_Event END_INTERFACE" in one
    assert "VAR_GLOBAL CONSTANT MAX_PARTS : INT := 10; END_VAR" in one
    assert "rSpeed : REAL; stState : stState_Placeholder;" in one
    told = [each.message for each in problems if each.code == "W008"]
    assert any("`MAX_PARTS` is a placeholder" in each and "10 is assumed" in each for each in told)
    assert any("`FB_Drive` is a placeholder, as what declares it is missing" in each for each in told)
    lines = pou_lines(whole_of(program_report(sources, problems, ["Parts"]).files))
    assert lines[0].startswith("3 of 3 POUs")
    assert "3 of these 3 use placeholders: what a missing library or file declares is inferred from its use" in lines


def test_a_mistake_in_what_the_project_declares_stays_one() -> None:
    text, _, problems = checked(
        "PROGRAM MAIN\nVAR b : FB_Drive; n : INT; END_VAR\nb(go := TRUE);\nn := 'text';\nEND_PROGRAM\n"
    )
    assert "FB_Drive" in text
    assert [each.code for each in problems if each.severity is Severity.ERROR] == ["T002"]


def test_nothing_is_written_where_every_name_is_declared() -> None:
    assert (
        placeholders({"m.st": "PROGRAM MAIN\nVAR n : INT; END_VAR\nn := ABS(n);\nEND_PROGRAM\n"}, ["Parts"], []) is None
    )


def test_a_block_that_an_interface_is_given_has_what_the_interface_has() -> None:
    machine = """FUNCTION_BLOCK FB_User
VAR i : I_Drive; END_VAR
METHOD FB_init : BOOL
VAR_INPUT bInitRetains : BOOL; bInCopyCode : BOOL; iDrive : I_Drive; END_VAR
i := iDrive;
END_METHOD
i.Move(fTo := 2.5);
i.fSpeed := 3.0;
END_FUNCTION_BLOCK
PROGRAM MAIN
VAR drive : FB_Drive; user : FB_User(iDrive := drive); units : ARRAY[1..GVL_Parts.N, 1..GVL_Parts.N] OF FB_Unit[(a := 1), (a := 2), (a := 3), (a := 4)]; b : BOOL; END_VAR
user();
b := drive.bReady;
END_PROGRAM
"""
    text, _, problems = checked(machine)
    assert [each for each in problems if each.severity is Severity.ERROR] == []
    assert "FUNCTION_BLOCK FB_Drive IMPLEMENTS I_Drive" in text
    assert "N : DINT := 2;" in text


STATION = """FUNCTION_BLOCK FB_Station
VAR lift : Parts.FB_Motor; ready : BOOL; text : STRING(80); END_VAR
lift(enable := TRUE);
CASE lift.eState OF
  Parts.E_MotorState.Stopped: ready := FALSE;
  Parts.E_MotorState.Running: ready := TRUE;
  Parts.E_MotorState.Fault: text := lift.sError;
END_CASE
CASE lift.kind OF Parts.Kind.Slow: ready := FALSE; Parts.Kind.Fast: ready := TRUE; END_CASE
IF lift.bRunning AND lift.fTorque > 12.5 THEN ready := FALSE; END_IF
END_FUNCTION_BLOCK
"""


def test_values_of_an_enumeration_with_the_name_of_the_library_before_them() -> None:
    for machine in (
        STATION,
        STATION.replace("VAR lift", "VAR state : Parts.E_MotorState; lift").replace(
            "CASE lift.eState",
            "state := lift.eState;\nIF state = Parts.E_MotorState.Stopped THEN ; END_IF\nCASE lift.eState",
        ),
    ):
        text, _, problems = checked(
            f"{machine}PROGRAM MAIN\nVAR station : FB_Station; END_VAR\nstation();\nEND_PROGRAM\n"
        )
        assert [str(each) for each in problems if each.severity is Severity.ERROR] == []
        one = " ".join(text.split())
        assert "{attribute 'qualified_only'} E_MotorState : (Stopped, Running, Fault);" in one
        assert "Kind : (Slow, Fast);" in one
        assert one.count("E_MotorState :") == 1
        assert (
            "VAR_INPUT enable : BOOL; END_VAR VAR_OUTPUT eState : E_MotorState; sError : STRING[80]; kind : Kind; bRunning : BOOL; fTorque : LREAL; END_VAR"
            in one
        )


def test_what_others_write_or_are_lent_is_no_output() -> None:
    machine = """FUNCTION_BLOCK FB_Count
VAR_IN_OUT n : DINT; END_VAR
n := n + 1;
END_FUNCTION_BLOCK
PROGRAM MAIN
VAR motor : Parts.FB_Motor; count : FB_Count; END_VAR
motor(enable := TRUE);
count(n := motor.nCount);
motor.stSetting.rSpeed := 1.5;
motor.anList[1] := 3;
FOR motor.nIndex := 1 TO 3 DO ; END_FOR
IF motor.done THEN ; END_IF
END_PROGRAM
"""
    text, _, problems = checked(machine)
    assert [str(each) for each in problems if each.severity is Severity.ERROR] == []
    assert "VAR_OUTPUT done : BOOL; END_VAR" in " ".join(text.split())


def test_a_type_that_only_goes_to_itself() -> None:
    machine = """PROGRAM MAIN
VAR motor : Parts.FB_Motor; one : Parts.T_Handle; two : Parts.T_Other; END_VAR
motor(one := one);
one := motor.h;
motor.g := two;
two := motor.g;
END_PROGRAM
"""
    _, _, problems = checked(machine)
    assert [str(each) for each in problems if each.severity is Severity.ERROR] == []


def test_variables_of_a_list_with_the_name_of_the_library_before_it() -> None:
    machine = """PROGRAM MAIN
VAR count : FB_Count; END_VAR
count(n := Parts.GVL_Parts.nCount);
Parts.GVL_Parts.stState.rSpeed := 1.5;
END_PROGRAM
FUNCTION_BLOCK FB_Count
VAR_IN_OUT n : DINT; END_VAR
n := n + 1;
END_FUNCTION_BLOCK
"""
    text, _, problems = checked(machine)
    assert [str(each) for each in problems if each.severity is Severity.ERROR] == []
    assert "GVL_Parts : GVL_Parts_Placeholder;" in text


SCL = """FUNCTION_BLOCK "Motor"
VAR_INPUT start : Bool; config : "MotorConfig"; END_VAR
VAR_IN_OUT drive : "Drive"; END_VAR
VAR scaling : "Scaling"; state : Int; i : Int; speed : Real; timer : TON_TIME; END_VAR
BEGIN
#timer(IN := #start AND NOT "Stop 1", PT := #config.delay);
IF "Config".motors[120].enabled AND "Config".limit > 12.5 THEN "Lamp" := #timer.Q; END_IF;
"Pause".TON(IN := #start, PT := T#2s);
#scaling(in := 5, high := "Config".high, out => #speed);
#speed := "Average"(raw := "Level", low := 0.0) + "Sel";
"Wait"(timer := #timer);
"Pump_DB"(start := #start);
IF "Pump_DB".running THEN "Count" := "Count" + #i; END_IF;
CASE #state OF
  "RUNS": #state := 1;
  "FAILS", 3: #state := 0;
END_CASE;
FOR #i := 0 TO "MAX_MOTORS" DO #drive.list[#i].speed := 2.5; END_FOR;
#mistyped := 1;
END_FUNCTION_BLOCK
ORGANIZATION_BLOCK "Main"
BEGIN
"Motor_DB"(start := "Start", drive := "Drives".first);
END_ORGANIZATION_BLOCK
DATA_BLOCK "Motor_DB"
"Motor"
BEGIN
END_DATA_BLOCK
"""


def test_names_in_the_quotes_of_scl_that_no_file_declares() -> None:
    sources = {"motor.scl": SCL, LANGUAGE_FILE: language_text("siemens")}
    sources |= {each.path: each.text for each in used_libraries(sources, "siemens")}
    quoted = quoted_names(sources)
    assert {"MOTOR", "STOP_1", "SEL", "FAILS"} <= quoted
    found = placeholders(sources, (), dialect_in(sources).prefixes, quoted)
    assert found is not None
    one = " ".join(found[0].split())
    for text in (
        "Stop_1 : Bool;", "Lamp : BOOL;", "Pause : IEC_TIMER;", "Count : Int;", "Sel : Real;", "MAX_MOTORS : Int;",
        "motors : ARRAY[0..120] OF Config_Placeholder_motors_Placeholder;", "limit : REAL;",
        "FUNCTION_BLOCK Scaling {stub} VAR_INPUT in : DINT;", "VAR_OUTPUT out : Real; END_VAR", "FUNCTION Average : Real {stub}",
        "VAR_IN_OUT timer : TON_TIME; END_VAR", "FUNCTION_BLOCK Pump_DB_Placeholder {stub}", "TYPE Drive : STRUCT",
        "VAR_GLOBAL CONSTANT RUNS : Int := 10001; FAILS : Int := 10002; END_VAR",
    ):  # fmt: skip
        assert text in one, text
    assert "mistyped" not in one
    sources |= {PATH: found[0]}
    sources |= {each.path: each.text for each in used_libraries(sources, "siemens")}
    problems = check_sources(sources, MODELS["GENERIC-IEC"]).problems
    assert [each.code for each in problems if each.severity is Severity.ERROR] == ["T001"]
    assert sum("is a placeholder, as what declares it is missing" in each.message for each in problems) == 18


def test_tags_of_modules_that_no_file_declares() -> None:
    text = """PROGRAM Main
VAR lamp : BOOL; level : REAL; n : DINT; Own_I : DINT; END_VAR
IF Local_1_I.Data.3 AND NOT Local_1_I.Fault.0 THEN Rack_2_O1.Data.1 := lamp; END_IF
level := Analog_I.Ch0Data * 2.0;
(* Comment_I.x *)
n := Own_I + Missing;
END_PROGRAM
"""
    sources = {"main.st": text, LANGUAGE_FILE: language_text("rockwell")}
    assert module_tags(sources) == {"LOCAL_1_I", "RACK_2_O1", "ANALOG_I"}
    assert seldom_declared(sources, "rockwell") == module_tags(sources)
    assert seldom_declared(sources, "codesys") == frozenset()
    found = placeholders(sources, (), frozenset(), module_tags(sources))
    assert found is not None
    one = " ".join(found[0].split())
    for each in ("Data : DINT; Fault : DINT;", "Ch0Data : REAL;", "Local_1_I : Local_1_I_Placeholder;"):
        assert each in one, each
    problems = check_sources(sources | {PATH: found[0]}, MODELS["GENERIC-IEC"]).problems
    assert [each.message[:28] for each in problems if each.severity is Severity.ERROR] == ["`Missing` is not declared."]


def test_counters_are_those_of_the_dialect() -> None:
    machine = "PROGRAM MAIN VAR c : CTU; d : FB_Panel; END_VAR c(CU := TRUE, PV := 3); d.total := c.CV; END_PROGRAM"
    text, _, problems = checked(machine)
    assert "total : WORD" in text
    assert [str(each) for each in problems if each.severity is Severity.ERROR] == []


def test_what_leads_back_to_itself_is_elsewhere() -> None:
    for machine, line in (
        (
            "PROGRAM MAIN VAR d, e : FB_Node; END_VAR d := d.next; e := d.next.next; END_PROGRAM",
            "next : REFERENCE TO FB_Node;",
        ),
        (
            "PROGRAM MAIN VAR d, e : ST_Node; END_VAR d.next := e; e.v := d.next.v; END_PROGRAM",
            "next : REFERENCE TO ST_Node;",
        ),
        ("PROGRAM MAIN VAR d : ST_A; e : ST_B; END_VAR d.o := e; e.n := d; END_PROGRAM", "o : REFERENCE TO ST_B;"),
        (
            "FUNCTION_BLOCK FB_A VAR x : FB_B; END_VAR x.sub.a := 1; x.sub := x; END_FUNCTION_BLOCK\n"
            "PROGRAM MAIN VAR a : FB_A; END_VAR a(); END_PROGRAM",
            "sub : REFERENCE TO FB_B;",
        ),
    ):
        text, _, problems = checked(machine)
        assert line in text
        assert [str(each) for each in problems if each.severity is Severity.ERROR] == []
