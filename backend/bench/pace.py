"""What the scan loop can do: scans a second, lateness at a pace, what a condition and an interrupt cost.

`python -m bench.pace [--seconds N]`. The sample conveyor on the native engine, in this process, with a journal:
without the process of a host around it, which comes back twenty times a second to take values and checkpoints.
"""

import argparse
import json
import sys
import threading
from dataclasses import asdict, dataclass
from statistics import median
from time import monotonic_ns, perf_counter_ns, thread_time_ns

from scanbench.check.build import check_sources
from scanbench.check.typed.condition import Condition, compile_condition
from scanbench.engines.engine import Engine, Pace, Reason
from scanbench.engines.native.engine import NativeEngine
from scanbench.plcmodel.load import model_named
from scanbench.program.program import Program
from scanbench.runtime.command import Refusal
from scanbench.runtime.programs import Loaded
from scanbench.runtime.resource import Resource
from scanbench.runtime.write import Write
from scanbench.server.samples import samples

SAMPLE = "Conveyor"
PERIODS_MS = (1, 10)
SEAMS = 100
"""Writes that are entered during the run as fast as possible."""
CONDITION = "Main.belt.position < -1.0 AND motor"
"""Never holds, and is looked at after every scan."""
SAMPLES = 5
SCANS = 1_000_000
INTERRUPTS = 100_000
WAKES = 50


@dataclass(frozen=True, slots=True)
class Kept:
    """How well a pace was kept."""

    period_ms: int
    scans: int
    mean_late_us: float
    worst_late_us: float
    late_percent: float
    """Scans that began after the next one was due."""
    cpu_percent: float
    """Of one core."""


@dataclass(frozen=True, slots=True)
class PaceFigures:
    """What was measured."""

    scans_per_second: float
    """As fast as possible, a write in the seam now and then, of wall time."""
    scan_ns: float
    condition_ns: float
    """A scan that a condition is looked at after."""
    interrupt_ns: float
    """The call."""
    wake_us: float
    """From an interrupt until the loop, which slept, has come back."""
    paces: tuple[Kept, ...]

    @property
    def condition_ratio(self) -> float:
        """A scan with a condition to one without."""
        return self.condition_ns / self.scan_ns


def run_pace_bench(seconds: float = 5) -> PaceFigures:
    """Runs all of it; each pace for so many seconds."""
    program = _program()
    loaded = Loaded.make(program, NativeEngine)
    resource = Resource(loaded)
    speed = _speed(resource)
    engine = resource.engine
    condition = compile_condition(program, CONDITION)
    assert isinstance(condition, Condition), condition
    plain, with_condition = [], []
    for _ in range(SAMPLES):
        engine.stop_when(None)
        plain.append(_scan_ns(engine))
        engine.stop_when(condition)
        with_condition.append(_scan_ns(engine))
    engine.stop_when(None)
    paces = tuple(_pace(engine, each, seconds) for each in PERIODS_MS)
    return PaceFigures(speed, median(plain), median(with_condition), _interrupt_ns(engine), _wake_us(engine), paces)


def _program() -> Program:
    sample = next(each for each in samples() if each.name == SAMPLE)
    checked = check_sources(sample.files, model_named(sample.model))
    assert checked.program is not None, "\n".join(map(str, checked.problems))
    return checked.program


def _speed(resource: Resource) -> float:
    """Scans a second, the seams between them included."""
    resource.submit(Write("bench", "start", "TRUE"))
    resource.run(SCANS)
    start = perf_counter_ns()
    for number in range(SEAMS):
        resource.run(SCANS // 10)
        entered = resource.submit(Write("bench", "bufferLevel", str(number % 50)))
        assert not isinstance(entered, Refusal), entered
    return SEAMS * (SCANS // 10) / (perf_counter_ns() - start) * 1e9


def _scan_ns(engine: Engine) -> float:
    start = thread_time_ns()
    stop = engine.run(SCANS)
    assert stop.reason is Reason.DONE, stop
    return (thread_time_ns() - start) / SCANS


def _pace(engine: Engine, period_ms: int, seconds: float) -> Kept:
    pace = Pace(period_ms * 1_000_000, monotonic_ns() + 10_000_000)
    start = thread_time_ns()
    engine.run(max(1, round(seconds * 1000 / period_ms)), pace)
    cpu = thread_time_ns() - start
    return Kept(
        period_ms=period_ms,
        scans=pace.scans,
        mean_late_us=round(pace.late_ns / pace.scans / 1000, 1),
        worst_late_us=round(pace.worst_ns / 1000, 1),
        late_percent=round(100 * pace.late_scans / pace.scans, 3),
        cpu_percent=round(100 * cpu / (pace.scans * pace.period_ns), 2),
    )


def _interrupt_ns(engine: Engine) -> float:
    start = perf_counter_ns()
    for _ in range(INTERRUPTS):
        engine.interrupt()
    spent = perf_counter_ns() - start
    engine.run(1)  # takes the interrupt
    return round(spent / INTERRUPTS, 1)


def _wake_us(engine: Engine) -> float:
    """The median, with a second thread that interrupts a loop that would sleep for long."""
    taken = []
    for _ in range(WAKES):
        interrupted = [0]

        def interrupt(at: list[int] = interrupted) -> None:
            at[0] = perf_counter_ns()
            engine.interrupt()

        timer = threading.Timer(0.005, interrupt)
        timer.start()
        engine.run(1, Pace(60_000_000_000, monotonic_ns() + 60_000_000_000))
        taken.append(perf_counter_ns() - interrupted[0])
        timer.join()
    return round(median(taken) / 1000, 1)


def report(figures: PaceFigures) -> str:
    """The figures for people."""
    lines = [
        f"as fast as possible   {figures.scans_per_second:,.0f} scans a second, {figures.scan_ns:.1f} ns each",
        f"with a condition      {figures.condition_ratio:.2f} of a scan without",
        f"an interrupt          {figures.interrupt_ns:.0f} ns; {figures.wake_us:.0f} us until a sleeping loop is back",
    ]
    lines += [
        f"every {each.period_ms:2} ms           {each.mean_late_us:.0f} us late in the mean, {each.worst_late_us:.0f} us at worst, "
        f"{each.late_percent:.2f} % too late, {each.cpu_percent:.1f} % of a core"
        for each in figures.paces
    ]
    return "\n".join(lines)


def main() -> None:
    """Prints the figures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=5)
    parser.add_argument("--json", action="store_true")
    given = parser.parse_args()
    figures = run_pace_bench(given.seconds)
    said = (
        json.dumps({**asdict(figures), "condition_ratio": figures.condition_ratio}) if given.json else report(figures)
    )
    sys.stdout.write(said + "\n")


if __name__ == "__main__":
    main()
