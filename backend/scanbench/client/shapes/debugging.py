"""Answers of the REST API: breakpoints. Made by `python -m tests.client_shapes`; do not edit."""

from typing import Literal, TypedDict


class BreakpointInfo(TypedDict):
    """A breakpoint of this instance, whoever manages it."""

    id: int
    kind: Literal["line", "data", "error", "violation", "trap", "scan"]
    author: str
    group: str
    """empty: the list that all browsers share; else a session of a DAP client."""
    enabled: bool
    file: str
    line: int
    """as asked for."""
    column: int
    """as asked for; 0 is the first statement in the line."""
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
    at_line: int
    """where it really is; 0 for other kinds."""
    at_column: int
    reached: int
    """how often, since it was set."""
