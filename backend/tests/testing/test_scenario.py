"""Scenario files: read and written, played, recorded from a run, and made as short as they can be."""

import random
from collections.abc import Callable, Iterator
from contextlib import suppress
from datetime import UTC, datetime
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scanbench.faults.line_faults import BreakLine, LineFault, MendLine
from scanbench.history.scenario import BadScenario, Expectation, Scenario, Step, read_scenario, write_scenario
from scanbench.history.scenario_steps import from_run
from scanbench.runtime.command import Entry, Plan
from scanbench.runtime.write_areas import AreaWrite, WriteAreas
from scanbench.testing.attempts import Attempts
from scanbench.testing.play import Failed
from scanbench.testing.project import Project
from scanbench.testing.shrink import shrink
from tests.amounts import amount
from tests.cli.calling import scanbench
from tests.comm.bench import machine

SOURCE = """
VAR_GLOBAL a, b, c, d, start, motor : BOOL; level, n : INT; END_VAR
PROGRAM Main
VAR seen : INT; broken : BOOL; list : ARRAY[1..3] OF INT; END_VAR
  n := n + 1;
  motor := start;
  // a comes before b, b before c; then d breaks it
  IF a AND seen = 0 THEN seen := 1; END_IF;
  IF b AND seen = 1 THEN seen := 2; END_IF;
  IF c AND seen = 2 THEN seen := 3; END_IF;
  IF d AND seen = 3 THEN broken := TRUE; END_IF;
  IF level > 90 THEN list[level] := 0; END_IF;
END_PROGRAM
"""
FILE = """# a comment
scans: 40
steps:
- {at: 5, do: write start=TRUE}
- {at: 20, do: raise battery-error}
- {at: 25, do: clear all}
expect:
- {after: 6, holds: motor}
- {from: 6, to: 40, always: motor}
- {from: 0, to: 20, never: A402.04}
- {from: 20, within: 3, holds: A402.04}
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("plant")
    (folder / "main.st").write_text(SOURCE)
    (folder / "project.json").write_text('{"model": "CJ1M-CPU63"}')
    return folder


@pytest.fixture(scope="module")
def attempt(folder: Path) -> Iterator[Callable[[Scenario], Failed | None]]:
    with Attempts(Project.read(folder)) as attempt:
        yield attempt


def test_a_file_comes_back_as_it_was() -> None:
    scenario = read_scenario(FILE)
    assert read_scenario(write_scenario(scenario)) == scenario
    assert [each.at for each in scenario.steps] == [5, 20, 25]
    assert str(scenario.expect[3]) == "from 20 within 3: holds A402.04"


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("scans: [", "it is no YAML"),
        ("7", "has to be names with values"),
        ("steps: []", "scans has to be a number"),
        ("{scans: 5, stops: []}", "stops is unknown"),
        ("{scans: 5, steps: [{at: 9, do: mode RUN}]}", "at has to be a number from 0 to 5"),
        ("{scans: 5, steps: [{at: 1, do: jump}]}", "do has to begin with one of write"),
        ("{scans: 5, expect: [{after: 1}]}", "has to be a condition"),
        ("{scans: 5, expect: [{from: 4, to: 2, never: x}]}", "which is not from 5 to 5"),
        ("{scans: 5, expect: [{from: 4, to: 4, never: x}]}", "which is not from 5 to 5"),
        ("{scans: 5, expect: [{from: 4, within: 2, holds: x}]}", "which is not from 4 to 5"),
    ],
)
def test_what_is_no_scenario_says_why(text: str, why: str) -> None:
    with pytest.raises(BadScenario, match=why):
        read_scenario(text)


@given(st.text(max_size=60))
def test_any_text_is_a_scenario_or_none(text: str) -> None:
    with suppress(BadScenario):
        assert write_scenario(read_scenario(text))


def test_what_is_expected_holds(attempt: Callable[[Scenario], Failed | None]) -> None:
    assert attempt(read_scenario(FILE)) is None


@pytest.mark.parametrize(
    ("change", "what", "scan", "message"),
    [
        (("after: 6", "after: 5"), "after 5: holds motor", 5, "`motor` does not hold after 5 scans. Now motor = FALSE"),
        (("from: 6, to: 40, always: motor", "from: 6, to: 40, always: n < 12"), "from 6 to 40: always n < 12", 12,
         "`n < 12` does not hold after 12 scans. Now n = 12"),
        (("from: 0, to: 20, never: A402.04", "from: 0, to: 30, never: A402.04"), "from 0 to 30: never A402.04", 21,
         "`A402.04` holds after 21 scans. Now A402.04 = TRUE"),
        (("from: 20, within: 3, holds: A402.04", "from: 26, within: 3, holds: A402.04"), "from 26 within 3: holds A402.04", 29,
         "`A402.04` does not hold after 29 scans. Now A402.04 = FALSE"),
        (("never: A402.04", "never: 'Main.list[level] = 3'"), "from 0 to 20: never Main.list[level] = 3", 1,
         "`Main.list[level] = 3` has no value (an index is outside, a divisor is 0 or a reference refers to nothing) after 1 scans"),
        (("from: 6, to: 40, always: motor", "from: 8, to: 40, always: 10 / (n - 15) < 100"),
         "from 8 to 40: always 10 / (n - 15) < 100", 15, "has no value"),
        (("holds: A402.04}", "holds: 'Main.list[level] = 3'}\n- {from: 0, to: 40, never: n = 7}"), "from 0 to 40: never n = 7", 7,
         "`n = 7` holds after 7 scans"),
        (("holds: A402.04}", "holds: 'Main.list[level] = 3'}"), "from 20 within 3: holds Main.list[level] = 3", 23, "has no value"),
        (("start=TRUE}", "start=TRUE}\n- {at: 6, do: mode PROGRAM}"), "from 6 to 40: always motor", 40,
         "`motor` was not tested: no program ran in the scans 6 to 39 (mode PROGRAM, or an error that stops the program)."),
        (("start=TRUE}", "start=TRUE}\n- {at: 6, do: raise memory-error}"), "from 6 to 40: always motor", 40,
         "`motor` was not tested: no program ran in the scans 6 to 39 (mode PROGRAM, or an error that stops the program)."),
        (("write start=TRUE", "write level=99"), "trap", 5, "main.st:12:27: trap bounds"),
        (("write start=TRUE", "write A400=1"), "refused: write A400=1", 5, "read-only"),
    ],
)  # fmt: skip
def test_what_is_not_so_is_told(
    attempt: Callable[[Scenario], Failed | None], change: tuple[str, str], what: str, scan: int, message: str
) -> None:
    failed = attempt(read_scenario(FILE.replace(*change)))
    assert failed is not None
    assert (failed.what, failed.scan) == (what, scan)
    assert message in failed.message


@pytest.mark.nightly
def test_random_scenarios_shrink_to_what_was_planted(attempt: Callable[[Scenario], Failed | None]) -> None:
    shortest = 0
    rounds = amount(200, 2)
    for seed in range(rounds):
        scenario = planted(random.Random(seed))
        failed = attempt(scenario)
        assert failed is not None
        short = shrink(scenario, failed, attempt)
        again = attempt(short)
        assert again is not None
        assert again.what == failed.what
        assert set(short.steps) <= set(scenario.steps)
        shortest += len(short.steps) == 4
    assert shortest >= 0.8 * rounds


def planted(chance: random.Random) -> Scenario:
    """Four writes that break it, among up to 40 that do not matter."""
    at = sorted(chance.sample(range(100), 4))
    needed = [Step(scan, f"write {name}=TRUE") for scan, name in zip(at, "abcd", strict=True)]
    noise = [
        Step(chance.randrange(100), chance.choice([
            "write start=TRUE", "write start=FALSE", f"write level={chance.randrange(90)}", "raise battery-error", "clear all",
            f"write n={chance.randrange(100)}", "mode MONITOR", "force motor=TRUE",
        ]))
        for _ in range(chance.randrange(40))
    ]  # fmt: skip
    steps = sorted((each for each in (*needed, *noise) if each.do != "raise battery-error"), key=lambda step: step.at)
    return Scenario(120, tuple(steps), (Expectation("never", "Main.broken", 0, 120),))


def test_a_scenario_is_recorded_from_a_run_played_and_shortened(folder: Path, tmp_path: Path) -> None:
    run, file = tmp_path / "it.scanrun", folder / "it.scenario.yaml"
    ran = scanbench(
        "run", str(folder), "--scans", "50", "--set", "start=TRUE@5", "--set", "level=7@9", "--raise", "io-bus-error:rack=1,slot=3@30",
        "--clear", "all@35", "--mode", "PROGRAM@40", "--record", str(run),
    )  # fmt: skip
    assert ran.returncode == 0, ran.stderr
    recorded = scanbench("scenario", "record", str(run), "--expect", "motor", "--expect", "level")
    assert recorded.returncode == 0, recorded.stderr
    assert "- {at: 30, do: 'raise io-bus-error:" in recorded.stdout
    assert "- {after: 50, holds: level = 7}" in recorded.stdout
    file.write_text(recorded.stdout)
    assert scanbench("scenario", "run", str(file)).stdout == f"{file}: as expected\n"
    file.write_text(recorded.stdout.replace("level = 7", "level = 0"))
    assert scanbench("scenario", "run", str(file)).returncode == 1
    short = scanbench("scenario", "shrink", str(file))
    assert short.returncode == 0, short.stderr
    assert "# 1 of 5 steps are left" in short.stdout
    assert [each.do for each in read_scenario(short.stdout).steps] == ["write level=7"]


@pytest.mark.parametrize("expect", ["", "expect: []\n"])
def test_a_scenario_that_expects_nothing_says_so(folder: Path, expect: str) -> None:
    file = folder / "empty.scenario.yaml"
    file.write_text(f"scans: 5\n{expect}")
    played = scanbench("scenario", "run", str(file))
    said = f"{file}: nothing is expected: 5 scans went by without a trap; write what is to hold below `expect:`\n"
    assert (played.returncode, played.stdout) == (3, said)


def test_a_recorded_line_cut_and_what_a_client_wrote_are_steps_that_play(
    attempt: Callable[[Scenario], Failed | None],
) -> None:
    resource = machine("CJ1M-CPU63")
    model = resource.program.layout.model
    plan = Plan((), "")
    commands = (
        BreakLine("Ada", "fins", LineFault("cut")), BreakLine("Ada", "modbus", LineFault("late", 500, 2, 4)), MendLine("Ada", "fins"),
        WriteAreas("plant", (AreaWrite("D", 401, b"\x00"), AreaWrite("D", 400, b"\x07\x00\x03"))),
    )  # fmt: skip
    entries = [Entry(at, datetime(2026, 1, 1, tzinfo=UTC), each, plan) for at, each in enumerate(commands, 5)]
    made = from_run(entries, 20, model, [("D200", "16#0007")])
    told = [each.do for each in made.steps]
    assert told[:3] == ["break fins=cut", "break modbus=late 500 for 2 of 4", "mend fins"]
    assert told[3:11] == [f"write D200.{bit:02}=FALSE" for bit in range(8, 16)]
    assert told[11] == "write D200=16#0007"
    assert told[12:14] == ["write D201.00=TRUE", "write D201.01=TRUE"]
    assert made.notes == ()
    assert attempt(read_scenario(write_scenario(made))) is None


@pytest.mark.parametrize(
    ("do", "why"),
    [
        ("break fins", "break SERVER=FAULT"),
        ("break fins=torn", "there is no fault 'torn' of a line"),
        ("break profinet=cut", "there is no line 'profinet'"),
        ("mend slmp", "CJ1M-CPU63 does not speak SLMP"),
    ],
)
def test_a_step_of_a_line_that_makes_no_sense_says_why(
    attempt: Callable[[Scenario], Failed | None], do: str, why: str
) -> None:
    failed = attempt(read_scenario(f"scans: 10\nsteps: [{{at: 5, do: {do}}}]\n"))
    assert failed is not None
    assert why in failed.message
