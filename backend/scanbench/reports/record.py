"""The test record: which errors a program was tested against, what it did, and who says so. Data, and how it is made."""

from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from datetime import datetime
from typing import ClassVar, Literal

from scanbench.faults.details import code_text_with
from scanbench.faults.history import ErrorRow, Status
from scanbench.faults.present import Origin
from scanbench.faults.reaction.reaction import FINDINGS, WORST_FIRST, Reaction, RequiredResult, Verdict
from scanbench.faults.reference import error_of, named_reference
from scanbench.plcmodel.catalogue import ErrorEntry, ErrorGroup, Severity, path_text
from scanbench.plcmodel.model import Model
from scanbench.public import Moment, Public
from scanbench.reports.record_text import Language, RecordLine, details_in_words, in_names, worded

SweepStatus = Literal["running", "done", "cancelled", "interrupted", "failed"]


@dataclass(frozen=True, slots=True)
class RecordHead:
    """What was tested, and who wrote the record."""

    project: str
    model: str
    instance: str
    program_version: int
    program_hash: str
    """sha256 of the sources; empty where the build is not known any more."""
    exported_at: datetime
    exported_by: str
    tool: str
    """The program that wrote it, with its version."""


@dataclass(frozen=True, slots=True)
class RecordAccepted(Public):
    """Somebody accepted that the program does not react."""

    state: str
    reason: str
    by: str
    at: Moment


@dataclass(frozen=True, slots=True)
class RecordError:
    """One error instance. Those of hardware that is not fitted are not in a record, unless somebody raised them, or
    something is required of them."""

    id: str
    """In the notation of references: `fal:number=5`; of a kind of which no instance is known, and in older records, its id."""
    name: str
    group: str
    """Names of its groups, from the top, with ` / ` between."""
    code: str
    flag: str
    severity: Severity
    status: Status
    details: str = ""
    generated_at: datetime | None = None
    recovered_at: datetime | None = None
    generated_scan: int | None = None
    recovered_scan: int | None = None
    by: str = ""
    origin: Origin | None = None
    count: int = 0
    reaction: Reaction | None = None
    """Of the last time that it was raised on this PLC; of its differences only the outputs."""
    reaction_note: str = ""
    """Why there is none, although it was raised."""
    accepted: tuple[RecordAccepted, ...] = ()
    details_text: str = ""
    """The details in the words of the catalogue."""

    def accepted_in(self, state: str) -> RecordAccepted | None:
        """Who accepted last that nothing comes of it in this state."""
        return next((one for one in reversed(self.accepted) if one.state == state), None)


@dataclass(frozen=True, slots=True)
class RecordCell(Public):
    """One error, raised alone from one state."""

    error: str
    state: str
    verdict: Verdict | None
    """None: it could not be raised, `note` says why."""
    scans: int | None = None
    """Until the first effect."""
    note: str = ""
    required: int = 0
    """Requirements that are about it,"""
    unmet: int = 0
    """and how much is not as it is required: unexpected restarts and what was not tried are counted."""
    untried: tuple[RequiredResult, ...] = ()
    """Without a verdict: what is required all the same, and why it was not tried."""


@dataclass(frozen=True, slots=True)
class RecordProblem(Public):
    """A mistake in what the project requires: what it says there was not tried."""

    line: int
    column: int
    message: str


@dataclass(frozen=True, slots=True)
class RecordSweep(Public):
    """A sweep of this version of the program."""

    at: Moment
    by: str
    instance: str
    status: SweepStatus
    window: int
    states: tuple[str, ...]
    cells: tuple[RecordCell, ...]
    problems: tuple[RecordProblem, ...] = ()
    """Each is a finding."""


@dataclass(frozen=True, slots=True)
class Finding:
    """What is known of one error at the end: from the PLC itself, else from sweeps (the worst of all states)."""

    verdict: Verdict | None
    scans: int | None
    where: Literal["plc", "sweep", ""]
    """Empty: it was not tested, or nothing is known of what the program did."""
    unmet: int = 0
    """So much was not as it is required."""


@dataclass(frozen=True, slots=True)
class Missed:
    """An error that the program misses in one state, or to which it does not react as required: open until somebody accepts
    that, for this state."""

    error: RecordError
    state: str
    """Empty: raised on the PLC itself, wherever that was."""
    verdict: Verdict | None
    """None: it could not be raised, so what is required was not tried."""
    accepted: RecordAccepted | None
    unmet: int = 0
    """It is about requirements: so much is not as it is required, unexpected restarts counted. Nobody can accept that."""
    why: str = ""
    """What was not tried, and why."""


@dataclass(frozen=True, slots=True)
class Summary(Public):
    """The record in numbers."""

    PUBLIC: ClassVar = "RecordSummary"

    errors: int
    tested: int
    """Raised on the PLC or in a sweep."""
    generated: int
    """Still present."""
    verdicts: dict[Verdict, int]
    unknown: int
    """Tested, but without a verdict."""
    accepted: int
    """Findings, one for each error and state, that were accepted."""
    open: int
    """And those that were not; mistakes in what the project requires counted."""


@dataclass(frozen=True, slots=True)
class TestRecord:
    """One PLC, one version of its program, every error of the catalogue."""

    __test__ = False  # its name is no test of ours
    head: RecordHead
    errors: tuple[RecordError, ...]
    sweeps: tuple[RecordSweep, ...] = ()
    """The newest first."""
    log: tuple[RecordLine, ...] = ()
    _swept: dict[str, dict[str, RecordCell]] = field(default_factory=dict, init=False, repr=False, compare=False)
    """The newest cell with a verdict, by error and state: a sweep of one state does not hide what is open in others."""

    _untried: dict[str, dict[str, RecordCell]] = field(default_factory=dict, init=False, repr=False, compare=False)
    """The newest cell, by error and state, where that was not raised although something is required."""

    def __post_init__(self) -> None:
        for sweep in reversed(self.sweeps):
            for cell in sweep.cells:
                untried = self._untried.setdefault(cell.error, {})
                untried.pop(cell.state, None)
                if cell.verdict is not None:
                    self._swept.setdefault(cell.error, {})[cell.state] = cell
                elif cell.unmet:
                    untried[cell.state] = cell

    def finding(self, error: RecordError) -> Finding:
        """What is known of an error."""
        if error.reaction is not None:
            return Finding(error.reaction.verdict, error.reaction.first_effect, "plc", len(error.reaction.unmet))
        cells, untried = self._swept.get(error.id, {}).values(), self._untried.get(error.id, {}).values()
        if not cells:
            return Finding(None, None, "", max((cell.unmet for cell in untried), default=0))
        worst = min(cells, key=lambda cell: WORST_FIRST.index(cell.verdict) if cell.verdict else 0)
        return Finding(worst.verdict, worst.scans, "sweep", max(cell.unmet for cell in (*cells, *untried)))

    @property
    def missed(self) -> list[Missed]:
        """What the program misses, by error and state; in the order of the catalogue, what is open first."""
        found = [each for error in self.errors for each in self._missed(error)]
        return sorted(found, key=lambda each: (each.accepted is not None, each.error.severity != "fatal"))

    def _missed(self, error: RecordError) -> list[Missed]:
        found = [
            Missed(error, cell.state, cell.verdict, error.accepted_in(cell.state))
            for cell in self._swept.get(error.id, {}).values()
            if cell.verdict in FINDINGS
        ]
        required = [
            Missed(error, cell.state, cell.verdict, None, cell.unmet)
            for cell in self._swept.get(error.id, {}).values()
            if cell.verdict is not None and cell.unmet
        ]
        # What was seen on the PLC itself is said once more only where no state has it: who accepts does so for a state.
        seen = None if error.reaction is None else error.reaction.verdict
        if seen in FINDINGS and all(each.verdict != seen for each in found):
            found.append(Missed(error, "", seen, None))
        if error.reaction is not None and error.reaction.unmet:
            required.append(Missed(error, "", error.reaction.verdict, None, len(error.reaction.unmet)))
        untried = [
            Missed(
                error,
                cell.state,
                None,
                None,
                cell.unmet,
                "; ".join(f"{each.text}: {each.note}" for each in cell.untried),
            )
            for cell in self._untried.get(error.id, {}).values()
        ]
        return [*found, *required, *untried]

    @property
    def problems(self) -> tuple[RecordProblem, ...]:
        """What the newest sweep could not try, as nobody can say what is meant: findings, too."""
        return self.sweeps[0].problems if self.sweeps else ()

    def tested(self, error: RecordError) -> bool:
        """Whether it was raised at all."""
        return error.status != "never" or self.finding(error).where != ""

    @property
    def summary(self) -> Summary:
        """The record in numbers."""
        tested = [error for error in self.errors if self.tested(error)]
        found = [self.finding(error).verdict for error in tested]
        accepted = [each.accepted is not None for each in self.missed]
        return Summary(
            errors=len(self.errors),
            tested=len(tested),
            generated=sum(error.status == "generated" for error in self.errors),
            verdicts={verdict: found.count(verdict) for verdict in WORST_FIRST},
            unknown=found.count(None),
            accepted=accepted.count(True),
            open=accepted.count(False) + len(self.problems),
        )

    @property
    def title(self) -> str:
        """In a line, for lists."""
        head = self.head
        return f"{head.project}, {head.instance}, version {head.program_version}, {head.exported_at:%Y-%m-%d %H:%M} UTC"


def make_record(
    head: RecordHead, model: Model, rows: Iterable[ErrorRow], *, sweeps: Sequence[RecordSweep] = (),
    accepted: Iterable[tuple[str, RecordAccepted]] = (), log: Sequence[RecordLine] = (), language: Language = "en",
) -> TestRecord:  # fmt: skip
    """The record of these rows, in the order of the model's catalogue; `accepted` are pairs of error and acceptance."""
    by_id: dict[str, list[ErrorRow]] = {}
    for row in rows:
        by_id.setdefault(row.id, []).append(row)
    reasons: dict[str, list[RecordAccepted]] = {}
    for error, one in accepted:
        reasons.setdefault(error, []).append(one)
    wanted = {cell.error for sweep in sweeps for cell in sweep.cells if cell.verdict is None and cell.unmet}
    kept = [
        _error(groups, error, row, tuple(reasons.get(row.key, ())), language)
        for groups, error in model.errors_with_groups()
        for row in _with_untried(error, by_id.get(error.id, []), wanted)
        if row.fitted or row.status != "never" or row.key in wanted
    ]
    known = {error.id for error in kept}
    ours = [replace(each, cells=tuple(cell for cell in each.cells if cell.error in known)) for each in sweeps]
    errors = {error.id: error for error in model.errors()}
    lines = (replace(line, text=in_names(errors, line.text, language)) for line in log)
    return TestRecord(head, tuple(kept), tuple(ours), tuple(lines))


def _with_untried(error: ErrorEntry, rows: Sequence[ErrorRow], wanted: Collection[str]) -> Iterator[ErrorRow]:
    """The rows of an error, with one for each instance of which something is required, and that could not be raised."""
    yield from rows
    known = {row.key for row in rows}
    added = [key for key in sorted(wanted) if error_of(key) == error.id and key not in known]
    for key in added:
        given = dict(named_reference(key).details)
        details, code = ", ".join(f"{name}={value}" for name, value in given.items()), code_text_with(error, given)
        yield ErrorRow(error.id, error.name, error.severity, code=code, details=details, instance=key, fitted=False)
    if not rows and not added:
        yield ErrorRow(error.id, error.name, error.severity, code=error.code_text)


def _error(
    groups: Iterable[ErrorGroup], error: ErrorEntry, row: ErrorRow, accepted: tuple[RecordAccepted, ...],
    language: Language,
) -> RecordError:  # fmt: skip
    reaction = row.reaction
    return RecordError(
        id=row.key, name=worded(error.name, error.wordings, language),
        group=path_text(worded(group.name, group.wordings, language) for group in groups), code=row.code,
        flag=error.flag_text, severity=error.severity, status=row.status, details=row.details,
        generated_at=row.generated_at, recovered_at=row.recovered_at, generated_scan=row.generated_scan,
        recovered_scan=row.recovered_scan, by=row.by or "", origin=row.origin, count=row.count,
        reaction=None if reaction is None or reaction.found is None else _outputs_only(reaction.found),
        reaction_note="" if reaction is None else reaction.message, accepted=accepted,
        details_text=", ".join(filter(None, (details_in_words(error, row.details, language), row.label))),
    )  # fmt: skip


def _outputs_only(reaction: Reaction) -> Reaction:
    return replace(reaction, differences=tuple(each for each in reaction.differences if each.output))
