"""A verification as one JSON object; its shape is described in docs/verification.md."""

import json

from scanbench.reports.report import Report, ReportHead
from scanbench.reports.value_text import column_of, differing_bits, value_text
from scanbench.verify.contract import Column, Mismatch, Place, Row, VerifyCoverage

FORMAT = 1
"""Raised when the meaning of a key changes; new keys may come at any time."""

Json = bool | int | float | str | None | list["Json"] | dict[str, "Json"]


def to_json(report: Report) -> str:
    """The text."""
    return json.dumps(report_object(report), ensure_ascii=False)


def report_object(report: Report) -> dict[str, Json]:
    """The same as an object, to be part of a larger one."""
    columns = {each.name: each for each in report.columns}
    return {
        "format": FORMAT,
        **_head(report.head),
        "same": _same(report),
        "verdict": report.verdict,
        "columns": [_column(each, report) for each in report.ordered()],
        "differences": [_difference(row, each, report.columns) for row, each in report.differences()],
        "rows": [_row(row, columns) for row in report.rows],
    }


def _same(report: Report) -> bool | None:
    """None: there is no verdict, as nothing was compared, or not all that was asked."""
    return {"differs": False, "same": True}.get(report.verdict)


def _head(head: ReportHead) -> dict[str, Json]:
    return {
        "tool": head.tool, "project": head.project, "instance": head.instance, "model": head.model, "by": head.by,
        "when": head.when, "program_version": head.version, "range": head.title, "source": head.source,
        "trace": head.trace or None, "interval_ns": head.interval_ns, "first": head.first, "last": head.last,
        "compared": head.compared, "skipped": head.skipped, "not_reached": head.not_reached,
        "skipped_stretches": [[first, last] for first, last in head.stretches],
        "limit": head.limit, "differing_rows": head.differing, "rows_left_out": head.forgotten,
        "note": head.note or None, "coverage": _coverage(head.coverage),
    }  # fmt: skip


def _coverage(coverage: VerifyCoverage | None) -> Json:
    if coverage is None:
        return None
    return {
        "outputs": [
            {
                "column": each.column, "variable": each.path, "compared": each.compared, "differing": each.differing,
                "within_tolerance": each.allowed, "left_open_by_rounding": each.left_open, "without_value": each.missing,
                "largest_deviation": each.largest,
            }
            for each in coverage.outputs
        ],
        "inputs": list(coverage.inputs), "ignored_columns": list(coverage.ignored),
        "not_recorded": list(coverage.unrecorded), "remembered_not_recorded": list(coverage.remembered),
        "assumed": list(coverage.assumed), "read_not_recorded": list(coverage.ungiven), "more": coverage.more,
    }  # fmt: skip


def _column(column: Column, report: Report) -> Json:
    return {
        "name": column.name, "type": column.type, "size": column.size, "input": column.name in report.inputs,
        "output": column.name in report.outputs,
    }  # fmt: skip


def _row(row: Row, columns: dict[str, Column]) -> Json:
    def text(name: str, data: bytes | None) -> Json:
        return None if data is None else value_text(columns[name], data)

    return {
        "kind": row.kind, "scan": row.scan, "call": row.call, "count": row.count, "instance": row.instance,
        "place": _place(row.place), "next": _place(row.next), "compared": row.compared, "differs": row.differs,
        "outputs": {
            name: {"control": text(name, each.control), "monitor": text(name, each.monitor), "set": text(name, each.set)}
            for name, each in row.outputs.items() if name in columns
        },
        "inputs": {
            name: {"recorded": text(name, each.recorded), "expected": text(name, each.expected), "set": text(name, each.set)}
            for name, each in row.inputs.items() if name in columns
        },
        "disturbances": list(row.disturbances), "used": row.used, "note": row.note or None,
        "consequences": [each.message for each in row.consequences],
    }  # fmt: skip


def _difference(row: Row, difference: Mismatch, columns: tuple[Column, ...]) -> Json:
    column, bits = column_of(difference, columns), differing_bits(difference.control, difference.monitor)
    return {
        "scan": row.scan, "call": row.call, "instance": row.instance, "cause": difference.cause,
        "variable": difference.name, "type": difference.type or None,
        "was": value_text(column, difference.control) or None, "is": value_text(column, difference.monitor) or None,
        "was_bytes": difference.control.hex(), "is_bytes": difference.monitor.hex(), "bits": [*bits],
        "place": _place(difference.place), "disturbances": list(row.disturbances), "message": difference.message,
    }  # fmt: skip


def _place(place: Place | None) -> Json:
    if place is None:
        return None
    return {
        "task": place.task, "instance": place.instance, "pou": place.pou, "file": place.file, "line": place.line,
        "text": place.text,
    }  # fmt: skip
