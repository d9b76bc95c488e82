"""Reactions: who read an error, what differed, and how exact the comparison is."""

import pytest

from scanbench.engines.observe import MakeObserved
from scanbench.faults.inject import Generate, Recover
from scanbench.faults.reaction import Reaction, Reader
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
  special AT A402.06 : BOOL; code AT A400 : WORD; lamp AT CIO 100.01 : BOOL;
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
    assert found.verdict == "reacted"
    assert (found.first_read, found.first_effect, found.window, found.note) == (1, 1, 50, "")
    assert found.readers == (Reader("main.st", line("IF basic"), "Main", "flag", 1),)
    assert lines(found) == [line("lamp := TRUE"), line("trips := trips + 1")]
    assert found.differences[0].path == "Main.lamp"  # outputs come first
    assert differing(found) == {"Main.lamp": ("FALSE", "TRUE", True, 1), "Main.trips": ("0", "1", False, 1)}
    assert found.difference_count == 2


def test_a_forgotten_error_is_never_read(make: MakeObserved) -> None:
    assert reaction(HANDLERS, "battery-error", make) == Reaction("never_read", 50)


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
    assert (found.verdict, found.first_read) == ("reacted", 1)
    assert differing(found)["Main.late"] == ("FALSE", "TRUE", False, 11)
    assert differing(found)["Main.wait.Q"] == ("FALSE", "TRUE", False, 11)
    assert found.first_effect == 11  # that the timer began is seen by nobody


CODE = """
PROGRAM Main
VAR code AT A400 : WORD; hit, n : INT; END_VAR
  n := n + 1;
  IF code = 16#00F7 THEN hit := hit + 1; END_IF;
END_PROGRAM
"""


def test_who_compares_the_code_word_reads_every_error_and_reacts_to_one(make: MakeObserved) -> None:
    hit, other = reaction(CODE, "battery-error", make), reaction(CODE, "basic-io-error", make)
    assert (hit.verdict, [each.what for each in hit.readers], list(differing(hit))) == (
        "reacted",
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
    assert hidden == Reaction("never_read", 50)


def test_reading_after_it_was_recovered_is_not_reading_it(make: MakeObserved) -> None:
    source = """
PROGRAM Main
VAR battery AT A402.04 : BOOL; n, seen : INT; END_VAR
  n := n + 1;
  IF n > 20 THEN IF battery THEN seen := 1; END_IF; END_IF;
END_PROGRAM
"""
    program = checked({"main.st": source})
    kept = attempt(program, ("battery-error",), make)
    assert isinstance(kept, Reaction)
    assert (kept.verdict, kept.first_read, kept.first_effect) == ("reacted", 11, 11)
    gone = attempt(program, ("battery-error",), make, later=((5, Recover("Ada", ("battery-error",))),))
    assert gone == Reaction("never_read", 50)


def test_a_fatal_error_stops_the_plc(make: MakeObserved) -> None:
    assert reaction(HANDLERS, "memory-error", make) == Reaction("stopped", 0)


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
    assert (found.verdict, found.window, found.first_effect) == ("reacted", 1, 1)
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
    assert (found.verdict, found.window) == ("never_read", 20)
    assert found.note.startswith("the program stops without it too")


def test_details_are_read_too(make: MakeObserved) -> None:
    source = """
PROGRAM Main
VAR units AT A417 : WORD; unit : WORD; n : INT; END_VAR
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
    assert (found.verdict, [each.what for each in found.readers]) == ("reacted", ["detail"])
    assert differing(found) == {"Main.unit": ("16#0000", "16#0008", False, 1)}


def test_a_reaction_may_be_an_error_of_the_program(make: MakeObserved) -> None:
    source = """
PROGRAM Main
VAR battery AT A402.04 : BOOL; ok : BOOL; END_VAR
  IF battery THEN ok := FAL(N := 7); END_IF;
END_PROGRAM
"""
    found = reaction(source, "battery-error", make)
    assert (found.verdict, found.first_effect) == ("reacted", 1)
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
    assert reaction(source, "battery-error", make, 100) == Reaction("never_read", 100)


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
        assert attempt(program, (id,), MAKES["native"], 30) == Reaction("never_read", 30), id


@pytest.mark.parametrize("name", MODELS)
def test_every_fatal_error_stops_the_plc(name: str) -> None:
    program = checked({"main.st": BUSY}, name)
    for each in model(name).errors():
        if each.severity == "fatal":
            assert attempt(program, (each.id,), MAKES["native"], 30) == Reaction("stopped", 0), each.id


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
    assert found == Reaction("never_read", 20)


def test_errors_of_one_batch_are_told_apart(make: MakeObserved) -> None:
    program = checked({"main.st": HANDLERS})
    assert attempt(program, ("battery-error", "basic-io-error"), make) == Reaction("never_read", 50)
    found = attempt(program, ("basic-io-error", "battery-error"), make)
    assert isinstance(found, Reaction)
    assert found.verdict == "reacted"


def test_a_write_that_only_the_error_makes_possible_is_no_excuse(make: MakeObserved) -> None:
    """A write of both runs that the program overwrites with the error only: an effect, in the scan in which it is one."""
    source = """
PROGRAM Main
VAR battery AT A402.04 : BOOL; x : INT; END_VAR
  IF battery THEN x := 0; END_IF;
END_PROGRAM
"""
    found = attempt(checked({"main.st": source}), ("battery-error",), make, 20, ((4, Write("Ada", "Main.x", "5")),))
    assert isinstance(found, Reaction)
    assert (found.verdict, found.first_read, found.first_effect) == ("reacted", 1, 5)


def test_a_window_without_end_is_cut_where_memory_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("scanbench.faults.react.TRACE_LIMIT", 4_000)
    found = attempt(checked({"main.st": BUSY}), ("battery-error",), MAKES["native"], 200)
    assert isinstance(found, Reaction)
    assert found.verdict == "never_read"
    assert 5 < found.window < 200
    assert found.note == f"only {found.window} scans were compared: the program changes too much memory for more"


@pytest.mark.parametrize("command", [Restart("Ada", "cold"), Restart("Ada", "warm")])
def test_a_restart_ends_the_window(command: Command, make: MakeObserved) -> None:
    found = attempt(checked({"main.st": BUSY}), ("battery-error",), make, 20, ((7, command),))
    assert found == Reaction("never_read", 7, note="the program was restarted")


def test_a_plc_that_does_not_run_says_so(make: MakeObserved) -> None:
    found = attempt(checked({"main.st": BUSY}), ("battery-error",), make, 20, before=(SetMode("Ada", "PROGRAM"),))
    assert isinstance(found, Refusal)
    assert "did not run" in found.message
