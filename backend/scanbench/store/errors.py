"""The part of the store that keeps the error history of every PLC, version by version."""

from collections.abc import Sequence
from dataclasses import asdict
from typing import cast

from sqlalchemy import Insert, Table, select
from sqlalchemy.dialects import postgresql, sqlite
from sqlalchemy.orm import Session

from scanbench.store import rows
from scanbench.store.connected import Repository, the_instance
from scanbench.store.records import HistoryRow
from scanbench.store.tables import AUTHOR, ErrorHistory

_TABLE = cast(Table, ErrorHistory.__table__)


class Errors(Repository):
    """Error history and reactions."""

    def history(self, instance: int) -> list[HistoryRow]:
        """The errors that were raised on an instance, by version of the program and id."""
        with self._database.reading() as session:
            the_instance(session, instance)
            found = select(ErrorHistory).where(ErrorHistory.instance_id == instance)
            ordered = found.order_by(ErrorHistory.program_version, ErrorHistory.error)
            return [rows.history(entry) for entry in session.scalars(ordered)]

    def keep(self, instance: int, errors: Sequence[HistoryRow]) -> None:
        """Each of these takes the place of what was known of the same error on the same version."""
        with self._database.writing() as session:
            the_instance(session, instance, lock=True)
            if errors:
                session.execute(_upsert(session), [_columns(instance, row) for row in errors])


def _upsert(session: Session) -> Insert:
    """One statement for all rows: a row that is there already is replaced."""
    if session.get_bind().dialect.name == "postgresql":
        made = postgresql.insert(_TABLE)
        return made.on_conflict_do_update(constraint=_TABLE.primary_key, set_=dict(made.excluded))
    other = sqlite.insert(_TABLE)
    return other.on_conflict_do_update(index_elements=list(_TABLE.primary_key), set_=dict(other.excluded))


def _columns(instance: int, row: HistoryRow) -> dict[str, object]:
    return {**asdict(row), "instance_id": instance, "by": row.by[:AUTHOR], "recovered_by": row.recovered_by[:AUTHOR]}
