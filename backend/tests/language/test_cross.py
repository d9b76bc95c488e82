"""Who reads and who writes; what nobody reads."""

from scanbench.language.cross import complete, cross_references, symbol_of_path, unused
from scanbench.language.navigate import named_at
from tests.language.reading import FILE, marked, read

PROGRAM = """\
FUNCTION_BLOCK Belt
VAR_INPUT run : BOOL; END_VAR
VAR_OUTPUT position : INT; END_VAR
VAR speed, spare : INT; seen : BOOL; END_VAR
IF run THEN
  position := position + speed;
END_IF;
seen := run;
speed := 3;
END_FUNCTION_BLOCK
FUNCTION_BLOCK Reset
VAR_IN_OUT what : INT; END_VAR
what := 0;
END_FUNCTION_BLOCK
VAR_GLOBAL
  total : INT;
  lamp AT %QX0.0 : BOOL;
END_VAR
PROGRAM Main
VAR belts : ARRAY[1..2] OF Belt; reset : Reset; END_VAR
belts[1](run := TRUE);
total := belts[1].position;
reset(what := total);
lamp := total > 5;
END_PROGRAM
"""


def crossed(text: str) -> list[str]:
    reading, position = marked(text)
    found = named_at(reading, FILE, position)
    assert found is not None
    assert complete(reading)
    return [f"{each.place.span.line} {each.access} {each.pou}" for each in cross_references(reading, found.symbol)]


def test_each_place_says_whether_it_reads_or_writes_and_in_which_pou() -> None:
    assert crossed(PROGRAM.replace("position := pos", "|position := pos")) == [
        "3 declared Belt",
        "6 written Belt",
        "6 read Belt",
        "22 read Main",
    ]
    assert crossed(PROGRAM.replace("  total : INT", "  |total : INT")) == [
        "16 declared ",
        "22 written Main",
        "23 written Main",
        "24 read Main",
    ]
    assert crossed(PROGRAM.replace("VAR_INPUT run", "VAR_INPUT |run")) == [
        "2 declared Belt",
        "5 read Belt",
        "8 read Belt",
        "21 written Main",
    ]
    assert crossed(PROGRAM.replace("FUNCTION_BLOCK Reset", "FUNCTION_BLOCK |Reset")) == [
        "11 declared Reset",
        "20 named Main",
    ]


def test_a_reference_is_bound_and_what_it_leads_to_may_be_written() -> None:
    text = "PROGRAM Main\nVAR r : REF_TO INT; n, m : INT; END_VAR\nr REF= n;\nm := r^;\nEND_PROGRAM\n"
    assert crossed(text.replace("VAR r", "VAR |r")) == ["2 declared Main", "3 written Main", "4 read Main"]
    assert crossed(text.replace("INT; n,", "INT; |n,")) == ["2 declared Main", "3 written Main"]
    assert [each.declared.name for each in unused(read(text))] == ["m"]


PASSED = """\
FUNCTION_BLOCK Belt
VAR_INPUT run : BOOL; speed : INT; END_VAR
VAR_IN_OUT count : INT; END_VAR
VAR_OUTPUT done : BOOL; END_VAR
METHOD Go : BOOL
VAR_INPUT fast : BOOL; END_VAR
Go := fast AND run;
END_METHOD
done := run AND speed > count;
END_FUNCTION_BLOCK
FUNCTION_BLOCK Long EXTENDS Belt
VAR_INPUT length : INT; END_VAR
END_FUNCTION_BLOCK
FUNCTION Clamp : INT
VAR_INPUT v, low : INT; END_VAR
Clamp := MAX(v, low);
END_FUNCTION
PROGRAM Main
VAR belts : ARRAY[1..2] OF Belt; n : INT; long : Long; END_VAR
belts[n](TRUE, Clamp(n, 3), n);
belts[1](run := TRUE, count := n);
long(FALSE, 7, n);
n := n + BOOL_TO_INT(belts[1].Go(TRUE));
END_PROGRAM
PROGRAM Listed
VAR a, b : INT; belt : Belt; END_VAR
LD a
Clamp b
ST b
CAL belt(run := TRUE, speed := a, count := b)
LD belt.done
END_PROGRAM
"""


def test_an_input_gets_values_by_position_too_and_in_il() -> None:
    def of(before: str, name: str, access: str = "written") -> list[int]:
        found = crossed(PASSED.replace(f"{before}{name}", f"{before}|{name}", 1))
        return [int(each.split()[0]) for each in found if each.split()[1] == access]

    assert of("VAR_INPUT ", "run") == [20, 21, 22, 30]
    assert of("run : BOOL; ", "speed") == [20, 22, 30]
    assert of("VAR_IN_OUT ", "count", "read") == [9, 20, 21, 22, 30]
    assert of("VAR_INPUT ", "v, low") == [20, 28]
    assert of("VAR_INPUT v, ", "low") == [20, 28]
    assert of("VAR_INPUT ", "fast") == [23]
    assert of("VAR_OUTPUT ", "done") == [9]


def test_il_reads_and_writes() -> None:
    assert crossed(PASSED.replace("VAR a, b", "VAR a, |b")) == [
        "26 declared Listed",
        "28 read Listed",
        "29 written Listed",
        "30 written Listed",
    ]
    assert crossed(PASSED.replace("VAR_OUTPUT done", "VAR_OUTPUT |done"))[-1] == "31 read Listed"


def test_the_line_is_told_without_its_indentation() -> None:
    reading, position = marked(PROGRAM.replace("speed := 3", "|speed := 3"))
    found = named_at(reading, FILE, position)
    assert found is not None
    assert cross_references(reading, found.symbol)[1].text == "position := position + speed;"


def test_an_instance_path_leads_to_the_variable_of_the_block() -> None:
    reading = read(PROGRAM)
    found = symbol_of_path(reading, "Main.belts[2].speed")
    assert found is not None
    assert (found.owner, found.name) == ("BELT", "SPEED")
    total = symbol_of_path(reading, "total")
    assert total is not None
    assert total.owner == "GLOBAL"
    assert symbol_of_path(reading, "Main.belts[2].sped") is None
    assert symbol_of_path(reading, "D100") is None
    assert symbol_of_path(read(PROGRAM.replace("total := ", "total = ")), "total") is None


def test_what_nobody_reads_is_listed_and_what_others_may_see_is_not() -> None:
    found = [(each.declared.name, each.written, each.pou) for each in unused(read(PROGRAM))]
    assert found == [("spare", False, "Belt"), ("seen", True, "Belt")]


def test_what_tools_are_given_and_what_a_loop_counts_with_is_read() -> None:
    found = unused(
        read("""\
PROGRAM Main
VAR given, i, n : INT; END_VAR
FOR i := 1 TO 3 DO n := n + 1; END_FOR;
END_PROGRAM
CONFIGURATION Plant
RESOURCE Cpu ON GENERIC_IEC
TASK Fast(INTERVAL := T#10ms, PRIORITY := 1);
PROGRAM P WITH Fast : Main;
END_RESOURCE
VAR_ACCESS tool : Cpu.P.given : INT READ_ONLY; END_VAR
END_CONFIGURATION
""")
    )
    assert [each.declared.name for each in found] == []


def test_what_is_passed_to_an_in_out_may_be_read_there_and_an_external_only_names_a_global() -> None:
    reading = read("""\
VAR_GLOBAL shared, dead : INT; END_VAR
FUNCTION_BLOCK Bump
VAR_IN_OUT x : INT; END_VAR
x := x + 1;
END_FUNCTION_BLOCK
TYPE Pair : STRUCT low, high : INT; END_STRUCT; END_TYPE
PROGRAM Main
VAR_EXTERNAL shared, dead : INT; END_VAR
VAR bump : Bump; n : INT; p : Pair; END_VAR
bump(x := n);
p.low := shared;
END_PROGRAM
""")
    assert [each.declared.name for each in unused(reading)] == ["dead"]
    dead = symbol_of_path(reading, "dead")
    pair = symbol_of_path(reading, "Main.p")
    assert dead is not None
    assert pair is not None
    assert [each.access for each in cross_references(reading, dead)] == ["declared", "declared"]
    assert [each.access for each in cross_references(reading, pair)] == ["declared", "written"]


def test_a_program_with_errors_is_not_complete() -> None:
    assert not complete(read(PROGRAM.replace("lamp := total > 5;", "lamp := totl > 5;")))
