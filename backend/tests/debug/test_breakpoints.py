"""Each kind of breakpoint, with all that narrows it, on both engines."""

from pathlib import Path

import pytest

from scanbench.debug.breakpoint import Breakpoint
from scanbench.debug.hits import HitRule, parse_hits
from scanbench.engines.interpreter.debugged import debug_engine
from scanbench.faults.inject import Generate
from scanbench.faults.reference import ErrorRef
from scanbench.runtime.command import Refusal
from scanbench.runtime.restart import Restart
from scanbench.runtime.write import Write
from tests.debug.test_walks import BUILDS
from tests.debug.walking import STATIONS, MakeDebug, Walker
from tests.recording.recorded import to_program
from tests.runtime.bench import value

TASKS = """FUNCTION_BLOCK Count
VAR n : DINT; END_VAR
  n := n + 1;
END_FUNCTION_BLOCK
PROGRAM Main
VAR c : Count; END_VAR
  c();
END_PROGRAM
CONFIGURATION Line
  RESOURCE Cpu ON PLC
    TASK Fast(INTERVAL := T#10ms, PRIORITY := 1);
    TASK Slow(INTERVAL := T#30ms, PRIORITY := 2);
    PROGRAM One WITH Fast : Main;
    PROGRAM Two WITH Slow : Main;
  END_RESOURCE
END_CONFIGURATION
"""


@pytest.fixture(params=[debug_engine, BUILDS.engine], ids=["reference", "native"])
def make(request: pytest.FixtureRequest) -> MakeDebug:
    return request.param  # type: ignore[no-any-return]


@pytest.fixture
def walker(make: MakeDebug, tmp_path: Path) -> Walker:
    return Walker(tmp_path / "a.run", make=make)


def line(number: int, **more: object) -> Breakpoint:
    return Breakpoint(1, "line", "Ann", file="main.st", line=number, **more)  # type: ignore[arg-type]


def data(path: str, access: str = "change", **more: object) -> Breakpoint:
    return Breakpoint(1, "data", "Ann", path=path, access=access, **more)  # type: ignore[arg-type]


def test_a_line_without_a_statement_moves_down_and_says_so(walker: Walker) -> None:
    moved, unknown, beyond = walker.set(line(24), Breakpoint(2, "line", "Ann", file="mian.st", line=1), line(99))
    assert (moved.verified, moved.line, moved.message) == (True, 24, "")
    moved, *_ = walker.set(line(8))
    assert (moved.verified, moved.line, moved.message) == (True, 13, "moved to line 13: line 8 has no statement")
    assert (unknown.verified, "Did you mean `main.st`?" in unknown.message) == (False, True)
    assert (beyond.verified, beyond.message) == (
        False, "no statement begins at main.st:99 or below; the last one is at line 30"
    )  # fmt: skip


def test_the_nth_statement_in_a_line_by_its_column(make: MakeDebug, tmp_path: Path) -> None:
    source = "PROGRAM Main\nVAR a, b, c : INT; END_VAR\n  a := a + 1;  b := a;  c := b;\nEND_PROGRAM\n"
    walker = Walker(tmp_path / "a.run", source, make)
    (verdict,) = walker.set(line(3, column=17))
    assert (verdict.line, verdict.column) == (3, 16)
    walker.run()
    assert [value(walker.timeline.resource, f"Main.{each}") for each in "abc"] == [1, 0, 0]


def test_only_in_one_instance_where_the_condition_holds(walker: Walker) -> None:
    (verdict,) = walker.set(line(14, instance="Main.b", condition="last > 12 AND Main.n MOD 2 = 0"))
    assert verdict.verified, verdict.message
    halt = walker.run()
    assert halt is not None
    assert halt.instance == "Main.b"
    resource = walker.timeline.resource
    assert value(resource, "Main.n") == 12
    assert value(resource, "Main.b.last") == 14
    for bad, why in (
        (line(14, condition="last +"), "condition"),
        (line(14, condition="last + 1"), "must be BOOL"),
        (line(14, instance="Main.x"), "has no member"),
        (line(14, instance="Main.n"), "is no instance"),
        (line(25, instance="Main.a"), "Main.a is a Station"),
        (line(14, task="Fats"), "there is no task Fats"),
        (line(14, hits="often"), "is no hit count"),
        (line(14, log="{nix}"), "nix"),
        (line(14, assign="nix := 1"), "nix"),
        (data("Main.nix"), "has no member"),
        (data("Main.n", assign="Main.n := 1"), "line breakpoint"),
        (Breakpoint(1, "error", "Ann", error="nix"), "has no error nix"),
    ):
        (verdict,) = walker.set(bad)
        assert not verdict.verified, bad
        assert why in verdict.message


def test_only_in_one_task(make: MakeDebug, tmp_path: Path) -> None:
    walker = Walker(tmp_path / "a.run", TASKS, make)
    walker.set(line(3, task="slow"))
    for expected in (0, 3, 6):
        halt = walker.run()
        assert halt is not None
        assert (halt.task, halt.scan, halt.instance) == ("Slow", expected, "Two.c")
        walker.debugger.step("continue", "Ann")


@pytest.mark.parametrize(
    ("hits", "scans"), [("3", [2]), ("= 2", [1]), (">= 3", [2, 3, 4]), ("% 3", [2, 5, 8]), ("> 1", [1, 2])]
)
def test_hits_are_counted(walker: Walker, hits: str, scans: list[int]) -> None:
    walker.set(line(25, hits=hits))
    found = []
    for _ in scans:
        halt = walker.run(10)
        assert halt is not None
        found.append(halt.scan)
        walker.debugger.step("continue", "Ann")
    assert found == scans
    assert walker.debugger.verdicts[0].hits == scans[-1] + 1


def test_hit_counts_as_typed() -> None:
    assert parse_hits(" >=3 ") == HitRule(">=", 3)
    assert parse_hits("== 4") == HitRule("=", 4)
    assert parse_hits(" ") is None
    for text in ("x", "3x", "-1", "% 0", "0", "1.5", "9" * 40):
        assert isinstance(parse_hits(text), str), text


def test_a_logpoint_speaks_and_an_execution_point_assigns_without_halting(walker: Walker) -> None:
    walker.set(
        line(27, log="n={n}, a={a.total}"),
        Breakpoint(2, "line", "Ann", file="main.st", line=30, condition="n = 3", assign="list[4] := n; other := 77;"),
    )
    assert walker.run(5) is None
    said = [text for _, _, text in walker.heard.logs]
    assert said[:2] == ["n=1, a=2", "n=2, a=6"]
    resource = walker.timeline.resource
    assert value(resource, "Main.list[4]") == 3
    entries = [each for each in walker.timeline.live_journal if each.step]
    assert [(each.scan, each.command.author) for each in entries] == [(2, "Ann")]
    state = resource.state
    assert walker.timeline.goto(2) is None
    walker.timeline.return_live()
    assert resource.state == state
    walker.timeline.goto(0)
    walker.timeline.step(walker.timeline.live_scan)
    assert resource.state == state, "what was assigned is replayed in the middle of its scan"


def test_a_data_breakpoint_halts_after_the_write(walker: Walker) -> None:
    (verdict,) = walker.set(data("Main.list"))
    assert verdict.verified
    walker.run()
    assert (walker.halt.reason, walker.halt.text) == ("data breakpoint", "Main.list was written")
    assert value(walker.timeline.resource, "Main.list[1]") == 1
    assert walker.halt.scan == 0


@pytest.mark.parametrize(
    ("access", "texts"),
    [
        ("read", ["Main.b.small was read: 0", "Main.b.small was read: 0", "Main.b.small was read: 5"]),
        ("write", ["Main.b.small was written: 0", "Main.b.small changed from 0 to 5", "Main.b.small was written: 5"]),
        ("change", ["Main.b.small changed from 0 to 5"]),
        ("access", ["Main.b.small was read: 0", "Main.b.small was written: 0"]),
    ],
)
def test_reads_writes_and_changes(make: MakeDebug, tmp_path: Path, access: str, texts: list[str]) -> None:
    source = STATIONS.replace("  sum := sum + total;", "  sum := sum + small;\n  small := SEL(Main.n > 1, 0, 5);")
    source = source.replace("Main.n > 1", "last > 0").replace("small : INT(0..100)", "small : INT")
    walker = Walker(tmp_path / "a.run", source, make)
    (verdict,) = walker.set(data("Main.b.small", access))
    assert verdict.verified, verdict.message
    found = []
    for _ in texts:
        walker.run(20)
        found.append(walker.halt.text)
        walker.debugger.step("continue", "Ann")
    assert found == texts


def test_an_in_out_is_followed_to_what_is_passed(walker: Walker) -> None:
    walker.run(1)
    walker.set(data("Main.b.sum"))
    walker.run()
    assert walker.halt.text.startswith("Main.b.sum changed from ")
    before = value(walker.timeline.resource, "Main.other")
    walker.step("continue")
    assert value(walker.timeline.resource, "Main.other") != before


def test_a_write_in_the_last_statement_halts_in_the_seam(make: MakeDebug, tmp_path: Path) -> None:
    source = "PROGRAM Main\nVAR n : DINT; END_VAR\n  n := n + 1;\nEND_PROGRAM\n"
    walker = Walker(tmp_path / "a.run", source, make)
    walker.set(data("Main.n"))
    walker.run()
    assert (walker.here, walker.halt.span, walker.halt.text) == ((1, 0), None, "Main.n changed from 0 to 1")
    walker.step("continue")
    assert walker.here == (2, 0)


def test_an_error_halts_before_the_next_statement(walker: Walker) -> None:
    error = next(each.id for each in walker.timeline.resource.program.layout.model.errors() if each.severity != "fatal")
    walker.set(Breakpoint(1, "error", "Ann", error=error), Breakpoint(2, "error", "Ann", error="", hits="2"))
    walker.run(5)
    walker.submit(Generate("Bob", (ErrorRef(error),)))
    walker.run()
    assert (walker.halt.reason, walker.halt.text, walker.here) == ("error", f"{error} was raised", (5, 1))
    walker.debugger.step("continue", "Ann")
    assert walker.run(5) is None


def test_a_violation_halts_after_the_statement(make: MakeDebug, tmp_path: Path) -> None:
    source = STATIONS.replace(
        "  sum := sum + total;", "  sum := sum + total;\n  small := DINT_TO_INT(total);\n  t := 1;"
    )
    walker = Walker(tmp_path / "a.run", source, make)
    walker.set(Breakpoint(1, "violation", "Ann"))
    walker.run()
    assert walker.halt.reason == "violation"
    assert walker.halt.text == "small was 103, outside of 0..100, at main.st:21 in Main.a"
    left = walker.halt.left
    assert left is not None
    assert (left.variable, left.value, left.low, left.high, left.instance) == ("small", 103, 0, 100, "Main.a")
    assert left.calls == ("Station Main.a main.st:21", "Main Main main.st:27")
    assert (walker.line, walker.halt.instance) == (22, "Main.a")
    assert value(walker.timeline.resource, "Main.a.total") == 103


LENT = """\
FUNCTION_BLOCK Pump
VAR_IN_OUT level : INT (0..100); END_VAR
level := level + 60;
END_FUNCTION_BLOCK
PROGRAM Main
VAR tanks : ARRAY[1..2] OF INT (0..100); p : Pump; END_VAR
p(level := tanks[1]);
p(level := tanks[2]);
END_PROGRAM"""


def test_a_violation_by_the_name_of_an_in_out_says_whose_variable_it_is(make: MakeDebug, tmp_path: Path) -> None:
    walker = Walker(tmp_path / "a.run", LENT, make)
    walker.set(Breakpoint(1, "violation", "Ann"))
    for tank in (1, 2):
        walker.run() if tank == 1 else walker.step("continue")
        left = walker.halt.left
        assert left is not None
        assert (left.variable, left.target, left.instance, left.value) == (
            "level",
            f"Main.tanks[{tank}]",
            "Main.p",
            120,
        )
        assert walker.halt.text == f"Main.tanks[{tank}] (here level) was 120, outside of 0..100, at main.st:3 in Main.p"


def test_at_a_scan(walker: Walker) -> None:
    walker.set(Breakpoint(1, "scan", "Ann", scan=42))
    walker.run()
    assert (walker.halt.reason, walker.here) == ("scan", (42, 1))
    assert walker.debugger.flavour == "debug"
    walker.debugger.step("continue", "Ann")
    assert walker.run(10) is None
    assert walker.debugger.flavour == ""


def test_several_at_one_scan_and_before_one_task(make: MakeDebug, tmp_path: Path) -> None:
    walker = Walker(tmp_path / "a.run", TASKS, make)
    walker.set(
        Breakpoint(1, "scan", "Ann", scan=9),
        Breakpoint(2, "scan", "Bob", scan=9, log="n is {One.c.n}"),
        Breakpoint(3, "scan", "Cid", scan=9, task="slow"),
        Breakpoint(4, "scan", "Cid", scan=10, task="slow"),
    )
    walker.run()
    assert (walker.here, walker.halt.breakpoints, walker.halt.task) == ((9, 1), (1,), "Fast")
    assert [text for *_, text in walker.heard.logs] == ["n is 9"]
    walker.step("continue")
    assert (walker.here, walker.halt.breakpoints, walker.halt.task) == ((9, 3), (3,), "Slow")
    walker.step("continue")
    assert (walker.debugger.halt, len(walker.heard.logs)) == (None, 1)
    assert [each.hits for each in walker.debugger.verdicts] == [1, 1, 1, 0], "Slow does not run in scan 10"


def test_an_instance_of_a_function_is_the_one_that_called_it(walker: Walker) -> None:
    (verdict,) = walker.set(line(4, instance="Main.b"))
    assert verdict.verified, verdict.message
    for scan in (0, 1):
        walker.run(5)
        assert (walker.halt.scan, walker.halt.pou) == (scan, "Twice")
        assert walker.timeline.resource.listening.inside is not None
        assert walker.timeline.resource.listening.inside.frames[1].instance == walker.debugger.placing.place(
            line(13, instance="Main.b"), 0
        ).instance  # fmt: skip
        walker.debugger.step("continue", "Ann")


BY_VALUE = """FUNCTION_BLOCK Fill
{in_out 'value'}
VAR_IN_OUT level : INT; on : BOOL; END_VAR
VAR n : INT; END_VAR
  n := n + 1;
  level := level + 1;
  on := NOT on;
  IF n > 1000 THEN RETURN; END_IF;
  n := n;
  IF n MOD 2 = 1 THEN
    RETURN;
  END_IF;
END_FUNCTION_BLOCK
PROGRAM Main
VAR x, y : INT; w : WORD; f : ARRAY[0..1] OF Fill; END_VAR
  f[1](level := x, on := w.3);
  y := x;
  x := x + 10;
  y := y;
END_PROGRAM
"""


@pytest.mark.parametrize("convention", ["value", "reference"])
@pytest.mark.parametrize(
    ("access", "path", "lines"),
    [("write", "level", [7, 19]), ("change", "level", [7, 19]), ("read", "level", [7, 18, 19]), ("change", "on", [8])],
)
def test_an_in_out_is_watched_where_its_block_works_on_it(
    make: MakeDebug, tmp_path: Path, convention: str, access: str, path: str, lines: list[int]
) -> None:
    walker = Walker(tmp_path / "a.run", BY_VALUE.replace("'value'", f"'{convention}'"), make)
    walker.run(1)
    walker.set(data(f"Main.f[1].{path}", access))
    for expected in 2 * lines:
        walker.run(3)
        assert walker.line == expected
        walker.debugger.step("continue", "Ann")


def test_a_trap_halts_before_the_statement_and_then_traps(make: MakeDebug, tmp_path: Path) -> None:
    source = "PROGRAM Main\nVAR n : DINT := 5; d : DINT; END_VAR\n  n := n - 1;\n  d := 10 / n;\nEND_PROGRAM\n"
    walker = Walker(tmp_path / "a.run", source, make)
    walker.set(Breakpoint(1, "trap", "Ann"))
    walker.run()
    assert (walker.halt.reason, walker.line, walker.here) == ("trap", 4, (4, 2))
    assert value(walker.timeline.resource, "Main.n") == 0
    walker.step("back")
    assert (walker.line, value(walker.timeline.resource, "Main.n")) == (3, 1)
    walker.step("continue")
    assert (walker.line, walker.halt.past) == (4, False)
    walker.submit(Write("Ann", "Main.n", "5"))
    walker.debugger.step("continue", "Ann")
    walker.run(3)
    assert walker.timeline.resource.runnable, "what was written before it saved the program"
    walker.debugger.step("continue", "Ann")
    walker.run()
    assert walker.halt.reason == "trap"
    walker.debugger.step("continue", "Ann")
    assert walker.run() is None
    assert walker.timeline.resource.header.halted_by_trap
    walker.step("back")
    assert (walker.line, walker.halt.past) == (4, True), "back from a trap is before the statement that trapped"


def test_disabled_ones_cost_nothing_and_groups_are_independent(walker: Walker) -> None:
    walker.set(line(25))
    walker.run()
    assert walker.debugger.flavour == "debug"
    walker.set(line(25, condition="n < 0"))
    walker.debugger.step("continue", "Ann")
    assert walker.run(1) is None
    assert walker.debugger.flavour == "debug"
    walker.set(line(25, enabled=False))
    assert walker.debugger.flavour == ""
    assert walker.run(5) is None
    assert walker.debugger.flavour == ""
    walker.debugger.set("tool", None, None, (Breakpoint(7, "line", "Tool", group="tool", file="main.st", line=26),))
    walker.set()
    halt = walker.run()
    assert halt is not None
    assert halt.breakpoints == (7,)
    walker.debugger.set("tool", "line", "main.st", ())
    walker.debugger.step("continue", "Ann")
    assert walker.run(5) is None
    assert walker.debugger.flavour == ""


def test_breakpoints_find_their_place_in_the_next_program(walker: Walker) -> None:
    walker.set(line(25), data("Main.sum"))
    walker.run()
    assert to_program(walker.timeline, 2, "") == ""
    walker.fit()
    walker.debugger.moved()
    gone, lost = walker.debugger.verdicts
    assert not gone.verified
    assert not lost.verified
    assert "Main" in lost.message


def test_places_are_found_without_an_engine(tmp_path: Path) -> None:
    walker = Walker(tmp_path / "a.run")
    (verdict,) = walker.set(line(5, enabled=False))
    assert verdict.verified
    assert to_program(walker.timeline, 2, STATIONS) == ""
    walker.debugger.moved()
    assert walker.debugger.verdicts[0].verified
    assert walker.run(5) is None
    assert walker.timeline.live.debug is None, "whoever has a native one can put it in place yet"


def test_what_needs_the_seam_lets_the_scan_end_first(walker: Walker) -> None:
    walker.set(line(26))
    walker.run()
    scan = walker.halt.scan
    entry = walker.submit(Restart("Bob", "cold"))
    assert (entry.scan, entry.step, walker.here) == (scan + 1, 0, (scan + 1, 0))
    assert not isinstance(walker.debugger.step("over", "Ann"), Refusal)
    halt = walker.run()
    assert halt is not None
    assert (halt.scan, halt.count) == (scan + 1, 1)
