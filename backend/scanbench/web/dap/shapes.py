"""What DAP clients send: the arguments of the requests that are served, as far as they are used.

https://microsoft.github.io/debug-adapter-protocol/specification. What is not known is passed over, as DAP asks for; what
is known must be right. `scanbench` fields are ours: see docs/dap.md.
"""

from typing import Literal

from pydantic import BaseModel, ConfigDict, Field
from pydantic.alias_generators import to_camel

from scanbench.debug.breakpoint import BreakpointKind, DataAccess
from scanbench.wire.debugging import StepAction

Body = dict[str, object]
"""A JSON object."""
_LINES = 1 << 30


class Args(BaseModel):
    """Base of all arguments."""

    model_config = ConfigDict(extra="ignore", alias_generator=to_camel, populate_by_name=True, strict=True)


class Request(Args):
    """The envelope of a request."""

    seq: int
    type: Literal["request"]
    command: str
    arguments: Body = Field(default_factory=dict)


class Nothing(Args):
    """A request without arguments that matter."""


class Initialize(Args):
    client_id: str = Field(default="", alias="clientID")
    client_name: str = ""
    locale: str = ""
    lines_start_at1: bool = True
    columns_start_at1: bool = True
    path_format: Literal["path"] = "path"
    supports_invalidated_event: bool = False


class Launch(Args):
    """Our own arguments of `launch`."""

    program: str
    model: str | None = None
    interval: str | None = None
    stop_on_entry: bool = False
    pace: float = Field(default=1.0, ge=0, le=1000, description="0: as fast as possible")
    no_debug: bool = False
    cwd: str | None = None


class Attach(Args):
    """Our own arguments of `attach`; the address and what belongs to it are for `scanbench dap` on stdio alone."""

    address: str | None = None
    token: str | None = None
    instance: int | str | None = None
    user: str | None = None
    local_root: str | None = None


class Disconnect(Args):
    restart: bool = False
    terminate_debuggee: bool | None = None


class Cancel(Args):
    request_id: int | None = None


class Source(Args):
    path: str = ""
    name: str = ""
    source_reference: int = 0


class Extra(Args):
    """The `scanbench` field of a breakpoint: what DAP has no word for."""

    model_config = ConfigDict(extra="forbid")

    assign: str = ""
    log: str = ""
    instance: str = ""
    task: str = ""
    enabled: bool = True
    access: DataAccess | None = None


class _Conditional(Args):
    condition: str = ""
    hit_condition: str = ""
    scanbench: Extra = Field(default_factory=Extra)


class SourceBreakpoint(_Conditional):
    line: int = Field(ge=0, le=_LINES)
    column: int | None = Field(default=None, ge=0, le=_LINES)
    log_message: str = ""


class SetBreakpoints(Args):
    source: Source
    breakpoints: list[SourceBreakpoint] = Field(default_factory=list)
    lines: list[int] | None = None


class FunctionBreakpoint(_Conditional):
    name: str


class SetFunctionBreakpoints(Args):
    breakpoints: list[FunctionBreakpoint]


class DataBreakpointInfo(Args):
    name: str
    variables_reference: int = 0
    frame_id: int | None = None


class DataBreakpoint(_Conditional):
    data_id: str
    access_type: Literal["read", "write", "readWrite"] = "write"


class SetDataBreakpoints(Args):
    breakpoints: list[DataBreakpoint]


class FilterOptions(Args):
    filter_id: str
    condition: str = ""


class SetExceptionBreakpoints(Args):
    filters: list[str]
    filter_options: list[FilterOptions] = Field(default_factory=list)


class BreakpointLocations(Args):
    source: Source
    line: int = Field(ge=0, le=_LINES)
    end_line: int | None = Field(default=None, ge=0, le=_LINES)


class StackTrace(Args):
    thread_id: int
    start_frame: int = Field(default=0, ge=0)
    levels: int = Field(default=0, ge=0)


class Scopes(Args):
    frame_id: int


class Variables(Args):
    variables_reference: int
    filter: Literal["indexed", "named"] | None = None
    start: int = Field(default=0, ge=0)
    count: int = Field(default=0, ge=0)


class SetVariable(Args):
    variables_reference: int
    name: str
    value: str


class SetExpression(Args):
    expression: str
    value: str
    frame_id: int | None = None


class Effects(Args):
    """The `scanbench` field of `evaluate`."""

    effects: bool = False


class Evaluate(Args):
    expression: str
    frame_id: int | None = None
    context: str = ""
    scanbench: Effects = Field(default_factory=Effects)


class ExceptionInfo(Args):
    thread_id: int


class Completions(Args):
    text: str
    column: int
    line: int | None = None
    frame_id: int | None = None


class SourceText(Args):
    source: Source = Field(default_factory=Source)
    source_reference: int = 0


# ---- our own requests ----------------------------------------------------------------------------------------------


class OwnBreakpoint(Args):
    """A breakpoint of any kind, whole; without an id it is a new one."""

    model_config = ConfigDict(extra="forbid")

    id: int | None = None
    kind: BreakpointKind
    enabled: bool = True
    source: Source | None = None
    line: int = Field(default=0, ge=0, le=_LINES)
    column: int | None = Field(default=None, ge=0, le=_LINES)
    path: str = ""
    access: DataAccess = "change"
    error: str = ""
    scan: int = Field(default=0, ge=0, lt=1 << 63)
    condition: str = ""
    hits: str = ""
    log: str = ""
    assign: str = ""
    instance: str = ""
    task: str = ""


class SetBreakpoint(Args):
    breakpoint: OwnBreakpoint


class RemoveBreakpoints(Args):
    ids: list[int] | None = None


class EnableBreakpoints(Args):
    enabled: bool
    ids: list[int] | None = None


class RunTo(Args):
    source: Source
    line: int = Field(ge=0, le=_LINES)


class Path(Args):
    path: str


class Step(Args):
    action: StepAction


class Force(Args):
    path: str
    value: str


class Release(Args):
    path: str | None = None


class Raise(Args):
    error: str


class Coverage(Args):
    on: bool | None = None
    reset: bool = False
