"""A sweep on all cores: processes that begin as copies of this one, so that program, code and states are there already."""

import multiprocessing
import os
import signal
from collections.abc import Iterator, Mapping, Sequence

from scanbench.faults.reaction.required_rules import Rules
from scanbench.faults.reaction.steps import Point
from scanbench.faults.reaction.sweep import Cell, Sweeper, sweep
from scanbench.faults.reference import ErrorRef
from scanbench.runtime.programs import Programs

MOST_PROCESSES = 8
"""More would each keep the run without an error of every state."""
_FEWEST = 40
"""Cases for which processes are not worth their start."""
_copied: list[tuple[Sweeper, Sequence[ErrorRef], Sequence[str]]] = []
"""What the processes find when they begin."""


def sweep_side_by_side(
    points: Mapping[str, Point], errors: Sequence[ErrorRef], window: int, programs: Programs, processes: int | None = None,
    rules: Rules | None = None,
) -> Iterator[Cell]:  # fmt: skip
    """The cells of `sweep`, in its order. `processes`: as many as there are cores, if it is not given."""
    count = min(processes or len(os.sched_getaffinity(0)), MOST_PROCESSES, len(errors))
    if count < 2 or len(errors) * len(points) < _FEWEST:
        yield from sweep(points, errors, window, programs, rules=rules)
        return
    for point in points.values():
        programs.get(point.version)  # built once, for all of them
    _copied.append((Sweeper(points, window, programs, rules), errors, tuple(points)))
    try:
        with multiprocessing.get_context("fork").Pool(count, _begin) as pool:
            for cells in pool.imap(_cells, range(len(errors))):
                yield from cells
    finally:
        _copied.pop()


def _begin() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the first process's business


def _cells(index: int) -> list[Cell]:
    sweeper, errors, names = _copied[-1]
    return [sweeper.cell(errors[index], name) for name in names]
