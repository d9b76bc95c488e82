"""`scanbench run --record FILE`: the run as a file, as the bench itself keeps it."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from scanbench.cli.inputs import usage
from scanbench.program.program import Program
from scanbench.recording.recording import DEFAULT_LIMIT, Recording
from scanbench.wire.codec import ENTRIES, pack_body
from scanbench.wire.host import Sources

LIMIT = DEFAULT_LIMIT
"""Bytes of a file: a longer run keeps fewer checkpoints of its beginning, and of a very long one the beginning goes."""
_VERSION = 1


@contextmanager
def recorded(
    path: Path | None, program: Program, files: dict[str, str], interval_ns: int
) -> Iterator[Recording | None]:
    """A run file for a run from a cold start, if one is wanted. Of a run that fails no file is left."""
    if path is None:
        yield None
        return
    sources = Sources(program.layout.model.name, files, interval_ns, _VERSION)
    try:
        recording = Recording.begin(path, program, _VERSION, pack_body(sources), ENTRIES, "command line", LIMIT)
    except FileExistsError:
        usage(f"{path} is there already: remove it, or choose a different name")
    except OSError as error:
        usage(f"{path} cannot be written: {error.strerror}")
    try:
        with recording:
            yield recording
    except BaseException:
        path.unlink(missing_ok=True)
        raise


def check_whole(recording: Recording) -> None:
    """Refuses a file that ran out of room."""
    if recording.trouble:
        usage(f"the run could not be recorded whole: {recording.trouble}")
