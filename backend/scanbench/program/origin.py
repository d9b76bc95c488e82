"""Who wrote the text where something is declared: the user's project, the standard library, or the maker of a model's text."""

from scanbench.problems import Span

LIBRARY_FOLDER = "<standard>/"
"""Where the spans of the library are; no project has a folder of that name."""
SYSTEM_FILE = f"{LIBRARY_FOLDER}system.st"
"""Where the spans of a model's text are."""


def in_library(span: Span) -> bool:
    """Whether this span is in the library or in a model's text, and not in a project."""
    return span.file.startswith(LIBRARY_FOLDER)


def is_system(span: Span) -> bool:
    """Whether this span is in text that is made from a model."""
    return span.file == SYSTEM_FILE
