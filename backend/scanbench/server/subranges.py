"""What becomes of values outside of subranges in a project: what its `language.json` says, and how that is changed."""

from collections.abc import Mapping, Sequence

from scanbench.server.language_files import file_of
from scanbench.server.projects import Projects
from scanbench.syntax.language_file import LANGUAGE_FILE, WHOLE_PROJECT, Language, language_of, with_subranges
from scanbench.wire.refused import Refused


async def subranges_in(projects: Projects, id: int) -> dict[str, str]:
    """By the name of a variable, a type or a POU, or `*`, as it is written there; nothing where the file is wrong."""
    file = await file_of(projects, id)
    return _words(language_of({} if file is None else {LANGUAGE_FILE: file.text})[0])


async def change_subranges(projects: Projects, id: int, policies: Mapping[str, str], author: str) -> dict[str, str]:
    """Writes all of them into the file, over its newest version; where it says so already, nothing changes. `Refused`."""
    file = await file_of(projects, id)
    sources = {} if file is None else {LANGUAGE_FILE: file.text}
    said, problems = language_of(sources)
    if problems:
        raise Refused(f"{LANGUAGE_FILE} cannot be read, so nothing was changed: {problems[0].message}")
    wanted = with_subranges(sources, policies)
    wrong = language_of(wanted)[1]
    if wrong:
        raise Refused(wrong[0].message)
    await _check_names(projects, id, wanted, [name for name in policies if name not in said.subranges])
    if _words(said) != dict(policies):
        await projects.save(id, LANGUAGE_FILE, wanted[LANGUAGE_FILE], 0 if file is None else file.version, author)
    return dict(policies)


def _words(said: Language) -> dict[str, str]:
    return {name: policy.word for name, policy in said.subranges.items()}


async def _check_names(projects: Projects, id: int, wanted: Mapping[str, str], fresh: Sequence[str]) -> None:
    """`Refused` where the project has nothing of a name that is said for the first time: a check of it would never come."""
    named = [f"`{name.upper()}`" for name in fresh if name != WHOLE_PROJECT]
    if not named:
        return
    for problem in (await projects.check(id, wanted)).problems:
        if problem.span.file == LANGUAGE_FILE and any(name in problem.message for name in named):
            raise Refused(problem.message)
