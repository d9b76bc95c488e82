"""What a verification is said to have come to, from what its process tells."""

from dataclasses import replace

from scanbench.reports.report import stretched
from scanbench.wire.verification import ScansDone, ScansVerified, VerifyBegun
from scanbench.wire.verifying import VerificationStatus, VerifyWish

STRETCHES = 100
Stretches = tuple[tuple[int, int], ...]


def begun(status: VerificationStatus, answer: VerifyBegun, live: int) -> VerificationStatus:
    """Its range is understood, while the PLC is at scan `live`."""
    first, last, notes = live, None, [answer.note]
    if status.source == "trace":
        first, last = answer.first, answer.end - 1
    elif status.wanted.first is not None:
        first, last, note = _of_the_past(status.wanted, status.wanted.first, answer.end)
        notes.append(note)
    return replace(
        status, title=answer.title, instances=answer.instances, first=first, last=last, version=answer.version,
        interval_ns=answer.interval_ns, note=" ".join(filter(None, notes)),
        state="waiting" if status.pace != "free" else "verifying",
    )  # fmt: skip


def _of_the_past(wanted: VerifyWish, first: int, end: int) -> tuple[int, int, str]:
    """The first and the last scan, and what is not as it was wanted."""
    last = end - 1 if wanted.last is None else min(wanted.last, end - 1)
    if wanted.last is None or last == wanted.last:
        return first, last, ""
    note = (
        f"Scans {first:,} to {wanted.last:,} were wanted, and {last:,} is the last that is over: "
        f"what comes after it is not compared."
    )
    return first, last, note


def verified(status: VerificationStatus, came: ScansVerified) -> VerificationStatus:
    """More scans, or a step of one."""
    new = next((row for row in came.rows if row.first is not None), None)
    if status.first_difference is None and new is not None:
        status = replace(status, first_difference=new.first, first_scan=new.scan)
    return replace(
        status, scan=came.scan if came.scan >= 0 else status.scan, compared=status.compared + came.compared,
        skipped=status.skipped + sum(last - first + 1 for first, last in came.skipped),
        stretches=with_stretches(status.stretches, came.skipped),
        differing=status.differing + sum(row.first is not None for row in came.rows), used=max(status.used, came.used),
        not_run=status.not_run + came.not_run, full=status.full + came.full,
        coverage=(came.coverage if isinstance(came, ScansDone) else None) or status.coverage,
    )  # fmt: skip


def with_stretches(known: Stretches, more: Stretches) -> Stretches:
    """The last of all."""
    made = list(known)
    for first, last in more:
        stretched(made, first, last)
    return tuple(made[-STRETCHES:])
