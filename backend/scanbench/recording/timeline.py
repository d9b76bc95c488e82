"""A recorded run: the PLC goes on at its live end, and any earlier scan can be shown, copied, and gone on from.

What is shown and what runs are one resource. To show the past its state is put aside, the nearest checkpoint is put in
its place, and the journal is re-entered up to the scan; to return the state is put back. So watches, forces and errors
that people see are those of then, through the same doors, and nothing but a return can change the run.
"""

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

from scanbench.check.typed.condition import Condition, compile_condition
from scanbench.engines.debug import Listen
from scanbench.engines.engine import Pace, Reason, Stop
from scanbench.recording.blocks import Codec
from scanbench.recording.checkpoints import Checkpoints
from scanbench.recording.fingerprints import program_digest
from scanbench.recording.format import RunFileError
from scanbench.recording.gaps import gap_between, gap_of
from scanbench.recording.moment import Moment, seam
from scanbench.recording.past import run_on
from scanbench.recording.programs import KeptPrograms, ProgramsOf
from scanbench.recording.recording import DEFAULT_LIMIT, Recording
from scanbench.recording.replay import NOT_AS_RECORDED, Diverged, open_at, replay, state_of
from scanbench.runtime.agenda import Agenda
from scanbench.runtime.command import Command, Entry, Refusal
from scanbench.runtime.detect import Detect
from scanbench.runtime.inside import HaltAt, Inside
from scanbench.runtime.journal import Journal
from scanbench.runtime.programs import Loaded, NoProgram, Programs
from scanbench.runtime.resource import Measured, Resource

PAST = "this is the past: return to live, or branch from here"
NOT_SHOWN = (Diverged, *NOT_AS_RECORDED, NoProgram, RunFileError, OSError)
"""What running a scan again comes to where the file, its programs or the code are not as they were recorded."""


class Timeline:
    """A run with its recording. Everything in the thread that runs the scans, but for `live`."""

    def __init__(self, recording: Recording, resource: Resource, programs: KeptPrograms) -> None:
        """See `begin` and `resume`."""
        self.recording, self.resource = recording, resource
        self._kept = programs
        self._checkpoints = Checkpoints(recording)
        self._live: Moment | None = None
        """The state of the live PLC while an earlier scan is shown."""
        self._sent = 0
        self._whole = True
        """Whether no entry was dropped from the journal since what is shown was last restored."""

    @classmethod
    def begin(
        cls, path: Path, programs: Programs, version: int, sources: bytes, codec: Codec, by: str,
        detect: Detect | None = None, limit: int = DEFAULT_LIMIT, agenda: Agenda | None = None,
    ) -> "Timeline":  # fmt: skip
        """A new run at scan 0 with a new file. `FileExistsError` when there is one of this name; `OSError`."""
        loaded = programs.get(version)
        recording = Recording.begin(path, loaded.program, version, sources, codec, by, limit)
        kept = KeptPrograms(recording, programs)
        resource = Resource(loaded, programs=kept, detect=detect, recorder=recording, agenda=agenda)
        return cls(recording, resource, kept)

    @classmethod
    def resume(
        cls, path: Path, programs_of: ProgramsOf, codec: Codec, until: int = 0, detect: Detect | None = None,
        limit: int = DEFAULT_LIMIT, agenda: Agenda | None = None,
    ) -> "Timeline":  # fmt: skip
        """Goes on with a run file, at scan `until` or at the last scan that it knows of, whichever is later.

        `RunFileError` when it cannot be used, with what to do. After damage only what the file itself knows counts.
        """
        recording = Recording.open(path, codec, limit)
        try:
            programs = KeptPrograms(recording, programs_of(recording.programs))
            checkpoint, entries = recording.checkpoints[-1], recording.take_entries()
            resource = open_at(recording, programs, checkpoint, entries, detect, agenda)
            end = recording.last_scan if recording.ends_early else max(until, recording.last_scan)
            resource.proved = max(resource.proved, until)
            replay(resource, entries[checkpoint.entries :], end)
            resource.proved = 1 << 64  # from here on it is what really runs
            resource.settle()
        except (Diverged, *NOT_AS_RECORDED) as error:
            recording.close()
            raise RunFileError(f"{path.name} cannot be gone on with: {error}") from error
        except BaseException:
            recording.close()
            raise
        return cls(recording, resource, programs)

    def close(self) -> None:
        """Notes the scan that the run has reached, and closes the file."""
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
    def live(self) -> Loaded:
        """The program that the PLC runs. Any thread."""
        live = self._live
        return live.loaded if live is not None else self.resource.loaded

    @property
    def live_image(self) -> tuple[Loaded, bytes | bytearray]:
        """That program, and its image where the PLC is or waits."""
        if self._live is not None:
            return self._live.loaded, self._live.state
        return self.resource.loaded, self.resource.memory

    @property
    def live_inside(self) -> Inside | None:
        """Where the PLC's next scan is halted, if it is."""
        return self._live.inside if self._live is not None else self.resource.listening.inside

    @property
    def live_journal(self) -> Journal:
        """The whole journal, also while the past is shown."""
        return self._live.journal if self._live is not None else self.resource.journal

    @property
    def programs(self) -> Programs:
        """The programs as they were given."""
        return self._kept.inner

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
        program = self.resource.program
        outcome = self.resource.submit(command)
        waiting = self.resource.waiting
        if self.resource.program is not program and waiting.until:
            again = [compile_condition(self.resource.program, each.text) for each in waiting.until]
            waiting.until = tuple(
                replace(each, unknown=before.unknown)
                for each, before in zip(again, waiting.until, strict=True)
                if isinstance(each, Condition)
            )
        self._checkpoints.take_due(self.resource)
        return outcome

    def add_program(self, version: int, sources: bytes) -> Refusal | None:
        """Keeps a program that the `Programs` have, so that a `ProgramChange` may change to it."""
        if version in self.recording.programs:
            return Refusal(f"there is a program version {version} in {self.recording.path.name} already")
        try:
            program = self._kept.inner.get(version).program
        except NoProgram as error:
            return Refusal(str(error))
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

    def drive(self, driven: bytes) -> None:
        """Keeps how the PLC is driven from here on, for who goes on with the run: `Recording.driven`. `OSError`."""
        self.recording.drive(self.live_scan, driven)

    def note(self) -> None:
        """Marks the scan that the run has reached, and keeps the file within its bounds. A few calls a second are enough."""
        trim = self.recording.tidy()
        if trim is not None:
            self._forget(trim.kept, trim.cut)
        if self.recording.trouble:  # is there room again?
            if self._live is None and not self.resource.begun:
                self._checkpoints.take(self.resource)
            else:
                with suppress(OSError):
                    self.drive(self.recording.driven)
        self.recording.note(self.live_scan)

    def _forget(self, kept: tuple[int, ...], cut: int) -> None:
        """The front of the journal was dropped, but for what forces and errors are known by."""
        journal = self.live_journal
        left = journal.without_front(kept, cut)
        self._sent = max(0, self._sent - len(journal) + len(left))
        if self._live is None:
            self.resource.journal = left
        else:
            self._live = replace(self._live, journal=left)
            self._whole = False

    # ---- the past -------------------------------------------------------------------------------------------------

    def goto(self, scan: int, count: int = 0) -> Refusal | None:
        """Shows the state in which `scan` begins, with all that was entered before it; with a count, where its statement
        of this count is next (`engines.debug`)."""
        return self._visit(scan, stay=True, count=count)

    def look_at(self, scan: int, look: Callable[[], None], begin: Moment | None = None) -> Refusal | None:
        """Goes to where a scan began, looks at it there, and comes back to what is shown. `begin` is the state of the PLC before the
        scan, where somebody has kept it (only live): nothing has to be run up to there then. What `look` raises is raised, after
        the return; it is a refusal where the scan does not go as it was recorded."""
        if begin is None:
            return self._visit(scan, stay=False, look=look, begin=True)
        live = self._live = Moment.of(self.resource)
        try:
            begin.restore(self.resource)
            look()
        except NOT_SHOWN as error:
            return Refusal(f"scan {scan} cannot be shown: {error}")
        finally:
            live.restore(self.resource)
            self._live = None
        return None

    def step(self, scans: int = 1) -> Refusal | None:
        """Shows a later scan of the past."""
        if self._live is None:
            return Refusal("this is live, not the past: run a scan")
        shown = self.resource.header.scan
        if shown >= self._live.scan:
            return Refusal("the past ends here: return to live to run the next scan")
        return self.goto(min(shown + scans, self._live.scan))

    def return_live(self) -> None:
        """Shows the live PLC again; it continues when somebody lets it run."""
        if self._live is not None:
            self._live.restore(self.resource)
            self._live, self._whole = None, True

    def copy(self, path: Path, scan: int | None, by: str, on_done: Callable[[Refusal | None], None]) -> None:
        """Writes a new run file that ends before `scan`, or with the current state: for a branch, a clone, an export.

        The state is taken now; a different thread writes the file, and calls `on_done` when it has done so. If the copy is
        refused at once, `on_done` is called at once.
        """

        def done(error: Exception | None) -> None:
            reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
            on_done(Refusal(f"the run cannot be written to {path.name}: {reason}") if error is not None else None)

        wanted = self._live or Moment.of(self.resource)
        if scan is not None and scan != wanted.scan:
            found: list[Moment] = []
            refusal = self._visit(scan, stay=False, look=lambda: found.append(Moment.of(self.resource)))
            if refusal is not None:
                on_done(refusal)
                return
            wanted = found[0]
        try:
            self.recording.copy(path, wanted.ending(), by, done)
        except OSError as error:
            done(error)

    def go_on(self, until: int) -> Stop:
        """Runs what is shown of the past on, with the resource's hook, to the seam before scan `until`, at most to that
        before the PLC's next scan. With `until` after that and the PLC in the middle of it, the hook has to halt there.

        HALTED: the hook halted it; INTERRUPTED: it stopped before `until`, perhaps because a different program follows here, or
        because scans are lost here, and what is shown now is the state after them.
        """
        if self._live is None or not self._whole:
            raise RuntimeError("there is no past to go on in: go to a scan of it first")
        gap = gap_between(self.recording.gaps, self.resource.header.scan, until)
        if gap is None:
            return run_on(self.resource, self._live, until)
        stop = run_on(self.resource, self._live, gap.first)
        if stop.reason is not Reason.DONE:
            return stop
        checkpoint = next(each for each in self.recording.checkpoints if each.at == gap.at)
        loaded = self._kept.get(checkpoint.version)
        state = state_of(self.recording, checkpoint, loaded)
        self.resource.restore(loaded, state, self._live.journal.prefix(checkpoint.entries))
        return Stop(Reason.INTERRUPTED)

    def rewind(self) -> None:
        """Puts the live PLC back to the beginning of the scan in which it is halted or has just trapped.

        For code that cannot be gone on with inside of a scan. `Diverged` and the like when the run cannot be repeated.
        """
        resource, journal, measured = self.resource, self.resource.journal, self.resource.measured
        scan = resource.header.scan
        checkpoint = self.recording.before(scan)
        assert self._live is None
        assert checkpoint is not None
        loaded = self._kept.get(checkpoint.version)
        resource.restore(loaded, state_of(self.recording, checkpoint, loaded), journal.prefix(checkpoint.entries))
        self._replay(journal[checkpoint.entries : seam(journal, scan, inside=False)], scan)
        resource.journal, resource.measured = journal, measured

    def _visit(
        self, scan: int, stay: bool, look: Callable[[], None] = lambda: None, count: int = 0, begin: bool = False
    ) -> Refusal | None:  # fmt: skip
        """Goes to a scan, looks at it there, and comes back unless it is to `stay`, and always when it cannot be shown or looked at."""
        live, shown, whole = self._live, Moment.of(self.resource), self._whole
        self._live = live or shown  # before anything is moved: other threads ask for what is live
        stays = False
        try:
            refusal = self._move(scan, count, begin or count > 0, was_past=live is not None)
            if refusal is None:
                look()
                stays = stay
            return refusal
        except NOT_SHOWN as error:
            return Refusal(f"scan {scan} cannot be shown: {error}")
        finally:
            if not stays:
                shown.restore(self.resource)
                self._live, self._whole = live, whole

    def _move(self, scan: int, count: int, begin: bool, was_past: bool) -> Refusal | None:
        """Puts the resource into the past; `begin`: to where the scan began, should it have trapped. Where it cannot,
        somebody has to put it back; `NOT_SHOWN`."""
        live, journal, resource = self.live_scan, self.live_journal, self.resource
        if scan > live:
            return Refusal(f"scan {scan} has not come yet: the PLC is at scan {live}")
        checkpoint = self.recording.before(scan)
        if checkpoint is None:
            return Refusal(
                f"scan {scan} is not kept any more: the run can be gone back to scan {self.recording.first_scan}"
            )
        gap = gap_of(self.recording.gaps, scan)
        if gap is not None:
            return Refusal(f"scan {scan} cannot be shown: {gap}")
        end = seam(journal, scan, begin)
        resource.leave()  # what was shown keeps its own journal
        on = checkpoint.scan <= resource.header.scan <= scan and checkpoint.entries <= len(resource.journal) <= end
        if not (was_past and self._whole and on):
            loaded = self._kept.get(checkpoint.version)
            state = state_of(self.recording, checkpoint, loaded)
            resource.restore(loaded, state, journal.prefix(checkpoint.entries))
            self._whole = True
        resource.measured = Measured()
        self._replay(journal[len(resource.journal) : end], scan)
        if count and not self._enter(scan, count):
            return Refusal(f"scan {scan} has no statement {count}: it did not get so far")
        return None

    def _replay(self, entries: Sequence[Entry], scan: int) -> None:
        """Runs the resource from its present state to the seam before a scan, without a listener."""
        with self.resource.listening.instead(None):
            replay(self.resource, entries, scan)

    def _enter(self, scan: int, count: int) -> bool:
        """From the seam before a scan to its statement of this count."""
        with self.resource.listening.instead(HaltAt(count), Listen(count=count)):
            while (stop := self.go_on(scan + 1)).reason is Reason.INTERRUPTED:
                pass
        return stop.reason is Reason.HALTED
