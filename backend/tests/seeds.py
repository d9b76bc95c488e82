"""Looks at seed after seed on all cores, for what compares something random. Processes do the work, so that even a crash is noticed and
its seed is known."""

import multiprocessing
import os
from collections.abc import Callable
from ctypes import c_longlong
from multiprocessing.sharedctypes import Synchronized
from queue import Empty
from time import monotonic

from scanbench.garbage import keep_what_is_there

WAIT_S = 1.0
MOST = 10
"""Failures after which it is enough."""

Found = tuple[int, str]
Failing = Callable[[int], str]
"""How what a seed gives fails, made small; '' if it does not."""


def _work(
    failing: Failing, first: int, step: int, end: int, now: "Synchronized[int]", found: "multiprocessing.Queue[Found]"
) -> None:
    """Every `step`th seed."""
    keep_what_is_there()
    for seed in range(first, end, step):
        now.value = seed
        if how := failing(seed):
            found.put((seed, how))
    now.value = end


def run(failing: Failing, seeds: int, first: int, what: str, each: int = 1) -> int:
    """The number of failures; `each` seed gives so many of `what`."""
    cores = os.cpu_count() or 1
    found: multiprocessing.Queue[Found] = multiprocessing.Queue()
    end, failures, start = first + seeds, 0, monotonic()
    places: list[Synchronized[int]] = [multiprocessing.Value(c_longlong, first) for _ in range(cores)]
    begin = [first + number for number in range(cores)]

    def started(number: int) -> multiprocessing.Process:
        process = multiprocessing.Process(
            target=_work, args=(failing, begin[number], cores, end, places[number], found)
        )
        process.start()
        return process

    workers = [started(number) for number in range(cores)]
    while any(worker.is_alive() for worker in workers) or not found.empty():
        try:
            seed, how = found.get(timeout=WAIT_S)
            failures += 1
            print(f"\nseed {seed}: {how}\n", flush=True)
        except Empty:
            done = sum(max(place.value - first, 0) for place in places) // cores
            print(f"{done * each} {what}, {failures} failures, {monotonic() - start:.0f} s", end="\r", flush=True)
        for number, worker in enumerate(workers):
            if not worker.is_alive() and worker.exitcode:
                failures += 1
                print(f"\nseed {places[number].value}: the process ended with {worker.exitcode}\n", flush=True)
                begin[number] = places[number].value + cores
                workers[number] = started(number)
        if failures >= MOST:
            for worker in workers:
                worker.terminate()
            break
    print(f"\n{seeds * each} {what} from seed {first}, {failures} failures, {monotonic() - start:.0f} s")
    return failures
