"""REST: projects, files, check, build."""

from fastapi import APIRouter, Request

from scanbench.public import iso
from scanbench.store.records import NotFound
from scanbench.web import messages as wire
from scanbench.web import translate
from scanbench.web.auth import user_of
from scanbench.web.messages_base import Id
from scanbench.web.reach import Bench

router = APIRouter(prefix="/api/projects", tags=["projects"])
_PLAIN_BUILD = wire.Build()


@router.get("")
async def on_projects(bench: Bench) -> list[wire.Project]:
    """Every project, by name."""
    return [translate.project(row) for row in await bench.projects.all()]


@router.post("", status_code=201)
async def on_new_project(bench: Bench, new: wire.NewProject) -> wire.Project:
    """An empty project on a model."""
    return translate.project(await bench.projects.create(new.name.strip(), new.model, new.watch))


@router.delete("/{project}", status_code=204)
async def on_delete_project(bench: Bench, project: Id) -> None:
    """Deletes a project that no instance runs."""
    await bench.delete_project(project)


@router.get("/{project}/files")
async def on_files(bench: Bench, project: Id) -> list[wire.FileInfo]:
    """The files of a project."""
    return [translate.file_info(row) for row in await bench.projects.files(project)]


@router.get("/{project}/files/{path:path}")
async def on_file(bench: Bench, project: Id, path: str) -> wire.FileText:
    """One file with its text."""
    return translate.file_text(await bench.projects.file(project, path))


@router.put("/{project}/files/{path:path}", responses={409: {"model": wire.SaveConflict}})
async def on_save_file(bench: Bench, request: Request, project: Id, path: str, save: wire.SaveFile) -> wire.FileInfo:
    """Saves a file, if nobody else did since it was read."""
    author = user_of(request).name
    row = await bench.projects.save(project, path, save.text, save.version, author, save.draft)
    return translate.file_info(row)


@router.delete("/{project}/files/{path:path}", status_code=204)
async def on_delete_file(bench: Bench, request: Request, project: Id, path: str) -> None:
    """Deletes a file."""
    await bench.projects.delete_file(project, path, user_of(request).name)


@router.post("/{project}/check")
async def on_check(bench: Bench, project: Id, edited: wire.CheckRequest) -> wire.CheckResult:
    """Checks the project with texts that are not saved yet; stores nothing."""
    return translate.check_result(await bench.projects.check(project, edited.files))


@router.post("/{project}/build")
async def on_build(bench: Bench, request: Request, project: Id, how: wire.Build = _PLAIN_BUILD) -> wire.BuildResult:
    """Builds what is saved, and swaps it into the project's instances; asks first where variables would be reset."""
    return translate.build_result(await bench.projects.build(project, user_of(request).name, how.agreed, how.instances))


@router.get("/{project}/versions")
async def on_versions(bench: Bench, project: Id) -> list[wire.ProjectVersion]:
    """Every build of a project that was accepted, the last one first."""
    found = await bench.projects.versions(project)
    return [wire.ProjectVersion(version=each.version, author=each.author, at=iso(each.at)) for each in found]


@router.get("/{project}/versions/{version}")
async def on_version(bench: Bench, project: Id, version: int) -> wire.VersionText:
    """The files of a version."""
    sources = await bench.projects.built(project, version)
    if sources is None:
        raise NotFound(f"this project has no version {version}")
    return wire.VersionText(version=version, files=sources.files)
