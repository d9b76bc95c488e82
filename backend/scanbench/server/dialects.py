"""The dialect of a project: what its `language.json` says, and how it is changed."""

from scanbench.server.language_files import file_of
from scanbench.server.projects import Projects
from scanbench.syntax.language_file import LANGUAGE_FILE, DialectName, dialect_of, with_dialect


async def dialect_in(projects: Projects, id: int) -> DialectName:
    """The dialect that a project is checked in."""
    file = await file_of(projects, id)
    return dialect_of({} if file is None else {LANGUAGE_FILE: file.text})[0]


async def change_dialect(projects: Projects, id: int, dialect: DialectName, author: str) -> DialectName:
    """Writes the dialect into the file, over its newest version; where it is so already, nothing changes."""
    file = await file_of(projects, id)
    sources = {} if file is None else {LANGUAGE_FILE: file.text}
    if dialect_of(sources) != (dialect, []):
        version = 0 if file is None else file.version
        await projects.save(id, LANGUAGE_FILE, with_dialect(sources, dialect)[LANGUAGE_FILE], version, author)
    return dialect
