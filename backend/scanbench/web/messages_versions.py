"""What goes over the wire about versions of a program and commits. See `messages.py`."""

from pydantic import Field

from scanbench.web.messages_base import Wire


class ProjectVersion(Wire):
    """A build of a project that was accepted."""

    version: int
    author: str
    at: str = Field(description="ISO 8601")
    label: str = Field(description="a short name, such as that of a release; empty when it has none")
    message: str = Field(description="what was changed and why")


class DescribeVersion(Wire):
    """What is null stays as it is; an empty text takes it away."""

    label: str | None = Field(default=None, max_length=100)
    message: str | None = Field(default=None, max_length=10_000)


class VersionText(Wire):
    version: int
    files: dict[str, str] = Field(description="path -> text")


class NewCommit(Wire):
    """Optimistic, like a save: `head` is the last commit that somebody saw."""

    message: str = Field(max_length=10_000)
    head: str = Field(default="", pattern=r"^[0-9a-f]{0,64}$", description="empty: there was none yet")
    agreed: bool = Field(default=False, description="also where another program committed in the folder")


class CommitText(Wire):
    commit: str
    files: dict[str, str] = Field(description="path -> text")
