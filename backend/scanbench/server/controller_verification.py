"""A verification whose control device is a controller that runs elsewhere: it is read, and the same table fills as it runs."""

import asyncio
import logging
from collections import deque
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from scanbench.comm.controller.contract import Connection, Unreachable
from scanbench.comm.controller.opening import open_source
from scanbench.comm.controller.sampling import Read, Sampler, Settling, taken
from scanbench.jobs.client import FAULT
from scanbench.server.verification import TraceSource, Verification
from scanbench.session.session import Session
from scanbench.verify.contract import Memory
from scanbench.verify.trace.growing import LONGEST, TIME, Sample, most_samples
from scanbench.verify.trace.mapping import TraceMapping
from scanbench.wire.host import Sources
from scanbench.wire.refused import Refused
from scanbench.wire.verification import BeginController, TakeSamples, VerifyBegun
from scanbench.wire.verifying import VerifyPace, VerifyWish

log = logging.getLogger(__name__)
MOST_WAITING = 500
"""Samples that wait for the monitor; beyond that the oldest are left out."""
AT_ONCE = 20
"""Samples in one request."""


class ControllerVerification(Verification):
    """See `Verification`; there is only the free pace, since the controller waits for nobody."""

    def __init__(
        self, id: int, session: Session, wanted: VerifyWish, trace: TraceSource, connection: Connection, author: str,
        cache: Path, on_change: Callable[[Verification], None], hand_over: Callable[[Verification], bool],
    ) -> None:  # fmt: skip
        super().__init__(id, session, wanted, trace, author, cache, on_change, hand_over)
        self._sampler = Sampler(connection, open_source, self._on_trouble)
        self._interval_ms = connection.interval_ms
        self._waiting: deque[Sample] = deque()
        self._left_out = self._began_ns = 0
        self._wanted: list[int] = []
        """Places of the columns that are read."""
        self._settling: Settling | None = None
        self._elsewhere = True
        self._over = False
        """No more samples come."""
        self._last_from = -1
        """The scan from which on all the rest was asked for, after the last sample came."""
        self._left = 0
        """Samples that are still to be taken."""
        self._feeding: asyncio.Task[None] | None = None

    async def begin(self) -> None:
        """See `Verification`."""
        try:
            await super().begin()
        except Unreachable as error:
            raise Refused(error.message) from error
        most = most_samples(1 + len(self._sampler.found.columns))
        note = (
            f"Sampled every {self._interval_ms:,} ms, at most {most:,} times: scans in between run with the inputs of the sample before, "
            f"and what is shorter than that is not seen."
        )
        self._change(last=None, sampled=True, note=" ".join(filter(None, (self.status.note, note))))
        self._left = most - 1
        self._feeding = self._do(self._feed())

    async def _begun_trace(self, trace: TraceSource, sources: Sources) -> VerifyBegun:
        found = await self._sampler.begin()
        columns = (TIME, *found.columns)
        mapping = TraceMapping.from_json(trace.mapping)
        wanted = {each.column for each in mapping.columns if each.role != "ignore"} | {mapping.axis}
        self._wanted = [at for at, each in enumerate(found.columns) if each in wanted]
        first = await self._sampler.once(self._wanted)
        self._began_ns, range, limit = first.at_ns, self.status.wanted.range, self.status.wanted.limit
        begun = await self.ask(
            lambda ref: BeginController(
                ref, sources, trace.name, columns, self._cells(first), trace.mapping, range, limit
            ),
            VerifyBegun,
        )  # fmt: skip
        if mapping.unit == "scan":
            inputs = tuple(found.columns.index(each.column) for each in mapping.columns if each.role == "input")
            self._settling = Settling(found.columns.index(mapping.axis), inputs)
        longest_ms = LONGEST // 2 * begun.interval_ns // 1_000_000  # a sample may come late
        if self._interval_ms > longest_ms:
            raise Refused(
                f"too many scans lie between two samples at an interval of {self._interval_ms:,} ms: "
                f"choose one of at most {longest_ms:,} ms for this program"
            )
        return begun

    async def end(self) -> None:
        """See `Verification`."""
        await super().end()
        await self._sampler.close()

    async def drive(
        self, pace: VerifyPace | None, auto: bool | None, memory: Memory | None, action: str | None, author: str
    ) -> None:
        """See `Verification`."""
        if pace not in (None, "free") or action == "go_on":
            raise Refused(
                "a controller that runs elsewhere waits for nobody: its scans are verified at a free pace only"
            )
        await super().drive(pace, auto, memory, action, author)
        if self.status.state == "stopped":
            await self._pause()
        elif not self._over and not self.over and self._feeding is None:
            self._feeding = self._do(self._feed())

    async def _pause(self) -> None:
        """Leaves the controller alone: what it does meanwhile is not read."""
        feeding, self._feeding = self._feeding, None
        if feeding is not None:
            feeding.cancel()
            await asyncio.gather(feeding, return_exceptions=True)
        await self._sampler.close()

    # ---- samples ----------------------------------------------------------------------------------------------------

    async def _feed(self) -> None:
        """Reads the controller until enough was read, or it cannot be read any more."""
        try:
            async for read in taken(self._sampler, self._wanted, self._settling, self._left):
                self._left -= 1
                self._keep(read)
                self._poke()
        except Unreachable as error:
            self._fail(error.message)
        except Exception:
            log.exception("a controller could not be read")
            self._fail(FAULT)
        self._over = True
        await self._sampler.close()
        self._poke()

    def _fail(self, why: str) -> None:
        """See `Verification`; nobody wants samples any more."""
        super()._fail(why)
        if self._feeding is not None and self._feeding is not asyncio.current_task():
            self._feeding.cancel()
            self._do(self._sampler.close())

    def _keep(self, read: Read) -> None:
        self._waiting.append(Sample(self._cells(read), read.after_break))
        if len(self._waiting) > MOST_WAITING:  # the reference is slower than the controller
            self._waiting.popleft()
            self._waiting[0] = replace(self._waiting[0], after_break=True)
            self._left_out += 1

    def _cells(self, read: Read) -> tuple[str, ...]:
        return (f"{(read.at_ns - self._began_ns) / 1e6:.3f}", *read.cells)

    def _poke_past(self, live: int) -> None:
        # a request ends early where a further one waits: all is verified when one for the rest goes no further
        if self._waiting or (self._over and self._last_from != self._next):
            count = min(AT_ONCE, len(self._waiting))
            samples = tuple(self._waiting.popleft() for _ in range(count))
            first, last = self._next, self._over and not self._waiting
            self._last_from = first if last else -1
            self._verify(lambda ref: TakeSamples(ref, samples, first, last))
        elif self._over:
            self._change(last=self._next - 1, state="done", message=self._said())

    def _said(self) -> str:
        return (
            f"{self._left_out:,} samples were left out: the reference is slower than the controller"
            if self._left_out
            else ""
        )

    def _on_trouble(self, why: str) -> None:
        self._change(message=why or self._said())
