"""How a program reacts to an error: the run with it is compared with the same run without it, scan by scan.

Both begin in one state and get the same commands. Runs are deterministic, so whatever differs outside of error memory is
the program's doing. What the PLC or the program entered by itself is not given to the run without the error: it finds
out again what there is to find.
"""

from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from scanbench.engines.observe import Observer, ReadAt
from scanbench.faults.details import Chosen, choose
from scanbench.faults.detect import Detection
from scanbench.faults.inject import ACTIVE, Generate, Recover
from scanbench.faults.reaction.effects import Effects, Variables
from scanbench.faults.reaction.error_memory import Watched, Words, code_bits, kept_bits, without_patches, words_of
from scanbench.faults.reaction.reaction import FINDINGS, Line, Reaction, Reader, Verdict, What
from scanbench.faults.reaction.readings import Readings
from scanbench.faults.reaction.states import Trace
from scanbench.faults.reaction.tasks import Turns, triggers
from scanbench.faults.reference import ErrorRef, find_error
from scanbench.problems import Span
from scanbench.program.program import Program
from scanbench.runtime.command import Command, Entry, Refusal, Swapped
from scanbench.runtime.header import Halt
from scanbench.runtime.journal import Journal
from scanbench.runtime.programs import Programs
from scanbench.runtime.resource import Resource
from scanbench.runtime.trap import TrapInfo, Trapped
from scanbench.symbols.sites import StatementSite

TRACE_LIMIT = 128 << 20
"""Bytes that the run without the error may take: what it changed, scan by scan."""
_NAMED = 3
"""Variables or statements that a note names."""


@dataclass(frozen=True, slots=True)
class Point:
    """A PLC before a scan, where a comparison begins."""

    version: int
    state: bytes
    journal: Journal


class Given(NamedTuple):
    """A command from outside that both runs get, and the scan before which it was entered."""

    scan: int
    entry: Entry


def react(
    point: Point, generate: Entry, following: Sequence[Entry], window: int, programs: Programs, error: str
) -> Reaction | Refusal:
    """The reaction to `error`, one of those that the recorded `generate` raised at this point.

    `following` is what the journal has after it. The window ends early before a change of the program or a restart.
    Errors that were raised together would hide each other's effects: each is compared as if it had been raised alone.
    """
    command = generate.command
    raised = command.errors if isinstance(command, Generate) else ()
    ref = next((each for each in raised if each.id == error), None)
    if ref is None:
        return Refusal(f"{error} was not raised there: {generate.plan.message}")
    rest = _following(point, generate, following, window, programs)
    others = [each.id for each in raised if each.id != error]
    twin = run_twin(point, _without(generate, rest.given, {error, *others}), rest.window, programs, TRACE_LIMIT)
    comparison = Comparison(point, programs, Prepared(programs.get(point.version).program))
    notes = [rest.note]
    if others:
        given = tuple(each for each in rest.given if _spared(each.entry.command, others) is not None)
        found = comparison.raised(twin, ref, command.author, given)
        notes.append(f"it was raised together with {', '.join(others)}, and is compared as if it had been alone")
    else:
        found = comparison.of(twin, generate, ref, rest.given)
    if isinstance(found, Refusal):
        return Refusal(f"{found.message} ({rest.note})" if rest.note else found.message)
    return replace(found, note="; ".join(filter(None, (found.note, *notes))))


@dataclass(frozen=True, slots=True)
class Twin:
    """The run without the error. Its last state is that of the trap where one ended it."""

    trace: Trace
    reached: frozenset[int]
    trap: TrapInfo | None


def run_twin(
    point: Point, commands: Sequence[tuple[int, Command | Entry]], window: int, programs: Programs,
    limit: int,
) -> Twin:  # fmt: skip
    """Runs from a point with these commands, each before a scan; what is refused now is left out. An entry is one that
    was made inside of its scan."""
    resource = _resource_at(point, programs)
    observer = _observer(programs, point)
    observer.watch(())
    observer.take()
    trace = Trace(state_words(resource), limit)
    waiting = list(commands)
    while len(trace) < window and not trace.full and resource.trap is None:
        while waiting and waiting[0][0] <= resource.header.scan:
            _give(resource, waiting.pop(0)[1])
        _advance(resource)
        trace.add(state_words(resource))
    return Twin(trace, observer.take().reached, resource.trap)


class Prepared:
    """What every comparison on one program needs."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self.variables = Variables(program)
        self.kept = kept_bits(program)
        self.readings = Readings(program, self.variables.deciding.instances)


class Comparison:
    """Compares runs that begin at one point."""

    def __init__(self, point: Point, programs: Programs, prepared: Prepared) -> None:
        self._point, self._programs, self._prepared = point, programs, prepared

    def raised(
        self, twin: Twin, ref: ErrorRef, author: str, given: Sequence[Given] = ()
    ) -> Reaction | Refusal:  # fmt: skip
        """The reaction to an error that is raised alone, now, with the commands that follow."""
        resource = _resource_at(self._point, self._programs)
        entry = resource.submit(Generate(author, (ref,)))
        if isinstance(entry, Refusal):
            return entry
        return self.of(twin, entry, ref, given)

    def of(self, twin: Twin, generate: Entry, ref: ErrorRef, given: Sequence[Given]) -> Reaction | Refusal:
        """The reaction to an error of an entry that is made at the point, with the commands that follow."""
        program = self._prepared.program
        known = find_error(program.layout.model, ref.id)
        chosen = known if isinstance(known, Refusal) else choose(known, dict(ref.details), program.layout)
        if isinstance(chosen, Refusal):
            return chosen
        resource = _resource_at(self._point, self._programs)
        could_run = resource.runnable
        present = [id for id in resource.journal.derived(ACTIVE) if id != ref.id]
        _reenter(resource, generate)
        if resource.header.halt & Halt.FATAL_ERROR and chosen.error.severity == "fatal":
            return Reaction("stopped", 0, note="" if could_run else "the program did not run before either")
        own = [generate, *(each.entry for each in given if _is_about(each.entry.command, ref.id))]
        kept = without_patches(self._prepared.kept, (patch for entry in own for patch in entry.plan.patches))
        run = _Run(resource, twin, Effects(self._prepared.variables, kept), chosen, ref, self._prepared.readings)
        found = run.through(_observer(self._programs, self._point), given)
        if isinstance(found, Refusal) or found.verdict not in FINDINGS or not present:
            return found
        hidden = f"{', '.join(present)} was present before: what follows from both is no difference"
        return replace(found, note="; ".join(filter(None, (found.note, hidden))))


class _Run:
    """The run with the error, compared with its twin."""

    def __init__(
        self, resource: Resource, twin: Twin, effects: Effects, chosen: Chosen, ref: ErrorRef, readings: Readings
    ) -> None:  # fmt: skip
        self._resource, self._twin, self._effects, self._chosen, self._ref = resource, twin, effects, chosen, ref
        self._readings = readings
        self._watched = Watched.of(resource.program, chosen)
        self._readers: dict[tuple[int, What], int] = {}
        self._triggered: dict[tuple[str, Span, What], int] = {}
        self._looked: set[int] = set()
        """Statements that came to read there, whatever it showed then."""
        self._reached: set[int] = set()
        self._turns = Turns(resource.program)
        self._recovered: int | None = None
        """The scan after which the program itself took the error back."""
        self._ran = False

    def through(self, observer: Observer, given: Sequence[Given]) -> Reaction | Refusal:
        """Runs to the end of the window, or of what can be compared."""
        resource, waiting, scan = self._resource, list(given), 0
        observer.watch(self._watched.bits)
        observer.take()
        looking = tuple(triggers(resource.program, self._watched))
        for without in self._twin.trace.states():
            _enter(resource, waiting)
            shown = self._kinds_shown()
            scan += 1
            if resource.runnable:
                self._ran = True
                self._turns.ran(resource.header.scan)
                self._look(looking, scan, shown)
            entered = len(resource.journal)
            _advance(resource)
            if self._recovered is None and any(_takes_back(each, self._ref) for each in resource.journal[entered:]):
                self._recovered = scan
            seen = observer.take()
            self._reached |= seen.reached
            self._read(seen.reads, scan, shown)
            self._effects.compare(scan, without, state_words(resource))
            if resource.trap is not None:
                break
        if not self._ran:
            return Refusal("the program did not run, so nothing can be said about it: change to MONITOR or RUN first")
        return self._reaction(scan, observer.sites.statements)

    def _kinds_shown(self) -> frozenset[What]:
        """What of the error can be read in this scan: its flag, its details and its record in the log, its code too unless a more
        serious error hides it; once it was recovered, only its record in the log."""
        if self._chosen.error.id not in self._resource.journal.derived(ACTIVE):
            return frozenset(("log",))
        code = sum(
            self._resource.memory[part.offset] << 8 * index
            for index, part in enumerate(code_bits(self._resource.program))
        )
        return frozenset(("flag", "detail", "log", *(("code",) if code == self._chosen.code else ())))

    def _look(self, looking: Iterable[tuple[str, Span, What]], scan: int, shown: frozenset[What]) -> None:
        for task, span, what in looking:
            if what in shown:
                self._triggered.setdefault((task, span, what), scan)

    def _read(self, reads: Iterable[ReadAt], scan: int, shown: frozenset[What]) -> None:
        for read in reads:
            self._looked.add(read.site)
            for what in self._watched.kinds(read.offset, read.mask):
                if what in shown:
                    self._readers.setdefault((read.site, what), scan)

    def _reaction(self, scans: int, sites: Sequence[StatementSite]) -> Reaction:
        effects, readers = self._effects, self._places(sites)
        reached = {(sites[each].span.file, sites[each].span.line) for each in self._reached - self._twin.reached}
        seen = (effects.first, self._recovered, scans if self._stops_otherwise(scans) else None)
        first = min((each for each in seen if each is not None), default=None)
        under_way = effects.under_way() if first is None else {}
        if under_way:
            first = min(under_way.values())
        missed = self._missed() if first is None else ()
        verdict: Verdict
        if first is not None:
            verdict = "reacted"
        elif missed:
            verdict = "not_reached"
        elif effects.count:
            verdict = "stored_only"
        else:
            verdict = "no_effect" if readers else "never_read"
        return Reaction(
            verdict,
            scans,
            min(readers.values(), default=None),
            first,
            tuple(Reader(*place, scan) for place, scan in sorted(readers.items(), key=lambda each: each[1])),
            effects.shown(),
            effects.count,
            tuple(Line(*place) for place in sorted(reached)),
            "; ".join((*self._notes(scans), *self._more(scans, first is None, tuple(under_way), missed))),
        )

    def _missed(self) -> tuple[str, ...]:
        """The statements that would read what the error writes, and did not come to it."""
        return tuple(str(each) for each in self._readings.of(self._watched) if each.site not in self._looked)

    def _places(self, sites: Sequence[StatementSite]) -> dict[tuple[str, int, str, What], int]:
        """Who read what, and in which scan first."""
        found: dict[tuple[str, int, str, What], int] = {}
        for (number, what), scan in self._readers.items():
            site = sites[number]
            found.setdefault((site.span.file, site.span.line, site.pou, what), scan)
        for (task, span, what), scan in self._triggered.items():
            found.setdefault((span.file, span.line, task, what), scan)
        return found

    def _traps(self, scans: int) -> tuple[TrapInfo | None, TrapInfo | None]:
        """What stopped the program in the last scan, with the error and without it."""
        return self._resource.trap, self._twin.trap if scans == len(self._twin.trace) else None

    def _stops_otherwise(self, scans: int) -> bool:
        trap, without = self._traps(scans)
        return trap != without

    def _notes(self, scans: int) -> Iterator[str]:
        trap, without = self._traps(scans)
        if trap is not None and without is not None and trap != without:
            yield f"the program stopped with it: {trap}; and without it: {without}"
        elif trap is not None and without is None:
            yield f"the program stopped with it: {trap}"
        elif trap is not None:
            yield f"the program stops without it too: {trap}"
        elif without is not None:
            yield f"the program goes on with it, and stops without it: {without}"
        elif self._twin.trace.full:
            yield f"only {scans} scans were compared: the program changes too much memory for more"
        if not self._effects.complete:
            yield f"more than {self._effects.count} variables differ"

    def _more(self, scans: int, nothing: bool, under_way: Sequence[str], missed: Sequence[str]) -> Iterator[str]:
        if self._recovered is not None:
            yield f"the program recovered it itself, after {self._recovered} scan{'s' * (self._recovered != 1)}"
        if under_way:
            yield f"no output differed in the window; {_some(under_way)} did, and may decide one later"
        if missed:
            yield f"not reached in the {scans} scans: {_some(missed)}: a longer window or a different state would tell"
        if nothing:
            yield from self._turns.notes(scans)


def _some(names: Sequence[str]) -> str:
    return ", ".join(names[:_NAMED]) + (f" and {len(names) - _NAMED} more" if len(names) > _NAMED else "")


def _takes_back(entry: Entry, ref: ErrorRef) -> bool:
    """Whether an entry that the program made takes this error back."""
    command = entry.command
    if not isinstance(command, Recover):
        return False
    return command.ids is None or ref.id in command.ids or ref in command.numbers


# ---- steps of a run ------------------------------------------------------------------------------------------------


def _resource_at(point: Point, programs: Programs) -> Resource:
    """A PLC at the point. There is only one at a time, as the memory of a program is one."""
    loaded = programs.get(point.version)
    resource = Resource(loaded, programs=programs, detect=Detection())
    resource.restore(loaded, point.state, point.journal.prefix(len(point.journal)))
    resource.lenient = True
    return resource


def _observer(programs: Programs, point: Point) -> Observer:
    observer = programs.get(point.version).observer
    assert observer is not None, "what is compared runs on observed code"
    return observer


def _reenter(resource: Resource, entry: Entry) -> None:
    """As it was recorded: in the seam, or inside of the scan that is next."""
    if entry.step:
        resource.await_step(entry)
    else:
        resource.reenter(entry)


def _give(resource: Resource, command: Command | Entry) -> None:
    if isinstance(command, Entry):
        resource.await_step(command)
    else:
        resource.submit(command)


def _enter(resource: Resource, waiting: list[Given]) -> None:
    while waiting and waiting[0].scan <= resource.header.scan:
        _reenter(resource, waiting.pop(0).entry)


def _advance(resource: Resource) -> None:
    if resource.runnable:
        resource.run(1)
    else:
        resource.pass_time(1)


def state_words(resource: Resource) -> Words:
    """The state as it is now; not a copy."""
    return np.frombuffer(resource.memory, np.uint64, words_of(resource.program))


# ---- the journal after an error -----------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _Following:
    """What came after an error from outside, and how long it can be compared."""

    given: tuple[Given, ...]
    window: int
    note: str


def _following(
    point: Point, generate: Entry, following: Sequence[Entry], window: int, programs: Programs
) -> _Following:
    """Runs it once more as it was: what is entered again by itself came from the PLC or its program, the rest from outside."""
    resource = _resource_at(point, programs)
    _reenter(resource, generate)
    begin = resource.header.scan
    end, note = begin + window, ""
    left: list[Entry] = []
    for entry in following:
        if entry.scan >= end or isinstance(entry.command, Trapped):  # after a trap nothing is compared
            break
        if entry.plan.cuts:
            end = entry.scan
            note = "the program was changed" if isinstance(entry.plan.effect, Swapped) else "the program was restarted"
            break
        left.append(entry)
    given: list[Given] = []
    while resource.header.scan < end and resource.trap is None:
        while left and left[0].scan <= resource.header.scan:
            given.append(Given(left[0].scan, left.pop(0)))
            _reenter(resource, given[-1].entry)
        entered = len(resource.journal)
        _advance(resource)
        for made in resource.journal[entered:]:
            same = [each for each in left if each.scan <= resource.header.scan and each.command == made.command]
            if same:
                left.remove(same[0])
    return _Following(tuple(given), end - begin, note)


def _without(generate: Entry, given: Iterable[Given], errors: Collection[str]) -> list[tuple[int, Command | Entry]]:
    """The commands that the run without these errors gets. What is left of one inside of a scan comes after that."""
    found: list[tuple[int, Command | Entry]] = []
    for scan, entry in ((generate.scan, generate), *given):
        left = _spared(entry.command, errors)
        if left is not None and entry.step:
            found.append((scan, entry) if left is entry.command else (scan + 1, left))
        elif left is not None:
            found.append((scan, left))
    return found


def _spared(command: Command, errors: Collection[str]) -> Command | None:
    """What is left of a command when it is not to touch these errors."""
    if isinstance(command, Generate):
        left = tuple(each for each in command.errors if each.id not in errors)
        return replace(command, errors=left) if left else None
    if isinstance(command, Recover) and command.ids is not None:
        ids = tuple(id for id in command.ids if id not in errors)
        numbers = tuple(each for each in command.numbers if each.id not in errors)
        return replace(command, ids=ids, numbers=numbers) if ids or numbers else None
    return command


def _is_about(command: Command, error: str) -> bool:
    if isinstance(command, Generate):
        return any(each.id == error for each in command.errors)
    if not isinstance(command, Recover):
        return False
    return command.ids is None or error in command.ids or any(each.id == error for each in command.numbers)
