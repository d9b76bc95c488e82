"""A PLCopen or L5X file as a project that can be taken in, with what is said of its POUs."""

from collections.abc import Iterator

from scanbench.syntax.imported import Project, Read
from scanbench.syntax.l5x.project import is_l5x
from scanbench.syntax.l5x.project import read_project as read_l5x
from scanbench.syntax.plcopen.document import is_plcopen
from scanbench.syntax.plcopen.project import read_project as read_plcopen
from scanbench.syntax.xml_tree import BadXml
from scanbench.wire.refused import Refused


def is_foreign(data: bytes) -> bool:
    """Whether a file is one that `read_foreign` reads."""
    return is_plcopen(data) or is_l5x(data)


def read_foreign(data: bytes) -> Project:
    """Its files, as text; `Refused` where it cannot be read, or has no POU."""
    what = "L5X" if is_l5x(data) else "PLCopen"
    try:
        made = read_l5x(data) if is_l5x(data) else read_plcopen(data)
    except BadXml as bad:
        raise Refused(f"this {what} file cannot be read: {bad}") from bad
    if not made.files:
        raise Refused(f"this {what} file has no types and no POUs")
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
