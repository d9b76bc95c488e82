"""What `scanbench verify` prints for people: a line of what was compared, and a block for each difference."""

from collections.abc import Iterator

from scanbench.reports.report import Report, ReportHead
from scanbench.reports.sweep_report import count
from scanbench.reports.value_text import column_of, differing_bits, value_text
from scanbench.verify.contract import ENDED, Column, Mismatch, Row, VerifyCoverage

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
    yield _summary(report)


def _coverage(coverage: VerifyCoverage) -> Iterator[str]:
    """What of a trace was compared, and what was not."""
    yield "compared, values of each output:"
    for each in coverage.outputs:
        parts = [f"{each.compared:,}"]
        parts += [f"{each.differing:,} differ"] if each.differing else []
        parts += [f"{each.allowed:,} within the tolerance"] if each.allowed else []
        parts += [f"{each.left_open:,} within what rounded numbers leave open"] if each.left_open else []
        parts += [f"{each.missing:,} without a value to compare"] if each.missing else []
        parts += [f"off by {each.largest:.4g} at most"] if each.largest else []
        yield f"  {each.path}: {', '.join(parts)}"
    kinds = (
        ("not compared, as they are given to the reference", coverage.inputs),
        ("not compared, columns that are mapped to nothing", coverage.ignored),
        ("not compared, as the file has no column of them", coverage.unrecorded),
        ("remembered by the program, and not in the file: the first rows told", coverage.assumed),
        ("read by the program, and not in the file: the reference took the start values of", coverage.ungiven),
        ("remembered by the program, and not in the file: they began as after a cold start", coverage.remembered),
    )
    for what, names in kinds:
        if names:
            yield f"{what}: {', '.join(names[:NAMES])}{', ...' if len(names) > NAMES else ''}"


def _summary(report: Report) -> str:
    head = report.head
    same = "no difference in what was compared" if head.skipped or head.unreached else "no difference"
    if head.coverage is not None and head.coverage.ungiven:
        same += f", if {count(len(head.coverage.ungiven), 'input')} without a column had the start value"
    came = f"{count(head.differing, 'row')} differ" if head.differing else same
    if not head.differing and (report.idle or not head.compared):
        came = "nothing was compared, as the range did not run in them" if report.idle else "nothing was compared"
    skipped = f", {head.skipped:,} not compared ({_stretches(head)})" if head.skipped else ""
    unreached = f", {head.unreached:,} that were asked for did not run" if head.unreached else ""
    return (
        f"{head.project} on {head.model}, {head.title}: scans {head.first} to {head.last}, "
        f"{0 if report.idle else head.compared:,} compared{skipped}{unreached}: {came}"
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
