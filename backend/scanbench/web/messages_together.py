"""Wire shapes of what people do together in one file. See `messages.py`. A draft is a document of Yjs with one text, `text`: its updates and
state vectors (version 1 of their encoding) are in base64.
"""

from typing import Annotated, Literal

from pydantic import Base64Bytes, Field

from scanbench.web.messages_base import Wire

DraftPath = Annotated[str, Field(min_length=1, max_length=255)]
DraftKey = Annotated[str, Field(min_length=1, max_length=64)]

Vector = Annotated[Base64Bytes, Field(max_length=1 << 20)]
Update = Annotated[Base64Bytes, Field(max_length=4 << 20)]


class OpenDraft(Wire):
    """Begins to edit a file together with everybody who has it open: `Draft` is the answer, before `Done`."""

    type: Literal["open_draft"] = "open_draft"
    ref: int
    path: DraftPath
    draft: DraftKey | None = Field(
        default=None, description="the draft that is here already, as after a lost connection"
    )
    vector: Vector | None = Field(default=None, description="what is here of it")


class EditDraft(Wire):
    """Changes of a draft that is open; `Done` when they are kept. The same once more changes nothing."""

    type: Literal["edit_draft"] = "edit_draft"
    ref: int
    path: DraftPath
    draft: DraftKey
    update: Update


class CloseDraft(Wire):
    type: Literal["close_draft"] = "close_draft"
    ref: int
    path: DraftPath


Mark = Annotated[str, Field(max_length=200)]


class Here(Wire):
    """Where this browser's user is now: `file` and `line`, and in a draft their selection as relative positions of Yjs in base64. Not answered."""

    type: Literal["here"] = "here"
    file: DraftPath | None
    line: Annotated[int, Field(ge=1, lt=1 << 31)] | None = None
    anchor: Mark | None = None
    head: Mark | None = None


class Invitation(Wire):
    token: str = Field(description="as `token` in the query of the page's address")


class Draft(Wire):
    """The text of a file as it is edited now; `version` is that of the saved text."""

    type: Literal["draft"] = "draft"
    path: str
    draft: str = Field(description="a file that was deleted and made again has a different one")
    update: str = Field(description="what the browser has not yet")
    vector: str = Field(description="what the server has: the browser sends the rest")
    version: int
