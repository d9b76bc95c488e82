"""The `language.json` of a project."""

from scanbench.server.projects import Projects
from scanbench.store.records import FileRow, NotFound
from scanbench.syntax.language_file import LANGUAGE_FILE


async def file_of(projects: Projects, id: int) -> FileRow | None:
    """None where the project has none. `NotFound`: there is no such project."""
    await projects.get(id)
    try:
        return await projects.file(id, LANGUAGE_FILE)
    except NotFound:
        return None
