"""What the parent asks a PLC's host of debugging, and what it hears; goes with `host.py`, packed by `codec.py`.

Each request carries a `ref` and is answered by exactly one message with it; a refusal is an `Ack` that is not ok.
"""

from dataclasses import dataclass
from typing import Literal

from scanbench.debug.bound_to import Bound, BoundTo
from scanbench.debug.breakpoint import Breakpoint, Verdict
from scanbench.debug.flow_shown import FlowAsked, Flows
from scanbench.debug.shown import FrameInfo, ScopeInfo, VariableInfo
from scanbench.public import Public
from scanbench.taps.covered import CoveredFile
from scanbench.verify.contract import Range

# ---- parent to host ------------------------------------------------------------------------------------------------

StepAction = Literal[
    "continue", "pause", "in", "within", "over", "out", "statement", "scan", "to", "back", "reverse", "entry"
]
"""`in`: to the next statement anywhere, into calls. `within`: to the next statement of a range, into its calls. `over`: to the next statement of this frame or one further out. `out`:
to the next statement of the frame that called. `statement`: as `in`. `scan`: to the first statement of the next scan.
`to`: to a line. `back`: to the statement before. `reverse`: back to where a breakpoint would have halted last (or the
first scan that is kept). `entry`: to the first statement of the next scan, from a run that goes on. After the last statement of a scan the next scan begins at
once. Steps from a PLC that runs halt first, at its next statement."""


@dataclass(frozen=True, slots=True)
class SetBreakpoints:
    """All breakpoints of a group from now on; `file` narrows that to its line breakpoints, `kind` to that kind. Answered
    with `BreakpointsAre` of these."""

    ref: int
    group: str
    kind: str | None
    file: str | None
    breakpoints: tuple[Breakpoint, ...]


@dataclass(frozen=True, slots=True)
class Step:
    """Moves a PLC as a debugger does; answered with `Ack` when it is under way (a halt follows in `PlcState.halt`), for
    steps back when it is done."""

    ref: int
    action: StepAction
    author: str
    file: str = ""
    line: int = 0
    path: str = ""
    """`reverse` to the last write of this variable, whatever breakpoints there are."""
    range: Range | None = None
    """Of `within`."""


@dataclass(frozen=True, slots=True)
class WantStack:
    """Answered with `Stack`; refused while the PLC is not halted."""

    ref: int


@dataclass(frozen=True, slots=True)
class WantTasks:
    """Answered with `Tasks`, whether it is halted or not."""

    ref: int


@dataclass(frozen=True, slots=True)
class WantScopes:
    """The scopes of a frame (index into `Stack`); answered with `Scopes`."""

    ref: int
    frame: int


@dataclass(frozen=True, slots=True)
class WantVariables:
    """The parts of an expression that is a place: members, elements; answered with `Variables`.

    `scope` (one of the names in `Scopes`) with an empty expression: the variables of that scope. `frame` None as in
    `Evaluate`: an expression in the scope of the whole program, also while it runs.
    """

    ref: int
    frame: int | None
    scope: str
    expression: str
    start: int = 0
    count: int = 0
    """0: all, but no more than 1,000."""


@dataclass(frozen=True, slots=True)
class Evaluate:
    """An expression of ST in a frame's scope, or of the whole program (`frame` None, also while it runs); answered with
    `Evaluated`. Calls run on a copy of the image, so nothing is changed; `effects`: an assignment or call that is to change
    it is entered through the one door."""

    ref: int
    frame: int | None
    text: str
    author: str
    effects: bool = False


@dataclass(frozen=True, slots=True)
class SetExpression:
    """Gives a place of a frame's scope (or of the whole program) a value, through the one door; answered with
    `Evaluated` of what it is then."""

    ref: int
    frame: int | None
    target: str
    value: str
    author: str


@dataclass(frozen=True, slots=True)
class WantPlaces:
    """Where breakpoints can be in a file, from line to line; answered with `Places`."""

    ref: int
    file: str
    first: int
    last: int


@dataclass(frozen=True, slots=True)
class WantBinding:
    """What an in-out is bound to; answered with `BindingIs`."""

    ref: int
    path: str


@dataclass(frozen=True, slots=True)
class WantFlow:
    """What the code of an instance saw in the last scan, and in the one that is halted; answered with `FlowIs`. While the PLC
    runs it is the scan that runs next."""

    ref: int
    asked: FlowAsked


@dataclass(frozen=True, slots=True)
class SetCoverage:
    """Notes what is reached from now on, or no longer; `reset` forgets what was noted. Answered with `Ack`."""

    ref: int
    on: bool
    reset: bool
    author: str


@dataclass(frozen=True, slots=True)
class WantCoverage:
    """Answered with `CoverageIs`."""

    ref: int


# ---- host to parent ------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class BreakpointsAre:
    """Answer to `SetBreakpoints`; with ref None: all there are, whenever they or their counts changed."""

    ref: int | None
    verdicts: tuple[Verdict, ...]


@dataclass(frozen=True, slots=True)
class LogpointSaid:
    """A logpoint was reached."""

    breakpoint: int
    text: str
    scan: int
    file: str
    line: int


@dataclass(frozen=True, slots=True)
class Stack:
    ref: int
    frames: tuple[FrameInfo, ...]
    """Innermost first."""


@dataclass(frozen=True, slots=True)
class Tasks:
    """Answer to `WantTasks`."""

    ref: int
    names: tuple[str, ...]
    """Of the program that is shown, in the order in which they run."""


@dataclass(frozen=True, slots=True)
class Scopes:
    ref: int
    scopes: tuple[ScopeInfo, ...]


@dataclass(frozen=True, slots=True)
class Variables:
    ref: int
    variables: tuple[VariableInfo, ...]
    total: int


@dataclass(frozen=True, slots=True)
class Evaluated:
    ref: int
    ok: bool
    message: str
    variable: VariableInfo | None
    near: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class PlaceInfo:
    """A statement at which a breakpoint can be set."""

    line: int
    column: int
    end_line: int
    end_column: int
    pou: str


@dataclass(frozen=True, slots=True)
class Places:
    ref: int
    places: tuple[PlaceInfo, ...]


@dataclass(frozen=True, slots=True)
class BindingIs:
    """Answer to `WantBinding`."""

    ref: int
    bound: Bound


@dataclass(frozen=True, slots=True)
class FlowIs:
    """Answer to `WantFlow`."""

    ref: int
    flows: Flows


@dataclass(frozen=True, slots=True)
class Coverage(Public):
    """Told while coverage is on, whenever something more was reached, and when it is switched."""

    on: bool
    since_scan: int
    scans: int
    """How many scans were noted."""
    files: tuple[CoveredFile, ...]
    type: Literal["coverage"] = "coverage"


@dataclass(frozen=True, slots=True)
class CoverageIs:
    """Answer to `WantCoverage`; with ref None whenever it changes while it is on."""

    ref: int | None
    coverage: Coverage


DebugRequest = (
    SetBreakpoints | Step | WantStack | WantTasks | WantScopes | WantVariables | Evaluate | SetExpression | WantPlaces | WantBinding
    | SetCoverage | WantCoverage | WantFlow
)  # fmt: skip
__all__ = ["BoundTo", "FrameInfo", "ScopeInfo", "VariableInfo"]
