"""Why `run` comes back: the same reasons from each engine."""

import os
import signal
import threading
import time
from collections.abc import Callable

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scanbench.check.typed.condition import Condition, compile_condition
from scanbench.engines.engine import Engine, Pace, Reason, Stop
from scanbench.engines.interpreter.engine import ReferenceEngine
from scanbench.engines.native.engine import NativeEngine
from scanbench.engines.pair import Differs, PairEngine
from scanbench.program.layout import Layout
from scanbench.program.program import Program
from tests.amounts import amount
from tests.engines.native.plc import check

COUNT = "PROGRAM Main VAR n : DINT; a : INT; END_VAR n := n + 1; a := DINT_TO_INT(n * 7 MOD 11); END_PROGRAM"
TRAPS = "PROGRAM Main VAR n, a : INT; END_VAR n := n + 1; a := 1 / (3 - n); END_PROGRAM"
ENGINES: list[Callable[[Program, bytearray], Engine]] = [NativeEngine, ReferenceEngine, PairEngine]

engines = pytest.mark.parametrize("make", ENGINES, ids=["native", "reference", "both"])


def condition(program: Program, text: str) -> Condition:
    made = compile_condition(program, text)
    assert isinstance(made, Condition), made
    return made


def scan(memory: bytearray) -> int:
    return int.from_bytes(memory[Layout.SCAN : Layout.SCAN + 8], "little")


def ask(memory: bytearray) -> None:
    """Has the program ask for something in every scan: a force sets the count after the point at which it is cleared."""
    memory[Layout.FORCE_COUNT : Layout.FORCE_COUNT + 4] = (1).to_bytes(4, "little")
    memory[Layout.FORCES : Layout.FORCES + 8] = Layout.ASKED_COUNT.to_bytes(4, "little") + bytes([0xFF, 1, 0, 0])


@engines
def test_a_condition_ends_every_run_until_it_is_taken_away(make: Callable[[Program, bytearray], Engine]) -> None:
    program = check(COUNT)
    memory = bytearray(program.initial_image)
    engine = make(program, memory)
    engine.stop_when(condition(program, "Main.n >= 5"))
    assert (engine.run(100), scan(memory)) == (Stop(Reason.CONDITION), 5)
    assert (engine.run(100), scan(memory)) == (Stop(Reason.CONDITION), 6)
    engine.stop_when(condition(program, "Main.n = 3"))
    assert (engine.run(10), scan(memory)) == (Stop(Reason.DONE), 16)
    engine.stop_when(None)
    assert (engine.run(10), scan(memory)) == (Stop(Reason.DONE), 26)


def test_both_keeps_the_temporaries_of_the_engines_apart() -> None:
    program = check(
        "FUNCTION F : DINT VAR a, b : DINT; END_VAR a := 1; b := 2; F := a + b; END_FUNCTION\n"
        "PROGRAM Main VAR n : DINT; END_VAR n := n + 1; IF n < 0 THEN n := F(); END_IF; END_PROGRAM"
    )
    assert program.layout.size > program.layout.state_size
    pair = PairEngine(program, bytearray(program.initial_image))
    pair.memory[-1], pair.shadow[-1] = 9, 7  # in the frame of F, which is not called
    assert pair.run(3) == Stop(Reason.DONE)
    assert (pair.memory[-1], pair.shadow[-1]) == (9, 7)


@engines
def test_a_condition_that_holds_after_the_last_scan_is_told(make: Callable[[Program, bytearray], Engine]) -> None:
    program = check(COUNT)
    memory = bytearray(program.initial_image)
    engine = make(program, memory)
    engine.stop_when(condition(program, "Main.n = 5"))
    assert engine.run(5) == Stop(Reason.CONDITION)


@engines
def test_what_is_asked_for_ends_a_run_but_the_condition_comes_before_it(
    make: Callable[[Program, bytearray], Engine],
) -> None:
    program = check(COUNT)
    memory = bytearray(program.initial_image)
    engine = make(program, memory)
    engine.stop_when(condition(program, "Main.n = 2"))
    ask(memory)
    assert (engine.run(5), scan(memory)) == (Stop(Reason.ASKED), 1)
    assert (engine.run(5), scan(memory)) == (Stop(Reason.CONDITION), 2)
    assert (engine.run(5), scan(memory)) == (Stop(Reason.ASKED), 3)


@engines
def test_a_trap_comes_before_the_condition(make: Callable[[Program, bytearray], Engine]) -> None:
    program = check(TRAPS)
    memory = bytearray(program.initial_image)
    engine = make(program, memory)
    engine.stop_when(condition(program, "Main.n = 3"))
    assert (engine.run(5).reason, scan(memory)) == (Reason.TRAP, 2)


@engines
def test_at_a_pace_and_measured_as_a_whole(make: Callable[[Program, bytearray], Engine]) -> None:
    program = check(COUNT)
    memory = bytearray(program.initial_image)
    engine = make(program, memory)
    engine.stop_when(condition(program, "Main.n MOD 4 = 0"))
    for pace in (Pace(1000, 0), Pace(0, 0)):
        assert engine.run(100, pace).reason is Reason.CONDITION
        assert pace.scans == 4


@engines
def test_an_interrupt_comes_back_once(make: Callable[[Program, bytearray], Engine]) -> None:
    program = check(COUNT)
    memory = bytearray(program.initial_image)
    engine = make(program, memory)
    engine.interrupt()
    assert (engine.run(5), scan(memory)) == (Stop(Reason.INTERRUPTED), 0)
    assert (engine.run(5), scan(memory)) == (Stop(Reason.DONE), 5)


@engines
def test_a_scan_that_began_after_the_next_was_due_is_late(make: Callable[[Program, bytearray], Engine]) -> None:
    program = check(COUNT)
    engine = make(program, bytearray(program.initial_image))
    now = time.monotonic_ns()
    stalled = 60_000_000_000
    pace = Pace(1_000_000_000, now - stalled)  # this one is moved to now, so the next is not due yet
    engine.run(1, pace)
    assert (pace.late_scans, pace.scans) == (1, 1)
    assert pace.deadline_ns >= now + pace.period_ns
    assert pace.worst_ns == pace.late_ns == pace.deadline_ns - pace.period_ns - (now - stalled), "a stall is not hidden"
    never = Pace(0, 0)
    engine.run(3, never)
    assert (never.late_scans, never.scans) == (0, 3)


def test_other_code_of_the_same_program_takes_the_condition_over() -> None:
    program = check(COUNT)
    memory = bytearray(program.initial_image)
    made = condition(program, "Main.n >= 5")
    quick = NativeEngine(program, memory, 0)
    quick.stop_when(made)
    assert quick.run(3) == Stop(Reason.DONE)
    fast = NativeEngine(program, memory, 2)
    fast.stop_when(made)
    assert (fast.run(100), scan(memory)) == (Stop(Reason.CONDITION), 5)


def test_both_engines_must_agree_on_the_condition() -> None:
    program = check(COUNT)
    engine = PairEngine(program, bytearray(program.initial_image))
    engine.stop_when(condition(program, "Main.n = 3"))
    engine.reference.stop_when(condition(program, "Main.n = 4"))
    with pytest.raises(Differs, match="native found that the condition holds, reference went on"):
        engine.run(10)


PROGRAM = check(COUNT)


@settings(max_examples=amount(60, 10), deadline=None)
@given(
    st.sampled_from(["=", "<>", "<", ">="]),
    st.integers(-3, 12),
    st.sampled_from(["AND", "OR", "XOR"]),
    st.integers(0, 30),
)
def test_native_and_reference_stop_at_the_same_scan(op: str, a: int, join: str, n: int) -> None:
    made = condition(PROGRAM, f"Main.a {op} {a} {join} Main.n / (Main.n - {n}) > 1")
    stopped = []
    for make in (NativeEngine, ReferenceEngine):
        memory = bytearray(PROGRAM.initial_image)
        engine = make(PROGRAM, memory)
        engine.stop_when(made)
        stopped.append((engine.run(40), scan(memory)))
    assert stopped[0] == stopped[1]


@engines
def test_a_forged_force_table_stays_in_the_image(make: Callable[[Program, bytearray], Engine]) -> None:
    """An image may come from a file that somebody has made."""
    program = check(COUNT)
    memory = bytearray(program.layout.size)
    memory[: len(program.initial_image)] = program.initial_image
    memory[Layout.FORCE_COUNT : Layout.FORCE_COUNT + 4] = b"\xff\xff\xff\xff"
    for entry in range(Layout.FORCE_LIMIT):
        at = Layout.FORCES + 8 * entry
        memory[at : at + 8] = (len(memory) + entry * 4096).to_bytes(4, "little") + bytes([0xFF, 0xFF, 0, 0])
    engine = make(program, memory)
    assert engine.run(3) == Stop(Reason.DONE)
    assert scan(memory) == 3


@engines
def test_of_several_conditions_each_ends_the_run_whatever_traps(make: Callable[[Program, bytearray], Engine]) -> None:
    program = check(COUNT)
    texts = ("10 / (Main.n - Main.n) > 0", "Main.n = 4", "Main.n = 9", "10 / (Main.n - 4) > 0 AND Main.n = 6")
    memory = bytearray(program.initial_image)
    engine = make(program, memory)
    made = [condition(program, text) for text in texts]
    engine.stop_when(made[0], *made[1:])
    stops = []
    while engine.run(20 - scan(memory)).reason is Reason.CONDITION:
        stops.append((scan(memory), [engine.holds(each) for each in made]))
    assert stops == [
        (4, [False, True, False, False]), (6, [False, False, False, True]), (9, [False, False, True, False]),
    ]  # fmt: skip
    engine.stop_when(None, made[0], condition(program, "Main.n = 25"))
    assert (engine.run(20), scan(memory)) == (Stop(Reason.CONDITION), 25)
    assert engine.holds(condition(program, "Main.n = 25"))


class Woken(Exception):
    """What a signal's handler raises, as Ctrl-C does."""


def test_a_long_native_run_lets_signals_through() -> None:
    """Nobody interrupts: the handler of a signal is called all the same, in the thread that runs."""
    program = check(COUNT)
    memory = bytearray(program.initial_image)
    engine = NativeEngine(program, memory)

    def on_signal(number: int, frame: object) -> None:
        raise Woken

    def send() -> None:
        while scan(memory) == 0:
            pass
        os.kill(os.getpid(), signal.SIGUSR1)

    before = signal.signal(signal.SIGUSR1, on_signal)
    thread = threading.Thread(target=send)
    try:
        thread.start()
        with pytest.raises(Woken):
            engine.run(9_000_000_000)
        assert scan(memory) < 9_000_000_000
    finally:
        thread.join()
        signal.signal(signal.SIGUSR1, before)


def test_a_run_in_slices_is_one_run() -> None:
    program = check(COUNT)
    memory = bytearray(program.initial_image)
    engine = NativeEngine(program, memory)
    assert (engine.run(1_000_003), scan(memory)) == (Stop(Reason.DONE), 1_000_003)
    engine.stop_when(condition(program, "Main.n = 1000500"))
    assert (engine.run(1_000_000), scan(memory)) == (Stop(Reason.CONDITION), 1_000_500)
