"""What a browser says on the WebSocket, in addition to the commands (`messages_commands.py`). `ref` is chosen by the sender and comes back
in `Done`, so that a refusal lands in the row that caused it.
"""

from typing import Annotated, Literal

from pydantic import Field

from scanbench.web.messages_base import Scan, Wire
from scanbench.web.messages_commands import Command
from scanbench.web.messages_debug import DapOut, SetCoverage
from scanbench.web.messages_together import CloseDraft, EditDraft, Here, OpenDraft


class Watch(Wire):
    type: Literal["watch"] = "watch"
    ref: int
    paths: list[str]


class Unwatch(Wire):
    type: Literal["unwatch"] = "unwatch"
    ids: list[int]


class Run(Wire):
    """`continue` with `scans`: so many, then pause; with `until`: up to the first scan after which the condition holds."""

    type: Literal["run"] = "run"
    ref: int
    action: Literal["continue", "pause", "scan", "speed"] = Field(description="speed: only that, a target stays")
    speed: float | None = Field(default=None, description="0.01 to 1000; 0 is as fast as possible")
    scans: Annotated[int, Field(ge=1, lt=1 << 53)] | None = None
    until: str | None = Field(default=None, description="a BOOL expression over instance paths and addresses")


class NewRun(Wire):
    """Begins at scan 0, with an empty timeline; the old run file is kept aside on the server."""

    type: Literal["new_run"] = "new_run"
    ref: int


class Travel(Wire):
    """Shows the PLC as it was before `scan`; null returns to live."""

    type: Literal["travel"] = "travel"
    ref: int
    scan: Scan | None
    count: Scan = Field(
        default=0, description="inside of the scan, before its statement of this count; 0: its beginning"
    )


class Press(Wire):
    """A push button: writes TRUE when it is pressed, FALSE when it is let go, and FALSE as well when this connection
    ends before, if the PLC takes it then."""

    type: Literal["press"] = "press"
    ref: int
    path: str
    down: bool


class RollBack(Wire):
    """Swaps the program back in that ran before the last change."""

    type: Literal["roll_back"] = "roll_back"
    ref: int


ClientMessage = Annotated[
    Watch
    | Unwatch
    | Command
    | Press
    | Run
    | NewRun
    | Travel
    | RollBack
    | SetCoverage
    | DapOut
    | OpenDraft
    | EditDraft
    | CloseDraft
    | Here,
    Field(discriminator="type"),
]
