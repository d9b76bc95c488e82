"""The part of the store that keeps states, sweeps and what was accepted of their findings."""

import logging
from collections.abc import Sequence
from dataclasses import asdict, fields

from sqlalchemy import delete, func, select, update
from sqlalchemy.exc import IntegrityError
from sqlalchemy.orm import Session

from scanbench.runtime.clock import wall_time
from scanbench.store import rows
from scanbench.store.connected import Repository, check, the_project
from scanbench.store.records import (
    AcceptedRow,
    CellRow,
    Json,
    NameTaken,
    NotFound,
    StateRow,
    SweepProblem,
    SweepRow,
    SweepStatus,
    SweptError,
)
from scanbench.store.tables import AUTHOR, NAME, AcceptedFinding, ProgramState, Sweep, SweepCell

log = logging.getLogger("scanbench")


class States(Repository):
    """States of programs that were kept, from which sweeps begin."""

    def all(self, project: int) -> list[StateRow]:
        """The kept states of a project, by name."""
        with self._database.reading() as session:
            the_project(session, project)
            found = select(ProgramState).where(ProgramState.project_id == project).order_by(ProgramState.name)
            return [rows.state(each) for each in session.scalars(found)]

    def create(self, project: int, name: str, *, instance: str, scan: int, program_version: int, by: str) -> StateRow:
        """Keeps a state; its name is its own in the project."""
        check("the name", name, NAME)
        try:
            with self._database.writing() as session:
                the_project(session, project)
                made = ProgramState(
                    project_id=project, name=name, instance=instance, scan=scan, program_version=program_version,
                    by=by[:AUTHOR], at=wall_time(),
                )  # fmt: skip
                session.add(made)
                session.flush()
                return rows.state(made)
        except IntegrityError as error:
            raise NameTaken(f"there is a state {name!r} in this project already: choose another name") from error

    def delete(self, state: int) -> None:
        """Forgets a state; sweeps that began from it stay."""
        with self._database.writing() as session:
            gone = delete(ProgramState).where(ProgramState.id == state).returning(ProgramState.id)
            if session.scalars(gone).first() is None:
                raise NotFound(f"there is no state {state}")


class Sweeps(Repository):
    """Sweeps and their cells."""

    def all(self, project: int) -> list[SweepRow]:
        """The sweeps of a project, the newest first. The log names those that cannot be read."""
        with self._database.reading() as session:
            the_project(session, project)
            found = session.scalars(select(Sweep).where(Sweep.project_id == project).order_by(Sweep.id.desc())).all()
            counts = _counts(session, [row.id for row in found])
            read: list[SweepRow] = []
            for row in found:
                try:
                    read.append(rows.sweep(row, counts[row.id]))
                except rows.UnreadableSweep as error:
                    log.error("%s", error)
            return read

    def ids(self) -> set[int]:
        """All sweeps of all projects, also those that cannot be read."""
        with self._database.reading() as session:
            return set(session.scalars(select(Sweep.id)))

    def get(self, sweep: int) -> SweepRow:
        """One sweep; `StoreError` when it cannot be read."""
        with self._database.reading() as session:
            return rows.sweep(_sweep(session, sweep), _counts(session, [sweep])[sweep])

    def create(
        self, project: int, *, instance_id: int | None, instance: str, model: str, program_version: int, by: str,
        window: int, states: Sequence[str], errors: Sequence[SweptError],
    ) -> SweepRow:  # fmt: skip
        """A sweep that runs, without cells."""
        with self._database.writing() as session:
            the_project(session, project)
            made = Sweep(
                project_id=project, instance_id=instance_id, instance=instance, model=model,
                program_version=program_version, by=by[:AUTHOR], at=wall_time(), status="running", message="",
                window=window, states=list(states), errors=[asdict(each) for each in errors], seconds=0.0,
            )  # fmt: skip
            session.add(made)
            session.flush()
            return rows.sweep(made, rows.NOTHING)

    def change(self, sweep: int, *, status: SweepStatus, message: str, seconds: float) -> SweepRow:
        """Sets the state of a sweep; `seconds` spent in all."""
        with self._database.writing() as session:
            row = _sweep(session, sweep)
            row.status, row.message, row.seconds = status, message, seconds
            session.flush()
            return rows.sweep(row, _counts(session, [sweep])[sweep])

    def plan(self, sweep: int, errors: Sequence[SweptError], problems: Sequence[SweepProblem]) -> SweepRow:
        """Sets what a sweep raises, and what is wrong with what is required."""
        with self._database.writing() as session:
            row = _sweep(session, sweep)
            row.errors = [asdict(each) for each in errors]
            row.problems = [asdict(each) for each in problems]
            session.flush()
            return rows.sweep(row, _counts(session, [sweep])[sweep])

    def interrupt(self, message: str) -> int:
        """At the start of a server: what ran when it ended is interrupted; how many that were."""
        with self._database.writing() as session:
            ended = update(Sweep).where(Sweep.status == "running").values(status="interrupted", message=message)
            return len(session.scalars(ended.returning(Sweep.id)).all())

    def delete(self, sweep: int) -> None:
        """Deletes a sweep with its cells."""
        with self._database.writing() as session:
            if session.scalars(delete(Sweep).where(Sweep.id == sweep).returning(Sweep.id)).first() is None:
                raise NotFound(f"there is no sweep {sweep}")

    def add_cells(self, sweep: int, cells: Sequence[CellRow]) -> None:
        """More cells; one that is there already is replaced."""
        with self._database.writing() as session:
            _sweep(session, sweep)
            for cell in cells:
                reaction = None if cell.reaction is None else dict(cell.reaction)
                untried = [asdict(each) for each in cell.untried]
                told = {each.name: getattr(cell, each.name) for each in fields(cell)}
                session.merge(SweepCell(sweep_id=sweep, **told | {"reaction": reaction, "untried": untried}))

    def cells(self, sweep: int) -> list[CellRow]:
        """The cells in the order of errors and states, without their reactions."""
        with self._database.reading() as session:
            row = _sweep(session, sweep)
            errors = {error["id"]: place for place, error in enumerate(row.errors)}
            states = {state: place for place, state in enumerate(row.states)}
            found = [rows.cell(each) for each in session.scalars(select(SweepCell).where(SweepCell.sweep_id == sweep))]
            last = len(errors)
            return sorted(found, key=lambda cell: (errors.get(cell.error, last), states.get(cell.state, 0)))

    def reactions(self, sweep: int) -> dict[tuple[str, str], Json]:
        """The reactions of all cells that have one, by error and state."""
        with self._database.reading() as session:
            _sweep(session, sweep)
            found = session.scalars(select(SweepCell).where(SweepCell.sweep_id == sweep))
            return {(each.error, each.state): each.reaction for each in found if each.reaction is not None}

    def reaction(self, sweep: int, error: str, state: str) -> Json | None:
        """The reaction of one cell; None where there is none."""
        with self._database.reading() as session:
            _sweep(session, sweep)
            found = session.get(SweepCell, (sweep, error, state))
            if found is None:
                raise NotFound(f"sweep {sweep} has no cell for {error} from {state!r}")
            return found.reaction


class Findings(Repository):
    """What was accepted of what sweeps found."""

    def accepted(self, project: int) -> list[AcceptedRow]:
        """Everything that was accepted in a project."""
        with self._database.reading() as session:
            the_project(session, project)
            found = select(AcceptedFinding).where(AcceptedFinding.project_id == project)
            ordered = found.order_by(AcceptedFinding.error, AcceptedFinding.state)
            return [rows.accepted(each) for each in session.scalars(ordered)]

    def accept(self, project: int, *, error: str, state: str, reason: str, by: str) -> AcceptedRow:
        """Accepts a finding, or changes the reason."""
        check("the reason", reason, 500)
        check("the state", state, NAME)
        with self._database.writing() as session:
            the_project(session, project)
            made = AcceptedFinding(
                project_id=project, error=error, state=state, reason=reason, by=by[:AUTHOR], at=wall_time()
            )
            return rows.accepted(session.merge(made))

    def withdraw(self, project: int, *, error: str, state: str) -> None:
        """Takes an acceptance back."""
        with self._database.writing() as session:
            the_project(session, project)
            found = session.get(AcceptedFinding, (project, error, state))
            if found is None:
                raise NotFound(f"nobody accepted {error} from {state!r}")
            session.delete(found)


def _sweep(session: Session, id: int) -> Sweep:
    found = session.get(Sweep, id)
    if found is None:
        raise NotFound(f"there is no sweep {id}")
    return found


def _counts(session: Session, sweeps: Sequence[int]) -> dict[int, rows.Counted]:
    verdicts: dict[int, dict[str | None, int]] = {sweep: {} for sweep in sweeps}
    unmet = dict.fromkeys(sweeps, 0)
    columns = select(SweepCell.sweep_id, SweepCell.verdict, func.count(), func.sum(SweepCell.unmet))
    found = columns.where(SweepCell.sweep_id.in_(sweeps)).group_by(SweepCell.sweep_id, SweepCell.verdict)
    for sweep, verdict, count, failed in session.execute(found):
        verdicts[sweep][verdict] = count
        unmet[sweep] += int(failed)
    return {sweep: rows.Counted(verdicts[sweep], unmet[sweep]) for sweep in sweeps}
