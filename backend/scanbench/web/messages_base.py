"""The base of all wire shapes. See `messages.py`."""

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field


class Wire(BaseModel):
    """Base of all wire shapes: unknown fields are refused, so that a typing error never passes silently."""

    model_config = ConfigDict(extra="forbid")


Scan = Annotated[int, Field(ge=0, lt=1 << 63)]
"""Number of a scan, or of scans."""
Id = Annotated[int, Field(ge=1, lt=1 << 31)]
"""Number of a project, instance, state, sweep, record or armed fault: what both databases can look up."""
Version = Annotated[int, Field(ge=0, lt=1 << 31)]
"""Number of a file's or a program's version; 0: there is none yet."""
