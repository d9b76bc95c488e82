"""REST: projects as one file."""

import asyncio
import re
from urllib.parse import quote

from fastapi import APIRouter, Request, Response

from scanbench.server.archive import LARGEST, unpack
from scanbench.server.samples import templates
from scanbench.syntax.plcopen.write import Form
from scanbench.web import messages as wire
from scanbench.web import translate
from scanbench.web.auth import user_of
from scanbench.web.messages_base import Id
from scanbench.web.messages_projects import ExchangeFile, ProjectArchive, ProjectTemplate
from scanbench.web.reach import Bench
from scanbench.wire.refused import Refused

router = APIRouter(prefix="/api", tags=["projects"])


@router.get("/projects/{project}/archive", response_class=Response)
async def on_pack(bench: Bench, project: Id) -> Response:
    """The project as a zip file: `project.json`, the files as they are saved, the project's own errors."""
    name, data = await bench.projects.pack(project)
    plain = re.sub(r"[^A-Za-z0-9._ -]", "_", name)
    headers = {"Content-Disposition": f"attachment; filename=\"{plain}.zip\"; filename*=UTF-8''{quote(name)}.zip"}
    return Response(data, media_type="application/zip", headers=headers)


@router.get("/projects/{project}/plcopen")
async def on_write(bench: Bench, project: Id, form: Form = Form.TC6) -> ExchangeFile:
    """The program of the project as it is saved, as a file for other tools, with what that form has no place for."""
    name, made = await bench.projects.written(project, form)
    return ExchangeFile(name=f"{name}.xml", text=made.data.decode("utf-8"), left_out=made.left_out)


@router.get("/templates")
async def on_templates() -> list[ProjectTemplate]:
    """What a new project can begin with: templates, and the samples."""
    return [
        ProjectTemplate(id=each.id, name=each.name, model=each.model, files=list(each.files)) for each in templates()
    ]


@router.post("/archives")
async def on_look(request: Request) -> ProjectArchive:
    """What a zip file has of a project, of Scanbench, TwinCAT or plain files, or a PLCopen or L5X file; keeps nothing. The body is the file."""
    found = await asyncio.to_thread(unpack, await _body(request))
    return ProjectArchive(
        name=found.name,
        model=found.model,
        files=[*found.files, *found.panels],
        left_out=list(found.left_out),
        notes=list(found.notes),
    )


@router.post("/archives/projects", status_code=201)
async def on_unpack(bench: Bench, request: Request, name: str, model: str) -> wire.Project:
    """A new project with the files of a zip file or a PLCopen or L5X file, which is the body. They are not built yet."""
    if not 0 < len(name.strip()) <= 100:
        raise Refused("the name of the project must have 1 to 100 characters")
    archive = await asyncio.to_thread(unpack, await _body(request))
    return translate.project(await bench.projects.from_archive(name.strip(), model, archive, user_of(request).name))


async def _body(request: Request) -> bytes:
    data = bytearray()
    async for chunk in request.stream():
        data += chunk
        if len(data) > LARGEST:
            raise Refused(f"the file is larger than {LARGEST >> 20} MiB")
    return bytes(data)
