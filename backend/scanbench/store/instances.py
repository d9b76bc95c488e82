"""Virtual PLCs, and the log of each."""

from collections.abc import Sequence
from dataclasses import asdict

from sqlalchemy import delete, func, insert, select
from sqlalchemy.exc import IntegrityError

from scanbench.runtime.clock import wall_time
from scanbench.store import rows
from scanbench.store.connected import Repository, check, the_instance, the_project
from scanbench.store.records import InstanceRow, Json, Limits, LogRow, NameTaken, NotFound
from scanbench.store.tables import AUTHOR, NAME, Instance, Log


class Instances(Repository):
    """Instances, by number."""

    def all(self) -> list[InstanceRow]:
        """Every instance, in the order of their making."""
        with self._database.reading() as session:
            return [rows.instance(found) for found in session.scalars(select(Instance).order_by(Instance.id))]

    def create(self, project: int, name: str, look: bool = False) -> InstanceRow:
        """A new virtual PLC for a project; `look`: for a look at the past."""
        check("the name", name, NAME)
        try:
            with self._database.writing() as session:
                the_project(session, project)
                made = Instance(project_id=project, name=name, created=wall_time(), look=look)
                session.add(made)
                session.flush()
                return rows.instance(made)
        except IntegrityError as error:
            raise NameTaken(f"there is an instance {name!r} already: choose another name") from error

    def change(
        self, instance: int, *, name: str | None = None, powered: bool | None = None, limits: Limits | None = None
    ) -> InstanceRow:
        """Changes what is given."""
        if name is not None:
            check("the name", name, NAME)
        try:
            with self._database.writing() as session:
                row = the_instance(session, instance, lock=True)
                row.name = row.name if name is None else name
                row.powered = row.powered if powered is None else powered
                if limits is not None:
                    row.memory_mib, row.cpu_percent, row.run_mib = (
                        limits.memory_mib, limits.cpu_percent, limits.run_mib
                    )  # fmt: skip
                session.flush()
                return rows.instance(row)
        except IntegrityError as error:
            raise NameTaken(f"there is an instance {name!r} already: choose another name") from error

    def keep_communication(self, instance: int, content: Json) -> None:
        """Its servers of protocols."""
        with self._database.writing() as session:
            the_instance(session, instance, lock=True).communication = dict(content)

    def delete(self, instance: int) -> None:
        """Deletes it with its history and log."""
        with self._database.writing() as session:
            if session.scalars(delete(Instance).where(Instance.id == instance).returning(Instance.id)).first() is None:
                raise NotFound(f"there is no instance {instance}")


class Logs(Repository):
    """The lines of each instance's log."""

    def last(self, instance: int, limit: int) -> list[LogRow]:
        """The last `limit` lines, oldest first."""
        with self._database.reading() as session:
            the_instance(session, instance)
            found = select(Log).where(Log.instance_id == instance).order_by(Log.id.desc()).limit(limit)
            return [rows.log(entry) for entry in reversed(session.scalars(found).all())]

    def page(
        self, instance: int, first: int | None, limit: int, kind: str | None = None
    ) -> tuple[int, int, list[LogRow]]:
        """`limit` lines from the number `first` on, counted from 0, or the last ones: the first's number, how many there
        are, and the lines, oldest first."""
        with self._database.reading() as session:
            the_instance(session, instance)
            of = Log.instance_id == instance if kind is None else (Log.instance_id == instance) & (Log.kind == kind)
            total = session.scalars(select(func.count()).select_from(Log).where(of)).one()
            begin = max(0, total - limit) if first is None else first
            found = select(Log).where(of).order_by(Log.id).offset(begin).limit(limit)
            return begin, total, [rows.log(entry) for entry in session.scalars(found)]

    def errors(self, instance: int, version: int, limit: int) -> tuple[int, list[LogRow]]:
        """What was last raised and recovered while this version of the program ran, oldest first, and how much there was before."""
        with self._database.reading() as session:
            the_instance(session, instance)
            of = (Log.instance_id == instance) & (Log.program_version == version) & Log.kind.in_(("error", "recover"))
            total = session.scalars(select(func.count()).select_from(Log).where(of)).one()
            found = select(Log).where(of).order_by(Log.id.desc()).limit(limit)
            return max(0, total - limit), [rows.log(entry) for entry in reversed(session.scalars(found).all())]

    def add(self, instance: int, lines: Sequence[LogRow], keep: int | None = None) -> None:
        """More lines, in their order; with `keep` only the last so many lines of the instance stay."""
        with self._database.writing() as session:
            the_instance(session, instance)
            if lines:
                told = [{**asdict(line), "author": line.author[:AUTHOR], "instance_id": instance} for line in lines]
                session.execute(insert(Log), told)
            if keep is not None:
                ids = select(Log.id).where(Log.instance_id == instance).order_by(Log.id.desc())
                last = session.scalars(ids.offset(keep).limit(1)).first()
                if last is not None:
                    session.execute(delete(Log).where(Log.instance_id == instance, Log.id <= last))
