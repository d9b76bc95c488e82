"""Wire shapes of questions about the past: who wrote this, what changed, where two runs part, what if. See `history/contract.py`.

Bytes of values are hex, as in `messages_verify.py`.
"""

from typing import Literal

from pydantic import Field

from scanbench.web.messages_base import Id, Scan, Wire
from scanbench.web.messages_verify import Hex, VerifyPlace


class LastWriter(Wire):
    path: str
    by: Literal["program", "command", "plc", "start"]
    scan: int
    count: int = Field(description="of a statement: the position in front of it, for `travel`")
    place: VerifyPlace | None
    author: str
    text: str
    value: Hex
    shown: str


class VariableChange(Wire):
    path: str
    type: str
    kind: str
    size: int
    values: list[tuple[str, int]]
    before: Hex
    after: Hex
    before_shown: str
    after_shown: str


class BetweenEntry(Wire):
    scan: int
    run: Literal["", "A", "B"]
    author: str
    text: str


class RunChanges(Wire):
    first: int
    last: int
    changes: list[VariableChange]
    count: int
    entries: list[BetweenEntry]
    note: str


class NewComparison(Wire):
    other: Id = Field(description="instance B; that of the address is A")


class RunDivergence(Wire):
    compared: int
    first: int
    last: int
    scan: int | None
    cause: Literal["", "command", "program", "start"]
    text: str
    place: VerifyPlace | None
    changes: RunChanges | None
    entries: list[BetweenEntry]
    marks: list[tuple[int, int]]


class Comparison(Wire):
    """How far a comparison of two runs is, and what came of it. Kept until the server ends, the last 20 of an instance."""

    type: Literal["comparison"] = "comparison"
    id: int
    a: int = Field(description="instance")
    b: int
    by: str
    done: int
    of: int
    result: RunDivergence | None
    message: str = Field(description="why nothing came of it")


class NewRerun(Wire):
    """The run of this instance once more, with one error another; see `verify.findings.RerunChange`."""

    name: str = Field(min_length=1, max_length=100, description="of the new instance")
    scan: Scan = Field(description="in front of which the error was raised")
    error: str = Field(min_length=1, max_length=200)
    by: int = Field(default=0, ge=-1_000_000, le=1_000_000)
    instead: str = Field(default="", max_length=200)
    leave_out: bool = False
    behind: int = Field(default=0, ge=0, le=1_000_000)


class Rerun(Wire):
    """How far a replay with a change is, and the instance that came of it."""

    type: Literal["rerun"] = "rerun"
    id: int
    by: str
    name: str
    done: int
    of: int
    instance: int | None
    refused: list[str]
    message: str = Field(description="why nothing came of it")
