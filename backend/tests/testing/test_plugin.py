"""Tests that people write for their programs: with the fixtures of the plugin, in a pytest of their own."""

from pathlib import Path

import pytest

from scanbench.testing import plc, project

pytest_plugins = ["pytester"]
LOADED = plc, project
"""A run of pytester forgets the modules that it loads, and some of them cannot be loaded twice."""

INI = "[pytest]\naddopts = -p no:cacheprovider -p no:asyncio -p no:pytest-lsp\n"
"""`pytest-lsp` takes only tests that are functions."""

PROGRAM = """
VAR_GLOBAL start AT CIO 0.00 : BOOL; motor AT CIO 100.00 : BOOL; lamp AT CIO 100.01 : BOOL; battery AT A402.04 : BOOL; END_VAR
PROGRAM Main
VAR n : INT; index : INT; list : ARRAY[1..3] OF INT; END_VAR
  n := n + 1;
  motor := start;
  lamp := battery;
  list[1] := n;
  IF index > 0 THEN list[index] := 0; END_IF;
END_PROGRAM
"""
GOOD = """
import pytest

def test_the_motor_follows(plc):
    assert plc.read("motor") == "FALSE"
    plc.write("start", True)
    assert plc.within_scans(1, "motor") == 1
    plc.always(20, "motor")
    assert plc.scan == 21
    assert plc.time_s == pytest.approx(0.21)
    assert plc.value("Main.list") == [21, 0, 0]

def test_each_test_has_a_fresh_plc(plc):
    assert plc.scan == 0
    assert plc.value("Main.n") == 0

def test_an_error_lights_the_lamp(plc):
    plc.never(10, "lamp")
    plc.raise_error("battery-error")
    plc.within_scans(2, "lamp")
    assert plc.errors == ("battery-error",)
    plc.recover()
    plc.run_until("NOT lamp", most=3)

def test_forces_modes_and_restarts(plc):
    with plc.forced("motor", True):
        plc.always(5, "motor")
    plc.run()
    assert not plc.holds("motor")
    plc.mode("PROGRAM")
    plc.run(5)
    assert plc.value("Main.n") == 6
    plc.mode("MONITOR")
    plc.restart("cold")
    plc.run()
    assert plc.value("Main.n") == 1

@pytest.mark.parametrize("scans", [0, -5])
def test_no_scan_shows_nothing(plc, scans):
    from scanbench.testing.plc import PlcRefused
    for look in (plc.always, plc.never):
        with pytest.raises(PlcRefused, match=f"after {scans} scans, so never"):
            look(scans, "Main.n >= 0")

def test_a_program_that_does_not_run_shows_nothing(plc):
    from scanbench.testing.plc import PlcFailure
    plc.mode("PROGRAM")
    for look, condition in ((plc.always, "NOT motor"), (plc.never, "motor")):
        with pytest.raises(PlcFailure, match="was not tested: no program ran in the scans"):
            look(50, condition)

def test_a_program_that_an_error_stopped_shows_nothing(plc):
    from scanbench.testing.plc import PlcFailure
    plc.raise_error("memory-error")
    plc.run()
    with pytest.raises(PlcFailure, match="was not tested: no program ran in the scans 1 to 50"):
        plc.never(50, "Main.n > 100")

def test_what_has_no_value_shows_nothing(plc):
    from scanbench.testing.plc import PlcFailure
    for look, condition, last in ((plc.always, "10 / (Main.n - 15) < 100", 14), (plc.never, "Main.n = 10 / (Main.n - 16)", 15)):
        with pytest.raises(PlcFailure, match=f"has no value .* after scan {last},"):
            look(50, condition)
    with pytest.raises(PlcFailure, match="has no value"):
        plc.holds("Main.n = 10 / (Main.n - 16)")
    with pytest.raises(PlcFailure, match="within 1 scans.* In the last one it had no value"):
        plc.within_scans(1, "10 / (Main.n - 17) = 3")

def test_refused(plc):
    from scanbench.testing.plc import PlcRefused
    for wrong, why in ((lambda: plc.read("moter"), "motor"), (lambda: plc.write("A400", 1), "read-only"),
                       (lambda: plc.raise_error("batery-error"), "battery-error"), (lambda: plc.holds("n +"), "n +")):
        with pytest.raises(PlcRefused, match=why.replace("+", ".")):
            wrong()
"""
BAD = """
def test_too_late(plc):
    plc.run(7)
    plc.within_scans(3, "motor AND Main.n > 0")

def test_never(plc):
    plc.never(10, "Main.n = 4")

def test_trap(plc):
    plc.write("Main.index", 9)
    plc.run(3)
"""


@pytest.fixture(autouse=True)
def _quiet(pytester: pytest.Pytester) -> None:
    """What a different plugin of ours wants to be told."""
    pytester.makeini(INI)


@pytest.fixture
def folder(pytester: pytest.Pytester) -> Path:
    pytester.makefile(".st", main=PROGRAM)
    (pytester.path / "project.json").write_text('{"model": "CJ1M-CPU63"}')
    return pytester.path


@pytest.mark.parametrize("engine", ["native", "reference", "both"])
def test_what_holds_passes(pytester: pytest.Pytester, folder: Path, engine: str) -> None:
    pytester.makepyfile(test_good=GOOD)
    pytester.runpytest_inprocess("--scanbench-engine", engine).assert_outcomes(passed=10)
    assert not (folder / "scanbench-runs").exists()


def test_what_does_not_hold_says_where_and_leaves_its_run(pytester: pytest.Pytester, folder: Path) -> None:
    pytester.makepyfile(test_bad=BAD)
    result = pytester.runpytest_inprocess("--junitxml", "report.xml")
    result.assert_outcomes(failed=3)
    result.stdout.fnmatch_lines([
        "*PlcFailure: `motor AND Main.n > 0` did not hold within 3 scans, 7 to 9. Now motor = FALSE, Main.n = 10",
        "*failed after scan 9: import the file in the browser, and go to that scan*",
        "*PlcFailure: `Main.n = 4` held after scan 3, the 4. of 10. Now Main.n = 4",
        "*PlcFailure: main.st:*: trap * in scan 0*",
    ])  # fmt: skip
    runs = sorted(each.name for each in (folder / "scanbench-runs").iterdir())
    assert runs == [f"test_bad.py_{name}.scanrun" for name in ("test_never", "test_too_late", "test_trap")]
    assert 'failures="3"' in (folder / "report.xml").read_text()


def test_a_program_that_does_not_compile_is_told_once(pytester: pytest.Pytester) -> None:
    pytester.makefile(".st", main="PROGRAM Main VAR n : INT; END_VAR n := m; END_PROGRAM")
    pytester.makepyfile(test_it="def test_it(plc): pass")
    result = pytester.runpytest_inprocess()
    result.assert_outcomes(errors=1)
    result.stdout.fnmatch_lines(["*cannot be tested:", "main.st:1:40: T001 `m` is not declared."])


def test_a_mark_names_the_project(pytester: pytest.Pytester) -> None:
    (pytester.path / "plant").mkdir()
    (pytester.path / "plant" / "main.st").write_text("PROGRAM Main VAR n : INT; END_VAR n := n + 2; END_PROGRAM")
    pytester.makepyfile(
        test_it="import pytest\n@pytest.mark.scanbench('plant')\ndef test_it(plc):\n  plc.run(2)\n  assert plc.value('Main.n') == 4"
    )
    pytester.runpytest_inprocess().assert_outcomes(passed=1)


@pytest.mark.parametrize("said", ["option", "ini"])
def test_a_scenario_elsewhere_is_of_the_named_project(pytester: pytest.Pytester, folder: Path, said: str) -> None:
    """As the page makes it: a file that names no project, in a folder of its own."""
    tests = pytester.mkdir("downloads")
    (tests / "line-1.scenario.yaml").write_text(
        "scans: 5\nsteps:\n- {at: 1, do: write start=TRUE}\nexpect:\n- {after: 3, holds: motor}\n"
    )
    if said == "ini":
        pytester.makeini(f"{INI}scanbench_project = .\n")
    named = ["--scanbench-project", str(folder)] if said == "option" else []
    pytester.runpytest_inprocess(*named, str(tests)).assert_outcomes(passed=1)
