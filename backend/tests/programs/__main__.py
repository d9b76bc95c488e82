"""`python -m tests.programs N [SEED]`: N random programs from a seed on, on all cores; prints those that fail, made small.

A fresh seed is taken when none is given. Processes do the work, so that even a crash is noticed and its seed is known.
"""

import multiprocessing
import os
import secrets
import sys
import traceback
from ctypes import c_longlong
from multiprocessing.sharedctypes import Synchronized
from queue import Empty
from time import monotonic

from tests.programs import conditions, generate
from tests.programs.compare import Refused, checked, compare, levels
from tests.programs.reduce import reduced

WAIT_S = 1.0
MOST = 10
"""Failures after which it is enough."""

Found = tuple[int, str]


def failure(source: str, seed: int) -> str:
    """How the program fails, '' if it does not. The first words are the same for the same kind of failure."""
    for level in levels(seed):
        try:
            compare(source, level)
        except Refused as error:
            return f"refused: {error}"
        except AssertionError as error:
            return f"O{level} differs: {error}"
        except Exception as error:
            return f"{type(error).__name__} at O{level}: {error}\n{traceback.format_exc(limit=-4)}"
    try:
        program = checked(source)
        if program is not None:
            conditions.compare(program, condition_of(seed))
    except Exception as error:
        return f"condition, {type(error).__name__}: {error}"
    return ""


def condition_of(seed: int) -> str:
    """The condition that is compared on the program of a seed, and on what is left of it when it is made small."""
    program = checked(generate(seed))
    return conditions.text(seed, program) if program is not None else "FALSE"


def work(first: int, step: int, end: int, now: "Synchronized[int]", found: "multiprocessing.Queue[Found]") -> None:
    """Every `step`th seed."""
    for seed in range(first, end, step):
        now.value = seed
        source = generate(seed)
        if how := failure(source, seed):
            if not how.startswith("refused"):
                kind = how.split(":")[0]
                source = reduced(source, lambda text, kind=kind, seed=seed: failure(text, seed).startswith(kind))  # type: ignore[misc]
            found.put((seed, f"{failure(source, seed)}\n{source}"))
    now.value = end


def run(count: int, first: int) -> int:
    """The number of failures."""
    cores = os.cpu_count() or 1
    found: multiprocessing.Queue[Found] = multiprocessing.Queue()
    end, failures, start = first + count, 0, monotonic()
    places: list[Synchronized[int]] = [multiprocessing.Value(c_longlong, first) for _ in range(cores)]
    begin = [first + number for number in range(cores)]

    def started(number: int) -> multiprocessing.Process:
        process = multiprocessing.Process(target=work, args=(begin[number], cores, end, places[number], found))
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
            print(f"{done} programs, {failures} failures, {monotonic() - start:.0f} s", end="\r", flush=True)
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
    print(f"\n{count} programs from seed {first}, {failures} failures, {monotonic() - start:.0f} s")
    return failures


if __name__ == "__main__":
    seeds = [int(word) for word in sys.argv[1:]]
    sys.exit(1 if run(seeds[0] if seeds else 1000, seeds[1] if len(seeds) > 1 else secrets.randbelow(10**9)) else 0)
