"""REST: the errors that a project defines itself."""

import asyncio
from collections.abc import Sequence
from dataclasses import asdict

from fastapi import APIRouter, Request, Response

from scanbench.plcmodel import drafts as plc
from scanbench.plcmodel.check_drafts import DraftProblem
from scanbench.server import user_errors
from scanbench.web import messages as shared
from scanbench.web import messages_user_errors as wire
from scanbench.web.auth import user_of
from scanbench.web.messages_base import Id, Version
from scanbench.web.reach import Bench, xml_body

router = APIRouter(prefix="/api/projects/{project}/user-errors", tags=["user errors"])


@router.get("")
async def on_user_errors(bench: Bench, project: Id) -> wire.UserErrors:
    """The project's own errors."""
    return await asyncio.to_thread(_shown, await user_errors.read(bench.projects, project))


@router.post("/check")
async def on_check_user_errors(bench: Bench, project: Id, draft: wire.UserErrorsDraft) -> wire.UserErrorsChecked:
    """What is wrong with errors that are being edited; stores nothing."""
    drafts = await asyncio.to_thread(_drafts, draft)
    found = await user_errors.check(bench.projects, project, drafts)
    return wire.UserErrorsChecked(problems=list(map(_problem, found)))


@router.put("", responses={409: {"model": shared.SaveConflict}})
async def on_save_user_errors(
    bench: Bench, request: Request, project: Id, save: wire.SaveUserErrors
) -> wire.UserErrors:
    """Writes them all to errors.xml, if nothing is wrong with them and nobody else saved since they were read."""
    author = user_of(request).name
    drafts = await asyncio.to_thread(_drafts, save)
    saved = await user_errors.save(bench.projects, project, drafts, save.version, author)
    return await asyncio.to_thread(_shown, saved)


@router.post("/import", responses={409: {"model": shared.SaveConflict}})
async def on_import_user_errors(
    bench: Bench, request: Request, project: Id, version: Version, how: wire.ImportHow = "replace"
) -> wire.UserErrors:
    """Takes the errors of a file, which is the body, in place of the project's own or in addition to them."""
    text, author = await xml_body(request), user_of(request).name
    saved = await user_errors.bring_in(bench.projects, project, text, version, how == "add", author)
    return await asyncio.to_thread(_shown, saved)


@router.get("/export", response_class=Response)
async def on_export_user_errors(bench: Bench, project: Id) -> Response:
    """The file errors.xml."""
    text = await user_errors.export(bench.projects, project)
    return Response(
        text, media_type="application/xml", headers={"Content-Disposition": 'attachment; filename="errors.xml"'}
    )


# ---- shapes: thousands of errors take a while, so in a thread ---------------------------------------------------------


def _shown(found: user_errors.UserErrors) -> wire.UserErrors:
    return wire.UserErrors.model_validate(
        {
            **asdict(found.drafts), "version": found.version, "readable": found.readable,
            "problems": list(map(_problem, found.problems)),
        }
    )  # fmt: skip


def _problem(found: DraftProblem) -> wire.UserProblem:
    span = found.problem.span
    return wire.UserProblem(
        path=found.path, code=found.problem.code, message=found.problem.message, line=span.line, column=span.column
    )


def _drafts(draft: wire.UserErrorsDraft) -> plc.Drafts:
    return plc.Drafts(
        errors=tuple(map(_error, draft.errors)),
        groups=tuple(plc.DraftGroup(tuple(each.path), _texts(each.texts)) for each in draft.groups),
    )


def _error(error: wire.UserError) -> plc.DraftError:
    return plc.DraftError(
        **error.model_dump(exclude={"group", "texts", "details", "also"}),
        group=tuple(error.group),
        texts=_texts(error.texts),
        details=tuple(map(_detail, error.details)),
        also=tuple(plc.DraftAlso(**each.model_dump()) for each in error.also),
    )


def _detail(detail: wire.UserDetail) -> plc.DraftDetail:
    return plc.DraftDetail(
        **detail.model_dump(exclude={"texts", "addresses"}),
        texts=_texts(detail.texts),
        addresses=tuple(
            plc.DraftAddress(**each.model_dump(exclude={"texts"}), texts=_texts(each.texts))
            for each in detail.addresses
        ),
    )


def _texts(texts: Sequence[wire.UserText]) -> plc.Texts:
    return tuple(plc.DraftText(each.language, each.name, each.description) for each in texts)
