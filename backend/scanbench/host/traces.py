"""The traces of one PLC: what its engine samples is taken here, in the loop's thread, and read in a thread of its own."""

import logging
import threading
from dataclasses import replace
from queue import SimpleQueue

from scanbench.host.link import Link
from scanbench.program.program import Program
from scanbench.recording.timeline import Timeline
from scanbench.runtime.clock import monotonic_ns
from scanbench.taps.trace import MAX_BYTES, MAX_TRACES, BadTrace, Trace, total_bytes
from scanbench.taps.trace_buffer import PAGE, TooMany
from scanbench.wire import host as protocol
from scanbench.wire.traces import DefineTrace, DriveTrace, ReadTrace, TraceRead, TracesAre, TraceStatus

log = logging.getLogger("scanbench")
_GROWN_NS = 200_000_000
"""How often it is told that a trace has grown."""


class Traces:
    """Answers `DefineTrace`, `DriveTrace` and `ReadTrace`."""

    def __init__(self, timeline: Timeline, link: Link) -> None:
        self._timeline, self._link = timeline, link
        self._traces: dict[int, Trace] = {}
        self._told: TracesAre | None = None
        self._grown_at = 0
        self._asked: SimpleQueue[ReadTrace] = SimpleQueue()
        self._reader: threading.Thread | None = None
        self._as_one = threading.Lock()
        """What a trace is and what it holds belong together: held while both change, and while a reader gets hold of both."""

    @property
    def _program(self) -> Program:
        return self._timeline.live.program

    # ---- the loop's thread ----------------------------------------------------------------------------------------

    def serve(self, message: object) -> None:
        """Defines, starts, stops, deletes."""
        assert isinstance(message, DefineTrace | DriveTrace)
        self.drain()
        near: tuple[str, ...] = ()
        try:
            with self._as_one:
                said = self._define(message) if isinstance(message, DefineTrace) else self._drive(message)
            ok = True
        except BadTrace as error:
            said, near, ok = str(error), error.near, False
        self._aim_engine()
        self._tell()
        self._link.post(protocol.Ack(message.ref, ok, said, self._timeline.live_scan, near))

    def drain(self) -> None:
        """Takes what was sampled: after each run, and before anything else may change what is sampled."""
        scan, changed = self._timeline.live_scan, False
        for trace in self._traces.values():
            if trace.running:
                with self._as_one:
                    changed = trace.drain(scan) or changed
        if changed:
            self._aim_engine()
            self._tell()

    def tick(self) -> None:
        """Tells how much there is."""
        self.drain()
        now = monotonic_ns()
        if now >= self._grown_at and (self._traces or (self._told is not None and self._told.traces)):
            self._grown_at = now + _GROWN_NS
            self._tell()

    def moved(self) -> None:
        """Looks the signals up again, as a new program may run. The samples of the old one were drained after its last run."""
        if self._timeline.past:
            return
        self.drain()
        program = self._program
        with self._as_one:
            for trace in self._traces.values():
                trace.aim(program, self._timeline.live_scan)
        self._aim_engine()
        self._tell()

    def _define(self, wanted: DefineTrace) -> str:
        trace, program = self._traces.get(wanted.id), self._program
        fresh = trace is None
        if trace is None:
            if len(self._traces) >= MAX_TRACES:
                raise BadTrace(f"There are {MAX_TRACES} traces already, which is the most: delete one first.")
            trace = Trace(wanted.id, wanted.definition, wanted.author)
        elif trace.definition == replace(wanted.definition, name=trace.definition.name) and not wanted.start:
            trace.rename(wanted.definition.name, wanted.author)
            return f"trace {wanted.definition.name}"
        tried = Trace(wanted.id, wanted.definition, wanted.author)
        tried.define(wanted.definition, program, wanted.author)
        self._refuse_large(wanted.id, tried)
        same = replace(trace.definition, name=wanted.definition.name, signals=wanted.definition.signals)
        if not fresh and not wanted.start and wanted.definition == same:
            trace.choose(wanted.definition, program, self._timeline.live_scan, wanted.author)
            return f"trace {wanted.definition.name} changed"
        run = wanted.start or trace.running
        trace.define(wanted.definition, program, wanted.author)
        self._traces[wanted.id] = trace
        if run:
            trace.start(program, self._timeline.live_scan)
        return f"trace {wanted.definition.name} {'made' if fresh else 'changed'}"

    def _refuse_large(self, id: int, tried: Trace) -> None:
        others = total_bytes({known: trace for known, trace in self._traces.items() if known != id})
        if others + tried.bytes > MAX_BYTES:
            fits = max(0, (MAX_BYTES - others) // tried.row_bytes * tried.definition.every)
            raise BadTrace(
                f"A buffer of {tried.definition.scans:,} scans takes {tried.bytes / (1 << 20):.1f} MiB, and all traces of a PLC"
                f" may take {MAX_BYTES >> 20}: {fits:,} scans would fit."
            )

    def _drive(self, wanted: DriveTrace) -> str:
        trace = self._traces.get(wanted.id)
        if trace is None:
            raise BadTrace(f"There is no trace {wanted.id} any more.")
        name = trace.definition.name
        match wanted.action:
            case "start":
                trace.start(self._program, self._timeline.live_scan)
                return f"trace {name} {trace.state}"
            case "stop":
                trace.stop()
                return f"trace {name} stopped"
            case "delete":
                del self._traces[wanted.id]
                return f"trace {name} deleted"
        raise BadTrace(f"`{wanted.action}` is nothing that a trace can do: start, stop, delete.")

    def _aim_engine(self) -> None:
        """What the PLC samples from now on; rows that were not taken would be lost."""
        self._timeline.resource.waiting.samplings = tuple(
            one for trace in self._traces.values() for one in trace.samplings
        )

    def _tell(self) -> None:
        traces = TracesAre(tuple(self._status(trace) for trace in self._traces.values()))
        if traces != self._told and not self._link.backlogged:  # else the next tick finds that they differ
            self._told = traces
            self._link.post(traces)

    def _status(self, trace: Trace) -> TraceStatus:
        first, end = trace.buffer.extent
        return TraceStatus(
            trace.id, trace.definition, trace.by, trace.state, trace.signals, trace.generation, trace.triggered,
            trace.hits, trace.buffer.rows, first, end, trace.bytes, self._program.interval_ns, trace.note,
        )  # fmt: skip

    # ---- the link's thread, and that of who reads -----------------------------------------------------------------

    def read(self, asked: ReadTrace) -> None:
        """Answers with samples, in due time: neither the scans nor the link wait for it."""
        self._asked.put(asked)
        if self._reader is None:
            self._reader = threading.Thread(target=self._read_all, name="traces", daemon=True)
            self._reader.start()

    def _read_all(self) -> None:
        while True:
            asked = self._asked.get()
            try:
                self._link.post(self._found(asked))
            except TooMany as error:
                self._link.post(TraceRead(asked.ref, b"", str(error)))
            except Exception as error:  # a look must not end the PLC, whatever comes of it
                log.exception("the samples of a trace cannot be read")
                said = "there is not enough memory for it" if isinstance(error, MemoryError) else str(error)
                self._link.post(TraceRead(asked.ref, b"", f"The samples cannot be read: {said}"))

    def _found(self, asked: ReadTrace) -> TraceRead:
        with self._as_one:
            trace = self._traces.get(asked.id)
            if trace is None:
                return TraceRead(asked.ref, b"", f"There is no trace {asked.id} any more.")
            status, buffer = self._status(trace), trace.buffer
        first, end = buffer.extent
        last = end if asked.last is None else asked.last
        if not asked.page:
            samples = buffer.read(asked.first, last, asked.points)
            return TraceRead(asked.ref, samples.pack(first, end, status.generation))
        samples = buffer.newest(asked.first, last, buffer.rows_in(PAGE))
        return TraceRead(asked.ref, samples.pack(first, end, status.generation), status=status)
