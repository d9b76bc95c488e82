"""What is shown of a halted program: frames, scopes, variables, all as text."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class FrameInfo:
    """One frame of the call stack."""

    index: int
    name: str
    """`Main.line.station (Station)`; of a FUNCTION its name."""
    pou: str
    instance: str
    task: str
    file: str
    line: int
    column: int
    end_line: int
    end_column: int


@dataclass(frozen=True, slots=True)
class ScopeInfo:
    """Variables of one section: VAR_INPUT, VAR_OUTPUT, VAR_IN_OUT, VAR, VAR_TEMP, VAR_EXTERNAL, RESULT, GLOBAL, ..."""

    name: str
    count: int


@dataclass(frozen=True, slots=True)
class VariableInfo:
    """One variable, element or result, as text."""

    name: str
    expression: str
    """What names it in the scope of its frame, for `Evaluate`, `SetExpression` and `WantVariables`."""
    value: str
    type: str
    path: str
    """Instance path or address, for watch and data breakpoints; empty for temporaries."""
    alias: str = ""
    """Of an in-out or reference: `-> Main.tank[3].level (D120)`."""
    address: str = ""
    children: int = 0
    indexed: bool = False
    """Its children are elements of an array."""
    writable: bool = True
