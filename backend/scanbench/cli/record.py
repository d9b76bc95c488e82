"""`scanbench run --record FILE`: the run as a file, as the bench itself keeps it."""

from pathlib import Path

from scanbench.check.program import Program
from scanbench.cli.inputs import usage
from scanbench.runtime.fingerprints import program_digest
from scanbench.runtime.header import Mode, fresh_image
from scanbench.runtime.recording import About, Recording
from scanbench.runtime.resource import Resource
from scanbench.session.codec import ENTRIES, pack_body
from scanbench.session.protocol import Sources

_VERSION = 1


def begin(path: Path, program: Program, files: dict[str, str], interval_ns: int) -> Recording:
    """A new run file for a run from a cold start."""
    sources = Sources(program.layout.model.name, files, interval_ns, _VERSION)
    try:
        recording = Recording.create(path, About.of(program, "command line"), ENTRIES)
        recording.program(_VERSION, pack_body(sources), program_digest(program))
        recording.checkpoint(0, _VERSION, bytes(fresh_image(program, Mode.MONITOR)[: program.layout.state_size]))
    except FileExistsError:
        usage(f"{path} is there already: remove it, or choose another name")
    except OSError as error:
        usage(f"{path} cannot be written: {error.strerror}")
    return recording


def end(recording: Recording, resource: Resource) -> None:
    """The state at the end, so that whoever opens the file sees it at once."""
    written = recording.checkpoint(resource.header.scan, _VERSION, resource.state)
    recording.note(resource.header.scan)
    recording.close()
    if not written:
        usage(f"the run could not be recorded whole: {recording.trouble}")
