"""Replay: the journal's plans entered again at their scans give the same image, byte for byte."""

from collections.abc import Iterable

from scanbench.engines.engine import Reason
from scanbench.recording.format import RunFileError
from scanbench.runtime.command import Entry
from scanbench.runtime.inside import Diverged
from scanbench.runtime.resource import Resource
from scanbench.runtime.trap import Trapped

__all__ = ["BETWEEN", "Diverged", "replay", "run_to"]

BETWEEN = 1 << 23
"""So many scans run at most from one recorded state to the next, however quick the program is (`checkpoints.py`). A run file
that says that more of them ran after its last state is not believed: nothing in it would ever bring them to an end."""


def replay(resource: Resource, entries: Iterable[Entry], until: int) -> None:
    """Runs to scan `until` as fast as possible, entering each entry's plan where it was entered first.

    What was entered inside of scan `until` is entered when that runs.
    """
    for entry in entries:
        run_to(resource, entry.scan)
        if entry.step:
            resource.await_step(entry)
            continue
        if isinstance(entry.command, Trapped):
            _break_off(resource)
        resource.reenter(entry)
    if not resource.header.halted_by_trap:
        run_to(resource, until)


def run_to(resource: Resource, scan: int) -> None:
    """Runs up to this scan, in which nothing is entered on the way; time alone passes while the program is stopped."""
    now = resource.header.scan
    if scan < now:
        raise Diverged(f"the journal goes on at scan {scan}, the image is at {now}")
    if not resource.runnable and not resource.header.halted_by_trap:
        resource.pass_time(scan - now)
    unproved = scan - max(resource.header.scan, resource.proved)
    if resource.runnable and unproved > BETWEEN:
        raise RunFileError(
            f"the run file says that scan {scan} was reached, {unproved} scans after its last state, and never are there more "
            f"than {BETWEEN}: it is damaged, or no run file of scanbench"
        )
    while (now := resource.header.scan) < scan:
        if not resource.runnable or resource.rerun(scan - now).reason is Reason.TRAP:
            raise Diverged(f"the replay stopped in scan {now}, before scan {scan}, where the journal goes on")


def _break_off(resource: Resource) -> None:
    """The part of a scan that ran before a trap."""
    scan = resource.header.scan
    while resource.runnable and resource.header.scan == scan:
        if resource.rerun(1).reason is Reason.TRAP:
            return
    raise Diverged(f"scan {scan} ended by a run-time error when it was recorded, and does not now")
