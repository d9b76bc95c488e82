"""What was tested: for every version of the program one row for every error, folded from journal entries as they come."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from datetime import datetime
from typing import Literal

from scanbench.faults.details import choose
from scanbench.faults.inject import Active, Generate, Origin, Recover
from scanbench.faults.reaction.reaction import WORST_FIRST, Reaction, Verdict
from scanbench.faults.reference import ErrorRef
from scanbench.plcmodel.model import ErrorEntry, Model
from scanbench.program.layout import Layout
from scanbench.runtime.command import Entry, Refusal, Swapped

Status = Literal["never", "generated", "cleared"]


@dataclass(frozen=True, slots=True)
class RowReaction:
    """What is known of the reaction to an error, the last time it was raised. `message` says why it failed."""

    state: Literal["recording", "done", "failed"]
    found: Reaction | None = None
    message: str = ""
    scan: int = 0
    """Before which the error was raised."""

    @property
    def verdict(self) -> Verdict | None:
        """In a word; None while there is none."""
        return None if self.found is None else self.found.verdict

    @property
    def scans(self) -> int | None:
        """Scans until the first effect."""
        return None if self.found is None else self.found.first_effect


@dataclass(frozen=True, slots=True)
class Swept:
    """What the newest sweep of a version found out about an error: the worst of all states."""

    verdict: Verdict
    scans: int | None


def worst(found: Iterable[tuple[str, Swept]]) -> dict[str, Swept]:
    """Of what was found in several states the worst, by error; of several as bad the slowest."""
    kept: dict[str, Swept] = {}
    for id, swept in found:
        if id not in kept or _badness(swept) < _badness(kept[id]):
            kept[id] = swept
    return kept


def _badness(swept: Swept) -> tuple[int, int]:
    return WORST_FIRST.index(swept.verdict), -(swept.scans or 0)


@dataclass(frozen=True, slots=True)
class ErrorRow:
    """The history of one error on one instance and one version of its program."""

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
    reaction: RowReaction | None = None
    program_version: int = 0
    swept: Swept | None = None
    """Not kept: sweeps are."""


def comes_again(command: Generate) -> bool:
    """Whether this is a later time of an armed fault."""
    return command.arm is not None and command.step > 0


class History:
    """The rows of one instance, in the order of the catalogue: those of the version that runs, and kept ones of others.

    Rows of a version that does not run any more stay as they were when it ended.
    """

    def __init__(self, model: Model, version: int = 0, kept: Iterable[ErrorRow] = ()) -> None:
        """`kept` is what is known from earlier, of any version."""
        self._model = model
        self._layout = _layout(model)
        self._version = version
        self._swept: Mapping[int, Mapping[str, Swept]] = {}
        self._raised_by_version: dict[int, dict[str, ErrorRow]] = {}
        for row in kept:
            self._raised_by_version.setdefault(row.program_version, {})[row.id] = row

    @property
    def version(self) -> int:
        """Of the program that runs."""
        return self._version

    @property
    def versions(self) -> list[int]:
        """The version that runs, and those on which errors were raised."""
        return sorted({self._version} | {version for version, rows in self._raised_by_version.items() if rows})

    @property
    def rows(self) -> list[ErrorRow]:
        """Every row of the version that runs, in the order of the catalogue."""
        return self.rows_of(self._version, self._model)

    def rows_of(self, version: int, model: Model) -> list[ErrorRow]:
        """Every row of a version, which ran on this model."""
        raised = self._raised_by_version.get(version, {})
        return [
            replace(raised[error.id], name=error.name, severity=error.severity)
            if error.id in raised
            else _never(error, version)
            for error in model.errors()
        ]

    def take_sweeps(self, swept: Mapping[int, Mapping[str, Swept]]) -> None:
        """What sweeps found out, by version and error."""
        self._swept = swept

    def with_sweep(self, row: ErrorRow) -> ErrorRow:
        """The row with what a sweep of its version found out."""
        swept = self._swept.get(row.program_version, {}).get(row.id)
        return row if swept == row.swept else replace(row, swept=swept)

    # ---- what happens ---------------------------------------------------------------------------------------------

    def fold(self, entry: Entry) -> list[ErrorRow]:
        """Takes an entry in; the rows that it changed. Where it changed the version, look at all `rows` again."""
        command, effect = entry.command, entry.plan.effect
        if isinstance(effect, Swapped):
            ended = self._cleared(self._present, entry.at, entry.scan) if effect.fresh else []
            return ended + self.turn_to(effect.version, entry.at, entry.scan)
        if entry.plan.starts_fresh:
            return self._cleared(self._present, entry.at, entry.scan)
        if isinstance(command, Generate):
            return self._generated(entry, command)
        if isinstance(command, Recover):
            return self._cleared(self._present if command.ids is None else command.ids, entry.at, entry.scan)
        return []

    def take_model(self, model: Model) -> None:
        """Takes the catalogue of a new program: the user's own errors are part of its version."""
        self._model = model
        self._layout = _layout(model)

    def begin(self, version: int) -> None:
        """This version runs; what is present is told later (`reconcile`)."""
        self._version = version

    def turn_to(self, version: int, at: datetime, scan: int) -> list[ErrorRow]:
        """Turns to the version that runs from now on. Present errors get rows of this version too; gives the rows that changed."""
        if version == self._version:
            return []
        present = {id: self._now[id] for id in self._present}
        self._version = version
        changed = self._cleared([id for id in self._present if id not in present], at, scan)
        for id, row in present.items():
            known = self._now.get(id)
            same = known is not None and known.generated_at == row.generated_at
            if same and known is not None and known.status == "generated":
                continue  # the program went back to a version that saw it raised
            count = (0 if known is None else known.count) + (not same)
            reaction = known.reaction if same and known is not None else None
            self._now[id] = replace(row, program_version=version, count=count, reaction=reaction)
            changed.append(self._now[id])
        return changed

    def reconcile(self, present: Mapping[str, Active], at: datetime) -> list[ErrorRow]:
        """These errors are present now and no others, whatever was heard of before (a branch has a past that nobody told);
        the rows that it changed."""
        changed = self._cleared([id for id in self._present if id not in present], at, 0)
        for id, active in present.items():
            row = self._now.get(id)
            if row is None or row.status != "generated":
                changed += self._raised(active.refs[-1], at, active.scan, active.by, active.origin, None)
        return changed

    def as_of(self, present: Mapping[str, Active], at: datetime, version: int | None = None) -> list[ErrorRow]:
        """Every row as it was when these errors and no others were present; nothing is changed."""
        known = [row for rows in self._raised_by_version.values() for row in rows.values()]
        then = History(self._model, self._version if version is None else version, known)
        then.reconcile(present, at)
        return then.rows

    def set_reaction(self, id: str, version: int, scan: int, found: Reaction | str) -> ErrorRow | None:
        """What was found out of the reaction to an error that was raised before `scan` on this version, or why nothing
        was; the changed row, or None when it was raised again in the meantime."""
        row = self._raised_by_version.get(version, {}).get(id)
        if row is None or row.reaction is None or row.reaction.scan != scan:
            return None
        text, seen = (found, None) if isinstance(found, str) else ("", found)
        reaction = RowReaction("done" if seen is not None else "failed", seen, text, scan)
        changed = replace(row, reaction=reaction)
        self._raised_by_version[version][id] = changed
        return changed

    # ---- inside ---------------------------------------------------------------------------------------------------

    @property
    def _now(self) -> dict[str, ErrorRow]:
        """The rows of errors that were raised on the version that runs."""
        return self._raised_by_version.setdefault(self._version, {})

    @property
    def _present(self) -> list[str]:
        return [row.id for row in self._now.values() if row.status == "generated"]

    def _generated(self, entry: Entry, command: Generate) -> list[ErrorRow]:
        changed = []
        for ref in command.errors:
            reaction = self._reaction_to(entry, command, ref.id)
            changed += self._raised(ref, entry.at, entry.scan, command.author, command.origin, reaction)
        return changed

    def _reaction_to(self, entry: Entry, command: Generate, id: str) -> RowReaction | None:
        """A fault that recurs is compared once, from its first time on; so is one that only gets new details, as a comparison
        with a run in which it is present already shows little."""
        if command.origin != "simulator":
            return None
        known = self._now.get(id)
        if known is not None and known.reaction is not None:
            if comes_again(command) or (command.again and known.status == "generated"):
                return known.reaction
        return RowReaction("recording", scan=entry.scan)

    def _raised(
        self, ref: ErrorRef, at: datetime, scan: int, by: str, origin: Origin, reaction: RowReaction | None
    ) -> list[ErrorRow]:
        error = self._model.error(ref.id)
        chosen = choose(error, dict(ref.details), self._layout) if error is not None else None
        if error is None or chosen is None or isinstance(chosen, Refusal):
            return []
        row = self._now.get(error.id) or _never(error, self._version)
        self._now[error.id] = replace(
            row,
            status="generated", code=chosen.code_text, details=str(chosen), generated_at=at, recovered_at=None,
            generated_scan=scan, recovered_scan=None, by=by, origin=origin, count=row.count + 1, reaction=reaction,
        )  # fmt: skip
        return [self._now[error.id]]

    def _cleared(self, ids: Iterable[str], at: datetime, scan: int) -> list[ErrorRow]:
        changed = []
        for id in ids:
            row = self._now.get(id)
            if row is not None and row.status == "generated":
                self._now[id] = replace(row, status="cleared", recovered_at=at, recovered_scan=scan)
                changed.append(self._now[id])
        return changed


def _never(error: ErrorEntry, version: int) -> ErrorRow:
    return ErrorRow(error.id, error.name, error.severity, code=error.code_text, program_version=version)


def _layout(model: Model) -> Layout:
    """Codes and details are the same in every layout, so any will do."""
    return Layout(model, {area.name: 0 for area in model.areas})
