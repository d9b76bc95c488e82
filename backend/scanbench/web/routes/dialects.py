"""REST: the dialect of a project, and what it does with values outside of subranges."""

from fastapi import APIRouter, Request

from scanbench.server.dialects import change_dialect, dialect_in
from scanbench.server.subranges import change_subranges, subranges_in
from scanbench.web.auth import user_of
from scanbench.web.messages_base import Id
from scanbench.web.messages_projects import ProjectDialect, ProjectSubranges
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


@router.get("/{project}/subranges")
async def on_subranges(bench: Bench, project: Id) -> ProjectSubranges:
    """What the project says of values outside of subranges."""
    return ProjectSubranges.model_validate({"policies": await subranges_in(bench.projects, project)})


@router.put("/{project}/subranges")
async def on_change_subranges(
    bench: Bench, request: Request, project: Id, wanted: ProjectSubranges
) -> ProjectSubranges:
    """Replaces all of it: writes the project's `language.json`."""
    made = await change_subranges(bench.projects, project, wanted.policies, user_of(request).name)
    return ProjectSubranges.model_validate({"policies": made})
