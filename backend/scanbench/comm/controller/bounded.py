"""So many samples of a controller as a trace, for who waits for them: a command."""

import asyncio
from collections.abc import Callable, Sequence
from contextlib import aclosing

from scanbench.comm.controller.contract import Connection
from scanbench.comm.controller.opening import for_program, open_source
from scanbench.comm.controller.sampling import Read, Sampler, Settling, taken
from scanbench.program.program import Program
from scanbench.verify.trace.growing import TIME, GrowingTrace, Sample, controller_table, most_samples
from scanbench.verify.trace.mapping import TraceMapping
from scanbench.verify.trace.table import Table

MappingOf = Callable[[Table], TraceMapping]
"""What the columns of the first sample are."""


def read_samples(
    connection: Connection, program: Program, samples: int, mapping_of: MappingOf, say: Callable[[str], None],
    told: Callable[[int], None],
) -> GrowingTrace:  # fmt: skip
    """Reads it so often. `say` is told what is left out and why there are no samples, `told` how many there are. `Unreachable`; `BadMapping`
    and `BadTraceFile`: what does not fit the program."""
    return asyncio.run(_read(for_program(connection, program), program, samples, mapping_of, say, told))


async def _read(
    connection: Connection, program: Program, samples: int, mapping_of: MappingOf, say: Callable[[str], None],
    told: Callable[[int], None],
) -> GrowingTrace:  # fmt: skip
    sampler = Sampler(connection, open_source, lambda why: say(why) if why else None)
    try:
        found = await sampler.begin()
        for left in found.left_out:
            say(f"not read: {left}")
        first = await sampler.once(range(len(found.columns)))
        columns = (TIME, *found.columns)
        table = controller_table(connection.address, columns, _cells(first, first))
        mapping = mapping_of(table)
        growing = GrowingTrace(table, mapping, program)
        wanted = {each.column for each in mapping.columns if each.role != "ignore"} | {mapping.axis}
        read = [at for at, name in enumerate(found.columns) if name in wanted]
        most, done = min(samples, most_samples(len(columns))), 1
        told(done)
        more = taken(sampler, read, _settling(found.columns, mapping), most - 1)
        async with aclosing(more) as further:  # type: ignore[type-var]
            async for each in further:
                growing.add([Sample(_cells(each, first), each.after_break)])
                done += 1
                told(done)
        return growing
    finally:
        await sampler.close()


def _settling(columns: Sequence[str], mapping: TraceMapping) -> Settling | None:
    if mapping.unit != "scan":
        return None
    inputs = tuple(columns.index(each.column) for each in mapping.columns if each.role == "input")
    return Settling(columns.index(mapping.axis), inputs)


def _cells(read: Read, first: Read) -> tuple[str, ...]:
    return (f"{(read.at_ns - first.at_ns) / 1e6:.3f}", *read.cells)
