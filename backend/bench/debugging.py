"""What debugging costs: a scan with one breakpoint that is never hit, and what swapping the code takes.

`python -m bench.debugging [PROGRAM...] [--json]`. All figures of a program come from one run, samples taken in turn, and
are ratios to its run flavour. The breakpoint is where it costs most, in the statement that runs most often, with a condition
that is never true; and in a statement that never runs, as in an IF that is not taken.
"""

import argparse
import json
import sys
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from time import perf_counter_ns, thread_time_ns
from typing import TypeVar

from bench.large import UNITS
from bench.run import PROGRAMS, BenchError, checked_program
from scanbench.check.build import check_sources
from scanbench.check.typed.local import Local, Locals
from scanbench.engines.cache import BlobCache
from scanbench.engines.debug import DebugEngine, Listen
from scanbench.engines.engine import Engine, Reason
from scanbench.engines.interpreter.evaluate import Evaluator
from scanbench.engines.native.compiler import Compiler
from scanbench.engines.native.debugged import DebugBuilds, debug_engine
from scanbench.engines.native.engine import NativeEngine
from scanbench.engines.native.probed import ProbedBuilds, probed_engine
from scanbench.engines.probe import Probe
from scanbench.plcmodel.load import model_named
from scanbench.program.program import Pou, Program
from scanbench.program.types import Elementary, Kind, Record
from scanbench.server.samples import samples
from scanbench.symbols.sites import Sites

T = TypeVar("T")

SAMPLE = "Conveyor"
SAMPLES = 7
SAMPLE_S = 0.03
WARM_UP = 200
LISTENED = 20
"""Scans in which it is found out what runs how often."""
SWAPS = 5


@dataclass(frozen=True, slots=True)
class Costs:
    """ns of a scan of the run flavour, and ratios to that."""

    run_ns: float
    loaded: float
    """The run flavour again, with a debug engine at hand that is not in use."""
    probed_hot: float
    """A breakpoint in the statement that runs most often, whose condition is never true."""
    probed_cold: float | None
    """One in a statement that does not run, or hardly ever; None where there is none."""
    debug_hot: float
    """The same in the debug flavour, where Python looks at the condition."""
    debug_cold: float | None


@dataclass(frozen=True, slots=True)
class Swaps:
    """ms: the pauses in the seam where all is ready, and the work before that, while the program runs."""

    debug_pause: float
    debug_build: float
    probed_pause: float
    probed_build: float
    """The code of the run flavour is kept; the module of the probe is compiled again."""


@dataclass(frozen=True, slots=True)
class _Places:
    """The places of the breakpoints, each with a condition that is never true there."""

    hot: int
    hot_condition: Local
    cold: int | None
    cold_condition: Local


def measure_costs(program: Program) -> Costs:
    """What a breakpoint costs while the program runs."""
    places, code = _places(program), DebugBuilds().objects(program)
    memory = bytearray(program.initial_image)
    idle = debug_engine(program, memory, code)

    def probed(site: int, condition: Local) -> Engine:
        return ProbedBuilds().engine(program, bytearray(program.initial_image), [Probe(site, condition.expr)])

    def debugged(site: int, condition: Local) -> Engine:
        memory = bytearray(program.initial_image)
        engine = debug_engine(program, memory, code)
        engine.hook(_Condition(engine, Evaluator(program, memory).condition(condition)))
        engine.listen(Listen(sites=frozenset({site})))
        return engine

    engines = [
        NativeEngine(program, bytearray(program.initial_image)), NativeEngine(program, memory),
        probed(places.hot, places.hot_condition), debugged(places.hot, places.hot_condition),
    ]  # fmt: skip
    if places.cold is not None:
        engines += [probed(places.cold, places.cold_condition), debugged(places.cold, places.cold_condition)]
    ns = _in_turn(engines)
    del idle
    loaded, probed_hot, debug_hot, *cold = (round(each / ns[0], 3) for each in ns[1:])
    probed_cold, debug_cold = cold or (None, None)
    return Costs(round(ns[0], 1), loaded, probed_hot, probed_cold, debug_hot, debug_cold)


def measure_swaps(program: Program) -> Swaps:
    """What it takes to put a different flavour in place."""
    places = _places(program)
    probes = [Probe(places.hot, places.hot_condition.expr)]
    memory = bytearray(program.initial_image)
    code, debug_build = _timed(lambda: DebugBuilds().objects(program))
    with TemporaryDirectory() as directory:
        cache = BlobCache(Path(directory))
        Compiler(cache).build(program)
        objects, probed_build = _timed(lambda: ProbedBuilds(cache).objects(program, probes))
    assert objects is not None
    debug_pauses = [_timed(lambda: debug_engine(program, memory, code))[1] for _ in range(SWAPS)]
    probed_pauses = [_timed(lambda: probed_engine(program, memory, probes, objects))[1] for _ in range(SWAPS)]
    return Swaps(median(debug_pauses), debug_build, median(probed_pauses), probed_build)


def _timed(make: Callable[[], T]) -> tuple[T, float]:
    start = perf_counter_ns()
    made = make()
    return made, round((perf_counter_ns() - start) / 1e6, 1)


def _in_turn(engines: list[Engine]) -> list[float]:
    """Medians of ns per scan."""
    scans = [_scans(engine) for engine in engines]
    samples: list[list[float]] = [[] for _ in engines]
    for _ in range(SAMPLES):
        for taken, engine, count in zip(samples, engines, scans, strict=True):
            taken.append(_run(engine, count) / count)
    return [median(taken) for taken in samples]


def _scans(engine: Engine) -> int:
    """How many take as long as a sample."""
    _run(engine, WARM_UP)
    scans = 1
    while (spent := _run(engine, scans)) < SAMPLE_S * 0.2e9:
        scans *= 2
    return max(1, int(scans * SAMPLE_S * 1e9 / spent))


def _run(engine: Engine, scans: int) -> int:
    start = thread_time_ns()
    stop = engine.run(scans)
    spent = thread_time_ns() - start
    if stop.reason is not Reason.DONE:
        raise BenchError(f"the program stopped: {stop}")
    return spent


# ---- the places of breakpoints --------------------------------------------------------------------------------------


class _Hook:
    def access(self, site: int, count: int, offset: int, size: int, written: bool) -> None:
        raise AssertionError("no byte is listened for")


class _Counting(_Hook):
    """Counts how often each statement begins."""

    def __init__(self) -> None:
        self.counts: Counter[int] = Counter()

    def statement(self, site: int, count: int, depth: int) -> bool:
        self.counts[site] += 1
        return False


class _Condition(_Hook):
    """Halts where a condition holds, as the debugger does."""

    def __init__(self, engine: DebugEngine, holds: Callable[[int], bool]) -> None:
        self._engine, self._holds = engine, holds

    def statement(self, site: int, count: int, depth: int) -> bool:
        return self._holds(self._engine.frames()[0].instance)


def _places(program: Program) -> _Places:
    engine = DebugBuilds().engine(program, bytearray(program.initial_image))
    counting = _Counting()
    engine.hook(counting)
    engine.listen(Listen(every=True))
    engine.run(LISTENED)
    engine.listen(Listen())
    engine.run(WARM_UP)
    reached = engine.observer.take().reached
    hot = counting.counts.most_common(1)[0][0]
    cold = next((site for site in range(len(engine.sites.statements)) if site not in reached), None)
    hot_condition = _never(program, engine.sites, hot)
    return _Places(hot, hot_condition, cold, hot_condition if cold is None else _never(program, engine.sites, cold))


def _never(program: Program, sites: Sites, site: int) -> Local:
    """A condition on a variable of the statement's POU that is never true, which no compiler can know."""
    pou = next(pou for pou, inside in sites.bodies.items() if site in inside)
    conditions = (Locals(program).condition(pou, text) for text in _texts(pou, program))
    found = next((each for each in conditions if isinstance(each, Local)), None)
    if found is None:
        raise BenchError(f"{pou.name} has no number that a condition could look at")
    return found


def _texts(pou: Pou, program: Program) -> Iterator[str]:
    for record in (pou.frame, pou.instance):
        yield from _of_record(record, "")
    for each in program.shown:
        yield from _of_record(each.pou.instance, f"{each.name}.")


def _of_record(record: Record, prefix: str) -> Iterator[str]:
    for member in record.members.values():
        name, type = f"{prefix}{member.name}", member.type
        if isinstance(type, Record):
            yield from _of_record(type, f"{name}.")
        elif isinstance(type, Elementary) and not member.hidden:
            if type.kind is Kind.INT and type.signed:
                yield f"{name} = {-(1 << type.bits - 1)}"
            elif type.kind is Kind.REAL:
                yield f"{name} = 1.25E30"


# ---- the whole ------------------------------------------------------------------------------------------------------


def conveyor() -> Program:
    """The sample."""
    sample = next(each for each in samples() if each.name == SAMPLE)
    checked = check_sources(sample.files, model_named(sample.model))
    assert checked.program is not None
    return checked.program


def main() -> None:
    """Prints the figures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "programs", nargs="*", metavar="PROGRAM", help=f"{SAMPLE}, {', '.join(PROGRAMS)}; all by default"
    )
    parser.add_argument("--json", action="store_true")
    given = parser.parse_args()
    figures: dict[str, dict[str, float | None]] = {}
    for name in given.programs or [SAMPLE, *PROGRAMS]:
        program = conveyor() if name == SAMPLE else checked_program(name)[0]
        figures[name] = asdict(measure_costs(program))
        if name in UNITS:
            figures[name] |= asdict(measure_swaps(program))
        if not given.json:
            shown = ", ".join(f"{key} {value}" for key, value in figures[name].items())
            sys.stdout.write(f"{name:16} {shown}\n")
            sys.stdout.flush()
    if given.json:
        sys.stdout.write(json.dumps(figures) + "\n")


if __name__ == "__main__":
    main()
