"""What building and editing a large program costs, as the host of a PLC and the checker of the server do it.

Each has a process of its own, and time counts from when that has its modules loaded and the text in hand. The first host finds
an empty cache directory; the second finds what the first has left there, and is then edited: no edit was ever built before.
`python -m bench.building PART PROGRAM CACHE` is one of them, and prints one JSON object.
"""

import json
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from statistics import median
from time import perf_counter_ns

from bench.large import UNITS, large
from scanbench.check.incremental import Checks
from scanbench.engines.cache import BlobCache
from scanbench.host.build import Builder, find_model
from scanbench.host.program_cache import keep, key_of
from scanbench.host.programs import HostPrograms
from scanbench.host.swaps import Recode
from scanbench.runtime.program_change import ProgramChange
from scanbench.runtime.programs import Loaded, LoadedPrograms
from scanbench.runtime.resource import Resource
from scanbench.wire.host import Sources

MODEL = "GENERIC-IEC"
INTERVAL_NS = 1_000_000
OPTIMISED_S = 120
LOOK_S = 0.05
SAMPLES = 9

STATEMENT = "integ := integ + err * 0.01;"
BODIES = ("integ := integ + err * 0.0{};", "integ := integ + err * 0.0{};\n      state := 1;", "integ := integ + {};")
"""What people make of the statement, in one block after the other: a new number, a line more."""
BROKEN = ("integ := integ + err * ;", "integ := integ + er{} * 0.01;", *BODIES)
DECLARATION = "  b2 : BOOL;"
DECLARATIONS = ("  b2 : BOOL; more{} : INT;", "  b2 : BOOL;\n  another{} : REAL;", "  b2 : BOO{};")

Figures = dict[str, float]


def measure_building(program: str) -> Figures:
    """ms of each step, and MB of the processes that took them. `program` is one of `bench.large.UNITS`, or the path of one like them."""
    with tempfile.TemporaryDirectory() as cache:
        first, second, checker = (_process(part, program, cache) for part in PARTS)
    return {
        "cold": first["start"],
        "cached": second["start"],
        "optimised_behind": first["optimised"],
        "pou_changed": second["pou_changed"],
        "keystroke_in_body": checker["body"],
        "keystroke_in_declaration": checker["declaration"],
        "host_mb": max(first["memory_mb"], second["memory_mb"]),
        "checker_mb": checker["memory_mb"],
    }


def _process(part: str, program: str, cache: str) -> Figures:
    command = [sys.executable, "-m", "bench.building", part, program, cache]
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True)
    figures: Figures = json.loads(done.stdout)
    return figures


def _first_host(program: str, cache: Path) -> Figures:
    """Until optimised code runs."""
    return _host(program, cache)[0]


def _second_host(program: str, cache: Path) -> Figures:
    """The same again, then edits."""
    figures, builder, plc = _host(program, cache)
    builder.prepare(_sources(program, _text(program)))
    changes = _edits(_text(program), STATEMENT, BODIES)
    figures["pou_changed"] = _median(lambda edited: change(builder, plc, _sources(program, edited)), changes)
    return figures | _memory()


def _checker(program: str, cache: Path) -> Figures:
    """Problems after each keystroke."""
    figures = {}
    for name, part, others in (("body", STATEMENT, BROKEN), ("declaration", DECLARATION, DECLARATIONS)):
        figures[name] = _keystrokes(program, _text(program), _edits(_text(program), part, others))
    return figures | _memory()


PARTS: dict[str, Callable[[str, Path], Figures]] = {"first": _first_host, "second": _second_host, "checker": _checker}


def _host(program: str, cache: Path) -> tuple[Figures, Builder, Resource]:
    sources = _sources(program, _text(program))
    start = perf_counter_ns()
    builder = Builder(cache)
    built = builder.build(sources)
    plc = Resource(Loaded.make(built.program, built.engine))
    plc.run(1)
    figures = {"start": _ms(start)}
    figures["optimised"], together_kb = _optimise(builder, plc)
    keep(BlobCache(cache), key_of(sources, find_model(MODEL)), built.program)
    return figures | _memory(together_kb), builder, plc


def _memory(together_kb: int = 0) -> Figures:
    """Peak of this process, or of it and its worker together if that was more.

    Not from `getrusage`, which counts what the parent had when it started the process.
    """
    return {"memory_mb": round(max(_field_kb("/proc/self/status", "VmHWM:"), together_kb) / 1024, 1)}


def _together_kb() -> int:
    """What this process and its children take now; what they share counts once."""
    lists = (path.read_text() for path in Path("/proc/self/task").glob("*/children"))
    pids = ["self", *(pid for text in lists for pid in text.split())]
    return sum(_field_kb(f"/proc/{pid}/smaps_rollup", "Pss:") for pid in pids)


def _field_kb(path: str, name: str) -> int:
    try:
        lines = Path(path).read_text().splitlines()
    except OSError:  # the process has just ended
        return 0
    return next((int(line.split()[1]) for line in lines if line.startswith(name)), 0)


def _text(program: str) -> str:
    return large(program) if program in UNITS else Path(program).read_text("utf-8")


def _sources(program: str, text: str) -> Sources:
    return Sources(MODEL, {f"{program}.st": text}, INTERVAL_NS, 1)


def _ms(start: int) -> float:
    return round((perf_counter_ns() - start) / 1e6, 1)


def _edits(text: str, part: str, others: tuple[str, ...]) -> list[str]:
    """The text after each of so many edits, one after the other, each in a different block."""
    made = []
    pieces = text.split(part)
    between = [part] * (len(pieces) - 1)
    for number in range(SAMPLES):
        place = number * len(between) // SAMPLES
        between[place] = others[number % len(others)].format(number)
        made.append(pieces[0] + "".join(left + right for left, right in zip(between, pieces[1:], strict=True)))
    return made


def _median(measure: Callable[[str], float], texts: list[str]) -> float:
    return round(median(measure(text) for text in texts), 1)


def _optimise(builder: Builder, plc: Resource) -> tuple[float, int]:
    """Waits for the optimised code; ms, and the most KiB that it took with the worker."""
    if builder.tiers is None or not builder.tiers.optimising:
        return 0.0, 0
    start, done = perf_counter_ns(), threading.Event()

    def take(recode: Recode) -> None:
        if recode.engine is not None:
            plc.loaded.engine = recode.engine
        done.set()

    builder.tiers.optimise(take)
    peak = 0
    while not done.wait(LOOK_S) and _ms(start) < OPTIMISED_S * 1000:
        peak = max(peak, _together_kb())
    return _ms(start), peak


def change(builder: Builder, plc: Resource, sources: Sources) -> float:
    """ms from the text of a build to the first scan of the new program, variables carried over."""
    start = perf_counter_ns()
    version = plc.version + 1
    plc.programs = LoadedPrograms(plc.loaded, HostPrograms(builder, {}).make(replace(sources, version=version)))
    plc.submit(ProgramChange("bench", version))
    plc.run(1)
    return _ms(start)


def _keystrokes(program: str, text: str, texts: list[str]) -> float:
    checks, model = Checks(), find_model(MODEL)
    checks.diagnose(_sources(program, text).files, model, INTERVAL_NS)

    def measure(edited: str) -> float:
        start = perf_counter_ns()
        checks.diagnose(_sources(program, edited).files, model, INTERVAL_NS)
        return _ms(start)

    return _median(measure, texts)


if __name__ == "__main__":
    sys.stdout.write(json.dumps(PARTS[sys.argv[1]](sys.argv[2], Path(sys.argv[3]))))
