"""The libraries of vendors in a project: which there are for its dialect, which it uses, and how one becomes a file of it."""

import asyncio
from collections.abc import Mapping
from dataclasses import dataclass

from scanbench.check.libraries.catalogue import Library, catalogue, library_named, used_libraries
from scanbench.reports.program_page import program_page
from scanbench.reports.program_report import program_report
from scanbench.server.projects import Projects
from scanbench.store.records import FileRow, NotFound
from scanbench.syntax.language_file import dialect_of


@dataclass(frozen=True, slots=True)
class Offered:
    """A library for the programs of a project."""

    library: Library
    added: bool
    """Its text is a file of the project."""
    used: bool
    """The programs name what it declares, and the project has no other text of that."""


async def offered(projects: Projects, id: int) -> list[Offered]:
    """The libraries of the project's dialect, and those of others that it has."""
    sources = await projects.sources(id)
    return await asyncio.to_thread(_offered, sources)


def _offered(sources: Mapping[str, str]) -> list[Offered]:
    dialect = dialect_of(sources)[0]
    used = {each.name for each in used_libraries(sources, dialect)}
    found = [Offered(each, each.path in sources, each.name in used) for each in catalogue()]
    return [each for each in found if each.added or dialect in each.library.dialects]


async def add_library(projects: Projects, id: int, name: str, author: str) -> FileRow:
    """Saves the text of a library as a file of the project; `Conflict` where it is there already."""
    library = library_named(name)
    if library is None:
        raise NotFound(f"there is no library {name}")
    await projects.get(id)
    return await projects.save(id, library.path, library.text, 0, author)


async def report_page(projects: Projects, id: int) -> str:
    """How much of what is saved of the project runs, as a page."""
    project, sources = await projects.get(id), await projects.sources(id)
    found = await projects.check(id, {})
    return await asyncio.to_thread(lambda: program_page(program_report(sources, found.problems), project.name))
