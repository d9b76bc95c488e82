"""Verifications that come back when the server has started again."""

import asyncio
from collections.abc import Callable
from dataclasses import replace

from scanbench.server.verification import TraceSource, Verification
from scanbench.session.session import Session
from scanbench.wire.events import Event, StateChanged
from scanbench.wire.refused import Refused
from scanbench.wire.verifying import VerificationStatus

MOST_AGAIN = 20_000
"""Scans that one that follows a PLC verifies again."""
ELSEWHERE = "the server has started again: connect to the controller again"
_LOST = "the server has started again, and it could not go on"


def before_it(status: VerificationStatus) -> VerificationStatus:
    """What is wanted of one that comes back: one that was stopped shows the scans that it had come to."""
    wanted = status.wanted
    if status.state == "stopped" and status.source != "trace" and status.scan is not None:
        wanted = replace(wanted, pace="free", first=status.first, last=status.scan)
    return replace(status, wanted=wanted)


async def ready(session: Session) -> None:
    """Until its PLC has started."""
    there = asyncio.Event()

    def on_event(event: Event) -> None:
        if isinstance(event, StateChanged) and event.state.state != "starting":
            there.set()

    session.listen(on_event)
    try:
        if session.state.state == "starting":
            await there.wait()
    finally:
        session.ignore(on_event)


async def take_up(
    verification: Verification, status: VerificationStatus, trace: TraceSource | None, tell: Callable[[], None]
) -> None:  # fmt: skip
    """Verifies again what was verified, from the run file or the log, which gives the same rows; then it goes on."""
    await _take_up(verification, status, trace)
    tell()


async def _take_up(verification: Verification, status: VerificationStatus, trace: TraceSource | None) -> None:
    session = verification.session
    if status.source == "trace" and (trace is None or not trace.file.exists()):
        await _give_up(verification, status, ELSEWHERE if status.last is None else _LOST)
        return
    if status.state == "failed":
        await _give_up(verification, status, status.message)
        return
    await ready(session)
    live = max(session.state.scan, session.state.live_scan)
    verification.begin_from = max(status.first, live - MOST_AGAIN)
    try:
        await verification.begin()
    except Refused as refused:
        await _give_up(verification, status, refused.message)


async def _give_up(verification: Verification, status: VerificationStatus, why: str) -> None:
    """It is there as it was, without its rows."""
    verification.status = replace(status, state="failed", message=why, auto=False, rows=0, forgotten=0)
    await verification.release()
