"""What was tested: for every version of the program one row for every error instance, folded from journal entries as they come."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import datetime
from typing import Literal

from scanbench.faults.acknowledge import Acknowledge, Acknowledged
from scanbench.faults.details import Chosen, choose, code_text_with
from scanbench.faults.inject import Generate, Recover
from scanbench.faults.present import Active, Origin, Way, instances_in
from scanbench.faults.reaction.reaction import WORST_FIRST, Reaction, Verdict
from scanbench.faults.reference import ErrorRef, named_reference, natural
from scanbench.plcmodel.hardware import FittedKind, fitted_kind
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

    @property
    def unmet(self) -> int:
        """How much is not as it is required, unexpected restarts counted."""
        return 0 if self.found is None else len(self.found.unmet)


@dataclass(frozen=True, slots=True)
class Swept:
    """What the newest sweep of a version found out about an error: the worst of all states."""

    verdict: Verdict
    scans: int | None
    unmet: int = 0
    """So much was not as it is required there, unexpected restarts counted."""


def worst(found: Iterable[tuple[str, Swept]]) -> dict[str, Swept]:
    """Of what was found in several states the worst, by error: what is not as required first; of several as bad the slowest."""
    kept: dict[str, Swept] = {}
    for id, swept in found:
        if id not in kept or _badness(swept) < _badness(kept[id]):
            kept[id] = swept
    return kept


def _badness(swept: Swept) -> tuple[int, int, int]:
    return -swept.unmet, WORST_FIRST.index(swept.verdict), -(swept.scans or 0)


@dataclass(frozen=True, slots=True)
class ErrorRow:
    """The history of one error instance on one PLC and one version of its program."""

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
    recovered_by: str = ""
    """Who recovered or cleared it; empty: it is present, or went with a restart."""
    recovered_way: Way | None = None
    acknowledged: Acknowledged | None = None
    """None: nobody has acknowledged this time of it."""
    instance: str = ""
    """Which of its kind, in the notation of references: `fal:number=5`. Empty: the kind, of which no instance is known yet."""

    fitted: bool = True
    """False: the project says that the hardware is not there."""
    label: str = ""
    """What the project calls the unit or the number."""

    @property
    def key(self) -> str:
        """What names it among the rows of a version."""
        return self.instance or self.id


def instance_of(error: ErrorEntry | None, id: str, details: str) -> str:
    """The instance that a row is of, from its details: `rack=1, slot=3`."""
    known = dict(part.split("=", 1) for part in details.split(", ") if "=" in part)
    names = [each.name for each in error.identifying] if error is not None else []
    return str(ErrorRef(id, tuple((name, known[name]) for name in names if name in known)))


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
        self._swept: Mapping[int, Mapping[str, list[ErrorRef]]] = {}
        self._worst: Mapping[int, Mapping[str, Swept]] = {}
        self._raised_by_version: dict[int, dict[str, ErrorRow]] = {}
        for row in kept:
            self._raised_by_version.setdefault(row.program_version, {})[row.key] = row

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
        raised: dict[str, dict[str, ErrorRow]] = {}
        for key, row in self._raised_by_version.get(version, {}).items():
            raised.setdefault(row.id, {})[key] = row
        swept = self._swept.get(version, {})
        return [
            row
            for error in model.errors()
            for row in _rows_of_kind(model, error, raised.get(error.id, {}), swept.get(error.id, ()), version)
        ]

    def take_sweeps(self, swept: Mapping[int, Mapping[str, Swept]]) -> None:
        """What sweeps found out, by version and error, which may have details."""
        by_kind = {version: self._by_kind(found) for version, found in swept.items()}
        self._swept = {
            version: {id: [ref for ref, _ in cells] for id, cells in kinds.items()}
            for version, kinds in by_kind.items()
        }
        self._worst = {
            version: worst(
                (key, each) for cells in kinds.values() for ref, each in cells for key in self._rows_with(ref)
            )
            for version, kinds in by_kind.items()
        }

    def with_sweep(self, row: ErrorRow) -> ErrorRow:
        """The row with what a sweep of its version found out; of several cells the worst."""
        swept = self._worst.get(row.program_version, {}).get(row.key)
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
            return self._cleared(self._recovered(command), entry.at, entry.scan, (command.author, command.way))
        if isinstance(command, Acknowledge):
            return self._acknowledged(entry, command)
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
        present = {key: self._now[key] for key in self._present}
        self._version = version
        changed = self._cleared([key for key in self._present if key not in present], at, scan)
        for key, row in present.items():
            known = self._now.get(key)
            same = known is not None and known.generated_at == row.generated_at
            if same and known is not None and known.status == "generated":
                continue  # the program went back to a version that saw it raised
            count = (0 if known is None else known.count) + (not same)
            reaction = known.reaction if same and known is not None else None
            self._now[key] = replace(row, program_version=version, count=count, reaction=reaction)
            changed.append(self._now[key])
        return changed

    def reconcile(self, present: Mapping[str, Active], at: datetime) -> list[ErrorRow]:
        """These errors are present now and no others, whatever was heard of before (a branch has a past that nobody told);
        the rows that it changed."""
        there = {self._key(raised.ref): raised for raised in instances_in(present).values()}
        changed = self._cleared([key for key in self._present if key not in there], at, 0)
        for key, raised in there.items():
            row = self._now.get(key)
            if row is None or row.status != "generated":
                changed += self._raised(raised.ref, at, raised.scan, raised.by, raised.origin, None)
        return changed

    def as_of(self, present: Mapping[str, Active], scan: int, version: int | None = None) -> list[ErrorRow]:
        """Every row as it was at the beginning of `scan`, when these errors and no others were present; nothing is changed.

        Of each row the last time that it was raised is known. What is not known of an earlier time is None."""
        shown = self._version if version is None else version
        known = [row for rows in self._raised_by_version.values() for row in rows.values()]
        then = History(self._model, shown, [earlier for row in known if (earlier := _before(row, scan)) is not None])
        for key, raised in {self._key(each.ref): each for each in instances_in(present).values()}.items():
            row = self._raised_by_version.get(shown, {}).get(key)
            if row is not None and row.generated_scan == raised.scan:
                then._now[key] = _uncleared(_unacknowledged(row, scan))
            else:
                then._raised(raised.ref, None, raised.scan, raised.by, raised.origin, None)
        return then.rows

    def set_reaction(self, key: str, version: int, scan: int, found: Reaction | str) -> ErrorRow | None:
        """What was found out of the reaction to an instance that was raised before `scan` on this version, or why nothing
        was; the changed row, or None when it was raised again in the meantime."""
        row = self._raised_by_version.get(version, {}).get(key)
        if row is None or row.reaction is None or row.reaction.scan != scan:
            return None
        text, seen = (found, None) if isinstance(found, str) else ("", found)
        reaction = RowReaction("done" if seen is not None else "failed", seen, text, scan)
        changed = replace(row, reaction=reaction)
        self._raised_by_version[version][key] = changed
        return changed

    # ---- inside ---------------------------------------------------------------------------------------------------

    @property
    def _now(self) -> dict[str, ErrorRow]:
        """The rows of errors that were raised on the version that runs."""
        return self._raised_by_version.setdefault(self._version, {})

    @property
    def _present(self) -> list[str]:
        return [row.key for row in self._now.values() if row.status == "generated"]

    def _key(self, ref: ErrorRef) -> str:
        """What names the row of this error."""
        return _key_of(self._model, self._layout, ref)

    def _by_kind(self, found: Mapping[str, Swept]) -> dict[str, list[tuple[ErrorRef, Swept]]]:
        by_kind: dict[str, list[tuple[ErrorRef, Swept]]] = {}
        for text, swept in found.items():
            ref = named_reference(self._key(named_reference(text)))
            by_kind.setdefault(ref.id, []).append((ref, swept))
        return by_kind

    def _rows_with(self, ref: ErrorRef) -> set[str]:
        """The rows that a cell tells something about: the one of its instance, and the one of a kind without instances."""
        error = self._model.error(ref.id)
        return {ref.id, str(ref)} | ({str(_identified(error, ref))} if error is not None else set())

    def _recovered(self, command: Recover) -> list[str]:
        if command.ids is None:
            return self._present
        numbers = set(map(self._key, command.numbers))
        return [key for key in self._present if self._now[key].id in command.ids or key in numbers]

    def _generated(self, entry: Entry, command: Generate) -> list[ErrorRow]:
        changed: list[ErrorRow] = []
        raised = set(map(self._key, command.errors))
        changed += self._cleared(set(map(self._key, command.replaces or ())) - raised, entry.at, entry.scan)
        for ref in command.errors:
            reaction = self._reaction_to(entry, command, self._key(ref))
            changed += self._raised(ref, entry.at, entry.scan, command.author, command.origin, reaction)
        return changed

    def _reaction_to(self, entry: Entry, command: Generate, key: str) -> RowReaction | None:
        """A fault that recurs is compared once, from its first time on; so is one that only gets new details, as a comparison
        with a run in which it is present already shows little."""
        if command.origin != "simulator":
            return None
        if key not in map(self._key, command.replaces or ()) and any(
            each.id == named_reference(key).id for each in command.replaces or ()
        ):
            return None  # it only moved to a different unit
        known = self._now.get(key)
        if known is not None and known.reaction is not None:
            if comes_again(command) or (command.again and known.status == "generated"):
                return known.reaction
        return RowReaction("recording", scan=entry.scan)

    def _raised(
        self, ref: ErrorRef, at: datetime | None, scan: int, by: str, origin: Origin, reaction: RowReaction | None
    ) -> list[ErrorRow]:
        error = self._model.error(ref.id)
        chosen = choose(error, dict(ref.details), self._layout) if error is not None else None
        if error is None or chosen is None or isinstance(chosen, Refusal):
            return []
        key = str(chosen.instance)
        row = self._now.get(key) or _never(error, self._version, key)
        raised = replace(
            row,
            status="generated", code=chosen.code_text, details=str(chosen), generated_at=at, recovered_at=None,
            generated_scan=scan, recovered_scan=None, recovered_by="", recovered_way=None, acknowledged=None, by=by, origin=origin,
            count=row.count + 1, reaction=reaction,
        )  # fmt: skip
        self._now[key] = _told(fitted_kind(self._model.fitted, error), raised)
        return [self._now[key]]

    def _acknowledged(self, entry: Entry, command: Acknowledge) -> list[ErrorRow]:
        key = self._key(named_reference(command.error))
        row = self._now.get(key)
        if row is None:
            return []
        self._now[key] = replace(
            row, acknowledged=Acknowledged(command.author, entry.at, entry.scan, command.remark)
        )  # fmt: skip
        return [self._now[key]]

    def _cleared(
        self, keys: Iterable[str], at: datetime, scan: int, by: tuple[str, Way] | None = None
    ) -> list[ErrorRow]:
        changed = []
        who, way = by or ("", None)
        for key in keys:
            row = self._now.get(key)
            if row is not None and row.status == "generated":
                self._now[key] = replace(
                    row, status="cleared", recovered_at=at, recovered_scan=scan, recovered_by=who, recovered_way=way
                )  # fmt: skip
                changed.append(self._now[key])
        return changed


def _before(row: ErrorRow, scan: int) -> ErrorRow | None:
    """The row at the beginning of `scan`, when its error was not present; None: it had not been raised yet."""
    if row.generated_scan is None:
        return row
    if row.generated_scan < scan:
        return replace(_unacknowledged(row, scan), status="cleared")
    if row.count == 1:
        return None
    return replace(
        _uncleared(row), status="cleared", generated_at=None, generated_scan=None, by=None, reaction=None, acknowledged=None
    )  # fmt: skip


def _unacknowledged(row: ErrorRow, scan: int) -> ErrorRow:
    """The row as it was before `scan`, as far as somebody has acknowledged it later."""
    later = row.acknowledged is not None and row.acknowledged.scan >= scan
    return replace(row, acknowledged=None) if later else row


def _uncleared(row: ErrorRow) -> ErrorRow:
    return replace(row, status="generated", recovered_at=None, recovered_scan=None, recovered_by="", recovered_way=None)


def key_for(model: Model, text: str) -> str:
    """What names the row of an error that a sweep raised."""
    return _key_of(model, _layout(model), named_reference(text))


def _key_of(model: Model, layout: Layout, ref: ErrorRef) -> str:
    error = model.error(ref.id)
    chosen = None if error is None else choose(error, dict(ref.details), layout)
    return str(chosen.instance) if isinstance(chosen, Chosen) else str(ref)


def _rows_of_kind(
    model: Model,
    error: ErrorEntry,
    raised: Mapping[str, ErrorRow],
    swept: Sequence[ErrorRef],
    version: int,
) -> list[ErrorRow]:
    """A row for each instance that is fitted, was raised or swept, in the order of their numbers; else one for the kind."""
    names = {each.name for each in error.identifying}
    told = (_identified(error, ref) for ref in swept)
    known = {*raised, *(str(ref) for ref in told if ref.details or not names)}
    kind = fitted_kind(model.fitted, error)
    known |= {str(ErrorRef(error.id, details)) for details in kind.instances or ()}
    rows = [raised.get(key) or _never(error, version, key) for key in sorted(known, key=natural)]
    return [_told(kind, row) for row in rows or [_never(error, version)]]


def _identified(error: ErrorEntry, ref: ErrorRef) -> ErrorRef:
    """With just the details that tell it apart from others of its kind."""
    names = {each.name for each in error.identifying}
    return ErrorRef(error.id, tuple(each for each in ref.details if each[0] in names))


def _told(kind: FittedKind, row: ErrorRow) -> ErrorRow:
    """The row as the model of its version tells it."""
    error, details = kind.error, named_reference(row.key).details
    return replace(
        row, name=error.name, severity=error.severity, fitted=kind.has(details), label=kind.name(details)
    )  # fmt: skip


def _never(error: ErrorEntry, version: int, instance: str = "") -> ErrorRow:
    """A row of what was never raised; of a kind whose instances are not told apart it is its only one."""
    known = instance or ("" if error.identifying else error.id)
    given = named_reference(instance).details
    details, code = ", ".join(f"{name}={value}" for name, value in given), code_text_with(error, dict(given))
    return ErrorRow(
        error.id, error.name, error.severity, code=code, details=details, program_version=version, instance=known
    )  # fmt: skip


def _layout(model: Model) -> Layout:
    """Codes and details are the same in every layout, so any will do."""
    return Layout(model, {area.name: 0 for area in model.areas})
