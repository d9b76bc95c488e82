"""Traces on a PLC: triggers to the scan, rings, programs that change; the same on both engines."""

from dataclasses import replace

import pytest

from scanbench.engines.engine import Reason
from scanbench.runtime.programs import EngineFactory
from scanbench.runtime.resource import Resource
from scanbench.taps.trace import BadTrace, Trace, TraceDefinition, TraceTrigger, check_definition
from tests.runtime.bench import ENGINES, change, plc, program

SOURCE = """
PROGRAM Main
VAR n : DINT; a : INT; on : BOOL; r : REAL; color : (RED, GREEN, BLUE); END_VAR
  n := n + 1; a := DINT_TO_INT(n MOD 100); on := n MOD 10 >= 7; r := DINT_TO_REAL(n) / 2.0;
END_PROGRAM
"""
PLAIN = TraceDefinition("T", ("Main.n", "Main.on", "Main.r"), scans=100)
engines = pytest.mark.parametrize("engine", ENGINES, ids=["reference", "native"])


class Bench:
    """One PLC with one trace, as the host runs them."""

    def __init__(self, definition: TraceDefinition, engine: EngineFactory = ENGINES[0], source: str = SOURCE) -> None:
        self.plc: Resource = plc(source, engine)
        self.trace = Trace(1, definition, "Ada")
        self.trace.define(definition, self.plc.program, "Ada")

    def start(self) -> None:
        self.trace.start(self.plc.program, self.scan)
        self.plc.waiting.samplings = self.trace.samplings

    @property
    def scan(self) -> int:
        return self.plc.header.scan

    def run(self, scans: int, at_once: int = 40) -> None:
        """So many scans, drained as often as the host does it or more seldom."""
        end = self.scan + scans
        while self.scan < end:
            assert self.plc.run(min(at_once, end - self.scan)).reason in (Reason.DONE, Reason.INTERRUPTED)
            self.trace.drain(self.scan)
            self.plc.waiting.samplings = self.trace.samplings

    def become(self, source: str) -> None:
        """Another program, as the host puts it in place."""
        change(self.plc, program(source))
        self.trace.drain(self.scan)
        self.trace.aim(self.plc.program, self.scan)
        self.plc.waiting.samplings = self.trace.samplings

    def choose(self, *signals: str) -> None:
        """Other signals, as the host takes them over."""
        self.trace.choose(replace(self.trace.definition, signals=signals), self.plc.program, self.scan, "Ada")
        self.plc.waiting.samplings = self.trace.samplings

    def scans(self) -> list[int]:
        found: list[int] = self.trace.buffer.read(0, 1 << 40).scans.tolist()
        return found


def triggered(text: str, when: str, value: str = "", before: int = 50, **more: object) -> TraceDefinition:
    return replace(PLAIN, trigger=TraceTrigger(text, when, value, before), **more)  # type: ignore[arg-type]


@engines
def test_without_a_trigger_the_last_scans_are_there(engine: EngineFactory) -> None:
    bench = Bench(PLAIN, engine)
    bench.run(30)
    assert bench.scans() == []
    bench.start()
    bench.run(250)
    assert bench.trace.state == "recording"
    assert bench.scans() == list(range(180, 280))
    bench.trace.stop()
    bench.plc.waiting.samplings = bench.trace.samplings
    bench.run(20)
    assert (bench.trace.state, bench.scans()[-1]) == ("stopped", 279)


@engines
@pytest.mark.parametrize("at_once", [1, 13, 5000])
@pytest.mark.parametrize(
    ("text", "when", "value", "scan"),
    [
        ("Main.on", "rises", "", 16), ("Main.on", "falls", "", 19), ("Main.on", "changes", "", 16),
        ("Main.n", "above", "40", 40), ("Main.n", "below", "50", 12), ("Main.n", "equals", "33", 32),
        ("Main.n", "rises", "60", 59), ("Main.a", "falls", "1", 99), ("Main.r", "above", "20.25", 40),
        ("Main.n > 30 AND Main.on", "holds", "", 36), ("Main.a", "changes", "", 13), ("Main.n > 5", "holds", "", 12),
    ],
)  # fmt: skip
def test_a_trigger_is_found_to_the_scan(
    engine: EngineFactory, text: str, when: str, value: str, scan: int, at_once: int
) -> None:
    bench = Bench(triggered(text, when, value, before=20), engine)
    bench.run(12)
    bench.start()
    assert bench.trace.state == "armed"
    bench.run(400, at_once)
    assert (bench.trace.state, bench.trace.triggered) == ("complete", scan)
    assert bench.scans() == list(range(max(12, scan - 20), scan + 80))


@engines
def test_a_trigger_between_samples_is_still_exact(engine: EngineFactory) -> None:
    bench = Bench(triggered("Main.n", "equals", "58", every=10, scans=200), engine)
    bench.start()
    bench.run(400)
    assert (bench.trace.triggered, bench.trace.state) == (57, "complete")
    assert bench.scans() == [scan for scan in range(300) if scan % 10 == 0 and scan < 58 + 90]


@engines
def test_all_before_and_all_after(engine: EngineFactory) -> None:
    for before, expected in ((0, range(299, 399)), (100, range(200, 300)), (50, range(249, 349))):
        bench = Bench(triggered("Main.n", "equals", "300", before=before), engine)
        bench.start()
        bench.run(1000)
        assert bench.scans() == list(expected)
        assert 299 in bench.scans()


def test_armed_again_by_itself_shows_the_last_complete_record() -> None:
    bench = Bench(triggered("Main.a", "rises", "50", scans=40, repeat=True))
    bench.start()
    bench.run(60)
    assert (bench.trace.state, bench.trace.triggered, bench.trace.hits) == ("triggered", 49, 1)
    bench.run(30)
    first = bench.trace.generation
    assert (bench.trace.state, bench.trace.triggered) == ("armed", 49)
    assert bench.scans() == list(range(29, 69))
    bench.run(65)
    assert (bench.trace.state, bench.trace.triggered, bench.trace.hits) == ("triggered", 49, 2)
    assert bench.scans() == list(range(29, 69))
    bench.run(1000, at_once=5000)
    assert bench.trace.hits == 12
    assert bench.trace.triggered is not None
    assert bench.trace.triggered % 100 == 49
    assert bench.scans() == list(range(bench.trace.triggered - 20, bench.trace.triggered + 20))
    assert bench.trace.generation > first


def test_the_program_is_changed_and_what_is_known_goes_on() -> None:
    bench = Bench(PLAIN)
    bench.start()
    bench.run(30)
    new = SOURCE.replace("r : REAL;", "").replace("r := DINT_TO_REAL(n) / 2.0;", "")
    bench.become(new)
    bench.run(30)
    assert [bool(each.message) for each in bench.trace.signals] == [False, False, True]
    assert bench.trace.signals[2].type == "REAL"
    found = bench.trace.buffer.read(0, 1000)
    assert found.scans.tolist() == list(range(60))
    assert found.valid.tolist() == [7] * 30 + [3] * 30
    change(bench.plc, program(SOURCE.replace("on : BOOL", "on : BOOL; extra : INT")), version=3)
    bench.trace.aim(bench.plc.program, bench.scan)
    bench.plc.waiting.samplings = bench.trace.samplings
    bench.run(5)
    assert bench.trace.buffer.read(60, 1000).valid.tolist() == [7] * 5


def test_a_signal_of_a_different_type_begins_again_and_says_so() -> None:
    bench = Bench(PLAIN)
    bench.start()
    bench.run(30)
    change(bench.plc, program(SOURCE.replace("r : REAL;", "r : LREAL;").replace("DINT_TO_REAL", "DINT_TO_LREAL")))
    before = bench.trace.generation
    bench.trace.aim(bench.plc.program, bench.scan)
    bench.plc.waiting.samplings = bench.trace.samplings
    bench.run(10)
    assert bench.trace.generation == before + 1
    assert "Main.r has a different type" in bench.trace.note
    assert bench.scans() == list(range(30, 40))


def test_samplings_of_a_different_program_never_run() -> None:
    bench = Bench(PLAIN)
    bench.start()
    change(bench.plc, program(SOURCE.replace("VAR n", "VAR first : ARRAY [0..99] OF LINT; n")))
    bench.run(20)
    assert bench.scans() == []


def test_an_enumeration_keeps_its_names() -> None:
    bench = Bench(replace(PLAIN, signals=("Main.color",)))
    assert bench.trace.signals[0].values == (("RED", 0), ("GREEN", 1), ("BLUE", 2))


@pytest.mark.parametrize(
    ("definition", "word"),
    [
        (replace(PLAIN, name=" "), "name"), (replace(PLAIN, signals=()), "0 signals"),
        (replace(PLAIN, signals=tuple(f"Main.n + {k}" for k in range(65))), "65 signals"),
        (replace(PLAIN, every=0), "Every 0"), (replace(PLAIN, scans=1), "buffer of 1"),
        (replace(PLAIN, scans=10, every=20), "buffer of 10"), (triggered("Main.n", "jumps"), "jumps"),
        (triggered("Main.on", "rises", before=101), "101 %"), (triggered("Main.n", "above"), "needs a value"),
        (replace(PLAIN, repeat=True), "trigger"),
    ],
)  # fmt: skip
def test_bounds(definition: TraceDefinition, word: str) -> None:
    with pytest.raises(BadTrace, match=word):
        check_definition(definition)


@pytest.mark.parametrize(
    ("definition", "word"),
    [
        (replace(PLAIN, signals=("Main.m",)), "no member `m`"), (replace(PLAIN, signals=("Main",)), "Main"),
        (triggered("Main.n", "rises"), "value that it has to cross"), (triggered("Main.n", "holds"), "compare"),
        (triggered("Main.x", "rises"), "Trigger"), (triggered("Main.n", "above", "abc"), "abc"),
        (triggered("Main.n", "above", "1) OR (Main.on"), "Trigger"),
    ],
)  # fmt: skip
def test_what_the_program_does_not_know(definition: TraceDefinition, word: str) -> None:
    trace = Trace(1, definition, "Ada")
    with pytest.raises(BadTrace, match=word):
        trace.define(definition, plc(SOURCE).program, "Ada")


def test_other_signals_leave_what_was_recorded_of_those_that_stay() -> None:
    bench = Bench(PLAIN)
    bench.start()
    bench.run(30)
    before = bench.trace.buffer.read(0, 1000)
    bench.choose("Main.a", "Main.r", "Main.n")
    bench.run(20)
    found = bench.trace.buffer.read(0, 1000)
    assert found.scans.tolist() == list(range(50))
    assert found.valid.tolist() == [0b110] * 30 + [0b111] * 20
    assert found.values[0].tolist()[30:] == list(range(31, 51))
    assert found.values[1].tolist()[:30] == before.values[2].tolist()
    assert found.values[2].tolist() == list(range(1, 51))
    assert [each.text for each in bench.trace.signals] == ["Main.a", "Main.r", "Main.n"]
    states = [bench.trace.state]
    bench.trace.stop()
    bench.choose("Main.n", "Main.on")
    states.append(bench.trace.state)
    assert states == ["recording", "stopped"]
    assert bench.trace.buffer.read(0, 1000).valid.tolist() == [0b01] * 50


def test_other_signals_leave_the_trigger_and_the_record_that_is_shown() -> None:
    bench = Bench(triggered("Main.a", "rises", "50", scans=40, repeat=True))
    bench.start()
    bench.run(110)
    shown = bench.scans()
    bench.choose("Main.n", "Main.a")
    assert (bench.trace.state, bench.trace.hits, bench.trace.triggered) == ("armed", 1, 49)
    assert bench.scans() == shown
    bench.run(60)
    assert (bench.trace.hits, bench.trace.triggered) == (2, 149)
    found = bench.trace.buffer.read(0, 1000)
    assert found.scans.tolist() == list(range(129, 169))
    assert found.values[1].tolist() == [(scan + 1) % 100 for scan in range(129, 169)]


def test_a_change_while_it_is_triggered_does_not_end_a_repeating_trace() -> None:
    bench = Bench(triggered("Main.a", "rises", "50", scans=40, repeat=True))
    bench.start()
    bench.run(55)
    assert (bench.trace.state, bench.trace.hits) == ("triggered", 1)
    bench.become(SOURCE.replace("VAR n", "VAR first : LREAL; n"))
    bench.run(1000)
    assert bench.trace.hits == 11
    assert bench.trace.triggered is not None
    assert bench.trace.triggered % 100 == 49
    assert bench.scans() == list(range(bench.trace.triggered - 20, bench.trace.triggered + 20))


def test_an_edge_at_a_change_is_one() -> None:
    bench = Bench(triggered("Main.n > 20", "rises", scans=40))
    bench.start()
    bench.run(20)
    bench.become(SOURCE.replace("VAR n", "VAR first : LREAL; n"))
    bench.run(60)
    assert bench.trace.triggered == 20


@pytest.mark.parametrize("at", [30, 55])
def test_a_trigger_that_has_no_meaning_any_more_is_waited_for_no_more(at: int) -> None:
    bench = Bench(triggered("Main.a", "rises", "50", scans=40, repeat=True))
    bench.start()
    bench.run(at)
    bench.become(SOURCE.replace("a : INT;", "").replace("a := DINT_TO_INT(n MOD 100);", ""))
    bench.run(200)
    assert not bench.trace.running
    assert bench.trace.state == ("stopped" if at < 49 else "complete")
    assert "Trigger" in bench.trace.note
    assert not bench.trace.samplings
    assert bench.scans() == list(range(30) if at < 49 else range(29, 69))
