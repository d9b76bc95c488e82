"""What the parent and the host of a PLC say to each other. Frozen data, packed by `codec.py`.

Parent to host: `Start` first, then the others in any order. A `ref` is chosen by the parent and comes back in the answer.
Host to parent: `Ready` or `StartFailed` first. `Entered` comes for every journal entry, in order, before the `Ack` of its
command; `Checkpoint` says from which entry on a replay needs the journal.
"""

from dataclasses import dataclass

from scanbench.check.violations import Violations
from scanbench.runtime.command import Command, Entry
from scanbench.runtime.trap import TrapInfo

# ---- parent to host ------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Sources:
    """One accepted build: everything that makes the program."""

    model: str
    files: dict[str, str]
    interval_ns: int
    version: int


@dataclass(frozen=True, slots=True)
class Checkpoint:
    """A copy of the state before `scan` of program `version`; the journal's first `entries` entries are in it."""

    scan: int
    entries: int
    version: int
    image: bytes
    """Zstandard."""


@dataclass(frozen=True, slots=True)
class Start:
    """Builds and runs. With a checkpoint: goes back to it and replays the journal up to scan `until`."""

    sources: Sources
    speed: float
    paused: bool
    checkpoint: Checkpoint | None
    journal: tuple[Entry, ...]
    until: int


@dataclass(frozen=True, slots=True)
class Submit:
    """A command for the seam; answered with `Ack`."""

    ref: int
    command: Command


@dataclass(frozen=True, slots=True)
class Drive:
    """Pace: `continue`, `pause`, `scan` (one), `restart` (cold start), or only a new speed; answered with `Ack`."""

    ref: int
    action: str
    speed: float | None
    author: str


@dataclass(frozen=True, slots=True)
class Build:
    """Compiles beside the running program, and swaps in the seam; answered with `Ack`."""

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
    """`members` of a path, or what `complete`s a text; answered with `Found`."""

    ref: int
    kind: str
    text: str


@dataclass(frozen=True, slots=True)
class Quit:
    """Ends the process."""


# ---- host to parent ------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Ready:
    """The program runs (or stands); `message` says on what."""

    message: str


@dataclass(frozen=True, slots=True)
class StartFailed:
    """The program cannot be run at all."""

    message: str


@dataclass(frozen=True, slots=True)
class HostState:
    """The state of the PLC; `InstanceState` of the wire without what the parent knows itself."""

    state: str
    mode: str
    message: str
    scan: int
    time_ns: int
    interval_ns: int
    cycle_us: float
    speed: float
    paused: bool
    trap: TrapInfo | None
    forces: int
    version: int


@dataclass(frozen=True, slots=True)
class Frame:
    """A value frame (`web/frames.py`), for all subscribers or for one."""

    data: bytes
    to: int | None = None


@dataclass(frozen=True, slots=True)
class Diagnosed:
    """The runtime diagnostics are others than before."""

    violations: Violations


@dataclass(frozen=True, slots=True)
class Entered:
    """A new entry of the journal."""

    entry: Entry


@dataclass(frozen=True, slots=True)
class ColdStart:
    """A new run begins: fresh image, empty journal, no error present, no force. Its first `Checkpoint` follows."""


@dataclass(frozen=True, slots=True)
class Ack:
    """Answer to `Submit`, `Drive`, `Build`: done before `scan`, or refused."""

    ref: int
    ok: bool
    message: str
    scan: int
    near: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class SymbolInfo:
    """A variable or an address, as the wire's `Symbol`."""

    path: str
    name: str
    type: str
    kind: str
    size: int
    address: str | None
    writable: bool
    section: str
    expandable: bool
    values: tuple[tuple[str, int], ...] = ()
    """Names of an enumeration's numbers."""


@dataclass(frozen=True, slots=True)
class WatchItem:
    """One watched path: its symbol, or why there is none. `sent` is false for structures, which are in no frame."""

    id: int
    path: str
    symbol: SymbolInfo | None
    sent: bool
    message: str = ""
    near: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Watching:
    """Answer to `WatchPaths`; with ref None for all ids, after a new program moved the variables."""

    ref: int | None
    items: tuple[WatchItem, ...]


@dataclass(frozen=True, slots=True)
class Found:
    """Answer to `Lookup`."""

    ref: int
    symbols: tuple[SymbolInfo, ...]
    message: str = ""
    near: tuple[str, ...] = ()


ToHost = Start | Submit | Drive | Build | WatchPaths | UnwatchIds | WantSnapshot | Lookup | Quit
FromHost = (
    Ready | StartFailed | HostState | Frame | Diagnosed | Entered | ColdStart | Checkpoint | Ack | Watching | Found
)
