"""How a program reacts to an error: the run with it is compared with the same run without it, scan by scan.

Both begin in one state and get the same commands. Runs are deterministic, so whatever differs outside of error memory is
the program's doing. What the PLC or the program entered by itself is not given to the run without the error: it finds
out again what there is to find.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

from scanbench.engines.observe import Observer, ReadAt
from scanbench.faults.details import Chosen, choose
from scanbench.faults.inject import ACTIVE, Generate, Recover, in_the_way, present_texts, takes_back
from scanbench.faults.reaction.effects import SHOWN, Effects, Variables
from scanbench.faults.reaction.error_memory import Watched, code_bits, kept_bits, without_patches
from scanbench.faults.reaction.following import commands_without, following_of, is_about, spared
from scanbench.faults.reaction.reaction import (
    FINDINGS,
    Basis,
    Carried,
    Line,
    Reaction,
    Reader,
    Unreached,
    Verdict,
    What,
)
from scanbench.faults.reaction.readings import Readings
from scanbench.faults.reaction.required_rules import Made, Rules
from scanbench.faults.reaction.required_run import RequiredRun, stopped
from scanbench.faults.reaction.state_readers import StateReaders
from scanbench.faults.reaction.states import Trace
from scanbench.faults.reaction.steps import (
    Given,
    Point,
    advance,
    enter,
    give,
    observer_of,
    reenter,
    resource_at,
    state_words,
)
from scanbench.faults.reaction.tasks import Turns, triggers
from scanbench.faults.reaction.untried import by_hand
from scanbench.faults.reference import ErrorRef, covers, find_error
from scanbench.problems import Span
from scanbench.program.program import Program
from scanbench.runtime.command import Command, Entry, Refusal
from scanbench.runtime.header import Halt
from scanbench.runtime.programs import Programs
from scanbench.runtime.resource import Resource
from scanbench.runtime.trap import TrapInfo
from scanbench.symbols.sites import StatementSite

TRACE_LIMIT = 128 << 20
"""Bytes that the run without the error may take: what it changed, scan by scan."""


def react(
    point: Point, generate: Entry, following: Sequence[Entry], window: int, programs: Programs, error: str,
    rules: Rules | None = None, asked: int | None = None,
) -> Reaction | Refusal:  # fmt: skip
    """The reaction to `error`, one of those that the recorded `generate` raised at this point, in the notation of references.

    `following` is what the journal has after it. The window ends early before a change of the program or a restart.
    `asked` is the window for requirements, where the run does not have as much yet.
    Errors that were raised together would hide each other's effects: each is compared as if it had been raised alone.
    """
    command = generate.command
    raised = command.errors if isinstance(command, Generate) else ()
    ref = next((each for each in raised if covers(error, each)), None)
    if ref is None:
        return Refusal(f"{error} was not raised there: {generate.plan.message}")
    rest = following_of(point, generate, following, window, programs)
    others = [each for each in raised if each != ref]
    twin = run_twin(point, commands_without(generate, rest.given, raised), rest.window, programs, TRACE_LIMIT)
    twin = replace(twin, window=asked or window)
    comparison = Comparison(point, programs, Prepared(programs.get(point.version).program))
    notes = [rest.note]
    every = () if rules is None else rules.of(ref, None)
    if others:
        given = tuple(each for each in rest.given if spared(each.entry.command, others) is not None)
        found = comparison.raised(twin, ref, command.author, given, every)
        notes.append(
            f"it was raised together with {', '.join(map(str, others))}, and is compared as if it had been alone"
        )
    else:
        found = comparison.of(twin, generate, ref, rest.given, every)
    if isinstance(found, Refusal):
        return Refusal(f"{found.message} ({rest.note})" if rest.note else found.message)
    if rules is not None:
        found = replace(found, required=(*found.required, *by_hand(rules, ref)))
    return replace(found, note="; ".join(filter(None, (found.note, *notes))))


@dataclass(frozen=True, slots=True)
class Twin:
    """The run without the error. Its last state is that of the trap where one ended it."""

    trace: Trace
    reached: frozenset[int]
    trap: TrapInfo | None
    window: int
    """Scans that were asked for: the trace has fewer where something ended it early."""


def run_twin(
    point: Point, commands: Sequence[tuple[int, Command | Entry]], window: int, programs: Programs,
    limit: int,
) -> Twin:  # fmt: skip
    """Runs from a point with these commands, each before a scan; what is refused now is left out. An entry is one that
    was made inside of its scan."""
    resource = resource_at(point, programs)
    observer = observer_of(programs, point)
    observer.watch(())
    observer.take()
    trace = Trace(state_words(resource), limit)
    waiting = list(commands)
    while len(trace) < window and not trace.full and resource.trap is None:
        while waiting and waiting[0][0] <= resource.header.scan:
            give(resource, waiting.pop(0)[1])
        advance(resource)
        trace.add(state_words(resource))
    return Twin(trace, observer.take().reached, resource.trap, window)


class Prepared:
    """What every comparison on one program needs."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self.variables = Variables(program)
        self.kept = kept_bits(program)
        self.readings = Readings(program, self.variables.deciding.instances)
        self.state_readers = StateReaders(program, self.variables.deciding.instances)


class Comparison:
    """Compares runs that begin at one point."""

    def __init__(self, point: Point, programs: Programs, prepared: Prepared) -> None:
        self._point, self._programs, self._prepared = point, programs, prepared

    def raised(
        self, twin: Twin, ref: ErrorRef, author: str, given: Sequence[Given] = (), required: Sequence[Made] = ()
    ) -> Reaction | Refusal:  # fmt: skip
        """The reaction to an error that is raised alone, now, with the commands that follow."""
        resource = resource_at(self._point, self._programs)
        if (there := in_the_way(resource.view, ref)) is not None:
            return Refusal(f"{there} is present in this state already")
        entry = resource.submit(Generate(author, (ref,), anyway=True))
        if isinstance(entry, Refusal):
            return entry
        assert isinstance(entry.command, Generate)
        return self.of(twin, entry, entry.command.errors[0], given, required)

    def of(
        self, twin: Twin, generate: Entry, ref: ErrorRef, given: Sequence[Given], required: Sequence[Made] = ()
    ) -> Reaction | Refusal:  # fmt: skip
        """The reaction to an error of an entry that is made at the point, with the commands that follow."""
        program = self._prepared.program
        known = find_error(program.layout.model, ref.id)
        chosen = known if isinstance(known, Refusal) else choose(known, dict(ref.details), program.layout)
        if isinstance(chosen, Refusal):
            return chosen
        resource = resource_at(self._point, self._programs)
        could_run = resource.runnable
        before = present_texts(resource.journal.derived(ACTIVE))
        reenter(resource, generate)
        now = present_texts(resource.journal.derived(ACTIVE))
        before = tuple(each for each in before if each in now and each != str(ref))
        if resource.header.halt & Halt.FATAL_ERROR and chosen.error.severity == "fatal":
            note = "" if could_run else "the program did not run before either"
            return Reaction("stopped", 0, note=note, basis="exact", required=stopped(required))
        own = [generate, *(each.entry for each in given if is_about(each.entry.command, ref))]
        kept = without_patches(self._prepared.kept, (patch for entry in own for patch in entry.plan.patches))
        variables = self._prepared.variables
        alone = all(is_about(each.entry.command, ref) for each in given)
        watched = RequiredRun(required, resource, ref, twin.window, variables, alone=alone)
        run = _Run(resource, twin, Effects(variables, kept), chosen, ref, self._prepared)
        found = run.through(observer_of(self._programs, self._point), given, watched)
        if isinstance(found, Reaction):
            found = watched.judged(found, generate.command.author)
        if isinstance(found, Refusal) or found.verdict not in FINDINGS or not before:
            return found
        hidden = f"{', '.join(before)} was present before: what follows from both is no difference"
        return replace(found, note="; ".join(filter(None, (found.note, hidden))))


_LOG: frozenset[What] = frozenset(("log",))
_NO_CODE: frozenset[What] = frozenset(("flag", "detail", "log"))
_CODE_TOO: frozenset[What] = frozenset(("flag", "detail", "log", "code"))


class _Run:
    """The run with the error, compared with its twin."""

    def __init__(
        self, resource: Resource, twin: Twin, effects: Effects, chosen: Chosen, ref: ErrorRef, prepared: Prepared
    ) -> None:  # fmt: skip
        self._resource, self._twin, self._effects, self._chosen, self._ref = resource, twin, effects, chosen, ref
        self._prepared = prepared
        self._watched = Watched.of(resource.program, chosen)
        self._readers: dict[tuple[int, What], int] = {}
        self._triggered: dict[tuple[str, Span, What], int] = {}
        self._hidden: set[int] = set()
        """Statements that read the code word while it showed the code of a more serious error."""
        self._looked: set[int] = set()
        """Statements that came to read there, whatever it showed then."""
        self._reached: set[int] = set()
        self._turns = Turns(resource.program)
        self._recovered: int | None = None
        """The scan after which the program itself took the error back."""
        self._ran = False
        self._code_at = tuple(part.offset for part in code_bits(resource.program))
        self._known = -1, False
        """How many entries there were, and whether the error was present then."""

    def through(self, observer: Observer, given: Sequence[Given], watched: RequiredRun) -> Reaction | Refusal:
        """Runs to the end of the window, or of what can be compared."""
        resource, waiting, scan = self._resource, list(given), 0
        observer.watch(self._watched.bits)
        observer.take()
        looking = tuple(triggers(resource.program, self._watched))
        for without in self._twin.trace.states():
            if waiting and waiting[0].scan <= resource.header.scan:
                watched.entering()
            enter(resource, waiting)
            watched.before()
            shown = self._kinds_shown()
            scan += 1
            if resource.runnable:
                self._ran = True
                self._turns.ran(resource.header.scan)
                self._look(looking, scan, shown)
            entered = len(resource.journal)
            advance(resource)
            if self._recovered is None and any(_takes_back(each, self._ref) for each in resource.journal[entered:]):
                self._recovered = scan
            seen = observer.take()
            self._reached |= seen.reached
            self._read(seen.reads, scan, shown)
            self._effects.compare(scan, without, state_words(resource))
            watched.after(scan, without)
            if resource.trap is not None:
                break
        if not self._ran:
            return Refusal("the program did not run, so nothing can be said about it: change to MONITOR or RUN first")
        return self._reaction(scan, observer.sites.statements)

    def _kinds_shown(self) -> frozenset[What]:
        """What of the error can be read in this scan: its flag, its details and its record in the log, its code too unless a more
        serious error hides it; once it was recovered, only its record in the log."""
        if not self._present():
            return _LOG
        if not self._chosen.error.coded:
            return _NO_CODE
        code = sum(self._resource.memory[offset] << 8 * index for index, offset in enumerate(self._code_at))
        return _CODE_TOO if code == self._chosen.code else _NO_CODE

    def _present(self) -> bool:
        """Looked up when something was entered: in most scans nothing is."""
        entries = len(self._resource.journal)
        if self._known[0] != entries:
            active = self._resource.journal.derived(ACTIVE).get(self._ref.id)
            there = active is not None and (not self._chosen.error.several or self._ref in active.refs)
            self._known = entries, there
        return self._known[1]

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
                elif what == "code" and "flag" in shown:
                    self._hidden.add(read.site)

    def _reaction(self, scans: int, sites: Sequence[StatementSite]) -> Reaction:
        effects, readers = self._effects, self._places(sites)
        reached = {(sites[each].span.file, sites[each].span.line) for each in self._reached - self._twin.reached}
        seen = (effects.first, self._recovered, scans if self._stops_otherwise(scans) else None)
        first = min((each for each in seen if each is not None), default=None)
        carried = self._carried() if first is None else ()
        decided_by = self._decided_by(scans) if first is None and not carried else ()
        displayed, missed = effects.displayed(), self._missed() if first is None else ()
        verdict, basis = _graded(
            acted=first is not None, decided=bool(carried or decided_by), displayed=bool(displayed),
            missed=bool(missed), stored=effects.count > 0, read=bool(readers),
        )  # fmt: skip
        return Reaction(
            verdict,
            scans,
            min(readers.values(), default=None),
            first,
            tuple(Reader(*place, scan) for place, scan in sorted(readers.items(), key=lambda each: each[1])),
            effects.shown(),
            effects.count,
            tuple(Line(*place) for place in sorted(reached)),
            "; ".join((*self._notes(scans), *self._more(scans, first is None, sites))),
            basis,
            carried,
            decided_by,
            displayed,
            missed,
        )

    def _carried(self) -> tuple[Carried, ...]:
        """The state that decides something after the window, with who reads it."""
        found = list(self._effects.carried().items())[:SHOWN]
        return tuple(
            Carried(path, scan, self._prepared.state_readers.of(begin, end)) for path, (scan, begin, end) in found
        )

    def _decided_by(self, scans: int) -> tuple[str, ...]:
        """The statements that ran in one of the runs only, and write what an output depends on."""
        readings, deciding = self._prepared.readings, self._prepared.variables.deciding
        found = readings.only_in(self._reached, self._twin.reached)
        if scans == len(self._twin.trace):
            found = sorted((*found, *readings.only_in(self._twin.reached, self._reached)))
        return tuple(
            dict.fromkeys(readings.place(each) for each in found if deciding.handles(readings.statements[each]))
        )

    def _missed(self) -> tuple[Unreached, ...]:
        """The statements that would read what the error writes, and did not come to it."""
        readings, reached = self._prepared.readings, self._reached | self._twin.reached
        found = (each for each in readings.of(self._watched) if each.site not in self._looked)
        return tuple(readings.missed(each, reached, self._turns.idle) for each in found)

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

    def _more(self, scans: int, nothing: bool, sites: Sequence[StatementSite]) -> Iterator[str]:
        if self._recovered is not None:
            yield f"the program recovered it itself, after {self._recovered} scan{'s' * (self._recovered != 1)}"
        if nothing and self._hidden:
            lines = sorted({(sites[each].span.file, sites[each].span.line) for each in self._hidden})
            where = ", ".join(f"{file}:{line}" for file, line in lines)
            yield f"the error code was that of a more serious error where the program read it: {where}"
        if nothing:
            yield from self._turns.notes(scans)


def _graded(
    *, acted: bool, decided: bool, displayed: bool, missed: bool, stored: bool, read: bool
) -> tuple[Verdict, Basis]:  # fmt: skip
    """What an error did at most, and what says so."""
    if acted:
        return "acted", "exact"
    if decided:
        return "decided", "static"
    if displayed:
        return "displayed", "exact"
    if missed:
        return "not_reached", "static"
    if stored:
        return "stored", "exact"
    return ("no_effect" if read else "never_read"), "exact"


def _takes_back(entry: Entry, ref: ErrorRef) -> bool:
    """Whether an entry that the program made takes this error back."""
    command = entry.command
    if not isinstance(command, Recover):
        return False
    return takes_back(command, ref)
