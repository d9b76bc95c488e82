"""What if: inputs of a recorded run with other values, carried on; the smallest change; the test that is made of it."""

import random
from pathlib import Path

import pytest

from scanbench.engines.native.engine import NativeEngine
from scanbench.engines.native.observed import ObservedBuilds
from scanbench.faults.agenda import agenda_of_faults
from scanbench.faults.disturb.definition import Disturbance
from scanbench.faults.disturb.disturb import Disturb
from scanbench.history.scenario import read_scenario
from scanbench.history.whatif.contract import BadWhatIf, SetValue, WhatIf, WhatIfWanted
from scanbench.history.whatif.tries import what_if
from scanbench.recording.programs import programs_of
from scanbench.recording.reader import RunReader
from scanbench.runtime.command import Command
from scanbench.runtime.write import Write
from scanbench.wire.codec import ENTRIES
from tests.amounts import amount, nightly
from tests.history.test_campaign import MAKE, bench
from tests.runtime.bench import program
from tests.verify.verified_runs import record

SOURCE = """
VAR_GLOBAL
  start AT CIO0.00 : BOOL; door AT CIO0.01 : BOOL; level AT CIO1 : INT; speed AT CIO2 : UINT; mask AT CIO3 : WORD;
  motor AT CIO100.00 : BOOL; full AT CIO100.01 : BOOL;
END_VAR
PROGRAM Main
VAR seen, n : INT; ratio : REAL; delay : TIME; divisor : INT := 1; END_VAR
  n := n + 1;
  motor := start AND door AND speed >= 37;
  IF motor THEN seen := seen + level; END_IF;
  full := seen > 500;
  ratio := 10.0 / REAL#4.0;
  n := n / divisor;
END_PROGRAM
"""


def asked(folder: Path, wanted: WhatIfWanted, source: str = SOURCE, scans: int = 100) -> WhatIf:
    commands = [
        (10, Write("Ada", "start", "TRUE")),
        (11, Write("Ada", "speed", "20")),
        (60, Write("Ada", "level", "3")),
    ]
    (folder / "base.run").unlink(missing_ok=True)
    path = record(folder / "base.run", program(source), scans, commands, engine=NativeEngine)
    with RunReader(path, programs_of(lambda kept: program(source), MAKE), ENTRIES) as reader:
        reader.follow()
        return what_if(reader, wanted, bench(folder, program(source)))


def value(path: str, text: str) -> SetValue:
    return SetValue(path, text)


def test_values_are_carried_on_through_the_scans_that_follow(tmp_path: Path) -> None:
    values = (value("door", "TRUE"), value("speed", "40"), value("level", "100"))
    wanted = WhatIfWanted(20, values, condition="full", window=50, watch=("Main.seen", "motor"))
    found = asked(tmp_path, wanted)
    assert (found.recorded.met, found.recorded.shown) == (None, ("0", "FALSE"))
    (one,) = found.tries
    assert (one.met, one.output_scan, one.shown, one.ran) == (25, 20, ("5000", "TRUE"), 50)
    # written once they are there, too: nothing else writes them, but somebody does in scan 60
    once = asked(tmp_path, WhatIfWanted(20, values, hold=False, condition="full", window=50, watch=("Main.seen",)))
    assert once.tries[0].met == 25
    assert once.tries[0].shown == (str(40 * 100 + 10 * 3),)


def test_a_range_of_values_is_tried(tmp_path: Path) -> None:
    wanted = WhatIfWanted(
        20,
        (value("door", "TRUE"), value("level", "100")),
        vary="speed",
        tried=("30", "36..37", "90..60/30"),
        condition="full",
    )
    found = asked(tmp_path, wanted)
    assert [(each.values[-1].value, each.met) for each in found.tries] == [
        ("30", None), ("36", None), ("37", 25), ("90", 25), ("60", 25),
    ]  # fmt: skip
    assert [each.output_scan for each in found.tries] == [None, None, 20, 20, 20]


def test_a_value_that_is_none_and_a_run_time_error_are_told(tmp_path: Path) -> None:
    found = asked(tmp_path, WhatIfWanted(20, vary="Main.divisor", tried=("1", "0", "many"), hold=False, window=5))
    right, trapped, none = found.tries
    assert (right.trapped, right.ran) == ("", 5)
    assert trapped.trapped.startswith("scan 20, main.st:")
    assert (trapped.ran, none.ran) == (0, 0)
    assert "many" in none.refused[0]


def test_a_condition_without_a_value_is_told(tmp_path: Path) -> None:
    wanted = WhatIfWanted(20, vary="speed", tried=("3", "4"), window=5, condition="10 / (speed - 3) = 10")
    found = asked(tmp_path, wanted)
    assert [(each.met, each.unvalued) for each in found.tries] == [(None, 20), (20, None)]
    assert "after scan 20 `10 / (speed - 3) = 10` has no value (an index is outside, a divisor is 0" in found.note
    assert "which counts as not met (in 1 of the runs)" in found.note


def test_the_smallest_change_is_found(tmp_path: Path) -> None:
    search = ("start", "speed", "level", "mask")
    given = (value("door", "TRUE"),)
    found = asked(tmp_path, WhatIfWanted(20, given, search=True, candidates=search, condition="motor", window=1))
    assert found.best is not None
    assert found.tries[found.best].values == (*given, value("speed", "37"))
    assert "of numbers only some are tried" in found.note
    # a BOOL that is enough comes first
    found = asked(
        tmp_path,
        WhatIfWanted(
            20, (value("speed", "50"),), search=True, candidates=("start", "door", "level"), condition="motor", window=1
        ),
    )
    assert found.best is not None
    assert found.tries[found.best].values[-1] == value("door", "TRUE")
    # two of them
    found = asked(
        tmp_path,
        WhatIfWanted(5, (value("speed", "50"),), search=True, candidates=("start", "door", "level"), condition="motor", window=1),
    )  # fmt: skip
    assert found.best is not None
    assert found.tries[found.best].values[1:] == (value("start", "TRUE"), value("door", "TRUE"))


@pytest.mark.parametrize(
    ("type", "bound", "nearest"),
    [
        ("INT", "> 20000", "20001"), ("INT", "< -32767", "-32768"), ("USINT", "> 200", "201"),
        ("UDINT", "> 3000000000", "3000000001"), ("LINT", "> 5000000000000000123", "5000000000000000124"),
        ("ULINT", "> 10000000000000000000", "10000000000000000001"), ("INT(0..300)", "> 105", "106"),
    ],
)  # fmt: skip
def test_numbers_are_looked_for_up_to_their_bounds(type: str, bound: str, nearest: str, tmp_path: Path) -> None:
    source = f"PROGRAM Main VAR x : {type}; seen : BOOL; END_VAR seen := x {bound}; END_PROGRAM"
    source = source.replace("seen := x", "hit := x").replace("PROGRAM Main VAR", STARTS, 1)
    found = asked(tmp_path, WhatIfWanted(20, search=True, candidates=("Main.x",), condition="hit", window=1), source)
    assert found.best is not None, found.note
    assert found.tries[found.best].values == (value("Main.x", nearest),)


STARTS = """VAR_GLOBAL start AT CIO0.00 : BOOL; speed AT CIO2 : UINT; level AT CIO1 : INT; hit : BOOL; END_VAR
PROGRAM Main VAR"""


def test_what_is_set_alone_is_tried_before_a_change_is_looked_for(tmp_path: Path) -> None:
    given = (value("door", "TRUE"), value("speed", "40"))
    found = asked(tmp_path, WhatIfWanted(20, given, search=True, candidates=("level",), condition="motor", window=1))
    assert (found.best, [each.met for each in found.tries]) == (None, [20])
    assert "holds after scan 20 without any change" in found.note


def test_from_a_run_time_error_on_nothing_can_be_tried(tmp_path: Path) -> None:
    source = SOURCE.replace("n := n / divisor;", "n := n / (divisor - n / 50);")
    with pytest.raises(BadWhatIf, match="begin with an earlier scan, 48 at the latest"):
        asked(tmp_path, WhatIfWanted(49, (value("door", "TRUE"),)), source)
    found = asked(tmp_path, WhatIfWanted(40, (value("door", "TRUE"), value("speed", "40"))), source)
    assert (found.recorded.ran, found.tries[0].ran, found.tries[0].output_scan) == (9, 9, 40)


def test_what_a_search_did_not_find_or_look_at_is_said(tmp_path: Path) -> None:
    source = SOURCE.replace("delay : TIME;", "delay : TIME; name : STRING[5];")
    wanted = WhatIfWanted(20, search=True, candidates=("level", "Main.name"), condition="motor", window=1)
    found = asked(tmp_path, wanted, source)
    assert found.best is None
    assert "Main.name: no values are tried of such a type" in found.note
    assert "no change of one of them, or of two that are BOOL, was found" in found.note
    found = asked(tmp_path, WhatIfWanted(20, search=True, candidates=("door",), condition="start", window=3))
    assert (found.best, found.tries) == (None, ())
    assert "holds after scan 20 without any change" in found.note


def test_tries_that_all_end_by_a_run_time_error_are_no_fault_of_the_search(tmp_path: Path) -> None:
    source = SOURCE.replace("n := n / divisor;", "IF door THEN n := n / (divisor - 1); END_IF;")
    found = asked(
        tmp_path, WhatIfWanted(20, search=True, candidates=("door",), condition="motor", window=1), source
    )  # fmt: skip
    assert [each.ran for each in found.tries] == [0]
    assert found.tries[0].trapped
    assert "no change of one of them" in found.note


def test_a_test_is_made_of_it(tmp_path: Path) -> None:
    wanted = WhatIfWanted(20, (value("door", "TRUE"), value("speed", "40")), condition="motor", window=9)
    made = read_scenario(asked(tmp_path, wanted).scenario)
    assert [(each.at, each.do) for each in made.steps] == [
        (10, "write start=TRUE"), (11, "write speed=20"), (20, "force door=TRUE"), (20, "force speed=40"),
    ]  # fmt: skip
    assert [(each.kind, each.condition, each.first, each.last) for each in made.expect] == [("holds", "motor", 21, 29)]
    assert made.scans == 29
    assert made.notes == ()


@pytest.mark.parametrize(
    ("wanted", "message"),
    [
        (WhatIfWanted(500, (value("door", "TRUE"),)), "scan 500 is not in the run"),
        (WhatIfWanted(20), "say which variable"),
        (WhatIfWanted(20, (value("dor", "TRUE"),)), "dor"),
        (WhatIfWanted(20, (value("door", "TRUE"),), condition="motr"), "motr"),
        (WhatIfWanted(20, search=True, candidates=("door",)), "a search needs a condition"),
        (WhatIfWanted(20, vary="door"), "say which values"),
        (WhatIfWanted(20, vary="speed", tried=("1",) * 201), "at most 200"),
        (WhatIfWanted(20, vary="speed", tried=("0..1000/2",)), "write a larger step"),
        (WhatIfWanted(20, vary="speed", tried=("0..10/0",)), "the step is 0"),
        (WhatIfWanted(20, vary="speed", tried=("1",) * 200, window=9_000), "fewer values, or fewer scans"),
    ],
)
def test_what_cannot_be_tried_is_refused(wanted: WhatIfWanted, message: str, tmp_path: Path) -> None:
    with pytest.raises(BadWhatIf, match=message):
        asked(tmp_path, wanted)


@nightly
def test_a_planted_threshold_is_found(tmp_path: Path) -> None:
    chance = random.Random(3)
    for number in range(amount(40, 4)):
        low = chance.choice((True, False))
        edge = chance.randint(-30_000, 30_000)
        source = SOURCE.replace("speed >= 37", f"level {'<=' if low else '>='} {edge}")
        given = (value("door", "TRUE"),)
        found = asked(
            tmp_path, WhatIfWanted(20, given, search=True, candidates=("level",), condition="motor", window=1), source
        )
        now = 0
        if found.recorded.met is None and not (now <= edge if low else now >= edge):
            assert found.best is not None, (number, edge, low, found.note)
            assert found.tries[found.best].values[-1].value == str(edge), (number, edge, low)


BELT = """
VAR_GLOBAL start AT CIO0.00 : BOOL; lamp AT CIO100.00 : BOOL; END_VAR
PROGRAM Main
VAR position : INT; END_VAR
  position := position + 5;
  lamp := position > 1000;
END_PROGRAM
"""
MOVES = "main.st:5"


def disturbed(folder: Path, wanted: WhatIfWanted, *commands: tuple[int, Command]) -> WhatIf:
    """Of a run in which bit 1 of the new position is turned over, or what is given."""
    agenda = agenda_of_faults(ObservedBuilds().engine)
    (folder / "base.run").unlink(missing_ok=True)
    path = record(folder / "base.run", program(BELT), 60, commands or HIT, engine=NativeEngine, agenda=agenda)
    with RunReader(path, programs_of(lambda kept: program(BELT), MAKE), ENTRIES) as reader:
        reader.follow()
        return what_if(reader, wanted, bench(folder, program(BELT)))


HIT = ((10, Disturb("Ada", Disturbance("result", site=MOVES, bit=1, scan=46))),)
"""Before scan 46 the position is 230; after it 235 as it should be, and 233 here."""


def asks_for(scan: int, window: int, condition: str = "") -> WhatIfWanted:
    given = (value("Main.position", "237"),)
    return WhatIfWanted(scan, given, window=window, hold=False, condition=condition, watch=("Main.position",))


def test_a_value_is_there_in_the_scan_in_which_a_disturbance_came(tmp_path: Path) -> None:
    found = disturbed(tmp_path, asks_for(46, 1, "Main.position = 242"))
    assert [(each.met, each.shown, each.ran) for each in found.tries] == [(46, ("242",), 1)]
    found = disturbed(tmp_path, asks_for(45, 2, "Main.position = 242"))
    assert [(each.met, each.shown, each.ran) for each in found.tries] == [(45, ("247",), 2)]


@pytest.mark.parametrize("scan", [46, 45, 20])
def test_the_recorded_run_has_its_disturbances(scan: int, tmp_path: Path) -> None:
    found = disturbed(tmp_path, asks_for(scan, 47 - scan))
    assert found.recorded.shown == ("233",)
    assert found.undisturbed is not None
    assert found.undisturbed.shown == ("235",)
    assert found.note == "the tries are without the disturbances, which come from scan 46 on"


@pytest.mark.parametrize(
    "commands",
    [
        ((46, Disturb("Ada", Disturbance("flip", "Main.position", 1))),),
        ((30, Disturb("Ada", Disturbance("flip", "Main.position", 1, scan=46))),),
        ((46, Disturb("Ada", Disturbance("flip", "Main.position", 1))), (46, Write("Ada", "start", "TRUE"))),
    ],
)
def test_what_turned_over_before_the_scan_is_not_so_in_the_tries(
    commands: tuple[tuple[int, Command], ...], tmp_path: Path
) -> None:
    found = disturbed(
        tmp_path, WhatIfWanted(46, (value("lamp", "TRUE"),), window=1, watch=("Main.position",)), *commands
    )
    assert found.undisturbed is not None
    assert (found.recorded.shown, found.undisturbed.shown, found.tries[0].shown) == (("233",), ("235",), ("235",))


def test_a_run_without_disturbances_has_one_row_of_itself(tmp_path: Path) -> None:
    found = disturbed(tmp_path, asks_for(20, 10))
    assert (found.undisturbed, found.note, found.recorded.shown) == (None, "", ("150",))
    found = disturbed(tmp_path, asks_for(47, 3))
    assert (found.undisturbed, found.note, found.recorded.shown) == (None, "", ("248",))


def test_an_explanation_is_looked_for_without_the_disturbance(tmp_path: Path) -> None:
    wanted = WhatIfWanted(
        46, search=True, candidates=("Main.position",), condition="Main.position = 233", window=1, hold=False
    )  # fmt: skip
    found = disturbed(tmp_path, wanted)
    assert found.recorded.met == 46
    assert found.best is not None
    assert found.tries[found.best].values == (value("Main.position", "228"),)


def test_what_goes_on_beyond_the_end_of_the_run_is_said(tmp_path: Path) -> None:
    assert "the run has scans up to 59: from there on" in disturbed(tmp_path, asks_for(50, 11)).note
    assert disturbed(tmp_path, asks_for(50, 10)).note == ""
