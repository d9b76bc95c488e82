"""Many virtual PLCs on one machine: whether they hold their pace, what each costs, and how soon a new one scans.

`python -m bench.instances [--count N] [--interval T] [--seconds N]`: without a count 200 of the conveyor sample at
10 ms, then 50 at 1 ms. All is as in the server, without the web: hosts from the zygote, runs recorded, nobody watching.
"""

import argparse
import asyncio
import json
import re
import sys
import tempfile
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from statistics import mean, median
from time import perf_counter

from scanbench.check.incremental import Checks
from scanbench.engines.cache import BlobCache
from scanbench.host.build import find_model
from scanbench.host.load import Loads
from scanbench.host.program_cache import keep, key_of
from scanbench.host.run_files import run_path
from scanbench.host.zygote import zygote
from scanbench.server.samples import samples
from scanbench.session.instance import Instance, Remembered
from scanbench.store.records import Limits
from scanbench.wire import host as protocol
from scanbench.wire.host import PlcState

SAMPLE = "Conveyor"
SETTLE_S = 3.0
_INTERVAL = re.compile(r"INTERVAL := T#\w+")
_UNITS = {"us": 1_000, "ms": 1_000_000, "s": 1_000_000_000}
_START_S = 60


@dataclass(frozen=True, slots=True)
class Figures:
    """What was measured. Starts are from the request to the end of the first scan."""

    count: int
    interval_ms: float
    cold_start_ms: float
    """Of the first instance: nothing was built before."""
    start_ms: float
    """Of a built program: the median."""
    worst_start_ms: float
    held_percent: float
    """Scans that were run, of those that were due."""
    late_percent: float
    """Scans of all instances that began after the next one was due."""
    late_us: float
    """Mean lateness of the start of a scan."""
    worst_us: float
    cpu_percent: float
    """Of all hosts together, of one core."""
    memory_mb: float
    """PSS of a host: the mean; hosts share the rest."""
    most_memory_mb: float


class _Plc:
    """One instance, and what it says of itself."""

    def __init__(self, number: int, sources: protocol.Sources, directory: Path) -> None:
        self._changed, self._heard = asyncio.Event(), 0.0
        memory = Remembered(
            f"line-{number}",
            sources,
            run_path(directory, number),
            Limits(),
            protocol.Driven(paused=True),
        )
        self.instance = Instance(memory, self._on_state, lambda _: None, directory / "cache")

    @property
    def state(self) -> PlcState:
        """What the host said last."""
        return self.instance.state

    @property
    def progress(self) -> tuple[int, float]:
        """The scan it was at, and when it said so."""
        return self.state.scan, self._heard

    async def first_scan_ms(self) -> float:
        """Starts it, for one scan."""
        start = perf_counter()
        self.instance.start()
        async with asyncio.timeout(_START_S):
            await self._until(lambda state: state.state == "paused")
            await self.instance.ask(lambda ref: protocol.Drive(ref, "scan", None, "bench"), protocol.Ack)
            await self._until(lambda state: state.scan > 0)
        return (perf_counter() - start) * 1000

    async def run(self) -> None:
        """Goes on at its pace, measured from now on."""
        await self.instance.ask(lambda ref: protocol.Drive(ref, "continue", None, "bench"), protocol.Ack)

    def _on_state(self, _: PlcState) -> None:
        self._heard = perf_counter()
        self._changed.set()

    async def _until(self, holds: Callable[[PlcState], bool]) -> None:
        while not holds(self.state):
            if self.state.state == "failed":
                raise RuntimeError(self.state.message)
            self._changed.clear()
            await self._changed.wait()


async def measure(count: int, interval_ms: float, seconds: float) -> Figures:
    """Starts so many, lets them run, and ends them."""
    with tempfile.TemporaryDirectory() as name:
        directory, sources = Path(name), _sources(interval_ms)
        async with _running(directory, count, sources) as (plcs, cold_ms, starts_ms):
            await asyncio.sleep(SETTLE_S)
            await asyncio.gather(*(plc.run() for plc in plcs))  # starts a new measurement
            loads, pids = Loads(), [plc.state.pid for plc in plcs if plc.state.pid is not None]
            await asyncio.to_thread(loads.look, pids)
            before = [plc.progress for plc in plcs]
            await asyncio.sleep(seconds)
            found = list((await asyncio.to_thread(loads.look, pids)).values())
            after, held = [plc.state for plc in plcs], [_rate(plc, *old) for plc, old in zip(plcs, before, strict=True)]
        return Figures(
            count=count,
            interval_ms=interval_ms,
            cold_start_ms=round(cold_ms, 1),
            start_ms=round(median(starts_ms), 1),
            worst_start_ms=round(max(starts_ms), 1),
            held_percent=round(100 * mean(held) * interval_ms / 1000, 2),
            late_percent=round(mean(state.late_percent for state in after), 3),
            late_us=round(mean(state.late_us for state in after), 1),
            worst_us=max(state.worst_us for state in after),
            cpu_percent=round(sum(each.cpu_percent for each in found), 1),
            memory_mb=round(mean(each.memory_bytes for each in found) / (1 << 20), 2),
            most_memory_mb=round(max(each.memory_bytes for each in found) / (1 << 20), 2),
        )


@asynccontextmanager
async def _running(
    directory: Path, count: int, sources: protocol.Sources
) -> AsyncIterator[tuple[list[_Plc], float, list[float]]]:
    """All of them at their pace; how long the first one took with an empty cache, and the others."""
    plcs: list[_Plc] = []
    try:
        zygote().start()
        await _warmed(directory, sources)
        plcs.append(_Plc(0, sources, directory))
        cold_ms = await plcs[0].first_scan_ms()
        _keep(sources, directory / "cache")
        starts_ms: list[float] = []
        for number in range(1, count):
            plcs.append(_Plc(number, sources, directory))
            starts_ms.append(await plcs[-1].first_scan_ms())
        for plc in plcs:
            await plc.run()
        yield plcs, cold_ms, starts_ms or [cold_ms]
    finally:
        await asyncio.gather(*(plc.instance.stop() for plc in plcs))


def _rate(plc: _Plc, scan: int, heard: float) -> float:
    """Scans a second since then."""
    scan_now, now = plc.progress
    return (scan_now - scan) / (now - heard) if now > heard else 0.0


async def _warmed(directory: Path, sources: protocol.Sources) -> None:
    """Waits until the zygote has everything imported: a host of it answers."""
    with tempfile.TemporaryDirectory(dir=directory) as name:
        plc = _Plc(0, sources, Path(name))
        try:
            await plc.first_scan_ms()
        finally:
            await plc.instance.stop()


def _sources(interval_ms: float) -> protocol.Sources:
    """The sample at this interval."""
    sample = next(each for each in samples() if each.name == SAMPLE)
    interval = f"INTERVAL := T#{round(interval_ms * 1000)}us"
    files = {path: _INTERVAL.sub(interval, text) for path, text in sample.files.items()}
    return protocol.Sources(sample.model, files, round(interval_ms * 1_000_000), 1)


def _keep(sources: protocol.Sources, cache: Path) -> None:
    """Keeps the program, as the server does after an accepted build."""
    model = find_model(sources.model)
    program = Checks().check(sources.files, model, sources.interval_ns).program
    assert program is not None
    keep(BlobCache(cache), key_of(sources, model), program)


def _milliseconds(text: str) -> float:
    """`10ms`, `500us`, `1s`."""
    match = re.fullmatch(r"(\d+(?:\.\d+)?)(us|ms|s)", text)
    if match is None:
        raise argparse.ArgumentTypeError(f"{text} is no time: write 10ms, 500us or 1s")
    return float(match[1]) * _UNITS[match[2]] / _UNITS["ms"]


def _shown(figures: Figures) -> str:
    return (
        f"{figures.count} instances at {figures.interval_ms:g} ms: {figures.late_percent:.3f} % of scans late, "
        f"{figures.held_percent:.2f} % of the pace held\n"
        f"  lateness {figures.late_us:.0f} us mean, {figures.worst_us / 1000:.1f} ms at worst\n"
        f"  memory {figures.memory_mb:.1f} MB mean, {figures.most_memory_mb:.1f} MB at most (PSS each); "
        f"CPU {figures.cpu_percent:.0f} % of a core, all together\n"
        f"  from the request to the first scan: {figures.start_ms:.0f} ms built before "
        f"({figures.worst_start_ms:.0f} ms at worst), {figures.cold_start_ms:.0f} ms never built"
    )


def main(arguments: list[str]) -> int:
    """Measures, and prints what was found."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int)
    parser.add_argument("--interval", type=_milliseconds, default=10.0)
    parser.add_argument("--seconds", type=float, default=20)
    parser.add_argument("--json", action="store_true")
    given = parser.parse_args(arguments)
    plans = [(given.count, given.interval)] if given.count is not None else [(200, 10.0), (50, 1.0)]
    for count, interval_ms in plans:
        figures = asyncio.run(measure(count, interval_ms, given.seconds))
        sys.stdout.write((json.dumps(asdict(figures)) if given.json else _shown(figures)) + "\n")
        sys.stdout.flush()
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
