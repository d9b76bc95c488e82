"""One mistake, one message: what follows from a declaration that was refused is not told once more, and nothing breaks on it."""

from difflib import get_close_matches

import pytest

from scanbench.check import context
from scanbench.check.build import check_sources
from scanbench.check.standard.functions import FUNCTIONS
from tests.caseformat import MODELS


def told(*sources: str) -> list[str]:
    files = {f"{number}.st": text for number, text in enumerate(sources)}
    return [each.message for each in check_sources(files, MODELS["GENERIC-IEC"]).problems]


MOTOR = """FUNCTION_BLOCK Motor EXTENDS Missing IMPLEMENTS Runs
VAR own : INT; END_VAR
METHOD PUBLIC OVERRIDE Start : BOOL
own := inherited + 1;
Start := SUPER.Start() AND Ready();
Halt(FALSE);
END_METHOD
inherited := THIS.other + own;
SUPER(given := 3);
END_FUNCTION_BLOCK
FUNCTION_BLOCK Pump EXTENDS Motor
level := own + inherited;
THIS.Fill();
END_FUNCTION_BLOCK
INTERFACE Runs METHOD Run : BOOL END_METHOD END_INTERFACE
INTERFACE Other END_INTERFACE
PROGRAM Main VAR p : Pump := (speed := 1); m : Motor; r : Runs; e : Other; n : INT; END_VAR
p(given := 1, taken => n);
n := p.level + m.level;
p.Fill(3);
IF p.Ready() THEN n := m.%X1; END_IF
r := m;
e := p;
END_PROGRAM"""


def test_an_unknown_base_is_told_once() -> None:
    messages = told(MOTOR.replace("m.%X1", "1"))
    assert messages == ["There is no FUNCTION_BLOCK or CLASS `Missing`."]
    assert told(MOTOR.replace("m.%X1", "nothing"))[1:] == ["`nothing` is not declared."], (
        "what is none of its affair is"
    )


BROKEN = {
    "the result of a function": "FUNCTION F : Nope F := 1; END_FUNCTION PROGRAM Main VAR n : INT; END_VAR n := 3 * F() + MIN(-F(), n); F(); END_PROGRAM",
    "the result of a method": "FUNCTION_BLOCK B METHOD M : Nope M := 1; END_METHOD END_FUNCTION_BLOCK PROGRAM Main VAR n : INT; b : B; END_VAR n := b.M() + 1; END_PROGRAM",
    "a parameter": "FUNCTION F : INT VAR_INPUT a : Nope; END_VAR F := a; END_FUNCTION PROGRAM Main VAR n : INT; END_VAR n := F(a := 1); n := F(1); END_PROGRAM",
    "a member": "TYPE S : STRUCT a : Nope; END_STRUCT; END_TYPE PROGRAM Main VAR n : INT; s : S := (a := 1); END_VAR n := s.a; END_PROGRAM",
    "an input": "FUNCTION_BLOCK B VAR_INPUT a : Nope; END_VAR END_FUNCTION_BLOCK PROGRAM Main VAR b : B; END_VAR b(a := 1); b.a := 2; END_PROGRAM",
}


@pytest.mark.parametrize("what", BROKEN)
def test_an_unknown_type_is_told_once(what: str) -> None:
    assert told(BROKEN[what]) == ["There is no type `Nope`."]


@pytest.mark.parametrize("type", ["BOOL", "INT", "REAL", "LREAL", "STRING", "TIME"])
def test_a_constant_that_was_refused_has_no_value(type: str) -> None:
    messages = told(
        f"PROGRAM Main VAR CONSTANT n : {type} := z; END_VAR VAR r : {type} := n; a : ARRAY[1..n] OF INT; END_VAR r := n; END_PROGRAM"
    )
    assert messages == ["`z` is not declared."]


@pytest.mark.parametrize(
    "call", ["n := 2 * F();", "n := -F();", "a[F()] := 1;", "n := MIN(n, F());", "IF NOT F() THEN END_IF"]
)
def test_a_function_without_a_result_has_no_value(call: str) -> None:
    messages = told(
        f"FUNCTION F END_FUNCTION PROGRAM Main VAR n : INT; a : ARRAY[0..1] OF INT; END_VAR {call} END_PROGRAM"
    )
    assert messages == ["`F` has no result; call it as a statement."]


@pytest.mark.parametrize("bounds", ["0..9223372036854775807", "0..4294967295, 0..4294967295", "0..99999999999"])
@pytest.mark.parametrize("element", ["Empty", "Nothing", "INT"])
def test_arrays_have_an_end(bounds: str, element: str) -> None:
    messages = told(
        "TYPE Nothing : STRUCT END_STRUCT; END_TYPE FUNCTION_BLOCK Empty END_FUNCTION_BLOCK "
        f"PROGRAM Main VAR a : ARRAY[{bounds}] OF {element}; END_VAR END_PROGRAM"
    )
    assert len(messages) == 1
    assert "; at most 67108864." in messages[0]


def test_arrays_of_nothing_have_initial_values() -> None:
    messages = told(
        "TYPE E : STRUCT END_STRUCT; END_TYPE PROGRAM Main VAR a : ARRAY[0..2] OF E := [1]; END_VAR END_PROGRAM"
    )
    assert messages == ["An initial value of E is written like (member := value)."]


USES = """PROGRAM Main VAR s : STRING; d : DT; ld : LDT; t : TIME; c : CTU; r : REAL; END_VAR
s := TIME_TO_STRING(t); s := DT_TO_STRING(d); s := REAL_TO_STRING(r); ld := DT_TO_LDT(d); s := TO_STRING(d); s := REPLACE(s, s, 1, 2);
d := CONCAT_DATE_TOD(DATE#2000-01-01, TOD#00:00:00); s := TOD_TO_STRING(TOD#00:00:00); s := INSERT(s, s, 3); c(); END_PROGRAM"""


def test_the_library_means_its_own_functions() -> None:
    """Whatever the user's PROGRAMs are called."""
    programs = "\n".join(f"PROGRAM {name} END_PROGRAM" for name in FUNCTIONS if name not in USES)
    problems = check_sources({"a.st": USES, "b.st": programs}, MODELS["GENERIC-IEC"]).problems
    assert {each.span.file for each in problems} <= {"a.st", "b.st"}


def test_names_that_were_perhaps_meant_are_found_among_many(monkeypatch: pytest.MonkeyPatch) -> None:
    """Few of thousands are compared letter by letter, and the nearest is among them."""
    compared = 0

    def counted(word: str, possibilities: list[str], n: int, cutoff: float) -> list[str]:
        nonlocal compared
        compared += len(possibilities)
        return get_close_matches(word, possibilities, n=n, cutoff=cutoff)

    monkeypatch.setattr("scanbench.check.context.get_close_matches", counted)
    known = [f"GVL_Conveyor_{number:04}_Speed" for number in range(2000)]
    report = context.Report()
    for _ in range(50):
        assert "`GVL_Conveyor_1234_Speed`" in report.near("GVL_Conveyer_1234_Sped", lambda: known)
    assert compared == context.COMPARED, "and the same name once only"


def test_only_the_first_of_thousands_of_unknown_names_are_compared() -> None:
    known = [f"GVL_Conveyor_{number:04}_Speed" for number in range(2000)]
    report = context.Report()
    found = [report.near(f"GVL_Conveyer_{number:04}_Sped", lambda: known) for number in range(5000)]
    assert all(found[:20])
    assert not any(found[100:])
    assert report.compared < context.MOST_COMPARED + len(known) + context.LETTERS


def test_a_name_that_is_not_known_is_reported_three_times_in_a_pou() -> None:
    """It is one mistake, however often the name is used; in each POU, as each can be seen by itself."""
    uses = "x := Missing;\n" * 50 + "x := Lost(1);\n" * 50
    text = f"FUNCTION_BLOCK A\nVAR x : INT; END_VAR\n{uses}END_FUNCTION_BLOCK\nPROGRAM Main\nVAR x : INT; END_VAR\n{uses}x := Other;\nEND_PROGRAM\n"
    found = [each.message for each in check_sources({"a.st": text}, MODELS["GENERIC-IEC"]).problems]
    assert [sum(name in each for each in found) for name in ("`Missing`", "`Lost`", "`Other`")] == [6, 6, 1]


def test_names_that_every_pou_knows_are_looked_at_once() -> None:
    known = [f"GVL_Hopper_{number}_Level" for number in range(500)]
    context._pairs.cache_clear()
    for pou in range(5):
        assert context.did_you_mean("GVL_Hoper_77_Level", [*known, f"local_{pou}"]).startswith(
            " Did you mean `GVL_Hopper_7"
        )
    assert context._pairs.cache_info().misses == 500 + 5 + 1
