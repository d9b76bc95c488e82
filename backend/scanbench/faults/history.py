"""What was tested: one row for every error of the catalogue, folded from journal entries as they come."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from datetime import datetime
from typing import Literal

from scanbench.check.layout import Layout
from scanbench.faults.details import choose
from scanbench.faults.inject import Active, Generate, Origin, Recover
from scanbench.faults.reference import ErrorRef
from scanbench.plcmodel.model import Model
from scanbench.runtime.command import Entry, Refusal

Status = Literal["never", "generated", "cleared"]


@dataclass(frozen=True, slots=True)
class ErrorRow:
    """The history of one error on one instance."""

    id: str
    name: str
    severity: Literal["fatal", "nonfatal"]
    status: Status = "never"
    code: str = ""
    details: str = ""
    generated_at: datetime | None = None
    recovered_at: datetime | None = None
    generated_scan: int | None = None
    recovered_scan: int | None = None
    by: str | None = None
    origin: Origin | None = None
    count: int = 0


class History:
    """The rows of one instance, in the order of the catalogue."""

    def __init__(self, model: Model, kept: Mapping[str, ErrorRow] | None = None) -> None:
        """`kept` is what is known from earlier, by id."""
        self._model = model
        # Codes and details are the same in every layout, so any will do.
        self._layout = Layout(model, {area.name: 0 for area in model.areas})
        self._rows = {
            error.id: (kept or {}).get(error.id) or ErrorRow(error.id, error.name, error.severity, code=error.code_text)
            for error in model.errors()
        }

    @property
    def rows(self) -> list[ErrorRow]:
        """Every row, in the order of the catalogue."""
        return list(self._rows.values())

    def fold(self, entry: Entry) -> list[ErrorRow]:
        """Takes an entry in; the rows that it changed."""
        command = entry.command
        if entry.plan.starts_anew:
            return self._cleared(self._present, entry.at, entry.scan)
        if isinstance(command, Generate):
            return self._generated(entry, command)
        if isinstance(command, Recover):
            return self._cleared(self._present if command.ids is None else command.ids, entry.at, entry.scan)
        return []

    def reconcile(self, present: Mapping[str, Active], at: datetime) -> list[ErrorRow]:
        """These errors are present now and no others, whatever was heard of before (a branch has a past that nobody told);
        the rows that it changed."""
        changed = self._cleared([id for id in self._present if id not in present], at, 0)
        for id, active in present.items():
            if id in self._rows and self._rows[id].status != "generated":
                changed += self._raised(active.refs[-1], at, active.scan, active.by, active.origin)
        return changed

    def as_of(self, present: Mapping[str, Active], at: datetime) -> list[ErrorRow]:
        """Every row as it was when these errors and no others were present; nothing is changed."""
        then = History(self._model, dict(self._rows))
        then.reconcile(present, at)
        return then.rows

    @property
    def _present(self) -> list[str]:
        return [row.id for row in self._rows.values() if row.status == "generated"]

    def _generated(self, entry: Entry, command: Generate) -> list[ErrorRow]:
        changed = []
        for ref in command.errors:
            changed += self._raised(ref, entry.at, entry.scan, command.author, command.origin)
        return changed

    def _raised(self, ref: ErrorRef, at: datetime, scan: int, by: str, origin: Origin) -> list[ErrorRow]:
        error = self._model.error(ref.id)
        chosen = choose(error, dict(ref.details), self._layout) if error is not None else None
        if error is None or chosen is None or isinstance(chosen, Refusal):
            return []
        row = self._rows[error.id]
        self._rows[error.id] = replace(
            row,
            status="generated", code=chosen.code_text, details=str(chosen), generated_at=at, recovered_at=None,
            generated_scan=scan, recovered_scan=None, by=by, origin=origin, count=row.count + 1,
        )  # fmt: skip
        return [self._rows[error.id]]

    def _cleared(self, ids: Iterable[str], at: datetime, scan: int) -> list[ErrorRow]:
        changed = []
        for id in ids:
            row = self._rows.get(id)
            if row is not None and row.status == "generated":
                self._rows[id] = replace(row, status="cleared", recovered_at=at, recovered_scan=scan)
                changed.append(self._rows[id])
        return changed
