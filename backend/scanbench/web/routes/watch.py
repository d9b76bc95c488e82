"""REST: watch lists."""

from fastapi import APIRouter, Request
from fastapi.responses import JSONResponse

from scanbench.store.records import ListConflict, WatchContent, WatchEntry, WatchListRow
from scanbench.web import messages_watch as wire
from scanbench.web.auth import user_of
from scanbench.web.messages_base import Id
from scanbench.web.reach import Bench

router = APIRouter(prefix="/api", tags=["watch lists"])


@router.get("/projects/{project}/watch-lists")
async def on_watch_lists(bench: Bench, request: Request, project: Id) -> list[wire.WatchListInfo]:
    """The lists that the user sees: shared ones and the user's own, by name."""
    found = await bench.watch_lists.all(project, user_of(request).name)
    return [wire.WatchListInfo.model_validate(_head(row)) for row in found]


@router.post("/projects/{project}/watch-lists", status_code=201)
async def on_new_watch_list(bench: Bench, request: Request, project: Id, made: wire.NewWatchList) -> wire.WatchList:
    """A new list."""
    user = user_of(request).name
    return _shown(await bench.watch_lists.create(project, made.name, made.shared, _content(made), user))


@router.get("/watch-lists/{id}")
async def on_watch_list(bench: Bench, request: Request, id: Id) -> wire.WatchList:
    """One list."""
    return _shown(await bench.watch_lists.get(id, user_of(request).name))


@router.put("/watch-lists/{id}", responses={409: {"model": wire.WatchListConflict}})
async def on_save_watch_list(bench: Bench, request: Request, id: Id, save: wire.SaveWatchList) -> wire.WatchList:
    """Saves it whole, if nobody else saved since it was read."""
    user = user_of(request).name
    return _shown(await bench.watch_lists.save(id, save.name, save.shared, _content(save), save.version, user))


@router.delete("/watch-lists/{id}", status_code=204)
async def on_delete_watch_list(bench: Bench, request: Request, id: Id) -> None:
    """Deletes a list."""
    await bench.watch_lists.delete(id, user_of(request).name)


async def on_list_conflict(_request: Request, error: Exception) -> JSONResponse:
    """Somebody else saved this list first."""
    assert isinstance(error, ListConflict)
    return JSONResponse(wire.WatchListConflict(message=str(error), theirs=_shown(error.theirs)).model_dump(), 409)


def _head(row: WatchListRow) -> dict[str, object]:
    return {
        "id": row.id, "name": row.name, "shared": row.owner == "", "version": row.version, "author": row.by,
        "count": len(row.content.entries),
    }  # fmt: skip


def _shown(row: WatchListRow) -> wire.WatchList:
    entries = [{"path": each.path, "group": each.group, "format": each.format} for each in row.content.entries]
    return wire.WatchList.model_validate({**_head(row), "groups": list(row.content.groups), "entries": entries})


def _content(given: wire.NewWatchList) -> WatchContent:
    entries = (WatchEntry(each.path, each.group, each.format) for each in given.entries)
    return WatchContent(tuple(given.groups), tuple(entries))
