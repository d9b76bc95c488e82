"""A test record as CSV: one row for each error, for a spreadsheet."""

import csv
import io
from collections.abc import Iterable
from datetime import datetime

from scanbench.faults.reaction.reaction import Reaction
from scanbench.public import iso
from scanbench.reports.record import RecordError, TestRecord

COLUMNS = (
    "group", "id", "error", "code", "flag", "severity", "status", "generated", "generated scan", "recovered",
    "recovered scan", "details", "by", "origin", "count", "verdict", "verdict from", "scans until the first effect",
    "readers", "outputs that differ", "variables that differ", "accepted", "open in", "note", "required", "not as required",
)  # fmt: skip
_BOM = "\ufeff"  # a spreadsheet takes the file for Latin-1 without it


def to_csv(record: TestRecord) -> str:
    """The rows, with a head line."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\r\n")
    writer.writerow(COLUMNS)
    open_in: dict[str, dict[str, None]] = {}
    for missed in record.missed:
        if missed.accepted is None:
            open_in.setdefault(missed.error.id, {})[missed.state or "on the PLC itself"] = None
    for error in record.errors:
        writer.writerow(map(_harmless, _row(record, error, open_in.get(error.id, ()))))
    return _BOM + text.getvalue()


def _row(record: TestRecord, error: RecordError, open_in: Iterable[str]) -> list[str]:
    finding, reaction = record.finding(error), error.reaction
    return [
        error.group, error.id, error.name, error.code, error.flag, error.severity, error.status,
        _moment(error.generated_at), _number(error.generated_scan), _moment(error.recovered_at),
        _number(error.recovered_scan), error.details_text or error.details, error.by, error.origin or "", str(error.count),
        finding.verdict or "", finding.where, _number(finding.scans),
        "" if reaction is None else ", ".join(reaction.reader_places),
        "" if reaction is None else _outputs(reaction),
        "" if reaction is None else str(reaction.difference_count),
        "; ".join(f"{one.state}: {one.reason} ({one.by})" for one in error.accepted),
        ", ".join(open_in),
        error.reaction_note or ("" if reaction is None else reaction.note),
        str(len(reaction.required)) if reaction is not None and reaction.required else "",
        "" if reaction is None else "; ".join(reaction.unmet),
    ]  # fmt: skip


def _outputs(reaction: Reaction) -> str:
    """The outputs that differ, with what they were without and with the error."""
    return ", ".join(f"{each.path} {each.without} → {each.value}" for each in reaction.differences)


def _moment(at: datetime | None) -> str:
    return "" if at is None else iso(at)


def _number(number: int | None) -> str:
    return "" if number is None else str(number)


def _harmless(text: str) -> str:
    """A name that begins like a formula would be one in the spreadsheet of whoever opens the file."""
    return f"'{text}" if text[:1] in ("=", "+", "-", "@", "\t", "\r") else text
