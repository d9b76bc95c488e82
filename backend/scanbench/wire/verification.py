"""What the parent and a job process say to each other about verification and about the past of a run.

One process belongs to one verification: it runs the control device (the run file, re-run natively) and the monitor. It answers requests in
order; it sends rows as they are made, and the parent keeps them. A different process answers the questions about the past.
"""

from dataclasses import dataclass
from typing import ClassVar

from scanbench.debug.flow_shown import FlowAsked
from scanbench.history.contract import Changes, Divergence, RerunChange, Writer
from scanbench.public import Public
from scanbench.verify.contract import Column, Mismatch, Range, VerifyCoverage, VerifyFlows
from scanbench.verify.trace.growing import Sample
from scanbench.wire.host import Sources

NOW = (1 << 63) - 1
"""As a scan: the end of the run."""

# ---- parent to job: a verification ---------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class BeginVerify:
    """Opens the run file (read-only; its PLC may go on writing it). Answered with `VerifyBegun`."""

    ref: int
    run: str
    range: Range
    limit: int
    """Uses of variables that are recorded of a scan."""
    until: int
    """Scans before this one are over."""
    first: int
    """The first scan that is wanted: columns are named for the program that ran then."""


@dataclass(frozen=True, slots=True)
class BeginTrace:
    """As `BeginVerify`, for a controller log: the file as it was uploaded, and how its columns are meant (JSON of
    `verify.mapping.TraceMapping`). Answered with `VerifyBegun`."""

    ref: int
    sources: Sources
    file: str
    name: str
    mapping: str
    range: Range
    limit: int


@dataclass(frozen=True, slots=True)
class BeginController:
    """As `BeginTrace`, for a controller that runs, of which this is the first sample. Answered with `VerifyBegun`."""

    ref: int
    sources: Sources
    address: str
    columns: tuple[str, ...]
    cells: tuple[str, ...]
    mapping: str
    range: Range
    limit: int


@dataclass(frozen=True, slots=True)
class TakeSamples:
    """More samples of the controller; scans from `first` on that they tell of are verified. Answered as `VerifyScans`."""

    ref: int
    samples: tuple[Sample, ...]
    first: int
    last: bool = False
    """No more of them come: the last scans are verified, too, of which later values might have come in time."""


@dataclass(frozen=True, slots=True)
class VerifyScans:
    """Verifies scans `first` to `last`, both included, in order. Answered with `ScansVerified` a few times a second, then
    `ScansDone`. It ends early, after the scan that runs, when a further request waits."""

    ref: int
    first: int
    last: int
    until: int
    """Scans before this one are over."""


@dataclass(frozen=True, slots=True)
class VerifyStep:
    """Both sides run one step of a scan, and are compared; see `Verifier.step`. Answered with `ScansDone`, one row of kind
    `step`."""

    ref: int
    scan: int
    after: int
    count: int
    until: int


@dataclass(frozen=True, slots=True)
class SetInputs:
    """The monitor runs these passes again on edited inputs: (scan, call, column) -> value as typed; an empty text takes an
    edit back. Answered with `ScansVerified` with the rows as they are now."""

    ref: int
    edits: tuple[tuple[int, int, str, str], ...]


@dataclass(frozen=True, slots=True)
class UsesOf:
    """The used-variable record of one pass. Answered with `UsesAre`."""

    ref: int
    scan: int
    call: int


@dataclass(frozen=True, slots=True)
class RowFlowsOf:
    """What the code of an instance saw in one pass. Answered with `RowFlowsAre`."""

    ref: int
    scan: int
    call: int
    asked: FlowAsked


# ---- job to parent -------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class VerifyBegun:
    """The range is understood: how it reads for people, and the scans that are kept."""

    ref: int
    title: str
    """`FB_Belt, lines 33 to 42`."""
    instances: tuple[str, ...]
    first: int
    end: int
    interval_ns: int
    version: int
    """Of the program."""
    note: str = ""
    """How the range was understood, where that is not plain."""


@dataclass(frozen=True, slots=True)
class PackedRow:
    """A row, packed by the codec: whoever keeps thousands of them keeps bytes."""

    scan: int
    call: int
    count: int
    first: Mismatch | None
    """Its first difference."""
    data: bytes


@dataclass(frozen=True, slots=True)
class ScansVerified:
    """Rows, in order, those of a scan all in one message; `scan` is the last one that is verified, -1 where there is none."""

    ref: int
    scan: int
    compared: int
    """Scans since the last message of which anything was compared."""
    rows: tuple[PackedRow, ...]
    columns: tuple[Column, ...]
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    used: int
    skipped: tuple[tuple[int, int], ...] = ()
    """Scans since the last message of which nothing was compared, as stretches, both ends included."""
    not_run: int = 0
    """Scans of `compared` in which the range did not run."""
    full: int = 0
    """Skipped scans in which uses found no room in the record."""


@dataclass(frozen=True, slots=True)
class ScansDone(ScansVerified):
    """The last ones."""

    failed: str = ""
    """Why it cannot go on."""
    coverage: VerifyCoverage | None = None
    """Of a trace: what was compared so far, and what was not."""


@dataclass(frozen=True, slots=True)
class KeptRows:
    """The rows of a verification that was kept, in a file of its own."""

    first: int
    """Index of the first."""
    rows: tuple[PackedRow, ...]
    columns: tuple[Column, ...]
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    old: dict[int, PackedRow]
    """By index: rows before `first` that differ."""


@dataclass(frozen=True, slots=True)
class UseRow(Public):
    """One use of a variable; see `verify.contract.Use`."""

    PUBLIC: ClassVar = "VerifyUse"

    name: str
    written: bool
    control: str | None
    """As text."""
    monitor: str | None
    file: str
    line: int
    instance: str


@dataclass(frozen=True, slots=True)
class UsesAre:
    """The used-variable record, in the order of use."""

    ref: int
    uses: tuple[UseRow, ...]


@dataclass(frozen=True, slots=True)
class RowFlowsAre:
    """On both sides."""

    ref: int
    flows: VerifyFlows


# ---- the past: one process for the questions of all, one for each comparison and replay ----------------------------


@dataclass(frozen=True, slots=True)
class FindWriter:
    """Who last wrote a variable before `scan` began. Answered with `WriterFound`."""

    ref: int
    run: str
    path: str
    scan: int
    """`NOW`: where the run ends."""
    until: int
    """Scans before this one are over, here and below; 0: those that the file knows of."""


@dataclass(frozen=True, slots=True)
class WriterFound:
    """Who."""

    ref: int
    writer: Writer


@dataclass(frozen=True, slots=True)
class MakeScenario:
    """The scenario of what people did before `scan`. Answered with `ScenarioMade`."""

    ref: int
    run: str
    scan: int
    """`NOW`: where the run ends."""
    until: int


@dataclass(frozen=True, slots=True)
class ScenarioMade:
    """The text of its file."""

    ref: int
    text: str


@dataclass(frozen=True, slots=True)
class FindChanges:
    """The values that differ between the beginnings of scan `first` and of scan `last` of `run`; with `other`, a second run file:
    between `first` in `run` and `last` in `other`. Answered with `ChangesFound`."""

    ref: int
    run: str
    first: int
    last: int
    until: int
    other: str = ""
    other_until: int = 0


@dataclass(frozen=True, slots=True)
class ChangesFound:
    """What."""

    ref: int
    changes: Changes


@dataclass(frozen=True, slots=True)
class CompareRuns:
    """Two run files scan by scan, in as far as both go. Answered with `PastAt` a few times a second, then `RunsCompared`."""

    ref: int
    run: str
    other: str
    until: int
    other_until: int


@dataclass(frozen=True, slots=True)
class PastAt:
    """How far it is."""

    ref: int
    done: int
    of: int
    """Scans."""


@dataclass(frozen=True, slots=True)
class RunsCompared:
    """Where they part, if they do."""

    ref: int
    divergence: Divergence


@dataclass(frozen=True, slots=True)
class RerunRun:
    """Repeats the run with one change, up to scan `until`, into a new run file. Answered with `PastAt` a few times a
    second, then `RerunDone`."""

    ref: int
    run: str
    to: str
    change: RerunChange
    until: int
    author: str


@dataclass(frozen=True, slots=True)
class RerunDone:
    """The file is there. `refused`: commands that were not taken this time, and why."""

    ref: int
    scan: int
    """The file ends before it."""
    refused: tuple[str, ...] = ()
