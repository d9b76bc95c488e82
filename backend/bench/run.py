"""Speed of the native engine compared with C written by hand, measured in the same run by the same method.

Both run the program 2,000 scans first and must then agree on its checksum `chk`. Time is thread CPU time, as the machine
may have other things to do; samples of the two alternate, and medians of five are compared.
"""

import re
import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from time import perf_counter_ns, thread_time_ns
from typing import TypedDict

from bench.building import measure_building
from bench.interpreter import statements_per_second
from bench.large import UNITS, large
from bench.peers import peer_ratios
from scanbench.check.build import check_sources
from scanbench.engines.engine import Engine, Reason
from scanbench.engines.native.engine import NativeEngine
from scanbench.engines.native.observed import ObservedBuilds
from scanbench.plcmodel.load import model_named
from scanbench.program.program import Program
from scanbench.symbols.symbols import resolve

HERE = Path(__file__).parent
PROGRAMS = ("noop", "bool", "arith", "array", "mavg", "state", "string", "string_unrolled", *UNITS)
MODEL = "GENERIC-IEC"
INTERVAL_NS = 1_000_000
WARM_UP = 2000
SAMPLES = 5
SAMPLE_S = 0.05

Row = dict[str, float | None]


class Result(TypedDict):
    """Of each program the time of a scan, the ratios of peers to C and the time of its build; and the speed of the interpreter."""

    programs: dict[str, Row]
    peers: dict[str, dict[str, float]]
    compile: dict[str, Row]
    building: dict[str, dict[str, float]]
    interpreter_per_second: float | None


class BenchError(Exception):
    """The bench cannot be run, or a program computes something else than its C twin."""


@dataclass(slots=True)
class _Native:
    """A program under measurement on the native engine."""

    engine: Engine
    chk: int
    scans: int
    """In one sample."""

    def sample(self) -> float:
        start = thread_time_ns()
        stop = self.engine.run(self.scans)
        spent = thread_time_ns() - start
        if stop.reason is not Reason.DONE:
            raise BenchError(f"the program stopped: {stop}")
        return spent / self.scans


def run_bench(programs: list[str] | None = None) -> Result:
    """ns per scan of each program, natively and in C (None where it has no twin or there is no gcc); build times in ms.

    The interpreter is measured when all programs are.
    """
    names = programs or list(PROGRAMS)
    unknown = [name for name in names if name not in PROGRAMS]
    if unknown:
        raise BenchError(f"there is no bench program {', '.join(unknown)}; there are: {', '.join(PROGRAMS)}")
    result: Result = {"programs": {}, "peers": {}, "compile": {}, "building": {}, "interpreter_per_second": None}
    with tempfile.TemporaryDirectory() as directory:
        for name in names:
            program, check_ms = checked_program(name)
            native, compile_ms = _build(program)
            observed, observed_ms = _build_observed(program)
            twin = _compile_c(name, Path(directory))
            result["compile"][name] = {"check": check_ms, **compile_ms, "observed": observed_ms}
            result["programs"][name] = _measure(name, native, observed, twin)
            if ratios := peer_ratios(name):
                result["peers"][name] = ratios
            if name in UNITS:
                result["building"][name] = measure_building(name)
    if not programs:
        result["interpreter_per_second"] = round(statements_per_second())
    return result


def checked_program(name: str) -> tuple[Program, float]:
    """A program of the bench, and ms that checking it took."""
    source = large(name) if name in UNITS else (HERE / "st" / f"{name}.st").read_text("utf-8")
    start = perf_counter_ns()
    checked = check_sources({f"{name}.st": source}, model_named(MODEL), INTERVAL_NS)
    spent = (perf_counter_ns() - start) / 1e6
    if checked.program is None:
        raise BenchError("\n".join(map(str, checked.problems)))
    return checked.program, round(spent, 1)


def _build(program: Program) -> tuple[_Native, Row]:
    memory = bytearray(program.initial_image)
    engine = NativeEngine(program, memory)
    steps = ("emit", "parse", "optimise", "codegen", "link")
    compile_ms: Row = {step: round(getattr(engine.timings, step), 1) for step in steps}
    return _warmed_up(program, engine, memory), compile_ms


def _build_observed(program: Program) -> tuple[_Native, float]:
    """Observed code while nothing is watched, and ms from the checked program to its engine."""
    memory = bytearray(program.initial_image)
    start = perf_counter_ns()
    engine, _ = ObservedBuilds().engine(program, memory)
    spent = (perf_counter_ns() - start) / 1e6
    return _warmed_up(program, engine, memory), round(spent, 1)


def _warmed_up(program: Program, engine: Engine, memory: bytearray) -> _Native:
    """What it computed by then, and how many scans take as long as a sample."""
    engine.run(WARM_UP)
    place = resolve(program, "bench.chk").locate(memory)
    assert place is not None
    chk = int.from_bytes(memory[place[0] : place[0] + 4], "little", signed=True)
    native = _Native(engine, chk, 16)
    while (spent := native.sample() * native.scans) < SAMPLE_S * 0.2e9:
        native.scans *= 2
    native.scans = max(1, int(native.scans * SAMPLE_S * 1e9 / spent))
    return native


def _compile_c(name: str, directory: Path) -> Path | None:
    """The C twin as a program that measures itself."""
    source, gcc = HERE / "hand" / f"{name}.c", shutil.which("gcc")
    if gcc is None or not source.is_file():
        return None
    target = directory / name
    done = subprocess.run(
        [gcc, "-O3", "-march=native", str(HERE / "hand" / "main.c"), str(source), "-lm", "-o", str(target)],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    if done.returncode:
        raise BenchError(f"gcc cannot compile {source}:\n{done.stderr}")
    return target


def _measure(name: str, native: _Native, observed: _Native, twin: Path | None) -> Row:
    if observed.chk != native.chk:
        raise BenchError(f"{name}: chk is {native.chk}, but {observed.chk} in observed code")
    ours, watched, theirs = [], [], []
    for _ in range(SAMPLES):
        ours.append(native.sample())
        watched.append(observed.sample())
        if twin is not None:
            theirs.append(_sample_c(name, native.chk, twin))
    ns = median(ours)
    c_ns = median(theirs) if theirs else None
    return {
        "ns": round(ns, 2),
        "c_ns": c_ns,
        "ratio": round(ns / c_ns, 3) if c_ns else None,
        "observed_ratio": round(median(watched) / ns, 3),
    }


def _sample_c(name: str, chk: int, twin: Path) -> float:
    # the C measures five times, too
    done = subprocess.run([str(twin), name, str(SAMPLE_S / SAMPLES)], capture_output=True, text=True, check=True)
    found = re.search(r"chk2000=(-?\d+) .* median=([\d.]+)", done.stdout)
    if found is None:
        raise BenchError(f"{name}: the C twin printed something else: {done.stdout!r}")
    if int(found.group(1)) != chk:
        raise BenchError(f"{name}: chk is {chk}, but {found.group(1)} in C")
    return float(found.group(2))
