"""A sweep for people and machines: a table, JSON, JUnit. The HTML page is `sweep_page.py`'s."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import cast, get_args

from scanbench.faults.details import code_text_raised
from scanbench.faults.reaction.compare import Outcome, SweepChange, judged
from scanbench.faults.reaction.reaction import OutputRestart, RequiredResult, Verdict
from scanbench.faults.reaction.required import REQUIRED, Required
from scanbench.faults.reaction.sweep import Cell
from scanbench.faults.reference import error_of, named_reference
from scanbench.plcmodel.catalogue import ErrorEntry, Severity
from scanbench.problems import Problem
from scanbench.reports import record_words
from scanbench.reports.junit import Case, junit
from scanbench.reports.reason import reason_of, some
from scanbench.reports.required_words import (
    NOT_TRIED,
    OUTCOMES,
    evidence,
    is_grade,
    outcome_of,
    required_lines,
    restarted,
    unexpected,
)
from scanbench.typed import BadValue, make_kept

WORDS: Mapping[Verdict | None, str] = {
    verdict: record_words.WORDS["en"][verdict or "not_raised"] for verdict in (*get_args(Verdict), None)
}
FORMAT = 2
"""2: the grades. 1 is read, too."""
_READ = (1, 2)
NO_SWEEP = "is not a sweep's JSON (made with errors sweep --json)"


@dataclass(frozen=True, slots=True)
class SweepResult:
    """A sweep that is over."""

    project: str
    model: str
    window: int
    states: tuple[tuple[str, int], ...]
    """Name, and the scan before which errors were raised."""
    errors: tuple[ErrorEntry, ...]
    cells: tuple[Cell, ...]
    """For each error all states, in these orders."""
    problems: tuple[Problem, ...] = ()
    """Of the file with what is required: what is wrong there is not tried."""

    def entry(self, cell: Cell) -> ErrorEntry:
        """The error of a cell."""
        return next(each for each in self.errors if each.id == error_of(cell.error))

    def code(self, error: str) -> str:
        """The code of an error, with the details that it was raised with."""
        ref = named_reference(error)
        return code_text_raised(next(each for each in self.errors if each.id == ref.id), dict(ref.details))

    def counts(self) -> dict[str, int]:
        """How often there was which verdict, in words."""
        counted = Counter(WORDS[verdict_of(cell)] for cell in self.cells)
        return {word: counted[word] for word in WORDS.values() if counted[word]}

    def unhandled(self, severities: Sequence[Severity], required: Required = REQUIRED) -> tuple[Cell, ...]:
        """Errors of these severities that did less than is required, or not what is required."""
        return tuple(
            cell for cell in self.cells if self.entry(cell).severity in severities and not is_met(cell, required)
        )

    def outcomes(self) -> Counter[str]:
        """How many requirements came to what, in words."""
        return Counter(outcome_of(each) for cell in self.cells for each in cell.required)


def is_met(cell: Cell, required: Required) -> bool:
    """Whether it is as it is required. Of an error that could not be raised only what the project requires of it counts."""
    verdict = verdict_of(cell)
    return not cell.unmet and (verdict is None or required.met(cell.error, verdict, cell.point))


def verdict_of(cell: Cell) -> Verdict | None:
    """What became of it; None where it could not be raised."""
    return cell.reaction.verdict if cell.reaction is not None else None


def reason(cell: Cell) -> str:
    """A sentence about what was found."""
    reaction = cell.reaction
    return cell.note if reaction is None else "; ".join(filter(None, (reason_of(reaction), reaction.note)))


# ---- text ----------------------------------------------------------------------------------------------------------


def sweep_text(result: SweepResult) -> list[str]:
    """A line for each error and state, and a summary."""
    rows = [("ERROR", "CODE", "SEVERITY", "STATE", "VERDICT", "SCANS", "WHY")]
    for cell in result.cells:
        entry, reaction = result.entry(cell), cell.reaction
        scans = "" if reaction is None or reaction.first_effect is None else str(reaction.first_effect)
        verdict = WORDS[verdict_of(cell)]
        rows.append(
            (cell.error, result.code(cell.error) or "-", entry.severity, cell.point, verdict, scans, reason(cell))
        )
    head = f"{result.project} on {result.model}: {count(len(result.errors), 'error')}, {count(len(result.states), 'state')}"
    counts = ", ".join(f"{number} {word}" for word, number in result.counts().items())
    return [f"{head}, {result.window} scans each", "", *table(rows), "", counts, *_required_text(result)]


def _required_text(result: SweepResult) -> list[str]:
    """What is not as it is required, and how many are."""
    rows = [("ERROR", "STATE", "REQUIRED", "OUTCOME", "WHY")]
    for cell in result.cells:
        rows += [
            (cell.error, cell.point, each.text, outcome_of(each), evidence(each))
            for each in cell.required
            if each.outcome != "passed"
        ]
        rows += [
            (cell.error, cell.point, "no unexpected restart", "failed", restarted(each))
            for each in unexpected(cell.reaction)
        ]
    told = result.outcomes()
    counts = ", ".join(f"{told[word]} {word}" for word in (*OUTCOMES.values(), NOT_TRIED) if told[word])
    restarts = sum(len(unexpected(cell.reaction)) for cell in result.cells)
    ends = [f"requirements: {counts}"] if counts else []
    ends += [count(restarts, "unexpected restart")] if restarts else []
    return ["", *(table(rows) if len(rows) > 1 else []), *ends] if ends else []


def compare_text(changes: Sequence[SweepChange]) -> list[str]:
    """A line for each that is not as before, and a summary."""
    rows = [("ERROR", "STATE", "BEFORE", "AFTER", "CHANGE", "NOT AS REQUIRED ANY MORE, DIFFERS NO LONGER")]
    for each in changes:
        if each.change != "same":
            before, after = _outcome(each.before, each.scans_before), _outcome(each.after, each.scans_after)
            rows.append(
                (each.error, each.state, before, after, each.change, ", ".join(some((*each.unmet, *each.lost))))
            )
    counted = Counter(each.change for each in changes)
    summary = ", ".join(f"{number} {kind}" for kind, number in counted.most_common()) or "nothing to compare"
    return [*(table(rows) if len(rows) > 1 else []), *([""] if len(rows) > 1 else []), summary]


def _outcome(verdict: Verdict | None, scans: int | None) -> str:
    return WORDS[verdict] + (f" after {count(scans, 'scan')}" if scans is not None else "")


def count(number: int, what: str) -> str:
    """`1 scan`, `2 scans`."""
    return f"{number} {what}{'s' * (number != 1)}"


def table(rows: Sequence[tuple[str, ...]]) -> list[str]:
    """Lines of text, with each column as wide as its longest cell."""
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    return ["  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in rows]


# ---- JSON ----------------------------------------------------------------------------------------------------------


def sweep_json(result: SweepResult) -> dict[str, object]:
    """One object; `outcomes_in` reads it again."""
    return {
        "format": FORMAT,
        "project": result.project,
        "model": result.model,
        "window": result.window,
        "states": [{"name": name, "scan": scan} for name, scan in result.states],
        "counts": {
            verdict: number
            for verdict in get_args(Verdict)
            if (number := sum(verdict_of(cell) == verdict for cell in result.cells))
        },
        "problems": [
            {
                "file": each.span.file,
                "line": each.span.line,
                "column": each.span.column,
                "code": each.code,
                "message": each.message,
            }
            for each in result.problems
        ],
        "results": [_cell_json(result, cell) for cell in result.cells],
    }


def _cell_json(result: SweepResult, cell: Cell) -> dict[str, object]:
    entry, reaction = result.entry(cell), cell.reaction
    about: dict[str, object] = {
        "id": cell.error, "error": entry.id, "name": entry.name, "code": result.code(cell.error),
        "severity": entry.severity, "state": cell.point,
        "verdict": verdict_of(cell), "scans": None, "first_read": None, "window": 0, "readers": [], "reads": [],
        "differences": [], "difference_count": 0, "handler_lines": [], "note": cell.note, "basis": "", "carried": [],
        "decided_by": [], "displayed": [], "unreached": [], "required": [asdict(each) for each in cell.required], "restarts": [], "recovery": 0, "reason": reason(cell),
    }  # fmt: skip
    if reaction is not None:
        about |= {
            "scans": reaction.first_effect, "first_read": reaction.first_read, "window": reaction.window,
            "readers": list(reaction.reader_places), "reads": [asdict(each) for each in reaction.readers],
            "differences": [asdict(each) for each in reaction.differences],
            "difference_count": reaction.difference_count,
            "handler_lines": [f"{each.file}:{each.line}" for each in reaction.lines], "note": reaction.note,
            "basis": reaction.basis, "carried": [asdict(each) for each in reaction.carried],
            "decided_by": list(reaction.decided_by), "displayed": list(reaction.displayed),
            "unreached": [asdict(each) for each in reaction.unreached],
            "restarts": [asdict(each) for each in reaction.restarts], "recovery": reaction.recovery,
        }  # fmt: skip
    return about


def is_sweep(told: object) -> bool:
    """Whether this is meant to be what `sweep_json` wrote."""
    return isinstance(told, dict) and isinstance(told.get("results"), list)


def outcomes_in(told: object) -> list[Outcome]:
    """What `sweep_json` wrote; ValueError says what is missing or wrong."""
    if not isinstance(told, dict) or not is_sweep(told):
        raise ValueError(f"this {NO_SWEEP}")
    if told.get("format") not in _READ:
        raise ValueError(f"a sweep of format {told.get('format')!r}; this scanbench reads formats 1 and {FORMAT}")
    return [_outcome_in(number, each) for number, each in enumerate(told["results"])]


def conditions_apart(before: Mapping[str, object], after: Mapping[str, object]) -> list[str]:
    """In what two sweeps, as `sweep_json` wrote them, were not made alike: what they say differs for that reason, too."""
    found = []
    if before.get("model") != after.get("model"):
        found.append(f"they are of different models: {before.get('model')} and {after.get('model')}")
    if before.get("window") != after.get("window"):
        found.append(
            f"each error was watched for {before.get('window')} scans before, and for {after.get('window')} after"
        )
    at = [_state_scans(each) for each in (before, after)]
    for name in sorted(at[0].keys() & at[1].keys()):
        if at[0][name] != at[1][name]:
            found.append(f"the state {name} was at scan {at[0][name]} before, and at scan {at[1][name]} after")
    return found


def _state_scans(told: Mapping[str, object]) -> dict[str, object]:
    return {str(each.get("name")): each.get("scan") for each in _objects(told.get("states"))}


def _outcome_in(number: int, told: object) -> Outcome:
    where = f"results[{number}]"
    if not isinstance(told, dict):
        raise ValueError(f"{where} is no object")
    error, state, verdict, scans = (told.get(name) for name in ("id", "state", "verdict", "scans"))
    if not isinstance(error, str) or not isinstance(state, str):
        raise ValueError(f"{where} has no `id` and `state`")
    if verdict is not None and verdict not in get_args(Verdict):
        raise ValueError(f"{where} has the verdict {verdict!r}; there are {', '.join(get_args(Verdict))}")
    if scans is not None and (not isinstance(scans, int) or isinstance(scans, bool)):
        raise ValueError(f"{where} has the scans {scans!r}, which is no whole number")
    outputs, others = _differed(told)
    required = _judged_in(where, told, outputs or ())
    return Outcome(error, state, cast("Verdict | None", verdict), scans, outputs, others, required)


def _judged_in(where: str, told: Mapping[str, object], outputs: Iterable[str]) -> dict[str, bool]:
    """What was required and looked at; nothing where a sweep was made before there was that."""
    try:
        return judged(
            [make_kept(RequiredResult, each) for each in _objects(told.get("required"))],
            [make_kept(OutputRestart, each) for each in _objects(told.get("restarts"))],
            recovery if isinstance(recovery := told.get("recovery"), int) else 0,
            outputs,
        )
    except BadValue as why:
        raise ValueError(f"{where}: {why}") from why


def _objects(told: object) -> list[Mapping[str, object]]:
    return [each for each in told if isinstance(each, dict)] if isinstance(told, list) else []


def _differed(told: Mapping[str, object]) -> tuple[frozenset[str] | None, frozenset[str] | None]:
    """The outputs and the other variables that differed; None where not all of them are there."""
    listed, count = told.get("differences"), told.get("difference_count")
    if not isinstance(listed, list) or count != len(listed) or not all(isinstance(each, dict) for each in listed):
        return None, None
    paths = {str(each.get("path")): each.get("output") is True for each in listed}
    return (
        frozenset(path for path, output in paths.items() if output),
        frozenset(path for path, output in paths.items() if not output),
    )


# ---- JUnit ---------------------------------------------------------------------------------------------------------


def sweep_junit(result: SweepResult, severities: Sequence[Severity], required: Required = REQUIRED) -> str:
    """A test case for each error and state; it fails where an error of these severities did less than is required. One more for each
    mistake in what is required: it fails."""
    failed = result.unhandled(severities, required)
    cases = [_case(result, cell, cell in failed, required) for cell in result.cells]
    cases += [
        Case(each.span.file, f"line {each.span.line}", "failure", f"{NOT_TRIED}: {each.message}", each.code)
        for each in result.problems
    ]
    return junit(f"{result.project} on {result.model}", cases)


def _case(result: SweepResult, cell: Cell, failed: bool, required: Required) -> Case:
    code, verdict = result.code(cell.error), verdict_of(cell)
    group, name = f"{result.model}.{cell.point}", f"{cell.error} ({code})" if code else cell.error
    if failed:
        told = "\n".join((reason(cell), *required_lines(cell)))
        return Case(group, name, "failure", _failure(result.entry(cell), cell, required), verdict or "not_tried", told)
    if cell.reaction is None:
        return Case(group, name, "skipped", cell.note)
    return Case(group, name, text="\n".join((f"{WORDS[verdict]}: {reason(cell)}", *required_lines(cell))))


def _failure(entry: ErrorEntry, cell: Cell, required: Required) -> str:
    """What a build server shows first."""
    verdict = verdict_of(cell)
    said = [f"{entry.severity} error: {WORDS[verdict]}"]
    wanted = required.of(cell.error, cell.point)
    if wanted is not None and verdict is not None and not required.met(cell.error, verdict, cell.point):
        said.append(f"required: {WORDS[wanted]}")
    said += [f"{outcome_of(each)}: {each.text}" for each in cell.required if each.is_finding and not is_grade(each)]
    said += [restarted(each) for each in unexpected(cell.reaction)]
    return "; ".join(said)
