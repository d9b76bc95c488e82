"""What the embedded checks of subranges found, on the wire."""

from typing import Literal

from pydantic import Field

from scanbench.web.messages_base import Wire


class Calling(Wire):
    """A call that leads to a violation."""

    pou: str
    instance: str = Field(description="path of the instance that calls; empty in a FUNCTION")
    method: str = Field(description="the method or action of the instance that calls; empty in its body")
    file: str
    line: int
    column: int


class Violation(Wire):
    """A place and instance at which a value left its subrange, by one path of calls."""

    file: str
    line: int
    column: int
    end_line: int
    end_column: int
    pou: str
    instance: str = Field(description="path of the instance that ran; empty in a FUNCTION")
    variable: str
    target: str = Field(description="the variable, where `variable` is that of an in-out or reference; else empty")
    value: str
    beyond: bool = Field(description="the value was farther outside than 65 bits can say")
    low: str
    high: str
    text: str
    times: int
    first_scan: int
    last_scan: int
    calls: list[Calling] = Field(description="that lead there, the outermost first; none in what a task runs")
    cut: bool = Field(
        description="there are more calls around these: 8 are kept, and of a POU that calls itself the innermost one"
    )


class Diagnostics(Wire):
    """The runtime diagnostics, whenever they change: the list is bounded, and says what did not fit."""

    type: Literal["diagnostics"] = "diagnostics"
    violations: list[Violation]
    dropped: int
    count: int
