"""A sweep on several cores: processes that begin as copies of this one, so that program, code and states are there already."""

import multiprocessing
import os
import signal
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool

from scanbench.engines.lifeline import end_with_parent
from scanbench.faults.reaction.required_rules import Rules
from scanbench.faults.reaction.steps import Point
from scanbench.faults.reaction.sweep import Cell, Sweeper, pairs_of, sweep
from scanbench.faults.reference import ErrorRef
from scanbench.runtime.programs import Programs

MOST_PROCESSES = 8
"""More would each keep the run without an error of every state."""
_FEWEST = 40
"""Cases for which processes are not worth their start."""
_copied: list[tuple[Sweeper, Sequence[tuple[ErrorRef, str]]]] = []
"""What the processes find when they begin."""


class Died(Exception):
    """One of the processes died, for want of memory perhaps."""

    def __init__(self) -> None:
        super().__init__("a process that tried errors died, perhaps for want of memory: try again, with fewer states")


def cores() -> int:
    """Those that this process may use."""
    return len(os.sched_getaffinity(0))


def sweep_side_by_side(
    points: Mapping[str, Point], errors: Sequence[ErrorRef], window: int, programs: Programs, processes: int | None = None,
    rules: Rules | None = None, done: Collection[tuple[str, str]] = (), known: Collection[str] = (),
    on_try: Callable[[str, str], None] = lambda error, point: None,
) -> Iterator[Cell]:  # fmt: skip
    """The cells of `sweep`, in its order. `processes`: as many as there are cores, if it is not given. `on_try` is told the first
    case that is not over. `Died`: a process is gone, and with it what it tried."""
    pairs = pairs_of(points, errors, done)
    count = min(processes or cores(), MOST_PROCESSES, len(pairs))
    if count < 2 or len(pairs) < _FEWEST:
        yield from sweep(points, errors, window, programs, done, on_try, rules, known)
        return
    sweeper = Sweeper(points, window, programs, rules, known)
    for point in points.values():
        programs.get(point.version)  # built once, for all of them
    yield from _on_several(sweeper, pairs, count, on_try)


def _on_several(
    sweeper: Sweeper, pairs: Sequence[tuple[ErrorRef, str]], count: int, on_try: Callable[[str, str], None]
) -> Iterator[Cell]:
    others = set(multiprocessing.active_children())
    pool = ProcessPoolExecutor(count, multiprocessing.get_context("fork"), _begin, (os.getpid(),))
    _copied.append((sweeper, pairs))
    try:
        found = pool.map(_cell, range(len(pairs)))
        for ref, name in pairs:
            on_try(str(ref), name)
            yield next(found)
    except BrokenProcessPool as error:
        raise Died from error
    except BaseException:  # nobody wants what they try now
        for each in set(multiprocessing.active_children()) - others:
            each.kill()
        raise
    finally:
        _copied.pop()
        pool.shutdown(cancel_futures=True)


def _begin(parent: int) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the first process's business
    end_with_parent(parent)


def _cell(index: int) -> Cell:
    sweeper, pairs = _copied[-1]
    return sweeper.cell(*pairs[index])
