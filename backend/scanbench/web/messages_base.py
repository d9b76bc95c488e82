"""The base of all wire shapes. See `messages.py`."""

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field


class Wire(BaseModel):
    """Base of all wire shapes: unknown fields are refused, so that a typing error never passes silently."""

    model_config = ConfigDict(extra="forbid")


Scan = Annotated[int, Field(ge=0, lt=1 << 63)]
"""Number of a scan, or of scans."""
