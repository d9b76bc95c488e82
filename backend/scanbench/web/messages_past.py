"""What is asked about the past by REST; what comes of it is in `history/contract.py` and `wire/events.py`."""

from pydantic import Field

from scanbench.web.messages_base import Id, Scan, Wire


class NewComparison(Wire):
    other: Id = Field(description="instance B; that of the address is A")


class NewRerun(Wire):
    """Repeats the run of this instance with one error changed; see `history.contract.RerunChange`."""

    name: str = Field(min_length=1, max_length=100, description="of the new instance")
    scan: Scan = Field(description="before which the error was raised")
    error: str = Field(min_length=1, max_length=200)
    by: int = Field(default=0, ge=-1_000_000, le=1_000_000)
    instead: str = Field(default="", max_length=200)
    leave_out: bool = False
    scans_after: int = Field(
        default=0, ge=0, le=1_000_000, description="so many scans the new run goes on after the end of the original"
    )
