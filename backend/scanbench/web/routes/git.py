"""REST: the working tree of a project under git."""

from fastapi import APIRouter, Request

from scanbench.server.repositories import Commit, Status
from scanbench.web import messages_versions
from scanbench.web.auth import user_of
from scanbench.web.messages_base import Id
from scanbench.web.reach import Bench

router = APIRouter(prefix="/api/projects/{project}/git", tags=["projects"])


@router.get("")
async def on_status(bench: Bench, project: Id) -> Status:
    """The working tree of a project, and what a commit would keep."""
    return await bench.repositories.status(project)


@router.post("", status_code=201)
async def on_begin(bench: Bench, project: Id) -> Status:
    """Makes a working tree for a project that has none; nothing is committed yet."""
    return await bench.repositories.begin(project)


@router.get("/commits")
async def on_commits(bench: Bench, project: Id, path: str | None = None) -> list[Commit]:
    """The last 500 commits, or those that changed the file of this path, the last one first."""
    return await bench.repositories.commits(project, path)


@router.post("/commits", status_code=201)
async def on_commit(bench: Bench, request: Request, project: Id, new: messages_versions.NewCommit) -> Commit:
    """Commits what is saved, if nobody else did since `head`; its author is the user."""
    return await bench.repositories.commit(project, new.message, new.head, user_of(request).name, new.agreed)


@router.get("/commits/{commit}")
async def on_commit_texts(bench: Bench, project: Id, commit: str) -> messages_versions.CommitText:
    """The files of the project as a commit has them."""
    return messages_versions.CommitText(commit=commit, files=await bench.repositories.texts(project, commit))
