"""A verification as text for people, and as JUnit: a line of what was compared, and a block for each difference."""

from collections.abc import Iterator

from scanbench.reports.junit import Case, junit
from scanbench.reports.report import Report, ReportHead
from scanbench.reports.sweep_report import count
from scanbench.reports.value_text import column_of, differing_bits, value_text
from scanbench.verify.contract import ENDED, Column, Compared, Mismatch, Row, VerifyCoverage
from scanbench.verify.verdict import skipped, taken_over

STRETCHES = 5
"""Of scans that were not compared that are named."""
NAMES = 12
"""Of a kind that are named."""
SHOWN = 10
"""Differences that are printed; `--json` and `--html` have more."""
CAUSES = {
    "logic": "the same inputs gave a different result",
    "input": "what was read is not what should have been there",
    "order": "a different statement ran, or a different variable was used",
    "trap": "a run-time error in one of them",
    "outside": "a variable that the range does not use",
    "recorded": "re-running the recorded scan gave a different value",
}


def verify_text(report: Report) -> Iterator[str]:
    """The lines."""
    head, differences = report.head, report.differences()
    for row, difference in differences[:SHOWN]:
        yield from _block(row, difference, report.columns)
        yield ""
    if len(differences) > SHOWN:
        yield f"{len(differences) - SHOWN:,} more differences: --json and --html have them"
        yield ""
    for row in report.rows:
        if ENDED in row.note and not row.differs:
            yield f"scan {row.scan}: {row.note}, in the reference as well"
    if head.coverage is not None:
        yield from _coverage(head.coverage)
    if head.full:
        yield (
            f"the record was full in {count(head.full, 'scan')}: what a scan used beyond {head.limit:,} uses of variables was not "
            "compared; --limit keeps more"
        )
    yield summary(report)


def _coverage(coverage: VerifyCoverage) -> Iterator[str]:
    """What of a trace was compared, and what was not."""
    yield "compared, values of each output:"
    for each in coverage.outputs:
        yield f"  {each.path}: {_told(each)}"
    kinds = (
        ("not compared, as they are given to the reference", coverage.inputs),
        ("not compared, columns that are mapped to nothing", coverage.ignored),
        ("not compared, as the file has no column of them", coverage.unrecorded),
        ("remembered by the program, and not in the file: the first rows told", coverage.assumed),
        (
            "read by the program, and without a value in the file: the reference took the start values of",
            coverage.ungiven,
        ),
        ("remembered by the program, and not in the file: they began as after a cold start", coverage.remembered),
    )
    for what, names in kinds:
        if names:
            yield f"{what}: {', '.join(names[:NAMES])}{', ...' if len(names) > NAMES else ''}"


def _told(output: Compared) -> str:
    parts = [f"{output.compared:,} compared"]
    parts += [_differ(output.differing, f"{output.differing:,}")] if output.differing else []
    parts += [f"{output.allowed:,} within the tolerance"] if output.allowed else []
    parts += [f"{output.left_open:,} within what rounded numbers leave open"] if output.left_open else []
    parts += [f"{output.missing:,} without a value to compare"] if output.missing else []
    parts += [f"off by {output.largest:.4g} at most"] if output.largest else []
    return ", ".join(parts)


def _differ(number: int, what: str) -> str:
    return f"{what} differ{'s' * (number == 1)}"


def verify_junit(report: Report, lost: str = "") -> str:
    """Cases: that all scans were compared, that there is no difference, and of a trace that all inputs have values, and each output.
    `lost`: what of the run is not there."""
    head, differences = report.head, report.differences()
    group, said = f"{head.project}.verify", summary(report)
    nothing = report.idle or not head.compared
    which = "all scans after the first" if taken_over(head) else "all scans"
    whole = Case(group, f"{head.title}: {which} are compared", text=said)
    if nothing or skipped(head) or lost:
        message = ". ".join(filter(None, (said if nothing or skipped(head) else "", lost)))
        whole = Case(group, whole.name, "error", message, "not_compared", head.note)
    same = Case(group, f"{head.title}: no difference")
    if head.differing:
        text = "\n\n".join("\n".join(_block(*each, report.columns)) for each in differences[:SHOWN])
        message = differences[0][1].message if differences else said
        same = Case(group, same.name, "failure", message, "difference", f"{text}\n\n{said}".strip())
    elif nothing:
        same = Case(group, same.name, "skipped", "nothing was compared")
    values = () if head.coverage is None else _values(group, head.title, head.coverage)
    return junit(f"{head.project} on {head.model}", (whole, same, *values))


def _values(group: str, title: str, coverage: VerifyCoverage) -> Iterator[Case]:
    """What there has to be in a trace."""
    given = Case(group, f"{title}: all inputs have values")
    if coverage.ungiven:
        message = f"the reference took the start values of {', '.join(coverage.ungiven)}: the file has no value of them"
        given = Case(group, given.name, "error", message, "not_given")
    yield given
    yield from (_output(group, each) for each in coverage.outputs)


def _output(group: str, output: Compared) -> Case:
    name, told = f"output {output.path}", _told(output)
    if output.differing:
        return Case(group, name, "failure", f"{output.path}: {told}", "difference")
    if output.missing:
        return Case(group, name, "error", f"{output.path}: {told}", "not_compared")
    if not output.compared:
        return Case(group, name, "skipped", f"{output.path}: {told}")
    return Case(group, name, text=f"{output.path}: {told}")


def summary(report: Report) -> str:
    """One sentence: what was compared, and what came of it."""
    head = report.head
    missing = head.coverage is not None and any(each.missing for each in head.coverage.outputs)
    part = head.skipped or head.not_reached or head.unfinished or missing
    same = "no difference in what was compared" if part else "no difference"
    if head.coverage is not None and head.coverage.ungiven:
        same += f", if {count(len(head.coverage.ungiven), 'input')} had the start value where the file has no value"
    came = _differ(head.differing, count(head.differing, "row")) if head.differing else same
    if not head.differing and (report.idle or not head.compared):
        came = "nothing was compared, as the range did not run in them" if report.idle else "nothing was compared"
    left = f", {head.skipped:,} not compared ({_stretches(head)})" if head.skipped else ""
    unreached = f", {head.not_reached:,} that were asked for did not run" if head.not_reached else ""
    return (
        f"{head.project} on {head.model}, {head.title}: scans {head.first} to {head.last}, "
        f"{0 if report.idle else head.compared:,} compared{left}{unreached}: {came}"
    )


def _stretches(head: ReportHead) -> str:
    shown = [str(first) if first == last else f"{first} to {last}" for first, last in head.stretches[:STRETCHES]]
    return ", ".join(shown) + (", ..." if len(head.stretches) > STRETCHES else "")


def _block(row: Row, difference: Mismatch, columns: tuple[Column, ...]) -> Iterator[str]:
    place, column = difference.place, column_of(difference, columns)
    yield f"scan {row.scan}: {difference.message}"
    if place is not None:
        yield f"  task      {place.task or '-'}"
        yield f"  instance  {place.instance}"
        yield f"  line      {place.file}:{place.line}" + (f": {place.text}" if place.text else "")
    if difference.control or difference.monitor:
        yield f"  variable  {difference.name}" + (f" : {difference.type}" if difference.type else "")
        yield f"  was       {value_text(column, difference.control) or '-'}"
        yield f"  is        {value_text(column, difference.monitor) or '-'} in the reference"
    bits = differing_bits(difference.control, difference.monitor)
    if bits:
        yield f"  bits      {', '.join(map(str, bits[:16]))}{', ...' if len(bits) > 16 else ''}"
    yield f"  cause     {difference.cause}: {CAUSES[difference.cause]}"
    if row.disturbances:
        yield f"  injected  {'; '.join(row.disturbances)}"
