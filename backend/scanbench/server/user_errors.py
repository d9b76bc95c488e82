"""The errors that a project defines itself, as a form: read from `errors.xml`, checked, written whole or not at all."""

import asyncio
from dataclasses import dataclass

from scanbench.plcmodel.check_drafts import DraftProblem, check_drafts
from scanbench.plcmodel.document import Document
from scanbench.plcmodel.drafts import DraftGroup, Drafts, read_drafts
from scanbench.plcmodel.model import Model
from scanbench.plcmodel.user_errors import USER_ERRORS, document_of, with_user_errors
from scanbench.plcmodel.write_catalogue import write_catalogue
from scanbench.problems import Problem
from scanbench.server.projects import Projects
from scanbench.store.records import NotFound
from scanbench.wire.refused import Refused


@dataclass(frozen=True, slots=True)
class UserErrors:
    """What `errors.xml` says. `readable` is false where a form cannot show it: the problems say why."""

    version: int
    """0: there is no such file yet."""
    drafts: Drafts
    problems: tuple[DraftProblem, ...] = ()
    readable: bool = True


async def read(projects: Projects, id: int) -> UserErrors:
    """The errors of a project."""
    model = await _model(projects, id)
    try:
        file = await projects.file(id, USER_ERRORS)
    except NotFound:
        return UserErrors(0, Drafts())
    return await asyncio.to_thread(_read, model, file.text, file.version)


async def check(projects: Projects, id: int, drafts: Drafts) -> list[DraftProblem]:
    """What is wrong with errors that are not saved yet."""
    model = await _model(projects, id)
    return (await asyncio.to_thread(check_drafts, model, drafts))[1]


async def save(projects: Projects, id: int, drafts: Drafts, version: int, author: str) -> UserErrors:
    """Writes them, if nothing is wrong with them and nobody else wrote since `version`."""
    model = await _model(projects, id)
    written, problems = await asyncio.to_thread(check_drafts, model, drafts)
    if problems:
        raise Refused(_refusal("nothing was saved", [each.problem for each in problems]))
    file = await projects.save(id, USER_ERRORS, written.text, version, author)
    return await asyncio.to_thread(_read, model, file.text, file.version)


async def bring_in(projects: Projects, id: int, text: str, version: int, add: bool, author: str) -> UserErrors:
    """Takes the errors of a file from elsewhere, in place of those that there are or in addition to them."""
    model = await _model(projects, id)
    before = await read(projects, id) if add else None
    written = await asyncio.to_thread(_imported, model, text, before)
    file = await projects.save(id, USER_ERRORS, written, version, author)
    return await asyncio.to_thread(_read, model, file.text, file.version)


async def export(projects: Projects, id: int) -> str:
    """The file; one without any error where there is none."""
    try:
        return (await projects.file(id, USER_ERRORS)).text
    except NotFound:
        return (await asyncio.to_thread(write_catalogue, Drafts())).text


async def _model(projects: Projects, id: int) -> Model:
    return projects.model((await projects.get(id)).model)


def _read(model: Model, text: str, version: int) -> UserErrors:
    document = document_of(text)
    if not isinstance(document, Document):
        return UserErrors(version, Drafts(), tuple(DraftProblem("", each) for each in document), readable=False)
    drafts = read_drafts(document)
    return UserErrors(version, drafts, tuple(check_drafts(model, drafts)[1]))


def _imported(model: Model, text: str, before: UserErrors | None) -> str:
    """What is to be written: the errors of a file, in addition to those that there were, if they are given."""
    drafts = _checked(model, text)
    if before is None:
        return write_catalogue(drafts).text
    if not before.readable:
        raise Refused(f"nothing was imported: {USER_ERRORS} has errors itself, so nothing can be added to it")
    written, problems = check_drafts(model, _together(before.drafts, drafts))
    if problems:
        raise Refused(_refusal("nothing was imported: together with yours", [each.problem for each in problems]))
    return written.text


def _checked(model: Model, text: str) -> Drafts:
    """The drafts of a file in which nothing is wrong."""
    problems = with_user_errors(model, text)[1]
    document = document_of(text)
    if problems or not isinstance(document, Document):
        raise Refused(_refusal("nothing was imported", problems))
    return read_drafts(document)


def _together(ours: Drafts, theirs: Drafts) -> Drafts:
    known = {group.path for group in ours.groups}
    more: tuple[DraftGroup, ...] = tuple(group for group in theirs.groups if group.path not in known)
    return Drafts((*ours.errors, *theirs.errors), (*ours.groups, *more))


def _refusal(what: str, problems: list[Problem]) -> str:
    first, more = problems[0], len(problems) - 1
    span = first.span
    others = f" (and {more} more)" if more else ""
    return f"{what}: line {span.line}, column {span.column}: {first.message}{others}"
