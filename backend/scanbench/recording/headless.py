"""Runs a program without a clock, a socket or a person: the same commands give the same image, every time."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Generic, TypeVar

from scanbench.check.typed.condition import Condition
from scanbench.engines.engine import Reason
from scanbench.program.program import Program
from scanbench.recording.checkpoints import Checkpoints
from scanbench.recording.recording import Recording
from scanbench.runtime.agenda import Agenda
from scanbench.runtime.command import Command, Entry, Refusal
from scanbench.runtime.detect import Detect
from scanbench.runtime.interrupt import Interrupt
from scanbench.runtime.programs import EngineFactory, Loaded, Programs
from scanbench.runtime.resource import Resource

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Refused:
    """A command that the PLC did not take."""

    scan: int
    command: Command
    refusal: Refusal


@dataclass(frozen=True, slots=True)
class HeadlessRun(Generic[T]):
    """What came out. `scans` were run, or passed while the program was stopped; a trap ends the run."""

    resource: Resource
    scans: int
    entries: tuple[Entry, ...]
    refused: tuple[Refused, ...]
    rows: tuple[tuple[int, T], ...]
    """(scans run so far, what `sample` saw), every `every` scans."""
    met: bool = False
    """The run ended because the condition held."""
    unvalued: int | None = None
    """After this scan the condition had no value for the first time."""


def run_headless(
    program: Program, scans: int, engine_factory: EngineFactory, commands_at: Sequence[tuple[int, Command]] = (),
    every: int = 0, sample: Callable[[Resource], T] | None = None, *,
    detect: Detect | None = None, agenda: Agenda | None = None, recording: Recording | None = None,
    programs: Programs | None = None, until: Condition | None = None, interrupt: Interrupt | None = None,
    on_begin: Callable[[Resource], None] | None = None,
) -> HeadlessRun[T]:  # fmt: skip
    """Runs `scans` scans from a cold start in MONITOR mode.

    A command (n, c) is entered in the seam before scan n, counting from 0; several for one seam in the order given. n == `scans` is the seam after the
    last scan; what is later does not come to pass. While the program is stopped (a fatal error, mode PROGRAM) scans pass without it; the `agenda` enters
    what is due before the commands for a seam. A trap ends the run at once, and so does the first scan after which `until` holds, a condition for the
    program that the run begins with.

    A `recording` that is still at the cold start receives the whole run, with checkpoints, and is left open; `entries` has only what is still in there.
    Asked by the `interrupt`, the run ends after the scan that is running. `on_begin` is told the PLC before its first scan.
    """
    loaded = Loaded.make(program, engine_factory)
    resource = Resource(loaded, programs=programs, detect=detect, recorder=recording, agenda=agenda)
    recorded = _Recorded(recording, resource) if recording is not None else None
    awaited = _Awaited(resource, until)
    _begin(resource, interrupt, on_begin)
    refused: list[Refused] = []
    rows: list[tuple[int, T]] = []
    waiting = sorted(commands_at, key=lambda pair: pair[0])
    while resource.trap is None:
        now = resource.header.scan
        refused += _entered(resource, waiting, recorded)
        if now >= scans or awaited.met or (interrupt is not None and interrupt.asked):
            break
        stop = min([scans, *_stops(resource, waiting, every, recorded)])
        awaited.run(stop - now)
        if recorded is not None:
            recorded.take_due()
        done = resource.header.scan
        if every and sample is not None and done % every == 0 and done > now and resource.trap is None:
            rows.append((done, sample(resource)))
    if recorded is not None:
        recorded.end()
    return HeadlessRun(
        resource,
        resource.header.scan,
        tuple(resource.journal),
        tuple(refused),
        tuple(rows),
        awaited.met,
        awaited.unvalued,
    )


def _begin(resource: Resource, interrupt: Interrupt | None, on_begin: Callable[[Resource], None] | None) -> None:
    """Tells who waits for the PLC."""
    if interrupt is not None:
        interrupt.reaches(resource.interrupt)
    if on_begin is not None:
        on_begin(resource)


def _entered(resource: Resource, waiting: list[tuple[int, Command]], recorded: "_Recorded | None") -> Iterator[Refused]:
    """Enters the commands for this seam; those that the PLC does not take."""
    while waiting and waiting[0][0] <= resource.header.scan:
        at, command = waiting.pop(0)
        outcome = resource.submit(command)
        if isinstance(outcome, Refusal):
            yield Refused(at, command, outcome)
        elif recorded is not None:
            recorded.take_due()


def _stops(
    resource: Resource, waiting: Sequence[tuple[int, Command]], every: int, recorded: "_Recorded | None"
) -> Iterator[int]:
    """Scans in whose seam there is something to do."""
    now = resource.header.scan
    if waiting:
        yield waiting[0][0]
    if every:
        yield now - now % every + every
    if recorded is not None and resource.runnable:
        yield now + recorded.slice()


class _Awaited:
    """The condition at which a run ends."""

    def __init__(self, resource: Resource, until: Condition | None) -> None:
        self._resource, self._until = resource, until
        self.met = False
        self.unvalued: int | None = None
        """The first scan after which it had no value: the run comes back for that, too, but once."""
        resource.waiting.until = () if until is None else (until, replace(until, unknown=True))

    def run(self, scans: int) -> None:
        """So many scans; perhaps less: it comes back for what the program asks for."""
        resource = self._resource
        if not resource.runnable:
            resource.idle(scans)
        elif resource.run(scans).reason is Reason.CONDITION and self._until is not None:
            truth = resource.engine.truth(self._until)
            self.met = truth is True
            if truth is None:
                self.unvalued = resource.header.scan - 1
                resource.waiting.until = (self._until,)


class _Recorded:
    """The recording of a run: checkpoints when they are due, and the file within its bounds."""

    def __init__(self, recording: Recording, resource: Resource) -> None:
        self._recording, self._resource = recording, resource
        self._checkpoints = Checkpoints(recording)

    def slice(self) -> int:
        """Scans until something is due."""
        return self._checkpoints.slice(self._resource)

    def take_due(self) -> None:
        """What is due in this seam."""
        self._checkpoints.take_due(self._resource)
        self._tidy()
        if self._recording.info.bytes > self._recording.bounds.limit:
            self._recording.wait()  # nobody waits for this run, and it could be faster than what makes its file smaller
            self._tidy()

    def _tidy(self) -> None:
        trim = self._recording.tidy()
        if trim is not None:
            self._resource.journal = self._resource.journal.without_front(trim.kept, trim.cut)

    def end(self) -> None:
        """The state at the end, so that whoever opens the file sees it at once."""
        self._checkpoints.take(self._resource)
        self._recording.note(self._resource.header.scan)
