"""A controller that runs as what `scanbench verify` verifies: it is read a number of times, then compared."""

from collections.abc import Callable
from dataclasses import dataclass

import typer

from scanbench.cli.inputs import usage
from scanbench.cli.progress import progress
from scanbench.comm.controller.bounded import read_samples
from scanbench.comm.controller.contract import FASTEST_MS, SLOWEST_MS, Connection, Unreachable
from scanbench.program.program import Program
from scanbench.verify.trace.growing import TIME, GrowingTrace
from scanbench.verify.trace.mapping import BadMapping, TraceMapping
from scanbench.verify.trace.propose import sampled
from scanbench.verify.trace.table import BadTraceFile, Table

SAMPLES, INTERVAL_MS = 200, 100


@dataclass(frozen=True, slots=True)
class Controller:
    """Where it is, and what is read how often."""

    address: str
    nodes: tuple[str, ...] = ()
    samples: int = SAMPLES
    interval_ms: int = INTERVAL_MS


def read_controller(
    controller: Controller, program: Program, mapping_of: Callable[[Table], tuple[TraceMapping, bool]]
) -> GrowingTrace:
    """All samples of it. `mapping_of`: what its columns are, and whether somebody said so. Ends with exit code 2 where that cannot be."""
    if not FASTEST_MS <= controller.interval_ms <= SLOWEST_MS:
        usage(f"--every {controller.interval_ms}: a controller is read every {FASTEST_MS} to {SLOWEST_MS} ms")
    done = 0

    def told(count: int) -> None:
        nonlocal done
        done = count

    def mapped(table: Table) -> TraceMapping:
        mapping, said = mapping_of(table)
        return mapping if said else sampled(mapping, controller.interval_ms, TIME)

    def say(text: str) -> None:
        typer.echo(f"scanbench: {text}", err=True)

    connection = Connection(controller.address, controller.interval_ms, controller.nodes)
    try:
        with progress(controller.samples, lambda: done, lambda: f"{done:,} samples"):
            return read_samples(connection, program, controller.samples, mapped, say, told)
    except Unreachable as error:
        usage(error.message)
    except BadMapping as error:
        usage(str(error))
    except BadTraceFile as error:
        usage(" ".join(str(each) for each in error.problems))
