"""The part of the store that keeps the error history of every PLC, version by version."""

from datetime import datetime

from sqlalchemy import select

from scanbench.store import rows
from scanbench.store.connected import Connected, the_instance
from scanbench.store.records import HistoryRow, Json, Origin, ReactionState
from scanbench.store.tables import AUTHOR, ErrorHistory


class Errors(Connected):
    """Error history and reactions."""

    def history(self, instance: int, version: int | None = None) -> list[HistoryRow]:
        """The errors that were raised on an instance, by version of the program and id; of one `version` if given."""
        with self._reading() as session:
            the_instance(session, instance)
            found = select(ErrorHistory).where(ErrorHistory.instance_id == instance)
            if version is not None:
                found = found.where(ErrorHistory.program_version == version)
            ordered = found.order_by(ErrorHistory.program_version, ErrorHistory.error)
            return [rows.history(entry) for entry in session.scalars(ordered)]

    def history_versions(self, instance: int) -> list[int]:
        """The versions on which errors were raised, in their order."""
        with self._reading() as session:
            the_instance(session, instance)
            versions = select(ErrorHistory.program_version).where(ErrorHistory.instance_id == instance).distinct()
            return sorted(session.scalars(versions))

    def record_generated(
        self, instance: int, error: str, *, program_version: int, code: str, details: str, at: datetime, scan: int,
        by: str, origin: Origin, count: int | None = None,
    ) -> HistoryRow:  # fmt: skip
        """An error was raised: its row says so, and counts, or takes over the count. Its reaction stays."""
        with self._writing() as session:
            the_instance(session, instance, lock=True)
            row = session.get(ErrorHistory, (instance, program_version, error))
            if row is None:
                row = ErrorHistory(
                    instance_id=instance, program_version=program_version, error=error, count=0, reaction_message=""
                )
                session.add(row)
            row.code, row.details, row.by, row.origin = code, details, by[:AUTHOR], origin
            row.status, row.count = "generated", row.count + 1 if count is None else count
            row.generated_at, row.generated_scan, row.recovered_at, row.recovered_scan = at, scan, None, None
            session.flush()
            return rows.history(row)

    def record_cleared(
        self, instance: int, error: str, *, program_version: int, at: datetime, scan: int
    ) -> HistoryRow | None:
        """An error was recovered; None if it was never raised on this version."""
        with self._writing() as session:
            the_instance(session, instance, lock=True)
            row = session.get(ErrorHistory, (instance, program_version, error))
            if row is None:
                return None
            row.status, row.recovered_at, row.recovered_scan = "cleared", at, scan
            session.flush()
            return rows.history(row)

    def set_reaction(
        self, instance: int, version: int, error: str, *, state: ReactionState | None, reaction: Json | None = None,
        message: str = "",
    ) -> HistoryRow | None:  # fmt: skip
        """What is known of the reaction to an error; None if it was never raised on this version."""
        with self._writing() as session:
            the_instance(session, instance, lock=True)
            row = session.get(ErrorHistory, (instance, version, error))
            if row is None:
                return None
            row.reaction_state, row.reaction_message = state, message
            row.reaction = None if reaction is None else dict(reaction)
            session.flush()
            return rows.history(row)
