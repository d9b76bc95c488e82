"""The debugger on the wire. Breakpoints, steps, stack, scopes and values speak DAP (the Debug Adapter Protocol of
https://microsoft.github.io/debug-adapter-protocol/), in an envelope here, plain on `/api/instances/{id}/dap`."""

from typing import Literal

from pydantic import Field, JsonValue

from scanbench.web.messages_base import Wire


class DapOut(Wire):
    """A DAP request of the browser; each connection is a debug session of its own, which is attached from the start."""

    type: Literal["dap"] = "dap"
    message: dict[str, JsonValue]


class Dap(Wire):
    """A DAP response or event for this browser."""

    type: Literal["dap"] = "dap"
    message: dict[str, JsonValue]


class HaltInfo(Wire):
    """The PLC is halted by the debugger; part of the instance's state, so that everybody sees it at once."""

    number: int = Field(description="each halt has a number of its own")
    reason: Literal[
        "breakpoint", "data breakpoint", "step", "pause", "entry", "goto", "error", "violation", "trap", "scan"
    ]
    text: str
    by: str
    file: str = Field(description="of the statement that is next; empty in the seam")
    line: int
    column: int
    end_line: int
    end_column: int
    pou: str
    instance: str
    task: str
    count: int = Field(description="statements of the scan that have begun, the next one included; 0 is the seam")
    past: bool


class BreakpointInfo(Wire):
    """A breakpoint of this instance, whoever manages it."""

    id: int
    kind: Literal["line", "data", "error", "violation", "trap", "scan"]
    author: str
    group: str = Field(description="empty: the list that all browsers share; else a session of a DAP client")
    enabled: bool
    file: str
    line: int = Field(description="as asked for")
    column: int = Field(description="as asked for; 0 is the first statement in the line")
    path: str
    access: Literal["read", "write", "change", "access"]
    error: str
    scan: int
    condition: str
    hits: str
    log: str
    assign: str
    instance: str
    task: str
    verified: bool
    message: str
    at_line: int = Field(description="where it really is; 0 for other kinds")
    at_column: int
    reached: int = Field(description="how often, since it was set")


class Breakpoints(Wire):
    """All breakpoints of the instance, whenever they or their counts change; also in `hello`."""

    type: Literal["breakpoints"] = "breakpoints"
    breakpoints: list[BreakpointInfo]


class ChangeCoverage(Wire):
    """Whether it is noted what is reached."""

    on: bool
    reset: bool = Field(default=False, description="what was reached is forgotten first")


class SetCoverage(ChangeCoverage):
    """The same on the WebSocket."""

    type: Literal["set_coverage"] = "set_coverage"
    ref: int
