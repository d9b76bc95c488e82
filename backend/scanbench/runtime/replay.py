"""Replay: an image and a journal determine every later byte."""

from collections.abc import Iterable

from scanbench.runtime.command import Entry
from scanbench.runtime.resource import Resource
from scanbench.runtime.trap import Trapped


class Diverged(Exception):
    """The replay did not do what the journal says: the program or the engine is not the one that was recorded."""


def replay(resource: Resource, entries: Iterable[Entry], until: int) -> None:
    """Runs to scan `until` as fast as possible, entering each entry's plan where it was entered first."""
    for entry in entries:
        _run_to(resource, entry.scan)
        if isinstance(entry.command, Trapped):
            resource.rerun_trap(entry)
        else:
            resource.reenter(entry)
    if resource.runnable:
        _run_to(resource, until)


def _run_to(resource: Resource, scan: int) -> None:
    missing = scan - resource.header.scan
    if missing < 0:
        raise Diverged(f"the journal goes on at scan {scan}, the image is at {resource.header.scan}")
    if missing == 0:
        return
    if resource.runnable:
        resource.run(missing)
    if not resource.runnable and resource.trap is None:
        resource.pass_time(scan - resource.header.scan)
    if resource.header.scan != scan:
        raise Diverged(f"the replay stopped in scan {resource.header.scan}, before scan {scan}: {resource.trap}")
