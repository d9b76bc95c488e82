"""The FastAPI application: routes, errors as `Refusal`, the page, and the guard around all of it."""

from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from dataclasses import dataclass
from pathlib import Path

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import HTMLResponse, JSONResponse
from starlette.exceptions import HTTPException
from starlette.types import ASGIApp

from scanbench import __version__
from scanbench.runtime.resource import is_no_space
from scanbench.server.workbench import Workbench
from scanbench.store.records import Conflict, ListConflict, NameTaken, NotFound, NotStorable, StoreError
from scanbench.web import messages as wire
from scanbench.web import translate
from scanbench.web.auth import Gate, Guard
from scanbench.web.built_files import BuiltFiles
from scanbench.web.compressed import compressed
from scanbench.web.headers import NoStore
from scanbench.web.invalid import said
from scanbench.web.operations import Api, operation_id
from scanbench.web.pages import frontend_directory, not_built_page
from scanbench.web.routes import archives as routes_archives
from scanbench.web.routes import binding as routes_binding
from scanbench.web.routes import campaigns as routes_campaigns
from scanbench.web.routes import communication as routes_communication
from scanbench.web.routes import debug as routes_debug
from scanbench.web.routes import dialects as routes_dialects
from scanbench.web.routes import errors as routes_errors
from scanbench.web.routes import flow as routes_flow
from scanbench.web.routes import git as routes_git
from scanbench.web.routes import instances as routes_instances
from scanbench.web.routes import invitations as routes_invitations
from scanbench.web.routes import libraries as routes_libraries
from scanbench.web.routes import memory as routes_memory
from scanbench.web.routes import models as routes_models
from scanbench.web.routes import past as routes_past
from scanbench.web.routes import projects as routes_projects
from scanbench.web.routes import records as routes_records
from scanbench.web.routes import sweeps as routes_sweeps
from scanbench.web.routes import traces as routes_traces
from scanbench.web.routes import user_errors as routes_user_errors
from scanbench.web.routes import values as routes_values
from scanbench.web.routes import verify as routes_verify
from scanbench.web.routes import watch as routes_watch
from scanbench.web.socket import dap as routes_dap
from scanbench.web.socket import lsp as routes_lsp
from scanbench.web.spoken import Spoken
from scanbench.wire.refused import Refused, Unavailable

_STATUS: dict[type[Exception], int] = {
    NotFound: 404, NameTaken: 409, NotStorable: 422, Refused: 422, Unavailable: 503, StoreError: 503,
}  # fmt: skip

_ABOUT = "Projects, virtual PLCs and what can be done with them. Refused: 4xx with a `Refusal`, whose `near` names what was perhaps meant."


@dataclass(frozen=True, slots=True)
class Config:
    """What a server needs to know."""

    bench: Workbench
    gate: Gate
    no_start: Callable[[StoreError | OSError], None]
    """The PLCs could not be started, as on a full disk: to end the server, and to say so."""


def create_app(config: Config) -> ASGIApp:
    """The application; its lifespan starts and ends the PLCs."""

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        app.state.bench = config.bench
        app.state.token = config.gate.token
        app.state.public_url = "" if config.gate.public is None else config.gate.public.origin
        try:
            try:
                await config.bench.start()
            except (StoreError, OSError) as error:
                config.no_start(error)
            yield
        finally:
            await config.bench.close()

    app = bare_app()
    app.router.lifespan_context = lifespan
    app.add_middleware(Guard, gate=config.gate)
    return NoStore(compressed(Spoken(app)))  # Starlette answers to a bug outside of what is added to it


def bare_app() -> FastAPI:
    """An app with the routes only, without a workbench: enough to describe the API."""
    app = Api(
        title="Scanbench", description=_ABOUT, license_info={"name": "Apache-2.0", "identifier": "Apache-2.0"},
        generate_unique_id_function=operation_id, version=__version__, docs_url=None, redoc_url=None, openapi_url="/api/openapi.json",
        responses={"4XX": {"model": wire.Refusal}},
    )  # fmt: skip
    for routes in (
        routes_instances, routes_dap, routes_lsp, routes_errors, routes_sweeps, routes_records, routes_projects, routes_archives, routes_git, routes_user_errors,
        routes_models, routes_invitations, routes_memory, routes_communication, routes_binding, routes_flow, routes_debug, routes_dialects, routes_libraries, routes_traces, routes_values, routes_watch, routes_verify,
        routes_past,
        routes_campaigns,
    ):  # fmt: skip
        app.include_router(routes.router)
    for error, status in _STATUS.items():
        app.add_exception_handler(error, _refusing(status))
    app.add_exception_handler(Conflict, _on_conflict)
    app.add_exception_handler(ListConflict, routes_watch.on_list_conflict)
    app.add_exception_handler(RequestValidationError, _on_invalid)
    app.add_exception_handler(HTTPException, _on_http)
    app.add_exception_handler(OSError, _on_os_error)
    _serve_page(app, frontend_directory())
    return app


def _refusing(status: int):  # type: ignore[no-untyped-def]  # the handler's type is Starlette's own affair
    async def on_error(_request: Request, error: Exception) -> JSONResponse:
        near = list(error.near) if isinstance(error, Refused) else []
        return JSONResponse(wire.Refusal(message=str(error), near=near).model_dump(), status)

    return on_error


async def _on_conflict(_request: Request, error: Exception) -> JSONResponse:
    """Somebody else saved first; a file that was deleted meanwhile comes as version 0, to be made again."""
    assert isinstance(error, Conflict)
    theirs = error.theirs
    if theirs is None:
        text = wire.FileText(path=error.path, version=0, author="", text="")
    else:
        text = translate.file_text(theirs)
    return JSONResponse(wire.SaveConflict(message=str(error), theirs=text).model_dump(), 409)


async def _on_invalid(_request: Request, error: Exception) -> JSONResponse:
    assert isinstance(error, RequestValidationError)
    lines = [said(one, ".".join(map(str, one["loc"][1:]))) for one in error.errors()]
    return JSONResponse(wire.Refusal(message="; ".join(lines)).model_dump(), 422)


async def _on_http(_request: Request, error: Exception) -> JSONResponse:
    assert isinstance(error, HTTPException)
    return JSONResponse(wire.Refusal(message=str(error.detail)).model_dump(), error.status_code)


async def _on_os_error(_request: Request, error: Exception) -> JSONResponse:
    """A file that finds no room, of a trace or an upload, say: no fault of ours."""
    if not isinstance(error, OSError) or not is_no_space(error):
        raise error
    return JSONResponse(wire.Refusal(message="no space: the disk is full. Make room, then try again").model_dump(), 507)


def _serve_page(app: FastAPI, directory: Path) -> None:
    """The built frontend, whether it is there at the start or comes later."""

    @app.get("/i/{rest:path}", include_in_schema=False)
    @app.get("/", include_in_schema=False)
    async def on_page() -> HTMLResponse:
        index = directory / "index.html"
        if not index.is_file():
            return HTMLResponse(not_built_page(directory), 503)
        return HTMLResponse(index.read_text("utf-8"), headers={"Cache-Control": "no-cache"})

    app.mount("/", BuiltFiles(directory=directory, check_dir=False), name="frontend")
