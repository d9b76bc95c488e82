"""Wire shapes of the error simulator: catalogue, history, reactions, faults with a shape, sweeps. See `messages.py`."""

from typing import Annotated, Literal

from pydantic import Field

from scanbench.faults.reaction.reaction import RequiredResult, Verdict
from scanbench.store.records import SweepProblem, SweptError
from scanbench.web.messages_base import Id, Scan, Wire

Severity = Literal["fatal", "nonfatal"]

# ---- catalogue -------------------------------------------------------------------------------------------------


class Wording(Wire):
    """Name and description in a language other than English; empty where the model has none."""

    language: str = Field(description="as in xml:lang, e.g. ja")
    name: str
    description: str


class ErrorDetail(Wire):
    """One thing to choose or enter when an error is raised."""

    name: str = Field(description="key in the command line's and the API's `details`, e.g. `rack`")
    control: Literal["List", "Spin", "Edit"]
    kind: Literal["Bit", "Word", "Byte", "BCD", "Nibble", "BitArray"] = Field(
        description="of a List: of its first choice"
    )
    description: str
    address: str
    choices: list["ErrorChoiceInfo"] = Field(default_factory=list, description="List: what can be chosen")
    minimum: int | None = None
    maximum: int | None = None
    default: str = ""
    base: int = Field(default=10, description="10, 16; 0: a text of at most `maximum` characters")
    adds: bool = Field(default=False, description="the number is added to the error code")
    identifies: Literal["", "several", "one"] = Field(
        default="", description="its values are errors of their own: several are present together, or one at a time"
    )
    hardware: str = Field(default="", description="what its number counts, of what a project can fit; empty: nothing")
    wordings: list[Wording] = Field(default_factory=list)


class ErrorChoiceInfo(Wire):
    id: str
    description: str
    address: str
    adds: int | None = Field(default=None, description="what choosing it adds to the error code; null: nothing")
    wordings: list[Wording] = Field(default_factory=list)


class Fact(Wire):
    """One statement of the model about the device, and where it comes from."""

    of: str = Field(description="flag, code, severity, priority, cause, memory, log, details, text")
    value: str
    source: str = Field(description="keys are in models/FORMAT.md")
    verified: bool = Field(description="somebody found it on the page that `source` names")
    inherited: bool = Field(description="it has no source of its own, but that of the whole error")


class ErrorInfo(Wire):
    id: str
    name: str
    description: str
    code: str = Field(description="as the device shows it, without what details add")
    flag: str
    severity: Severity
    priority: int = Field(description="1 is the most serious")
    verified: bool
    source: str
    facts: list[Fact] = Field(description="none of a project's own error")
    details: list[ErrorDetail]
    absent: bool = Field(
        default=False, description="the device can report it of what is not fitted: `anyway` raises it"
    )
    user: bool = Field(default=False, description="one of the project's own (errors.xml)")
    wordings: list[Wording] = Field(default_factory=list)


class ErrorGroup(Wire):
    name: str
    groups: list["ErrorGroup"]
    errors: list[ErrorInfo]
    wordings: list[Wording] = Field(default_factory=list)


# ---- reactions -------------------------------------------------------------------------------------------------


class ReactionState(Wire):
    """In short, for the tables. `recording`: the window is not over; `failed`: `message` says why there is none."""

    state: Literal["recording", "done", "failed"]
    verdict: Verdict | None
    scans: int | None = Field(description="scans until the first effect, from 1")
    unmet: int = Field(default=0, description="so much is not as it is required, unexpected restarts counted")
    message: str


# ---- history ---------------------------------------------------------------------------------------------------


class ErrorAcknowledged(Wire):
    """Somebody acknowledged an error at an alarm list."""

    by: str
    at: str = Field(description="ISO 8601, UTC")
    scan: int
    remark: str = Field(description="empty: none")


class ErrorHistoryRow(Wire):
    """One row per error instance: has this version of the program been tested against it?"""

    id: str
    instance: str = Field(
        default="",
        description="which of its kind (`fal:number=5`), what `recover` takes; empty: the kind, of which none is known yet",
    )
    fitted: bool = Field(default=True, description="false: the project's hardware.json does not have it")
    label: str = Field(default="", description="what hardware.json calls the unit or the number")
    name: str
    severity: Severity
    status: Literal["never", "generated", "cleared"]
    code: str
    details: str
    generated_at: str | None = Field(description="ISO 8601, UTC")
    recovered_at: str | None
    generated_scan: int | None
    recovered_scan: int | None
    recovered_by: str = Field(default="", description="who did it; empty: it is present, or went with a restart")
    recovered_way: Literal["simulator", "tool", "program"] | None = Field(
        default=None,
        description="simulator: recovered, its cause is gone, too; tool, program: cleared in the device's own way",
    )
    acknowledged: ErrorAcknowledged | None = Field(
        default=None, description="who acknowledged it the last time that it was raised; null: nobody"
    )
    by: str | None
    origin: Literal["simulator", "plc", "program"] | None
    count: int
    reaction: ReactionState | None = Field(description="of the last time; null when nobody compared")
    swept: ReactionState | None = Field(
        default=None, description="what the newest sweep of this version found out, the worst of its states"
    )


# ---- raise and recover -----------------------------------------------------------------------------------------


class GenerateOne(Wire):
    id: str
    details: dict[str, str] = Field(default_factory=dict, description="detail name to chosen entry or number")


class GenerateErrors(Wire):
    """All of them between the same two scans, or none. `again`: errors that are present change to these details."""

    errors: list[GenerateOne] = Field(min_length=1)
    again: bool = False
    anyway: bool = Field(default=False, description="although the project's hardware.json does not have it")


class FaultStart(Wire):
    """When a fault begins: now, before `scan`, when `condition` holds, when the statement at `file`:`line` is reached."""

    kind: Literal["now", "scan", "condition", "line"] = "now"
    scan: Scan | None = None
    condition: str = Field(default="", max_length=2000)
    file: str = ""
    line: Annotated[int, Field(ge=0, lt=1 << 31)] = 0


class FaultShape(Wire):
    """How a fault goes on. stay: until it is recovered. for: `scans`. intermittent: present for `scans` of each `period`,
    `times` times (null: until it is taken back), varied by chance when there is a `seed`. chatter: on and off in turn, scan by scan,
    `times` times. unacknowledged: recovered after `scans`, before `acknowledge` (a condition) holds. chance: while it is gone, it comes in each scan with a
    probability of `per_million` millionths, and is present for `scans`; `seed` decides in which."""

    kind: Literal["stay", "for", "intermittent", "chatter", "unacknowledged", "chance"] = "stay"
    scans: Annotated[int, Field(ge=1, le=1_000_000_000)] = 1
    period: Annotated[int, Field(ge=2, le=1_000_000_000)] = 2
    times: Annotated[int, Field(ge=1, le=1_000_000)] | None = None
    seed: Annotated[int, Field(ge=0, lt=1 << 32)] | None = None
    acknowledge: str = Field(default="", max_length=2000)
    per_million: Annotated[int, Field(ge=1, le=1_000_000)] = 1_000


class ArmFaults(Wire):
    """Errors with a beginning and a shape; `gap` scans from one to the next (0: all between the same two scans)."""

    errors: list[GenerateOne] = Field(min_length=1)
    start: FaultStart = FaultStart()
    shape: FaultShape = FaultShape()
    gap: Annotated[int, Field(ge=0, le=1_000_000_000)] = 0


class DisarmFaults(Wire):
    """Takes faults back: nothing more is raised, and what they raised and is still present is recovered."""

    ids: list[Id] | None = Field(default=None, description="null is all of them")


class PreviewErrors(GenerateErrors):
    """What raising these would write now. Nothing is changed."""


class CommandResult(Wire):
    """What became of a command that came by REST."""

    ok: bool
    message: str
    scan: int
    near: list[str] = Field(default_factory=list)


class RecoverErrors(Wire):
    ids: list[str] | None = Field(
        default=None, description="all instances (`fal`), or one (`fal:number=5`); null is all that are present"
    )


class ClearErrors(Wire):
    """The tool's own way, as FINS 2101: what the device lets go of. An error whose cause is still there stays."""

    what: Literal["current", "all"] | Annotated[int, Field(ge=0, le=0xFFFF_FFFF)] = Field(
        default="current", description="`current` (the most serious), `all`, or an error code as a number"
    )


# ---- states and sweeps -----------------------------------------------------------------------------------------


class NewProgramState(Wire):
    """Keeps the PLC as it was before `scan`, or is now, as a point to begin sweeps from."""

    name: str = Field(min_length=1, max_length=100)
    scan: Scan | None = None


class NewSweep(Wire):
    """Every error alone, from every state. `states`: numbers of kept states; none: from the PLC as it is now."""

    errors: list[str] | None = Field(
        default=None, description="ids, or instances (`fal:number=5`); null is the whole catalogue"
    )
    states: list[Id] = Field(default_factory=list)
    window: Annotated[int, Field(ge=1, le=100_000)] = 200


SweepStatus = Literal["running", "done", "cancelled", "interrupted", "failed"]


class SweepSummary(Wire):
    """A sweep without its cells: what it tries, and how far it is."""

    id: int
    project: int
    instance_id: int | None = Field(description="null: that PLC is gone")
    instance: str
    model: str
    program_version: int
    by: str
    at: str
    status: SweepStatus
    message: str
    done: int
    total: int
    window: int
    states: list[str]
    counts: dict[Verdict, int]
    unmet: int = Field(
        default=0,
        description="so much in all cells is not as it is required, requirements that could not be tried counted",
    )
    problems: list[SweepProblem] = Field(
        default_factory=list,
        description="mistakes in required.reactions: what it says there was not tried; each is a finding",
    )
    seconds: float = Field(description="spent so far")


class Accepted(Wire):
    """Somebody accepted a finding: the record shows it with this reason."""

    reason: str
    by: str
    at: str


class SweepCell(Wire):
    """What came of one error, raised from one state."""

    error: str
    state: str
    verdict: Verdict | None = Field(description="null: it could not be raised, `note` says why")
    first_read: int | None
    first_effect: int | None
    raised_scan: int
    difference_count: int
    required: int = Field(default=0, description="so many required reactions of the project are about it")
    unmet: int = Field(
        default=0,
        description="and so much is not as it is required; unexpected restarts and what was not tried are counted",
    )
    untried: list[RequiredResult] = Field(
        default_factory=list, description="without a verdict: what is required all the same, and why it was not tried"
    )
    note: str
    accepted: Accepted | None = None


class Sweep(SweepSummary):
    """A sweep with all its cells."""

    errors: tuple[SweptError, ...]
    cells: list[SweepCell]


class AcceptFinding(Wire):
    error: str
    state: str
    reason: str = Field(min_length=1, max_length=500)


class CellRef(Wire):
    error: str
    state: str


class OpenCell(CellRef):
    name: str = Field(min_length=1, max_length=100, description="of the new PLC")


class SweepChange(Wire):
    """One cell in two sweeps; null where a sweep has none."""

    error: str
    name: str
    state: str
    before: Verdict | None
    after: Verdict | None
    scans_before: int | None
    scans_after: int | None
    change: Literal["same", "better", "worse", "fewer", "slower", "faster", "new", "gone"] = Field(
        description="worse: what is required, the grade, or an output differs no longer; fewer: only some other variable does not"
    )
    lost: list[str] = Field(
        default_factory=list, description="what differs no longer because of the error, outputs first"
    )
    unmet: list[str] = Field(default_factory=list, description="what was as required before, and is not any more")


class SweepComparison(Wire):
    before: SweepSummary
    after: SweepSummary
    changes: list[SweepChange]


class SweepProgress(Wire):
    """A sweep of this project began, went on or ended; `cells` are those that are new since the last message."""

    type: Literal["sweep"] = "sweep"
    sweep: SweepSummary
    now: str = Field(description="what is tried now, for people")
    cells: list[SweepCell]
