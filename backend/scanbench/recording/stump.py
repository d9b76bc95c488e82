"""A short run file that begins in the middle of a run: what is tried from one place again and again is copied from it."""

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

from scanbench.public import iso
from scanbench.recording.blocks import Codec, keyframe
from scanbench.recording.format import Kind, RunFile
from scanbench.recording.journal_roots import journal_roots
from scanbench.recording.reader import RunReader, Unreadable
from scanbench.runtime.clock import wall_time
from scanbench.runtime.command import Command, Entry, Refusal
from scanbench.runtime.resource import Resource


def write_stump(
    reader: RunReader, to: Path, scan: int, by: str, codec: Codec, count: int, first: Sequence[Command] = ()
) -> None:  # fmt: skip
    """Writes a file that has nothing but the state before `scan`, with the first `count` entries and then `first` entered there, and
    of the entries those on which later ones depend. `Unreadable`; `OSError`."""
    resource = reader.at(scan, count)
    entries = [*reader.entries[:count], *(_entered(resource, each) for each in first)]
    version, state = resource.version, resource.state
    roots = journal_roots(entries, codec.folds)
    about = replace(
        reader.recording.about,
        created=iso(wall_time()),
        by=by,
        thinned_before=0,
        dropped_before=scan,
        roots=len(roots),
        marks=True,
    )
    file = RunFile.create(to)
    try:
        file.append(Kind.ABOUT, 0, about.packed())
        for kept in reader.recording.programs.values():
            file.append(Kind.PROGRAM, 0, kept.packed())
        for index in roots:
            file.append(Kind.ENTRY, entries[index].scan, codec.pack(entries[index]))
        file.append(Kind.KEYFRAME, scan, keyframe(version, state))
        file.mark(scan)
    except BaseException:
        with suppress(OSError):
            to.unlink()
        raise
    finally:
        file.close()


def _entered(resource: Resource, command: Command) -> Entry:
    """Before the scan that is next."""
    made = command.settled(resource.view)
    plan = made.plan(resource.view)
    if isinstance(plan, Refusal):
        raise Unreadable(plan.message)
    entry = Entry(resource.header.scan, wall_time(), made, plan)
    resource.reenter(entry)
    return entry
