"""Retrospective traces: what signals did in earlier scans, found out afterwards by running those scans again.

From the nearest checkpoint of the run file, with the journal, in a job process: the PLC itself goes on meanwhile.
"""

from bisect import bisect_right
from collections.abc import Callable, Sequence
from operator import attrgetter
from pathlib import Path

import numpy as np

from scanbench.check.typed.condition import BadCondition, Signal, compile_signal
from scanbench.engines.sample import HEAD_WORDS, Sampling
from scanbench.program.program import Program
from scanbench.program.types import BOOL, Elementary
from scanbench.recording.programs import ProgramsOf
from scanbench.recording.reader import RunReader, Unreadable
from scanbench.runtime.command import Entry, Swapped
from scanbench.runtime.resource import Resource
from scanbench.taps.spool import write_pages
from scanbench.taps.trace import TraceSignal, described
from scanbench.taps.trace_buffer import TraceBuffer, Words, row_bytes
from scanbench.wire.codec import ENTRIES
from scanbench.wire.traces import RecordRetrospective, RetrospectiveDone

MAX_BYTES = 512 << 20
"""What a record may take while it is made."""
_CHUNK = 4096


def record(ask: RecordRetrospective, programs: ProgramsOf, on_chunk: Callable[[int, int], None]) -> RetrospectiveDone:
    """Samples the scans that are asked for, and writes them to the file; `Unreadable` says why that cannot be."""
    with RunReader(Path(ask.run), programs, ENTRIES) as reader:
        reader.follow()
        retrospective = _Retrospective(ask, reader)
        resource = retrospective.run(on_chunk)
    buffer = retrospective.buffer()
    first, end = buffer.extent
    write_pages(Path(ask.to), buffer.pieces(0, end))
    return RetrospectiveDone(
        ask.ref, retrospective.signals(), buffer.rows, first, end, resource.program.interval_ns, resource.version
    )  # fmt: skip


class _Retrospective:
    """One record under way."""

    def __init__(self, ask: RecordRetrospective, reader: RunReader) -> None:
        if not ask.first <= ask.last:
            raise Unreadable(f"scans {ask.first} to {ask.last} are none")
        rows = (ask.last - ask.first) // ask.every + 1
        if rows * row_bytes([_LARGEST] * len(ask.signals)) > MAX_BYTES:
            fits = MAX_BYTES // row_bytes([_LARGEST] * len(ask.signals))
            raise Unreadable(
                f"{rows:,} samples of {len(ask.signals)} signals are too many: {fits:,} fit. Take every n-th scan"
            )
        self._ask, self._reader = ask, reader
        self._types: list[Elementary | None] = [None] * len(ask.signals)
        self._described = list(map(TraceSignal, ask.signals))
        self._parts: list[Words] = []
        self._sampling: Sampling | None = None
        self._columns: list[int] = []

    def run(self, on_chunk: Callable[[int, int], None]) -> Resource:
        """Runs the scans."""
        ask, entries = self._ask, self._reader.entries
        resource = self._reader.at(ask.first)
        end = ask.last + 1
        while resource.header.scan < end:
            self._aim(resource)
            now = resource.header.scan
            at = bisect_right(entries, now, key=attrgetter("scan"))
            stop = min(end, now + _CHUNK * ask.every, *_swaps(entries[at:]))
            self._reader.replay(resource, stop, bisect_right(entries, stop, key=attrgetter("scan")))
            if self._sampling is not None:
                self._parts.append(self._whole(self._sampling.take()))
            on_chunk(resource.header.scan - ask.first, end - ask.first)
            if resource.header.scan == now:  # it trapped, and nothing follows
                break
        bad = next((each for each, type in zip(self._described, self._types, strict=True) if type is None), None)
        if bad is not None:
            raise Unreadable(bad.message, self._near(resource.program, bad.text))
        return resource

    def _aim(self, resource: Resource) -> None:
        """Finds the signals in the program that runs now."""
        if self._sampling is not None and self._sampling.program is resource.program:
            return
        good: list[Signal] = []
        self._columns = []
        for index, text in enumerate(self._ask.signals):
            signal = compile_signal(resource.program, text)
            if isinstance(signal, BadCondition):
                if self._types[index] is None:
                    self._described[index] = TraceSignal(text, message=signal.message)
            elif self._types[index] in (None, signal.type):
                self._types[index], self._described[index] = signal.type, described(signal)
                good.append(signal)
                self._columns.append(index)
        self._sampling = Sampling(resource.program, good, self._ask.every, rows=_CHUNK + 2) if good else None
        if self._sampling is not None:
            self._sampling.skip_to(self._ask.first)
        resource.waiting.samplings = () if self._sampling is None else (self._sampling,)

    def _whole(self, rows: Words) -> Words:
        count = len(self._ask.signals)
        whole = np.zeros((len(rows), HEAD_WORDS + count), dtype=np.uint64)
        whole[:, 0] = rows[:, 0]
        for at, column in enumerate(self._columns):
            whole[:, 1] |= (rows[:, 1] >> np.uint64(at) & np.uint64(1)) << np.uint64(column)
            whole[:, HEAD_WORDS + column] = rows[:, HEAD_WORDS + at]
        return whole

    @staticmethod
    def _near(program: Program, text: str) -> tuple[str, ...]:
        signal = compile_signal(program, text)
        return signal.near if isinstance(signal, BadCondition) else ()

    def signals(self) -> tuple[TraceSignal, ...]:
        """What was sampled."""
        return tuple(self._described)

    def buffer(self) -> TraceBuffer:
        """All rows."""
        buffer = TraceBuffer([type or BOOL for type in self._types], max(1, sum(map(len, self._parts))))
        for part in self._parts:
            buffer.append(part)
        return buffer


_LARGEST = Elementary("LWORD", BOOL.kind, 8)


def _swaps(entries: Sequence[Entry]) -> list[int]:
    """The first scan before which the program changed; empty if it never did."""
    return [each.scan for each in entries if isinstance(each.plan.effect, Swapped)][:1]
