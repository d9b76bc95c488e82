"""A file of another tool as the files of a project, and what became of each POU."""

from dataclasses import dataclass, field


@dataclass(slots=True)
class Read:
    """What became of one POU."""

    pou: str
    line: int
    language: str
    notes: list[str] = field(default_factory=list)
    """What is not as it was; empty: all of it is."""
    refused: bool = False


@dataclass(slots=True)
class Project:
    """The files that were made, by path, and what became of each POU."""

    name: str
    files: dict[str, str] = field(default_factory=dict)
    pous: list[Read] = field(default_factory=list)
