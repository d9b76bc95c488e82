"""A recorded run: the PLC goes on at its live end, and any earlier scan can be shown, copied, and gone on from.

What is shown and what runs are one resource. To show the past its state is put aside, the nearest checkpoint is put in
its place, and the journal is re-entered up to the scan; to return the state is put back. So watches, forces and errors
that people see are those of then, through the same doors, and nothing but a return can change the run.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from scanbench.engines.engine import Pace, Stop
from scanbench.runtime.checkpoints import Checkpoints
from scanbench.runtime.command import Command, Entry, Refusal
from scanbench.runtime.detect import Detect
from scanbench.runtime.fingerprints import model_fingerprint, program_digest
from scanbench.runtime.journal import Journal
from scanbench.runtime.programs import Loaded, Programs
from scanbench.runtime.recording import DEFAULT_LIMIT, About, Codec, KeptProgram, Recording
from scanbench.runtime.replay import Diverged, replay
from scanbench.runtime.resource import Measured, Resource
from scanbench.runtime.runfile import RunFileError

PAST = "this is the past: return to live, or branch from here"

ProgramsOf = Callable[[Mapping[int, KeptProgram]], Programs]
"""Makes programs of what a run file kept of them. The mapping grows with the run."""


@dataclass(frozen=True, slots=True)
class _Standing:
    """All that a resource is at one moment."""

    version: int
    scan: int
    state: bytes
    journal: Journal
    measured: Measured


class Timeline:
    """A run with its recording. Everything but `recording.sync` in the thread that runs the scans."""

    def __init__(self, recording: Recording, resource: Resource, programs: "KeptPrograms") -> None:
        """See `begin` and `resume`."""
        self.recording, self.resource = recording, resource
        self._programs = programs
        self._checkpoints = Checkpoints(recording)
        self._live: _Standing | None = None
        self._sent = 0
        self._whole = True
        """What is shown began with the journal as it is: nothing was dropped since."""

    @classmethod
    def begin(
        cls, path: Path, programs: Programs, version: int, sources: bytes, codec: Codec, by: str,
        detect: Detect | None = None, limit: int = DEFAULT_LIMIT,
    ) -> "Timeline":  # fmt: skip
        """A new run at scan 0 with a new file. `FileExistsError` when there is one of this name; `OSError`."""
        loaded = programs.get(version)
        recording = Recording.create(path, About.of(loaded.program, by), codec, limit)
        try:
            recording.program(version, sources, program_digest(loaded.program))
            kept = KeptPrograms(recording, programs)
            resource = Resource(loaded, programs=kept, detect=detect, recorder=recording)
            if not recording.checkpoint(0, version, resource.state):
                raise OSError(recording.trouble)
        except OSError:
            recording.close()
            path.unlink(missing_ok=True)
            raise
        return cls(recording, resource, kept)

    @classmethod
    def resume(
        cls, path: Path, programs_of: ProgramsOf, codec: Codec, until: int = 0, detect: Detect | None = None,
        limit: int = DEFAULT_LIMIT,
    ) -> "Timeline":  # fmt: skip
        """Goes on with a run file, at scan `until` or at the last scan that it knows of, whichever is later.

        `RunFileError` when it cannot be used, with what to do. Behind damage only what the file itself knows counts.
        """
        recording = Recording.open(path, codec, limit)
        try:
            programs = KeptPrograms(recording, programs_of(recording.programs))
            resource = open_at(recording, programs, len(recording.checkpoints) - 1, detect)
            entries = recording.entries[recording.checkpoints[-1].entries :]
            end = recording.last_scan if recording.lost else max(until, recording.last_scan)
            replay(resource, entries, end)
            resource.settle()
        except Diverged as error:
            recording.close()
            raise RunFileError(f"{path.name} cannot be gone on with: {error}") from error
        except RunFileError:
            recording.close()
            raise
        recording.entries = []  # the resource has them
        return cls(recording, resource, programs)

    def close(self) -> None:
        """Notes where the run stands, and closes the file."""
        self.recording.note(self.live_scan)
        self.recording.close()

    # ---- what there is --------------------------------------------------------------------------------------------

    @property
    def past(self) -> bool:
        """Whether the past is shown, and the PLC waits."""
        return self._live is not None

    @property
    def live_scan(self) -> int:
        """The scan that the PLC runs next."""
        return self._live.scan if self._live is not None else self.resource.header.scan

    @property
    def live_version(self) -> int:
        """The program that the PLC runs."""
        return self._live.version if self._live is not None else self.resource.version

    @property
    def version(self) -> int:
        """The program that is shown."""
        return self.resource.version

    @property
    def live_journal(self) -> Journal:
        """The whole journal, also while the past is shown."""
        return self._live.journal if self._live is not None else self.resource.journal

    @property
    def marks(self) -> Sequence[Entry]:
        """The points of the run that mean something to people."""
        return self.live_journal

    def new_entries(self) -> list[Entry]:
        """Those that nobody was told of yet: the first time all of them."""
        journal = self.live_journal
        new = journal[self._sent :]
        self._sent = len(journal)
        return new

    # ---- live -----------------------------------------------------------------------------------------------------

    def submit(self, command: Command) -> Entry | Refusal:
        """Enters a command in the seam of the live PLC."""
        if self._live is not None:
            return Refusal(PAST)
        outcome = self.resource.submit(command)
        self._checkpoints.take_due(self.resource)
        return outcome

    def add_program(self, version: int, sources: bytes) -> Refusal | None:
        """Keeps a program that the `Programs` have, so that a `ProgramChange` may change to it."""
        if version in self.recording.programs:
            return Refusal(f"there is a program version {version} in {self.recording.path.name} already")
        try:
            program = self._programs.inner.get(version).program
        except LookupError as error:
            return Refusal(str(error.args[0]))
        try:
            self.recording.program(version, sources, program_digest(program))
        except OSError:
            return Refusal(f"the program cannot be kept, so it cannot take over: {self.recording.trouble}")
        return None

    def run(self, scans: int, pace: Pace | None = None) -> Stop:
        """Runs up to `scans` scans, but no more than to the next checkpoint: callers go on as long as they want to."""
        if self._live is not None:
            raise RuntimeError("the past is shown: the PLC waits")
        stop = self.resource.run(min(scans, self.slice()), pace)
        self._checkpoints.take_due(self.resource)
        return stop

    def slice(self) -> int:
        """Scans until the next checkpoint is due."""
        return self._checkpoints.slice(self.resource)

    def pass_time(self, scans: int) -> None:
        """Virtual time goes on while the program is stopped."""
        if self._live is None:
            self.resource.pass_time(scans)

    def note(self) -> None:
        """Marks where the run stands; takes over what `recording.sync` made smaller. A few times a second is enough."""
        trim = self.recording.commit()
        if trim is not None:
            self._forget(trim.kept, trim.cut)
        if self.recording.trouble and self._live is None:
            self._checkpoints.take(self.resource)  # is there room again?
        self.recording.note(self.live_scan)

    def _forget(self, kept: tuple[int, ...], cut: int) -> None:
        """The front of the journal was dropped, but for what forces and errors are known by."""
        journal = self.live_journal
        left = Journal([*(journal[index] for index in kept), *journal[cut:]])
        self._sent = max(0, self._sent - len(journal) + len(left))
        if self._live is None:
            self.resource.journal = left
        else:
            live = self._live
            self._live = _Standing(live.version, live.scan, live.state, left, live.measured)
            self._whole = False

    # ---- the past -------------------------------------------------------------------------------------------------

    def goto(self, scan: int) -> Refusal | None:
        """Shows the state in which `scan` begins, with all that was entered in front of it."""
        before = self._standing()
        refusal = self._move(scan)
        if refusal is None:
            self._live = self._live or before
        return refusal

    def step(self, scans: int = 1) -> Refusal | None:
        """Shows a later scan of the past."""
        if self._live is None:
            return Refusal("this is live, not the past: run a scan")
        shown = self.resource.header.scan
        if shown >= self._live.scan:
            return Refusal("the past ends here: return to live to run the next scan")
        return self.goto(min(shown + scans, self._live.scan))

    def return_live(self) -> None:
        """Shows the PLC where it stands; it goes on when somebody lets it run."""
        if self._live is not None:
            self._stand(self._live)
            self._live, self._whole = None, True

    def cut(self, path: Path, scan: int | None, by: str) -> Refusal | None:
        """A new run file that ends in front of `scan`, or where the PLC stands now: for a branch, a clone, an export."""
        shown, live = self._standing(), self._live
        if scan is None:
            wanted = live or shown
        else:
            refusal = self._move(scan)
            if refusal is not None:
                return refusal
            wanted = self._standing()
            self._stand(shown)
        entries = len(wanted.journal)
        try:
            self.recording.copy(path, entries, wanted.scan, wanted.version, wanted.state, by)
        except OSError as error:
            return Refusal(f"the run cannot be written to {path.name}: {error.strerror}")
        return None

    def _move(self, scan: int) -> Refusal | None:
        """Puts the resource into the past; where that cannot be, it stays as it is."""
        live = self.live_scan
        if scan > live:
            return Refusal(f"scan {scan} has not come yet: the PLC is at scan {live}")
        checkpoint = self.recording.before(scan)
        if checkpoint is None:
            return Refusal(
                f"scan {scan} is not kept any more: the run can be gone back to scan {self.recording.first_scan}"
            )
        journal, resource = self.live_journal, self.resource
        before, shown = self._standing(), resource.header.scan
        resource.engine.stop_when(None)
        try:
            if not (self.past and self._whole and checkpoint.scan <= shown <= scan):
                state = self.recording.state(checkpoint)
                resource.restore(checkpoint.version, state, Journal(journal[: checkpoint.entries]))
            resource.measured = Measured()
            done = len(resource.journal)
            replay(resource, journal[done : _entries_upto(journal, scan)], scan)
        except (Diverged, LookupError, RunFileError, OSError) as error:
            self._stand(before)
            return Refusal(f"scan {scan} cannot be shown: {error}")
        return None

    def _standing(self) -> _Standing:
        resource = self.resource
        return _Standing(
            resource.version, resource.header.scan, resource.state, resource.journal, resource.measured
        )  # fmt: skip

    def _stand(self, standing: _Standing) -> None:
        self.resource.restore(standing.version, standing.state, standing.journal)
        self.resource.measured = standing.measured


class KeptPrograms:
    """Programs, but only those that the run file has, and only when they have come out as they were."""

    def __init__(self, recording: Recording, programs: Programs) -> None:
        self._recording, self.inner = recording, programs
        self._checked: set[int] = set()

    def get(self, version: int) -> Loaded:
        """See `Programs`."""
        kept = self._recording.programs.get(version)
        if kept is None:
            raise LookupError(f"there is no program version {version} in {self._recording.path.name}")
        loaded = self.inner.get(version)
        if version not in self._checked:
            if program_digest(loaded.program) != kept.digest:
                raise LookupError(
                    f"program version {version} of {self._recording.path.name} does not come out as it was when it was "
                    "recorded, as another version of scanbench compiles it: open it with the version that wrote it"
                )
            self._checked.add(version)
        return loaded


def open_at(recording: Recording, programs: KeptPrograms, index: int, detect: Detect | None = None) -> Resource:
    """A resource that stands at a checkpoint of a run file; `RunFileError` when its programs are not what they were."""
    checkpoint = recording.checkpoints[index]
    try:
        loaded = programs.get(checkpoint.version)
    except LookupError as error:
        raise RunFileError(str(error.args[0])) from error
    model = loaded.program.layout.model
    if model_fingerprint(model) != recording.about.model_fingerprint:
        raise RunFileError(
            f"{recording.path.name} was recorded on another description of the model {recording.about.model} than the "
            f"one that is installed: use the models it was recorded with"
        )
    resource = Resource(loaded, programs=programs, detect=detect, recorder=recording)
    resource.restore(checkpoint.version, recording.state(checkpoint), Journal(recording.entries[: checkpoint.entries]))
    return resource


def _entries_upto(journal: Sequence[Entry], scan: int) -> int:
    """How many entries there are up to the seam of `scan`."""
    low, high = 0, len(journal)
    while low < high:
        middle = (low + high) // 2
        if journal[middle].scan <= scan:
            low = middle + 1
        else:
            high = middle
    return low
