"""What the PLC itself wrote: system words, the plant's inputs. No statement of the user's program tells of these."""

import numpy as np

from scanbench.check.typed.condition import BadCondition, compile_signal
from scanbench.debug.placed import bytes_of
from scanbench.engines.engine import Reason
from scanbench.engines.sample import HEAD_WORDS, Sampling
from scanbench.program.layout import Layout
from scanbench.program.program import Program
from scanbench.program.types import Elementary
from scanbench.recording.reader import RunReader
from scanbench.symbols.symbols import Symbol, resolve

_CHUNK = 1 << 17
"""Scans whose changes are looked at at once."""


def last_change(reader: RunReader, symbol: Symbol, scan: int, after: int) -> int | None:
    """The last scan after `after` and before `scan` in which the value changed, for a variable that the PLC itself may write."""
    timeline = reader.timeline
    if not _may_be_written(timeline.resource.program, symbol) or not isinstance(symbol.type, Elementary):
        return None
    until = scan
    for checkpoint in reversed(timeline.recording.checkpoints):
        if checkpoint.scan >= until:
            continue
        first = max(checkpoint.scan, after + 1)
        if first < until:
            found = _in_stretch(reader, symbol.path, first, until)
            if found is not None:
                return found
        if checkpoint.scan <= after + 1:
            return None
        until = checkpoint.scan
    return None


def _may_be_written(program: Program, symbol: Symbol) -> bool:
    """Variables of the user's programs are nobody else's; a plant may write what is global."""
    if symbol.address is not None or symbol.offset < Layout.HEADER_SIZE or program.layout.area_at(symbol.offset):
        return True
    if not program.plant:
        return False
    owned = (
        each.offset <= symbol.offset < each.offset + each.pou.instance.size
        for task in program.tasks
        for each in task.programs
    )
    return not any(owned)


def _in_stretch(reader: RunReader, path: str, first: int, end: int) -> int | None:
    """The last of these scans that changed the value."""
    timeline = reader.timeline
    last: int | None = None
    before: int | None = None
    reader.goto(first)
    while (now := timeline.resource.header.scan) < end:
        resource = timeline.resource
        signal = compile_signal(resource.program, path)
        if isinstance(signal, BadCondition):
            before = None
            if timeline.go_on(end).reason is not Reason.INTERRUPTED:
                break
            continue
        upto = min(end, now + _CHUNK)
        sampling = Sampling(resource.program, [signal], rows=upto - now + 1)
        sampling.skip_to(now)
        if before is None:
            before = _now(reader, path)
        resource.waiting.samplings = (sampling,)
        try:
            timeline.go_on(upto)
        finally:
            resource.waiting.samplings = ()
        rows = sampling.take()
        values = rows[:, HEAD_WORDS]
        if len(rows):
            changed = np.flatnonzero(values != np.concatenate(([np.uint64(before)], values[:-1])))
            if len(changed):
                last = int(rows[changed[-1], 0])
            before = int(values[-1])
        if timeline.resource.header.scan == now:
            break
    return last


def _now(reader: RunReader, path: str) -> int:
    resource = reader.timeline.resource
    place = bytes_of(resolve(resource.program, path), resource.memory)
    assert place is not None
    offset, size, mask = place
    value = int.from_bytes(resource.memory[offset : offset + size], "little")
    return int(bool(value & mask)) if mask != 0xFF else value
