"""Replay: the journal's plans entered again at their scans give the same image, byte for byte."""

from collections.abc import Iterable, Sequence
from struct import error as struct_error

from scanbench.engines.engine import Reason
from scanbench.recording.fingerprints import model_fingerprint
from scanbench.recording.format import RunFileError
from scanbench.recording.gaps import Lost
from scanbench.recording.programs import KeptPrograms
from scanbench.recording.recording import Recording
from scanbench.recording.thinning import Checkpoint
from scanbench.runtime.agenda import Agenda
from scanbench.runtime.command import Entry
from scanbench.runtime.detect import Detect
from scanbench.runtime.inside import Diverged
from scanbench.runtime.journal import Journal
from scanbench.runtime.programs import Loaded, NoProgram
from scanbench.runtime.resource import Resource
from scanbench.runtime.trap import Trapped

__all__ = ["BETWEEN", "NOT_AS_RECORDED", "Diverged", "open_at", "replay", "run_to", "state_of"]

NOT_AS_RECORDED = (ValueError, TypeError, AttributeError, IndexError, OverflowError, struct_error)
"""What re-entering a journal comes to that nobody has recorded: plans that are none, patches outside of the image."""

BETWEEN = 1 << 23
"""So many scans run at most from one recorded state to the next, however quick the program is (`checkpoints.py`). A run file
that says that more of them ran after its last state is not believed: nothing in it would ever bring them to an end."""


def open_at(
    recording: Recording, programs: KeptPrograms, checkpoint: Checkpoint, entries: Sequence[Entry],
    detect: Detect | None = None, agenda: Agenda | None = None,
) -> Resource:  # fmt: skip
    """A resource with the state of a checkpoint; `RunFileError` when its programs are not those of the recorded run."""
    try:
        loaded = programs.get(checkpoint.version)
    except NoProgram as error:
        raise RunFileError(str(error)) from error
    model = loaded.program.layout.model
    if model_fingerprint(model) != recording.about.model_fingerprint:
        raise RunFileError(
            f"{recording.path.name} was recorded with a different description of the model {recording.about.model} than the "
            f"one that is installed: use the models it was recorded with"
        )
    resource = Resource(loaded, programs=programs, detect=detect, recorder=recording, agenda=agenda)
    resource.restore(loaded, state_of(recording, checkpoint, loaded), Journal(entries[: checkpoint.entries]))
    resource.proved = recording.checkpoints[-1].scan
    return resource


def state_of(recording: Recording, checkpoint: Checkpoint, loaded: Loaded) -> bytes:
    """The state that a checkpoint holds, of the program that ran there; `RunFileError` when it holds something else."""
    return recording.state(checkpoint, loaded.program.layout.state_size)


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
    lost = resource.recorder.why_lost(now, scan) if resource.recorder is not None else ""
    if lost:
        raise Lost(lost)
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
