"""Answers of the REST API: verifications. Made by `python -m tests.client_shapes`; do not edit."""

from typing import Literal, NotRequired, TypedDict

from scanbench.client.shapes.past import VerifyPlace


class VerifyRange(TypedDict):
    """A stretch of one POU; all empty: the whole scan."""

    pou: NotRequired[str]
    """name of a POU, or FB.method; empty: the one that has the lines of `file`"""
    file: NotRequired[str]
    first: NotRequired[int]
    """line, from 1; 0: from the POU's first statement."""
    last: NotRequired[int]
    """included; 0: to its last statement."""
    instance: NotRequired[str]
    """the only instance that counts; empty: all."""


class VerifyDifference(TypedDict):
    """The first place where control and monitor part, or a byte that nobody should have changed."""

    cause: Literal["logic", "input", "order", "trap", "outside", "recorded"]
    name: str
    """The column, or the path or address of the variable."""
    control: str
    """A, `was` for people; empty where it did nothing."""
    monitor: str
    """A'."""
    place: VerifyPlace | None
    message: str
    """One sentence: `Main.belt[3].speed is 536, the reference gives 600, at FB_Belt.st:34 in scan 128388`."""
    type: str
    kind: str
    size: int


class VerifyCompared(TypedDict):
    """What came of one output of a trace."""

    column: str
    path: str
    compared: int
    """Values."""
    differing: int
    allowed: int
    """That agree only within the tolerance that somebody chose."""
    left_open: int
    """That agree only because rounded numbers do not tell."""
    missing: int
    """Scans that were compared, and of which the trace has no value of it."""
    largest: float
    """By how much a number was off at most, of those that are not the same; of a TIME in ns."""


class VerifyCoverage(TypedDict):
    """What of a trace was compared so far, and what was not."""

    outputs: list[VerifyCompared]
    inputs: list[str]
    """Variables that the trace gave to the monitor: they cannot differ."""
    ignored: list[str]
    """Columns of the file that are mapped to nothing."""
    unrecorded: list[str]
    """What the range wrote and the file has no column of: of these nothing was compared."""
    remembered: list[str]
    """What the program remembers and the file has no column of: the monitor began with the values of a cold start."""
    more: int
    """Variables of `unrecorded`, `remembered` and `ungiven` that are not named."""
    assumed: list[str]
    """Remembered variables of which the first rows told what they were: `Main.belt.on = TRUE`."""
    ungiven: list[str]
    """What the range read, the program never writes and the file has no column of, or no value in the first row: the monitor took the start value, and the controller may have had another one."""


class VerificationInfo(TypedDict):
    """The state of a verification. Everybody at the PLC sees the same."""

    id: int
    by: str
    title: str
    range: VerifyRange
    source: Literal["live", "past", "trace"]
    trace: str
    """name of the trace's file."""
    pace: Literal["free", "scan", "step"]
    auto: bool
    """paces scan and step: goes on by itself."""
    memory: Literal["recorded", "set"]
    state: Literal["starting", "verifying", "waiting", "stopped", "done", "failed"]
    message: str
    instances: list[str]
    limit: int
    first: int
    """the first scan that is, or was, to be verified."""
    last: int | None
    """the last one; null: as long as it runs."""
    scan: int | None
    """verified last."""
    compared: int
    """scans of which anything was compared."""
    skipped: int
    """scans of which nothing was: left out, not in the trace, or the program did not run."""
    stretches: list[list[int]]
    """those scans, the last 100 stretches, both ends included."""
    differing: int
    """rows that differ."""
    first_difference: VerifyDifference | None
    first_scan: int | None
    """scan of the first difference."""
    rows: int
    forgotten: int
    """rows at the front that found no room any more."""
    used: int
    """the most uses of a row."""
    coverage: VerifyCoverage | None
    """of a trace: what was compared so far, and what was not."""
    not_run: int
    """scans of `compared` in which the range did not run: there was nothing of it to compare."""
    not_reached: int
    """scans of the past that were wanted and did not run until now."""
    verdict: Literal["differs", "same", "same in what was compared", "nothing compared"]
    """until now; `same` only where all that was asked was compared, of a log all that it has (see `coverage`)."""
    generation: int
    """raised when rows that were already sent have changed."""


class TraceColumnMap(TypedDict):
    """What a column of a trace file means: a variable, and how near to it an output has to be."""

    column: str
    """as the file names it."""
    path: NotRequired[str]
    """variable or address of the project."""
    role: Literal["input", "output", "ignore"]
    absolute: NotRequired[float]
    """by so much the number of an output may differ."""
    relative: NotRequired[float]
    """the same as a part of what was recorded."""
    late_ms: NotRequired[float]
    """so much earlier or later it may come."""


class TraceMapping(TypedDict):
    """How a trace file is meant; see docs/trace-format.md."""

    axis: NotRequired[str]
    """column with scan or time; empty: a row is a scan."""
    unit: NotRequired[Literal["scan", "ns", "us", "ms", "s"]]
    gaps: NotRequired[Literal["refuse", "skip", "hold"]]
    """scans that are missing: refuse the file, compare nothing there and begin again, or hold the values."""
    columns: list[TraceColumnMap]
    sampled: NotRequired[Literal["end", "begin"]]
    """samples were taken at the end of a scan, or at its beginning: outputs are those of the scan before."""


class TraceProblem(TypedDict):
    """What is wrong with a file or with its mapping, and where."""

    row: int | None
    """Line of a CSV file, counted from 1; index in a JSON file, counted from 0; None: the file as a whole."""
    column: str
    message: str
    warning: bool
    """It is worth a look, but refuses nothing."""
    more: int
    """In so many further rows it is the same."""
    last: int | None
    """The last one of those."""
    near: list[str]
    """Variables that may be meant, where the column has none that fits."""


class TraceGuess(TypedDict):
    """Why a column has its variable in a proposal."""

    column: str
    score: float
    """How sure it is, up to 1: its name is that of the variable."""
    near: list[str]
    """What else it may be, or, below the score that is used, what it may be at all."""


class UploadedTrace(TypedDict):
    """A trace file that the server has read, or the first sample of a controller; nothing is kept of one that has problems."""

    file: str
    """handle for NewTraceVerification, good for an hour."""
    name: str
    columns: list[str]
    rows: int
    sample: list[list[str]]
    """the first rows, as text."""
    mapping: TraceMapping
    """a proposal: a saved mapping that fits, else by names."""
    problems: list[TraceProblem]
    guesses: list[TraceGuess]
    """how sure the proposal is of each column; none with a saved mapping."""
    layout: str
    """whose layout the file has; empty: ours."""
    left_out: list[str]
    """what the file has besides its columns, and is no variable."""


class VerifyColumn(TypedDict):
    """A variable that the range reads or writes. In a function block or method the name is the local one (`speed`, or `zone.parts` through an in-out), so rows of several instances share the column; else it is a path or an address."""

    name: str
    type: str
    kind: str
    """As in the watch table: bool, int, uint, real, bits, time, date, string, enum, ..."""
    size: int
    """Bytes of a value."""
    values: list[list[str | int]]
    """Names of an enumeration's numbers."""
    output: bool
    """Written in some row; said where rows are told, as `input`."""
    input: bool
    """Read before it was written, in some row."""


class VerifyOutput(TypedDict):
    """What was written: the last value in the pass. None: that side did not write it."""

    control: str | None
    monitor: str | None
    """A' on the recorded inputs."""
    set: str | None
    """A' on edited inputs, where somebody has edited any of this row and the monitor ran on them."""


class VerifyInput(TypedDict):
    """What was read before the pass wrote it."""

    recorded: str
    expected: str | None
    """What the monitor would have read by itself, when that is something else: a disturbed input."""
    set: str | None
    """What somebody has edited it to."""


class VerifyRow(TypedDict):
    """One line of the table."""

    kind: Literal["pass", "scan", "step", "none"]
    scan: int
    call: int
    """Which run through the range it is in this scan, from 1; 0 where that means nothing."""
    count: int
    """Of a step: the count of the statement that is next (`engines.debug`); 0 at the end of the scan."""
    instance: str
    place: VerifyPlace | None
    """Of a step: the statement that ran; None where it ran up to the first one only."""
    outputs: dict[str, VerifyOutput]
    inputs: dict[str, VerifyInput]
    """By the names of columns, both in the order of use."""
    differences: list[VerifyDifference]
    disturbances: list[str]
    """What was injected in this scan, for people: `Memory D120, bit 0`."""
    used: int
    """Uses of variables, the ones that found no room included."""
    note: str
    """`record full: 4,096 of 5,120 uses kept`, `not run in this scan`, `ended by a run-time error: ...`."""
    compared: bool
    """Whether it was: not where the program stood still, where a trace has no value or is believed, nor where uses found no room."""
    index: int
    """Of all rows, from 0, said where they are told; those that were forgotten keep theirs."""
    next: VerifyPlace | None
    """Of a step: the statement that is next."""
    consequences: list[VerifyDifference]
    """Of a step: what its statement got wrong because it read what was different before it. These are no differences of the row."""


class VerifyRows(TypedDict):
    """As many rows as were asked for, with all columns."""

    columns: list[VerifyColumn]
    rows: list[VerifyRow]
    first: int
    """Index of the first row that is kept."""
    count: int
    """Rows that there were; the last has index `count` - 1."""
    differing: list[int]
    """Indices of rows that differ, at most 10,000."""


class SetCell(TypedDict):
    """An input of the set data, edited."""

    scan: int
    call: int
    column: str
    value: str
    """as typed in the watch table; empty takes the edit back."""


class VerificationRecord(TypedDict):
    """A verification that was kept in the project."""

    id: int
    project: int
    name: str
    instance: str
    by: str
    at: str
    program_version: int
    info: VerificationInfo


class VerifyUse(TypedDict):
    """One use of a variable; see `verify.contract.Use`."""

    name: str
    written: bool
    control: str | None
    """As text."""
    monitor: str | None
    file: str
    line: int
    instance: str


class SavedMapping(TypedDict):
    """SavedMapping."""

    id: int
    name: str
    by: str
    mapping: TraceMapping
