"""States and sweeps -> wire shapes. Nothing is decided here."""

from collections.abc import Mapping
from typing import get_args

from scanbench.faults.reaction.reaction import Verdict
from scanbench.public import iso
from scanbench.server.sweeps import Comparison, Whole
from scanbench.store.records import AcceptedRow, CellRow, SweepRow
from scanbench.web import messages_errors as wire
from scanbench.wire.events import SweepChanged


def summary(row: SweepRow) -> wire.SweepSummary:
    """A sweep without its cells."""
    return wire.SweepSummary.model_validate(_summary(row))


def whole(found: Whole) -> wire.Sweep:
    """A sweep with its cells."""
    return wire.Sweep.model_validate(
        {
            **_summary(found.row),
            "errors": found.row.errors,
            "cells": [_cell(cell, found.accepted) for cell in found.cells],
        }
    )


def progress(changed: SweepChanged) -> wire.SweepProgress:
    """A sweep went on."""
    cells = [_cell(cell, changed.accepted) for cell in changed.cells]
    return wire.SweepProgress.model_validate({"sweep": _summary(changed.row), "now": changed.now, "cells": cells})


def accepted(row: AcceptedRow) -> wire.Accepted:
    """A finding that was accepted."""
    return wire.Accepted(reason=row.reason, by=row.by, at=iso(row.at))


def comparison(found: Comparison) -> wire.SweepComparison:
    """Two sweeps side by side."""
    names = {each.id: each.name for each in (*found.before.errors, *found.after.errors)}
    return wire.SweepComparison(
        before=summary(found.before), after=summary(found.after),
        changes=[
            wire.SweepChange.model_validate(
                {
                    "error": each.error, "name": names.get(each.error, each.error), "state": each.state,
                    "before": each.before, "after": each.after, "scans_before": each.scans_before,
                    "scans_after": each.scans_after, "change": each.change, "lost": list(each.lost),
                    "unmet": list(each.unmet),
                }
            )
            for each in found.changes
        ],
    )  # fmt: skip


def _summary(row: SweepRow) -> dict[str, object]:
    return {
        "id": row.id, "project": row.project, "instance_id": row.instance_id, "instance": row.instance,
        "model": row.model, "program_version": row.program_version, "by": row.by, "at": iso(row.at),
        "status": row.status,
        "message": row.message, "done": row.done, "total": row.total, "window": row.window,
        "states": list(row.states), "seconds": round(row.seconds, 1),
        "counts": {verdict: row.counts.get(verdict, 0) for verdict in get_args(Verdict)},
        "unmet": row.unmet, "problems": row.problems,
    }  # fmt: skip


def _cell(cell: CellRow, by_pair: Mapping[tuple[str, str], AcceptedRow]) -> dict[str, object]:
    row = by_pair.get((cell.error, cell.state))
    return {
        "error": cell.error, "state": cell.state, "verdict": cell.verdict, "first_read": cell.first_read,
        "first_effect": cell.first_effect, "raised_scan": cell.raised_scan, "difference_count": cell.difference_count,
        "required": cell.required, "unmet": cell.unmet, "untried": cell.untried,
        "note": cell.note, "accepted": None if row is None else accepted(row).model_dump(),
    }  # fmt: skip
