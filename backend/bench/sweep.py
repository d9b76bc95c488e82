"""`python -m bench sweep`: all error instances of a CJ1M with full racks, from one state and from ten.

The most that the model has: 4 racks of 10 slots, all taken; 40 special I/O units, 16 CPU bus units, 20 FAL numbers.
"""

import argparse
import os
import resource
import sys
import time
from collections.abc import Sequence

from scanbench.check.build import check_sources
from scanbench.engines.native.observed import ObservedBuilds
from scanbench.faults.reaction.choices import Choices
from scanbench.faults.reaction.side_by_side import sweep_side_by_side
from scanbench.faults.reaction.steps import Point, resource_at
from scanbench.faults.reference import ErrorRef
from scanbench.plcmodel.hardware import Fitted
from scanbench.plcmodel.load import load_all, model_directory
from scanbench.plcmodel.read_hardware import write_hardware
from scanbench.program.program import Program
from scanbench.recording.programs import cached, observed
from scanbench.runtime.programs import Loaded, Programs
from scanbench.runtime.resource import Resource

WINDOW, STATES = 200, 10
SOURCE = """
PROGRAM Main
VAR
  anyUnit AT A402.06 : BOOL; units AT A418 : WORD; fal AT A402.15 : BOOL; motor AT CIO 100.00 : BOOL;
  n, i : INT; samples : ARRAY[0..99] OF INT;
END_VAR
  n := n + 1;
  FOR i := 0 TO 99 DO samples[i] := samples[i] + i; END_FOR;
  motor := NOT (anyUnit AND units <> 0) AND NOT fal;
END_PROGRAM
"""


def full() -> tuple[Fitted, ...]:
    """What is fitted."""
    return (
        *(Fitted("basic-io-unit", None, rack, slot) for rack in range(4) for slot in range(10)),
        *(Fitted("special-io-unit", number, name=f"special {number}") for number in range(40)),
        *(Fitted("cpu-bus-unit", number, name=f"bus {number}") for number in range(16)),
        *(Fitted("fal", number, name=f"fault {number}") for number in range(1, 21)),
    )


def program() -> Program:
    """The program with its hardware."""
    model = next(each for each in load_all(model_directory())[0] if each.name == "CJ1M-CPU63")
    checked = check_sources({"main.st": SOURCE, "hardware.json": write_hardware(full())}, model, 10_000_000)
    assert checked.program is not None, checked.problems
    return checked.program


def states(programs: Programs) -> dict[str, Point]:
    """The PLC after 100 scans, after 200, and so on."""
    loaded: Loaded = programs.get(1)
    plc = Resource(loaded, programs=programs)
    found = {}
    for number in range(STATES):
        plc.run(100)
        found[f"state {number}"] = Point(1, plc.state, plc.journal)
    resource_at(found["state 0"], programs)
    return found


def measured(points: dict[str, Point], errors: Sequence[ErrorRef], programs: Programs, processes: int | None) -> str:
    """Seconds, and the memory of the largest process."""
    begun = time.perf_counter()
    cells = list(sweep_side_by_side(points, errors, WINDOW, programs, processes))
    seconds = time.perf_counter() - begun
    largest = max(resource.getrusage(who).ru_maxrss for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)) >> 10
    cores = processes or len(os.sched_getaffinity(0))
    return (
        f"{len(errors)} instances from {len(points)} state{'s' * (len(points) != 1)}: {seconds:.1f} s, {len(cells):,} cells, "
        f"{1000 * seconds / len(cells):.1f} ms each, processes {cores}, largest process {largest} MiB"
    )


def main() -> None:
    """Prints the figures."""
    parser = argparse.ArgumentParser(prog="python -m bench sweep", description=__doc__)
    parser.add_argument("--processes", type=int, default=None, help="how many; else one for each core")
    given = parser.parse_args()
    made = program()
    programs = cached({1: made}, observed(ObservedBuilds(None).engine))
    points = states(programs)
    errors = Choices(made).expand(ErrorRef(each.id) for each in made.layout.model.errors())
    for some in (dict(list(points.items())[:1]), points):
        sys.stdout.write(measured(some, errors, programs, given.processes) + "\n")
        sys.stdout.flush()


if __name__ == "__main__":
    main()
