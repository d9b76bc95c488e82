"""Wire shapes of verification. Bytes of values are hex, as they lie in the image: `5802` is INT 600; null: there is none.

What it means is said in `verify/contract.py`; rows, columns and cells have the same names there.
"""

from typing import Annotated, Literal

from pydantic import Field, StringConstraints

from scanbench.verify.contract import Mismatch, VerifyCoverage
from scanbench.verify.trace.propose import Guess
from scanbench.verify.trace.table import TraceProblem
from scanbench.verify.verdict import Verdict
from scanbench.web.messages_base import Scan, Wire

VerifyState = Literal["starting", "verifying", "waiting", "stopped", "done", "failed"]
"""verifying: scans are compared. waiting: for the user (paces scan and step), or for the PLC's next scan. stopped: by
somebody. done: all the scans that were asked for. failed: `message` says why."""
VerifyPace = Literal["free", "scan", "step"]
VerifyMemory = Literal["recorded", "set"]
Stripped = Annotated[str, StringConstraints(strip_whitespace=True)]
Limit = Annotated[int, Field(ge=1, le=1_000_000)]
Text = Annotated[str, Field(max_length=200)]


class VerifyRange(Wire):
    """A stretch of one POU; all empty: the whole scan."""

    pou: Text = Field(
        default="", description="name of a POU, or FB.method; empty: the one that has the lines of `file`"
    )
    file: Text = ""
    first: int = Field(default=0, ge=0, le=10_000_000, description="line, from 1; 0: from the POU's first statement")
    last: int = Field(default=0, ge=0, le=10_000_000, description="included; 0: to its last statement")
    instance: Text = Field(default="", description="the only instance that counts; empty: all")


class NewVerification(Wire):
    range: VerifyRange = VerifyRange()
    pace: VerifyPace = "free"
    first: Scan | None = Field(default=None, description="a past stretch; null: live, from the scan that is next")
    last: Scan | None = Field(default=None, description="included; null with `first`: to the scan that was over last")
    limit: Limit = Field(default=4096, description="uses of variables that are recorded of a scan")


class NewTraceVerification(Wire):
    """A controller log as the control device; the file is uploaded before, see `UploadedTrace`."""

    file: str = Field(min_length=1, max_length=80, description="as `UploadedTrace.file`")
    mapping: "TraceMapping"
    range: VerifyRange = VerifyRange()
    limit: Limit = 4096


class VerificationInfo(Wire):
    """The state of a verification. Everybody at the PLC sees the same."""

    id: int
    by: str
    title: str
    range: VerifyRange
    source: Literal["live", "past", "trace"]
    trace: str = Field(description="name of the trace's file")
    pace: VerifyPace
    auto: bool = Field(description="paces scan and step: goes on by itself")
    memory: VerifyMemory
    state: VerifyState
    message: str
    instances: list[str]
    limit: int
    first: int = Field(description="the first scan that is, or was, to be verified")
    last: int | None = Field(description="the last one; null: as long as it runs")
    scan: int | None = Field(description="verified last")
    compared: int = Field(description="scans of which anything was compared")
    skipped: int = Field(
        description="scans of which nothing was: left out, not in the trace, or the program did not run"
    )
    stretches: list[tuple[int, int]] = Field(description="those scans, the last 100 stretches, both ends included")
    differing: int = Field(description="rows that differ")
    first_difference: Mismatch | None
    first_scan: int | None = Field(description="scan of the first difference")
    rows: int
    forgotten: int = Field(description="rows at the front that found no room any more")
    used: int = Field(description="the most uses of a row")
    coverage: VerifyCoverage | None = Field(description="of a trace: what was compared so far, and what was not")
    not_run: int = Field(
        default=0, description="scans of `compared` in which the range did not run: there was nothing of it to compare"
    )
    not_reached: int = Field(default=0, description="scans of the past that were wanted and did not run until now")
    verdict: Verdict = Field(
        description="until now; `same` only where all that was asked was compared, of a log all that it has (see `coverage`)"
    )
    generation: int = Field(description="raised when rows that were already sent have changed")


class Verifications(Wire):
    """All verifications of the instance, whenever one changes, and a few times a second while one goes on."""

    type: Literal["verifications"] = "verifications"
    verifications: list[VerificationInfo]


class DriveVerification(Wire):
    """What is null stays as it is. `go_on`: one scan or statement further (paces scan and step)."""

    pace: VerifyPace | None = None
    auto: bool | None = None
    memory: VerifyMemory | None = None
    action: Literal["go_on", "stop", "resume"] | None = None


class SetCell(Wire):
    """An input of the set data, edited."""

    scan: Scan
    call: int = Field(ge=0, le=1_000_000)
    column: str = Field(min_length=1, max_length=500)
    value: str = Field(max_length=500, description="as typed in the watch table; empty takes the edit back")


class SetCells(Wire):
    cells: list[SetCell] = Field(min_length=1, max_length=10_000)


class KeepVerification(Wire):
    name: str = Field(min_length=1, max_length=100)


class VerificationRecord(Wire):
    """A verification that was kept in the project."""

    id: int
    project: int
    name: str
    instance: str
    by: str
    at: str
    program_version: int
    info: VerificationInfo


# ---- disturbances ----------------------------------------------------------------------------------------------------


class NewDisturbance(Wire):
    """flip: one bit of memory. late: an input refresh comes so many scans late (1: it is lost). stuck: an input stays as it is.
    result: what a statement writes has bits turned over."""

    kind: Literal["flip", "late", "stuck", "result"]
    path: Stripped = Field(
        default="", max_length=500, description="variable or address; empty with late, stuck: all inputs"
    )
    bit: int | None = Field(default=None, ge=0, le=1023, description="flip, result: which bit; null: any, by the seed")
    site: Stripped = Field(default="", max_length=300, description="result: `Main.st:34`")
    scan: Scan | None = Field(default=None, description="in which scan; null with probability 0: the next one")
    probability: float = Field(default=0, ge=0, le=1, description="of each scan, from `scan` on; 0: once")
    seed: int = Field(default=0, ge=0, lt=1 << 63)
    scans: int = Field(
        default=1, ge=1, le=1_000_000, description="late, stuck: how long; stuck with 1,000,000: until taken back"
    )
    times: int = Field(default=0, ge=0, le=1_000_000, description="with a probability: at most so often; 0: for ever")


# ---- controller logs -------------------------------------------------------------------------------------------------

Role = Literal["input", "output", "ignore"]


class TraceColumnMap(Wire):
    """What a column of a trace file means: a variable, and how near to it an output has to be."""

    column: str = Field(max_length=500, description="as the file names it")
    path: str = Field(default="", max_length=500, description="variable or address of the project")
    role: Role
    absolute: float = Field(default=0, ge=0, le=1e300, description="by so much the number of an output may differ")
    relative: float = Field(default=0, ge=0, le=1, description="the same as a part of what was recorded")
    late_ms: float = Field(default=0, ge=0, le=10_000, description="so much earlier or later it may come")


class TraceMapping(Wire):
    """How a trace file is meant; see docs/trace-format.md."""

    axis: str = Field(default="", max_length=500, description="column with scan or time; empty: a row is a scan")
    unit: Literal["scan", "ns", "us", "ms", "s"] = "scan"
    gaps: Literal["refuse", "skip", "hold"] = Field(
        default="refuse",
        description="scans that are missing: refuse the file, compare nothing there and begin again, or hold the values",
    )
    columns: list[TraceColumnMap] = Field(max_length=1000)
    sampled: Literal["end", "begin"] = Field(
        default="end",
        description="samples were taken at the end of a scan, or at its beginning: outputs are those of the scan before",
    )


class NewController(Wire):
    """A controller that runs elsewhere, to be read as the control device. Nothing is written to it."""

    address: str = Field(
        min_length=1,
        max_length=500,
        description="opc.tcp://HOST:PORT of an OPC UA server, fins://HOST:PORT (UDP) or fins+tcp://HOST:PORT",
    )
    interval_ms: int = Field(default=100, ge=10, le=60_000, description="from one sample to the next")
    nodes: list[Annotated[str, Field(min_length=1, max_length=500)]] = Field(
        default=[], max_length=999,
        description="ids of OPC UA nodes, none: all that the server shows; by FINS addresses as level=D100:INT, none: all variables of the program at addresses",
    )  # fmt: skip
    user: str = Field(default="", max_length=200, description="OPC UA; empty: nobody in particular")
    password: str = Field(default="", max_length=200)


class UploadedTrace(Wire):
    """A trace file that the server has read, or the first sample of a controller; nothing is kept of one that has problems."""

    file: str = Field(description="handle for NewTraceVerification, good for an hour")
    name: str
    columns: list[str]
    rows: int
    sample: list[list[str]] = Field(description="the first rows, as text")
    mapping: TraceMapping = Field(description="a proposal: a saved mapping that fits, else by names")
    problems: list[TraceProblem]
    guesses: list[Guess] = Field(description="how sure the proposal is of each column; none with a saved mapping")
    layout: str = Field(description="whose layout the file has; empty: ours")
    left_out: list[str] = Field(description="what the file has besides its columns, and is no variable")


class CheckTraceMapping(Wire):
    file: str = Field(min_length=1, max_length=80)
    mapping: TraceMapping


class SavedMapping(Wire):
    id: int
    name: str
    by: str
    mapping: TraceMapping


class SaveMapping(Wire):
    name: str = Field(min_length=1, max_length=100)
    mapping: TraceMapping


NewTraceVerification.model_rebuild()
