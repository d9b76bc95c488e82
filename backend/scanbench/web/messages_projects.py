"""What goes over the wire about new projects: what they begin with, archives that they come from, and what a build does to PLCs."""

from typing import Annotated

from pydantic import Field

from scanbench.runtime.migrate_image import Lost
from scanbench.syntax.language_file import DialectName
from scanbench.syntax.pragmas import PolicyName
from scanbench.web.messages_base import Wire


class NewProject(Wire):
    name: str = Field(min_length=1, max_length=100)
    model: str = "GENERIC-IEC"
    watch: list[str] = Field(default_factory=list, max_length=1000, description="what a fresh watch list begins with")
    template: str = Field(default="", max_length=100, description="`id` of a template; empty: without files")


class ProjectTemplate(Wire):
    """What a new project can begin with."""

    id: str
    name: str
    model: str = Field(description="that its program is written for")
    files: list[str]


class ProjectArchive(Wire):
    name: str = Field(description="as its project file says; empty without one")
    model: str = Field(description="the same")
    files: list[str]
    left_out: list[str] = Field(description="no programs, or not compiled by their TwinCAT project")
    notes: list[str] = Field(description="of a PLCopen or L5X file: what could not be kept as it was, by POU")


class ExchangeFile(Wire):
    """The program of a project as a file for other tools."""

    name: str
    text: str = Field(description="XML")
    left_out: list[str] = Field(description="what the form has no place for, by POU, type or file")


class ProjectDialect(Wire):
    """What the programs of a project are written in; `iec` is the strict language."""

    dialect: DialectName


class ProjectSubranges(Wire):
    """What becomes of values outside of subranges where no pragma says it; what no entry is about is limited."""

    policies: dict[Annotated[str, Field(max_length=200)], PolicyName] = Field(
        max_length=1000,
        description="by the name of a variable (`Main.speed`), a type, a POU or a method, or `*` for all the others",
    )


class ProjectLibrary(Wire):
    """A library of a vendor, for the programs of a project."""

    name: str
    about: str = Field(description="what it is")
    source: str = Field(description="address of its documentation")
    declared: int = Field(description="types, functions and blocks")
    stubs: int = Field(description="of these, POUs that need a device")
    path: str = Field(description="of its text in a project")
    added: bool = Field(description="its text is a file of the project")
    used: bool = Field(description="programs name what it declares, and nothing in the project declares that")


class UnsavedText(Wire):
    """A file as people edit it together, which is not what was saved last."""

    path: str
    text: str


class OnlineChange(Wire):
    """What a swap of the program does to the variables of one running PLC."""

    instance: int
    name: str
    kept: int = Field(
        description="variables that keep their value, as programs and globals declare them: an instance counts once"
    )
    reinitialized: int = Field(description="what has a value now and begins again, also within a variable")
    new: int
    removed: int
    lost: tuple[Lost, ...] = Field(description="at most 500; `lost_count` says how many there are")
    lost_count: int
    refusal: str = Field(description="why this PLC cannot be changed now (mode RUN, say); empty when it can")
