"""One verification, as the parent manages it: its process, its state, and what it does next.

The process re-runs the run file while the PLC runs, so a free pace costs the PLC nothing. With pace `scan` the PLC waits after
each scan, with pace `step` before each statement, until both sides were compared and somebody, or `auto`, continues.
"""

import asyncio
import logging
from collections.abc import Callable, Coroutine
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal, TypeVar

from scanbench.jobs.client import DIED, FAULT, Gone, Job
from scanbench.server.hold import Hold
from scanbench.server.verify_rows import Rows
from scanbench.server.verify_status import begun, verified, with_stretches
from scanbench.session.session import Session
from scanbench.verify.contract import AT_END, Memory
from scanbench.verify.trace.mapping import TraceMapping
from scanbench.wire.events import Event, StateChanged
from scanbench.wire.host import Sources
from scanbench.wire.refused import Refused
from scanbench.wire.verification import (
    BeginTrace,
    BeginVerify,
    ScansDone,
    ScansVerified,
    SetInputs,
    VerifyBegun,
    VerifyScans,
    VerifyStep,
)
from scanbench.wire.verifying import VerificationStatus, VerifyPace, VerifyWish

log = logging.getLogger("scanbench")

A = TypeVar("A")
MOST_LAG = 256
"""Scans by which a verification of a PLC that runs may lag; beyond that it continues with the newest ones."""
CAUGHT_UP = 64
"""So many of the newest it goes on with then."""
AT_ONCE = 200
"""Scans in one request. After each request it can be stopped, or its pace changed."""
_TRAPPED = "the PLC is stopped by a run-time error: restart it to go on"


@dataclass(frozen=True, slots=True)
class TraceSource:
    """A controller log, used as the control device."""

    file: Path
    name: str
    mapping: str
    """JSON of `verify.mapping.TraceMapping`."""


@dataclass(frozen=True, slots=True)
class _Cut:
    """A scan that a run-time error ended. When the program is restarted in it, more of it follows."""

    scan: int
    rows: int
    """So many were told."""


class Verification:
    """Everything in the event loop. `on_change` is called whenever the status changes."""

    def __init__(
        self, id: int, session: Session, wanted: VerifyWish, trace: TraceSource | None, author: str, cache: Path,
        on_change: Callable[["Verification"], None], hand_over: Callable[["Verification"], bool],
    ) -> None:  # fmt: skip
        """`hand_over`: whether a different verification holds the same PLC too, and takes over."""
        self.session, self.rows = session, Rows()
        source: Literal["live", "past", "trace"] = "live" if wanted.first is None else "past"
        self.status = VerificationStatus(
            id, session.id, author, wanted, "trace" if trace else source, wanted.pace, trace=trace.name if trace else "",
            sampled=trace is not None and TraceMapping.from_json(trace.mapping).gaps == "hold",
        )  # fmt: skip
        self._trace, self._on_change = trace, on_change
        self.mapping = "" if trace is None else trace.mapping
        self._job = Job(cache, self._on_end)
        self._run = session.instance.runs
        self._gone = self._elsewhere = False
        """Its process has ended; its control device is not the PLC."""
        self._busy = False
        """A request for scans is under way."""
        self._next = 0
        """The scan that is to be verified next."""
        self._at = (-1, 0)
        """Scan and count of the statement where the last step ended; the next one is about it. Count 0: of none."""
        self._stepping = False
        """A step is under way, not whole scans."""
        self._until = 0
        """Scans before this one were over as scans were asked for."""
        self._halt = self._behind = 0
        """The halt that was compared; up to which scan one that is taken up again may lag behind."""
        self.begin_from: int | None = None  # where one begins that follows the PLC, and is taken up again
        self.hold = Hold(session, lambda: hand_over(self))
        self._owed = 0
        """Scans that somebody may still go on by, with pace `scan`."""
        self._cut: _Cut | None = None
        self._tasks: set[asyncio.Task[None]] = set()

    # ---- life -----------------------------------------------------------------------------------------------------

    async def begin(self) -> None:
        """Until the range is understood; `Refused` says why it is not."""
        session, wanted, live = self.session, self.status.wanted, self._live_scan
        first = live if wanted.first is None else wanted.first
        if self._trace is not None:
            answer = await self._begun_trace(self._trace, session.instance.sources)
        else:
            if wanted.first is not None and not wanted.first < self._live_end:
                raise Refused(f"scan {wanted.first:,} is not over yet: the PLC is at scan {live:,}")
            if wanted.first is not None and wanted.last is not None and wanted.last < wanted.first:
                raise Refused(f"scans {wanted.first:,} to {wanted.last:,} are none")
            path = str(session.instance.run_file)
            answer = await self.ask(
                lambda ref: BeginVerify(ref, path, wanted.range, wanted.limit, live, first), VerifyBegun
            )
        self._change(begun(self.status, answer, self._live_scan))  # it took a while until now
        if self.begin_from is not None and self.status.source == "live":
            self._behind = self._live_scan
            self._change(first=min(max(self.begin_from, answer.first), self._behind))
        self._next = self.status.first
        session.listen(self._on_event)
        if self.status.pace != "free" and self.status.source == "live":
            await self.hold.hold(self.status.by)
        self._poke()

    async def _begun_trace(self, trace: TraceSource, sources: Sources) -> VerifyBegun:
        file, wanted = str(trace.file), self.status.wanted
        return await self.ask(
            lambda ref: BeginTrace(ref, sources, file, trace.name, trace.mapping, wanted.range, wanted.limit),
            VerifyBegun,
        )

    async def end(self) -> None:
        """Ends its process."""
        self.session.ignore(self._on_event)
        for task in self._tasks:
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)
        await self._job.end("the verification was ended")

    @property
    def over(self) -> bool:
        """Whether it has come to its end."""
        return self.status.state in ("done", "failed")

    @property
    def runs(self) -> bool:
        """Whether it has a process."""
        return not self._gone

    async def release(self) -> None:
        """Ends the process of one that is over; its rows stay, and can be looked at and kept."""
        self._gone = True
        await self._job.end("its process was ended as others began: begin a new verification")

    # ---- what users want ------------------------------------------------------------------------------------------

    async def drive(
        self, pace: VerifyPace | None, auto: bool | None, memory: Memory | None, action: str | None, author: str
    ) -> None:
        """Changes pace or memory; goes one further; stops or resumes."""
        status = self.status
        if status.state == "failed" and (pace, action) != (None, None):
            raise Refused(f"it has failed: {status.message}. Begin a new verification")
        if memory is not None and memory != status.memory:
            self._change(memory=memory, generation=status.generation + 1)
        if auto is not None:
            self._change(auto=auto)
        if pace is not None and pace != status.pace:
            self._change(pace=pace)
            if status.source == "live":
                await (self.hold.let_go(author) if pace == "free" else self.hold.hold(self.status.by))
        if action == "stop" and status.state not in ("done", "failed"):
            self._owed = 0
            self._change(state="stopped", message="")
            await self.hold.let_go(author)
            return
        if action == "resume" and self.status.state == "stopped":
            self._change(state="waiting", message="")
        if self.status.state == "stopped" or self.status.state == "done":
            if action == "go_on":
                raise Refused(
                    "it is over: begin a new verification"
                    if self.status.state == "done"
                    else "it is stopped: resume it"
                )
            return
        if action == "go_on":
            await self._go_on(author)
        elif self.status.auto and self.status.pace != "free":
            self._soon()
        self._poke()

    async def set_cells(self, edits: tuple[tuple[int, int, str, str], ...]) -> None:
        """The monitor runs these passes again on edited inputs."""
        self.rows.replace(await self.ask(lambda ref: SetInputs(ref, edits), ScansVerified))
        self._change(generation=self.status.generation + 1)

    # ---- going on -------------------------------------------------------------------------------------------------

    @property
    def holding(self) -> bool:
        """Whether the PLC is to wait for it."""
        status = self.status
        return status.source == "live" and status.pace != "free" and status.state in ("verifying", "waiting")

    @property
    def _live_scan(self) -> int:
        state = self.session.state
        return state.live_scan if state.past_by else state.scan

    @property
    def _live_end(self) -> int:
        """Scans before this one are over. A scan that a run-time error ended is over too, though the time did not advance."""
        state = self.session.state
        trapped = state.trap is not None and not state.past_by and state.trap.scan == state.scan
        return self._live_scan + (trapped or (self._cut is not None and self._cut.scan == self._live_scan))

    def _on_event(self, event: Event) -> None:
        if isinstance(event, StateChanged):
            self.hold.seen(event.state.state)
            self._poke()

    def _poke(self) -> None:
        """Asks for what is to be verified now, unless something is."""
        status, live = self.status, self._live_scan
        if self._cut is not None and self._cut.scan < live and not self._busy:
            if live - self._cut.scan <= MOST_LAG:  # the program was restarted in it
                self._next = min(self._next, self._cut.scan)
            else:
                self._cut = None
        if status.state in ("starting", "stopped", "done", "failed"):
            return
        if status.source != "trace" and self.session.instance.runs != self._run:
            self._fail("a new run began: begin a new verification")
        elif self._busy:
            return
        elif status.source != "live":
            self._poke_past(live)
        elif status.pace == "step":
            self._poke_halt(live)
        elif self._next < self._live_end:
            if status.pace == "free" and live - self._next > MOST_LAG and self._next >= self._behind:
                self._skip(live - CAUGHT_UP)
            self._scans(self._next, self._live_end - 1, live)

    def _poke_past(self, live: int) -> None:
        status = self.status
        assert status.last is not None
        until = (
            live if status.source == "past" else status.last + 1
        )  # a scan that a run-time error ended is known by itself
        if self._next > status.last:
            self._change(state="done", message="")
        elif status.pace == "free":
            self._scans(self._next, status.last, until)
        elif self._owed:
            self._owed -= 1
            if status.pace == "scan":
                self._scans(self._next, self._next, until)
            else:
                self._step(self._next, 0, until)
        elif status.state != "waiting":
            self._change(state="waiting")

    def _poke_halt(self, live: int) -> None:
        halt = self.session.state.halt
        # the last step was a run-time error
        trapped = halt is None and self._next < self._live_end and self._live_end > live
        moved = halt is not None and not halt.past and halt.number != self._halt
        if not trapped and not moved:
            return
        if self._at[1] and (halt is None or halt.scan > self._at[0]) and self._at[0] == self._next:
            # the last statement of that scan, before the scan is compared as a whole
            self._step(self._at[0], AT_END, live)
        elif halt is None:
            self._scans(self._next, live, live)
        elif self._next < halt.scan:  # those that are over by now are compared as a whole
            if halt.scan - self._next > MOST_LAG:
                self._skip(halt.scan - CAUGHT_UP)
            self._scans(self._next, halt.scan - 1, live)
        else:
            self._halt = halt.number
            if halt.count:
                self._step(halt.scan, halt.count, live)
            else:
                self._change(state="waiting")

    def _step(self, scan: int, count: int, until: int) -> None:
        """From where the last one ended, where that was in this scan; `count` as in `Verifier.step`."""
        after = self._at[1] if self._at[0] == scan and (not count or self._at[1] < count) else 0
        self._at, self._stepping = (-1, 0), True
        self._verify(lambda ref: VerifyStep(ref, scan, after, count, until))
        self._change(state="verifying", message="")

    def _scans(self, first: int, last: int, until: int) -> None:
        self._stepping, self._until = False, until
        last = min(last, first + AT_ONCE - 1)
        self._verify(lambda ref: VerifyScans(ref, first, last, until))
        if self.status.state != "verifying":
            self._change(state="verifying", message="")

    def _skip(self, to: int) -> None:
        """Goes on with this scan: those in between are not verified, and it says so."""
        skipped = to - self._next
        if skipped <= 0:
            return
        stretches = with_stretches(self.status.stretches, ((self._next, to - 1),))
        self._next = to
        self._change(skipped=self.status.skipped + skipped, stretches=stretches)

    async def _go_on(self, author: str) -> None:
        """One scan or statement further."""
        status, session = self.status, self.session
        if status.pace == "free":
            raise Refused("it goes on by itself: choose the pace scan or step to go on by hand")
        if status.source != "live":
            self._owed += 1
            return
        if session.state.past_by:
            raise Refused("the past is shown: return to live first")
        if self._live_end > self._live_scan:
            raise Refused(_TRAPPED)
        try:
            await self.hold.advance(status.pace, author, status.wanted.range)
        except Refused as refused:
            self._change(auto=False, message=refused.message)
            raise

    def _soon(self) -> None:
        """Goes on by itself."""

        async def go_on() -> None:
            if self.status.state in ("stopped", "done", "failed"):
                return
            try:
                await self._go_on(self.status.by)
                self._poke()
            except Refused as refused:
                self._change(auto=False, state="waiting", message=refused.message)

        self._do(go_on())

    # ---- the process ----------------------------------------------------------------------------------------------

    async def ask(self, make: Callable[[int], object], answer: type[A]) -> A:
        """What the process answers; `Refused`."""
        if self._gone:
            raise Refused("its process has ended: begin a new verification")
        return await self._job.ask(make, answer)

    def _verify(self, make: Callable[[int], object]) -> None:
        """Has scans verified; how long that takes is theirs, and it can be stopped."""

        async def on_part(part: object) -> None:
            if isinstance(part, ScansVerified):
                self._verified(part)

        async def verify() -> None:
            try:
                self._verified(await self._job.ask(make, ScansDone, None, on_part))
            except Gone:  # `_on_end` says so
                self._busy = False
            except Refused as refused:
                self._busy = False
                self._fail(refused.message)
            except Exception:
                log.exception("what a verification found could not be taken")
                self._busy = False
                self._fail(FAULT)

        self._busy = True
        self._do(verify())

    def _verified(self, came: ScansVerified) -> None:
        status = self.status
        if status.state == "failed":  # what comes after it may be of a new run
            return
        done, failed = isinstance(came, ScansDone), came.failed if isinstance(came, ScansDone) else ""
        came = self._without_known(came)
        self.rows.add(came)
        ended = bool(came.rows) and came.rows[-1].count == 0
        if self._stepping and came.rows and not ended:
            self._at = came.scan, came.rows[-1].count
        if not self._stepping or (ended and status.source != "live"):
            self._next = max(self._next, came.scan + 1)
        if done:
            self._busy = False
        going = status.state in ("verifying", "waiting", "starting")
        state = "failed" if failed else status.state
        if going and done and not failed:
            state = (
                "waiting"
                if status.pace != "free" or (self._next >= self._live_end and not self._elsewhere)
                else "verifying"
            )
        self._change(
            verified(status, came), state=state, message=failed or (_TRAPPED if self._cut is not None else ""),
            rows=self.rows.count, forgotten=self.rows.first,
        )  # fmt: skip
        if done and not failed:
            # whole scans that are compared on the way to a halt are no step: the halt is compared next
            stepped = status.pace == "scan" or status.source != "live" or self._stepping
            self._poke()
            if status.auto and status.pace != "free" and going and stepped and not self._busy:
                self._soon()

    def _without_known(self, came: ScansVerified) -> ScansVerified:
        """Of a scan that a run-time error ended, and in which the program was restarted, the rows that are new."""
        cut = self._cut
        if self._stepping or self.status.source != "live":
            return came
        if cut is not None and any(row.scan == cut.scan for row in came.rows):
            old = [row for row in came.rows if row.scan == cut.scan][: cut.rows]
            self._cut = None
            came = replace(came, rows=tuple(row for row in came.rows if row not in old), compared=came.compared - 1)
        if came.scan == self._until:  # it was asked for although a run-time error ended it and the time did not advance
            self._cut = _Cut(came.scan, sum(row.scan == came.scan for row in came.rows))
        return came

    def _on_end(self) -> None:
        """It died, or was ended."""
        self._gone = True
        if self.status.state not in ("failed", "done"):
            self._busy = False
            self._fail(DIED)

    def _fail(self, why: str) -> None:
        """The PLC need not wait any more."""
        self._change(state="failed", message=why, auto=False)
        self._do(self.hold.let_go(self.status.by))

    def _do(self, work: Coroutine[None, None, None]) -> asyncio.Task[None]:
        task = asyncio.get_running_loop().create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)
        return task

    def _change(self, status: VerificationStatus | None = None, **changes: object) -> None:
        self.status = replace(status or self.status, **changes)  # type: ignore[arg-type]  # names and types are the status' own
        self._on_change(self)
