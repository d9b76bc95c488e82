"""What the parent and the host of a PLC say to each other. Frozen data, packed by `codec.py`.

Parent to host: `Start` first, then the others in any order. A `ref` is chosen by the parent and comes back in the answer.
Host to parent: `Ready` or `StartFailed` first. `Entered` comes for every new journal entry, in order, before the `Ack` of
its command; `InEffect` and `RunMarks` say what holds after all entries so far, also those of earlier lives.
"""

from dataclasses import dataclass
from typing import ClassVar, Literal

from scanbench.debug.halt import Halt
from scanbench.faults.arm import ArmedInfo
from scanbench.faults.device_shapes import DeviceErrors
from scanbench.faults.disturb.disturb import DisturbanceInfo
from scanbench.faults.line_faults import BrokenLine
from scanbench.faults.present import Active
from scanbench.faults.preview import PreviewedWrite
from scanbench.faults.reference import ErrorRef
from scanbench.public import Public
from scanbench.recording.recording import RecordingInfo
from scanbench.runtime.command import Command, Entry
from scanbench.runtime.counted_variables import Counted
from scanbench.runtime.forces import ForcedValue
from scanbench.runtime.migrate_image import Lost
from scanbench.runtime.trap import TrapInfo
from scanbench.symbols.violations import Violations
from scanbench.wire.symbols import SymbolInfo, WatchItem

MarkKind = Literal[
    "write", "force", "error", "recover", "mode", "run", "build", "system", "halt", "disturbance"
]  # fmt: skip
"""What a mark of the timeline, or a line of the log, is about: categories of commands, and halts of a debugger."""

# ---- parent to host ------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Sources:
    """One accepted build: everything that makes the program."""

    model: str
    files: dict[str, str]
    interval_ns: int
    version: int


@dataclass(frozen=True, slots=True)
class Driven:
    """How a PLC is driven: kept in its run file, so that the next process drives it like that. Speed 0: as fast as possible."""

    speed: float = 1.0
    paused: bool = False
    end: int | None = None
    condition: str | None = None
    """The run was asked to end before scan `end`, or when this holds."""
    halted: bool = False
    """A debugger had halted it: it waits before its statement `count` (0: before the scan) until somebody lets it go on."""
    count: int = 0
    shown: int | None = None
    shown_count: int = 0
    """The scan of the past that is shown (None: the PLC itself), before this statement of it (0: before the scan)."""
    shown_by: str = ""


@dataclass(frozen=True, slots=True)
class Start:
    """Goes on with the run in the file `run`, up to scan `until` without waiting; begins one where there is none."""

    name: str
    sources: Sources
    """The program of a run that begins; a run that goes on has its own."""
    run: str
    run_mib: int | None
    memory_mib: int | None
    cpu_percent: int | None
    until: int
    driven: Driven | None
    """How it is to be driven; None is as the run file says."""


@dataclass(frozen=True, slots=True)
class Submit:
    """A command for the seam; answered with `Ack`."""

    ref: int
    command: Command


@dataclass(frozen=True, slots=True)
class Drive:
    """`continue` (for `scans`, or until a condition holds), `pause`, `scan` (one); `speed` changes that alone. Answered
    with `Ack`."""

    ref: int
    action: str
    speed: float | None
    author: str
    scans: int | None = None
    until: str | None = None


@dataclass(frozen=True, slots=True)
class Travel:
    """Shows the PLC as it was before `scan`, or where the scan's statement of this count is next; None returns to live.
    Answered with `Ack`."""

    ref: int
    scan: int | None
    author: str
    count: int = 0


@dataclass(frozen=True, slots=True)
class Copy:
    """Writes a run file of its own that ends before `scan`, or now; answered with `Ack`."""

    ref: int
    path: str
    scan: int | None
    author: str


@dataclass(frozen=True, slots=True)
class Preview:
    """What a swap to these sources would do to the variables; answered with `Previewed`."""

    ref: int
    sources: Sources


@dataclass(frozen=True, slots=True)
class PreviewErrors:
    """What raising these would write now; answered with `ErrorsPreviewed`."""

    ref: int
    errors: tuple[ErrorRef, ...]
    again: bool
    anyway: bool = False


@dataclass(frozen=True, slots=True)
class WantForces:
    """The forces as they are now; answered with `ForcesAre`."""

    ref: int


@dataclass(frozen=True, slots=True)
class WantDevice:
    """The device's own view of its errors, as it is now; answered with `DeviceIs`."""

    ref: int


@dataclass(frozen=True, slots=True)
class RollBack:
    """Swaps back in what ran before the last change of the program; answered with `Ack`."""

    ref: int
    author: str


@dataclass(frozen=True, slots=True)
class SetLimits:
    """New limits of the run file and of the CPU; those of memory hold from the next start."""

    run_mib: int | None
    cpu_percent: int | None


@dataclass(frozen=True, slots=True)
class Attend:
    """Whether somebody looks: nobody gets frames, and the state comes seldom."""

    anybody: bool


@dataclass(frozen=True, slots=True)
class Build:
    """Compiles while the program runs, and swaps in the seam; answered with `Ack`."""

    ref: int
    sources: Sources
    author: str


@dataclass(frozen=True, slots=True)
class WatchPaths:
    """Watches paths under these ids; ids that are watched already are sent again. Answered with `Watching`."""

    ref: int
    paths: tuple[tuple[int, str], ...]


@dataclass(frozen=True, slots=True)
class UnwatchIds:
    """Ends watching these ids."""

    ids: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class WantSnapshot:
    """A frame with all values for one subscriber."""

    to: int


@dataclass(frozen=True, slots=True)
class Lookup:
    """`members` of a path, what `complete`s a text, or the `instances` of a POU; answered with `Found`."""

    ref: int
    kind: str
    text: str


@dataclass(frozen=True, slots=True)
class WantSources:
    """What a version of the program is made of, as it is kept in the run; answered with `SourcesOf`."""

    ref: int
    version: int


@dataclass(frozen=True, slots=True)
class Ping:
    """Asks whether the process is there; answered with `Pong` at once, whatever the PLC does."""


@dataclass(frozen=True, slots=True)
class Quit:
    """Ends the process."""


# ---- host to parent ------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Pong:
    """Answer to `Ping`."""


@dataclass(frozen=True, slots=True)
class Ready:
    """The program is there, running or not; `message` names its engine, `sources` is what it is made of."""

    message: str
    sources: Sources
    fresh: bool
    """A new run has begun; else one goes on."""


@dataclass(frozen=True, slots=True)
class NowRuns:
    """From the next entries on a new program runs, made of these sources."""

    sources: Sources


@dataclass(frozen=True, slots=True)
class StartFailed:
    """The program cannot be run at all."""

    message: str
    no_space: bool = False
    """There is no room for its run: when there is, it can."""


@dataclass(frozen=True, slots=True)
class PlcState:
    """The state of one virtual PLC, as its host tells it; the parent adds what it knows of the process."""

    state: str
    mode: str
    message: str
    scan: int = 0
    time_ns: int = 0
    interval_ns: int = 0
    cycle_us: float = 0.0
    speed: float = 1.0
    pid: int | None = None
    restarts: int = 0
    trap: TrapInfo | None = None
    forces: int = 0
    version: int = 0
    live_scan: int = 0
    """Where the PLC waits while the past is shown; else `scan`."""
    past_by: str = ""
    """Who shows the past; empty when what is shown is live."""
    target: str = ""
    previous_version: int | None = None
    """What a roll back swaps in."""
    late_percent: float = 0.0
    late_us: float = 0.0
    """Mean lateness of scans since the pace was set; `worst_us` is the most. A stall is in both."""
    worst_us: float = 0.0
    halt: Halt | None = None
    """Where a debugger halted it; then `state` is `halted` (`past` while that is in the past)."""
    flavour: str = ""
    """Which code runs, for people: empty is the ordinary one, `debug`, `probed`."""
    startable: bool = True
    """False while its model is missing: nothing starts it before the server finds that again."""
    paused: bool = False
    """Whether it would be, were it not halted, trapped or shown in the past: the next process goes on like that."""


@dataclass(frozen=True, slots=True)
class InEffect:
    """What holds at the scan that is shown: the errors that are present, the faults that are armed, what disturbs it, broken lines."""

    errors: dict[str, Active]
    armed: tuple[ArmedInfo, ...] = ()
    disturbances: tuple[DisturbanceInfo, ...] = ()
    lines: tuple[BrokenLine, ...] = ()
    """Lines to clients that something is wrong with."""


@dataclass(frozen=True, slots=True)
class ForcesAre:
    """The forces that hold at the scan that is shown, and what they did in the scan before. `ref`: of who asked."""

    forces: tuple[ForcedValue, ...]
    ref: int | None = None


@dataclass(frozen=True, slots=True)
class DeviceIs:
    """The device's own view of its errors at the scan that is shown. `ref`: of who asked; told by itself when it changed."""

    found: DeviceErrors
    ref: int | None = None


@dataclass(frozen=True, slots=True)
class RunMark(Public):
    """An entry of the run's journal, in short."""

    PUBLIC: ClassVar = "Mark"

    scan: int
    kind: MarkKind
    author: str
    text: str


@dataclass(frozen=True, slots=True)
class RunMarks:
    """What the run file holds. With `fresh` `marks` are all there are, the last 5,000; later ones follow from `Entered`."""

    info: RecordingInfo
    marks: tuple[RunMark, ...]
    fresh: bool


@dataclass(frozen=True, slots=True)
class Previewed:
    """Answer to `Preview`. `lost` is bounded, `lost_count` is not; a `refusal` says why nothing can be swapped now."""

    ref: int
    counted: Counted
    lost: tuple[Lost, ...]
    lost_count: int
    refusal: str


@dataclass(frozen=True, slots=True)
class PreviewedErrors(Public):
    """What raising errors would do: what the plan says, or why it would be refused."""

    ok: bool
    message: str
    scan: int
    writes: tuple[PreviewedWrite, ...]
    """In the order of the memory."""
    more: int = 0
    """Words that change besides, and are not named."""


@dataclass(frozen=True, slots=True)
class ErrorsPreviewed:
    """Answer to `PreviewErrors`."""

    ref: int
    found: PreviewedErrors


@dataclass(frozen=True, slots=True)
class Frame:
    """A value frame (`web/socket/frames.py`), for all subscribers or for one."""

    data: bytes
    live_scan: int
    """Where the PLC was: what somebody saw is not lost with the process."""
    to: int | None = None


@dataclass(frozen=True, slots=True)
class Diagnosed:
    """The runtime diagnostics are others than before."""

    violations: Violations


@dataclass(frozen=True, slots=True)
class Entered:
    """New entries of the journal, in order: together what came since the last tick or answer."""

    entries: tuple[Entry, ...]


@dataclass(frozen=True, slots=True)
class Ack:
    """Answer to what wants something of the PLC: done before `scan`, or refused."""

    ref: int
    ok: bool
    message: str
    scan: int
    near: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Watching:
    """Answer to `WatchPaths`; with ref None for all ids, after a new program moved the variables."""

    ref: int | None
    items: tuple[WatchItem, ...]


@dataclass(frozen=True, slots=True)
class SourcesOf:
    """Answer to `WantSources`; no sources: why."""

    ref: int
    sources: Sources | None
    message: str = ""


@dataclass(frozen=True, slots=True)
class Found:
    """Answer to `Lookup`."""

    ref: int
    symbols: tuple[SymbolInfo, ...]
    message: str = ""
    near: tuple[str, ...] = ()
