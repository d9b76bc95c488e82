"""Wire shapes of the errors that a project defines itself: every attribute as it was typed, right or wrong. See `messages.py`."""

from typing import Annotated, Literal

from pydantic import Field

from scanbench.web.messages_base import Version, Wire

Typed = Annotated[str, Field(max_length=1000)]
Told = Annotated[str, Field(max_length=20_000)]
Path = Annotated[list[Typed], Field(max_length=64)]


class UserText(Wire):
    """Name and description in one language, English first; of a detail and an address only the description counts."""

    language: Annotated[str, Field(min_length=1, max_length=35)]
    name: Told = ""
    description: Told = ""


class UserAddress(Wire):
    """Where a detail writes; what is not given is empty."""

    id: Typed = ""
    address: Typed = ""
    type: Typed = "Bit"
    shift: Typed = ""
    width: Typed = ""
    value: Typed = ""
    min: Typed = ""
    max: Typed = ""
    default: Typed = ""
    base: Typed = ""
    adds: Typed = Field(default="", description="AddToErrorCode: true, false, or empty: as the error says")
    texts: list[UserText] = Field(default_factory=list, max_length=64)


class UserDetail(Wire):
    name: Typed = ""
    control: Typed = "List"
    default: Typed = ""
    identifies: Typed = Field(default="", description="several, one, or empty: its values are no errors of their own")
    hardware: Typed = Field(default="", description="what its number counts, of what a project can fit")
    absent: Typed = ""
    addresses: list[UserAddress] = Field(default_factory=list, max_length=1000)
    texts: list[UserText] = Field(default_factory=list, max_length=64)


class UserAlso(Wire):
    """What the error writes besides its flag."""

    address: Typed = ""
    type: Typed = "Bit"
    shift: Typed = ""
    width: Typed = ""
    value: Typed = ""
    detail: Typed = ""


class UserError(Wire):
    id: Typed = ""
    group: Path = Field(description="names of the groups it is in, the outermost first")
    code: Typed = ""
    flag: Typed = ""
    severity: Typed = "nonfatal"
    priority: Typed = ""
    cause: Typed = ""
    memory: Typed = ""
    source: Typed = ""
    verified: Typed = ""
    adds: Typed = ""
    hardware: Typed = ""
    texts: list[UserText] = Field(default_factory=list, max_length=64)
    details: list[UserDetail] = Field(default_factory=list, max_length=64)
    also: list[UserAlso] = Field(default_factory=list, max_length=64)


class UserGroup(Wire):
    """What a group is called in other languages than English."""

    path: Path
    texts: list[UserText] = Field(max_length=64)


class UserErrorsDraft(Wire):
    """All errors that a project defines itself, as they are being edited."""

    errors: list[UserError] = Field(max_length=5000)
    groups: list[UserGroup] = Field(default_factory=list, max_length=5000)


class SaveUserErrors(UserErrorsDraft):
    """`version` is that of errors.xml which the edit began from (0: there was none)."""

    version: Version


class UserProblem(Wire):
    path: str = Field(description="the field, such as errors.2.details.0.addresses.1.address; empty: the file")
    code: str
    message: str
    line: int = Field(description="in errors.xml")
    column: int


class UserErrorsChecked(Wire):
    problems: list[UserProblem]


class UserErrors(UserErrorsDraft):
    """The project's errors.xml as a form. Not `readable`: a form cannot show it, the problems say why."""

    version: int = Field(description="of errors.xml; 0: there is none yet")
    problems: list[UserProblem]
    readable: bool


ImportHow = Literal["replace", "add"]
