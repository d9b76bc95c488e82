"""The contract of verification: what is compared, and what came out.

The *control device* ran the program (native code, perhaps disturbed; or a real controller, of which there is a trace), the
*monitor* runs the same program a second time, on the inputs that the control device really used. `A` is what the control
device came to, `A'` what the monitor came to.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import ClassVar, Literal

from scanbench.debug.flow_shown import Flows
from scanbench.public import Hex, Public

Memory = Literal["recorded", "set"]
"""What the monitor runs on: the inputs of the control device, or a copy of them that somebody has edited."""
AT_END = 1 << 62
"""As the count of a statement: the end of the scan."""
RowKind = Literal["pass", "scan", "step", "none"]
"""A run through the range; a whole scan; one statement (pace step by step); the range did not run in this scan."""
Cause = Literal["logic", "input", "order", "trap", "outside", "recorded"]
"""logic: the same inputs gave a different result. input: a value became wrong although no statement wrote it (a disturbance
between two scans, or of an input refresh). order: a different statement ran, or a different variable was used. trap: a run-time
error ended one of the two. outside: a variable that the range does not use. recorded: re-running the recorded scan gave a
different result than the live run (the run file's checkpoint differs)."""

ENDED = "ended by a run-time error"
"""The beginning of the note of a row if a run-time error ended its scan."""
FULL = "record full"
"""The beginning of the note of a row where uses found no room."""
DEFAULT_LIMIT = 4096
"""The default for the number of uses of variables that are recorded in a scan."""
MAX_LIMIT = 1_000_000
MAX_COLUMNS = 400


class BadRange(ValueError):
    """No such stretch of the program; the message says what there is. `near` was perhaps meant."""

    def __init__(self, message: str, near: tuple[str, ...] = ()) -> None:
        super().__init__(message)
        self.near = near


@dataclass(frozen=True, slots=True)
class Range:
    """A stretch of one POU, as it was asked for. Neither file nor POU: the whole scan."""

    pou: str = ""
    """Name of a PROGRAM, FUNCTION_BLOCK, FUNCTION or method (`FB.method`); empty: the POU that has the lines of `file`."""
    file: str = ""
    first: int = 0
    """Line of the file, counted from 1; 0: from the POU's first statement."""
    last: int = 0
    """Included; 0: to the POU's last statement."""
    instance: str = ""
    """Path of the only instance that counts; empty: all of them."""


@dataclass(frozen=True, slots=True)
class Column(Public):
    """A variable that the range reads or writes. In a function block or method the name is the local one (`speed`, or
    `zone.parts` through an in-out), so rows of several instances share the column; else it is a path or an address."""

    PUBLIC: ClassVar = "VerifyColumn"

    name: str
    type: str
    kind: str
    """As in the watch table: bool, int, uint, real, bits, time, date, string, enum, ..."""
    size: int
    """Bytes of a value."""
    values: tuple[tuple[str, int], ...] = ()
    """Names of an enumeration's numbers."""
    output: bool = False
    """Written in some row; said where rows are told, as `input`."""
    input: bool = False
    """Read before it was written, in some row."""


@dataclass(frozen=True, slots=True)
class Place(Public):
    """Where in the program something happened."""

    PUBLIC: ClassVar = "VerifyPlace"

    task: str
    instance: str
    """Instance path of the POU that ran: `Main.belt[3]`; of a FUNCTION its name."""
    pou: str
    file: str
    line: int
    text: str = ""
    """The source line, trimmed."""


@dataclass(frozen=True, slots=True)
class Output(Public):
    """What was written: the last value in the pass. None: that side did not write it."""

    PUBLIC: ClassVar = "VerifyOutput"

    control: Hex | None
    monitor: Hex | None
    """A' on the recorded inputs."""
    set: Hex | None = None
    """A' on edited inputs, where somebody has edited any of this row and the monitor ran on them."""


@dataclass(frozen=True, slots=True)
class Input(Public):
    """What was read before the pass wrote it."""

    PUBLIC: ClassVar = "VerifyInput"

    recorded: Hex
    expected: Hex | None = None
    """What the monitor would have read by itself, when that is something else: a disturbed input."""
    set: Hex | None = None
    """What somebody has edited it to."""


@dataclass(frozen=True, slots=True)
class Mismatch(Public):
    """The first place where control and monitor part, or a byte that nobody should have changed."""

    PUBLIC: ClassVar = "VerifyDifference"

    cause: Cause
    name: str
    """The column, or the path or address of the variable."""
    control: Hex
    """A, `was` for people; empty where it did nothing."""
    monitor: Hex
    """A'."""
    place: Place | None
    message: str
    """One sentence: `Main.belt[3].speed is 536, the reference gives 600, at FB_Belt.st:34 in scan 128388`."""
    type: str = ""
    kind: str = ""
    size: int = 0


@dataclass(frozen=True, slots=True)
class Row(Public):
    """One line of the table."""

    PUBLIC: ClassVar = "VerifyRow"

    kind: RowKind
    scan: int
    call: int = 0
    """Which run through the range it is in this scan, from 1; 0 where that means nothing."""
    count: int = 0
    """Of a step: the count of the statement that is next (`engines.debug`); 0 at the end of the scan."""
    instance: str = ""
    place: Place | None = None
    """Of a step: the statement that ran; None where it ran up to the first one only."""
    outputs: Mapping[str, Output] = field(default_factory=dict)
    inputs: Mapping[str, Input] = field(default_factory=dict)
    """By the names of columns, both in the order of use."""
    differences: tuple[Mismatch, ...] = ()
    disturbances: tuple[str, ...] = ()
    """What was injected in this scan, for people: `Memory D120, bit 0`."""
    used: int = 0
    """Uses of variables, the ones that found no room included."""
    note: str = ""
    """`record full: 4,096 of 5,120 uses kept`, `not run in this scan`, `ended by a run-time error: ...`."""

    compared: bool = True
    """Whether it was: not where the program stood still, where a trace has no value or is believed, nor where uses found no room."""
    index: int = 0
    """Of all rows, from 0, said where they are told; those that were forgotten keep theirs."""
    next: Place | None = None
    """Of a step: the statement that is next."""
    consequences: tuple[Mismatch, ...] = ()
    """Of a step: what its statement got wrong because it read what was different before it. These are no differences of the row."""

    @property
    def differs(self) -> bool:
        """Whether anything is not as it should be."""
        return bool(self.differences)

    @property
    def cut(self) -> bool:
        """Whether it had uses that found no room, and of which nothing is known."""
        return FULL in self.note and not self.compared


@dataclass(frozen=True, slots=True)
class Compared(Public):
    """What came of one output of a trace."""

    PUBLIC: ClassVar = "VerifyCompared"

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


@dataclass(frozen=True, slots=True)
class VerifyCoverage(Public):
    """What of a trace was compared so far, and what was not."""

    outputs: tuple[Compared, ...]
    inputs: tuple[str, ...]
    """Variables that the trace gave to the monitor: they cannot differ."""
    ignored: tuple[str, ...]
    """Columns of the file that are mapped to nothing."""
    unrecorded: tuple[str, ...]
    """What the range wrote and the file has no column of: of these nothing was compared."""
    remembered: tuple[str, ...]
    """What the program remembers and the file has no column of: the monitor began with the values of a cold start."""
    more: int = 0
    """Variables of `unrecorded`, `remembered` and `ungiven` that are not named."""
    assumed: tuple[str, ...] = ()
    """Remembered variables of which the first rows told what they were: `Main.belt.on = TRUE`."""
    ungiven: tuple[str, ...] = ()
    """What the range read, the program never writes and the file has no column of, or no value in the first row: the monitor took the start
    value, and the controller may have had another one."""


@dataclass(frozen=True, slots=True)
class Use:
    """One entry of the used-variable record."""

    name: str
    written: bool
    control: bytes | None
    monitor: bytes | None
    place: Place


@dataclass(frozen=True, slots=True)
class VerifyFlows(Public):
    """What the code of one instance saw in one row, element by element, on both sides."""

    control: Flows
    monitor: Flows
    line: int = 0
    """Where the element begins that differed first: whose power or values are not the same, or that ran on one side only. 0: none did."""
    column: int = 0


@dataclass(frozen=True, slots=True)
class ScanVerified:
    """What came of one scan."""

    scan: int
    rows: tuple[Row, ...]
    columns: tuple[Column, ...]
    """New ones, in the order of their first use."""
    inputs: tuple[str, ...] = ()
    """Names that were inputs for the first time."""
    outputs: tuple[str, ...] = ()
    """Names that were outputs for the first time."""
    used: int = 0
    """The most uses of a row."""
    last: int = -1
    """Where nothing runs: the last scan of the stretch that this one begins; else nothing is said by it."""

    @property
    def compared(self) -> bool:
        """Whether the scan was compared: else nothing can be said of it."""
        return any(row.compared for row in self.rows) and not self.cut

    @property
    def idle(self) -> bool:
        """Whether the range did not run in it, so that there was nothing of it to compare."""
        return self.compared and all(row.kind == "none" for row in self.rows)

    @property
    def cut(self) -> bool:
        """Whether something of it was not compared, as it found no room in the record."""
        return any(row.cut for row in self.rows)


@dataclass(frozen=True, slots=True)
class Begun:
    """A range that was understood."""

    title: str
    instances: tuple[str, ...]
    first: int
    end: int
    interval_ns: int
    version: int
    """Of the program."""
    note: str = ""
    """What is not quite as it was asked for."""
