"""The part of the store that keeps drafts: files as people edit them together, before anybody saves."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby

from sqlalchemy import delete, insert, select
from sqlalchemy.exc import IntegrityError
from sqlalchemy.orm import Session

from scanbench.store.connected import Repository
from scanbench.store.records import NotFound
from scanbench.store.tables import Draft, DraftPart


@dataclass(frozen=True, slots=True)
class DraftRow:
    """A draft, and all that was ever changed in it: what that means is the affair of who wrote it."""

    key: str
    parts: tuple[bytes, ...]


class Drafts(Repository):
    """Drafts by the files that they are of; with its file a draft is deleted."""

    def get(self, project: int, path: str) -> DraftRow | None:
        """The draft of a file; None where nobody edited it yet."""
        with self._database.reading() as session:
            draft = session.get(Draft, (project, path))
            if draft is None:
                return None
            parts = select(DraftPart.data).where(DraftPart.project_id == project, DraftPart.path == path)
            return DraftRow(draft.key, tuple(session.scalars(parts.order_by(DraftPart.id))))

    def all(self, project: int) -> dict[str, DraftRow]:
        """The drafts of a project by the path of their file."""
        with self._database.reading() as session:
            found = select(Draft.path, Draft.key, DraftPart.data).outerjoin(
                DraftPart, (DraftPart.project_id == Draft.project_id) & (DraftPart.path == Draft.path)
            )
            rows = session.execute(found.where(Draft.project_id == project).order_by(Draft.path, DraftPart.id)).all()
        drafts: dict[str, DraftRow] = {}
        for path, group in groupby(rows, key=lambda row: row.path):
            parts = list(group)
            drafts[path] = DraftRow(parts[0].key, tuple(part.data for part in parts if part.data is not None))
        return drafts

    def create(self, project: int, path: str, key: str, part: bytes) -> DraftRow:
        """Begins a draft, or gives the one that there is meanwhile."""
        try:
            with self._database.writing() as session:
                session.execute(insert(Draft).values(project_id=project, path=path, key=key))
                session.execute(insert(DraftPart).values(project_id=project, path=path, data=part))
                return DraftRow(key, (part,))
        except IntegrityError:
            found = self.get(project, path)
            if found is None:
                raise _gone(path) from None
            return found

    def append(self, project: int, path: str, key: str, parts: Sequence[bytes]) -> None:
        """Adds changes; `NotFound` when the file was deleted, also when there is a new one of that name."""
        self._write(project, path, key, parts, begin_again=False)

    def replace(self, project: int, path: str, key: str, parts: Sequence[bytes]) -> None:
        """These in the place of all that there are."""
        self._write(project, path, key, parts, begin_again=True)

    def _write(self, project: int, path: str, key: str, parts: Sequence[bytes], begin_again: bool) -> None:
        try:
            with self._database.writing() as session:
                add_parts(session, project, path, key, parts, begin_again)
        except IntegrityError as error:
            raise _gone(path) from error


def add_parts(
    session: Session, project: int, path: str, key: str, parts: Sequence[bytes], begin_again: bool = False
) -> None:
    """Adds changes in a transaction that is under way."""
    found = session.get(Draft, (project, path), with_for_update=True)
    if found is None or found.key != key:
        raise _gone(path)
    if begin_again:
        session.execute(delete(DraftPart).where(DraftPart.project_id == project, DraftPart.path == path))
    session.execute(insert(DraftPart), [{"project_id": project, "path": path, "data": part} for part in parts])


def _gone(path: str) -> NotFound:
    return NotFound(f"there is no file {path!r} in this project any more")
