"""REST: projects, files, check, build."""

from fastapi import APIRouter, Request

from scanbench.public import iso
from scanbench.store.records import BuildInfo, NotFound
from scanbench.web import messages as wire
from scanbench.web import messages_projects, messages_versions, translate
from scanbench.web.auth import user_of
from scanbench.web.messages_base import Id, Version
from scanbench.web.reach import Bench

router = APIRouter(prefix="/api/projects", tags=["projects"])
_PLAIN_BUILD = wire.Build()


@router.get("")
async def on_projects(bench: Bench) -> list[wire.Project]:
    """Every project, by name."""
    return [translate.project(row) for row in await bench.projects.all()]


@router.post("", status_code=201)
async def on_new_project(bench: Bench, request: Request, new: messages_projects.NewProject) -> wire.Project:
    """A project on a model: empty, or with the files of a template, which are not built yet."""
    name = new.name.strip()
    if new.template:
        made = await bench.projects.from_template(name, new.model, new.template, user_of(request).name)
    else:
        made = await bench.projects.create(name, new.model, new.watch)
    return translate.project(made)


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
    return translate.check_result(await bench.projects.check(project, edited.files, edited.numbers))


@router.post("/{project}/build")
async def on_build(bench: Bench, request: Request, project: Id, how: wire.Build = _PLAIN_BUILD) -> wire.BuildResult:
    """Builds what is saved, and swaps it into the project's instances; asks first where variables would be reset."""
    author = user_of(request).name
    outcome = await bench.projects.build(project, author, how.agreed, how.instances, how.message)
    return translate.build_result(outcome)


@router.get("/{project}/unsaved")
async def on_unsaved(bench: Bench, project: Id) -> list[str]:
    """The files that somebody edited, and nobody has saved since."""
    await bench.projects.get(project)
    return await bench.projects.drafts.unsaved(project)


@router.get("/{project}/drafts")
async def on_drafts(bench: Bench, project: Id) -> list[messages_projects.UnsavedText]:
    """The texts that somebody edited, and nobody has saved since."""
    await bench.projects.get(project)
    texts = await bench.projects.drafts.unsaved_texts(project)
    return [messages_projects.UnsavedText(path=path, text=text) for path, text in texts.items()]


@router.get("/{project}/versions")
async def on_versions(bench: Bench, project: Id) -> list[messages_versions.ProjectVersion]:
    """Every build of a project that was accepted, the last one first."""
    return [_version(each) for each in await bench.projects.versions(project)]


@router.patch("/{project}/versions/{version}")
async def on_describe_version(
    bench: Bench, project: Id, version: Version, said: messages_versions.DescribeVersion
) -> messages_versions.ProjectVersion:
    """Gives a version a label or a message."""
    return _version(await bench.projects.describe(project, version, said.label, said.message))


@router.get("/{project}/versions/{version}")
async def on_version(bench: Bench, project: Id, version: Version) -> messages_versions.VersionText:
    """The files of a version."""
    sources = await bench.projects.built(project, version)
    if sources is None:
        raise NotFound(f"this project has no version {version}")
    return messages_versions.VersionText(version=version, files=sources.files)


def _version(build: BuildInfo) -> messages_versions.ProjectVersion:
    return messages_versions.ProjectVersion(
        version=build.version, author=build.author, at=iso(build.at), label=build.label, message=build.message
    )
