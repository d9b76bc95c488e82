"""What a long run with many errors costs to look at: log, history and record after so many error events.

`python -m bench.events [--events N] [--json]`. A PLC of its own, whose events go the way of live ones: through the session's log
and history into the database. Then each page is asked for as a browser does.
"""

import argparse
import asyncio
import json
import sys
import tempfile
from collections.abc import Awaitable, Callable
from pathlib import Path
from time import perf_counter

from scanbench.faults.inject import Generate, Recover
from scanbench.faults.reference import ErrorRef
from scanbench.reports.record_html import to_html
from scanbench.runtime.clock import wall_time
from scanbench.runtime.command import Command, Entry, Plan
from scanbench.server.workbench import Workbench
from scanbench.session.session import Session
from scanbench.store.store import Store
from scanbench.web import translate

EVENTS = 100_000
BATCH = 500
"""Entries that come from the PLC's process together."""
PAGE = 1000
SOURCE = "PROGRAM Main\nVAR n : DINT; END_VAR\n  n := n + 1;\nEND_PROGRAM\n"
Figures = dict[str, float]


def entries(count: int) -> list[Entry]:
    """An error that comes and goes."""
    at, ref = wall_time(), ErrorRef("battery-error")
    made: list[Entry] = []
    for number in range(count):
        command: Command = Generate("bench", (ref,)) if number % 2 == 0 else Recover("bench", (ref.id,))
        made.append(Entry(number, at, command, Plan((), f"event {number}")))
    return made


async def measure(events: int) -> Figures:
    """Seconds, by what was done; and how many lines are there."""
    with tempfile.TemporaryDirectory() as folder:
        store = Store(f"sqlite:///{folder}/bench.db")
        project = store.projects.create("line", "CJ1M-CPU63").id
        store.files.save(project, "main.st", SOURCE, 0, "bench")
        store.builds.accept(project, {"main.st": SOURCE}, "bench")
        instance = store.instances.create(project, "line-1").id
        store.instances.change(instance, powered=False)
        bench = Workbench(store, Path(folder))
        await bench.start()
        try:
            return await _measure(bench, bench.session(instance), events)
        finally:
            await bench.close()
            store.close()


async def _measure(bench: Workbench, session: Session, events: int) -> Figures:
    figures: Figures = {}

    async def timed(name: str, do: Callable[[], Awaitable[object]]) -> None:
        start = perf_counter()
        await do()
        figures[name] = perf_counter() - start

    async def enter() -> None:
        all_ = entries(events)
        for first in range(0, events, BATCH):
            some = all_[first : first + BATCH]
            session.log.on_entries(some)
            session.errors.on_entries(some)
            await asyncio.sleep(0)
        await bench.log_page(session, None, 1, None)  # all of it is in the database

    async def record() -> None:
        made = await bench.records.of_instance(session, None, "bench", "en")
        to_html(made, "en")

    async def history() -> None:
        json.dumps([translate.error_row(row).model_dump(mode="json") for row in session.errors.rows])

    await timed("events entered and kept", enter)
    await timed("log, last page", lambda: bench.log_page(session, None, PAGE, None))
    await timed("log, first page", lambda: bench.log_page(session, 0, PAGE, None))
    await timed("log, page in the middle, of one kind", lambda: bench.log_page(session, events // 4, PAGE, "error"))
    await timed("history", history)
    await timed("record, printable", record)
    page = await bench.log_page(session, None, 1, None)
    figures["lines in the log"] = page.total
    return figures


def main() -> None:
    """Prints the figures."""
    parser = argparse.ArgumentParser(
        prog="python -m bench.events", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--events", type=int, default=EVENTS, help="how many (default: 100,000)")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    given = parser.parse_args()
    figures = asyncio.run(measure(given.events))
    if given.json:
        sys.stdout.write(json.dumps(figures) + "\n")
        return
    for name, value in figures.items():
        shown = f"{value:12,.0f}" if name.startswith("lines") else f"{value:12.3f} s"
        sys.stdout.write(f"{name:40}{shown}\n")


if __name__ == "__main__":
    main()
