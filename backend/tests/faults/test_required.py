"""Required reactions: each form of the language, what it comes to, and why, on both engines."""

from typing import NamedTuple

import pytest

from scanbench.engines.observe import MakeObserved
from scanbench.faults.inject import Generate, Recover
from scanbench.faults.reaction.react import react
from scanbench.faults.reaction.reaction import Reaction
from scanbench.faults.reaction.required_rules import Rules, rules_of
from scanbench.faults.reaction.sweep import sweep
from scanbench.runtime.command import Entry
from scanbench.runtime.write import Write
from scanbench.syntax.requirements import REQUIREMENTS, read_requirements
from scanbench.wire.codec import Splitter, pack
from tests.faults.reacting import MAKES, checked, point_of, programs, ref, standing

WINDOW = 30
SOURCE = """VAR_GLOBAL
  battery AT A402.04 : BOOL; basic AT A402.12 : BOOL; unit3 AT A418.03 : BOOL;
  motor AT CIO 100.00 : BOOL; lamp AT CIO 100.01 : BOOL; fan AT CIO 100.02 : BOOL; blink AT CIO 100.03 : BOOL;
  speed AT CIO 101 : INT; reset AT CIO 0.02 : BOOL;
END_VAR
PROGRAM Main
VAR
  held : BOOL; wait : TON; beat : TON; after : INT; zero : INT; list : ARRAY[1..3] OF INT; index : INT;
END_VAR
  lamp := battery;
  wait(IN := battery, PT := T#50ms);          // a timer: after five scans
  motor := NOT wait.Q;                        // goes on by itself: an unexpected restart
  IF basic THEN held := TRUE; ELSIF reset THEN held := FALSE; END_IF;
  fan := NOT held;                            // a latch: stays off
  speed := SEL(basic, 100, 40);
  IF basic THEN index := 9; END_IF;
  beat(IN := NOT beat.Q, PT := T#30ms);
  IF beat.Q THEN blink := NOT blink; END_IF;
END_PROGRAM
"""


class Case(NamedTuple):
    """What a line says of an error, and what it has to come to."""

    error: str
    line: str
    outcome: str
    scan: int | None
    values: str = ""
    reason: str = ""


CASES = [
    # the program's handler by IF, and its timer
    Case("battery-error", "lamp", "passed", 30, "lamp=TRUE"),
    Case("battery-error", "lamp = TRUE within 1 scan", "passed", 1, "lamp=TRUE"),
    Case("battery-error", "motor = FALSE within 3 scans", "failed", 3, "motor=TRUE"),
    Case("battery-error", "motor = FALSE within 6 scans", "passed", 6, "motor=FALSE"),
    Case("battery-error", "motor = FALSE within T#60ms", "passed", 6, "motor=FALSE"),
    Case("battery-error", "motor = FALSE within T#20ms", "failed", 2, "motor=TRUE"),
    Case("battery-error", "fan = FALSE within 40 scans", "not_checked", None, reason="window"),
    Case("battery-error", "lamp within 40 scans", "passed", 1, "lamp=TRUE"),
    # over the whole window
    Case("battery-error", "always lamp AND fan", "passed", 30, "lamp=TRUE fan=TRUE"),
    Case("battery-error", "always motor", "failed", 6, "motor=FALSE"),
    Case("battery-error", "never motor AND NOT lamp", "passed", 30, "motor=FALSE lamp=TRUE"),
    Case("battery-error", "never NOT motor", "failed", 6, "motor=FALSE"),
    Case("battery-error", "CIO 100.01 AND CIO101 = 100", "passed", 30, "CIO100.01=TRUE CIO101=16#0064"),
    Case("battery-error", "lamp stays TRUE", "passed", 30, "lamp=TRUE"),
    Case("battery-error", "motor OR lamp stays TRUE", "passed", 30, "motor=FALSE lamp=TRUE"),
    Case("battery-error", "motor OR lamp stays FALSE", "failed", 1, "motor=TRUE lamp=TRUE"),
    Case("battery-error", "never motor OR lamp stays FALSE", "passed", 30),
    Case("battery-error", "lamp stays TRUE AND lamp", "passed", 30, "lamp=TRUE"),
    Case("battery-error", "NOT lamp stays TRUE OR TRUE", "failed", 1, "lamp=TRUE"),
    Case("battery-error", "(lamp stays TRUE) OR motor", "passed", 30),
    # until
    Case("battery-error", "motor until wait.Q", "not_checked", None, reason="invalid"),
    Case("battery-error", "motor until Main.wait.Q", "passed", 6, "motor=FALSE Main.wait.Q=TRUE"),
    Case("battery-error", "motor stays TRUE until reset", "failed", 6, "motor=FALSE reset=FALSE"),
    Case("battery-error", "NOT motor within 6 scans until reset", "passed", 30, "motor=FALSE reset=FALSE"),
    Case("battery-error", "blink within 30 scans until reset", "failed", None),
    Case("battery-error", "motor until battery", "passed", 1, "motor=TRUE battery=TRUE"),
    Case("battery-error", "NOT motor until lamp OR TRUE", "failed", 1),
    Case("battery-error", "motor until lamp", "passed", 1, "motor=TRUE lamp=TRUE"),
    Case("battery-error", "NOT motor until lamp", "passed", 1, "motor=TRUE lamp=TRUE"),
    Case("battery-error", "after recovery: motor stays FALSE until NOT reset", "failed", 1, "motor=TRUE reset=FALSE"),
    # recovery: without a latch, with one
    Case("battery-error", "after recovery: motor stays FALSE until reset", "failed", 1, "motor=TRUE reset=FALSE"),
    Case("battery-error", "after recovery: NOT lamp within 1 scan", "passed", 1, "lamp=FALSE"),
    Case("basic-io-error", "after recovery: fan stays FALSE until reset", "passed", 30, "fan=FALSE reset=FALSE"),
    Case("basic-io-error", "after recovery: fan", "failed", 30, "fan=FALSE"),
    Case("basic-io-error", "after recovery: speed = 100 within 1 scan", "passed", 1, "speed=100"),
    # not checked
    Case("battery-error", "mtoor = FALSE", "not_checked", None, reason="invalid"),
    Case("battery-error", "speed", "not_checked", None, reason="invalid"),
    Case("battery-error", "motor =", "not_checked", None, reason="invalid"),
    Case("battery-error", "10 / Main.zero = 3", "not_checked", 30, reason="invalid"),
    Case("basic-io-error", "never Main.list[Main.index] = 7", "not_checked", 1, reason="invalid"),
    Case("battery-error", "lamp within T#1ms", "not_checked", None, reason="invalid"),
    Case("memory-error", "lamp", "not_checked", None, reason="stopped"),
    Case("memory-error", "after recovery: lamp", "not_checked", None, reason="stopped"),
    # grades
    Case("battery-error", "at least acted", "passed", None, "verdict=acted"),
    Case("inner-board-error", "at least displayed", "failed", None, "verdict=never_read"),
    Case("inner-board-error", "at least none", "passed", None, "verdict=never_read"),
]  # fmt: skip


def rules(text: str, source: str = SOURCE) -> Rules:
    return rules_of(checked({"main.st": source}), {REQUIREMENTS: text})


def found(
    text: str, error: str, make: MakeObserved, states: tuple[str, ...] = ("Here",), source: str = SOURCE, known: tuple[str, ...] = (),
) -> Reaction:  # fmt: skip
    program = checked({"main.st": source})
    point = point_of(standing(program, make))
    made = Rules(program, read_requirements(text))
    (cell, *_) = sweep(
        dict.fromkeys(states, point), [ref(error)], WINDOW, programs(program, make), rules=made, known=known
    )
    assert cell.reaction is not None, cell
    return cell.reaction


@pytest.mark.parametrize("make", MAKES.values(), ids=MAKES)
@pytest.mark.parametrize("case", CASES, ids=lambda case: f"{case.error}: {case.line}")
def test_what_a_line_comes_to(case: Case, make: MakeObserved) -> None:
    (result,) = found(f"{case.error}:\n  {case.line}\n", case.error, make).required
    assert result.text == case.line
    assert result.line == 2
    assert result.outcome == case.outcome, result
    assert result.reason == case.reason, result
    if case.scan is not None or case.outcome == "passed":
        assert result.scan == case.scan, result
    if case.values:
        assert " ".join(f"{each.path}={each.value}" for each in result.values) == case.values
    assert result.is_finding == (case.outcome == "failed" or case.reason in ("invalid", "window"))


@pytest.mark.parametrize("make", MAKES.values(), ids=MAKES)
def test_an_output_that_goes_on_again_by_itself_is_a_finding(make: MakeObserved) -> None:
    """The motor; the fan is held by a latch, and a beacon that blinks is off now and then anyway."""
    reaction = found("", "battery-error", make)
    assert [(each.path, each.scan, each.allowed_by) for each in reaction.restarts] == [("motor", 1, "")]
    assert reaction.recovery == WINDOW
    assert next(Splitter().feed(pack(reaction))) == reaction  # as it crosses a process
    assert reaction.unmet == ("motor went on again by itself",)
    assert found("", "basic-io-error", make).restarts == ()
    assert found("", "inner-board-error", make).recovery == 0  # nothing was switched off: nothing to try


@pytest.mark.parametrize(
    "line",
    [
        "motor may restart",
        "after recovery: motor within 2 scans",
        "after recovery: motor",
        "after recovery: always motor",
        "after recovery: never NOT motor",
    ],
)
def test_a_requirement_that_allows_a_restart(line: str) -> None:
    reaction = found(f"all: {line}", "battery-error", MAKES["native"])
    (restart,) = reaction.restarts
    assert restart.allowed_by == line
    assert reaction.unmet == ()


def test_a_requirement_that_has_nothing_to_do_with_it_allows_none() -> None:
    (restart,) = found("all: after recovery: NOT lamp", "battery-error", MAKES["native"]).restarts
    assert not restart.allowed_by


def test_a_state_is_written_in_any_case_and_a_misspelled_one_is_a_finding() -> None:
    there = found(
        'battery-error in HERE: lamp\nbattery-error in "Hear", Here:\n  at least none\n  motor\n',
        "battery-error",
        MAKES["native"],
    )
    *tried, wrong = there.required
    assert [(each.text, each.outcome) for each in tried] == [
        ("lamp", "passed"), ("at least none", "passed"), ("motor", "failed"),
    ]  # fmt: skip
    assert (wrong.text, wrong.reason, wrong.is_finding) == ("motor", "no_state", True)
    assert wrong.note == "there is no state `Hear`. Did you mean `Here`?"
    (jam,) = found("battery-error in Jam: lamp", "battery-error", MAKES["native"]).required
    assert (jam.reason, jam.note) == ("no_state", "there is no state `Jam`. There are: `Here`.")


def test_a_requirement_of_a_state_counts_there() -> None:
    text = 'battery-error in There: lamp\nbattery-error in "Kept": motor\n'
    there = found(text, "battery-error", MAKES["native"], ("There",), known=("There", "kept"))
    assert [(each.text, each.outcome, each.reason) for each in there.required] == [
        ("lamp", "passed", ""), ("motor", "not_checked", "other_state"),
    ]  # fmt: skip
    assert [each.text for each in there.required if each.is_finding] == []


def test_of_several_units_the_one_that_is_present_is_tried_elsewhere() -> None:
    made, make = checked({"main.st": SOURCE}, "CJ2M-CPU33"), MAKES["native"]
    live = standing(made, make)
    points = {}
    for name, unit in (("A", 3), ("B", 20)):
        assert isinstance(live.submit(Generate("Ada", (ref(f"special-io-unit-error:unit={unit}"),))), Entry)
        live.run(2)
        points[name] = point_of(live)
        assert isinstance(live.submit(Recover("Ada", None)), Entry)
    wanted = Rules(made, read_requirements("special-io-unit-error:unit=3: lamp = lamp\n"))
    cells = sweep(points, [ref("special-io-unit-error:unit=3")], WINDOW, programs(made, make), rules=wanted)
    assert [(each.point, [one.reason for one in each.required], each.unmet) for each in cells] == [
        ("A", ["present"], ()), ("B", [""], ()),
    ]  # fmt: skip


def test_a_rule_that_exempts_what_is_not_fitted_has_it_raised_nowhere() -> None:
    made = checked({"main.st": SOURCE, "hardware.json": '{"version": 1, "fitted": []}'})
    kind = [ref("special-io-unit-error:unit=3")]
    for text, expected in (("at least none", kind), ("lamp", [*kind, ref("special-io-unit-error:unit=9")])):
        found = Rules(made, read_requirements(f"special-io-unit-error:unit=9: {text}\n")).raised(kind)
        assert found == expected


def test_what_could_not_be_raised_is_not_tried() -> None:
    """Each requirement is named, with the reason, and is a finding. An error that is present in one state is tried in another one."""
    made, make = checked({"main.st": SOURCE, "hardware.json": '{"version": 1, "fitted": []}'}), MAKES["native"]
    live = standing(made, make)
    points = {"Free": point_of(live)}
    assert isinstance(live.submit(Generate("Ada", (ref("battery-error"),))), Entry)
    live.run(2)
    points["Low"] = point_of(live)
    text = (
        "battery-error: lamp\nbattery-error in Low: motor\nbattery-error: at least none\n"
        "special-io-unit-error:unit=3:\n  at least acted\n  fan\nall in Lo: fan\n"
    )
    errors = [ref("battery-error"), ref("special-io-unit-error:unit=3")]
    cells = sweep(points, errors, WINDOW, programs(made, make), rules=Rules(made, read_requirements(text)))
    told = {(each.error, each.point): each for each in cells}
    low = told["battery-error", "Low"]
    assert low.reaction is None
    assert [(each.text, each.reason) for each in low.required] == [("lamp", "present"), ("motor", "not_raised")]
    assert low.unmet == ("motor",)
    assert low.required[1].note == low.note
    assert low.note == "battery-error is present in this state already"
    unfitted = told["special-io-unit-error:unit=3", "Free"]
    assert [(each.text, each.reason) for each in unfitted.required] == [
        ("at least acted", "not_raised"), ("fan", "not_raised"), ("fan", "no_state"),
    ]  # fmt: skip
    assert unfitted.unmet == ("at least acted", "fan", "fan")
    assert unfitted.note


@pytest.mark.parametrize(
    ("text", "error", "wanted"),
    [
        ("all: at least stored\nbattery-error: at least acted", "battery-error", "acted"),
        ("battery-error: at least acted\nall: at least stored", "battery-error", "acted"),
        ("all: at least stored\nfatal: at least none", "battery-error", "stored"),
        ("all: at least stored\nnonfatal: at least displayed", "battery-error", "displayed"),
        (
            "special-io-unit-error: at least acted\nspecial-io-unit-error:unit=3: at least none",
            "special-io-unit-error:unit=3",
            "none",
        ),
        ("special-io-unit-error:unit=3: at least none", "special-io-unit-error:unit=4", None),
        ("battery-error in Here: at least none\nbattery-error: at least acted", "battery-error", "none"),
    ],
)
def test_the_grade_that_is_most_about_an_error_counts(text: str, error: str, wanted: str | None) -> None:
    assert rules(text).grade(ref(error), "Here") == wanted


def test_without_details_every_instance_is_meant() -> None:
    made = rules("special-io-unit-error: lamp\nspecial-io-unit-error:unit=3: motor\nnonfatal: fan")
    assert [each.source.text for each in made.of(ref("special-io-unit-error:unit=3"), "")] == ["lamp", "motor", "fan"]
    assert [each.source.text for each in made.of(ref("special-io-unit-error:unit=4"), "")] == ["lamp", "fan"]
    both = [ref("special-io-unit-error"), ref("battery-error")]
    assert made.raised(both) == [both[0], ref("special-io-unit-error:unit=3"), both[1]]
    assert made.raised(both[1:]) == both[1:]


@pytest.mark.parametrize("written", ["unit=03", "unit=16#3", "16#03", "unit=0_3"])
def test_a_number_may_be_written_otherwise(written: str) -> None:
    text = f"special-io-unit-error:{written}: lamp\nspecial-io-unit-error:{written}: at least none\n"
    made, error = rules(text), ref("special-io-unit-error:unit=3")
    assert [each.source.text for each in made.of(error, None) if each.condition] == ["lamp"]
    assert made.grade(error, None) == "none"
    assert made.raised([ref("special-io-unit-error")]) == [ref("special-io-unit-error"), error]
    assert made.raised([error]) == [error]


def test_the_default_is_not_raised_twice() -> None:
    made = rules("special-io-unit-error:unit=0: lamp")
    assert made.raised([ref("special-io-unit-error")]) == [ref("special-io-unit-error")]
    assert [each.source.text for each in made.of(ref("special-io-unit-error"), None)] == ["lamp"]


def test_what_is_asked_for_and_not_fitted_is_raised_where_a_rule_names_it() -> None:
    text = (
        "battery-error: lamp\nbasic-io-error: motor\nspecial-io-unit-error:unit=3: fan\nmemory-error: at least none\n"
    )
    made, battery = rules(text), ref("battery-error")
    asked = ["battery-error", "special-io-unit-error", "memory-error"]
    assert made.raised([battery], asked) == [battery, ref("special-io-unit-error:unit=3")]


@pytest.mark.parametrize(
    ("text", "where", "says"),
    [
        ("battery-eror: lamp", (1, 1), "Did you mean `battery-error`"),
        ("battery-error:\n  mtoor = FALSE", (2, 3), "Did you mean `motor`"),
        ("battery-error:\n  lamp AND mtoor", (2, 12), "Did you mean `motor`"),
        ("battery-error:\n  after recovery: NOT lmp until reset", (2, 23), "Did you mean `lamp`"),
        ("battery-error: lamp until rset", (1, 27), "Did you mean `reset`"),
        ("battery-error: lamp OR mtoor stays FALSE", (1, 24), "Did you mean `motor`"),
        ("battery-error:\n  lamp OR motor  stays mtoor OR lamp", (2, 24), "Did you mean `motor`"),
        ("battery-error: speed", (1, 16), "it must be BOOL"),
        ("battery-error: motor := FALSE", (1, 22), "Compare with `=`"),
        ("battery-error: at least fine", (1, 25), "there are acted, decided"),
        ("  lamp", (1, 3), "say first which error"),
        ("battery-error lamp", (1, 1), "needs `:` after it"),
        ("special-io-unit-error:unit=999: lamp", (1, 1), "unit"),
        ("battery-error: lamp within T#1ms", (1, 28), "shorter than one scan"),
    ],
)  # fmt: skip
def test_a_mistake_is_told_with_its_place(text: str, where: tuple[int, int], says: str) -> None:
    (problem,) = rules(text).problems
    assert (problem.code, problem.span.line, problem.span.column) == ("R001", *where), problem
    assert says in problem.message


@pytest.mark.parametrize("make", MAKES.values(), ids=MAKES)
def test_a_single_raise_is_judged_by_the_same_requirements(make: MakeObserved) -> None:
    """Somebody recovers it in scan 11: from then on the recovery counts. The reset that somebody gave ends the latch."""
    program = checked({"main.st": SOURCE})
    live = standing(program, make)
    point = point_of(live)
    entry = live.submit(Generate("Ada", (ref("basic-io-error"),)))
    assert isinstance(entry, Entry)
    entered = len(live.journal)
    live.run(10)
    assert isinstance(live.submit(Recover("Ada", ("basic-io-error",))), Entry)
    live.run(5)
    assert isinstance(live.submit(Write("Ada", "reset", "TRUE")), Entry)
    live.run(15)
    text = "basic-io-error:\n  NOT fan within 1 scan\n  basic\n  NOT fan within 15 scans until reset\n  after recovery: fan stays FALSE until reset\n"
    made = Rules(program, read_requirements(text + "basic-io-error in There: lamp\n"))
    reaction = react(point, entry, live.journal[entered:], WINDOW, programs(program, make), "basic-io-error", made)
    assert isinstance(reaction, Reaction), reaction
    assert [(each.outcome, each.scan, each.note) for each in reaction.required] == [
        ("passed", 1, ""), ("passed", 10, ""), ("passed", 10, "until did not come"), ("passed", 6, "until came"),
        ("not_checked", None, "a PLC that somebody works with is in none of the states of a sweep"),
    ]  # fmt: skip
    assert reaction.restarts == ()  # somebody did it


def came_to(
    text: str, make: MakeObserved, source: str, error: str = "battery-error"
) -> list[tuple[str, str, int | None]]:
    reaction = found(f"{error}:\n{text}", error, make, source=source)
    return [(each.outcome, each.reason, each.scan) for each in reaction.required]


HEAD = """VAR_GLOBAL
  battery AT A402.04 : BOOL; motor AT CIO 100.00 : BOOL; lamp AT CIO 100.01 : BOOL;
END_VAR
PROGRAM Main
VAR
  list : ARRAY[1..3] OF INT; index : INT; scans : INT;
END_VAR
"""


@pytest.mark.parametrize("make", MAKES.values(), ids=MAKES)
def test_a_scan_in_which_the_program_stops_passes_nothing(make: MakeObserved) -> None:
    """The stop switches the outputs off, not the program."""
    source = f"""{HEAD}
      motor := TRUE;
      IF battery THEN scans := scans + 1; index := scans * 2; list[index] := 1; END_IF;
    END_PROGRAM"""
    text = "  motor = FALSE within 3 scans\n  never NOT motor\n  motor within 1 scan\n  Main.index = 2\n"
    assert came_to(text, make, source) == [
        ("not_checked", "ended", 2), ("not_checked", "ended", 2), ("passed", "", 1), ("not_checked", "ended", 2),
    ]  # fmt: skip


@pytest.mark.parametrize("make", MAKES.values(), ids=MAKES)
def test_a_window_that_ended_early_decides_nothing_about_its_end(make: MakeObserved) -> None:
    """The program stops without the error in scan 2; with it, it goes on."""
    source = f"""{HEAD}
      lamp := battery; scans := scans + 1;
      IF scans > 11 AND NOT battery THEN index := 9; list[index] := 1; END_IF;
    END_PROGRAM"""
    text = "  lamp\n  always lamp\n  never NOT lamp\n  lamp until motor\n  lamp within 1 scan\n  always motor\n"
    unknown = ("not_checked", "window", None)
    assert came_to(text, make, source) == [*[unknown] * 4, ("passed", "", 1), ("failed", "", 1)]


def recovering(scan: int) -> str:
    """A program that recovers the error itself in this scan of the window; the motor goes on again."""
    return f"""{HEAD.replace("battery AT A402.04", "fal AT A402.15")}
      lamp := fal; motor := NOT fal;
      IF fal THEN scans := scans + 1; END_IF;
      IF scans = {scan} THEN FAL(N := 0); END_IF;
    END_PROGRAM"""


@pytest.mark.parametrize("make", MAKES.values(), ids=MAKES)
def test_what_must_hold_with_the_error_is_not_asked_after_it(make: MakeObserved) -> None:
    text = "  lamp\n  NOT lamp\n  always lamp\n  lamp until Main.scans > 90\n  NOT lamp within 20 scans\n"
    assert came_to(text, make, recovering(10), "fal") == [
        ("passed", "", 10), ("failed", "", 10), ("passed", "", 10), ("passed", "", 10), ("not_checked", "window", None),
    ]  # fmt: skip


@pytest.mark.parametrize("make", MAKES.values(), ids=MAKES)
def test_a_program_that_recovers_it_in_the_last_scan(make: MakeObserved) -> None:
    text = "fal:\n  lamp\n  after recovery: NOT lamp within 1 scan\n"
    reaction = found(text, "fal", make, source=recovering(WINDOW))
    assert [(each.outcome, each.scan) for each in reaction.required] == [("passed", WINDOW), ("passed", 1)]
    assert [(each.path, each.scan) for each in reaction.restarts] == [("motor", 1)]
    assert reaction.recovery == WINDOW
