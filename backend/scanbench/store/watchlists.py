"""The part of the store that keeps watch lists: shared with everybody at a project, or somebody's own."""

from typing import cast

from sqlalchemy import delete, insert, select, update
from sqlalchemy.exc import IntegrityError

from scanbench.runtime.clock import wall_time
from scanbench.store import rows
from scanbench.store.connected import Repository, check, the_project
from scanbench.store.records import ListConflict, NameTaken, NotFound, WatchContent, WatchListRow
from scanbench.store.tables import AUTHOR, NAME, WatchList


class WatchLists(Repository):
    """Watch lists. Who may see which is for the caller to say."""

    def seen(self, project: int, user: str) -> list[WatchListRow]:
        """The lists of a project that somebody sees: shared ones and the user's own, by name."""
        with self._database.reading() as session:
            the_project(session, project)
            seen = (WatchList.project_id == project) & WatchList.owner.in_(("", user[:AUTHOR]))
            found = select(WatchList).where(seen).order_by(WatchList.name, WatchList.id)
            return [rows.watch_list(each) for each in session.scalars(found)]

    def get(self, id: int) -> WatchListRow:
        """One list."""
        with self._database.reading() as session:
            found = session.get(WatchList, id)
            if found is None:
                raise NotFound(f"there is no watch list {id}")
            return rows.watch_list(found)

    def create(self, project: int, name: str, owner: str, content: WatchContent, by: str) -> WatchListRow:
        """A new list; `owner` '' shares it."""
        check("the name", name, NAME)
        kept = _json(content)
        try:
            with self._database.writing() as session:
                the_project(session, project)
                values = {"owner": owner[:AUTHOR], "name": name, "content": kept, "by": by[:AUTHOR], "at": wall_time()}
                made = insert(WatchList).values(project_id=project, version=1, **values).returning(WatchList)
                return rows.watch_list(session.scalars(made).one())
        except IntegrityError as error:
            raise NameTaken(f"there is a watch list {name!r} already: choose another name") from error

    def save(self, id: int, name: str, owner: str, content: WatchContent, version: int, by: str) -> WatchListRow:
        """Saves what was edited from this `version`; `ListConflict` if that is not the last one."""
        check("the name", name, NAME)
        values = {
            "owner": owner[:AUTHOR],
            "name": name,
            "content": _json(content),
            "by": by[:AUTHOR],
            "at": wall_time(),
        }
        try:
            with self._database.writing() as session:
                # One statement looks and writes, so of two savers from the same version exactly one finds its row.
                last = (WatchList.id == id) & (WatchList.version == version)
                change = update(WatchList).where(last).values(version=version + 1, **values).returning(WatchList)
                saved = session.scalars(change).first()
                if saved is not None:
                    return rows.watch_list(saved)
        except IntegrityError as error:
            raise NameTaken(f"there is a watch list {name!r} already: choose another name") from error
        raise ListConflict(self.get(id))

    def delete(self, id: int) -> None:
        """Forgets a list."""
        with self._database.writing() as session:
            if session.scalars(delete(WatchList).where(WatchList.id == id).returning(WatchList.id)).first() is None:
                raise NotFound(f"there is no watch list {id}")


def _json(content: WatchContent) -> dict[str, object]:
    for text in (*content.groups, *(part for entry in content.entries for part in (entry.path, entry.group))):
        check("an entry", text)
    entries = [[entry.path, entry.group, entry.format] for entry in content.entries]
    return cast(dict[str, object], {"groups": list(content.groups), "entries": entries})
