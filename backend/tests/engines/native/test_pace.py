"""Pacing and interrupting. A loaded machine may keep a test waiting: where deadlines are compared, the periods are so long that
none of them is moved for that."""

import threading
import time

from scanbench.engines.engine import Pace, Reason, Stop
from scanbench.program.layout import Layout
from tests.engines.native.plc import plc

COUNT = "PROGRAM Main VAR n : DINT; END_VAR n := n + 1; END_PROGRAM"
MS = 1_000_000
HOUR = 3_600_000 * MS


def test_keeps_its_deadlines() -> None:
    made = plc(COUNT)
    start = time.monotonic_ns()
    pace = Pace(2 * MS, start + 5 * MS)
    assert made.engine.run(20, pace) == Stop(Reason.DONE)
    assert time.monotonic_ns() - start >= 5 * MS + 19 * 2 * MS
    assert pace.scans == 20
    assert pace.deadline_ns >= start + 5 * MS + 20 * 2 * MS  # later where it was too late for one
    assert 0 <= pace.late_ns <= 20 * pace.worst_ns
    assert 0 < pace.busy_ns < time.monotonic_ns() - start


def test_what_was_measured_adds_up() -> None:
    made = plc(COUNT)
    pace = Pace(MS, time.monotonic_ns())
    for _ in range(4):
        made.engine.run(3, pace)
    assert pace.scans == 12


def test_a_deadline_long_gone_is_moved() -> None:
    made = plc(COUNT)
    now = time.monotonic_ns()
    pace = Pace(5 * MS, now - 1000 * MS)
    made.engine.run(3, pace)
    assert pace.deadline_ns >= now + 3 * 5 * MS
    assert time.monotonic_ns() - now >= 2 * 5 * MS


def test_a_little_delay_is_made_up() -> None:
    made = plc(COUNT)
    start = time.monotonic_ns() - HOUR
    pace = Pace(HOUR // 5, start)
    made.engine.run(5, pace)
    assert pace.deadline_ns == start + HOUR
    assert pace.worst_ns >= HOUR


def test_an_interrupt_before_the_run_counts_once() -> None:
    made = plc(COUNT)
    made.engine.interrupt()
    assert made.engine.run(5) == Stop(Reason.INTERRUPTED)
    assert made.value("Main.n") == 0
    assert made.engine.run(5) == Stop(Reason.DONE)
    assert made.value("Main.n") == 5


def test_an_interrupt_ends_a_wait() -> None:
    made = plc(COUNT)
    start = time.monotonic_ns()
    timer = threading.Timer(0.03, made.engine.interrupt)
    timer.start()
    pace = Pace(HOUR, start + HOUR)
    assert made.engine.run(5, pace) == Stop(Reason.INTERRUPTED)
    assert pace.deadline_ns == start + HOUR
    timer.join()


def test_an_interrupt_ends_a_run_at_full_speed_and_python_goes_on_meanwhile() -> None:
    made = plc(COUNT)
    timer = threading.Timer(0.03, made.engine.interrupt)
    timer.start()
    assert made.engine.run(1 << 62) == Stop(Reason.INTERRUPTED)
    assert made.value("Main.n") == made.field(Layout.SCAN) & 0xFFFF_FFFF or made.field(Layout.SCAN) > 1 << 31
    timer.join()


def test_without_a_period_the_run_is_measured_as_a_whole() -> None:
    made = plc(COUNT)
    pace = Pace(0, 0)
    start = time.monotonic_ns()
    assert made.engine.run(100_000, pace) == Stop(Reason.DONE)
    assert pace.scans == 100_000
    assert 0 < pace.busy_ns <= time.monotonic_ns() - start
    assert pace.late_ns == 0


def test_a_trap_at_a_pace() -> None:
    made = plc("PROGRAM Main VAR n, a : INT; END_VAR n := n + 1; a := 1 / (3 - n); END_PROGRAM")
    start = time.monotonic_ns() - HOUR
    pace = Pace(HOUR // 5, start)
    assert made.engine.run(10, pace).reason is Reason.TRAP
    assert (pace.scans, pace.deadline_ns) == (2, start + 2 * (HOUR // 5))
