"""A PLCopen file as a project that can be taken in, with what is said of its POUs."""

from collections.abc import Iterator

from scanbench.syntax.plcopen.document import BadPlcOpen
from scanbench.syntax.plcopen.project import Project, Read, read_project
from scanbench.wire.refused import Refused


def read_plcopen(data: bytes) -> Project:
    """Its files, as text; `Refused` where it cannot be read, or has no POU."""
    try:
        made = read_project(data)
    except BadPlcOpen as bad:
        raise Refused(f"this PLCopen file cannot be read: {bad}") from bad
    if not made.files:
        raise Refused("this PLCopen file has no types and no POUs")
    return made


def notes(made: Project) -> Iterator[str]:
    """What is not as it was, by POU."""
    for each in made.pous:
        yield from (f"{each.pou}: {note}" for note in each.notes)


def summary(pous: list[Read]) -> tuple[int, int, int]:
    """How many POUs are as they were, nearly so, and without their body."""
    refused = sum(each.refused for each in pous)
    changed = sum(bool(each.notes) for each in pous) - refused
    return len(pous) - changed - refused, changed, refused
