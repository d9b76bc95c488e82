"""Answers of the REST API: the PLC and its values. Made by `python -m tests.client_shapes`; do not edit."""

from typing import Literal, NotRequired, TypedDict


class User(TypedDict):
    """Somebody who is at a PLC; a `client` of a protocol is no person."""

    name: str
    initials: str
    client: bool


class Project(TypedDict):
    """A project: its files are built for a model."""

    id: int
    name: str
    model: str
    version: int
    """counts the builds that were accepted."""
    watch: list[str]
    """what a fresh watch list begins with."""


class TrapInfo(TypedDict):
    """Why the program was stopped by itself."""

    kind: Literal["bounds", "division", "null", "string", "loop", "abstract", "fatal"]
    message: str
    file: str
    line: int
    column: int
    scan: int


class PastInfo(TypedDict):
    """What is shown is the past: the PLC waits at `live_scan`."""

    live_scan: int
    by: str
    """who went there."""


class HaltInfo(TypedDict):
    """The PLC is halted by the debugger; part of the instance's state, so that everybody sees it at once."""

    number: int
    """each halt has a number of its own."""
    reason: Literal[
        "breakpoint", "data breakpoint", "step", "pause", "entry", "goto", "error", "violation", "trap", "scan"
    ]
    text: str
    by: str
    file: str
    """of the statement that is next; empty in the seam."""
    line: int
    column: int
    end_line: int
    end_column: int
    pou: str
    instance: str
    task: str
    count: int
    """statements of the scan that have begun, the next one included; 0 is the seam."""
    past: bool


class InstanceState(TypedDict):
    """The state of one virtual PLC, as the top bar and the rail show it."""

    state: Literal[
        "starting",
        "running",
        "paused",
        "halted",
        "stopped",
        "fatal",
        "trapped",
        "restarting",
        "silent",
        "failed",
        "past",
        "off",
        "no_space",
    ]
    mode: Literal["PROGRAM", "MONITOR", "RUN"]
    message: str
    """one line that says why, e.g. the error code or the trap's place."""
    scan: int
    time_ns: int
    interval_ns: int
    cycle_us: float
    """measured duration of a scan."""
    speed: float
    """1 = real time, 0 = as fast as possible."""
    pid: int | None
    restarts: int
    trap: TrapInfo | None
    forces: int
    program_version: int
    past: PastInfo | None
    previous_version: int | None
    """what a roll back swaps in; null when there is nothing."""
    target: str
    """where a run ends: `scan 4711`, `until Main.count > 3`; or empty: it does not."""
    late_percent: float
    """scans of the last seconds that began after the next one was due."""
    late_us: float
    """how late scans began, in the mean, since speed was set or the PLC went on."""
    worst_us: float
    """how late the latest of them began: after a stall, too."""
    halt: HaltInfo | None
    """where the debugger halted it, also in the past; null while it runs."""
    flavour: str
    """which code runs: empty is the ordinary one, `debug`, `probed`"""
    startable: bool
    """false: nothing starts it, `message` says why and what to do."""


class InstanceLoad(TypedDict):
    """What an instance costs now; zeros while it is off."""

    cpu_percent: float
    """of one core."""
    memory_bytes: int
    """proportional share of memory (PSS)."""
    run_bytes: int
    """size of the run file."""


class InstanceLimits(TypedDict):
    """What an instance may cost at most; null is no limit."""

    memory_mib: NotRequired[int | None]
    cpu_percent: NotRequired[int | None]
    """of one core, for runs as fast as possible."""
    run_mib: NotRequired[int | None]
    """bound of the run file; null is the default."""


class Instance(TypedDict):
    """A virtual PLC that runs the program of a project."""

    id: int
    name: str
    project: Project
    model: str
    state: InstanceState
    load: InstanceLoad
    limits: InstanceLimits
    users: list[User]
    """who is at it now."""


class AppInfo(TypedDict):
    """What there is on a server."""

    version: str
    public_url: str
    """what links that are passed on begin with; empty: the address of the page."""
    you: User
    projects: list[Project]
    instances: list[Instance]


class ImportedInstance(TypedDict):
    """A PLC that goes on with the run of a file."""

    id: int
    name: str
    project: Project
    model: str
    state: InstanceState
    load: InstanceLoad
    limits: InstanceLimits
    users: list[User]
    """who is at it now."""
    damage: str
    """what is damaged in the file, and what is lost; empty where all is well."""


class Value(TypedDict):
    """A variable, an address or an expression of ST, as it is between two scans (or where the PLC is halted)."""

    path: str
    """instance path or address; empty for what is computed."""
    value: str
    """as it would be typed: TRUE, 42, T#5s, 'text'; of a structure how many members it has."""
    type: str
    address: str
    """vendor notation where it is located; else empty."""
    alias: str
    """of an in-out or reference: what it leads to, `-> Main.tank[3].level (D120)`"""


class CommandResult(TypedDict):
    """What became of a command that came by REST."""

    ok: bool
    message: str
    scan: int
    near: list[str]


class ForceInfo(TypedDict):
    """A force, and what it did in the scan that ran last: values as text."""

    path: str
    through: str
    """The in-out that it was entered for; empty where it was entered for the variable itself."""
    value: str
    author: str
    scan: int
    """Before which scan it was entered."""
    before: str
    """What the variable was when the program was about to begin: from the inputs, or from the scan before."""
    after_program: str
    """What the program made of it."""
    after: str
    """What it is now."""


class BoundTo(TypedDict):
    """One call site of an in-out, and what it passes."""

    actual: str
    """Path of the variable, `Main.tank[3].level`; empty when it is not known yet."""
    address: str
    """Vendor notation where it is located; else empty."""
    file: str
    line: int
    column: int
    call: str
    """The path of the calling instance, `Main.line`."""
    scan: int | None
    """Scan of the last execution; None: never, or nobody noted it, as the call does not run in every scan of its task."""
    last: bool
    """It is the one that ran last: what a write goes to."""
    message: str
    """Why a write cannot go there: a constant, a read-only area."""


class Binding(TypedDict):
    """What an in-out is bound to, and all that may be passed to it."""

    ok: bool
    message: str
    """Why it is bound to nothing: `not called yet`, ..."""
    convention: Literal["reference", "value"]
    sites: list[BoundTo]


class LogLine(TypedDict):
    """One line of the log, for people."""

    at: str
    scan: int
    author: str
    text: str
    kind: Literal["write", "force", "error", "recover", "mode", "run", "build", "system", "halt", "disturbance"]


class LogPage(TypedDict):
    """A stretch of the log as it is kept."""

    first: int
    """The number of the first of these lines, counted from 0."""
    total: int
    """Lines that are kept (of the kind that was asked for)."""
    kept: int
    """Lines that are kept at most; older ones go."""
    lines: list[LogLine]


class EnumValue(TypedDict):
    """A number of an enumeration that has a name."""

    name: str
    value: int


class Symbol(TypedDict):
    """A variable, or an address, by its instance path."""

    path: str
    name: str
    type: str
    """As declared, e.g. INT, ARRAY[0..9] OF REAL, TON."""
    kind: Literal[
        "bool",
        "int",
        "uint",
        "bits",
        "real",
        "time",
        "string",
        "array",
        "struct",
        "block",
        "union",
        "interface",
        "date",
        "char",
        "ref",
    ]
    size: int
    """Bytes of the value."""
    address: str | None
    """Vendor notation when it is located."""
    writable: bool
    section: str
    """VAR, VAR_INPUT, VAR_OUTPUT, VAR_IN_OUT, VAR_GLOBAL, address or member."""
    expandable: bool
    values: list[EnumValue]
    """Of an enumeration: the names of its numbers."""
    range: str
    """Of a subrange: the integer that it is and its bounds, INT (0..500); `type` may be a name."""
    in_out: bool
    """It is an in-out; of a watched path also: it leads through one. It has a binding."""


class Refusal(TypedDict):
    """Every refused request: what, and what to do next."""

    message: str
    near: list[str]
    """near matches for an unknown name."""


class Watched(TypedDict):
    """One path of a `Watch`: an id for the value frames, or the reason why there is none."""

    path: str
    id: int | None
    symbol: Symbol | None
    refusal: Refusal | None


class Watching(TypedDict):
    """Answer to `watch`; sent again, for all ids, when a new program moved the variables."""

    type: Literal["watching"]
    ref: int | None
    items: list[Watched]
