"""Reactions: who read an error, what differed, and how exact the comparison is."""

import pytest

from scanbench.engines.observe import MakeObserved
from scanbench.faults.inject import Generate, Recover
from scanbench.faults.reaction.reaction import Carried, Reaction, Reader, Unreached
from scanbench.runtime.command import Command, Refusal
from scanbench.runtime.forces import Force
from scanbench.runtime.modes import SetMode
from scanbench.runtime.restart import Restart
from scanbench.runtime.write import Write
from tests.faults.reacting import MAKES, attempt, checked, reaction, ref
from tests.runtime.bench import model

MODELS = ("GENERIC-IEC", "Q03UD", "CJ1M-CPU63", "CJ2M-CPU33", "CP1H-XA40D", "CS1D-CPU65H", "CS1G-CPU44H", "NJ501-1300")

# Each line is named by what the program does about one error.
HANDLERS = """
FUNCTION_BLOCK Copy
VAR_INPUT seen : BOOL; END_VAR
VAR_OUTPUT n : INT; END_VAR
  n := n + 1;
END_FUNCTION_BLOCK

PROGRAM Main
VAR
  battery AT A402.04 : BOOL; basic AT A402.12 : BOOL; inner AT A402.08 : BOOL; bus AT A402.07 : BOOL;
  special AT A402.06 : BOOL; code AT A400 : WORD; lamp AT CIO 100.01 : BOOL; warning AT CIO 100.02 : BOOL;
  copy : Copy; wait : TON; late : BOOL; trips, n : DINT;
END_VAR
VAR_TEMP nothing : BOOL; END_VAR
  n := n + 1;
  IF basic THEN
    lamp := TRUE;
    trips := trips + 1;
  END_IF;
  IF inner THEN
    nothing := TRUE;
  END_IF;
  copy(seen := bus);
  wait(IN := special, PT := T#100ms);
  late := wait.Q;
  warning := late;
END_PROGRAM
"""


@pytest.fixture(params=MAKES)
def make(request: pytest.FixtureRequest) -> MakeObserved:
    return MAKES[request.param]


def line(text: str, source: str = HANDLERS) -> int:
    """The number of the one line with this text."""
    found = [number for number, each in enumerate(source.splitlines(), 1) if text in each]
    assert len(found) == 1, found
    return found[0]


def differing(found: Reaction) -> dict[str, tuple[str, str, bool, int]]:
    return {each.path: (each.without, each.value, each.output, each.scan) for each in found.differences}


def lines(found: Reaction) -> list[int]:
    return [each.line for each in found.lines]


def test_a_handler_is_a_reaction_with_reader_lines_and_output(make: MakeObserved) -> None:
    found = reaction(HANDLERS, "basic-io-error", make)
    assert found.verdict == "acted"
    assert (found.first_read, found.first_effect, found.window, found.note) == (1, 1, 50, "")
    assert found.readers == (Reader("main.st", line("IF basic"), "Main", "flag", 1),)
    assert lines(found) == [line("lamp := TRUE"), line("trips := trips + 1")]
    assert found.differences[0].path == "Main.lamp"  # outputs come first
    assert differing(found) == {"Main.lamp": ("FALSE", "TRUE", True, 1), "Main.trips": ("0", "1", False, 1)}
    assert found.difference_count == 2


def test_a_forgotten_error_is_never_read(make: MakeObserved) -> None:
    assert reaction(HANDLERS, "battery-error", make) == Reaction("never_read", 50, basis="exact")


def test_read_in_vain(make: MakeObserved) -> None:
    found = reaction(HANDLERS, "inner-board-error", make)
    assert (found.verdict, found.first_effect, found.difference_count) == ("no_effect", None, 0)
    assert [each.line for each in found.readers] == [line("IF inner")]
    assert lines(found) == [line("nothing := TRUE")]  # reached, but a temporary is nothing that stays


def test_an_input_of_a_block_is_only_passed_on(make: MakeObserved) -> None:
    found = reaction(HANDLERS, "cpu-bus-unit-error", make)
    assert (found.verdict, found.differences) == ("no_effect", ())
    assert [(each.line, each.what) for each in found.readers] == [(line("copy(seen"), "flag")]


def test_a_late_reaction_counts_from_its_first_effect(make: MakeObserved) -> None:
    found = reaction(HANDLERS, "special-io-unit-error", make)
    assert (found.verdict, found.first_read) == ("acted", 1)
    assert differing(found)["Main.late"] == ("FALSE", "TRUE", False, 11)
    assert differing(found)["Main.wait.Q"] == ("FALSE", "TRUE", False, 11)
    assert differing(found)["Main.wait.ET"][3] < 11
    assert found.first_effect == 11  # that the timer began decides nothing


CODE = """
PROGRAM Main
VAR code AT A400 : WORD; hit AT CIO 100 : INT; n : INT; END_VAR
  n := n + 1;
  IF code = 16#00F7 THEN hit := hit + 1; END_IF;
END_PROGRAM
"""


def test_who_compares_the_code_word_reads_every_error_and_reacts_to_one(make: MakeObserved) -> None:
    hit, other = reaction(CODE, "battery-error", make), reaction(CODE, "basic-io-error", make)
    assert (hit.verdict, [each.what for each in hit.readers], list(differing(hit))) == (
        "acted",
        ["code"],
        ["Main.hit"],
    )
    assert (other.verdict, [each.what for each in other.readers]) == ("no_effect", ["code"])


def test_a_code_that_a_more_serious_error_hides_is_not_read(make: MakeObserved) -> None:
    program = checked({"main.st": CODE})
    first, second = sorted(
        (each for each in model().errors() if each.severity == "nonfatal" and each.id in ("battery-error", "basic-io-error")),
        key=lambda each: each.priority,
    )  # fmt: skip
    hides = (Generate("Ada", (ref(first.id),)),)
    hidden = attempt(program, (second.id,), make, before=hides)
    where = f"main.st:{line('IF code', CODE)}"
    note = (
        f"the error code was that of a more serious error where the program read it: {where}; "
        f"{first.id}:rack=0,slot=0 was present before: what follows from both is no difference"
    )
    assert hidden == Reaction("never_read", 50, note=note, basis="exact")


def test_a_condition_that_another_one_made_needless_names_its_own_statement(make: MakeObserved) -> None:
    source = """
PROGRAM Main
VAR lamp AT CIO 100.00 : BOOL; horn AT CIO 100.01 : BOOL; basic AT A402.12 : BOOL; battery AT A402.04 : BOOL; END_VAR
  IF basic THEN lamp := TRUE; ELSIF battery THEN horn := TRUE; END_IF;
END_PROGRAM
"""
    found = reaction(source, "battery-error", make, before=(Generate("Ada", (ref("basic-io-error"),)),))
    here = line("IF basic", source)
    assert found.verdict == "not_reached"
    assert [(each.line, each.why, each.at) for each in found.unreached] == [(here, "condition", f"main.st:{here}")]


def test_reading_after_it_was_recovered_is_not_reading_it(make: MakeObserved) -> None:
    source = """
PROGRAM Main
VAR battery AT A402.04 : BOOL; seen AT CIO 100 : INT; n : INT; END_VAR
  n := n + 1;
  IF n > 20 THEN IF battery THEN seen := 1; END_IF; END_IF;
END_PROGRAM
"""
    program = checked({"main.st": source})
    kept = attempt(program, ("battery-error",), make)
    assert isinstance(kept, Reaction)
    assert (kept.verdict, kept.first_read, kept.first_effect) == ("acted", 11, 11)
    gone = attempt(program, ("battery-error",), make, later=((5, Recover("Ada", ("battery-error",))),))
    assert gone == Reaction("never_read", 50, basis="exact")


def test_a_fatal_error_stops_the_plc(make: MakeObserved) -> None:
    assert reaction(HANDLERS, "memory-error", make) == Reaction("stopped", 0, basis="exact")


def test_a_program_that_traps_because_of_it_reacted(make: MakeObserved) -> None:
    source = """
PROGRAM Main
VAR battery AT A402.04 : BOOL; lamp AT CIO 100.00 : BOOL; n, d : INT := 1; END_VAR
  lamp := TRUE;
  IF battery THEN d := 0; END_IF;
  n := n / d;
END_PROGRAM
"""
    found = reaction(source, "battery-error", make)
    assert (found.verdict, found.window, found.first_effect) == ("acted", 1, 1)
    assert found.note.startswith("the program stopped with it: main.st:6")
    assert differing(found)["Main.lamp"] == ("TRUE", "FALSE", True, 1)


def test_a_program_that_traps_anyway_is_compared_up_to_there(make: MakeObserved) -> None:
    source = """
PROGRAM Main
VAR n : INT; END_VAR
  n := n + 1 + 0 / (30 - n);
END_PROGRAM
"""
    found = reaction(source, "battery-error", make)
    assert (found.verdict, found.window) == ("never_read", 21)  # with the scan that trapped
    assert found.note.startswith("the program stops without it too")


def test_details_are_read_too(make: MakeObserved) -> None:
    source = """
PROGRAM Main
VAR units AT A417 : WORD; unit AT CIO 100 : WORD; n : INT; END_VAR
  n := n + 1;
  unit := units;
END_PROGRAM
"""
    program = checked({"main.st": source})
    entry = program.layout.model.error("cpu-bus-unit-error")
    assert entry is not None
    assert entry.details
    found = attempt(program, (f"cpu-bus-unit-error:{entry.details[0].name}=3",), make)
    assert isinstance(found, Reaction)
    assert (found.verdict, [each.what for each in found.readers]) == ("acted", ["detail"])
    assert differing(found) == {"Main.unit": ("16#0000", "16#0008", True, 1)}


def test_a_reaction_may_be_an_error_of_the_program(make: MakeObserved) -> None:
    source = """
PROGRAM Main
VAR battery AT A402.04 : BOOL; ok : BOOL; END_VAR
  IF battery THEN ok := FAL(N := 7); END_IF;
END_PROGRAM
"""
    found = reaction(source, "battery-error", make)
    assert (found.verdict, found.first_effect) == ("acted", 1)
    assert "A402.15" in differing(found)


def test_what_the_program_raises_anyway_is_no_difference(make: MakeObserved) -> None:
    """FAL enters the journal by itself, in both runs; the log has a record more with the error, and is error memory."""
    source = """
PROGRAM Main
VAR n : INT; ok : BOOL; END_VAR
  n := n + 1;
  IF n MOD 20 = 0 THEN ok := FAL(N := INT_TO_LINT(n / 20)); END_IF;
END_PROGRAM
"""
    assert reaction(source, "battery-error", make, 100) == Reaction("never_read", 100, basis="exact")


def test_a_task_that_runs_less_often_reacts_when_its_turn_comes(make: MakeObserved) -> None:
    source = """
PROGRAM Fast
VAR n : INT; END_VAR
  n := n + 1;
END_PROGRAM
PROGRAM Slow
VAR battery AT A402.04 : BOOL; lamp AT CIO 100.00 : BOOL; END_VAR
  lamp := battery;
END_PROGRAM
CONFIGURATION C
  RESOURCE R ON PLC
    TASK Often(INTERVAL := T#10ms, PRIORITY := 1);
    TASK Seldom(INTERVAL := T#80ms, PRIORITY := 2);
    PROGRAM Fast WITH Often : Fast;
    PROGRAM Slow WITH Seldom : Slow;
  END_RESOURCE
END_CONFIGURATION
"""
    found = reaction(source, "battery-error", make)  # raised before scan 10; Seldom runs in scan 16
    assert (found.first_read, found.first_effect) == (7, 7)
    assert list(differing(found)) == ["Slow.lamp"]


def test_differences_are_named_by_variable_and_else_by_address(make: MakeObserved) -> None:
    source = """
PROGRAM Main
VAR battery AT A402.04 : BOOL; far : DINT; big : ARRAY[1..3] OF LREAL; text : STRING; words AT D10 : ARRAY[0..3] OF WORD; END_VAR
  IF battery THEN far := far * 3 + 300; big[2] := big[2] + 1.5; text := 'alarm'; words[2] := 7; END_IF;
  %QW5 := DINT_TO_WORD(far); %MX9.3 := battery;
END_PROGRAM
"""
    found = reaction(source, "battery-error", make, 200)
    assert differing(found) == {
        "CIO105": ("16#0000", "16#012C", True, 1),
        "Main.far": ("0", "300", False, 1),
        "Main.big[2]": ("0.0", "1.5", False, 1),
        "Main.text": ("''", "'alarm'", False, 1),
        "Main.words[2]": ("16#0000", "16#0007", False, 1),
        "W4.11": ("FALSE", "TRUE", False, 1),
    }


# ---- the twin ------------------------------------------------------------------------------------------------------

BUSY = """
PROGRAM Main
VAR n : DINT; t : TON; c : CTU; r : LREAL; a : ARRAY[0..9] OF INT; s : STRING; now : TIME; END_VAR
  n := n + 1; r := SIN(r + 0.1); a[n MOD 10] := a[n MOD 10] + DINT_TO_INT(n);
  t(IN := NOT t.Q, PT := T#70ms); c(CU := t.Q, PV := 3, R := c.Q);
  now := TIME(); s := CONCAT('n', DINT_TO_STRING(n));
END_PROGRAM
"""


@pytest.mark.parametrize("name", MODELS)
def test_an_error_that_nobody_handles_makes_no_difference(name: str) -> None:
    """For every error of the model: to the bit, whatever the program computes and whatever the model writes by itself."""
    program = checked({"main.st": BUSY}, name)
    errors = [each.id for each in model(name).errors() if each.severity == "nonfatal"]
    assert errors
    for id in errors:
        assert attempt(program, (id,), MAKES["native"], 30) == Reaction("never_read", 30, basis="exact"), id


@pytest.mark.parametrize("name", MODELS)
def test_every_fatal_error_stops_the_plc(name: str) -> None:
    program = checked({"main.st": BUSY}, name)
    for each in model(name).errors():
        standby = model(name).standby
        if each.severity == "fatal" and not (standby is not None and standby.takes_over_for(each.id)):
            assert attempt(program, (each.id,), MAKES["native"], 30) == Reaction("stopped", 0, basis="exact"), each.id


@pytest.mark.parametrize(
    "later",
    [
        ((3, Write("Ada", "Main.n", "100")), (3, Write("Bob", "D5", "7"))),
        ((0, Force("Ada", "CIO 100.03", "TRUE")),),
        ((4, Generate("Bob", (ref("basic-io-error"),))), (9, Recover("Bob", ("basic-io-error",)))),
        ((2, Recover("Ada", ("battery-error",))), (6, Generate("Ada", (ref("battery-error"),)))),
        ((5, Recover("Ada", None)),),
        ((5, SetMode("Ada", "PROGRAM")), (9, SetMode("Ada", "MONITOR"))),
    ],
)
def test_both_runs_get_what_came_from_outside(later: tuple[tuple[int, Command], ...], make: MakeObserved) -> None:
    found = attempt(checked({"main.st": BUSY}), ("battery-error",), make, 20, later)
    assert found == Reaction("never_read", 20, basis="exact")


def test_errors_of_one_batch_do_not_hide_each_other(make: MakeObserved) -> None:
    """Both switch the same lamp on: each is compared as if it had been raised alone."""
    source = """
PROGRAM Main
VAR lamp AT CIO 100.00 : BOOL; basic AT A402.12 : BOOL; bus AT A402.07 : BOOL; END_VAR
  IF basic OR bus THEN lamp := TRUE; END_IF;
END_PROGRAM
"""
    program = checked({"main.st": source})
    batch = ("basic-io-error", "cpu-bus-unit-error", "battery-error")
    recovered = ((20, Recover("Ada", None)),)
    for first in range(2):
        found = attempt(program, (*batch[first:], *batch[:first]), make, later=recovered)
        assert isinstance(found, Reaction)
        assert (found.verdict, found.first_effect) == ("acted", 1)
        assert set(differing(found)) == {"Main.lamp"}
        assert "raised together with" in found.note
    found = attempt(program, (batch[2], *batch[:2]), make)
    assert isinstance(found, Reaction)
    assert (found.verdict, found.differences) == ("never_read", ())


def test_an_error_that_was_there_before_is_named(make: MakeObserved) -> None:
    """What it switched on already is no difference."""
    found = reaction(HANDLERS, "battery-error", make, before=(Generate("Ada", (ref("basic-io-error"),)),))
    assert found.verdict == "never_read"
    assert "basic-io-error:rack=0,slot=0 was present before" in found.note


def test_a_write_that_only_the_error_makes_possible_is_no_excuse(make: MakeObserved) -> None:
    """A write of both runs that the program overwrites with the error only: an effect, in the scan in which it is one."""
    source = """
PROGRAM Main
VAR battery AT A402.04 : BOOL; x AT CIO 100 : INT; END_VAR
  IF battery THEN x := 0; END_IF;
END_PROGRAM
"""
    found = attempt(checked({"main.st": source}), ("battery-error",), make, 20, ((4, Write("Ada", "Main.x", "5")),))
    assert isinstance(found, Reaction)
    assert (found.verdict, found.first_read, found.first_effect) == ("acted", 1, 5)


def test_a_window_without_end_is_cut_where_memory_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("scanbench.faults.reaction.react.TRACE_LIMIT", 4_000)
    found = attempt(checked({"main.st": BUSY}), ("battery-error",), MAKES["native"], 200)
    assert isinstance(found, Reaction)
    assert found.verdict == "never_read"
    assert 5 < found.window < 200
    assert found.note == f"only {found.window} scans were compared: the program changes too much memory for more"


@pytest.mark.parametrize("command", [Restart("Ada", "cold"), Restart("Ada", "warm")])
def test_a_restart_ends_the_window(command: Command, make: MakeObserved) -> None:
    found = attempt(checked({"main.st": BUSY}), ("battery-error",), make, 20, ((7, command),))
    assert found == Reaction("never_read", 7, note="the program was restarted", basis="exact")


def test_a_plc_that_does_not_run_says_so(make: MakeObserved) -> None:
    found = attempt(checked({"main.st": BUSY}), ("battery-error",), make, 20, before=(SetMode("Ada", "PROGRAM"),))
    assert isinstance(found, Refusal)
    assert "did not run" in found.message


# ---- blocks of the library -----------------------------------------------------------------------------------------


def handling(variables: str, body: str) -> str:
    return f"""
PROGRAM Main
VAR battery AT A402.04 : BOOL; lamp AT CIO 100.00 : BOOL; go : BOOL; {variables} END_VAR
{body}
END_PROGRAM
"""


def test_a_timer_within_the_window_counts_from_its_output(make: MakeObserved) -> None:
    source = handling(
        "t : TON; n : INT;", "t(IN := battery, PT := T#100ms); IF t.Q THEN n := n + 1; END_IF; lamp := n > 0;"
    )
    found = reaction(source, "battery-error", make)
    assert (found.verdict, found.first_effect, found.note) == ("acted", 11, "")
    assert set(differing(found)) == {"Main.lamp", "Main.t.Q", "Main.t.ET", "Main.n"}


@pytest.mark.parametrize(
    "body", ["t(IN := battery, PT := T#5s);", "r(CLK := battery); s(CLK := go); lamp := s.Q;", "c(CU := battery, PV := 3);"]
)  # fmt: skip
def test_a_block_whose_outputs_nobody_reads_only_stores(body: str, make: MakeObserved) -> None:
    """Whatever is read of another of its type."""
    found = reaction(handling("t : TON; r, s : R_TRIG; c : CTU;", body), "battery-error", make)
    assert (found.verdict, found.first_effect, found.note) == ("stored", None, "")


# ---- tasks ---------------------------------------------------------------------------------------------------------

TASKS = """
PROGRAM Fast
VAR n : INT; END_VAR
  n := n + 1;
END_PROGRAM
PROGRAM Alarm
VAR_EXTERNAL battery : BOOL; lamp : BOOL; END_VAR
VAR_TEMP x : BOOL; END_VAR
  {body}
END_PROGRAM
CONFIGURATION C
  VAR_GLOBAL battery AT A402.04 : BOOL; lamp AT CIO 100.00 : BOOL; END_VAR
  RESOURCE R ON PLC
    TASK Often(INTERVAL := T#10ms, PRIORITY := 1);
    TASK Alarming({when}, PRIORITY := 0);
    PROGRAM Fast WITH Often : Fast;
    PROGRAM Alarm WITH Alarming : Alarm;
  END_RESOURCE
END_CONFIGURATION
"""
NO_TURN = "task Alarming (every 5s) did not run in the 50 scans: a longer window would tell"


def test_a_task_that_had_no_turn_is_told(make: MakeObserved) -> None:
    source = TASKS.format(body="lamp := battery;", when="INTERVAL := T#5s")
    missed = Unreached("main.st", line("lamp := battery", source), ("Alarm",), "task", "Alarming")
    assert reaction(source, "battery-error", make) == Reaction(
        "not_reached", 50, note=NO_TURN, basis="static", unreached=(missed,)
    )
    assert reaction(source, "battery-error", make, 500).note == ""


def test_a_task_without_a_turn_is_not_reported_where_a_second_one_reacted(make: MakeObserved) -> None:
    source = TASKS.format(body="lamp := battery;", when="INTERVAL := T#5s")
    source = source.replace("n := n + 1;", "n := n + 1; IF warn THEN n := 0; END_IF;")
    source = source.replace(
        "VAR n : INT;", "VAR_EXTERNAL battery : BOOL; END_VAR VAR n AT CIO 101 : INT; warn AT A402.04 : BOOL;"
    )
    found = reaction(source, "battery-error", make)
    assert (found.verdict, found.note) == ("acted", "")


@pytest.mark.parametrize(("body", "verdict"), [("lamp := TRUE;", "acted"), ("x := TRUE;", "no_effect")])
def test_a_task_that_the_flag_starts_reads_it(body: str, verdict: str, make: MakeObserved) -> None:
    source = TASKS.format(body=body, when="SINGLE := battery")
    found = reaction(source, "battery-error", make)
    assert (found.verdict, found.first_read) == (verdict, 1)
    assert found.readers == (Reader("main.st", line("SINGLE", source), "Alarming", "flag", 1),)
    assert lines(found) == [line(body, source)]


# ---- what the program does about the error itself ------------------------------------------------------------------


def test_a_program_that_recovers_the_error_reacted(make: MakeObserved) -> None:
    source = """
PROGRAM Main
VAR fal AT A402.15 : BOOL; n : INT; ok : BOOL := TRUE; END_VAR
  n := n + 1;
  IF fal AND n > 14 THEN FAL(N := 0); END_IF;
END_PROGRAM
"""
    found = reaction(source, "fal", make)
    assert (found.verdict, found.first_effect, found.differences) == ("acted", 5, ())
    assert found.note == "the program recovered it itself, after 5 scans"
    assert lines(found) == [line("FAL(N", source)]


def test_a_program_that_recovers_it_by_the_models_reset_bit_reacted(make: MakeObserved) -> None:
    source = "PROGRAM Main\n  IF SM1 THEN SD50 := 1500; SM50 := TRUE; END_IF;\nEND_PROGRAM\n"
    found = attempt(checked({"main.st": source}, "Q03UD"), ("ac-dc-down",), make)
    assert isinstance(found, Reaction)
    assert (found.verdict, found.first_effect) == ("acted", 1)
    assert found.note == "the program recovered it itself, after 2 scans"


def test_a_clear_in_vain_is_no_effect(make: MakeObserved) -> None:
    """The cause of a battery error lasts; another line that ran is not by itself a reaction."""
    found = reaction(handling("", "IF battery THEN FAL(N := 0, M := 16#FFFF); END_IF;"), "battery-error", make)
    assert (found.verdict, len(found.lines), found.note) == ("no_effect", 1, "")


def test_what_somebody_recovers_is_not_the_programs_doing(make: MakeObserved) -> None:
    recover = ((5, Recover("program", ("battery-error",))),)
    assert attempt(checked({"main.st": BUSY}), ("battery-error",), make, 20, recover) == Reaction(
        "never_read", 20, basis="exact"
    )


# ---- traps of the run without the error ----------------------------------------------------------------------------


def trapping(when: str) -> str:
    return f"""
PROGRAM Main
VAR battery AT A402.04 : BOOL; n, zero, x : INT; END_VAR
  n := n + 1;
  IF {when} THEN x := 1 / zero; END_IF;
END_PROGRAM
"""


def test_an_error_that_keeps_the_program_from_a_trap_has_an_effect(make: MakeObserved) -> None:
    found = reaction(trapping("n = 20 AND NOT battery"), "battery-error", make)
    assert (found.verdict, found.window, found.first_effect) == ("acted", 10, 10)
    assert found.note.startswith("the program goes on with it, and stops without it: main.st:5")
    assert differing(found)["A401.09"] == ("TRUE", "FALSE", False, 10)


def test_a_trap_in_the_first_scan_anyway(make: MakeObserved) -> None:
    found = reaction(trapping("n = 11"), "battery-error", make)
    assert (found.verdict, found.window) == ("never_read", 1)
    assert found.note.startswith("the program stops without it too: main.st:5")


def test_a_trap_somewhere_else(make: MakeObserved) -> None:
    source = trapping("n = 20 AND battery").replace("END_IF;", "END_IF;\n  x := 1 / (n - 20);")
    found = reaction(source, "battery-error", make)
    assert (found.verdict, found.first_effect) == ("acted", 10)
    assert found.note.startswith("the program stopped with it: main.st:5")
    assert "; and without it: main.st:6" in found.note


# ---- the log -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("address", ["A300", "A100", "A199"])
def test_who_reads_the_error_log_reads_the_error(address: str, make: MakeObserved) -> None:
    source = handling(f"entry AT {address} : WORD; END_VAR VAR_TEMP x : WORD;", "x := entry;")
    found = reaction(source, "battery-error", make)
    assert (found.verdict, [each.what for each in found.readers]) == ("no_effect", ["log"])


def test_the_log_still_tells_of_an_error_that_was_recovered(make: MakeObserved) -> None:
    body = "n := n + 1; IF n > 20 THEN IF count <> 0 THEN seen := 1; END_IF; END_IF;"
    source = handling("count AT A300 : WORD; seen AT CIO 101 : INT; n : INT;", body)
    recover = ((5, Recover("Ada", ("battery-error",))),)
    found = attempt(checked({"main.st": source}), ("battery-error",), make, later=recover)
    assert isinstance(found, Reaction)
    assert (found.verdict, found.first_read, [each.what for each in found.readers]) == ("acted", 11, ["log"])


# ---- what only stores ----------------------------------------------------------------------------------------------

OWN = "code AT A400 : WORD; entries AT A300 : WORD; "


@pytest.mark.parametrize(
    ("variables", "body"),
    [
        ("d, last : WORD; d1 : BOOL;", "d := code; d1 := battery; last := entries;"),
        ("d : WORD;", "d := code; lamp := d = 16#009A;"),
        ("old, new : BOOL;", "new := battery AND NOT old; old := battery; IF new AND go THEN lamp := TRUE; END_IF;"),
        ("old : WORD;", "IF code <> old THEN old := code; IF code = 16#009A THEN lamp := TRUE; END_IF; END_IF;"),
        ("r : R_TRIG; f : F_TRIG; n : INT;", "r(CLK := battery); f(CLK := battery); IF r.Q THEN n := n + 1; END_IF;"),
        ("cnt : INT;", "IF battery THEN cnt := cnt + 1; END_IF;"),
        ("cnt : INT; many : BOOL;", "IF battery THEN cnt := cnt + 1; END_IF; IF cnt > 3 THEN many := TRUE; END_IF;"),
    ],
    ids=("copies", "compared", "edge", "edge of the code", "triggers", "counter", "chain"),
)  # fmt: skip
@pytest.mark.parametrize("where", ["PROGRAM", "FUNCTION_BLOCK"])
def test_what_decides_nothing_is_only_stored(variables: str, body: str, where: str, make: MakeObserved) -> None:
    source = handling(OWN + variables, body)
    if where == "FUNCTION_BLOCK":
        source = source.replace("PROGRAM Main", "FUNCTION_BLOCK Part").replace("END_PROGRAM", "END_FUNCTION_BLOCK")
        source += "PROGRAM Main\nVAR part : Part; END_VAR\n  part();\nEND_PROGRAM\n"
    found = reaction(source, "battery-error", make)
    assert (found.verdict, found.first_effect) == ("stored", None)
    assert found.readers
    assert found.differences


@pytest.mark.parametrize(
    ("variables", "body"),
    [
        ("run, fault : BOOL;", "fault := fault OR battery; lamp := run AND NOT fault;"),
        ("run, fault : BOOL;", "IF NOT fault THEN fault := battery; END_IF; lamp := run AND NOT fault;"),
        ("run : BOOL; fault : SR;", "fault(S1 := battery); lamp := run AND NOT fault.Q1;"),
    ],
    ids=("latch by or", "latch by a copy", "latch of the library"),
)
def test_state_that_decides_an_output_later_is_named(variables: str, body: str, make: MakeObserved) -> None:
    source = handling(variables, body)
    found = reaction(source, "battery-error", make)
    assert (found.verdict, found.first_effect, found.basis) == ("decided", None, "static")
    assert found.carried == (Carried("Main.fault", 1, (f"main.st:{line(body, source)}",)),)


def test_a_reaction_counts_to_the_output_that_a_counter_ends_in(make: MakeObserved) -> None:
    body = "IF battery THEN cnt := cnt + 1; END_IF; IF cnt > 500 THEN lamp := TRUE; END_IF;"
    found = reaction(handling("cnt : INT;", body), "battery-error", make, 600)
    assert (found.verdict, found.first_effect, found.note) == ("acted", 501, "")


# ---- what is not reached -------------------------------------------------------------------------------------------


def test_a_read_now_and_then_is_not_never(make: MakeObserved) -> None:
    body = "n := n + 1;\nIF n MOD 500 = 499 THEN\nlamp := battery;\nEND_IF;"
    source = handling("n : INT;", body)
    found = reaction(source, "battery-error", make)
    read = line("lamp := battery", source)
    missed = Unreached("main.st", read, ("Main",), "condition", f"main.st:{read - 1}")
    assert found == Reaction("not_reached", 50, basis="static", unreached=(missed,))
    assert reaction(source, "battery-error", make, 600).verdict == "acted"
    assert reaction(source, "basic-io-error", make).verdict == "never_read"


def test_a_copy_beside_it_does_not_hide_what_was_not_reached(make: MakeObserved) -> None:
    body = "copy := battery;\nn := n + 1;\nIF n MOD 500 = 499 THEN\nlamp := battery;\nEND_IF;"
    source = handling("n : INT; copy : BOOL;", body)
    found = reaction(source, "battery-error", make)
    assert found.verdict == "not_reached"
    assert [each.line for each in found.unreached] == [line("lamp := battery", source)]
    assert [each.line for each in found.readers] == [line("copy := battery", source)]


def test_what_is_not_reached_is_named_with_its_instances(make: MakeObserved) -> None:
    source = """
FUNCTION_BLOCK Part
VAR_IN_OUT state : WORD; END_VAR
VAR_EXTERNAL battery : BOOL; END_VAR
VAR seen, flag : BOOL; n : INT; END_VAR
  n := n + 1;
  IF n > 1000 THEN
    seen := battery;
  END_IF;
END_FUNCTION_BLOCK
PROGRAM Main
VAR one, two : Part; many : ARRAY[1..5] OF Part; w : WORD; END_VAR
  one(state := w); two(state := w); many[2](state := w);
END_PROGRAM
CONFIGURATION C
  VAR_GLOBAL battery AT A402.04 : BOOL; END_VAR
  RESOURCE R ON PLC
    TASK T(INTERVAL := T#10ms, PRIORITY := 1);
    PROGRAM Main WITH T : Main;
  END_RESOURCE
END_CONFIGURATION
"""
    found = reaction(source, "battery-error", make)
    assert found.verdict == "not_reached"
    (missed,) = found.unreached
    assert (missed.line, missed.paths[:3], len(missed.paths)) == (
        line("seen := battery", source), ("Main.one", "Main.two", "Main.many[1]"), 7,
    )  # fmt: skip
