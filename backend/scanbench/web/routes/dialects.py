"""REST: the dialect of a project."""

from fastapi import APIRouter, Request

from scanbench.server.dialects import change_dialect, dialect_in
from scanbench.web.auth import user_of
from scanbench.web.messages_base import Id
from scanbench.web.messages_projects import ProjectDialect
from scanbench.web.reach import Bench

router = APIRouter(prefix="/api/projects", tags=["projects"])


@router.get("/{project}/dialect")
async def on_dialect(bench: Bench, project: Id) -> ProjectDialect:
    """The dialect that the programs of a project are written in."""
    return ProjectDialect(dialect=await dialect_in(bench.projects, project))


@router.put("/{project}/dialect")
async def on_change_dialect(bench: Bench, request: Request, project: Id, wanted: ProjectDialect) -> ProjectDialect:
    """Changes the dialect: writes the project's `language.json`."""
    author = user_of(request).name
    return ProjectDialect(dialect=await change_dialect(bench.projects, project, wanted.dialect, author))
