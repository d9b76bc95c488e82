"""A short run file that begins in the middle of a run: what is tried from one place again and again is copied from it."""

from bisect import bisect_right
from contextlib import suppress
from dataclasses import replace
from operator import attrgetter
from pathlib import Path

from scanbench.public import iso
from scanbench.recording.blocks import Codec, keyframe
from scanbench.recording.format import Kind, RunFile
from scanbench.recording.journal_roots import journal_roots
from scanbench.recording.reader import RunReader
from scanbench.runtime.clock import wall_time


def write_stump(reader: RunReader, to: Path, scan: int, by: str, codec: Codec) -> None:
    """Writes a file that has nothing but the state before `scan`, with all that was entered there, and of the entries before it
    those on which later ones depend. `Unreadable`; `OSError`."""
    entries = reader.entries[: bisect_right(reader.entries, scan, key=attrgetter("scan"))]
    resource = reader.at(scan)
    version, state = resource.version, resource.state
    roots = journal_roots(entries, codec.folds)
    about = replace(
        reader.recording.about, created=iso(wall_time()), by=by, thinned_before=0, dropped_before=scan, roots=len(roots)
    )
    file = RunFile.create(to)
    try:
        file.append(Kind.ABOUT, 0, about.packed())
        for kept in reader.recording.programs.values():
            file.append(Kind.PROGRAM, 0, kept.packed())
        for index in roots:
            file.append(Kind.ENTRY, entries[index].scan, codec.pack(entries[index]))
        file.append(Kind.KEYFRAME, scan, keyframe(version, state))
    except BaseException:
        with suppress(OSError):
            to.unlink()
        raise
    finally:
        file.close()
