"""REST: the libraries of vendors in a project, and the report of how much of it runs."""

from fastapi import APIRouter, Request
from fastapi.responses import Response

from scanbench.server.libraries import Offered, add_library, offered, report_page
from scanbench.web import messages as wire
from scanbench.web import translate
from scanbench.web.auth import user_of
from scanbench.web.messages_base import Id
from scanbench.web.messages_projects import ProjectLibrary
from scanbench.web.reach import Bench
from scanbench.web.routes.records import STYLE_ONLY

router = APIRouter(prefix="/api/projects", tags=["projects"])


@router.get("/{project}/libraries")
async def on_libraries(bench: Bench, project: Id) -> list[ProjectLibrary]:
    """The libraries for the dialect of a project, and whether it uses and has them."""
    return [_library(each) for each in await offered(bench.projects, project)]


@router.post("/{project}/libraries/{name}", status_code=201)
async def on_add_library(bench: Bench, request: Request, project: Id, name: str) -> wire.FileInfo:
    """Saves the text of a library as a file of the project."""
    return translate.file_info(await add_library(bench.projects, project, name, user_of(request).name))


@router.get("/{project}/report", response_class=Response)
async def on_report(bench: Bench, project: Id) -> Response:
    """How much of what is saved runs, what stops the rest, and which stubs it uses: a page."""
    page = await report_page(bench.projects, project)
    return Response(page, media_type="text/html; charset=utf-8", headers=STYLE_ONLY)


def _library(each: Offered) -> ProjectLibrary:
    library = each.library
    return ProjectLibrary(
        name=library.name,
        about=library.about,
        source=library.source,
        declared=len(library.declared),
        stubs=len(library.stubs),
        path=library.path,
        added=each.added,
        used=each.used,
    )
